//! A node's value in 32 bits, by type. `…_fits` says whether the encoding holds a value
//! within its stated error; what does not fit (NaN, infinities, out of range, a colour
//! with a negative channel, a normal that is not unit) is never stored, but evaluated
//! each time. Every decoder returns finite numbers for every word but scalars, which
//! are stored as they are.

use super::intrinsics::{abs, bits_of, float_of, max, min, select, sqrt};
use glam::{Vec2, Vec3, vec2, vec3};

/// Largest magnitude that colours and vectors hold.
pub const LARGEST_ENCODED: f32 = 65536.0;

/// Largest magnitude that pairs hold.
pub const LARGEST_ENCODED_PAIR: f32 = 2147483648.0;

/// Smallest integer `e` with `x ≤ 2^e`; `x` positive and finite.
#[inline(always)]
pub fn exponent_above(x: f32) -> i32 {
    ((bits_of(x) - 1) >> 23) as i32 - 126
}

/// `2^e`, `e` from −126 to 127.
#[inline(always)]
pub fn power_of_two(e: i32) -> f32 {
    float_of(((e + 127) as u32) << 23)
}

/// The nearest integer of `x`, which is first brought into 0 to `top`; `top` below 2²².
/// Adding 2²³ leaves the integer, rounded, in the low bits.
#[inline(always)]
pub fn quantize(x: f32, top: f32) -> u32 {
    bits_of(min(max(x, 0.0), top) + 8388608.0) & 0x7FFFFF
}

/// Exponent shared by values up to `largest`, within 32 steps from −15 to 16.
#[inline(always)]
pub fn shared_exponent(largest: f32) -> i32 {
    exponent_above(min(max(largest, 3.0517578e-5), LARGEST_ENCODED))
}

/// True if [`encode_color`] holds the colour.
#[inline(always)]
pub fn color_fits(c: Vec3) -> bool {
    c.x >= 0.0
        && c.y >= 0.0
        && c.z >= 0.0
        && c.x <= LARGEST_ENCODED
        && c.y <= LARGEST_ENCODED
        && c.z <= LARGEST_ENCODED
}

/// Linear colour, 0 to 65,536: square roots in 9 bits each under a shared 5-bit
/// exponent. The root spends the steps where the eye and products of colours notice
/// them; black and a channel of a power of two that leads the others are exact.
///
/// With `m` the largest channel, at least 2⁻¹⁵, the error of a channel `c` is at most
/// `0.00277·√(c·m) + 2e-6·m`: 0.28 % of the largest channel, less in the others.
#[inline(always)]
pub fn encode_color(c: Vec3) -> u32 {
    let e = shared_exponent(max(max(c.x, c.y), c.z));
    let scale = power_of_two(-e);
    let r = quantize(sqrt(max(c.x, 0.0) * scale) * 511.0, 511.0);
    let g = quantize(sqrt(max(c.y, 0.0) * scale) * 511.0, 511.0);
    let b = quantize(sqrt(max(c.z, 0.0) * scale) * 511.0, 511.0);
    r | (g << 9) | (b << 18) | (((e + 15) as u32) << 27)
}

/// Inverse of [`encode_color`].
#[inline(always)]
pub fn decode_color(word: u32) -> Vec3 {
    let scale = power_of_two((word >> 27) as i32 - 15);
    let r = (word & 511) as i32 as f32 / 511.0;
    let g = ((word >> 9) & 511) as i32 as f32 / 511.0;
    let b = ((word >> 18) & 511) as i32 as f32 / 511.0;
    vec3(r * r * scale, g * g * scale, b * b * scale)
}

/// True if [`encode_scalar`] holds the number.
#[inline(always)]
pub fn scalar_fits(x: f32) -> bool {
    abs(x) <= 3.4028235e38
}

/// A number, exact.
#[inline(always)]
pub fn encode_scalar(x: f32) -> u32 {
    bits_of(x)
}

/// Inverse of [`encode_scalar`].
#[inline(always)]
pub fn decode_scalar(word: u32) -> f32 {
    float_of(word)
}

/// True if [`encode_vector`] holds the vector.
#[inline(always)]
pub fn vector_fits(v: Vec3) -> bool {
    abs(v.x) <= LARGEST_ENCODED && abs(v.y) <= LARGEST_ENCODED && abs(v.z) <= LARGEST_ENCODED
}

/// Sign and 8 bits of magnitude of `x / 2^e`.
#[inline(always)]
pub fn encode_signed_byte(x: f32, scale: f32) -> u32 {
    quantize(abs(x) * scale * 255.0, 255.0) | select(0u32, 256u32, x < 0.0)
}

/// Inverse of [`encode_signed_byte`], before scaling.
#[inline(always)]
pub fn decode_signed_byte(bits: u32) -> f32 {
    let magnitude = (bits & 255) as i32 as f32 / 255.0;
    select(magnitude, -magnitude, (bits & 256) != 0)
}

