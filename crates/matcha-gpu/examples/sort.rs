//! What sorting queues by what is to be evaluated costs and brings: device seconds of the stages,
//! as a Markdown table.
//!
//!     cargo run --release -p matcha-gpu --example sort -- SCENE [WIDTH HEIGHT SAMPLES]

use matcha_gpu::backend::GpuOptions;
use matcha_gpu::device::Device;
use matcha_gpu::pipeline::Pipelines;
use matcha_gpu::wavefront::Wavefront;
use matcha_gpu::{GpuError, testing};
use matcha_import::{LoadOptions, load};
use matcha_render::backend::{CacheMode, Control, RenderOptions};
use matcha_render::film::Film;
use matcha_render::prepare::Prepared;
use std::path::Path;
use std::sync::Arc;

const STAGES: [&str; 5] = ["sort", "lookup", "misses", "evaluate", "shade"];

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |k: usize, otherwise| {
        let given = arguments.get(k).and_then(|a| a.parse().ok());
        given.unwrap_or(otherwise)
    };
    let scene = arguments.first().expect("the path of a scene");
    let loaded = load(Path::new(scene), &LoadOptions::default(), &mut |_| {}).expect("a scene");
    let resolution = [number(1, 240), number(2, 135)];
    let prepared = Prepared::new(loaded.scene, Some(resolution)).expect("a scene");
    let Some(device) = testing::device() else {
        return;
    };
    println!("{}\n", device.report().name);
    println!("| cache | sorted | {} | all, wall |", STAGES.join(" | "));
    println!("|---|---|{}---|", "---|".repeat(STAGES.len()));
    if let Err(error) = report(&device, &Arc::new(prepared), number(3, 4)) {
        eprintln!("{error}");
    }
}

fn report(device: &Device, prepared: &Arc<Prepared>, samples: u32) -> Result<(), GpuError> {
    let pipelines = Pipelines::new(device, None);
    let paper = CacheMode::Paper {
        cells: Some(1 << 20),
        entries: Some(8),
        level_offset: 0.0,
    };
    for (name, cache) in [("off", CacheMode::Off), ("on", paper)] {
        for sorted in [false, true] {
            let options = RenderOptions {
                cache,
                seed: Some(0),
                ..RenderOptions::default()
            };
            let gpu = GpuOptions {
                sort_queues: Some(sorted),
                ..GpuOptions::default()
            };
            let mut wavefront = Wavefront::new(device, &pipelines, prepared, &options, &gpu)?;
            let [width, height] = prepared.resolution();
            let mut film = Film::new(width, height, prepared.scene().settings.exposure);
            let start = std::time::Instant::now();
            wavefront.render(0..samples, &Control::default(), &mut film)?;
            let seconds = wavefront.statistics().stage_seconds;
            let stages = STAGES.map(|stage| {
                let seconds = seconds.get(stage).copied().unwrap_or(0.0);
                format!("{seconds:.3}")
            });
            let wall = start.elapsed().as_secs_f64();
            let sorted = if sorted { "yes" } else { "no" };
            println!("| {name} | {sorted} | {} | {wall:.2} |", stages.join(" | "));
        }
    }
    Ok(())
}
