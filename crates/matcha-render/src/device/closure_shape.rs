//! What a lobe looks like: roughness, tangent, Fresnel factor.

// A list of what it needs is plainer than a struct for one call.
#![allow(clippy::too_many_arguments)]

use glam::Vec3;
use matcha_shade::device::math::{
    FRAC_1_PI, PI, abs, clamp, max, max3, min, min3, saturate, select, select_u32, splat3, sqrt,
    vec3,
};

use super::closure_albedo::closure_mean_remapped;
use super::closure_kind::{
    DIFFUSE_ROW_COLOR, GLASS_ROW_COLOR, GLASS_ROW_IOR, GLOSSY_ROW_ANISOTROPY, GLOSSY_ROW_COLOR,
    GLOSSY_ROW_ROTATION, GLOSSY_ROW_TANGENT, PRINCIPLED_ROW_ANISOTROPIC,
    PRINCIPLED_ROW_ANISOTROPIC_ROTATION, PRINCIPLED_ROW_COAT_IOR, PRINCIPLED_ROW_IOR,
    PRINCIPLED_ROW_SPECULAR_IOR_LEVEL, PRINCIPLED_ROW_SPECULAR_TINT, PRINCIPLED_ROW_TANGENT,
};
use super::closure_layer::{
    ClosureLayer, LAYER_COAT, LAYER_DIFFUSE, LAYER_GLASS, LAYER_GLOSSY, LAYER_METAL,
    LAYER_REFRACTION, LAYER_SHEEN, LAYER_SPECULAR, LAYER_TRANSMISSION, LAYER_VELVET,
};
use super::closure_lobe::{
    ClosureContext, closure_across, closure_facing_ior, closure_glass_sides, closure_turn,
};
use super::closure_rows::{
    ClosureRows, closure_color, closure_number, closure_share, closure_triple,
};
use super::closure_set::{CLOSURE_WEIGHT_CUTOFF, closure_black};
use super::closure_tables::{ClosureTables, closure_sheen_fit};
use super::fresnel::{
    FRESNEL_DIELECTRIC, FRESNEL_F82, FRESNEL_REMAPPED, fresnel_f0, fresnel_f82_coefficient,
    fresnel_ior_of_f0, fresnel_mean_dielectric, fresnel_mean_f82,
};
use super::lobe::{ClosureLobe, LOBE_ASHIKHMIN_SHIRLEY, LOBE_OREN_NAYAR};
use super::lobe_soft::lobe_oren_nayar_loss;

/// How a lobe is to be completed.
#[derive(Clone, Copy, Debug)]
pub struct ClosurePlan {
    /// There is a lobe.
    pub kept: bool,
    /// Energy of multiple scattering is given back.
    pub multiple: bool,
    /// The lobe is glass, not a reflection.
    pub both: bool,
    /// Colour of each further bounce.
    pub tint: Vec3,
}

/// Gives a lobe with neutral parameters those of its layer. `bent` is the normal that the rows
/// say, `base_color` a Principled closure's.
#[inline]
pub fn closure_shape(
    rows: ClosureRows,
    tables: ClosureTables,
    context: ClosureContext,
    layer: ClosureLayer,
    backfacing: bool,
    wo: Vec3,
    bent: Vec3,
    base_color: Vec3,
    lobe: &mut ClosureLobe,
) -> ClosurePlan {
    let form = layer.form;
    let mut plan = ClosurePlan {
        kept: true,
        multiple: false,
        both: false,
        tint: Vec3::ZERO,
    };
    let roughness = closure_share(rows, layer.roughness_row);
    // Where the tangent is to point.
    let mut along = lobe.tangent;
    let mut turns = false;
    if form == LAYER_DIFFUSE {
        closure_shape_diffuse(rows, layer.principled, roughness, base_color, lobe);
    } else if form == LAYER_VELVET {
        lobe.alpha_x = max(roughness, 0.01);
    } else if form == LAYER_SHEEN {
        let fit = closure_sheen_fit(tables, max(roughness, 1.0e-3), lobe.cos_wo);
        plan.kept = abs(fit.a) >= 1.0e-5 && fit.albedo >= 1.0e-5;
        lobe.alpha_x = fit.a;
        lobe.alpha_y = fit.b;
        lobe.weight *= fit.albedo;
        lobe.sample_weight *= fit.albedo;
        along = wo;
        turns = true;
    } else if form >= LAYER_GLOSSY {
        let alpha = roughness * roughness;
        lobe.alpha_x = alpha;
        lobe.alpha_y = alpha;
        if form == LAYER_GLOSSY || form == LAYER_METAL || form == LAYER_SPECULAR {
            turns = closure_shape_anisotropy(rows, form, alpha, lobe);
            if turns {
                along = closure_shape_tangent(rows, form, bent, lobe.normal);
            }
        }
        plan = closure_shape_fresnel(rows, context, layer, backfacing, base_color, lobe);
    }
    if turns {
        lobe.tangent = closure_across(lobe.normal, along, lobe.tangent);
    }
    plan
}

