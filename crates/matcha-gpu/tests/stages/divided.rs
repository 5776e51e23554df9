//! Pictures of which the processor makes the first stages.

#[path = "../pictures/comparison.rs"]
mod pictures;

use crate::{RESOLUTION, pipelines, render_options, small_scene};
use matcha_gpu::backend::GpuOptions;
use matcha_gpu::device::Device;
use matcha_gpu::testing;
use matcha_gpu::wavefront::{GpuFrom, Stage, Wavefront};
use matcha_render::backend::{Backend, CacheMode, Control};
use matcha_render::cpu::CpuBackend;
use matcha_render::film::Film;
use pictures::difference;

const SAMPLES: u32 = 8;

fn picture(device: &Device, gpu_from: Option<GpuFrom>) -> Vec<[f32; 4]> {
    let prepared = small_scene();
    let options = render_options(CacheMode::Off);
    let gpu = GpuOptions {
        gpu_from,
        ..GpuOptions::default()
    };
    let wavefront = Wavefront::new(device, pipelines(device), &prepared, &options, &gpu);
    let mut wavefront = wavefront.unwrap_or_else(|error| panic!("{error}"));
    let [width, height] = RESOLUTION;
    let mut film = Film::new(width, height, prepared.scene().settings.exposure);
    let rendered = wavefront.render(0..SAMPLES, &Control::default(), &mut film);
    rendered.unwrap_or_else(|error| panic!("{error}"));
    film.combined()
}

#[test]
fn who_takes_which_stage_makes_no_difference() {
    let Some(device) = testing::device() else {
        return;
    };
    let backend = CpuBackend::new(small_scene(), &render_options(CacheMode::Off));
    let mut backend = backend.unwrap_or_else(|error| panic!("{error}"));
    let rendered = backend.render(0..SAMPLES, &Control::default());
    rendered.unwrap_or_else(|error| panic!("{error}"));
    let expected = backend.film().combined();
    let whole = picture(&device, None);
    assert_eq!(difference(&whole, &expected, 50), None);
    let from = [
        GpuFrom::Stage(Stage::Regenerate),
        GpuFrom::Stage(Stage::Traverse),
        GpuFrom::Stage(Stage::Lights),
        GpuFrom::Stage(Stage::Evaluate),
        GpuFrom::Stage(Stage::Shade),
        GpuFrom::Stage(Stage::Shadow),
        GpuFrom::Stage(Stage::Accumulate),
        GpuFrom::Nothing,
    ];
    for from in from {
        let divided = picture(&device, Some(from));
        assert_eq!(difference(&divided, &expected, 50), None, "{from:?}");
        if from == GpuFrom::Stage(Stage::Regenerate) {
            assert!(divided == whole, "one step at a time");
        }
    }
}
