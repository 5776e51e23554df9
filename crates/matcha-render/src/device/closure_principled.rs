//! The Principled closure, version 2: layers from the top down, each taking from what is
//! below the light that it reflects. Order and scalings are those of Cycles in Blender 4.5
//! ("Principled BSDF"). Subsurface scattering is rendered as diffuse reflection, thin films
//! not at all.
//!
//! Parameters are read where they are needed: registers are dearer than rows.

use glam::Vec3;
use matcha_shade::device::math::{max, max3, min, min3, saturate, splat3, sqrt, vec3};

use super::closure_albedo::closure_mean_remapped;
use super::closure_glow::{principled_coat_ior, principled_emitted, principled_tinted};
use super::closure_kind::{
    CLOSURE_ROW_WEIGHT, PRINCIPLED_ROW_ALPHA, PRINCIPLED_ROW_ANISOTROPIC,
    PRINCIPLED_ROW_ANISOTROPIC_ROTATION, PRINCIPLED_ROW_BASE_COLOR, PRINCIPLED_ROW_COAT_NORMAL,
    PRINCIPLED_ROW_COAT_ROUGHNESS, PRINCIPLED_ROW_COAT_WEIGHT, PRINCIPLED_ROW_DIFFUSE_ROUGHNESS,
    PRINCIPLED_ROW_IOR, PRINCIPLED_ROW_METALLIC, PRINCIPLED_ROW_NORMAL, PRINCIPLED_ROW_ROUGHNESS,
    PRINCIPLED_ROW_SHEEN_ROUGHNESS, PRINCIPLED_ROW_SHEEN_TINT, PRINCIPLED_ROW_SHEEN_WEIGHT,
    PRINCIPLED_ROW_SPECULAR_IOR_LEVEL, PRINCIPLED_ROW_SPECULAR_TINT,
    PRINCIPLED_ROW_SUBSURFACE_WEIGHT, PRINCIPLED_ROW_TANGENT, PRINCIPLED_ROW_TRANSMISSION_WEIGHT,
};
use super::closure_lobe::{
    ClosureContext, ClosureMultiple, closure_across, closure_add_diffuse, closure_add_lambert,
    closure_add_sheen, closure_counts, closure_glass_sides, closure_keep_fresnel, closure_lobe,
    closure_normal, closure_turn, closure_valid,
};
use super::closure_rows::{
    ClosureRows, closure_color, closure_number, closure_share, closure_triple, closure_unit,
};
use super::closure_set::{
    CLOSURE_WEIGHT_CUTOFF, LobeSet, closure_black, closure_set_add_transparency,
};
use super::closure_tables::ClosureTables;
use super::fresnel::{
    FRESNEL_DIELECTRIC, FRESNEL_F82, FRESNEL_REMAPPED, fresnel_f0, fresnel_f82_coefficient,
    fresnel_ior_of_f0, fresnel_mean_dielectric, fresnel_mean_f82,
};
use super::lobe::{ClosureLobe, LOBE_DIFFUSE, LOBE_GGX};

/// The index of refraction.
#[inline(always)]
fn principled_ior(rows: ClosureRows) -> f32 {
    max(closure_number(rows, PRINCIPLED_ROW_IOR), 1.0e-5)
}

/// What is left of `weight` under a layer that reflects `reflected` of it.
#[inline]
pub fn principled_under(weight: Vec3, reflected: Vec3) -> Vec3 {
    let x = principled_fraction(reflected.x, weight.x);
    let y = principled_fraction(reflected.y, weight.y);
    let z = principled_fraction(reflected.z, weight.z);
    weight * saturate(1.0 - max(max(x, y), z))
}

/// Quotient; 0 where nothing can be reflected.
#[inline(always)]
pub fn principled_fraction(reflected: f32, weight: f32) -> f32 {
    if weight != 0.0 {
        reflected / weight
    } else {
        0.0
    }
}

/// Adds the lobes of a Principled closure. `multiple`: energy of multiple scattering is
/// given back.
pub fn closure_add_principled(
    rows: ClosureRows,
    tables: ClosureTables,
    context: ClosureContext,
    multiple: bool,
    set: &mut LobeSet,
) {
    let mut weight = closure_triple(rows, CLOSURE_ROW_WEIGHT);
    let alpha = closure_share(rows, PRINCIPLED_ROW_ALPHA);
    if alpha < 1.0 {
        closure_set_add_transparency(set, weight * (1.0 - alpha));
        weight *= alpha;
    }
    weight = principled_sheen(rows, tables, context, weight, set);
    weight = principled_coat(rows, tables, context, weight, set);
    set.emission += principled_emitted(rows, weight);
    if context.scatter {
        principled_base(rows, tables, context, multiple, weight, set);
    }
}

