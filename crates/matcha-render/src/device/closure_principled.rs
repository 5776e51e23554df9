//! The Principled closure, version 2: layers from the top down, each taking from what is
//! below the light that it reflects. Order and scalings are those of Cycles in Blender 4.5
//! ("Principled BSDF"). Subsurface scattering is rendered as diffuse reflection, thin films
//! not at all.
//!
//! Parameters are read where they are needed: registers are dearer than rows.

use glam::Vec3;
use matcha_shade::device::math::{max, min3, saturate, splat3};

use super::closure_glow::principled_tinted;
use super::closure_kind::{
    PRINCIPLED_ROW_COAT_NORMAL, PRINCIPLED_ROW_COAT_ROUGHNESS, PRINCIPLED_ROW_COAT_WEIGHT,
    PRINCIPLED_ROW_DIFFUSE_ROUGHNESS, PRINCIPLED_ROW_METALLIC, PRINCIPLED_ROW_NORMAL,
    PRINCIPLED_ROW_ROUGHNESS, PRINCIPLED_ROW_SHEEN_ROUGHNESS, PRINCIPLED_ROW_SHEEN_TINT,
    PRINCIPLED_ROW_SHEEN_WEIGHT, PRINCIPLED_ROW_SUBSURFACE_WEIGHT,
    PRINCIPLED_ROW_TRANSMISSION_WEIGHT,
};
use super::closure_layer::{
    ClosureLayer, LAYER_COAT, LAYER_DIFFUSE, LAYER_LAMBERT, LAYER_METAL, LAYER_NONE, LAYER_SHEEN,
    LAYER_SPECULAR, LAYER_TRANSMISSION,
};
use super::closure_lobe::closure_normal;
use super::closure_rows::{
    ClosureRows, closure_color, closure_number, closure_share, closure_unit,
};
use super::closure_set::{CLOSURE_WEIGHT_CUTOFF, closure_black};
use super::lobe::{ClosureFrame, LOBE_DIFFUSE, LOBE_GGX, LOBE_SHEEN};

/// Layers from the top down: first the sheen.
pub const PRINCIPLED_SHEEN: u32 = 0;
/// The coat.
pub const PRINCIPLED_COAT: u32 = 1;
/// Metal.
pub const PRINCIPLED_METAL: u32 = 2;
/// Glass.
pub const PRINCIPLED_TRANSMISSION: u32 = 3;
/// The dielectric surface.
pub const PRINCIPLED_SPECULAR: u32 = 4;
/// Subsurface scattering.
pub const PRINCIPLED_SUBSURFACE: u32 = 5;
/// The diffuse base.
pub const PRINCIPLED_DIFFUSE: u32 = 6;
/// Number of layers.
pub const PRINCIPLED_LAYERS: u32 = 7;

/// Row of the number that says how much of a layer there is.
#[inline(always)]
fn principled_share_row(number: u32) -> u32 {
    if number == PRINCIPLED_SHEEN {
        PRINCIPLED_ROW_SHEEN_WEIGHT
    } else if number == PRINCIPLED_COAT {
        PRINCIPLED_ROW_COAT_WEIGHT
    } else if number == PRINCIPLED_METAL {
        PRINCIPLED_ROW_METALLIC
    } else if number == PRINCIPLED_TRANSMISSION {
        PRINCIPLED_ROW_TRANSMISSION_WEIGHT
    } else {
        PRINCIPLED_ROW_SUBSURFACE_WEIGHT
    }
}

/// Layer `number`, which the light `left` reaches.
#[inline]
pub fn principled_layer(
    rows: ClosureRows,
    number: u32,
    left: Vec3,
    base_color: Vec3,
    multiple: bool,
) -> ClosureLayer {
    let given = max(closure_number(rows, principled_share_row(number)), 0.0);
    // Sheen and coat may be more than there is.
    let share = if number > PRINCIPLED_COAT {
        saturate(given)
    } else {
        given
    };
    let mut layer = ClosureLayer {
        form: LAYER_NONE,
        kind: LOBE_GGX,
        weight: left * share,
        principled: true,
        share,
        normal_row: PRINCIPLED_ROW_NORMAL,
        roughness_row: PRINCIPLED_ROW_ROUGHNESS,
        multiple,
    };
    if number == PRINCIPLED_SPECULAR {
        layer.form = LAYER_SPECULAR;
        layer.weight = left;
    } else if number == PRINCIPLED_SUBSURFACE {
        layer.form = LAYER_LAMBERT;
        layer.kind = LOBE_DIFFUSE;
        layer.weight = min3(base_color, splat3(1.0)) * left * share;
    } else if number == PRINCIPLED_DIFFUSE {
        layer.form = LAYER_DIFFUSE;
        layer.kind = LOBE_DIFFUSE;
        layer.weight = base_color * left * (1.0 - share);
        layer.roughness_row = PRINCIPLED_ROW_DIFFUSE_ROUGHNESS;
    } else if share > CLOSURE_WEIGHT_CUTOFF {
        if number == PRINCIPLED_SHEEN {
            layer.form = LAYER_SHEEN;
            layer.kind = LOBE_SHEEN;
            layer.weight = closure_color(rows, PRINCIPLED_ROW_SHEEN_TINT) * left * share;
            layer.roughness_row = PRINCIPLED_ROW_SHEEN_ROUGHNESS;
        } else if number == PRINCIPLED_COAT {
            layer.form = LAYER_COAT;
            layer.normal_row = PRINCIPLED_ROW_COAT_NORMAL;
            layer.roughness_row = PRINCIPLED_ROW_COAT_ROUGHNESS;
            layer.multiple = true;
        } else if number == PRINCIPLED_METAL {
            layer.form = LAYER_METAL;
        } else {
            layer.form = LAYER_TRANSMISSION;
        }
    }
    layer
}

/// The sheen's normal, between the base's, `base`, and the coat's.
#[inline]
pub fn principled_sheen_normal(rows: ClosureRows, base: Vec3, shading_normal: Vec3) -> Vec3 {
    let coat = closure_share(rows, PRINCIPLED_ROW_COAT_WEIGHT);
    let top = closure_normal(rows, PRINCIPLED_ROW_COAT_NORMAL, shading_normal);
    closure_unit(base * (1.0 - coat) + top * coat, shading_normal)
}

/// What is left of `left` below a layer with the normal `normal` that reflects `reflected`.
#[inline]
pub fn principled_below(
    rows: ClosureRows,
    frame: ClosureFrame,
    layer: ClosureLayer,
    normal: Vec3,
    left: Vec3,
    reflected: Vec3,
) -> Vec3 {
    let form = layer.form;
    let mut below = left;
    if form == LAYER_METAL || form == LAYER_TRANSMISSION {
        below = left * (1.0 - layer.share);
    } else if form != LAYER_LAMBERT && form != LAYER_DIFFUSE && !closure_black(reflected) {
        below = principled_under(left, reflected);
    }
    if form == LAYER_COAT {
        below = principled_tinted(rows, frame, normal, below);
    }
    below
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
