//! Lobes from a closure's parameters.

use glam::Vec3;
use matcha_shade::device::math::{
    FRAC_1_PI, PI, abs, cos, cross, dot, is_finite, max, max3, min3, saturate, select, sin, splat3,
};

use super::closure_albedo::{closure_energy, closure_estimate};
use super::closure_rows::{ClosureRows, closure_triple, closure_unit};
use super::closure_set::{CLOSURE_WEIGHT_CUTOFF, LobeSet, closure_mean, closure_set_push};
use super::closure_tables::{ClosureTables, closure_sheen_fit};
use super::fresnel::{FRESNEL_NONE, FRESNEL_REMAPPED};
use super::lobe::{
    ClosureFrame, ClosureLobe, LOBE_BECKMANN, LOBE_DIFFUSE, LOBE_GGX, LOBE_OREN_NAYAR, LOBE_SHEEN,
    LOBE_VELVET,
};
use super::lobe_microfacet::lobe_lambda;
use super::lobe_soft::lobe_oren_nayar_loss;
use super::mapping::mapping_frame;
use super::shading_normal::shading_normal_valid;

/// What the path so far means for a hit's closures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosureContext {
    /// α below which glossy lobes are blurred (Cycles' "filter glossy"), 0 to 0.5.
    pub blur: f32,
    /// Glossy reflection is wanted: the setting, or no diffuse bounce just before.
    pub reflective_caustics: bool,
    /// Likewise refraction.
    pub refractive_caustics: bool,
    /// Lobes are wanted; without, only emission, transparency and holdout are gathered
    /// (shadow rays, paths that end here).
    pub scatter: bool,
}

/// Multiple scattering of a lobe.
#[derive(Clone, Copy, Debug)]
pub struct ClosureMultiple {
    /// It is wanted.
    pub wanted: bool,
    /// The lobe is glass, not a reflection.
    pub both: bool,
    /// Colour of each further bounce.
    pub tint: Vec3,
}

/// A parameter's normal, unit; the shading normal where it is zero or not a number.
#[inline]
pub fn closure_normal(rows: ClosureRows, i: u32, shading_normal: Vec3) -> Vec3 {
    closure_unit(closure_triple(rows, i), shading_normal)
}

/// The normal that glossy lobes use for a parameter's normal.
#[inline]
pub fn closure_valid(frame: ClosureFrame, normal: Vec3) -> Vec3 {
    let flat = normal.x == frame.ng.x && normal.y == frame.ng.y && normal.z == frame.ng.z;
    if !frame.bump_correction || flat {
        normal
    } else {
        shading_normal_valid(frame.ng, frame.wo, normal)
    }
}

/// `v` turned around the unit vector `axis` by `turns` full turns (Rodrigues).
#[inline]
pub fn closure_turn(v: Vec3, axis: Vec3, turns: f32) -> Vec3 {
    if turns == 0.0 {
        v
    } else {
        let s = sin(turns * 2.0 * PI);
        let c = cos(turns * 2.0 * PI);
        v * c + cross(axis, v) * s + axis * (dot(axis, v) * (1.0 - c))
    }
}

/// Unit vector across the normal: the part of `v` that is, or any where there is none.
#[inline]
pub fn closure_across(normal: Vec3, v: Vec3) -> Vec3 {
    closure_unit(v - normal * dot(normal, v), mapping_frame(normal).x)
}

/// Whether a weight is large enough for a lobe.
#[inline]
pub fn closure_counts(context: ClosureContext, weight: Vec3) -> bool {
    let share = closure_mean(max3(weight, Vec3::ZERO));
    // This way round, so that what is not a number makes no lobe.
    context.scatter && share >= CLOSURE_WEIGHT_CUTOFF && is_finite(share)
}

/// A lobe with neutral parameters.
#[inline]
pub fn closure_lobe(frame: ClosureFrame, kind: u32, weight: Vec3, normal: Vec3) -> ClosureLobe {
    let positive = max3(weight, Vec3::ZERO);
    ClosureLobe {
        kind,
        fresnel: FRESNEL_NONE,
        reflects: 1.0,
        weight: positive,
        sample_weight: closure_mean(positive),
        normal,
        tangent: mapping_frame(normal).x,
        alpha_x: 1.0,
        alpha_y: 1.0,
        ior: 1.0,
        energy: 1.0,
        f0: Vec3::ZERO,
        tint: Vec3::ZERO,
        cos_wo: dot(normal, frame.wo),
        lambda_wo: 0.0,
    }
}

/// Makes a lobe a dielectric's two sides, of the index `ior` seen from the front.
#[inline]
pub fn closure_glass_sides(
    lobe: &mut ClosureLobe,
    backfacing: bool,
    context: ClosureContext,
    ior: f32,
    f0: Vec3,
    tint: Vec3,
) {
    lobe.ior = closure_facing_ior(backfacing, ior);
    lobe.fresnel = FRESNEL_REMAPPED;
    lobe.f0 = min3(max3(f0, Vec3::ZERO), splat3(1.0));
    lobe.reflects = select(0.0, 1.0, context.reflective_caustics);
    lobe.tint = tint * select(0.0, 1.0, context.refractive_caustics);
}

