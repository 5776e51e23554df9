//! Nanoseconds per texture sample.

use crate::scenes::Random;
use matcha_render::scene::{AlphaMode, ColorSpace, Image, Pixels};
use matcha_render::texture::TextureSet;
use matcha_shade::graph::{AlphaHandling, Interpolation, TextureRef};
use matcha_shade::source::Extension;
use matcha_shade::vm::Textures;
use std::sync::Arc;
use std::time::Instant;

const SIZE: u32 = 2048;
const GROUP: usize = 512;

/// Samples a noise picture of 2048² pixels in groups, coherently and at random.
pub fn measure() {
    let mut random = Random(1);
    let bytes: Vec<[u8; 4]> = (0..SIZE * SIZE)
        .map(|_| {
            let bits = (random.unit() * 16_777_216.0) as u32;
            [bits as u8, (bits >> 8) as u8, (bits >> 16) as u8, 255]
        })
        .collect();
    let floats: Vec<[f32; 4]> = bytes
        .iter()
        .map(|p| p.map(|c| f32::from(c) / 255.0))
        .collect();
    let kinds = [
        ("bytes", Pixels::Rgba8(Arc::new(bytes))),
        ("floats", Pixels::RgbaF32(Arc::new(floats))),
    ];
    for (name, pixels) in kinds {
        let image = Image {
            name: name.into(),
            width: SIZE,
            height: SIZE,
            pixels,
            color_space: if name == "bytes" {
                ColorSpace::Srgb
            } else {
                ColorSpace::LinearRec709
            },
            alpha: AlphaMode::Straight,
        };
        for interpolation in [Interpolation::Linear, Interpolation::Cubic] {
            let texture = TextureRef {
                image: 0,
                interpolation,
                extension: Extension::Repeat,
                alpha: AlphaHandling::Associated,
                no_footprint: false,
            };
            let start = Instant::now();
            let set = TextureSet::build(std::slice::from_ref(&image), [&texture]);
            println!(
                "{name} {interpolation:?}: built in {:.0} ms, {:.1} MB beside the scene's",
                start.elapsed().as_secs_f64() * 1e3,
                set.bytes() as f64 / 1e6
            );
            for (what, spread, texels) in [
                ("coherent, magnified", 0.02, 0.0),
                ("random, magnified", 1.0, 0.0),
                ("random, level 2.5", 1.0, 5.6),
                ("random, level 6.5", 1.0, 90.0),
            ] {
                let ns = nanoseconds(&set, texture, spread, texels / SIZE as f32, &mut random);
                println!("  {what}: {ns:.1} ns");
            }
        }
    }
}

fn nanoseconds(
    set: &TextureSet,
    texture: TextureRef,
    spread: f32,
    footprint: f32,
    random: &mut Random,
) -> f64 {
    let along = vec![footprint; GROUP];
    let across = vec![0.0; GROUP];
    let mut out: [Vec<f32>; 4] = std::array::from_fn(|_| vec![0.0; GROUP]);
    let mut times: Vec<f64> = (0..400)
        .map(|_| {
            let base = random.unit();
            let [u, v]: [Vec<f32>; 2] = std::array::from_fn(|_| {
                (0..GROUP).map(|_| base + spread * random.unit()).collect()
            });
            let [r, g, b, a] = &mut out;
            let start = Instant::now();
            set.sample(
                texture,
                GROUP,
                [&u, &v],
                [&along, &across],
                [&across, &along],
                [r, g, b, a],
            );
            start.elapsed().as_secs_f64() * 1e9 / GROUP as f64
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
