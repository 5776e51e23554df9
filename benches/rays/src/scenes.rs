//! Scenes of about a million triangles, and rays through any scene.

use glam::{Affine3A, Quat, Vec3, Vec4, vec3};
use matcha_render::accel::{Accel, Ray};
use matcha_render::scene::{Instance, Mesh, Scene, Visibility};
use std::f32::consts::{PI, TAU};

/// A small generator, the same on every machine.
pub struct Random(pub u64);

impl Random {
    pub fn unit(&mut self) -> f32 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / (1u64 << 24) as f32
    }

    pub fn cube(&mut self) -> Vec3 {
        vec3(self.unit(), self.unit(), self.unit()) * 2.0 - 1.0
    }
}

fn place(mesh: usize, transform: Affine3A) -> Instance {
    Instance {
        name: String::new(),
        mesh: mesh as u32,
        transform,
        materials: vec![],
        pass_index: 0.0,
        random: 0.0,
        color: Vec4::ONE,
        visibility: Visibility::default(),
        holdout: false,
    }
}

fn add(scene: &mut Scene, mesh: Mesh, transform: Affine3A) {
    scene.instances.push(place(scene.meshes.len(), transform));
    scene.meshes.push(mesh);
}

fn bumpy_sphere(steps: u32) -> Mesh {
    let mut mesh = Mesh::default();
    for j in 0..=steps {
        for i in 0..=steps {
            let (t, p) = (i as f32 / steps as f32 * TAU, j as f32 / steps as f32 * PI);
            let r = 1.0 + 0.1 * (9.0 * t).sin() * (7.0 * p).sin();
            mesh.positions
                .push(r * vec3(p.sin() * t.cos(), p.sin() * t.sin(), p.cos()));
        }
    }
    let row = steps + 1;
    for a in (0..steps).flat_map(|j| (0..steps).map(move |i| j * row + i)) {
        mesh.indices
            .extend([[a, a + 1, a + row], [a + 1, a + row + 1, a + row]]);
    }
    mesh
}

fn room() -> Mesh {
    let side = |bit: bool| if bit { 4.0 } else { -4.0 };
    let quads = [
        [0, 1, 3, 2],
        [4, 6, 7, 5],
        [0, 4, 5, 1],
        [2, 3, 7, 6],
        [0, 2, 6, 4],
        [1, 5, 7, 3],
    ];
    Mesh {
        positions: (0..8)
            .map(|i| vec3(side(i & 1 > 0), side(i & 2 > 0), side(i & 4 > 0)))
            .collect(),
        indices: quads
            .iter()
            .flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]])
            .collect(),
        ..Mesh::default()
    }
}

/// A hundred spheres of ten thousand triangles in a room.
pub fn spheres() -> Scene {
    let mut scene = Scene::default();
    let mut random = Random(1);
    for _ in 0..100 {
        let scale = Vec3::splat(0.1 + 0.3 * random.unit());
        let turn = Quat::from_rotation_x(random.unit() * TAU);
        let transform = Affine3A::from_scale_rotation_translation(scale, turn, random.cube() * 3.0);
        add(&mut scene, bumpy_sphere(70), transform);
    }
    add(&mut scene, room(), Affine3A::IDENTITY);
    scene
}

/// A million thin triangles in a room: boxes overlap everywhere.
pub fn soup() -> Scene {
    let mut scene = Scene::default();
    let mut random = Random(1);
    let mut mesh = Mesh::default();
    for i in 0..1_000_000 {
        let corner = random.cube() * 3.0;
        let (long, short) = (random.cube() * 0.05, random.cube() * 0.01);
        mesh.positions
            .extend([corner, corner + long, corner + short]);
        mesh.indices.push([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    add(&mut scene, mesh, Affine3A::IDENTITY);
    add(&mut scene, room(), Affine3A::IDENTITY);
    scene
}

/// Incoherent rays of second and third bounces, and shadow rays from the same points to a spot
/// above the scene's middle.
pub fn rays(accel: &Accel, scene: &Scene, from_camera: bool, count: usize) -> [Vec<Ray>; 2] {
    let mut random = Random(5);
    let eye = Vec3::from(scene.camera.transform.translation);
    let forward = -Vec3::from(scene.camera.transform.matrix3.z_axis);
    let mut bounces: Vec<Ray> = Vec::with_capacity(count);
    for attempt in 0..6 * count {
        let mut ray = if from_camera {
            Ray::new(eye, (forward + random.cube() * 0.6).normalize_or(forward))
        } else {
            Ray::new(random.cube() * 3.9, random.cube().normalize_or(Vec3::X))
        };
        for _ in 0..1 + attempt % 2 {
            let Some(hit) = accel.closest(&ray) else {
                break;
            };
            let point = ray.origin + ray.direction * (hit.t * 0.9999);
            ray = Ray {
                t_min: 1e-4,
                ..Ray::new(point, random.cube().normalize_or(Vec3::X))
            };
        }
        if ray.t_min > 0.0 {
            bounces.push(ray);
        }
        if bounces.len() == count {
            break;
        }
    }
    let middle = bounces.iter().map(|r| r.origin).sum::<Vec3>() / bounces.len().max(1) as f32;
    let to_lamp = |ray: &Ray| {
        let direction = middle + Vec3::Z + 0.5 * ray.direction - ray.origin;
        Ray {
            direction,
            t_max: 0.999,
            ..*ray
        }
    };
    let shadows = bounces.iter().map(to_lamp).collect();
    [bounces, shadows]
}
