//! Microfacet distributions, their masking, and sampling of visible normals.
//!
//! Vectors with suffix `_local` are in the frame (tangent, bitangent, normal).

use glam::{Vec2, Vec3};
use matcha_shade::device::math::{
    PI, abs, clamp, cos, exp, max, normalize, saturate, select, sin, sqrt, vec3,
};

use super::error_function::{error_function, inverse_error_function};

/// Density of Trowbridge–Reitz normals from stretched coordinates: `slope` is
/// (x/αx)² + (y/αy)² and `z` the cosine of the half vector
/// (Walter et al. 2007, equation 33; anisotropic: Heitz 2014, equation 85).
#[inline(always)]
pub fn microfacet_ggx_density(slope: f32, z: f32, alpha2: f32) -> f32 {
    let t = slope + z * z;
    1.0 / max(PI * alpha2 * t * t, 1.0e-30)
}

/// Density of Beckmann normals (Walter et al. 2007, equation 25; arguments as above).
#[inline(always)]
pub fn microfacet_beckmann_density(slope: f32, z: f32, alpha2: f32) -> f32 {
    let z2 = max(z * z, 1.0e-12);
    exp(-slope / z2) / (PI * alpha2 * z2 * z2)
}

/// Smith's Λ of Trowbridge–Reitz for α²tan²θ (Heitz 2014, equation 72).
#[inline(always)]
pub fn microfacet_ggx_lambda(alpha_tan_squared: f32) -> f32 {
    0.5 * (sqrt(1.0 + alpha_tan_squared) - 1.0)
}

/// Smith's Λ of Beckmann, rational fit (Walter et al. 2007, equation 27; Heitz 2014,
/// below equation 69): relative error of the masking below 0.35 %.
#[inline(always)]
pub fn microfacet_beckmann_lambda(alpha_tan_squared: f32) -> f32 {
    let a = 1.0 / sqrt(max(alpha_tan_squared, 1.0e-12));
    let fit = ((0.396 * a - 1.259) * a + 1.0) / ((2.181 * a + 3.535) * a);
    select(fit, 0.0, a >= 1.6)
}

/// α²tan²θ of a direction, for one or two roughnesses.
#[inline(always)]
pub fn microfacet_alpha_tan_squared(v_local: Vec3, alpha_x: f32, alpha_y: f32) -> f32 {
    let x = alpha_x * v_local.x;
    let y = alpha_y * v_local.y;
    (x * x + y * y) / max(v_local.z * v_local.z, 1.0e-20)
}

/// A normal visible from `wo_local` (z > 0) of a Trowbridge–Reitz surface, by spherical
/// caps (Dupuy and Benyoub 2023, listing 3).
#[inline(always)]
pub fn microfacet_ggx_sample(wo_local: Vec3, alpha_x: f32, alpha_y: f32, u: Vec2) -> Vec3 {
    let wo = normalize(vec3(wo_local.x * alpha_x, wo_local.y * alpha_y, wo_local.z));
    let phi = 2.0 * PI * u.x;
    // 1 + z of the cap's point, kept as a sum: the half vector's z cancels otherwise.
    let rise = (1.0 - u.y) * (1.0 + wo.z);
    let z = rise - wo.z;
    let radius = sqrt(saturate(1.0 - z * z));
    let x = radius * cos(phi) + wo.x;
    let y = radius * sin(phi) + wo.y;
    normalize(vec3(x * alpha_x, y * alpha_y, max(rise, 1.0e-12)))
}

/// First slope of a visible Beckmann normal of roughness 1, seen under the cosine `cosine`:
/// inverts the cumulative distribution 1 + b + k·exp(−erf⁻¹(b)²) over b = erf(slope),
/// where k = tan θ / √π (Jakob 2014, "An Improved Visible Normal Sampling Routine for the
/// Beckmann Distribution", section 2) by safeguarded Newton steps.
#[inline]
pub fn microfacet_beckmann_slope(cosine: f32, u: f32) -> f32 {
    let sine = sqrt(max(1.0 - cosine * cosine, 1.0e-12));
    let tangent = sine / max(cosine, 1.0e-6);
    let k = tangent * 0.564_189_6;
    let cotangent = 1.0 / tangent;
    let top = error_function(cotangent);
    let tail = exp(-cotangent * cotangent);
    let target = u * (1.0 + top + k * tail);
    // First guess: exp(−erf⁻¹(b)²) is close to 1 − b².
    let rough_target = u * (1.0 + top + k * (1.0 - top * top));
    let discriminant = max(k * (k - rough_target + 1.0) + 0.25, 0.0);
    let guess = select(
        rough_target - 1.0,
        (0.5 - sqrt(discriminant)) / max(k, 1.0e-6),
        k > 1.0e-4,
    );
    let mut low = -1.0;
    let mut high = top;
    let mut b = clamp(guess, -0.999_999, 0.999_999);
    let mut slope = inverse_error_function(b);
    let mut value = 1.0 + b + k * exp(-slope * slope) - target;
    let mut i = 0;
    while i < 4 && abs(value) > 1.0e-6 {
        let above = value > 0.0;
        high = select(high, b, above);
        low = select(b, low, above);
        let derivative = 1.0 - slope * tangent;
        let newton = b - value / select(1.0e-6, derivative, derivative > 1.0e-6);
        let inside = newton >= low && newton <= high;
        b = select(0.5 * (low + high), newton, inside);
        b = clamp(b, -0.999_999, 0.999_999);
        slope = inverse_error_function(b);
        value = 1.0 + b + k * exp(-slope * slope) - target;
        i += 1;
    }
    slope
}

/// A normal visible from `wo_local` (z > 0) of a Beckmann surface (Heitz and d'Eon 2014,
/// section 4).
#[inline]
pub fn microfacet_beckmann_sample(wo_local: Vec3, alpha_x: f32, alpha_y: f32, u: Vec2) -> Vec3 {
    let wo = normalize(vec3(wo_local.x * alpha_x, wo_local.y * alpha_y, wo_local.z));
    let along = microfacet_beckmann_slope(wo.z, clamp(u.x, 1.0e-6, 0.999_999));
    let across = inverse_error_function(clamp(2.0 * u.y - 1.0, -0.999_999, 0.999_999));
    // Rotate from the direction's azimuth.
    let radius = sqrt(wo.x * wo.x + wo.y * wo.y);
    let defined = radius > 1.0e-7;
    let inverse = 1.0 / select(1.0, radius, defined);
    let c = select(1.0, wo.x * inverse, defined);
    let s = select(0.0, wo.y * inverse, defined);
    let x = (c * along - s * across) * alpha_x;
    let y = (s * along + c * across) * alpha_y;
    normalize(vec3(-x, -y, 1.0))
}
