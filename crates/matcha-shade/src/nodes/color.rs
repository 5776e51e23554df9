//! Mix and the nodes that change colours.

use super::vector::{component_of, triple};
use super::{At, Lowered, Lowering, Value};
use crate::graph::NodeId;
use crate::ops::OpCode;

/// `ShaderNodeMix`.
pub(super) fn mix(l: &mut Lowering, at: At, output: &str) -> Lowered<Value> {
    let clamps = l.flag(at, "clamp_factor");
    match output {
        "Result_Float" => {
            let t = factor(l, at, "Factor_Float", clamps)?;
            let inputs = [l.f1(at, "A_Float")?, l.f1(at, "B_Float")?, t];
            Ok(Value::Float(l.op(OpCode::math_mix, &inputs)))
        }
        "Result_Vector" => {
            let [a, b] = [l.f3(at, "A_Vector")?, l.f3(at, "B_Vector")?];
            if l.text(at, "factor_mode", "UNIFORM") == "NON_UNIFORM" {
                let mut t = l.f3(at, "Factor_Vector")?;
                if clamps {
                    t = l.op(OpCode::vector_saturate, &[t]);
                }
                return Ok(Value::Vector(l.op(OpCode::vector_mix_each, &[a, b, t])));
            }
            let t = factor(l, at, "Factor_Float", clamps)?;
            Ok(Value::Vector(l.op(OpCode::vector_mix, &[a, b, t])))
        }
        "Result_Color" => {
            let t = factor(l, at, "Factor_Float", clamps)?;
            let [a, b] = [l.f3(at, "A_Color")?, l.f3(at, "B_Color")?];
            let clamp = l.flag(at, "clamp_result");
            blend(l, at, t, a, b, clamp)
        }
        _ => {
            l.substitute(at, "ShaderNodeMix (rotation)", "no rotation");
            Ok(l.zero("ROTATION"))
        }
    }
}

/// `ShaderNodeMixRGB`, the older form.
pub(super) fn mix_rgb(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let t = factor(l, at, "Fac", true)?;
    let [a, b] = [l.f3(at, "Color1")?, l.f3(at, "Color2")?];
    let clamp = l.flag(at, "use_clamp");
    blend(l, at, t, a, b, clamp)
}

fn factor(l: &mut Lowering, at: At, socket: &str, clamps: bool) -> Lowered<NodeId> {
    let t = l.f1(at, socket)?;
    Ok(match (clamps, l.known(t)) {
        (false, _) => t,
        (true, Some(x)) => l.graph.f1(x.clamp(0.0, 1.0)),
        (true, None) => l.op(OpCode::math_saturate, &[t]),
    })
}

fn blend(l: &mut Lowering, at: At, t: NodeId, a: NodeId, b: NodeId, clamp: bool) -> Lowered<Value> {
    let mode = l.text(at, "blend_type", "MIX");
    let mixed = match mode.as_str() {
        "MIX" => l.op(OpCode::vector_mix, &[a, b, t]),
        other => match mode_of(other) {
            Some(op) => l.op(op, &[t, a, b]),
            None => return Err(l.bad_property(at, "blend_type")),
        },
    };
    Ok(Value::Color(if clamp {
        l.op(OpCode::vector_saturate, &[mixed])
    } else {
        mixed
    }))
}

fn mode_of(mode: &str) -> Option<OpCode> {
    Some(match mode {
        "ADD" => OpCode::mix_add,
        "MULTIPLY" => OpCode::mix_multiply,
        "SUBTRACT" => OpCode::mix_subtract,
        "SCREEN" => OpCode::mix_screen,
        "OVERLAY" => OpCode::mix_overlay,
        "DIVIDE" => OpCode::mix_divide,
        "DIFFERENCE" => OpCode::mix_difference,
        "EXCLUSION" => OpCode::mix_exclusion,
        "DARKEN" => OpCode::mix_darken,
        "LIGHTEN" => OpCode::mix_lighten,
        "DODGE" => OpCode::mix_dodge,
        "BURN" => OpCode::mix_burn,
        "HUE" => OpCode::mix_hue,
        "SATURATION" => OpCode::mix_saturation,
        "VALUE" => OpCode::mix_value,
        "COLOR" => OpCode::mix_color,
        "SOFT_LIGHT" => OpCode::mix_soft_light,
        "LINEAR_LIGHT" => OpCode::mix_linear_light,
        _ => return None,
    })
}