/// Vector of magnitude up to 65,536 with signs: sign and 8 bits each under a shared
/// 5-bit exponent. The error of a component is at most 0.4 % of the largest
/// component's magnitude, where that is at least 2⁻¹⁵ (below, at most 6e-8).
#[inline(always)]
pub fn encode_vector(v: Vec3) -> u32 {
    let e = shared_exponent(max(max(abs(v.x), abs(v.y)), abs(v.z)));
    let scale = power_of_two(-e);
    encode_signed_byte(v.x, scale)
        | (encode_signed_byte(v.y, scale) << 9)
        | (encode_signed_byte(v.z, scale) << 18)
        | (((e + 15) as u32) << 27)
}

/// Inverse of [`encode_vector`].
#[inline(always)]
pub fn decode_vector(word: u32) -> Vec3 {
    let scale = power_of_two((word >> 27) as i32 - 15);
    vec3(
        decode_signed_byte(word) * scale,
        decode_signed_byte(word >> 9) * scale,
        decode_signed_byte(word >> 18) * scale,
    )
}

/// True if [`encode_pair`] holds the pair.
#[inline(always)]
pub fn pair_fits(v: Vec2) -> bool {
    abs(v.x) <= LARGEST_ENCODED_PAIR && abs(v.y) <= LARGEST_ENCODED_PAIR
}

/// Sign and 12 bits of magnitude.
#[inline(always)]
pub fn encode_pair_component(x: f32, scale: f32) -> u32 {
    quantize(abs(x) * scale * 4095.0, 4095.0) | select(0u32, 4096u32, x < 0.0)
}

/// Inverse of [`encode_pair_component`], before scaling.
#[inline(always)]
pub fn decode_pair_component(bits: u32) -> f32 {
    let magnitude = (bits & 4095) as i32 as f32 / 4095.0;
    select(magnitude, -magnitude, (bits & 4096) != 0)
}

/// A gradient or a pair of coordinates: sign and 12 bits each under a shared 6-bit
/// exponent. A gradient's direction matters, so the two share what accuracy there is:
/// the error of a component is at most 0.00025 of the larger one, where that is at
/// least 2⁻³² (below, at most 3e-14).
#[inline(always)]
pub fn encode_pair(v: Vec2) -> u32 {
    let largest = max(abs(v.x), abs(v.y));
    let e = exponent_above(min(max(largest, 2.3283064e-10), LARGEST_ENCODED_PAIR));
    let scale = power_of_two(-e);
    encode_pair_component(v.x, scale)
        | (encode_pair_component(v.y, scale) << 13)
        | (((e + 32) as u32) << 26)
}

/// Inverse of [`encode_pair`].
#[inline(always)]
pub fn decode_pair(word: u32) -> Vec2 {
    let scale = power_of_two((word >> 26) as i32 - 32);
    vec2(
        decode_pair_component(word) * scale,
        decode_pair_component(word >> 13) * scale,
    )
}

/// True if [`encode_normal`] holds the vector: it is unit.
#[inline(always)]
pub fn normal_fits(n: Vec3) -> bool {
    abs(n.x * n.x + n.y * n.y + n.z * n.z - 1.0) <= 1e-3
}

/// Unit vector, folded onto an octahedron (Meyer et al. 2010; Cigolle et al. 2014,
/// section 3), 16 bits a side. The error is at most 0.00007 radians; the axes are exact.
#[inline(always)]
pub fn encode_normal(n: Vec3) -> u32 {
    let scale = 1.0 / (abs(n.x) + abs(n.y) + abs(n.z));
    let x = n.x * scale;
    let y = n.y * scale;
    let folded_x = select(1.0 - abs(y), abs(y) - 1.0, x < 0.0);
    let folded_y = select(1.0 - abs(x), abs(x) - 1.0, y < 0.0);
    let u = select(x, folded_x, n.z < 0.0);
    let v = select(y, folded_y, n.z < 0.0);
    let bits_u = quantize(u * 32767.0 + 32767.0, 65534.0);
    let bits_v = quantize(v * 32767.0 + 32767.0, 65534.0);
    bits_u | (bits_v << 16)
}

/// Inverse of [`encode_normal`]; unit.
#[inline(always)]
pub fn decode_normal(word: u32) -> Vec3 {
    let u = ((word & 0xFFFF) as i32 as f32 - 32767.0) / 32767.0;
    let v = ((word >> 16) as i32 as f32 - 32767.0) / 32767.0;
    let z = 1.0 - abs(u) - abs(v);
    let fold = max(-z, 0.0);
    let x = u + select(-fold, fold, u < 0.0);
    let y = v + select(-fold, fold, v < 0.0);
    let scale = 1.0 / sqrt(x * x + y * y + z * z);
    vec3(x * scale, y * scale, z * scale)
}
