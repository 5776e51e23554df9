use super::*;
use crate::scene::Pixels;
use matcha_shade::graph::Interpolation;
use matcha_shade::source::Extension;
use proptest::prelude::*;
use std::sync::Arc;

fn image(width: u32, height: u32, pixel: impl Fn(u32, u32) -> [u8; 4]) -> Image {
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    Image {
        name: "test".into(),
        width,
        height,
        pixels: Pixels::Rgba8(Arc::new(pixels.map(|(x, y)| pixel(x, y)).collect())),
        color_space: ColorSpace::NonColor,
        alpha: AlphaMode::Straight,
    }
}

fn noise(x: u32, y: u32) -> [u8; 4] {
    let h = (x.wrapping_mul(73_856_093) ^ y.wrapping_mul(19_349_663)).wrapping_mul(2_654_435_761);
    h.to_le_bytes()
}

fn reference() -> TextureRef {
    TextureRef {
        image: 0,
        interpolation: Interpolation::Linear,
        extension: Extension::Repeat,
        alpha: AlphaHandling::Associated,
        no_footprint: false,
    }
}

fn look_up(image: &Image, texture: TextureRef, uv: [f32; 2], axes: [[f32; 2]; 2]) -> [f32; 4] {
    let set = TextureSet::build(std::slice::from_ref(image), [&texture]);
    sample_one(&set, texture, uv, axes)
}

fn sample_one(
    set: &TextureSet,
    texture: TextureRef,
    uv: [f32; 2],
    axes: [[f32; 2]; 2],
) -> [f32; 4] {
    let mut out = [[0.0]; 4];
    let rows = |v: [f32; 2]| v.map(|x| [x]);
    let (uv, a, b) = (rows(uv), rows(axes[0]), rows(axes[1]));
    let [r, g, bl, al] = &mut out;
    set.sample(
        texture,
        1,
        [&uv[0], &uv[1]],
        [&a[0], &a[1]],
        [&b[0], &b[1]],
        [&mut r[..], &mut g[..], &mut bl[..], &mut al[..]],
    );
    out.map(|c| c[0])
}

fn near(a: [f32; 4], b: [f32; 4], tolerance: f32) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= tolerance)
}

const POINT: [[f32; 2]; 2] = [[0.0; 2]; 2];

#[test]
fn centres_give_texels_with_v_up() {
    let image = image(5, 3, noise);
    for y in 0..3 {
        for x in 0..5 {
            let uv = [(x as f32 + 0.5) / 5.0, 1.0 - (y as f32 + 0.5) / 3.0];
            let expected = noise(x, y).map(|c| f32::from(c) / 255.0);
            for interpolation in [Interpolation::Linear, Interpolation::Closest] {
                let found = look_up(
                    &image,
                    TextureRef {
                        interpolation,
                        ..reference()
                    },
                    uv,
                    POINT,
                );
                assert!(near(found, expected, 2e-5), "{found:?} {expected:?}");
            }
        }
    }
}

#[test]
fn deep_images_are_filtered_and_multiplied_by_alpha_in_encoded_numbers_like_bytes() {
    let bytes = image(4, 1, |x, _| [if x == 0 { 255 } else { 51 }, 102, 204, 153]);
    let Pixels::Rgba8(texels) = &bytes.pixels else {
        unreachable!()
    };
    let floats = texels.iter().map(|t| t.map(|c| f32::from(c) / 255.0));
    let deep = Image {
        pixels: Pixels::RgbaF32(Arc::new(floats.collect())),
        color_space: ColorSpace::Srgb,
        ..bytes.clone()
    };
    let bytes = Image {
        color_space: ColorSpace::Srgb,
        ..bytes
    };
    for (u, axis) in [(0.25, 0.0), (0.1, 0.0), (0.3, 0.5), (0.5, 2.0)] {
        let [a, b] = [&bytes, &deep]
            .map(|image| look_up(image, reference(), [u, 0.5], [[axis, 0.0], [0.0, axis]]));
        assert!(near(a, b, 5e-3), "{a:?} {b:?} at {u}, {axis}");
    }
}

