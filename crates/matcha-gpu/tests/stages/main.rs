//! Every stage of a wave on the device and on the processor, from identical memory.

mod comparison;
mod scene;
#[path = "../../../matcha-render/tests/scenes/mod.rs"]
#[allow(dead_code)]
mod scenes;

use comparison::{Difference, compare};
use matcha_gpu::GpuError;
use matcha_gpu::backend::GpuOptions;
use matcha_gpu::device::Device;
use matcha_gpu::pipeline::Pipelines;
use matcha_gpu::shader::{Library, LinkError};
use matcha_gpu::testing;
use matcha_gpu::wavefront::{GpuFrom, StepRecord, Wavefront};
use matcha_import::{LoadOptions, load};
use matcha_render::backend::{CacheMode, RenderOptions};
use matcha_render::prepare::Prepared;
use std::path::Path;
use std::sync::Arc;

const RESOLUTION: [u32; 2] = [24, 14];

fn tea_room() -> Arc<Prepared> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/tea_room.glb");
    let loaded = load(&path, &LoadOptions::default(), &mut |_| {}).expect("the example");
    Arc::new(Prepared::new(loaded.scene, Some(RESOLUTION)).expect("it can be rendered"))
}

fn small_scene() -> Arc<Prepared> {
    Arc::new(Prepared::new(scene::scene(), Some(RESOLUTION)).expect("it can be rendered"))
}

/// Compares all steps of some bounces of a scene whose kernels have been changed.
fn each_step(
    device: &Device,
    prepared: &Arc<Prepared>,
    cache: CacheMode,
    change: impl FnOnce(&mut Library) -> Result<(), LinkError>,
    look: &mut dyn FnMut(&StepRecord),
) -> Result<(), GpuError> {
    let options = RenderOptions {
        cache,
        seed: Some(1),
        ..RenderOptions::default()
    };
    let gpu = GpuOptions {
        gpu_from: Some(GpuFrom::Nothing),
        ..GpuOptions::default()
    };
    let pipelines = Pipelines::new(device, None);
    let mut wavefront =
        Wavefront::with_library(device, &pipelines, prepared, &options, &gpu, change)?;
    let [width, height] = RESOLUTION;
    wavefront.compare_steps(width * height, 0..8, 3, look)
}

#[test]
fn probe() {
    let Some(device) = testing::device() else {
        return;
    };
    for prepared in [small_scene(), tea_room()] {
        let mut look = |record: &StepRecord| {
            let difference: Difference = compare(record);
            println!(
                "{:?}: {} changed, {} others, {:?} {:?}",
                record.steps,
                difference.changed.len(),
                difference.others.len(),
                difference.wrong,
                difference.fields
            );
        };
        let done = each_step(&device, &prepared, CacheMode::Off, |_| Ok(()), &mut look);
        done.unwrap_or_else(|error| panic!("{error}"));
    }
}
