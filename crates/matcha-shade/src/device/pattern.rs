//! Cycles' small textures: white noise, wave, gradient, checker, brick and magic.

use super::hash::*;
use super::math::*;

/// A random number of a coordinate's bits, 1 dimension.
#[inline(always)]
pub fn white_noise_1d(w: f32) -> f32 {
    unit_hash1(w)
}

/// A random number of a coordinate's bits, 2 dimensions.
#[inline(always)]
pub fn white_noise_2d(p: Vec3) -> f32 {
    unit_hash2(p.x, p.y)
}

/// A random number of a coordinate's bits, 3 dimensions.
#[inline(always)]
pub fn white_noise_3d(p: Vec3) -> f32 {
    unit_hash3(p.x, p.y, p.z)
}

/// A random number of a coordinate's bits, 4 dimensions.
#[inline(always)]
pub fn white_noise_4d(p: Vec3, w: f32) -> f32 {
    unit_hash4(p.x, p.y, p.z, w)
}

/// A random colour of a coordinate's bits, 1 dimension.
#[inline(always)]
pub fn white_noise_color_1d(w: f32) -> Vec3 {
    vec3(unit_hash1(w), unit_hash2(w, 1.0), unit_hash2(w, 2.0))
}

/// A random colour of a coordinate's bits, 2 dimensions.
#[inline(always)]
pub fn white_noise_color_2d(p: Vec3) -> Vec3 {
    vec3(
        unit_hash2(p.x, p.y),
        unit_hash3(p.x, p.y, 1.0),
        unit_hash3(p.x, p.y, 2.0),
    )
}

/// A random colour of a coordinate's bits, 3 dimensions.
#[inline(always)]
pub fn white_noise_color_3d(p: Vec3) -> Vec3 {
    vec3(
        unit_hash3(p.x, p.y, p.z),
        unit_hash4(p.x, p.y, p.z, 1.0),
        unit_hash4(p.x, p.y, p.z, 2.0),
    )
}

/// A random colour of a coordinate's bits, 4 dimensions.
#[inline(always)]
pub fn white_noise_color_4d(p: Vec3, w: f32) -> Vec3 {
    vec3(
        unit_hash4(p.x, p.y, p.z, w),
        unit_hash4(p.z, p.x, w, p.y),
        unit_hash4(w, p.z, p.y, p.x),
    )
}

/// Moves a coordinate off the borders of unit cells, against flicker.
#[inline(always)]
pub fn off_borders(p: Vec3) -> Vec3 {
    (p + vec3(0.000_001, 0.000_001, 0.000_001)) * 0.999_999
}

/// Cycles, node Wave Texture, type Bands: phase of a coordinate; `direction` 0 to 3 for
/// X, Y, Z, diagonal.
#[inline(always)]
pub fn wave_bands(p_in: Vec3, direction: u32) -> f32 {
    let p = off_borders(p_in);
    let axis = select(select(p.x, p.y, direction == 1), p.z, direction == 2);
    select(axis * 20.0, (p.x + p.y + p.z) * 10.0, direction == 3)
}

/// The same, type Rings; `direction` 0 to 3 for X, Y, Z, spherical.
#[inline(always)]
pub fn wave_rings(p_in: Vec3, direction: u32) -> f32 {
    let p = off_borders(p_in);
    let x = select(p.x, 0.0, direction == 0);
    let y = select(p.y, 0.0, direction == 1);
    let z = select(p.z, 0.0, direction == 2);
    length(vec3(x, y, z)) * 20.0
}

/// The same: the value of a phase; `profile` 0 to 2 for sine, saw, triangle.
#[inline(always)]
pub fn wave_profile(phase: f32, profile: u32) -> f32 {
    let turns = phase * (1.0 / TAU);
    let sine = 0.5 + 0.5 * sin(phase - 0.5 * PI);
    let saw = turns - floor(turns);
    let triangle = abs(turns - floor(turns + 0.5)) * 2.0;
    select(select(sine, saw, profile == 1), triangle, profile == 2)
}

/// The coordinate that a wave's distortion noise is read at.
#[inline(always)]
pub fn wave_noise_place(p: Vec3, scale: f32) -> Vec3 {
    off_borders(p) * scale
}

/// Cycles, node Gradient Texture; `kind` 0 to 6 for linear, quadratic, easing, diagonal,
/// radial, quadratic sphere, spherical.
#[inline(always)]
pub fn gradient_value(p: Vec3, kind: u32) -> f32 {
    let positive = max(p.x, 0.0);
    let limited = min(positive, 1.0);
    let easing = limited * limited * (3.0 - 2.0 * limited);
    let radial = atan2(p.y, p.x) * (1.0 / TAU) + 0.5;
    let ball = max(0.999_999 - length(p), 0.0);
    let v = select(p.x, positive * positive, kind == 1);
    let v = select(v, easing, kind == 2);
    let v = select(v, (p.x + p.y) * 0.5, kind == 3);
    let v = select(v, radial, kind == 4);
    let v = select(v, ball * ball, kind == 5);
    let v = select(v, ball, kind == 6);
    saturate(v)
}

