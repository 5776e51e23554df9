//! Fresnel reflectance of smooth interfaces, exact and in the artists' parametrisations.

use glam::Vec3;
use matcha_shade::device::math::{
    abs, clamp, max, min3, mix3, saturate, saturate3, select, splat3, sqrt, vec3,
};

/// No Fresnel factor: a closure of one side whose weight says all.
pub const FRESNEL_NONE: u32 = 0;
/// Dielectric interface.
pub const FRESNEL_DIELECTRIC: u32 = 1;
/// Metal with an edge tint at 82°.
pub const FRESNEL_F82: u32 = 2;
/// The dielectric's curve, stretched between F0 and 1.
pub const FRESNEL_REMAPPED: u32 = 3;

/// Unpolarised reflectance of an interface and where light goes behind it.
#[derive(Clone, Copy, Debug)]
pub struct FresnelInterface {
    /// Fraction of energy that is reflected, 0 to 1.
    pub reflectance: f32,
    /// Cosine between normal and refracted ray, 0 under total internal reflection.
    pub cos_transmitted: f32,
}

/// Reflectance of a dielectric with relative index `ior` (behind over in front) under the
/// cosine `cos_incident` (Born and Wolf 1999, section 1.5.2; any text on optics).
#[inline(always)]
pub fn fresnel_interface(cos_incident: f32, ior: f32) -> FresnelInterface {
    let c = abs(cos_incident);
    // n·cos θt, from Snell's law.
    let g_squared = ior * ior - 1.0 + c * c;
    let g = sqrt(max(g_squared, 0.0));
    let senkrecht = (c - g) / max(c + g, 1.0e-30);
    let n2c = ior * ior * c;
    let parallel = (n2c - g) / max(n2c + g, 1.0e-30);
    let partial = 0.5 * (senkrecht * senkrecht + parallel * parallel);
    let total = g_squared <= 0.0;
    FresnelInterface {
        reflectance: select(partial, 1.0, total),
        cos_transmitted: select(g / ior, 0.0, total),
    }
}

/// Reflectance at normal incidence of a dielectric with relative index `ior`.
#[inline(always)]
pub fn fresnel_f0(ior: f32) -> f32 {
    let root = (ior - 1.0) / (ior + 1.0);
    root * root
}

/// The relative index, at least 1, whose reflectance at normal incidence is `f0`
/// (limited to 0.99).
#[inline(always)]
pub fn fresnel_ior_of_f0(f0: f32) -> f32 {
    let root = sqrt(clamp(f0, 0.0, 0.99));
    (1.0 + root) / (1.0 - root)
}

/// Cosine-weighted mean reflectance of a dielectric, fit of Kulla and Conty 2017
/// ("Revisiting Physically Based Shading at Imageworks", slide 24).
#[inline(always)]
pub fn fresnel_mean_dielectric(ior: f32) -> f32 {
    let outside = (ior - 1.0) / (4.08567 + 1.00071 * ior);
    let inside = 0.997118 + ior * (0.1014 - ior * (0.965241 + ior * 0.130607));
    select(outside, inside, ior < 1.0)
}

/// Where a dielectric's reflectance `f` lies between `f0` and 1, 0 to 1.
#[inline(always)]
pub fn fresnel_position(f: f32, f0: f32) -> f32 {
    saturate((f - f0) / max(1.0 - f0, 1.0e-30))
}

/// (1 − c)⁵, Schlick 1994 equation 15, for a cosine within [0, 1].
#[inline(always)]
pub fn fresnel_schlick_power(cosine: f32) -> f32 {
    let m = saturate(1.0 - cosine);
    let m2 = m * m;
    m2 * m2 * m
}

/// Coefficient b of the F82-tint model, F = Schlick − b·cos θ·(1 − cos θ)⁶, that scales
/// Schlick's value at cos θ = 1/7 by `tint` (Kutz, Hašan and Edmondson 2021, "Novel
/// aspects of the Adobe Standard Material", section 2).
#[inline]
pub fn fresnel_f82_coefficient(f0: Vec3, tint: Vec3) -> Vec3 {
    let p5 = fresnel_schlick_power(1.0 / 7.0);
    let schlick = mix3(f0, splat3(1.0), p5);
    let p6 = p5 * (6.0 / 7.0);
    schlick * (vec3(1.0, 1.0, 1.0) - min3(tint, splat3(1.0))) * (7.0 / p6)
}

/// Reflectance of the F82-tint model.
#[inline(always)]
pub fn fresnel_f82(cosine: f32, f0: Vec3, b: Vec3) -> Vec3 {
    let p5 = fresnel_schlick_power(cosine);
    let p6 = p5 * saturate(1.0 - cosine);
    saturate3(mix3(f0, splat3(1.0), p5) - b * (cosine * p6))
}

/// Cosine-weighted mean of [`fresnel_f82`]: the integrals of 2c(1 − c)⁵ and 2c²(1 − c)⁶
/// are 1/21 and 1/126.
#[inline(always)]
pub fn fresnel_mean_f82(f0: Vec3, b: Vec3) -> Vec3 {
    mix3(f0, splat3(1.0), 1.0 / 21.0) - b * (1.0 / 126.0)
}
