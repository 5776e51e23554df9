//! Pictures of which the processor makes the first stages.

#[path = "../pictures/comparison.rs"]
mod pictures;

use crate::{RESOLUTION, pipelines, render_options, small_scene};
use matcha_gpu::adapter::Kind;
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

/// Pixels that may have a path which goes elsewhere: none on drivers that round as the processor
/// does, because they compute on it.
fn other_paths(device: &Device) -> usize {
    let all = (RESOLUTION[0] * RESOLUTION[1]) as usize;
    if device.report().kind == Kind::Software {
        0
    } else {
        all / 100
    }
}

fn processors_picture() -> Vec<[f32; 4]> {
    let backend = CpuBackend::new(small_scene(), &render_options(CacheMode::Off));
    let mut backend = backend.unwrap_or_else(|error| panic!("{error}"));
    let rendered = backend.render(0..SAMPLES, &Control::default());
    rendered.unwrap_or_else(|error| panic!("{error}"));
    backend.film().combined()
}

#[test]
fn who_takes_which_stage_makes_no_difference() {
    let Some(device) = testing::device() else {
        return;
    };
    let expected = processors_picture();
    let whole = picture(&device, None);
    assert_eq!(difference(&whole, &expected, other_paths(&device)), None);
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
        let found = difference(&divided, &expected, other_paths(&device));
        assert_eq!(found, None, "{from:?}");
        if from == GpuFrom::Stage(Stage::Regenerate) {
            assert!(divided == whole, "one step at a time");
        }
    }
}

/// Where every path is the same, a pixel that is a little too bright.
#[test]
fn must_fail_a_corrupted_pixel_is_noticed() {
    let expected = processors_picture();
    let lit = (0..expected.len()).filter(|&pixel| expected[pixel][0] > 0.05);
    let lit: Vec<usize> = lit.collect();
    assert!(lit.len() > expected.len() / 2, "there is something to see");
    for pixel in [lit[0], lit[lit.len() / 2], lit[lit.len() - 1]] {
        let mut picture = expected.clone();
        picture[pixel][0] *= 1.03;
        assert!(
            difference(&picture, &expected, 0).is_some(),
            "pixel {pixel}"
        );
    }
}