/// Makes Lambert Oren–Nayar where it is rough; its colour tints multiple scattering (OpenPBR 1.1,
/// section "Base substrate"; σ as Fujii's).
#[inline]
fn closure_shape_diffuse(
    rows: ClosureRows,
    principled: bool,
    roughness: f32,
    base_color: Vec3,
    lobe: &mut ClosureLobe,
) {
    let mut sigma = roughness;
    if principled && roughness < CLOSURE_WEIGHT_CUTOFF {
        sigma = 0.0;
    }
    if sigma > 0.0 {
        let color = if principled {
            base_color
        } else {
            closure_color(rows, DIFFUSE_ROW_COLOR)
        };
        let a = 1.0 / (PI + sigma * (core::f32::consts::FRAC_PI_2 - 2.0 / 3.0));
        let b = sigma * a;
        let tint = min3(color, splat3(1.0));
        let mean_albedo = a * PI + b * (2.0 * PI - 5.6) / 3.0;
        let lost = 1.0 - mean_albedo;
        let towards_wo = a * PI + b * lobe_oren_nayar_loss(max(lobe.cos_wo, 0.0));
        let series = tint * tint * (FRAC_1_PI * mean_albedo / lost) / (splat3(1.0) - tint * lost);
        lobe.kind = LOBE_OREN_NAYAR;
        lobe.lambda_wo = a;
        lobe.alpha_y = b;
        lobe.tint = series * (1.0 - towards_wo);
    }
}

/// Stretches a glossy lobe; true if its tangent matters.
#[inline]
fn closure_shape_anisotropy(
    rows: ClosureRows,
    form: u32,
    alpha: f32,
    lobe: &mut ClosureLobe,
) -> bool {
    let row = select_u32(
        PRINCIPLED_ROW_ANISOTROPIC,
        GLOSSY_ROW_ANISOTROPY,
        form == LAYER_GLOSSY,
    );
    let given = closure_number(rows, row);
    let mut matters = true;
    if form == LAYER_GLOSSY {
        let anisotropy = clamp(given, -0.99, 0.99);
        matters = abs(anisotropy) > 1.0e-4;
        if matters {
            // Positive values stretch the highlight along the tangent's bitangent.
            let small = 1.0 - abs(anisotropy);
            let large = 1.0 / small;
            lobe.alpha_x = alpha * select(small, large, anisotropy < 0.0);
            lobe.alpha_y = alpha * select(large, small, anisotropy < 0.0);
        }
        let phong = lobe.kind == LOBE_ASHIKHMIN_SHIRLEY;
        let least = select(0.0, 1.0e-4, phong);
        lobe.alpha_x = clamp(lobe.alpha_x, least, 1.0);
        lobe.alpha_y = clamp(lobe.alpha_y, least, 1.0);
    } else {
        let aspect = sqrt(1.0 - saturate(given) * 0.9);
        lobe.alpha_x = min(alpha / aspect, 1.0);
        lobe.alpha_y = min(alpha * aspect, 1.0);
    }
    matters
}

/// The tangent of the rows, turned around the normal.
#[inline]
fn closure_shape_tangent(rows: ClosureRows, form: u32, bent: Vec3, normal: Vec3) -> Vec3 {
    let mut rotation_row = PRINCIPLED_ROW_ANISOTROPIC_ROTATION;
    let mut tangent_row = PRINCIPLED_ROW_TANGENT;
    let mut axis = bent;
    if form == LAYER_GLOSSY {
        rotation_row = GLOSSY_ROW_ROTATION;
        tangent_row = GLOSSY_ROW_TANGENT;
        axis = normal;
    }
    let rotation = closure_number(rows, rotation_row);
    closure_turn(closure_triple(rows, tangent_row), axis, rotation)
}

