//! Shading normals that differ from the geometry: kept valid, and shadowed softly.

use glam::Vec3;
use matcha_shade::device::math::{abs, dot, max, min, normalize, saturate, select, sqrt};

use super::microfacet::microfacet_ggx_lambda;

/// `n`, turned towards the geometric normal `ng` just so far that the mirror direction of
/// `wo` rises above the surface by the sine `min(0.01, 0.9 cos)`; `n` itself where it
/// does already. What Cycles' glossy closures do ("ensure valid specular reflection").
///
/// With Ng as z and N in the xz plane, the normal (√(1−s), 0, √s) mirrors wo to a height
/// h = 2 (wo·n) √s − wo.z; squaring gives 4a s² − 2b s + c = 0 with a = x² + z²,
/// b = 2 (a + z h), c = (z + h)², of which the sign of x selects one root.
#[inline]
pub fn shading_normal_valid(ng: Vec3, wo: Vec3, n: Vec3) -> Vec3 {
    let z = dot(wo, ng);
    let mirrored = 2.0 * dot(n, wo) * dot(n, ng) - z;
    let height = min(0.9 * z, 0.01);
    let aside = n - ng * dot(n, ng);
    let reach = sqrt(dot(aside, aside));
    let axis = aside * (1.0 / max(reach, 1.0e-12));
    let x = dot(wo, axis);
    let a = max(x * x + z * z, 1.0e-12);
    let b = 2.0 * (a + z * height);
    let c = (z + height) * (z + height);
    let root = sqrt(max(b * b - 4.0 * a * c, 0.0));
    let s = saturate(0.25 * (b + select(-root, root, x < 0.0)) / a);
    let turned = normalize(axis * sqrt(1.0 - s) + ng * sqrt(s));
    // A normal along Ng has no side to turn to and needs none.
    let keep = mirrored >= height || reach < 1.0e-6;
    if keep { n } else { turned }
}

/// Factor on a diffuse closure whose normal `n` is bent away from the surface's shading
/// normal `ns`, for light from `wi`: 0 where the two disagree about the side, otherwise a
/// GGX masking that widens with the bend (Conty, Lecocq and Stein 2019, "A
/// Microfacet-Based Shadowing Function to Solve the Bump Terminator Problem", eqs. 3–5).
/// `smooth_out` off: the side test alone.
#[inline]
pub fn shading_normal_shadow(ns: Vec3, n: Vec3, wi: Vec3, smooth_out: bool) -> f32 {
    let cos_i = dot(ns, wi);
    let cos_d = dot(ns, n);
    let sides = cos_i * cos_d * dot(n, wi);
    let i = min(abs(cos_i), 1.0);
    let d = max(min(abs(cos_d), 1.0), 1.0e-6);
    let alpha2 = saturate(0.125 * (1.0 / (d * d) - 1.0));
    let tan2 = max(1.0 / max(i * i, 1.0e-12) - 1.0, 0.0);
    let masking = 1.0 / (1.0 + microfacet_ggx_lambda(alpha2 * tan2));
    let soft = select(masking, 0.0, i < 1.0e-6);
    let factor = select(1.0, soft, smooth_out);
    select(factor, 0.0, sides < 0.0)
}
