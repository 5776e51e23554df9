//! Virtual texels: which square of a UV set's unbounded plane a footprint falls into
//! (Fujieda and Harada 2022, section 3.2). Exact: no rounding but the floor itself.

use crate::device::math::{bits_of, clamp, dot2, float_of, floor, min, to_int, vec2};
use glam::Vec2;

/// λ = floor(−log2(min(|a|, |b|))) of the footprint's half axes a and b in UV, with
/// `scale_squared` = 4^−offset multiplied to the squared lengths first, which adds the
/// offset to λ. Between −30 and 30; a footprint without size gives 30.
#[inline(always)]
pub fn texel_level(a: Vec2, b: Vec2, scale_squared: f32) -> i32 {
    let squared = clamp(
        min(dot2(a, a), dot2(b, b)) * scale_squared,
        8.673617e-19,
        1.1529215e18,
    );
    let bits = bits_of(squared);
    let exponent = (bits >> 23) as i32 - 127;
    let is_power = (bits & 0x007f_ffff) == 0;
    // −floor(−y/2) with y the logarithm: half of the exponent, rounded up unless exact.
    let rounds_up = (exponent & 1) != 0 || !is_power;
    -((exponent >> 1) + rounds_up as i32)
}

/// A texel's edge, 2^−level, for levels of [`texel_level`].
#[inline(always)]
pub fn texel_size(level: i32) -> f32 {
    float_of(((127 - level) << 23) as u32)
}

/// The length of a footprint's axes that texels of a level of [`texel_level`] stand for: of
/// those that ask for it, from half an edge to an edge and evenly so in octaves, the middle.
#[inline(always)]
pub fn texel_footprint(level: i32) -> f32 {
    texel_size(level) * 0.707_106_77
}

/// Index along one direction: floor(x · 2^level), within ±2^30.
#[inline(always)]
pub fn texel_index(x: f32, level: i32) -> i32 {
    to_int(floor(x * texel_size(-level)))
}

/// The middle of a texel.
#[inline(always)]
pub fn texel_centre(i: i32, j: i32, level: i32) -> Vec2 {
    let size = texel_size(level);
    vec2((i as f32 + 0.5) * size, (j as f32 + 0.5) * size)
}