#[test]
fn linear_is_halfway_between_centres_and_wraps() {
    let image = image(4, 1, |x, _| [if x == 0 { 255 } else { 0 }; 4]);
    let at = |u: f32, extension| {
        look_up(
            &image,
            TextureRef {
                extension,
                ..reference()
            },
            [u, 0.5],
            POINT,
        )[0]
    };
    assert!((at(0.25, Extension::Repeat) - 0.5).abs() < 1e-5);
    for whole in [-3.0, 0.0, 7.0] {
        assert!((at(whole, Extension::Repeat) - 0.5).abs() < 1e-5, "seam");
    }
    assert!((at(0.0, Extension::Extend) - 1.0).abs() < 1e-5);
    assert!((at(-9.0, Extension::Extend) - 1.0).abs() < 1e-5);
    assert!((at(0.0, Extension::Clip) - 0.5).abs() < 1e-5);
    assert_eq!(at(-0.5, Extension::Clip), 0.0);
    assert_eq!(at(1e20, Extension::Clip), 0.0);
    assert!((at(-0.1, Extension::Mirror) - at(0.1, Extension::Mirror)).abs() < 1e-5);
    assert!((at(1.3, Extension::Mirror) - at(0.7, Extension::Mirror)).abs() < 1e-5);
}

#[test]
fn a_footprint_as_large_as_the_image_gives_its_mean() {
    for (width, height) in [(1, 1), (8, 8), (7, 5), (13, 1), (64, 3)] {
        let image = image(width, height, noise);
        let mut mean = [0.0f64; 4];
        for y in 0..height {
            for x in 0..width {
                for (mean, c) in mean.iter_mut().zip(noise(x, y)) {
                    *mean += f64::from(c) / 255.0 / f64::from(width * height);
                }
            }
        }
        let found = look_up(&image, reference(), [0.3, 0.9], [[99.0, 0.0], [0.0, 99.0]]);
        assert!(
            near(found, mean.map(|m| m as f32), 0.6 / 255.0),
            "{width}x{height} {found:?} {mean:?}"
        );
    }
}

#[test]
fn coarse_levels_average_light_not_numbers() {
    let mut image = image(2, 2, |x, y| {
        if (x + y) % 2 == 0 {
            [255; 4]
        } else {
            [0, 0, 0, 255]
        }
    });
    image.color_space = ColorSpace::Srgb;
    let found = look_up(&image, reference(), [0.5, 0.5], [[1.0, 0.0], [0.0, 1.0]]);
    assert!((found[0] - 0.5).abs() < 0.004, "{found:?}");
}

#[test]
fn magnified_srgb_is_decoded_after_filtering() {
    let mut image = image(2, 1, |x, _| [x as u8 * 255, 0, 0, 255]);
    image.color_space = ColorSpace::Srgb;
    let found = look_up(&image, reference(), [0.5, 0.5], POINT);
    assert!((found[0] - srgb::to_linear(0.5)).abs() < 1e-5);
}

#[test]
fn the_shorter_axis_picks_the_level() {
    let image = image(64, 64, |x, _| [if x % 2 == 0 { 255 } else { 0 }; 4]);
    let thin = look_up(
        &image,
        reference(),
        [0.5 / 64.0, 0.4],
        [[1.0, 0.0], [0.0, 0.5 / 64.0]],
    );
    assert!(thin[0] > 0.99, "{thin:?}");
    let round = look_up(
        &image,
        reference(),
        [0.5 / 64.0, 0.4],
        [[0.1, 0.0], [0.0, 0.1]],
    );
    assert!((round[0] - 0.5).abs() < 0.01, "{round:?}");
    let nonsense = look_up(
        &image,
        reference(),
        [0.5 / 64.0, 0.4],
        [[f32::NAN, 0.0], [0.0, 1.0]],
    );
    assert!(nonsense[0] > 0.99, "{nonsense:?}");
}

