use super::*;
use crate::scene::{Instance, Mesh, Visibility};
use glam::{Affine3A, Mat3, Vec3, Vec4};
use proptest::prelude::*;

pub(crate) fn random(state: &mut u64) -> f32 {
    *state = state
        .wrapping_mul(6364136223846793005)
        .wrapping_add(1442695040888963407);
    ((*state >> 40) as f32) / (1u64 << 24) as f32
}

fn random_vec(state: &mut u64) -> Vec3 {
    Vec3::new(random(state), random(state), random(state)) * 2.0 - 1.0
}

fn soup(triangles: usize, size: f32, state: &mut u64) -> Mesh {
    let mut mesh = Mesh {
        name: "soup".into(),
        ..Mesh::default()
    };
    for i in 0..triangles as u32 {
        let center = random_vec(state);
        mesh.positions
            .extend([0; 3].map(|_| center + random_vec(state) * size));
        mesh.indices.push([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    mesh
}

fn place(mesh: u32, transform: Affine3A) -> Instance {
    Instance {
        name: "object".into(),
        mesh,
        transform,
        materials: vec![],
        pass_index: 0.0,
        random: 0.0,
        color: Vec4::ONE,
        visibility: Visibility::default(),
        holdout: false,
    }
}

fn scene(meshes: usize, instances: usize, triangles: usize, seed: u64) -> Scene {
    let mut state = seed;
    let meshes: Vec<Mesh> = (0..meshes)
        .map(|_| soup(triangles, 0.2, &mut state))
        .collect();
    let instances = (0..instances)
        .map(|i| {
            let linear = Mat3::from_rotation_y(random(&mut state) * 6.0)
                * Mat3::from_diagonal(random_vec(&mut state) + Vec3::splat(1.5));
            let offset = random_vec(&mut state) * 3.0;
            place(
                (i % meshes.len()) as u32,
                Affine3A::from_mat3_translation(linear, offset),
            )
        })
        .collect();
    Scene {
        meshes,
        instances,
        ..Scene::default()
    }
}

/// Every triangle of every instance in f64, by Möller and Trumbore.
fn brute_force(scene: &Scene, ray: &Ray) -> Option<(u32, u32, f64)> {
    let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
    let mut best: Option<(u32, u32, f64)> = None;
    for (i, instance) in scene.instances.iter().enumerate() {
        if visibility_mask(&instance.visibility) & ray.mask == 0 {
            continue;
        }
        let mesh = &scene.meshes[instance.mesh as usize];
        for (p, triangle) in mesh.indices.iter().enumerate() {
            if ray.excluded == [i as u32, p as u32] {
                continue;
            }
            let [a, b, c] = triangle.map(|v| {
                instance
                    .transform
                    .transform_point3(mesh.positions[v as usize])
                    .as_dvec3()
            });
            if [a, b, c].iter().any(|p| p.abs().max_element() > 1e18) {
                continue;
            }
            let (ab, ac) = (b - a, c - a);
            let normal = direction.cross(ac);
            let determinant = ab.dot(normal);
            let from = origin - a;
            let u = from.dot(normal) / determinant;
            let side = from.cross(ab);
            let v = direction.dot(side) / determinant;
            let t = ac.dot(side) / determinant;
            let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
            let within = t > f64::from(ray.t_min) && t < f64::from(ray.t_max);
            if inside && within && best.is_none_or(|b| t < b.2) {
                best = Some((i as u32, p as u32, t));
            }
        }
    }
    best
}

/// Compares with brute force; a few rays graze an edge and may differ in f32.
fn agree(scene: &Scene, accel: &Accel, rays: usize, seed: u64) -> usize {
    let mut state = seed;
    let mut differ = 0;
    for _ in 0..rays {
        let mut ray = Ray::new(random_vec(&mut state) * 6.0, random_vec(&mut state));
        if random(&mut state) < 0.3 {
            ray.t_max = random(&mut state) * 8.0;
            ray.t_min = random(&mut state) * 2.0;
        }
        let expected = brute_force(scene, &ray);
        let found = accel.closest(&ray);
        let same = match (&expected, &found) {
            (None, None) => true,
            (Some((i, p, t)), Some(hit)) => {
                let close = (f64::from(hit.t) - t).abs() < 1e-4 * (1.0 + t);
                (hit.instance, hit.primitive) == (*i, *p) && close
            }
            _ => false,
        };
        differ += usize::from(!same);
        assert_eq!(accel.occluded(&ray), found.is_some());
    }
    differ
}

#[test]
fn every_way_to_build_agrees_with_brute_force() {
    for (budget, pre_split) in [(0, false), (0, true), (150, false), (1 << 20, true)] {
        let flat_triangles = Some(budget);
        let scene = scene(3, 12, 60, 7);
        let options = BuildOptions {
            flat_triangles,
            pre_split,
            ..BuildOptions::default()
        };
        let mut accel = Accel::build_with(&scene, &options).unwrap();
        accel.validate().unwrap();
        let differ = agree(&scene, &accel, 3000, 11);
        assert!(differ <= 3, "{differ} of 3000 rays differ ({options:?})");
        accel.use_portable_kernel();
        let differ = agree(&scene, &accel, 3000, 11);
        assert!(
            differ <= 3,
            "{differ} of 3000 rays differ, portable ({options:?})"
        );
    }
}

/// A picture is the same whatever the processor, and a GPU's walk can have the same hits.
#[test]
fn all_kernels_give_the_same_bits() {
    let scene = scene(3, 12, 60, 7);
    let accel = Accel::build(&scene).unwrap();
    let mut portable = Accel::build(&scene).unwrap();
    portable.use_portable_kernel();
    let mut state = 23;
    let mut hits = 0;
    for _ in 0..10_000 {
        let ray = Ray::new(random_vec(&mut state) * 6.0, random_vec(&mut state));
        let bits = |accel: &Accel| {
            let hit = accel.closest(&ray)?;
            let numbers = [hit.t, hit.u, hit.v].map(f32::to_bits);
            Some((hit.instance, hit.primitive, numbers))
        };
        let found = bits(&accel);
        assert_eq!(found, bits(&portable), "{ray:?}");
        hits += usize::from(found.is_some());
    }
    assert!(hits > 500, "only {hits} rays hit anything");
}

#[test]
fn a_wrong_box_is_noticed() {
    let scene = scene(1, 1, 400, 3);
    let mut accel = Accel::build(&scene).unwrap();
    accel.validate().unwrap();
    let root = accel.root.index();
    accel.nodes[root].bounds[1][0] = accel.nodes[root].bounds[0][0] - 1.0;
    assert!(accel.validate().is_err());
    let differ = agree(&scene, &accel, 2000, 5);
    assert!(differ > 5, "only {differ} rays noticed");
}

#[test]
fn hits_weigh_the_corners() {
    let mut scene = Scene::default();
    scene.meshes.push(Mesh {
        positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
        indices: vec![[0, 1, 2]],
        ..Mesh::default()
    });
    scene.instances.push(place(0, Affine3A::IDENTITY));
    let accel = Accel::build(&scene).unwrap();
    let hit = accel
        .closest(&Ray::new(Vec3::new(0.2, 0.3, 2.0), Vec3::NEG_Z))
        .unwrap();
    assert!((hit.u - 0.2).abs() < 1e-6 && (hit.v - 0.3).abs() < 1e-6 && (hit.t - 2.0).abs() < 1e-6);
}

#[test]
fn nothing_is_hit_in_an_empty_scene() {
    let accel = Accel::build(&Scene::default()).unwrap();
    assert!(accel.closest(&Ray::new(Vec3::ZERO, Vec3::X)).is_none());
    accel.validate().unwrap();
}

#[test]
fn unsound_triangles_are_dropped() {
    let mut scene = scene(1, 1, 50, 1);
    let mesh = &mut scene.meshes[0];
    mesh.positions[0].x = f32::NAN;
    mesh.positions[4] = mesh.positions[3];
    mesh.positions[8].z = f32::INFINITY;
    mesh.positions[9].y = 3e30;
    for flat_triangles in [Some(0), Some(1000)] {
        let options = BuildOptions {
            flat_triangles,
            ..BuildOptions::default()
        };
        let accel = Accel::build_with(&scene, &options).unwrap();
        assert_eq!(accel.dropped_triangles(), 4);
        accel.validate().unwrap();
        assert!(agree(&scene, &accel, 500, 2) <= 1);
    }
}

#[test]
fn unsound_rays_hit_nothing() {
    let accel = Accel::build(&scene(1, 1, 50, 1)).unwrap();
    for bad in [f32::NAN, f32::INFINITY] {
        assert!(
            accel
                .closest(&Ray::new(Vec3::splat(bad), Vec3::X))
                .is_none()
        );
        assert!(
            accel
                .closest(&Ray::new(Vec3::ZERO, Vec3::new(bad, 1.0, 0.0)))
                .is_none()
        );
    }
    assert!(accel.closest(&Ray::new(Vec3::ZERO, Vec3::ZERO)).is_none());
}

#[test]
fn lying_indices_are_errors() {
    let mut broken = scene(1, 1, 5, 1);
    broken.meshes[0].indices[2][1] = 99;
    assert!(matches!(
        Accel::build(&broken),
        Err(AccelError::VertexIndex {
            triangle: 2,
            vertex: 99,
            ..
        })
    ));
    let mut broken = scene(1, 1, 5, 1);
    broken.instances[0].mesh = 4;
    assert!(matches!(
        Accel::build(&broken),
        Err(AccelError::MeshIndex { mesh: 4, .. })
    ));
}

#[test]
fn a_flattened_or_collapsed_instance_does_no_harm() {
    let mut scene = scene(1, 3, 40, 9);
    scene.instances[1].transform = Affine3A::from_scale(Vec3::new(1.0, 1.0, 0.0));
    scene.instances[2].transform = Affine3A::from_scale(Vec3::ZERO);
    let options = BuildOptions {
        flat_triangles: Some(0),
        ..BuildOptions::default()
    };
    let accel = Accel::build_with(&scene, &options).unwrap();
    accel.validate().unwrap();
    assert!(agree(&scene, &accel, 1000, 4) <= 2);
}

#[test]
fn coincident_triangles_make_no_trouble() {
    let mut scene = Scene::default();
    let mut mesh = Mesh {
        positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
        ..Mesh::default()
    };
    mesh.indices = vec![[0, 1, 2]; 5000];
    scene.meshes.push(mesh);
    scene.instances.push(place(0, Affine3A::IDENTITY));
    let accel = Accel::build(&scene).unwrap();
    accel.validate().unwrap();
    assert!(
        accel
            .closest(&Ray::new(Vec3::new(0.2, 0.2, 1.0), Vec3::NEG_Z))
            .is_some()
    );
}

#[test]
fn visibility_and_exclusion_hide() {
    let mut state = 5;
    for flat_triangles in [Some(0), None] {
        let mut scene = scene(2, 6, 80, 21);
        scene.instances[0].visibility.camera = false;
        scene.instances[1].visibility.shadow = false;
        let options = BuildOptions {
            flat_triangles,
            ..BuildOptions::default()
        };
        let accel = Accel::build_with(&scene, &options).unwrap();
        let mut differ = 0;
        for _ in 0..1000 {
            let mut ray = Ray::new(random_vec(&mut state) * 5.0, random_vec(&mut state));
            ray.mask = if random(&mut state) < 0.5 {
                ray_kind::CAMERA
            } else {
                ray_kind::SHADOW
            };
            if let Some(first) = accel.closest(&ray) {
                ray.excluded = [first.instance, first.primitive];
            }
            let expected = brute_force(&scene, &ray).map(|(i, p, _)| (i, p));
            let found = accel.closest(&ray).map(|hit| (hit.instance, hit.primitive));
            differ += usize::from(expected != found);
        }
        assert!(differ <= 2, "{differ}");
    }
}

/// A flat closed surface with thin triangles.
fn closed_surface() -> Mesh {
    let (rings, sectors) = (40u32, 60u32);
    let mut mesh = Mesh::default();
    for r in 0..=rings {
        for s in 0..sectors {
            let theta = std::f32::consts::PI * r as f32 / rings as f32;
            let phi = std::f32::consts::TAU * s as f32 / sectors as f32;
            let ring = if r == 0 || r == rings {
                0.0
            } else {
                theta.sin()
            };
            mesh.positions.push(Vec3::new(
                ring * phi.cos(),
                ring * phi.sin(),
                theta.cos() * 0.3,
            ));
        }
    }
    for r in 0..rings {
        for s in 0..sectors {
            let next = (s + 1) % sectors;
            let [a, b] = [r * sectors + s, r * sectors + next];
            let [c, d] = [a + sectors, b + sectors];
            mesh.indices.extend([[a, c, b], [b, c, d]]);
        }
    }
    mesh
}

/// Rays from inside of a closed surface at its edges: none gets out. (At a vertex the signs of six
/// edges would have to agree, and each is rounded on its own: a ray that aims at one to the last
/// bit may pass. Such rays have no measure.)
#[test]
fn edges_of_a_closed_surface_are_tight() {
    let mesh = closed_surface();
    let mut scene = Scene::default();
    scene.meshes.push(mesh.clone());
    scene.instances.push(place(0, Affine3A::IDENTITY));
    let mut accel = Accel::build(&scene).unwrap();
    let mut state = 3;
    for portable in [false, true] {
        if portable {
            accel.use_portable_kernel();
        }
        for i in 0..60_000 {
            let triangle = mesh.indices[(random(&mut state) * 4799.0) as usize];
            let [a, b] =
                [triangle[i % 3], triangle[(i + 1) % 3]].map(|v| mesh.positions[v as usize]);
            if a == b {
                continue;
            }
            let origin = random_vec(&mut state) * 0.1;
            let along = a.lerp(b, 0.05 + 0.9 * random(&mut state));
            let ray = Ray::new(origin, along - origin);
            assert!(
                accel.occluded(&ray),
                "{ray:?} slipped through (portable {portable})"
            );
        }
    }
}

#[test]
fn an_offset_leaves_the_surface_on_the_right_side() {
    let mut state = 77;
    for scale in [1e-3, 1.0, 1e4] {
        for _ in 0..1000 {
            let point = random_vec(&mut state) * scale;
            let normal = random_vec(&mut state).normalize();
            let direction = random_vec(&mut state);
            let moved = offset_origin(point, normal, direction).as_dvec3() - point.as_dvec3();
            let side = f64::from(normal.dot(direction).signum());
            assert!(moved.dot(normal.as_dvec3()) * side > 0.0);
            assert!(moved.length() < 1e-4 * f64::from(scale.max(1.0)));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn random_scenes_agree(seed in 1u64.., meshes in 1usize..4, instances in 1usize..9,
                           triangles in 1usize..70, flat in 0usize..300) {
        let scene = scene(meshes, instances, triangles, seed);
        let options = BuildOptions { flat_triangles: Some(flat), ..BuildOptions::default() };
        let accel = Accel::build_with(&scene, &options).unwrap();
        prop_assert_eq!(accel.validate(), Ok(()));
        prop_assert!(agree(&scene, &accel, 200, seed ^ 99) <= 1);
    }
}
