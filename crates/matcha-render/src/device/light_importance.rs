//! How much a cluster of lights may matter to a shading point.
//!
//! Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree
//! Splitting", §4: a cluster is bounded by a box, and by a cone of normals (half angle θo)
//! around which it shines up to θe. Angles appear as cosines only.

use glam::Vec3;
use matcha_shade::device::math::{abs, abs3, dot, max, min, select, sqrt};

/// Bounds of a cluster of lights.
#[derive(Clone, Copy, Debug)]
pub struct LightBounds {
    /// Low corner of the box, metres.
    pub low: Vec3,
    /// High corner of the box, metres.
    pub high: Vec3,
    /// Unit axis of the cone of normals.
    pub axis: Vec3,
    /// Cosine of θo, the largest angle between the axis and a normal.
    pub cos_normals: f32,
    /// Cosine of θe, the largest angle between a normal and a direction that it shines to.
    pub cos_emission: f32,
    /// Luminous intensity along the normals, summed: radiance times area, W·sr⁻¹.
    pub power: f32,
    /// Shines to both sides of its normals.
    pub two_sided: bool,
}

/// sin θ from cos θ of an angle from 0 to π.
#[inline(always)]
pub fn light_sine(cosine: f32) -> f32 {
    sqrt(max(1.0 - cosine * cosine, 0.0))
}

/// Estimate of the irradiance that a cluster brings to the point `p` with unit normal `n`
/// (zero where light from both sides counts). Zero only where it brings none.
///
/// Angles are subtracted by cosine and sine pairs; conditions are joined without short
/// circuits, so that a loop over clusters becomes vector code.
#[inline(always)]
pub fn light_importance(bounds: LightBounds, p: Vec3, n: Vec3) -> f32 {
    let to = (bounds.low + bounds.high) * 0.5 - p;
    let half = (bounds.high - bounds.low) * 0.5;
    let r2 = dot(half, half);
    let d2 = max(dot(to, to), 1e-30);
    let around = d2 <= r2;
    let inverse = 1.0 / sqrt(d2);
    // Half angle under which the bounding sphere is seen.
    let sin_bound = min(sqrt(r2) * inverse, 1.0);
    let cos_bound = sqrt(1.0 - sin_bound * sin_bound);
    // Smallest angle between the axis and a direction from the sphere to the point …
    let facing = -dot(bounds.axis, to) * inverse;
    let cos_axis = select(facing, abs(facing), bounds.two_sided);
    let sin_axis = light_sine(cos_axis);
    let towards = cos_axis >= cos_bound;
    let cos_turn = select(cos_axis * cos_bound + sin_axis * sin_bound, 1.0, towards);
    let sin_turn = select(sin_axis * cos_bound - cos_axis * sin_bound, 0.0, towards);
    // … and between a normal and it.
    let sin_normals = light_sine(bounds.cos_normals);
    let turned = cos_turn * bounds.cos_normals + sin_turn * sin_normals;
    let cos_out = select(turned, 1.0, cos_turn >= bounds.cos_normals);
    let shines = around | (cos_out > bounds.cos_emission);
    // Smallest angle of incidence.
    let opaque = dot(n, n) > 0.0;
    let cos_middle = dot(n, to) * inverse;
    let above = cos_middle * cos_bound + light_sine(cos_middle) * sin_bound;
    let cos_in = select(above, 1.0, cos_middle >= cos_bound);
    let reach = dot(abs3(n), half) + dot(n, to);
    let in_sight = !opaque | ((reach > 0.0) & (around | (cos_in > 0.0)));
    // Inside of the sphere every direction is possible.
    let out = select(max(cos_out, 0.0), 1.0, around);
    let incidence = select(cos_in, 1.0, around | !opaque);
    let value = bounds.power * out * incidence / max(max(d2, r2), 1e-12);
    select(0.0, value, shines & in_sight)
}

/// Irradiance on a surface with unit normal `n` from nine coefficients of the surrounding
/// radiance in real spherical harmonics, order (0,0), (1,−1), (1,0), (1,1), (2,−2) … (2,2)
/// (Ramamoorthi and Hanrahan 2001, eq. 13).
#[inline]
pub fn light_world_irradiance(l: [f32; 9], n: Vec3) -> f32 {
    0.886_227 * l[0]
        + 1.023_328 * (l[3] * n.x + l[1] * n.y + l[2] * n.z)
        + 0.858_086 * (l[4] * n.x * n.y + l[7] * n.x * n.z + l[5] * n.y * n.z)
        + 0.429_043 * l[8] * (n.x * n.x - n.y * n.y)
        + l[6] * (0.743_125 * n.z * n.z - 0.247_708)
}
