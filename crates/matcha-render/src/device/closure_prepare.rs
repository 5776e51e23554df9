//! From a closure's rows to its lobes.

use glam::Vec3;
use matcha_shade::device::math::{abs, clamp, max, max3, saturate, select, splat3};

use super::closure_albedo::{closure_energy, closure_mean_remapped};
use super::closure_kind::{
    CLOSURE_BACKGROUND, CLOSURE_DIFFUSE, CLOSURE_EMISSION, CLOSURE_GLASS, CLOSURE_GLOSSY,
    CLOSURE_HOLDOUT, CLOSURE_MODEL_ASHIKHMIN, CLOSURE_MODEL_ASHIKHMIN_SHIRLEY,
    CLOSURE_MODEL_BECKMANN, CLOSURE_MODEL_MULTI_GGX, CLOSURE_MODEL_STEP, CLOSURE_PRINCIPLED,
    CLOSURE_REFRACTION, CLOSURE_ROW_WEIGHT, CLOSURE_SHEEN, CLOSURE_SUBSURFACE, CLOSURE_TRANSLUCENT,
    CLOSURE_TRANSPARENT, DIFFUSE_ROW_COLOR, DIFFUSE_ROW_NORMAL, DIFFUSE_ROW_ROUGHNESS,
    GLASS_ROW_COLOR, GLASS_ROW_IOR, GLASS_ROW_NORMAL, GLASS_ROW_ROUGHNESS, GLOSSY_ROW_ANISOTROPY,
    GLOSSY_ROW_COLOR, GLOSSY_ROW_NORMAL, GLOSSY_ROW_ROTATION, GLOSSY_ROW_ROUGHNESS,
    GLOSSY_ROW_TANGENT, NORMAL_ROW_NORMAL, SUBSURFACE_ROW_NORMAL,
};
use super::closure_lobe::{
    ClosureContext, ClosureMultiple, closure_across, closure_add_diffuse, closure_add_lambert,
    closure_add_sheen, closure_add_velvet, closure_counts, closure_facing_ior, closure_glass_sides,
    closure_keep, closure_keep_fresnel, closure_lobe, closure_normal, closure_turn, closure_valid,
};
use super::closure_principled::closure_add_principled;
use super::closure_rows::{ClosureRows, closure_number, closure_triple};
use super::closure_set::{LobeSet, closure_mean, closure_set_add_transparency};
use super::closure_tables::ClosureTables;
use super::fresnel::fresnel_f0;
use super::lobe::{
    ClosureLobe, LOBE_ASHIKHMIN_SHIRLEY, LOBE_BECKMANN, LOBE_DIFFUSE, LOBE_GGX, LOBE_TRANSLUCENT,
};

/// Adds the lobes of one closure to `set`, which must have been begun.
///
/// `kind` is the closure's code. `rows` are its weight and parameters as
/// `matcha_shade::closure` lays them out. Numbers that are not finite count as 0, and a
/// normal of length 0 becomes the shading normal.
pub fn closure_prepare(
    kind: u32,
    rows: ClosureRows,
    tables: ClosureTables,
    context: ClosureContext,
    set: &mut LobeSet,
) {
    let family = kind % CLOSURE_MODEL_STEP;
    let weight = closure_triple(rows, CLOSURE_ROW_WEIGHT);
    if family == CLOSURE_EMISSION || family == CLOSURE_BACKGROUND {
        set.emission += weight;
    } else if family == CLOSURE_TRANSPARENT {
        closure_set_add_transparency(set, weight);
    } else if family == CLOSURE_HOLDOUT {
        set.holdout += weight;
    } else if family == CLOSURE_PRINCIPLED {
        let multiple = kind / CLOSURE_MODEL_STEP == CLOSURE_MODEL_MULTI_GGX;
        closure_add_principled(rows, tables, context, multiple, set);
    } else if context.scatter {
        closure_prepare_lobe(kind, rows, tables, context, set);
    }
}

/// A parameter's normal, turned as glossy lobes need it.
#[inline]
pub fn closure_valid_normal(rows: ClosureRows, i: u32, set: &LobeSet) -> Vec3 {
    closure_valid(set.frame, closure_normal(rows, i, set.frame.n))
}