/// Everything below the coat.
#[inline]
fn principled_base(
    rows: ClosureRows,
    tables: ClosureTables,
    context: ClosureContext,
    multiple: bool,
    arriving: Vec3,
    set: &mut LobeSet,
) {
    let mut weight = arriving;
    let bent = closure_normal(rows, PRINCIPLED_ROW_NORMAL, set.frame.n);
    let normal = closure_valid(set.frame, bent);
    let metallic = closure_share(rows, PRINCIPLED_ROW_METALLIC);
    if metallic > CLOSURE_WEIGHT_CUTOFF {
        let share = weight * metallic;
        principled_metal(rows, tables, context, multiple, share, normal, set);
        weight *= 1.0 - metallic;
    }
    let transmission = closure_share(rows, PRINCIPLED_ROW_TRANSMISSION_WEIGHT);
    if transmission > CLOSURE_WEIGHT_CUTOFF {
        let share = weight * transmission;
        principled_transmission(rows, tables, context, multiple, share, normal, set);
        weight *= 1.0 - transmission;
    }
    weight = principled_specular(rows, tables, context, multiple, weight, normal, set);
    let base_color = closure_color(rows, PRINCIPLED_ROW_BASE_COLOR);
    let subsurface = closure_share(rows, PRINCIPLED_ROW_SUBSURFACE_WEIGHT);
    let inside = min3(base_color, splat3(1.0)) * weight * subsurface;
    closure_add_lambert(set, context, LOBE_DIFFUSE, inside, normal);
    let rest = base_color * weight * (1.0 - subsurface);
    let set_roughness = closure_share(rows, PRINCIPLED_ROW_DIFFUSE_ROUGHNESS);
    let rough = if set_roughness < CLOSURE_WEIGHT_CUTOFF {
        0.0
    } else {
        set_roughness
    };
    closure_add_diffuse(set, context, rest, rough, bent, base_color);
}

/// The sheen on top; returns what is left below.
#[inline]
fn principled_sheen(
    rows: ClosureRows,
    tables: ClosureTables,
    context: ClosureContext,
    weight: Vec3,
    set: &mut LobeSet,
) -> Vec3 {
    let mut left = weight;
    let sheen = max(closure_number(rows, PRINCIPLED_ROW_SHEEN_WEIGHT), 0.0);
    if sheen > CLOSURE_WEIGHT_CUTOFF {
        let coat = closure_share(rows, PRINCIPLED_ROW_COAT_WEIGHT);
        let base = closure_normal(rows, PRINCIPLED_ROW_NORMAL, set.frame.n);
        let top = closure_normal(rows, PRINCIPLED_ROW_COAT_NORMAL, set.frame.n);
        let normal = closure_unit(base * (1.0 - coat) + top * coat, set.frame.n);
        let tinted = closure_color(rows, PRINCIPLED_ROW_SHEEN_TINT) * weight * sheen;
        let roughness = closure_share(rows, PRINCIPLED_ROW_SHEEN_ROUGHNESS);
        let reflected = closure_add_sheen(set, tables, context, tinted, roughness, normal);
        if !closure_black(reflected) {
            left = principled_under(weight, reflected);
        }
    }
    left
}

/// The clear coat; returns what is left below.
#[inline]
fn principled_coat(
    rows: ClosureRows,
    tables: ClosureTables,
    context: ClosureContext,
    weight: Vec3,
    set: &mut LobeSet,
) -> Vec3 {
    let mut left = weight;
    let coat = max(closure_number(rows, PRINCIPLED_ROW_COAT_WEIGHT), 0.0);
    if coat > CLOSURE_WEIGHT_CUTOFF {
        let ior = principled_coat_ior(rows);
        let bent = closure_normal(rows, PRINCIPLED_ROW_COAT_NORMAL, set.frame.n);
        let normal = closure_valid(set.frame, bent);
        if context.reflective_caustics && closure_counts(context, weight * coat) {
            let mut lobe = closure_lobe(set.frame, LOBE_GGX, weight * coat, normal);
            let roughness = closure_share(rows, PRINCIPLED_ROW_COAT_ROUGHNESS);
            lobe.ior = ior;
            lobe.fresnel = FRESNEL_DIELECTRIC;
            lobe.alpha_x = roughness * roughness;
            lobe.alpha_y = lobe.alpha_x;
            let bounces = ClosureMultiple {
                wanted: true,
                both: false,
                tint: splat3(fresnel_mean_dielectric(ior)),
            };
            let reflected = closure_keep_fresnel(set, tables, context, lobe, bounces);
            left = principled_under(weight, reflected);
        }
        left = principled_tinted(rows, set.frame, normal, left);
    }
    left
}

/// Roughness and tangent of the metal and of the specular layer.
#[inline]
fn principled_shape(lobe: &mut ClosureLobe, rows: ClosureRows, shading_normal: Vec3) {
    let roughness = closure_share(rows, PRINCIPLED_ROW_ROUGHNESS);
    let anisotropic = closure_share(rows, PRINCIPLED_ROW_ANISOTROPIC);
    let alpha = roughness * roughness;
    let aspect = sqrt(1.0 - anisotropic * 0.9);
    lobe.alpha_x = min(alpha / aspect, 1.0);
    lobe.alpha_y = min(alpha * aspect, 1.0);
    let bent = closure_normal(rows, PRINCIPLED_ROW_NORMAL, shading_normal);
    let rotation = closure_number(rows, PRINCIPLED_ROW_ANISOTROPIC_ROTATION);
    let tangent = closure_triple(rows, PRINCIPLED_ROW_TANGENT);
    lobe.tangent = closure_across(lobe.normal, closure_turn(tangent, bent, rotation));
}

