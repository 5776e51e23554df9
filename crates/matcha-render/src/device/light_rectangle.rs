//! Sampling of rectangles by solid angle, and of ellipses by area.

use crate::device::mapping::{MappingFrame, mapping_disk};
use glam::{Vec2, Vec3};
use matcha_shade::device::math::{abs, asin, clamp, cos, dot, max, select, sin, sqrt, vec2};

/// Rectangles that cover less than this solid angle (steradians) are sampled by area: the
/// angles of the spherical rectangle cancel in single precision.
pub const LIGHT_RECTANGLE_SMALL: f32 = 5e-3;

/// A rectangle or ellipse with a centre, unit axes in x and y, the normal of its shining
/// side in z, and full lengths.
#[derive(Clone, Copy, Debug)]
pub struct LightPatch {
    /// Centre, metres.
    pub center: Vec3,
    /// Unit axes and the shining normal.
    pub axes: MappingFrame,
    /// Full lengths along the axes, metres.
    pub size: Vec2,
}

/// A rectangle as seen from a point (Ureña, Fajardo and King 2013, §3).
#[derive(Clone, Copy, Debug)]
pub struct LightSphericalRectangle {
    /// Edges in the patch's axes relative to the point: x low, y low.
    pub low: Vec2,
    /// x high, y high.
    pub high: Vec2,
    /// Distance of the point to the plane, negative on the far side of the shining normal.
    pub height: f32,
    /// z component of the normal of the plane through the edge at y low.
    pub b0: f32,
    /// Likewise at y high.
    pub b1: f32,
    /// Where the sweep over the angle starts: the paper's k less π.
    pub start: f32,
    /// Solid angle, steradians.
    pub solid_angle: f32,
}

/// Prepares a rectangle for a point `p`. The internal angles are taken as deviations from
/// right angles (arc sines for the paper's arc cosines), which keeps small ones accurate.
#[inline(always)]
pub fn light_rectangle_seen(patch: LightPatch, p: Vec3) -> LightSphericalRectangle {
    let to = patch.center - p;
    let middle = vec2(dot(to, patch.axes.x), dot(to, patch.axes.y));
    let low = middle - patch.size * 0.5;
    let high = middle + patch.size * 0.5;
    let height = abs(dot(to, patch.axes.z));
    let h2 = height * height;
    // z components of the unit normals of the four edge planes, pointing inwards.
    let n0 = -low.y / sqrt(max(low.y * low.y + h2, 1e-36));
    let n1 = high.x / sqrt(max(high.x * high.x + h2, 1e-36));
    let n2 = high.y / sqrt(max(high.y * high.y + h2, 1e-36));
    let n3 = -low.x / sqrt(max(low.x * low.x + h2, 1e-36));
    let g0 = asin(clamp(n0 * n1, -1.0, 1.0));
    let g1 = asin(clamp(n1 * n2, -1.0, 1.0));
    let g2 = asin(clamp(n2 * n3, -1.0, 1.0));
    let g3 = asin(clamp(n3 * n0, -1.0, 1.0));
    LightSphericalRectangle {
        low,
        high,
        height,
        b0: n0,
        b1: n2,
        start: -(g2 + g3),
        solid_angle: max(g0 + g1 + g2 + g3, 0.0),
    }
}

/// Point of the rectangle, in the patch's axes relative to the point of view's foot on the
/// plane, uniform in solid angle (Ureña et al. 2013, §4, with the angle less π, which turns
/// the sign of its sine and cosine).
#[inline(always)]
pub fn light_rectangle_point(seen: LightSphericalRectangle, u: Vec2) -> Vec2 {
    let angle = u.x * seen.solid_angle + seen.start;
    let sine = sin(angle);
    let safe = select(sine, 1e-20, abs(sine) < 1e-20);
    let f = (cos(angle) * seen.b0 + seen.b1) / safe;
    let magnitude = 1.0 / sqrt(f * f + seen.b0 * seen.b0);
    let c = clamp(select(-magnitude, magnitude, f > 0.0), -1.0, 1.0);
    let slope = c * seen.height / sqrt(max(1.0 - c * c, 1e-14));
    let x = clamp(slope, seen.low.x, seen.high.x);
    let d2 = x * x + seen.height * seen.height;
    let h0 = seen.low.y / sqrt(max(d2 + seen.low.y * seen.low.y, 1e-36));
    let h1 = seen.high.y / sqrt(max(d2 + seen.high.y * seen.high.y, 1e-36));
    let h = h0 + u.y * (h1 - h0);
    let y = h * sqrt(d2 / max(1.0 - h * h, 1e-7));
    vec2(x, clamp(y, seen.low.y, seen.high.y))
}

/// Point of an ellipse with the given full lengths around the origin, uniform in area.
#[inline(always)]
pub fn light_ellipse_point(size: Vec2, u: Vec2) -> Vec2 {
    mapping_disk(u) * size * 0.5
}

/// Solid-angle density of a point that was sampled uniformly on an area.
#[inline(always)]
pub fn light_area_pdf(area: f32, distance_squared: f32, cosine: f32) -> f32 {
    select(
        0.0,
        distance_squared / max(area * cosine, 1e-36),
        cosine > 0.0,
    )
}
