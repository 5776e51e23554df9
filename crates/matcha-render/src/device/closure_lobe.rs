//! Lobes from a closure's parameters.

use glam::Vec3;
use matcha_shade::device::math::{PI, cos, cross, dot, is_finite, max3, min3, select, sin, splat3};

use super::closure_rows::{ClosureRows, closure_triple, closure_unit};
use super::closure_set::{CLOSURE_WEIGHT_CUTOFF, closure_mean};
use super::fresnel::{FRESNEL_NONE, FRESNEL_REMAPPED};
use super::lobe::{ClosureFrame, ClosureLobe};
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

/// Unit vector across the normal: the part of `v` that is, or `otherwise` where there is none.
#[inline]
pub fn closure_across(normal: Vec3, v: Vec3, otherwise: Vec3) -> Vec3 {
    closure_unit(v - normal * dot(normal, v), otherwise)
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
