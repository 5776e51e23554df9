//! The device's walk against the processor's, on the same rays.

mod comparison;
mod scenes;

use comparison::{Difference, Tracer};
use glam::{Affine3A, Vec3};
use matcha_gpu::device::Device;
use matcha_gpu::testing;
use matcha_gpu::trace::WideTree;
use matcha_render::accel::{Accel, BuildOptions, Ray};
use matcha_render::scene::{Mesh, Scene};

/// Rays that may find another triangle at the same distance: where triangles overlap.
const TIES: usize = 5;
/// Rays (of 100,000) that may pass an edge on the other side on a device that fuses products.
const GRAZING: usize = 5;

fn compare(device: &Device, accel: &Accel, tree: &WideTree, rays: &[Ray]) -> Difference {
    let tracer = Tracer::new(device, tree, rays).unwrap_or_else(|e| panic!("{e}"));
    comparison::compare(&tracer, accel, rays).unwrap_or_else(|e| panic!("{e}"))
}

fn assert_agree(difference: &Difference, rays: usize) {
    let allowed = |share: usize| rays * share / 100_000;
    assert!(difference.hits * 5 > rays, "{difference:?}");
    assert!(
        difference.other <= allowed(TIES + GRAZING),
        "{difference:?}"
    );
    assert!(difference.wrong <= allowed(GRAZING), "{difference:?}");
    assert!(difference.shadows <= allowed(GRAZING), "{difference:?}");
    assert!(difference.largest < 1e-2, "{difference:?}");
}

/// A scene's structure whose rays the portable kernel answers, so that both devices run the same
/// device code, and the device's form of it.
fn structures(flat: Option<usize>, seed: u64) -> (Accel, WideTree) {
    let scene = scenes::scene(17, 700, seed);
    let options = BuildOptions {
        flat_triangles: flat,
        ..BuildOptions::default()
    };
    let mut accel = Accel::build_with(&scene, &options).expect("a structure");
    let transparent: Vec<bool> = (0..17).map(|i| i % 4 == 3).collect();
    accel.part_shadows(&transparent);
    accel.use_portable_kernel();
    let tree = WideTree::new(&accel).expect("a hierarchy");
    (accel, tree)
}

#[test]
fn the_device_finds_what_the_processor_finds() {
    let Some(device) = testing::device() else {
        return;
    };
    for (flat, seed) in [(Some(0), 1), (None, 2), (Some(3000), 3)] {
        let (accel, tree) = structures(flat, seed);
        let rays = scenes::rays(&accel, 5.0, 200_000, seed);
        let difference = compare(&device, &accel, &tree, &rays);
        println!("flat {flat:?}, {} levels: {difference:?}", tree.levels);
        assert_agree(&difference, rays.len());
    }
}

/// Triangles each smaller than the one before by a ratio, around the same point.
fn nested(count: i32, ratio: f32) -> Scene {
    let mut mesh = Mesh::default();
    for k in 0..count {
        let size = ratio.powi(k);
        let corner = |axis: Vec3| axis * size + Vec3::splat(size * 0.1);
        mesh.positions
            .extend([corner(Vec3::X), corner(Vec3::Y), corner(Vec3::Z)]);
        let first = 3 * k as u32;
        mesh.indices.push([first, first + 1, first + 2]);
    }
    let mut scene = scenes::scene(1, 1, 1);
    scene.instances[0].transform = Affine3A::IDENTITY;
    scene.meshes = vec![mesh];
    scene
}

/// Triangles of 60 sizes from 1 to 10⁻⁹ within each other, by rays of all sizes. (Cubes of still
/// smaller ones are no numbers that every device has.)
#[test]
fn nested_triangles_of_all_sizes_are_found() {
    let Some(device) = testing::device() else {
        return;
    };
    let mut accel = Accel::build(&nested(60, 0.7)).expect("a structure");
    accel.use_portable_kernel();
    let tree = WideTree::new(&accel).expect("a hierarchy");
    let mut random = scenes::Random(4);
    let toward = |random: &mut scenes::Random| {
        let size = 0.7f32.powf(random.number() * 62.0);
        let origin = random.vector() * 3.0 * size;
        Ray::new(origin, random.vector() * size - origin)
    };
    let rays: Vec<Ray> = (0..100_000).map(|_| toward(&mut random)).collect();
    let difference = compare(&device, &accel, &tree, &rays);
    println!("{} levels: {difference:?}", tree.levels);
    assert_agree(&difference, rays.len());
}

#[test]
fn an_empty_scene_has_no_hits() {
    let Some(device) = testing::device() else {
        return;
    };
    let accel = Accel::build(&Default::default()).expect("a structure");
    let tree = WideTree::new(&accel).expect("a hierarchy");
    let rays = vec![Ray::new(Vec3::ZERO, Vec3::X); 100];
    let difference = compare(&device, &accel, &tree, &rays);
    assert_eq!((difference.other, difference.shadows), (0, 0));
}

/// The comparison must notice one wrong byte: the upper side of one box of the root.
#[test]
fn must_fail_a_corrupted_node_is_noticed() {
    let Some(device) = testing::device() else {
        return;
    };
    let (accel, mut tree) = structures(None, 2);
    let slot = tree.nodes[0].kinds.trailing_zeros() as usize;
    let sides = &mut tree.nodes[0].sides[0];
    sides[1][slot] = sides[0][slot];
    let rays = scenes::rays(&accel, 5.0, 100_000, 2);
    let difference = compare(&device, &accel, &tree, &rays);
    let result = std::panic::catch_unwind(|| assert_agree(&difference, rays.len()));
    assert!(result.is_err(), "not noticed: {difference:?}");
}
