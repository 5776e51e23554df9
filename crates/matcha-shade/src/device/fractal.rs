//! Sums of noise octaves: fractional Brownian motion and Musgrave's four variants
//! ("Texturing and Modeling: A Procedural Approach", 3rd ed., chapter 16), with the
//! fractional last octave and the normalisation of Cycles, node Noise Texture.
//!
//! Loop form: `step` adds one octave. State of the sums: value, sum of amplitudes,
//! amplitude, frequency, and the value with the octave that counts only in part.

use super::math::*;
use super::perlin::*;

/// Octaves to evaluate: the whole ones and the partial one.
#[inline(always)]
pub fn octave_count(detail: f32) -> u32 {
    let limited = clamp(detail, 0.0, 15.0);
    let whole = to_int(limited);
    (whole + 1) as u32 + select_u32(0, 1, limited > whole as f32)
}

/// True if octave `i` counts wholly.
#[inline(always)]
pub fn octave_is_whole(i: u32, detail: f32) -> bool {
    i as i32 <= to_int(clamp(detail, 0.0, 15.0))
}

/// Before the first octave.
#[inline(always)]
pub fn fbm_start() -> [f32; 5] {
    [0.0, 0.0, 1.0, 1.0, 0.0]
}

/// Adds the octave with noise `t`.
#[inline(always)]
pub fn fbm_octave(
    i: u32,
    t: f32,
    detail: f32,
    roughness: f32,
    lacunarity: f32,
    s: [f32; 5],
) -> [f32; 5] {
    let whole = octave_is_whole(i, detail);
    let added = s[0] + t * s[2];
    [
        select(s[0], added, whole),
        select(s[1], s[1] + s[2], whole),
        select(s[2], s[2] * max(roughness, 0.0), whole),
        select(s[3], s[3] * lacunarity, whole),
        added,
    ]
}

/// The value; normalised to [0, 1] where `normalized` is not 0.
#[inline(always)]
pub fn fbm_value(detail: f32, normalized: u32, s: [f32; 5]) -> f32 {
    let limited = clamp(detail, 0.0, 15.0);
    let part = limited - floor(limited);
    let below = select(s[0], 0.5 * s[0] / s[1] + 0.5, normalized != 0);
    let above = select(s[4], 0.5 * s[4] / (s[1] + s[2]) + 0.5, normalized != 0);
    select(below, mix(below, above, part), part > 0.0)
}

/// Multifractal.
pub const FRACTAL_MULTI: u32 = 0;
/// Hybrid multifractal.
pub const FRACTAL_HYBRID: u32 = 1;
/// Ridged multifractal.
pub const FRACTAL_RIDGED: u32 = 2;
/// Heterogeneous terrain.
pub const FRACTAL_HETERO: u32 = 3;

/// Before the first octave: value, power, weight, frequency.
#[inline(always)]
pub fn fractal_start(kind: u32) -> [f32; 4] {
    [select(0.0, 1.0, kind == FRACTAL_MULTI), 1.0, 1.0, 1.0]
}

/// Adds the octave with noise `t`. `part` is 1 for whole octaves.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub fn fractal_octave(
    i: u32,
    t: f32,
    detail: f32,
    roughness_in: f32,
    lacunarity: f32,
    offset: f32,
    gain: f32,
    kind: u32,
    s: [f32; 4],
) -> [f32; 4] {
    let limited = clamp(detail, 0.0, 15.0);
    let roughness = max(roughness_in, 0.0);
    let part = select(limited - floor(limited), 1.0, octave_is_whole(i, detail));
    let value = s[0];
    let power = s[1];

    let multi = value * (part * power * t + 1.0);

    let hybrid_runs = s[2] > 0.001;
    let hybrid_weight = min(s[2], 1.0);
    let hybrid_signal = (t + offset) * power;
    let hybrid = select(
        value,
        value + part * hybrid_weight * hybrid_signal,
        hybrid_runs,
    );
    let hybrid_next = select(s[2], hybrid_weight * gain * hybrid_signal, hybrid_runs);

    // The state's weight of the ridged kind is the last octave's signal times gain.
    let crest = offset - abs(t);
    let ridged_weight = select(saturate(s[2]), 1.0, i == 0);
    let ridged_signal = crest * crest * ridged_weight;
    let ridged_power = select(power, 1.0, i == 0);
    let ridged_part = select(0.0, 1.0, octave_is_whole(i, detail));
    let ridged = value + ridged_part * ridged_signal * ridged_power;

    let first = i == 0;
    let terrain_step = (t + offset) * power * value;
    let terrain = select(value + part * terrain_step, t + offset, first);

    let next = select(hybrid, multi, kind == FRACTAL_MULTI);
    let next = select(next, ridged, kind == FRACTAL_RIDGED);
    let next = select(next, terrain, kind == FRACTAL_HETERO);
    let weight = select(hybrid_next, ridged_signal * gain, kind == FRACTAL_RIDGED);
    [next, power * roughness, weight, s[3] * lacunarity]
}

/// Octaves of fractional Brownian motion, from its operands.
#[inline(always)]
pub fn fbm_count(
    _p: Vec3,
    _w: f32,
    detail: f32,
    _roughness: f32,
    _lacunarity: f32,
    _normalized: u32,
) -> u32 {
    octave_count(detail)
}