/// The index of refraction of a layer, seen from the front.
#[inline]
fn closure_shape_ior(rows: ClosureRows, form: u32) -> f32 {
    let mut row = PRINCIPLED_ROW_IOR;
    let mut least = 1.0e-5;
    if form == LAYER_COAT {
        row = PRINCIPLED_ROW_COAT_IOR;
        least = 1.0;
    } else if form <= LAYER_GLASS {
        row = GLASS_ROW_IOR;
    }
    max(closure_number(rows, row), least)
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

/// Gives a glossy lobe its Fresnel factor.
#[inline]
fn closure_shape_fresnel(
    rows: ClosureRows,
    context: ClosureContext,
    layer: ClosureLayer,
    backfacing: bool,
    base_color: Vec3,
    lobe: &mut ClosureLobe,
) -> ClosurePlan {
    let form = layer.form;
    let mut plan = ClosurePlan {
        kept: true,
        multiple: layer.multiple && form != LAYER_REFRACTION,
        both: form == LAYER_GLASS || form == LAYER_TRANSMISSION,
        tint: Vec3::ZERO,
    };
    if plan.multiple && form <= LAYER_GLASS {
        let row = select_u32(GLASS_ROW_COLOR, GLOSSY_ROW_COLOR, form == LAYER_GLOSSY);
        plan.tint = closure_color(rows, row);
    }
    if form == LAYER_GLOSSY {
        return plan;
    }
    let mut specular_tint = splat3(1.0);
    if form >= LAYER_METAL {
        specular_tint = closure_color(rows, PRINCIPLED_ROW_SPECULAR_TINT);
    }
    if form == LAYER_METAL {
        lobe.fresnel = FRESNEL_F82;
        lobe.f0 = min3(base_color, splat3(1.0));
        lobe.tint = fresnel_f82_coefficient(lobe.f0, min3(specular_tint, splat3(1.0)));
        plan.tint = fresnel_mean_f82(lobe.f0, lobe.tint);
        return plan;
    }
    let ior = closure_shape_ior(rows, form);
    if form == LAYER_REFRACTION {
        lobe.ior = closure_facing_ior(backfacing, ior);
        lobe.reflects = 0.0;
        lobe.tint = splat3(1.0);
    } else if form == LAYER_COAT {
        lobe.ior = ior;
        lobe.fresnel = FRESNEL_DIELECTRIC;
        plan.tint = splat3(fresnel_mean_dielectric(ior));
    } else {
        let mut f0 = fresnel_f0(ior);
        if form == LAYER_SPECULAR {
            let given = closure_number(rows, PRINCIPLED_ROW_SPECULAR_IOR_LEVEL);
            let level = max(given, 0.0);
            lobe.fresnel = FRESNEL_REMAPPED;
            lobe.ior = principled_specular_ior(ior, level);
            if level != 0.5 {
                f0 *= 2.0 * level;
            }
            lobe.f0 = min3(max3(specular_tint * f0, Vec3::ZERO), splat3(1.0));
            plan.kept = lobe.ior != 1.0;
        } else {
            // Light passes the surface twice, so that each pass takes the root.
            let clamped = min3(base_color, splat3(1.0));
            let mut color = vec3(sqrt(clamped.x), sqrt(clamped.y), sqrt(clamped.z));
            if form == LAYER_GLASS {
                // The weight has the colour already.
                color = splat3(1.0);
            }
            closure_glass_sides(lobe, backfacing, context, ior, specular_tint * f0, color);
        }
        plan.tint = closure_shape_bounces(form, context, plan.tint, *lobe);
    }
    plan
}

/// Colour of further bounces in a lobe with a remapped Fresnel factor; `color` is a Glass
/// closure's own.
#[inline]
fn closure_shape_bounces(
    form: u32,
    context: ClosureContext,
    color: Vec3,
    lobe: ClosureLobe,
) -> Vec3 {
    let mean = closure_mean_remapped(lobe.ior, lobe.f0);
    if form == LAYER_GLASS {
        // They are tinted by transmission.
        if context.refractive_caustics {
            color
        } else {
            color * mean
        }
    } else if form == LAYER_TRANSMISSION && !closure_black(lobe.tint) {
        lobe.tint
    } else {
        mean
    }
}