/// Cycles, node Checker Texture: 1 for the first colour.
#[inline(always)]
pub fn checker_value(p_in: Vec3) -> f32 {
    let p = off_borders(p_in);
    // Both colours alternate with the parity of the sum; odd takes the first. The
    // exclusive or has that parity too and cannot overflow.
    let parity = to_int(floor(p.x)) ^ to_int(floor(p.y)) ^ to_int(floor(p.z));
    select(0.0, 1.0, (parity & 1) != 0)
}

/// A brick's random number.
#[inline(always)]
pub fn brick_random(n_in: u32) -> f32 {
    let n = wrapping_add(n_in, 1013) & 0x7fff_ffff;
    let m = (n >> 13) ^ n;
    let square = wrapping_mul(wrapping_mul(m, m), 60493);
    let mixed = wrapping_add(
        wrapping_mul(m, wrapping_add(square, 19_990_303)),
        1_376_312_589,
    );
    0.5 * ((mixed & 0x7fff_ffff) as i32 as f32 * (1.0 / 1_073_741_824.0))
}

/// Where a point lies in its brick: x, y, width and the brick's random number.
/// `frequency` packs the offset's in the low and the squash's in the high 16 bits.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub fn brick_place(
    p: Vec3,
    width_in: f32,
    height: f32,
    offset_amount: f32,
    squash: f32,
    frequency: u32,
) -> [f32; 4] {
    let offset_frequency = (frequency & 0xffff) as i32 as f32;
    let squash_frequency = (frequency >> 16) as i32 as f32;
    let row = floor(safe_divide(p.y, height));
    let both = (offset_frequency > 0.0) & (squash_frequency > 0.0);
    let squashed = both & (modulo(row, squash_frequency) == 0.0);
    let width = width_in * select(1.0, squash, squashed);
    let moved = both & (modulo(row, offset_frequency) == 0.0);
    let offset = select(0.0, width * offset_amount, moved);
    let brick = floor(safe_divide(p.x + offset, width));
    let x = p.x + offset - width * brick;
    let y = p.y - height * row;
    let seed = wrapping_add((to_int(row) as u32) << 16, (to_int(brick) as u32) & 0xffff);
    [x, y, width, brick_random(seed)]
}

/// Cycles, node Brick Texture: mortar, 0 to 1, at a place of a brick.
#[inline(always)]
pub fn brick_mortar(place: [f32; 4], height: f32, mortar: f32, smooth: f32) -> f32 {
    let border = min(
        min(place[0], place[1]),
        min(place[2] - place[0], height - place[1]),
    );
    let depth = 1.0 - safe_divide(border, mortar);
    let t = saturate(safe_divide(depth, smooth));
    let soft = select(t * t * (3.0 - 2.0 * t), 1.0, smooth == 0.0);
    select(soft, 0.0, border >= mortar)
}

/// One turn of [`magic_color`].
#[inline(always)]
pub fn magic_fold(angle: f32, distortion: f32, is_sine: bool, sign: f32) -> f32 {
    sign * select(cos(angle), sin(angle), is_sine) * distortion
}

/// Cycles, node Magic Texture; `depth` 0 to 10 turns.
#[inline(always)]
pub fn magic_color(p: Vec3, scale: f32, distortion: f32, depth: u32) -> Vec3 {
    let px = modulo(p.x, TAU);
    let py = modulo(p.y, TAU);
    let pz = modulo(p.z, TAU);
    let any = select(1.0, distortion, depth > 0);
    let x = sin((px + py + pz) * 5.0 * scale) * any;
    let y = cos((py - px - pz) * 5.0 * scale) * any;
    let z = -cos((pz - px - py) * 5.0 * scale) * any;
    let y = select(y, magic_fold(x - y + z, distortion, false, -1.0), depth > 0);
    let x = select(x, magic_fold(x - y - z, distortion, false, 1.0), depth > 1);
    let z = select(z, magic_fold(-x - y - z, distortion, true, 1.0), depth > 2);
    let x = select(x, magic_fold(y - x - z, distortion, false, -1.0), depth > 3);
    let y = select(y, magic_fold(y - x + z, distortion, true, -1.0), depth > 4);
    let y = select(y, magic_fold(y - x + z, distortion, false, -1.0), depth > 5);
    let x = select(x, magic_fold(x + y + z, distortion, false, 1.0), depth > 6);
    let z = select(z, magic_fold(x + y - z, distortion, true, 1.0), depth > 7);
    let x = select(x, magic_fold(z - x - y, distortion, false, -1.0), depth > 8);
    let y = select(y, magic_fold(x - y + z, distortion, true, -1.0), depth > 9);
    let shrink = select(1.0, 0.5 * safe_divide(1.0, distortion), distortion != 0.0);
    vec3(0.5 - x * shrink, 0.5 - y * shrink, 0.5 - z * shrink)
}