/// [`fbm_start`], from the operands.
#[inline(always)]
pub fn fbm_init(
    _p: Vec3,
    _w: f32,
    _detail: f32,
    _roughness: f32,
    _lacunarity: f32,
    _normalized: u32,
) -> [f32; 5] {
    fbm_start()
}

/// [`fbm_value`], from the operands.
#[inline(always)]
pub fn fbm_finish(
    _p: Vec3,
    _w: f32,
    detail: f32,
    _roughness: f32,
    _lacunarity: f32,
    normalized: u32,
    s: [f32; 5],
) -> f32 {
    fbm_value(detail, normalized, s)
}

/// Octaves of a multifractal, from its operands.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub fn fractal_count(
    _p: Vec3,
    _w: f32,
    detail: f32,
    _roughness: f32,
    _lacunarity: f32,
    _offset: f32,
    _gain: f32,
    _kind: u32,
) -> u32 {
    octave_count(detail)
}

/// [`fractal_start`], from the operands.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub fn fractal_init(
    _p: Vec3,
    _w: f32,
    _detail: f32,
    _roughness: f32,
    _lacunarity: f32,
    _offset: f32,
    _gain: f32,
    kind: u32,
) -> [f32; 4] {
    fractal_start(kind)
}

/// The value of a multifractal.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub fn fractal_finish(
    _p: Vec3,
    _w: f32,
    _detail: f32,
    _roughness: f32,
    _lacunarity: f32,
    _offset: f32,
    _gain: f32,
    _kind: u32,
    s: [f32; 4],
) -> f32 {
    s[0]
}

/// An octave of fractional Brownian motion in 1 dimension.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub fn fbm_step_1d(
    i: u32,
    _p: Vec3,
    w: f32,
    detail: f32,
    roughness: f32,
    lacunarity: f32,
    _normalized: u32,
    s: [f32; 5],
) -> [f32; 5] {
    fbm_octave(i, noise_1d(w * s[3]), detail, roughness, lacunarity, s)
}

/// An octave of a multifractal in 1 dimension.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub fn fractal_step_1d(
    i: u32,
    _p: Vec3,
    w: f32,
    detail: f32,
    roughness: f32,
    lacunarity: f32,
    offset: f32,
    gain: f32,
    kind: u32,
    s: [f32; 4],
) -> [f32; 4] {
    fractal_octave(
        i,
        noise_1d(w * s[3]),
        detail,
        roughness,
        lacunarity,
        offset,
        gain,
        kind,
        s,
    )
}

/// An octave of fractional Brownian motion in 2 dimensions.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub fn fbm_step_2d(
    i: u32,
    p: Vec3,
    _w: f32,
    detail: f32,
    roughness: f32,
    lacunarity: f32,
    _normalized: u32,
    s: [f32; 5],
) -> [f32; 5] {
    fbm_octave(
        i,
        noise_2d(vec2(p.x * s[3], p.y * s[3])),
        detail,
        roughness,
        lacunarity,
        s,
    )
}

/// An octave of a multifractal in 2 dimensions.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub fn fractal_step_2d(
    i: u32,
    p: Vec3,
    _w: f32,
    detail: f32,
    roughness: f32,
    lacunarity: f32,
    offset: f32,
    gain: f32,
    kind: u32,
    s: [f32; 4],
) -> [f32; 4] {
    fractal_octave(
        i,
        noise_2d(vec2(p.x * s[3], p.y * s[3])),
        detail,
        roughness,
        lacunarity,
        offset,
        gain,
        kind,
        s,
    )
}

/// An octave of fractional Brownian motion in 3 dimensions.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub fn fbm_step_3d(
    i: u32,
    p: Vec3,
    _w: f32,
    detail: f32,
    roughness: f32,
    lacunarity: f32,
    _normalized: u32,
    s: [f32; 5],
) -> [f32; 5] {
    fbm_octave(i, noise_3d(p * s[3]), detail, roughness, lacunarity, s)
}

/// An octave of a multifractal in 3 dimensions.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub fn fractal_step_3d(
    i: u32,
    p: Vec3,
    _w: f32,
    detail: f32,
    roughness: f32,
    lacunarity: f32,
    offset: f32,
    gain: f32,
    kind: u32,
    s: [f32; 4],
) -> [f32; 4] {
    fractal_octave(
        i,
        noise_3d(p * s[3]),
        detail,
        roughness,
        lacunarity,
        offset,
        gain,
        kind,
        s,
    )
}

/// An octave of fractional Brownian motion in 4 dimensions.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub fn fbm_step_4d(
    i: u32,
    p: Vec3,
    w: f32,
    detail: f32,
    roughness: f32,
    lacunarity: f32,
    _normalized: u32,
    s: [f32; 5],
) -> [f32; 5] {
    fbm_octave(
        i,
        noise_4d(p * s[3], w * s[3]),
        detail,
        roughness,
        lacunarity,
        s,
    )
}

/// An octave of a multifractal in 4 dimensions.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub fn fractal_step_4d(
    i: u32,
    p: Vec3,
    w: f32,
    detail: f32,
    roughness: f32,
    lacunarity: f32,
    offset: f32,
    gain: f32,
    kind: u32,
    s: [f32; 4],
) -> [f32; 4] {
    fractal_octave(
        i,
        noise_4d(p * s[3], w * s[3]),
        detail,
        roughness,
        lacunarity,
        offset,
        gain,
        kind,
        s,
    )
}