#[inline]
fn principled_metal(
    rows: ClosureRows,
    tables: ClosureTables,
    context: ClosureContext,
    multiple: bool,
    weight: Vec3,
    normal: Vec3,
    set: &mut LobeSet,
) {
    if context.reflective_caustics && closure_counts(context, weight) {
        let mut lobe = closure_lobe(set.frame, LOBE_GGX, weight, normal);
        principled_shape(&mut lobe, rows, set.frame.n);
        let edge = closure_color(rows, PRINCIPLED_ROW_SPECULAR_TINT);
        let base_color = closure_color(rows, PRINCIPLED_ROW_BASE_COLOR);
        lobe.fresnel = FRESNEL_F82;
        lobe.f0 = min3(base_color, splat3(1.0));
        lobe.tint = fresnel_f82_coefficient(lobe.f0, min3(edge, splat3(1.0)));
        let bounces = ClosureMultiple {
            wanted: multiple,
            both: false,
            tint: fresnel_mean_f82(lobe.f0, lobe.tint),
        };
        let _reflected = closure_keep_fresnel(set, tables, context, lobe, bounces);
    }
}

#[inline]
fn principled_transmission(
    rows: ClosureRows,
    tables: ClosureTables,
    context: ClosureContext,
    multiple: bool,
    weight: Vec3,
    normal: Vec3,
    set: &mut LobeSet,
) {
    let wanted = context.reflective_caustics || context.refractive_caustics;
    if wanted && closure_counts(context, weight) {
        let mut lobe = closure_lobe(set.frame, LOBE_GGX, weight, normal);
        let roughness = closure_share(rows, PRINCIPLED_ROW_ROUGHNESS);
        lobe.alpha_x = roughness * roughness;
        lobe.alpha_y = lobe.alpha_x;
        let base_color = closure_color(rows, PRINCIPLED_ROW_BASE_COLOR);
        let clamped = min3(base_color, splat3(1.0));
        // Light passes the surface twice, so that each pass takes the root.
        let color = vec3(sqrt(clamped.x), sqrt(clamped.y), sqrt(clamped.z));
        let ior = principled_ior(rows);
        let f0 = closure_color(rows, PRINCIPLED_ROW_SPECULAR_TINT) * fresnel_f0(ior);
        let backfacing = set.frame.backfacing;
        closure_glass_sides(&mut lobe, backfacing, context, ior, f0, color);
        let tint = if closure_black(lobe.tint) {
            closure_mean_remapped(lobe.ior, lobe.f0)
        } else {
            lobe.tint
        };
        let bounces = ClosureMultiple {
            wanted: multiple,
            both: true,
            tint,
        };
        let _reflected = closure_keep_fresnel(set, tables, context, lobe, bounces);
    }
}

/// The index of refraction of the specular layer, which its level changes.
#[inline]
fn principled_specular_ior(ior: f32, level: f32) -> f32 {
    let mut changed = ior;
    if level != 0.5 {
        changed = fresnel_ior_of_f0(fresnel_f0(ior) * (2.0 * level));
        if ior < 1.0 {
            changed = 1.0 / changed;
        }
    }
    changed
}

/// The dielectric surface over the diffuse base; returns what is left below.
#[inline]
fn principled_specular(
    rows: ClosureRows,
    tables: ClosureTables,
    context: ClosureContext,
    multiple: bool,
    weight: Vec3,
    normal: Vec3,
    set: &mut LobeSet,
) -> Vec3 {
    let mut left = weight;
    let level = max(closure_number(rows, PRINCIPLED_ROW_SPECULAR_IOR_LEVEL), 0.0);
    let ior = principled_specular_ior(principled_ior(rows), level);
    let wanted = context.reflective_caustics && ior != 1.0;
    if wanted && closure_counts(context, weight) {
        let mut lobe = closure_lobe(set.frame, LOBE_GGX, weight, normal);
        principled_shape(&mut lobe, rows, set.frame.n);
        let mut f0 = fresnel_f0(principled_ior(rows));
        if level != 0.5 {
            f0 *= 2.0 * level;
        }
        let tint = closure_color(rows, PRINCIPLED_ROW_SPECULAR_TINT);
        lobe.fresnel = FRESNEL_REMAPPED;
        lobe.ior = ior;
        lobe.f0 = min3(max3(tint * f0, Vec3::ZERO), splat3(1.0));
        let bounces = ClosureMultiple {
            wanted: multiple,
            both: false,
            tint: closure_mean_remapped(ior, lobe.f0),
        };
        let reflected = closure_keep_fresnel(set, tables, context, lobe, bounces);
        left = principled_under(weight, reflected);
    }
    left
}