/// Adds the lobes of a closure that does nothing but scatter. The shading normal has none:
/// it is in the frame already.
#[inline]
pub fn closure_prepare_lobe(
    kind: u32,
    rows: ClosureRows,
    tables: ClosureTables,
    context: ClosureContext,
    set: &mut LobeSet,
) {
    let family = kind % CLOSURE_MODEL_STEP;
    let model = kind / CLOSURE_MODEL_STEP;
    let weight = closure_triple(rows, CLOSURE_ROW_WEIGHT);
    if family == CLOSURE_DIFFUSE {
        let roughness = closure_number(rows, DIFFUSE_ROW_ROUGHNESS);
        let normal = closure_normal(rows, DIFFUSE_ROW_NORMAL, set.frame.n);
        let color = closure_triple(rows, DIFFUSE_ROW_COLOR);
        closure_add_diffuse(set, context, weight, roughness, normal, color);
    } else if family == CLOSURE_TRANSLUCENT {
        let normal = closure_valid_normal(rows, NORMAL_ROW_NORMAL, set);
        closure_add_lambert(set, context, LOBE_TRANSLUCENT, weight, normal);
    } else if family == CLOSURE_SUBSURFACE {
        let normal = closure_valid_normal(rows, SUBSURFACE_ROW_NORMAL, set);
        closure_add_lambert(set, context, LOBE_DIFFUSE, weight, normal);
    } else if family == CLOSURE_SHEEN {
        closure_prepare_sheen(model, rows, tables, context, set);
    } else if family == CLOSURE_GLOSSY {
        closure_prepare_glossy(model, rows, tables, context, set);
    } else if family == CLOSURE_GLASS {
        closure_prepare_glass(model, rows, tables, context, set);
    } else if family == CLOSURE_REFRACTION {
        closure_prepare_refraction(model, rows, context, set);
    }
}

/// Lobe of a microfacet model.
#[inline(always)]
pub fn closure_distribution(model: u32) -> u32 {
    if model == CLOSURE_MODEL_BECKMANN {
        LOBE_BECKMANN
    } else if model == CLOSURE_MODEL_ASHIKHMIN_SHIRLEY {
        LOBE_ASHIKHMIN_SHIRLEY
    } else {
        LOBE_GGX
    }
}

#[inline]
fn closure_prepare_sheen(
    model: u32,
    rows: ClosureRows,
    tables: ClosureTables,
    context: ClosureContext,
    set: &mut LobeSet,
) {
    let weight = closure_triple(rows, CLOSURE_ROW_WEIGHT);
    let roughness = closure_number(rows, DIFFUSE_ROW_ROUGHNESS);
    let normal = closure_normal(rows, DIFFUSE_ROW_NORMAL, set.frame.n);
    if model == CLOSURE_MODEL_ASHIKHMIN {
        closure_add_velvet(set, context, weight, roughness, normal);
    } else {
        let _reflected = closure_add_sheen(set, tables, context, weight, roughness, normal);
    }
}

#[inline]
fn closure_prepare_glossy(
    model: u32,
    rows: ClosureRows,
    tables: ClosureTables,
    context: ClosureContext,
    set: &mut LobeSet,
) {
    let weight = closure_triple(rows, CLOSURE_ROW_WEIGHT);
    if context.reflective_caustics && closure_counts(context, weight) {
        let normal = closure_valid_normal(rows, GLOSSY_ROW_NORMAL, set);
        let mut lobe = closure_lobe(set.frame, closure_distribution(model), weight, normal);
        closure_glossy_shape(&mut lobe, rows);
        let phong = model == CLOSURE_MODEL_ASHIKHMIN_SHIRLEY;
        let least = select(0.0, 1.0e-4, phong);
        lobe.alpha_x = clamp(lobe.alpha_x, least, 1.0);
        lobe.alpha_y = clamp(lobe.alpha_y, least, 1.0);
        if model == CLOSURE_MODEL_MULTI_GGX {
            let tint = max3(closure_triple(rows, GLOSSY_ROW_COLOR), Vec3::ZERO);
            let energy = closure_energy(lobe, tables, false, tint);
            lobe.energy = energy.factor;
            lobe.weight *= energy.darkening;
            lobe.sample_weight *= closure_mean(energy.darkening);
        }
        closure_keep(set, context, lobe, lobe.weight);
    }
}