/// `ShaderNodeRGB`.
pub(super) fn rgb(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let content = l.source(at).outputs.first().map(|o| o.value.clone());
    let c = match content.as_deref() {
        Some([r, g, b, ..]) => [*r, *g, *b],
        _ => [0.0; 3],
    };
    Ok(Value::Color(l.graph.f3(c)))
}

/// `ShaderNodeRGBToBW`.
pub(super) fn luminance(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let c = l.f3(at, "Color")?;
    Ok(Value::Float(l.op(OpCode::color_luminance, &[c])))
}

/// `ShaderNodeHueSaturation`.
pub(super) fn hue_saturation(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let mut inputs = vec![l.f3(at, "Color")?];
    for name in ["Hue", "Saturation", "Value", "Fac"] {
        inputs.push(l.f1(at, name)?);
    }
    Ok(Value::Color(l.op(OpCode::color_adjust_hsv, &inputs)))
}

/// `ShaderNodeInvert`.
pub(super) fn invert(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let inputs = [l.f3(at, "Color")?, l.f1(at, "Fac")?];
    Ok(Value::Color(l.op(OpCode::color_invert, &inputs)))
}

/// `ShaderNodeBrightContrast`.
pub(super) fn bright_contrast(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let inputs = [
        l.f3(at, "Color")?,
        l.f1(at, "Bright")?,
        l.f1(at, "Contrast")?,
    ];
    Ok(Value::Color(l.op(OpCode::color_bright_contrast, &inputs)))
}

/// `ShaderNodeGamma`.
pub(super) fn gamma(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let inputs = [l.f3(at, "Color")?, l.f1(at, "Gamma")?];
    Ok(Value::Color(l.op(OpCode::color_gamma, &inputs)))
}

const RGB: [&str; 3] = ["Red", "Green", "Blue"];

/// `ShaderNodeSeparateColor`.
pub(super) fn separate_color(l: &mut Lowering, at: At, output: &str) -> Lowered<Value> {
    let c = l.f3(at, "Color")?;
    let c = match l.text(at, "mode", "RGB").as_str() {
        "RGB" => c,
        "HSV" => l.op(OpCode::color_to_hsv, &[c]),
        "HSL" => l.op(OpCode::color_to_hsl, &[c]),
        _ => return Err(l.bad_property(at, "mode")),
    };
    component_of(l, at, c, output, &RGB)
}

/// `ShaderNodeCombineColor`.
pub(super) fn combine_color(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let parts = [l.f1(at, "Red")?, l.f1(at, "Green")?, l.f1(at, "Blue")?];
    let c = triple(l, &parts);
    Ok(Value::Color(match l.text(at, "mode", "RGB").as_str() {
        "RGB" => c,
        "HSV" => l.op(OpCode::color_from_hsv, &[c]),
        "HSL" => l.op(OpCode::color_from_hsl, &[c]),
        _ => return Err(l.bad_property(at, "mode")),
    }))
}

/// `ShaderNodeSeparateRGB`, the older form.
pub(super) fn separate_rgb(l: &mut Lowering, at: At, output: &str) -> Lowered<Value> {
    let c = l.f3(at, "Image")?;
    component_of(l, at, c, output, &["R", "G", "B"])
}

/// `ShaderNodeCombineRGB`, the older form.
pub(super) fn combine_rgb(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let parts = [l.f1(at, "R")?, l.f1(at, "G")?, l.f1(at, "B")?];
    Ok(Value::Color(triple(l, &parts)))
}

/// `ShaderNodeSeparateHSV`, the older form.
pub(super) fn separate_hsv(l: &mut Lowering, at: At, output: &str) -> Lowered<Value> {
    let c = l.f3(at, "Color")?;
    let hsv = l.op(OpCode::color_to_hsv, &[c]);
    component_of(l, at, hsv, output, &["H", "S", "V"])
}

/// `ShaderNodeCombineHSV`, the older form.
pub(super) fn combine_hsv(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let parts = [l.f1(at, "H")?, l.f1(at, "S")?, l.f1(at, "V")?];
    let hsv = triple(l, &parts);
    Ok(Value::Color(l.op(OpCode::color_from_hsv, &[hsv])))
}
