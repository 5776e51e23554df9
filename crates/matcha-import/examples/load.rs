//! Loads a scene and prints what came in: `cargo run --release -p matcha-import --example load SCENE`.

use matcha_import::{LoadOptions, Progress, load};
use matcha_render::scene::Pixels;
use std::path::Path;
use std::time::Instant;

fn main() {
    let Some(path) = std::env::args().nth(1) else {
        eprintln!("usage: load SCENE");
        std::process::exit(2);
    };
    let start = Instant::now();
    let mut said =
        |progress: Progress| eprintln!("{:7.2} s  {progress:?}", start.elapsed().as_secs_f64());
    let imported =
        load(Path::new(&path), &LoadOptions::default(), &mut said).unwrap_or_else(|error| {
            eprintln!("{error}");
            std::process::exit(2);
        });
    let scene = &imported.scene;
    let triangles = |mesh: u32| scene.meshes[mesh as usize].indices.len();
    let bytes = |pixels: &Pixels| match pixels {
        Pixels::Rgba8(p) => 4 * p.len(),
        Pixels::RgbaF32(p) => 16 * p.len(),
    };
    println!("{} in {:.2} s", scene.name, start.elapsed().as_secs_f64());
    println!(
        "  meshes     {:8}, triangles {}",
        scene.meshes.len(),
        (0..scene.meshes.len() as u32).map(triangles).sum::<usize>()
    );
    println!(
        "  instances  {:8}, triangles {}",
        scene.instances.len(),
        scene
            .instances
            .iter()
            .map(|i| triangles(i.mesh))
            .sum::<usize>()
    );
    println!(
        "  materials  {:8}, trees {}, nodes {}",
        scene.materials.len(),
        scene.trees.len(),
        scene.trees.iter().map(|t| t.nodes.len()).sum::<usize>()
    );
    println!(
        "  images     {:8}, {:.1} MB",
        scene.images.len(),
        scene.images.iter().map(|i| bytes(&i.pixels)).sum::<usize>() as f64 / 1e6
    );
    let with_tangents = scene
        .meshes
        .iter()
        .flat_map(|m| &m.uv_sets)
        .filter(|set| !set.tangents.is_empty())
        .count();
    let with_generated = scene
        .meshes
        .iter()
        .filter(|mesh| !mesh.generated.is_empty())
        .count();
    println!(
        "  UV names {:?}, attributes {:?}",
        scene.uv_names, scene.attribute_names
    );
    println!("  UV sets with tangents {with_tangents}, meshes with Generated {with_generated}");
    for light in &scene.lights {
        println!(
            "  light {} {:?} power {}",
            light.name, light.shape, light.power
        );
    }
    println!(
        "  {:?}\n  {:?}\n  {:?}",
        scene.world, scene.camera, scene.settings
    );
    println!("report:\n{}", imported.report);
}
