//! A picture does not depend on whether queues are sorted.

use matcha_gpu::backend::{GpuOptions, MaterialStage};
use matcha_gpu::device::Device;
use matcha_gpu::pipeline::Pipelines;
use matcha_gpu::testing;
use matcha_gpu::wavefront::Wavefront;
use matcha_import::{LoadOptions, load};
use matcha_render::backend::{CacheMode, Control, RenderOptions};
use matcha_render::film::Film;
use matcha_render::prepare::Prepared;
use std::path::Path;
use std::sync::Arc;

const RESOLUTION: [u32; 2] = [32, 18];

fn prepared() -> Arc<Prepared> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/tea_room.glb");
    let loaded = load(&path, &LoadOptions::default(), &mut |_| {}).expect("the example");
    Arc::new(Prepared::new(loaded.scene, Some(RESOLUTION)).expect("it can be rendered"))
}

/// The picture's words.
fn picture(
    device: &Device,
    pipelines: &Pipelines,
    prepared: &Arc<Prepared>,
    cache: CacheMode,
    sorted: bool,
) -> Vec<u32> {
    let options = RenderOptions {
        cache,
        seed: Some(3),
        ..RenderOptions::default()
    };
    let gpu = GpuOptions {
        material_stage: MaterialStage::Split,
        sort_queues: Some(sorted),
        ..GpuOptions::default()
    };
    let wavefront = Wavefront::new(device, pipelines, prepared, &options, &gpu);
    let mut wavefront = wavefront.unwrap_or_else(|error| panic!("{error}"));
    let [width, height] = RESOLUTION;
    let mut film = Film::new(width, height, prepared.scene().settings.exposure);
    let rendered = wavefront.render(0..2, &Control::default(), &mut film);
    rendered.unwrap_or_else(|error| panic!("{error}"));
    let seconds = wavefront.statistics().stage_seconds;
    assert!(seconds.is_empty() || seconds.contains_key("sort") == sorted);
    let combined = film.combined();
    combined
        .iter()
        .flatten()
        .map(|part| part.to_bits())
        .collect()
}

#[test]
fn sorting_changes_no_picture() {
    let Some(device) = testing::device() else {
        return;
    };
    let prepared = prepared();
    let pipelines = Pipelines::new(&device, None);
    let small = CacheMode::Paper {
        cells: Some(1 << 16),
        entries: Some(8),
        level_offset: 0.0,
    };
    for cache in [CacheMode::Off, small] {
        let [plain, sorted] =
            [false, true].map(|sorted| picture(&device, &pipelines, &prepared, cache, sorted));
        assert!(plain.iter().any(|&word| word != 0), "it is not black");
        let differing = plain.iter().zip(&sorted).filter(|(a, b)| a != b).count();
        assert_eq!(differing, 0, "{cache:?}");
    }
}
