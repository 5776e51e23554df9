//! Rays per second against Embree 3, and nanoseconds per texture sample.
//!
//! Rates are the median over slices of two thousand rays, so that a busy machine's interruptions
//! fall out; hits are counted and printed: both sides must find the same number, but for a few
//! rays that graze an edge.

mod embree;
mod scenes;
mod texture;

use embree::Embree;
use matcha_render::accel::{Accel, BuildOptions, Ray};
use matcha_render::scene::Scene;
use std::path::Path;
use std::time::Instant;

const RAYS: usize = 500_000;
const SLICE: usize = 2_000;

fn main() {
    let mut names: Vec<String> = std::env::args().skip(1).collect();
    if names.is_empty() {
        names = ["texture", "spheres", "soup"].map(String::from).to_vec();
    }
    for name in names {
        match name.as_str() {
            "texture" => texture::measure(),
            "spheres" => compare(&name, &scenes::spheres(), false),
            "soup" => compare(&name, &scenes::soup(), false),
            file => match matcha_import::load(Path::new(file), &Default::default(), &mut |_| ()) {
                Ok(imported) => compare(&imported.scene.name.clone(), &imported.scene, true),
                Err(error) => eprintln!("{error}"),
            },
        }
    }
}

fn compare(name: &str, scene: &Scene, from_camera: bool) {
    let triangles: usize = scene.meshes.iter().map(|m| m.indices.len()).sum();
    println!(
        "{name}: {triangles} triangles, {} instances",
        scene.instances.len()
    );
    let shared = scene.instances.len() > scene.meshes.len();
    let Ok(accel) = Accel::build(scene) else {
        return eprintln!("cannot be built");
    };
    let rays = scenes::rays(&accel, scene, from_camera, RAYS);
    for flat in if shared {
        vec![true, false]
    } else {
        vec![true]
    } {
        let options = BuildOptions::default();
        let flat_triangles = if flat {
            options.flat_triangles
        } else {
            Some(0)
        };
        let start = Instant::now();
        let Ok(accel) = Accel::build_with(
            scene,
            &BuildOptions {
                flat_triangles,
                ..options
            },
        ) else {
            continue;
        };
        let built = start.elapsed().as_secs_f64();
        let what = format!(
            "ours {}, {built:.2} s, {} MB",
            if flat {
                "as built by default"
            } else {
                level(flat)
            },
            accel.bytes() / 1_000_000
        );
        report(&what, &rays, &|r| accel.closest(r).is_some(), &|r| {
            accel.occluded(r)
        });
        for robust in [true, false] {
            let embree = Embree::build(scene, flat, robust);
            let what = format!(
                "Embree {} {}",
                level(flat),
                if robust { "robust" } else { "fast" }
            );
            report(&what, &rays, &|r| embree.closest(r), &|r| {
                embree.occluded(r)
            });
        }
    }
}

fn level(flat: bool) -> &'static str {
    if flat { "one level" } else { "two levels" }
}

type Query<'a> = &'a (dyn Fn(&Ray) -> bool + Sync);

fn report(what: &str, [bounces, shadows]: &[Vec<Ray>; 2], closest: Query, occluded: Query) {
    for threads in [1, 2] {
        let (near, hits) = rate(bounces, threads, closest);
        let (any, blocked) = rate(shadows, threads, occluded);
        println!(
            "  {what}, {threads} thread(s): closest {near:.2} M/s ({hits}), any {any:.2} M/s ({blocked})"
        );
    }
}

/// Million rays a second, summed over threads, and the number of hits.
fn rate(rays: &[Ray], threads: usize, query: Query) -> (f64, usize) {
    let part = rays.len().div_ceil(threads).max(1);
    std::thread::scope(|scope| {
        let workers: Vec<_> = rays
            .chunks(part)
            .map(|rays| scope.spawn(move || median_rate(rays, query)))
            .collect();
        let results = workers.into_iter().filter_map(|worker| worker.join().ok());
        results.fold((0.0, 0), |sum, result| (sum.0 + result.0, sum.1 + result.1))
    })
}

fn median_rate(rays: &[Ray], query: Query) -> (f64, usize) {
    let mut hits = 0;
    let mut rates: Vec<f64> = rays
        .chunks(SLICE)
        .map(|slice| {
            let start = Instant::now();
            hits += slice.iter().filter(|ray| query(ray)).count();
            slice.len() as f64 / start.elapsed().as_secs_f64() / 1e6
        })
        .collect();
    rates.sort_by(f64::total_cmp);
    (rates.get(rates.len() / 2).copied().unwrap_or(0.0), hits)
}
