//! Scenes and rays made of random numbers.

use glam::{Affine3A, Mat3, Vec3, Vec4};
use matcha_render::accel::{Accel, NOTHING, Ray, ray_kind};
use matcha_render::scene::{Instance, Mesh, Scene, Visibility};

/// Numbers that look random (PCG's multiplier).
pub struct Random(pub u64);

impl Random {
    pub fn number(&mut self) -> f32 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 40) as f32 / (1u64 << 24) as f32
    }

    /// In [-1, 1]³.
    pub fn vector(&mut self) -> Vec3 {
        Vec3::new(self.number(), self.number(), self.number()) * 2.0 - 1.0
    }
}

fn soup(triangles: u32, size: f32, random: &mut Random) -> Mesh {
    let mut mesh = Mesh::default();
    for i in 0..triangles {
        let center = random.vector();
        mesh.positions
            .extend([0; 3].map(|_| center + random.vector() * size));
        mesh.indices.push([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    mesh
}

/// A closed wavy surface: neighbours share edges.
fn surface(rings: u32, sectors: u32) -> Mesh {
    let mut mesh = Mesh::default();
    for ring in 0..=rings {
        for sector in 0..sectors {
            let theta = std::f32::consts::PI * ring as f32 / rings as f32;
            let phi = std::f32::consts::TAU * sector as f32 / sectors as f32;
            let radius = 1.0 + 0.2 * (5.0 * phi).sin() * theta.sin();
            let flat = Vec3::new(
                theta.sin() * phi.cos(),
                theta.sin() * phi.sin(),
                theta.cos(),
            );
            mesh.positions.push(flat * radius);
        }
    }
    for ring in 0..rings {
        for sector in 0..sectors {
            let next = (sector + 1) % sectors;
            let [a, b] = [ring * sectors + sector, ring * sectors + next];
            mesh.indices
                .extend([[a, a + sectors, b], [b, a + sectors, b + sectors]]);
        }
    }
    mesh
}

/// Soups, surfaces, and a flat pane; some are hidden from some rays, some are mirrored or tiny.
pub fn scene(instances: usize, triangles: u32, seed: u64) -> Scene {
    let mut random = Random(seed);
    let mut pane = Mesh::default();
    pane.positions
        .extend([Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(1.0, 1.0, 0.0)]);
    pane.indices.extend([[0, 1, 2], [2, 1, 3]]);
    let meshes = vec![
        soup(triangles, 0.2, &mut random),
        surface(triangles / 40 + 3, 40),
        pane,
    ];
    let place = |i: usize| {
        let turn = Mat3::from_rotation_y(random.number() * 6.0);
        let scale = Mat3::from_diagonal(random.vector() + Vec3::splat(1.2));
        Instance {
            name: format!("object {i}"),
            mesh: (i % 3) as u32,
            transform: Affine3A::from_mat3_translation(turn * scale, random.vector() * 3.0),
            materials: vec![],
            pass_index: 0.0,
            random: 0.0,
            color: Vec4::ONE,
            visibility: Visibility {
                camera: i % 5 != 1,
                shadow: i % 7 != 2,
                ..Visibility::default()
            },
            holdout: false,
        }
    };
    Scene {
        instances: (0..instances).map(place).collect(),
        meshes,
        ..Scene::default()
    }
}

/// Rays as a path tracer has them: from everywhere, from surfaces onward, along axes, limited ones
/// and such that have no direction.
pub fn rays(accel: &Accel, extent: f32, count: usize, seed: u64) -> Vec<Ray> {
    let mut random = Random(seed);
    let mut rays = Vec::with_capacity(count);
    let kinds = [
        ray_kind::ALL,
        ray_kind::CAMERA,
        ray_kind::SHADOW,
        ray_kind::TRANSPARENT_SHADOW,
    ];
    while rays.len() < count {
        let mut ray = Ray::new(random.vector() * extent, random.vector());
        ray.mask = kinds[(random.number() * 3.99) as usize];
        match rays.len() % 16 {
            0 => ray.direction = Vec3::new(0.0, 0.0, -1.0),
            1 => ray.direction.x = 0.0,
            2 => ray.t_max = random.number() * extent,
            3 => ray.t_min = random.number() * extent,
            _ => {}
        }
        rays.push(ray);
        if let Some(hit) = accel.closest(&ray) {
            let mut onward = Ray::new(ray.origin + ray.direction * hit.t, random.vector());
            onward.excluded = [hit.instance, hit.primitive];
            onward.mask = ray.mask;
            rays.push(onward);
        }
    }
    rays.truncate(count);
    let unsound = [
        Vec3::ZERO,
        Vec3::splat(f32::NAN),
        Vec3::splat(f32::INFINITY),
    ];
    for (ray, direction) in rays.iter_mut().zip(unsound) {
        ray.direction = direction;
        ray.excluded = [NOTHING; 2];
    }
    rays
}