/// Roughness and tangent of a Glossy closure.
#[inline]
fn closure_glossy_shape(lobe: &mut ClosureLobe, rows: ClosureRows) {
    let roughness = saturate(closure_number(rows, GLOSSY_ROW_ROUGHNESS));
    let anisotropy = clamp(closure_number(rows, GLOSSY_ROW_ANISOTROPY), -0.99, 0.99);
    let alpha = roughness * roughness;
    if abs(anisotropy) > 1.0e-4 {
        let rotation = closure_number(rows, GLOSSY_ROW_ROTATION);
        let tangent = closure_triple(rows, GLOSSY_ROW_TANGENT);
        let turned = closure_turn(tangent, lobe.normal, rotation);
        lobe.tangent = closure_across(lobe.normal, turned);
        // Positive values stretch the highlight along the tangent's bitangent.
        let small = 1.0 - abs(anisotropy);
        let large = 1.0 / small;
        lobe.alpha_x = alpha * select(small, large, anisotropy < 0.0);
        lobe.alpha_y = alpha * select(large, small, anisotropy < 0.0);
    } else {
        lobe.alpha_x = alpha;
        lobe.alpha_y = alpha;
    }
}

#[inline]
fn closure_prepare_glass(
    model: u32,
    rows: ClosureRows,
    tables: ClosureTables,
    context: ClosureContext,
    set: &mut LobeSet,
) {
    let weight = closure_triple(rows, CLOSURE_ROW_WEIGHT);
    let wanted = context.reflective_caustics || context.refractive_caustics;
    if wanted && closure_counts(context, weight) {
        let roughness = saturate(closure_number(rows, GLASS_ROW_ROUGHNESS));
        let ior = max(closure_number(rows, GLASS_ROW_IOR), 1.0e-5);
        let normal = closure_valid_normal(rows, GLASS_ROW_NORMAL, set);
        let mut lobe = closure_lobe(set.frame, closure_distribution(model), weight, normal);
        lobe.alpha_x = roughness * roughness;
        lobe.alpha_y = roughness * roughness;
        let f0 = splat3(fresnel_f0(ior));
        let backfacing = set.frame.backfacing;
        closure_glass_sides(&mut lobe, backfacing, context, ior, f0, splat3(1.0));
        // The weight has the colour already; further bounces are tinted by transmission.
        let multiple = model == CLOSURE_MODEL_MULTI_GGX;
        let mut tint = Vec3::ZERO;
        if multiple {
            tint = max3(closure_triple(rows, GLASS_ROW_COLOR), Vec3::ZERO);
            if !context.refractive_caustics {
                tint *= closure_mean_remapped(lobe.ior, lobe.f0);
            }
        }
        let bounces = ClosureMultiple {
            wanted: multiple,
            both: true,
            tint,
        };
        let _reflected = closure_keep_fresnel(set, tables, context, lobe, bounces);
    }
}

#[inline]
fn closure_prepare_refraction(
    model: u32,
    rows: ClosureRows,
    context: ClosureContext,
    set: &mut LobeSet,
) {
    let weight = closure_triple(rows, CLOSURE_ROW_WEIGHT);
    if context.refractive_caustics && closure_counts(context, weight) {
        let roughness = saturate(closure_number(rows, GLASS_ROW_ROUGHNESS));
        let ior = max(closure_number(rows, GLASS_ROW_IOR), 1.0e-5);
        let normal = closure_valid_normal(rows, GLASS_ROW_NORMAL, set);
        let mut lobe = closure_lobe(set.frame, closure_distribution(model), weight, normal);
        lobe.alpha_x = roughness * roughness;
        lobe.alpha_y = roughness * roughness;
        lobe.ior = closure_facing_ior(set.frame.backfacing, ior);
        lobe.reflects = 0.0;
        lobe.tint = splat3(1.0);
        closure_keep(set, context, lobe, lobe.weight);
    }
}
