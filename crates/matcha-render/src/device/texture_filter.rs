//! Filtering of images: which level, which texels, which weights.
//!
//! Texel (i, j) of a level covers [i, i+1) × [j, j+1) in units of texels with v up, so its centre
//! is at i + 1/2, as in Cycles and OpenImageIO.
// Device code has no methods.
#![allow(clippy::manual_range_contains)]

use glam::Vec2;
use matcha_shade::device::math::{
    MAX, abs, bits_of, clamp, dot2, float_of, floor, min, to_int, vec2,
};

/// Outside of an image: it is repeated.
pub const TEXTURE_REPEAT: u32 = 0;
/// Outside: the border's texel.
pub const TEXTURE_EXTEND: u32 = 1;
/// Outside: transparent black.
pub const TEXTURE_CLIP: u32 = 2;
/// Outside: repeated, every other time mirrored.
pub const TEXTURE_MIRROR: u32 = 3;

/// The nearest texel.
pub const TEXTURE_CLOSEST: u32 = 0;
/// Bilinear.
pub const TEXTURE_LINEAR: u32 = 1;
/// Cubic B-spline on the finest level, bilinear on the others.
pub const TEXTURE_CUBIC: u32 = 2;

/// Result of [`texture_texel`] for a texel that is outside of a clipped image.
pub const TEXTURE_OUTSIDE: i32 = -1;

/// The level to read, and how much of the next coarser one is mixed in.
#[derive(Clone, Copy, Debug)]
pub struct TextureLevels {
    /// Number of the finer level.
    pub finer: u32,
    /// Weight of level `finer` + 1; 0 where it is not read.
    pub fraction: f32,
}

/// First of a filter's texels along one axis, and where between it and the next one the
/// coordinate is.
#[derive(Clone, Copy, Debug)]
pub struct TextureTap {
    /// Texel; may be outside of the image.
    pub first: i32,
    /// 0 to 1.
    pub fraction: f32,
}

/// log₂ with an error below 0.01 of a level: exponent and a parabola through the mantissa.
#[inline(always)]
pub fn texture_log2(x: f32) -> f32 {
    let bits = bits_of(x);
    let exponent = ((bits >> 23) as i32 - 127) as f32;
    let m = float_of((bits & 0x007f_ffff) | 0x3f80_0000) - 1.0;
    exponent + m + m * (1.0 - m) * (0.346_6 - 0.031 * (2.0 * m - 1.0))
}

/// Level for a footprint with these half axes in texture coordinates: that of which a texel is
/// as large as the SHORTER one, so that nothing is blurred beyond the footprint; what the long
/// one would need more is left to the samples of a pixel. 0 where an axis is zero or no number.
/// `size` is that of the finest level, `last` the number of the coarsest.
#[inline(always)]
pub fn texture_level(a: Vec2, b: Vec2, size: Vec2, last: u32) -> f32 {
    let scaled_a = vec2(a.x * size.x, a.y * size.y);
    let scaled_b = vec2(b.x * size.x, b.y * size.y);
    let squared_a = dot2(scaled_a, scaled_a);
    let squared_b = dot2(scaled_b, scaled_b);
    let least = min(squared_a, squared_b);
    // False where one of them is no number.
    if squared_a + squared_b >= least && least > 1.0 {
        min(0.5 * texture_log2(least), last as f32)
    } else {
        0.0
    }
}

/// The two levels around a fractional one.
#[inline(always)]
pub fn texture_levels(level: f32, last: u32) -> TextureLevels {
    let whole = to_int(level) as u32;
    if whole >= last {
        TextureLevels {
            finer: last,
            fraction: 0.0,
        }
    } else {
        TextureLevels {
            finer: whole,
            fraction: level - whole as f32,
        }
    }
}

/// Whether both coordinates are numbers and finite.
#[inline(always)]
pub fn texture_is_place(uv: Vec2) -> bool {
    abs(uv.x) <= MAX && abs(uv.y) <= MAX
}

/// A coordinate without the whole repetitions before it: the product with an image's size stays
/// small and exact.
#[inline(always)]
pub fn texture_unrepeated(coordinate: f32, wrap: u32) -> f32 {
    if wrap == TEXTURE_REPEAT {
        coordinate - floor(coordinate)
    } else if wrap == TEXTURE_MIRROR {
        coordinate - 2.0 * floor(0.5 * coordinate)
    } else {
        coordinate
    }
}

/// Where, in texels, a filter that reaches `back` texels back from an unrepeated coordinate
/// begins; so limited that it is exact as a whole number.
#[inline(always)]
pub fn texture_begin(unrepeated: f32, size: u32, back: f32) -> f32 {
    clamp(unrepeated * size as f32 - back, -1e8, 1e8)
}

/// A filter's first texel, and the fraction between it and the next.
#[inline(always)]
pub fn texture_tap(unrepeated: f32, size: u32, back: f32) -> TextureTap {
    let at = texture_begin(unrepeated, size, back);
    let below = floor(at);
    TextureTap {
        first: to_int(below),
        fraction: at - below,
    }
}

/// Into 0..size; without a division where at most one period is off.
#[inline(always)]
pub fn texture_wrapped(i: i32, size: i32) -> i32 {
    let mut at = i;
    if at < 0 {
        at += size;
    }
    if at >= size {
        at -= size;
    }
    if at < 0 || at >= size {
        at = i % size;
        if at < 0 {
            at += size;
        }
    }
    at
}

/// Into 0..size, running back and forth.
#[inline(always)]
pub fn texture_mirrored(i: i32, size: i32) -> i32 {
    let at = texture_wrapped(i, 2 * size);
    if at < size { at } else { 2 * size - 1 - at }
}

/// Into 0..size: the nearest.
#[inline(always)]
pub fn texture_extended(i: i32, size: i32) -> i32 {
    let mut at = i;
    if at > size - 1 {
        at = size - 1;
    }
    if at < 0 {
        at = 0;
    }
    at
}

/// The texel that is read for texel `i` of the unbounded plane; [`TEXTURE_OUTSIDE`] where
/// nothing is.
#[inline(always)]
pub fn texture_texel(i: i32, size: i32, wrap: u32) -> i32 {
    if wrap == TEXTURE_REPEAT {
        return texture_wrapped(i, size);
    }
    if wrap == TEXTURE_MIRROR {
        return texture_mirrored(i, size);
    }
    let at = texture_extended(i, size);
    if wrap == TEXTURE_CLIP && at != i {
        TEXTURE_OUTSIDE
    } else {
        at
    }
}

/// Weights of the cubic B-spline at a fraction between the two middle texels of four.
#[inline(always)]
pub fn texture_b_spline(t: f32) -> [f32; 4] {
    let s = 1.0 - t;
    let sixth = 1.0 / 6.0;
    [
        sixth * s * s * s,
        sixth * (4.0 + t * t * (3.0 * t - 6.0)),
        sixth * (4.0 + s * s * (3.0 * s - 6.0)),
        sixth * t * t * t,
    ]
}
