//! Rays of a scene on the device and on the processor: do they agree, and how many a second?
//!
//!     cargo run --release -p matcha-gpu --example trace -- SCENE [RAYS]

#[path = "../tests/trace/comparison.rs"]
mod comparison;

use comparison::Tracer;
use glam::{Vec3, vec3};
use matcha_gpu::device::Device;
use matcha_gpu::trace::WideTree;
use matcha_gpu::{GpuError, testing};
use matcha_import::{LoadOptions, load};
use matcha_render::accel::{Accel, Ray};
use matcha_render::scene::Scene;
use std::path::Path;
use std::time::Instant;

/// Numbers that look random (PCG's multiplier).
struct Random(u64);

impl Random {
    fn number(&mut self) -> f32 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 40) as f32 / (1u64 << 24) as f32
    }

    fn direction(&mut self) -> Vec3 {
        loop {
            let v = vec3(self.number(), self.number(), self.number()) * 2.0 - 1.0;
            if (0.01..1.0).contains(&v.length_squared()) {
                return v.normalize();
            }
        }
    }
}

/// A quarter of the rays through the picture, in its order; the others go on from where those
/// end, in any direction.
fn rays(scene: &Scene, accel: &Accel, count: usize) -> Vec<Ray> {
    let mut random = Random(1);
    let side = ((count / 4) as f32).sqrt() as usize;
    let through = |i: usize| {
        let (x, y) = (
            (i % side) as f32 / side as f32,
            (i / side) as f32 / side as f32,
        );
        let camera = scene.camera.transform;
        let direction = vec3(0.8 * (x - 0.5), 0.8 * (y - 0.5), -1.0);
        Ray::new(
            camera.translation.into(),
            camera.transform_vector3(direction),
        )
    };
    let mut rays: Vec<Ray> = (0..side * side).map(through).collect();
    let mut next = 0;
    while rays.len() < count && next < rays.len() {
        if let Some(hit) = accel.closest(&rays[next]) {
            let from = rays[next];
            let mut ray = Ray::new(from.origin + from.direction * hit.t, random.direction());
            ray.excluded = [hit.instance, hit.primitive];
            rays.push(ray);
        }
        next += 1;
    }
    rays
}

fn main() {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().expect("the scene is the first argument");
    let count = arguments
        .next()
        .map_or(1 << 20, |n| n.parse().expect("a number of rays"));
    let scene = load(Path::new(&path), &LoadOptions::default(), &mut |_| {})
        .expect("the scene loads")
        .scene;
    let mut accel = Accel::build(&scene).expect("a structure");
    let start = Instant::now();
    let tree = WideTree::new(&accel).expect("a hierarchy");
    println!(
        "{} nodes and {} triangles: {} MiB (processor's {} MiB), {} levels, made in {:.2} s",
        tree.nodes.len(),
        tree.triangles.len(),
        tree.bytes() >> 20,
        accel.bytes() >> 20,
        tree.levels,
        start.elapsed().as_secs_f32()
    );
    let rays = rays(&scene, &accel, count);
    let Some(device) = testing::device() else {
        return;
    };
    if let Err(error) = report(&device, &mut accel, &tree, &rays) {
        eprintln!("{error}");
    }
}

fn report(
    device: &Device,
    accel: &mut Accel,
    tree: &WideTree,
    rays: &[Ray],
) -> Result<(), GpuError> {
    let tracer = Tracer::new(device, tree, rays)?;
    for portable in [false, true] {
        if portable {
            accel.use_portable_kernel();
        }
        let start = Instant::now();
        for ray in rays {
            std::hint::black_box(accel.closest(ray));
        }
        let rate = rays.len() as f64 / start.elapsed().as_secs_f64();
        let difference = comparison::compare(&tracer, accel, rays)?;
        println!(
            "portable {portable}: {rate:.0} rays a second in one thread; {} rays, {difference:?}",
            rays.len()
        );
    }
    for entry in ["trace_closest_rays", "trace_occluded_rays"] {
        let (_, time) = tracer.trace(entry)?;
        let rate = rays.len() as f64 / time.as_secs_f64();
        println!("{entry}: {rate:.0} rays a second on the device");
    }
    Ok(())
}
