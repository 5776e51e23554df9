//! From a closure's rows to its lobes.

use glam::Vec3;
use matcha_shade::device::math::max;

use super::closure_albedo::{ClosureReflectance, closure_energy, closure_estimate};
use super::closure_glow::principled_emitted;
use super::closure_kind::{
    CLOSURE_BACKGROUND, CLOSURE_EMISSION, CLOSURE_HOLDOUT, CLOSURE_MODEL_MULTI_GGX,
    CLOSURE_MODEL_STEP, CLOSURE_PRINCIPLED, CLOSURE_ROW_WEIGHT, CLOSURE_TRANSPARENT,
    PRINCIPLED_ROW_ALPHA, PRINCIPLED_ROW_BASE_COLOR,
};
use super::closure_layer::{
    ClosureLayer, LAYER_COAT, LAYER_GLASS, LAYER_GLOSSY, LAYER_SHEEN, closure_layer_is_wanted,
    closure_layer_turns, closure_single_layer,
};
use super::closure_lobe::{
    ClosureContext, closure_counts, closure_lobe, closure_normal, closure_valid,
};
use super::closure_principled::{
    PRINCIPLED_COAT, PRINCIPLED_LAYERS, principled_below, principled_layer, principled_sheen_normal,
};
use super::closure_rows::{ClosureRows, closure_color, closure_share, closure_triple};
use super::closure_set::{LobeSet, closure_mean, closure_set_add_transparency, closure_set_push};
use super::closure_shape::{ClosurePlan, closure_shape};
use super::closure_tables::ClosureTables;
use super::lobe::{ClosureLobe, LOBE_BECKMANN, LOBE_GGX};
use super::lobe_microfacet::lobe_lambda;

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
    } else if family == CLOSURE_HOLDOUT {
        set.holdout += weight;
    } else if family == CLOSURE_TRANSPARENT {
        closure_set_add_transparency(set, weight);
    } else if family == CLOSURE_PRINCIPLED || context.scatter {
        closure_prepare_layers(kind, rows, tables, context, weight, set);
    }
}

/// Adds the lobes of a closure layer by layer.
#[inline]
pub fn closure_prepare_layers(
    kind: u32,
    rows: ClosureRows,
    tables: ClosureTables,
    context: ClosureContext,
    weight: Vec3,
    set: &mut LobeSet,
) {
    let principled = kind % CLOSURE_MODEL_STEP == CLOSURE_PRINCIPLED;
    let multiple = kind / CLOSURE_MODEL_STEP == CLOSURE_MODEL_MULTI_GGX;
    let mut left = weight;
    let mut base_color = Vec3::ZERO;
    let mut end = 1;
    if principled {
        end = PRINCIPLED_LAYERS;
        let alpha = closure_share(rows, PRINCIPLED_ROW_ALPHA);
        if alpha < 1.0 {
            closure_set_add_transparency(set, weight * (1.0 - alpha));
            left *= alpha;
        }
        base_color = closure_color(rows, PRINCIPLED_ROW_BASE_COLOR);
    }
    let mut number = 0;
    while number < end {
        let layer = if principled {
            principled_layer(rows, number, left, base_color, multiple)
        } else {
            closure_single_layer(kind, weight)
        };
        let counts =
            closure_layer_is_wanted(layer.form, context) && closure_counts(context, layer.weight);
        let mut normal = set.frame.n;
        let mut reflected = Vec3::ZERO;
        if counts || layer.form == LAYER_COAT {
            let bent = closure_normal(rows, layer.normal_row, set.frame.n);
            normal = closure_layer_normal(rows, layer, bent, set);
            if counts {
                let mut lobe = closure_lobe(set.frame, layer.kind, layer.weight, normal);
                let backfacing = set.frame.backfacing;
                let wo = set.frame.wo;
                let plan = closure_shape(
                    rows, tables, context, layer, backfacing, wo, bent, base_color, &mut lobe,
                );
                if plan.kept {
                    reflected = closure_keep(tables, context, layer.form, plan, &mut lobe, set);
                }
            }
        }
        if principled {
            left = principled_below(rows, set.frame, layer, normal, left, reflected);
            if number == PRINCIPLED_COAT {
                set.emission += principled_emitted(rows, left);
                if !context.scatter {
                    break;
                }
            }
        }
        number += 1;
    }
}

/// The normal of a layer whose rows say `bent`.
#[inline]
pub fn closure_layer_normal(
    rows: ClosureRows,
    layer: ClosureLayer,
    bent: Vec3,
    set: &LobeSet,
) -> Vec3 {
    let mut normal = bent;
    if closure_layer_turns(layer.form) {
        normal = closure_valid(set.frame, bent);
    } else if layer.principled && layer.form == LAYER_SHEEN {
        normal = principled_sheen_normal(rows, bent, set.frame.n);
    }
    normal
}

/// Completes a lobe and puts it into the set: weighs its sampling by what it reflects, gives back
/// the energy of multiple scattering where that is wanted, blurs it. Returns what it reflects,
/// with its weight.
#[inline]
pub fn closure_keep(
    tables: ClosureTables,
    context: ClosureContext,
    form: u32,
    plan: ClosurePlan,
    lobe: &mut ClosureLobe,
    set: &mut LobeSet,
) -> Vec3 {
    let fresnel = form >= LAYER_GLASS;
    let mut part = ClosureReflectance {
        reflected: Vec3::ZERO,
        transmitted: Vec3::ZERO,
    };
    if fresnel {
        part = closure_estimate(*lobe, tables);
        lobe.sample_weight *= closure_mean(part.reflected + part.transmitted);
    }
    if plan.multiple {
        let energy = closure_energy(*lobe, tables, plan.both, plan.tint);
        lobe.energy = energy.factor;
        lobe.weight *= energy.darkening;
        lobe.sample_weight *= closure_mean(energy.darkening);
    }
    let mut reflected = lobe.weight;
    let mut albedo = lobe.weight;
    if fresnel {
        reflected = lobe.weight * part.reflected;
        albedo = reflected + lobe.weight * part.transmitted;
    }
    if form >= LAYER_GLOSSY {
        lobe.alpha_x = max(lobe.alpha_x, context.blur);
        lobe.alpha_y = max(lobe.alpha_y, context.blur);
        if lobe.kind == LOBE_GGX || lobe.kind == LOBE_BECKMANN {
            lobe.lambda_wo = lobe_lambda(*lobe, set.frame.wo);
        }
    }
    closure_set_push(set, *lobe, albedo);
    reflected
}