/// The index of refraction behind over in front, of the index seen from the front.
#[inline(always)]
pub fn closure_facing_ior(backfacing: bool, ior: f32) -> f32 {
    select(ior, 1.0 / ior, backfacing)
}

/// Blurs, completes and keeps a microfacet or Phong lobe.
#[inline]
pub fn closure_keep(
    set: &mut LobeSet,
    context: ClosureContext,
    mut lobe: ClosureLobe,
    albedo: Vec3,
) {
    lobe.alpha_x = max(lobe.alpha_x, context.blur);
    lobe.alpha_y = max(lobe.alpha_y, context.blur);
    if lobe.kind == LOBE_GGX || lobe.kind == LOBE_BECKMANN {
        lobe.lambda_wo = lobe_lambda(lobe, set.frame.wo);
    }
    closure_set_push(set, lobe, albedo);
}

/// Weighs sampling by the lobe's reflectance, gives back the energy of multiple scattering
/// where that is wanted, keeps the lobe, and returns what it reflects with its weight.
#[inline]
pub fn closure_keep_fresnel(
    set: &mut LobeSet,
    tables: ClosureTables,
    context: ClosureContext,
    mut lobe: ClosureLobe,
    multiple: ClosureMultiple,
) -> Vec3 {
    let reflectance = closure_estimate(lobe, tables);
    lobe.sample_weight *= closure_mean(reflectance.reflected + reflectance.transmitted);
    if multiple.wanted {
        let energy = closure_energy(lobe, tables, multiple.both, multiple.tint);
        lobe.energy = energy.factor;
        lobe.weight *= energy.darkening;
        lobe.sample_weight *= closure_mean(energy.darkening);
    }
    let reflected = lobe.weight * reflectance.reflected;
    let albedo = reflected + lobe.weight * reflectance.transmitted;
    closure_keep(set, context, lobe, albedo);
    reflected
}

/// Adds Lambert, on this side or through the surface.
#[inline]
pub fn closure_add_lambert(
    set: &mut LobeSet,
    context: ClosureContext,
    kind: u32,
    weight: Vec3,
    normal: Vec3,
) {
    if closure_counts(context, weight) {
        let lobe = closure_lobe(set.frame, kind, weight, normal);
        closure_set_push(set, lobe, lobe.weight);
    }
}

/// Adds Lambert, or Oren–Nayar where `roughness` is above zero; `color` tints its multiple
/// scattering (OpenPBR 1.1, section "Base substrate"; σ as Fujii's).
pub fn closure_add_diffuse(
    set: &mut LobeSet,
    context: ClosureContext,
    weight: Vec3,
    roughness: f32,
    normal: Vec3,
    color: Vec3,
) {
    if closure_counts(context, weight) {
        let mut lobe = closure_lobe(set.frame, LOBE_DIFFUSE, weight, normal);
        let sigma = saturate(roughness);
        if sigma > 0.0 {
            let a = 1.0 / (PI + sigma * (core::f32::consts::FRAC_PI_2 - 2.0 / 3.0));
            let b = sigma * a;
            let tint = min3(max3(color, Vec3::ZERO), splat3(1.0));
            let mean_albedo = a * PI + b * (2.0 * PI - 5.6) / 3.0;
            let lost = 1.0 - mean_albedo;
            let towards_wo = a * PI + b * lobe_oren_nayar_loss(max(lobe.cos_wo, 0.0));
            let series =
                tint * tint * (FRAC_1_PI * mean_albedo / lost) / (splat3(1.0) - tint * lost);
            lobe.kind = LOBE_OREN_NAYAR;
            lobe.lambda_wo = a;
            lobe.alpha_y = b;
            lobe.tint = series * (1.0 - towards_wo);
        }
        closure_set_push(set, lobe, lobe.weight);
    }
}

/// Adds velvet.
pub fn closure_add_velvet(
    set: &mut LobeSet,
    context: ClosureContext,
    weight: Vec3,
    roughness: f32,
    normal: Vec3,
) {
    if closure_counts(context, weight) {
        let mut lobe = closure_lobe(set.frame, LOBE_VELVET, weight, normal);
        lobe.alpha_x = max(saturate(roughness), 0.01);
        closure_set_push(set, lobe, lobe.weight);
    }
}

/// Adds sheen; returns what it reflects with its weight, 0 where it vanishes.
pub fn closure_add_sheen(
    set: &mut LobeSet,
    tables: ClosureTables,
    context: ClosureContext,
    weight: Vec3,
    roughness: f32,
    normal: Vec3,
) -> Vec3 {
    let mut reflected = Vec3::ZERO;
    if closure_counts(context, weight) {
        let mut lobe = closure_lobe(set.frame, LOBE_SHEEN, weight, normal);
        let fit = closure_sheen_fit(tables, max(saturate(roughness), 1.0e-3), lobe.cos_wo);
        if abs(fit.a) >= 1.0e-5 && fit.albedo >= 1.0e-5 {
            lobe.alpha_x = fit.a;
            lobe.alpha_y = fit.b;
            lobe.weight *= fit.albedo;
            lobe.sample_weight *= fit.albedo;
            lobe.tangent = closure_across(normal, set.frame.wo);
            reflected = lobe.weight;
            closure_set_push(set, lobe, lobe.weight);
        }
    }
    reflected
}
