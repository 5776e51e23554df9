//! The device's ray queries against the processor's walk, on the same rays.

#[path = "../trace/comparison.rs"]
mod comparison;
#[path = "../trace/scenes.rs"]
mod scenes;

use comparison::{Difference, Tracer};
use glam::{Affine3A, Mat3, Vec3};
use matcha_gpu::device::Device;
use matcha_gpu::memory::Sections;
use matcha_gpu::shader::Library;
use matcha_gpu::trace::{WideTree, structure};
use matcha_gpu::{GpuError, testing};
use matcha_import::{LoadOptions, load};
use matcha_render::accel::{Accel, Ray};
use matcha_render::scene::Scene;
use std::path::Path;

/// Of 100,000 rays, such that may pass an edge on the other side: the device's test of a triangle
/// is its own.
const GRAZING: usize = 5;

/// Surfaces that are nearer to each other are at one place, metres: which of them a ray meets, or
/// whether it begins before or behind them, is up to rounding.
const TIED: f32 = 2e-5;

/// False for rays that begin at another surface than the one that they leave, or meet two at once.
fn is_told(accel: &Accel, ray: &Ray) -> bool {
    let tied = TIED / ray.direction.length();
    if !tied.is_finite() {
        return true;
    }
    let mut back = *ray;
    back.origin -= tied * ray.direction;
    back.t_max += 2.0 * tied;
    let Some(first) = accel.closest(&back) else {
        return true;
    };
    let mut second = back;
    second.excluded = [first.instance, first.primitive];
    second.t_min = second.t_min.max(first.t - tied);
    let alone = accel
        .closest(&second)
        .is_none_or(|hit| hit.t > first.t + tied);
    alone
        && [ray.t_min, ray.t_max]
            .iter()
            .all(|end| (first.t - tied - end).abs() > tied)
}

/// A scene with its structures, and what their kernels are made of.
struct Case {
    scene: Scene,
    accel: Accel,
    rays: Vec<Ray>,
}

impl Case {
    fn new(scene: Scene, transparent: &[bool], extent: f32, seed: u64) -> Case {
        let mut accel = Accel::build(&scene).expect("a structure");
        accel.part_shadows(transparent);
        let mut rays = scenes::rays(&accel, extent, 100_000, seed);
        let all = rays.len();
        rays.retain(|ray| is_told(&accel, ray));
        assert!(rays.len() * 10 > 9 * all, "{} of {all} rays", rays.len());
        Case { scene, accel, rays }
    }

    /// Shared, mirrored, hidden and transparent instances, and one without thickness, whose
    /// transform has no inverse.
    fn objects() -> Case {
        let mut scene = scenes::scene(17, 700, 5);
        let flat = Mat3::from_diagonal(Vec3::new(2.0, 3.0, 0.0));
        scene.instances[5].transform = Affine3A::from_mat3_translation(flat, Vec3::Y);
        // Nothing that can be hit, between what can.
        let mesh = &mut scene.meshes[0];
        mesh.indices[3] = [9, 9, 10];
        mesh.positions[36] = Vec3::splat(f32::NAN);
        let transparent: Vec<bool> = (0..17).map(|i| i % 4 == 3).collect();
        Case::new(scene, &transparent, 5.0, 5)
    }

    fn tea_room() -> Case {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/tea_room.glb");
        let loaded = load(&path, &LoadOptions::default(), &mut |_| {}).expect("the example");
        let transparent = vec![false; loaded.scene.instances.len()];
        Case::new(loaded.scene, &transparent, 3.0, 6)
    }

    fn compare(&self, device: &Device, library: Library) -> Result<Difference, GpuError> {
        let mut sections = Sections::new();
        let structure = structure(device, &self.scene, &self.accel)?;
        sections.structure("trace_scene", structure);
        let tracer = Tracer::over(device, library, sections, &self.rays)?;
        comparison::compare(&tracer, &self.accel, &self.rays)
    }

    /// The same rays by our own walk on the same device.
    fn compare_walk(&self, device: &Device) -> Result<Difference, GpuError> {
        let tree = WideTree::new(&self.accel).expect("a hierarchy");
        let tracer = Tracer::new(device, &tree, &self.rays)?;
        comparison::compare(&tracer, &self.accel, &self.rays)
    }
}

fn library(device: &Device) -> Library {
    Library::in_dialect(device.dialect()).expect("it is validated")
}

fn agrees(difference: &Difference, rays: usize) -> bool {
    let allowed = rays.div_ceil(100_000) * GRAZING;
    difference.hits * 5 > rays
        && difference.other <= allowed
        && difference.shadows <= allowed
        && difference.largest < 1e-2
}

#[test]
fn ray_queries_find_what_the_processor_finds() {
    let Some(device) = testing::ray_query_device() else {
        return;
    };
    for (name, case) in [("objects", Case::objects()), ("tea room", Case::tea_room())] {
        let found = case.compare(&device, library(&device));
        let difference = found.unwrap_or_else(|error| panic!("{error}"));
        let walk = case.compare_walk(&device);
        let walk = walk.unwrap_or_else(|error| panic!("{error}"));
        println!("{name}, ray queries: {difference:?}\n{name}, our walk: {walk:?}");
        assert!(agrees(&walk, case.rays.len()), "{name}: {walk:?}");
        assert!(
            agrees(&difference, case.rays.len()),
            "{name}: {difference:?}"
        );
    }
}

#[test]
fn an_empty_scene_has_no_hits() {
    let Some(device) = testing::ray_query_device() else {
        return;
    };
    let scene = Scene::default();
    let accel = Accel::build(&scene).expect("a structure");
    let rays = vec![Ray::new(Vec3::ZERO, Vec3::X); 100];
    let case = Case { scene, accel, rays };
    let difference = case.compare(&device, library(&device));
    let difference = difference.unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((difference.other, difference.shadows), (0, 0));
}

/// The comparison must notice each thing that rays ask of a structure, left out.
#[test]
fn must_fail_what_rays_ask_is_noticed() {
    let Some(device) = testing::ray_query_device() else {
        return;
    };
    let case = Case::objects();
    for (item, old, new) in [
        ("trace_structure", "ray.mask", "0xffu"),
        (
            "trace_is_left",
            "instance == ray.excluded_instance",
            "false",
        ),
        ("trace_query", "trace_above(ray.t_min)", "0.0"),
        ("trace_query", "trace_below(ray.t_max)", "3.0e38"),
        (
            "trace_structure",
            "met.primitive_index,",
            "met.primitive_index + 1u,",
        ),
        (
            "trace_structure",
            "met.barycentrics.x,\n        met.barycentrics.y",
            "met.barycentrics.y,\n        met.barycentrics.x",
        ),
    ] {
        let mut library = library(&device);
        library.corrupt(item, old, new).expect("it is there");
        let difference = case.compare(&device, library);
        let difference = difference.unwrap_or_else(|error| panic!("{error}"));
        assert!(
            !agrees(&difference, case.rays.len()),
            "{item}, {new}: {difference:?}"
        );
    }
}
