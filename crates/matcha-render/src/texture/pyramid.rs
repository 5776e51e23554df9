//! Levels of an image, each half as large as the one before.

use super::srgb::{to_encoded, to_linear};
use crate::scene::{ColorSpace, Image, Pixels};
use std::sync::Arc;

/// Texels of a level, rows from the top.
#[derive(Clone, Debug)]
pub(crate) enum Texels {
    Bytes(Arc<Vec<[u8; 4]>>),
    Floats(Arc<Vec<[f32; 4]>>),
}

/// One resolution of an image.
#[derive(Clone, Debug)]
pub(crate) struct Level {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) texels: Texels,
    /// The texels are the scene's.
    shared: bool,
}

impl Level {
    pub(crate) fn is_bytes(&self) -> bool {
        matches!(self.texels, Texels::Bytes(_))
    }

    pub(super) fn own_bytes(&self) -> usize {
        match &self.texels {
            _ if self.shared => 0,
            Texels::Bytes(texels) => size_of_val(&texels[..]),
            Texels::Floats(texels) => size_of_val(&texels[..]),
        }
    }
}

/// All levels; none if the image has no pixels, or not as many as its size says.
pub(super) fn build_pyramid(image: &Image, associate: bool) -> Option<Vec<Level>> {
    let count = (image.width as usize).checked_mul(image.height as usize)?;
    let texels = match &image.pixels {
        Pixels::Rgba8(pixels) => Texels::Bytes(associated_bytes(pixels, associate)),
        Pixels::RgbaF32(pixels) => Texels::Floats(associated_floats(pixels, associate)),
    };
    let (length, shared) = match (&texels, &image.pixels) {
        (Texels::Bytes(own), Pixels::Rgba8(scene)) => (own.len(), Arc::ptr_eq(own, scene)),
        (Texels::Floats(own), Pixels::RgbaF32(scene)) => (own.len(), Arc::ptr_eq(own, scene)),
        _ => (0, false),
    };
    if count == 0 || length != count || image.width.max(image.height) > 1 << 24 {
        return None;
    }
    let encoded = image.color_space == ColorSpace::Srgb;
    let finest = Level {
        width: image.width,
        height: image.height,
        texels,
        shared,
    };
    Some(coarser_levels(finest, encoded))
}

/// Colour times alpha in the numbers that are stored, as Cycles does when it loads an image.
fn associated_bytes(pixels: &Arc<Vec<[u8; 4]>>, associate: bool) -> Arc<Vec<[u8; 4]>> {
    if !associate || pixels.iter().all(|p| p[3] == 255) {
        return pixels.clone();
    }
    let scale = |c: u8, a: u8| ((u32::from(c) * u32::from(a) + 127) / 255) as u8;
    let texels = pixels
        .iter()
        .map(|&[r, g, b, a]| [scale(r, a), scale(g, a), scale(b, a), a]);
    Arc::new(texels.collect())
}

fn associated_floats(pixels: &Arc<Vec<[f32; 4]>>, associate: bool) -> Arc<Vec<[f32; 4]>> {
    if !associate || pixels.iter().all(|p| p[3] == 1.0) {
        return pixels.clone();
    }
    let texels = pixels.iter().map(|&[r, g, b, a]| [r * a, g * a, b * a, a]);
    Arc::new(texels.collect())
}

/// A plane of four linear channels.
struct Plane {
    width: usize,
    height: usize,
    texels: Vec<[f32; 4]>,
}

fn coarser_levels(finest: Level, encoded: bool) -> Vec<Level> {
    let bytes = finest.is_bytes();
    let mut levels = vec![finest];
    if levels[0].width == 1 && levels[0].height == 1 {
        return levels;
    }
    let mut plane = halve_finest(&levels[0], encoded);
    loop {
        levels.push(store(&plane, bytes, encoded));
        if plane.width == 1 && plane.height == 1 {
            return levels;
        }
        plane = halve(plane.width, plane.height, |i, to| {
            to.copy_from_slice(&plane.texels[i..][..to.len()])
        });
    }
}

