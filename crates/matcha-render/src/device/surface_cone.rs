//! Ray cones: how wide a path is where it hits, and the ellipse that it leaves on a surface.
//!
//! Akenine-Möller, Crassin, Boksansky, Belcour, Panteleev and Wright 2021, "Improved Shader and
//! Texture Level of Detail Using Ray Cones" (JCGT 10(1)).

use crate::device::mapping::mapping_frame;
use glam::Vec3;
use matcha_shade::device::math::{abs, clamp, cross, dot, max, min, sqrt};

/// Cosine below which a surface counts as seen edge-on: keeps the long axis finite.
pub const CONE_LEAST_COSINE: f32 = 1e-3;

/// Growth of a cone per metre after a diffuse bounce. A hundred samples a pixel that share the
/// hemisphere are about this far apart (2π/128 steradians each).
pub const DIFFUSE_SPREAD: f32 = 0.22;

/// Width of a cone after `distance` (section 2: w' = w + γ t, for small γ).
#[inline(always)]
pub fn cone_width_at(width: f32, spread: f32, distance: f32) -> f32 {
    abs(width + spread * distance)
}

/// Half axes, in world space, of the ellipse in which a cone of a diameter `width` around the unit
/// `direction` meets the plane with the unit `normal`. The first is the long one, along the
/// direction's projection onto the plane; both are orthogonal to the normal and to each other.
///
/// Section 3 of the paper with its erratum: the long half axis is r/cos θ, the short one r.
/// (The printed listing divides by a length that vanishes where the surface is seen head-on.)
#[inline(always)]
pub fn cone_ellipse(direction: Vec3, normal: Vec3, width: f32) -> [Vec3; 2] {
    let cosine = dot(direction, normal);
    let along = direction - normal * cosine;
    let sine_squared = dot(along, along);
    let unit = if sine_squared > 1e-8 {
        along / sqrt(sine_squared)
    } else {
        mapping_frame(normal).y
    };
    let radius = 0.5 * width;
    [
        unit * (radius / max(abs(cosine), CONE_LEAST_COSINE)),
        cross(normal, unit) * radius,
    ]
}

/// Spread of a cone, per metre, after a scattering: `alpha` is the square of the closure's
/// roughness, ignored where it is diffuse. A sharp mirror or glass keeps the spread; a lobe adds in
/// proportion to its width until it is as wide as a diffuse one's.
#[inline(always)]
pub fn cone_spread_after(spread: f32, alpha: f32, diffuse: bool) -> f32 {
    let added = if diffuse {
        1.0
    } else {
        clamp(2.0 * alpha, 0.0, 1.0)
    };
    min(abs(spread) + DIFFUSE_SPREAD * added, 1.0)
}

/// Half axes of a cone's circle on the sphere of directions, around the unit `direction`.
#[inline(always)]
pub fn cone_circle(direction: Vec3, spread: f32) -> [Vec3; 2] {
    let frame = mapping_frame(direction);
    let radius = 0.5 * spread;
    [frame.x * radius, frame.y * radius]
}
