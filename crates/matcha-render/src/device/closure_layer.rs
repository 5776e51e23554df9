//! What a lobe is made of: which rows of its closure, and with which weight.
//!
//! Every closure comes down to layers of one lobe each. Graphics drivers inline functions, so
//! that all kinds of lobes share one way from a layer to a lobe, with one look-up of each table
//! and one place that a lobe is written in.

use glam::Vec3;

use super::closure_kind::{
    CLOSURE_DIFFUSE, CLOSURE_GLASS, CLOSURE_GLOSSY, CLOSURE_MODEL_ASHIKHMIN,
    CLOSURE_MODEL_ASHIKHMIN_SHIRLEY, CLOSURE_MODEL_BECKMANN, CLOSURE_MODEL_MULTI_GGX,
    CLOSURE_MODEL_STEP, CLOSURE_REFRACTION, CLOSURE_SHEEN, CLOSURE_SUBSURFACE, CLOSURE_TRANSLUCENT,
    DIFFUSE_ROW_NORMAL, DIFFUSE_ROW_ROUGHNESS, GLASS_ROW_NORMAL, GLASS_ROW_ROUGHNESS,
    GLOSSY_ROW_NORMAL, GLOSSY_ROW_ROUGHNESS, NORMAL_ROW_NORMAL, SUBSURFACE_ROW_NORMAL,
};
use super::closure_lobe::ClosureContext;
use super::lobe::{
    LOBE_ASHIKHMIN_SHIRLEY, LOBE_BECKMANN, LOBE_DIFFUSE, LOBE_GGX, LOBE_SHEEN, LOBE_TRANSLUCENT,
    LOBE_VELVET,
};

/// No lobe.
pub const LAYER_NONE: u32 = 0;
/// Lambert, on this side or through the surface.
pub const LAYER_LAMBERT: u32 = 1;
/// Lambert, or Oren–Nayar where it is rough.
pub const LAYER_DIFFUSE: u32 = 2;
/// Ashikhmin's velvet.
pub const LAYER_VELVET: u32 = 3;
/// Sheen as a linearly transformed cosine.
pub const LAYER_SHEEN: u32 = 4;
/// Reflection whose colour is its weight. This and all further ones are microfacets or Phong's
/// lobe: they have an α, which may be blurred.
pub const LAYER_GLOSSY: u32 = 5;
/// Refraction only.
pub const LAYER_REFRACTION: u32 = 6;
/// Reflection and refraction. This and all further ones have a Fresnel factor.
pub const LAYER_GLASS: u32 = 7;
/// The Principled closure's clear coat.
pub const LAYER_COAT: u32 = 8;
/// Its metal. This and all further ones have the specular tint.
pub const LAYER_METAL: u32 = 9;
/// Its glass.
pub const LAYER_TRANSMISSION: u32 = 10;
/// The dielectric surface over its diffuse base.
pub const LAYER_SPECULAR: u32 = 11;

/// A lobe to be.
#[derive(Clone, Copy, Debug)]
pub struct ClosureLayer {
    /// One of the `LAYER_` constants.
    pub form: u32,
    /// One of the `LOBE_` constants.
    pub kind: u32,
    /// Factor on the lobe.
    pub weight: Vec3,
    /// It is one of a Principled closure's.
    pub principled: bool,
    /// Of a Principled closure: how much of the layer there is.
    pub share: f32,
    /// First row of the normal.
    pub normal_row: u32,
    /// Row of the roughness.
    pub roughness_row: u32,
    /// Energy of multiple scattering is given back.
    pub multiple: bool,
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

/// The layer of a closure that has one lobe. The shading normal has none: it is in the frame
/// already.
#[inline]
pub fn closure_single_layer(kind: u32, weight: Vec3) -> ClosureLayer {
    let family = kind % CLOSURE_MODEL_STEP;
    let model = kind / CLOSURE_MODEL_STEP;
    let mut layer = ClosureLayer {
        form: LAYER_NONE,
        kind: LOBE_DIFFUSE,
        weight,
        principled: false,
        share: 1.0,
        normal_row: DIFFUSE_ROW_NORMAL,
        roughness_row: DIFFUSE_ROW_ROUGHNESS,
        multiple: model == CLOSURE_MODEL_MULTI_GGX,
    };
    if family == CLOSURE_DIFFUSE {
        layer.form = LAYER_DIFFUSE;
    } else if family == CLOSURE_TRANSLUCENT {
        layer.form = LAYER_LAMBERT;
        layer.kind = LOBE_TRANSLUCENT;
        layer.normal_row = NORMAL_ROW_NORMAL;
    } else if family == CLOSURE_SUBSURFACE {
        layer.form = LAYER_LAMBERT;
        layer.normal_row = SUBSURFACE_ROW_NORMAL;
    } else if family == CLOSURE_SHEEN {
        let velvet = model == CLOSURE_MODEL_ASHIKHMIN;
        layer.form = if velvet { LAYER_VELVET } else { LAYER_SHEEN };
        layer.kind = if velvet { LOBE_VELVET } else { LOBE_SHEEN };
    } else if family == CLOSURE_GLOSSY {
        layer.form = LAYER_GLOSSY;
        layer.kind = closure_distribution(model);
        layer.normal_row = GLOSSY_ROW_NORMAL;
        layer.roughness_row = GLOSSY_ROW_ROUGHNESS;
    } else if family == CLOSURE_GLASS || family == CLOSURE_REFRACTION {
        let glass = family == CLOSURE_GLASS;
        layer.form = if glass { LAYER_GLASS } else { LAYER_REFRACTION };
        layer.kind = closure_distribution(model);
        layer.normal_row = GLASS_ROW_NORMAL;
        layer.roughness_row = GLASS_ROW_ROUGHNESS;
    }
    layer
}

/// Whether the path so far lets a layer be seen.
#[inline]
pub fn closure_layer_is_wanted(form: u32, context: ClosureContext) -> bool {
    let mut wanted = true;
    if form == LAYER_REFRACTION {
        wanted = context.refractive_caustics;
    } else if form == LAYER_GLASS || form == LAYER_TRANSMISSION {
        wanted = context.reflective_caustics || context.refractive_caustics;
    } else if form >= LAYER_GLOSSY {
        wanted = context.reflective_caustics;
    }
    wanted && form != LAYER_NONE
}

/// Whether a layer's normal is turned as glossy lobes need it.
#[inline(always)]
pub fn closure_layer_turns(form: u32) -> bool {
    form == LAYER_LAMBERT || form >= LAYER_GLOSSY
}