fn halve_finest(level: &Level, encoded: bool) -> Plane {
    let (width, height) = (level.width as usize, level.height as usize);
    let color: [f32; 256] = std::array::from_fn(|i| {
        let value = i as f32 / 255.0;
        if encoded { to_linear(value) } else { value }
    });
    match &level.texels {
        Texels::Bytes(texels) => halve(width, height, |first, to| {
            for (to, t) in to.iter_mut().zip(&texels[first..]) {
                let [r, g, b] = [t[0], t[1], t[2]].map(|c| color[c as usize]);
                *to = [r, g, b, f32::from(t[3]) / 255.0];
            }
        }),
        Texels::Floats(texels) => halve(width, height, |first, to| {
            to.copy_from_slice(&texels[first..][..to.len()]);
            if encoded {
                to.iter_mut().for_each(|t| *t = colors(*t, to_linear));
            }
        }),
    }
}

/// A texel with its colours changed.
fn colors([r, g, b, a]: [f32; 4], change: fn(f32) -> f32) -> [f32; 4] {
    [change(r), change(g), change(b), a]
}

/// Input texels under an output texel, with their weights: at most three where a size is odd.
#[derive(Clone, Copy)]
struct Taps {
    first: usize,
    weights: [f32; 4],
}

/// Exact areas: the mean over the image stays what it was.
fn taps(from: usize, to: usize) -> Vec<Taps> {
    let ratio = from as f64 / to as f64;
    (0..to)
        .map(|i| {
            let (low, high) = (i as f64 * ratio, (i + 1) as f64 * ratio);
            let first = low as usize;
            let weights = std::array::from_fn(|k| {
                let texel = (first + k) as f64;
                ((high.min(texel + 1.0) - low.max(texel)).max(0.0) / ratio) as f32
            });
            Taps { first, weights }
        })
        .collect()
}

/// Half the size; `row` copies linear texels from an index on.
fn halve(width: usize, height: usize, row: impl Fn(usize, &mut [[f32; 4]])) -> Plane {
    let (half_width, half_height) = ((width / 2).max(1), (height / 2).max(1));
    let (across, down) = (taps(width, half_width), taps(height, half_height));
    let mut texels = vec![[0.0f32; 4]; half_width * half_height];
    let mut line = vec![[0.0f32; 4]; width];
    for (target, down) in texels.chunks_exact_mut(half_width).zip(&down) {
        for (k, &vertical) in down.weights.iter().enumerate() {
            if vertical == 0.0 || down.first + k >= height {
                continue;
            }
            row((down.first + k) * width, &mut line);
            for (target, across) in target.iter_mut().zip(&across) {
                for (source, &weight) in line[across.first..].iter().zip(&across.weights) {
                    for c in 0..4 {
                        target[c] += source[c] * (weight * vertical);
                    }
                }
            }
        }
    }
    Plane {
        width: half_width,
        height: half_height,
        texels,
    }
}

fn store(plane: &Plane, bytes: bool, encoded: bool) -> Level {
    let texels = if bytes {
        let byte = |value: f32| (value * 255.0 + 0.5) as u8;
        let color = |value: f32| byte(if encoded { to_encoded(value) } else { value });
        let texel = |t: &[f32; 4]| [color(t[0]), color(t[1]), color(t[2]), byte(t[3])];
        Texels::Bytes(Arc::new(plane.texels.iter().map(texel).collect()))
    } else if encoded {
        let texels = plane.texels.iter().map(|t| colors(*t, to_encoded));
        Texels::Floats(Arc::new(texels.collect()))
    } else {
        Texels::Floats(Arc::new(plane.texels.clone()))
    };
    Level {
        width: plane.width as u32,
        height: plane.height as u32,
        texels,
        shared: false,
    }
}