#[test]
fn alpha_is_treated_as_the_node_asks() {
    let mut image = image(1, 1, |_, _| [200, 100, 50, 128]);
    image.color_space = ColorSpace::LinearRec709;
    let alpha = 128.0 / 255.0;
    let with = |alpha| {
        look_up(
            &image,
            TextureRef {
                alpha,
                ..reference()
            },
            [0.5; 2],
            POINT,
        )
    };
    assert!(near(
        with(AlphaHandling::Associated),
        [
            200.0 / 255.0 * alpha,
            100.0 / 255.0 * alpha,
            50.0 / 255.0 * alpha,
            alpha
        ],
        0.003
    ));
    assert!(near(
        with(AlphaHandling::Unassociated),
        [200.0 / 255.0, 100.0 / 255.0, 50.0 / 255.0, alpha],
        0.005
    ));
    assert_eq!(with(AlphaHandling::Ignored)[3], 1.0);
    image.alpha = AlphaMode::ChannelPacked;
    let packed = look_up(
        &image,
        TextureRef {
            alpha: AlphaHandling::Unassociated,
            ..reference()
        },
        [0.5; 2],
        POINT,
    );
    assert!(near(
        packed,
        [200.0 / 255.0, 100.0 / 255.0, 50.0 / 255.0, alpha],
        1e-5
    ));
    image.alpha = AlphaMode::None;
    assert_eq!(look_up(&image, reference(), [0.5; 2], POINT)[3], 1.0);
}

#[test]
fn the_finest_level_is_shared_with_the_scene() {
    let image = image(64, 64, |x, y| {
        let [r, g, b, _] = noise(x, y);
        [r, g, b, 255]
    });
    let set = TextureSet::build(&[image], [&reference()]);
    let coarser = 64 * 64 * 4 / 3;
    assert!(set.bytes() <= coarser, "{}", set.bytes());
}

#[test]
fn missing_and_lying_images_are_pink() {
    let mut broken = image(4, 4, noise);
    broken.height = 9;
    assert_eq!(
        look_up(&broken, reference(), [0.5; 2], POINT),
        TEXTURE_MISSING
    );
    let far = TextureRef {
        image: 7,
        ..reference()
    };
    assert_eq!(look_up(&broken, far, [0.5; 2], POINT), TEXTURE_MISSING);
    let empty = image(0, 0, noise);
    assert_eq!(
        look_up(&empty, reference(), [0.5; 2], POINT),
        TEXTURE_MISSING
    );
}

#[test]
fn the_decoder_is_exact_enough() {
    let decoder = Decoder::new();
    for i in 0..=100_000 {
        let x = i as f32 / 50_000.0 - 0.1;
        assert!(
            (decoder.linear(x) - srgb::to_linear(x)).abs() < 2e-7 * (1.0 + x.max(0.0).powi(3)),
            "{x}"
        );
        assert!((srgb::to_encoded(srgb::to_linear(x)) - x.max(0.0)).abs() < 1e-5);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]
    /// Every filter is a weighted mean: a constant picture stays constant, and results stay
    /// between the least and the largest texel.
    #[test]
    fn filters_are_means(u in -20.0f32..20.0, v in -20.0f32..20.0, axis in 0.0f32..2.0, width in 1u32..20, height in 1u32..20) {
        let constant = image(width, height, |_, _| [51, 102, 153, 255]);
        let varied = image(width, height, |x, y| noise(x, y).map(|c| 64 + c / 2));
        for interpolation in [Interpolation::Closest, Interpolation::Linear, Interpolation::Cubic, Interpolation::Smart] {
            for extension in [Extension::Repeat, Extension::Extend, Extension::Mirror] {
                let texture = TextureRef { interpolation, extension, ..reference() };
                let axes = [[axis, 0.0], [0.0, axis]];
                let found = look_up(&constant, texture, [u, v], axes);
                prop_assert!(near(found, [0.2, 0.4, 0.6, 1.0], 1e-5), "{:?}", found);
                let found = look_up(&varied, texture, [u, v], axes);
                prop_assert!(found.iter().all(|&c| (64.0 / 255.0 - 1e-5..=191.0 / 255.0 + 1e-5).contains(&c)), "{:?}", found);
            }
        }
    }

    /// No coordinate, however wild, does harm.
    #[test]
    fn any_bits_are_survived(bits in prop::array::uniform6(any::<u32>())) {
        let image = image(6, 3, noise);
        let x = bits.map(f32::from_bits);
        for extension in [Extension::Repeat, Extension::Extend, Extension::Mirror, Extension::Clip] {
            for interpolation in [Interpolation::Closest, Interpolation::Linear, Interpolation::Cubic] {
                let found = look_up(&image, TextureRef { extension, interpolation, ..reference() }, [x[0], x[1]], [[x[2], x[3]], [x[4], x[5]]]);
                prop_assert!(found.iter().all(|c| (-0.001..=1.001).contains(c)), "{:?}", found);
            }
        }
    }
}
