//! Math, Clamp, Map Range and the sources of numbers.

use super::{At, Lowered, Lowering, Value};
use crate::graph::NodeId;
use crate::ops::OpCode;

/// `ShaderNodeMath`.
pub(super) fn math(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let operation = l.text(at, "operation", "ADD");
    let Some((op, operands)) = operation_of(&operation) else {
        return Err(l.bad_property(at, "operation"));
    };
    let mut inputs = Vec::new();
    for name in &["Value", "Value_001", "Value_002"][..operands] {
        inputs.push(l.f1(at, name)?);
    }
    let value = match operation.as_str() {
        "RADIANS" | "DEGREES" => {
            let half_turn: f32 = 180.0;
            let factor = if operation == "RADIANS" {
                1f32.to_radians()
            } else {
                half_turn / std::f32::consts::PI
            };
            let factor = l.graph.f1(factor);
            l.op(OpCode::math_multiply, &[inputs[0], factor])
        }
        _ => l.op(op, &inputs),
    };
    Ok(Value::Float(clamped(l, at, value)))
}

fn clamped(l: &mut Lowering, at: At, value: NodeId) -> NodeId {
    if l.flag(at, "use_clamp") {
        l.op(OpCode::math_saturate, &[value])
    } else {
        value
    }
}

fn operation_of(name: &str) -> Option<(OpCode, usize)> {
    Some(match name {
        "ADD" => (OpCode::math_add, 2),
        "SUBTRACT" => (OpCode::math_subtract, 2),
        "MULTIPLY" => (OpCode::math_multiply, 2),
        "DIVIDE" => (OpCode::math_divide, 2),
        "MULTIPLY_ADD" => (OpCode::math_multiply_add, 3),
        "POWER" => (OpCode::math_power, 2),
        "LOGARITHM" => (OpCode::math_logarithm, 2),
        "SQRT" => (OpCode::math_sqrt, 1),
        "INVERSE_SQRT" => (OpCode::math_inverse_sqrt, 1),
        "ABSOLUTE" => (OpCode::math_absolute, 1),
        "EXPONENT" => (OpCode::math_exponent, 1),
        "MINIMUM" => (OpCode::math_minimum, 2),
        "MAXIMUM" => (OpCode::math_maximum, 2),
        "LESS_THAN" => (OpCode::math_less_than, 2),
        "GREATER_THAN" => (OpCode::math_greater_than, 2),
        "SIGN" => (OpCode::math_sign, 1),
        "COMPARE" => (OpCode::math_compare, 3),
        "SMOOTH_MIN" => (OpCode::math_smooth_minimum, 3),
        "SMOOTH_MAX" => (OpCode::math_smooth_maximum, 3),
        "ROUND" => (OpCode::math_round, 1),
        "FLOOR" => (OpCode::math_floor, 1),
        "CEIL" => (OpCode::math_ceil, 1),
        "TRUNC" => (OpCode::math_truncate, 1),
        "FRACT" => (OpCode::math_fraction, 1),
        "MODULO" => (OpCode::math_modulo, 2),
        "FLOORED_MODULO" => (OpCode::math_floored_modulo, 2),
        "WRAP" => (OpCode::math_wrap, 3),
        "SNAP" => (OpCode::math_snap, 2),
        "PINGPONG" => (OpCode::math_pingpong, 2),
        "SINE" => (OpCode::math_sine, 1),
        "COSINE" => (OpCode::math_cosine, 1),
        "TANGENT" => (OpCode::math_tangent, 1),
        "ARCSINE" => (OpCode::math_arcsine, 1),
        "ARCCOSINE" => (OpCode::math_arccosine, 1),
        "ARCTANGENT" => (OpCode::math_arctangent, 1),
        "ARCTAN2" => (OpCode::math_arctan2, 2),
        "SINH" => (OpCode::math_sinh, 1),
        "COSH" => (OpCode::math_cosh, 1),
        "TANH" => (OpCode::math_tanh, 1),
        "RADIANS" | "DEGREES" => (OpCode::math_multiply, 1),
        _ => return None,
    })
}

/// `ShaderNodeClamp`.
pub(super) fn clamp(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let op = match l.text(at, "clamp_type", "MINMAX").as_str() {
        "MINMAX" => OpCode::clamp_min_max,
        "RANGE" => OpCode::clamp_range,
        _ => return Err(l.bad_property(at, "clamp_type")),
    };
    let inputs = [l.f1(at, "Value")?, l.f1(at, "Min")?, l.f1(at, "Max")?];
    Ok(Value::Float(l.op(op, &inputs)))
}

/// `ShaderNodeMapRange`.
pub(super) fn map_range(l: &mut Lowering, at: At, output: &str) -> Lowered<Value> {
    let kind = l.text(at, "interpolation_type", "LINEAR");
    if l.text(at, "data_type", "FLOAT") == "FLOAT_VECTOR" || output == "Vector" {
        return map_range_vector(l, at, &kind);
    }
    let mut inputs = Vec::new();
    for name in ["Value", "From Min", "From Max", "To Min", "To Max"] {
        inputs.push(l.f1(at, name)?);
    }
    let op = match kind.as_str() {
        "LINEAR" => OpCode::map_range_linear,
        "STEPPED" => OpCode::map_range_stepped,
        "SMOOTHSTEP" => OpCode::map_range_smooth,
        "SMOOTHERSTEP" => OpCode::map_range_smoother,
        _ => return Err(l.bad_property(at, "interpolation_type")),
    };
    let (low, high) = (inputs[3], inputs[4]);
    if kind == "STEPPED" {
        inputs.push(l.f1(at, "Steps")?);
    }
    let value = l.op(op, &inputs);
    Ok(Value::Float(if l.flag(at, "clamp") {
        l.op(OpCode::clamp_range, &[value, low, high])
    } else {
        value
    }))
}

fn map_range_vector(l: &mut Lowering, at: At, kind: &str) -> Lowered<Value> {
    let mut inputs = Vec::new();
    for name in [
        "Vector",
        "From_Min_FLOAT3",
        "From_Max_FLOAT3",
        "To_Min_FLOAT3",
        "To_Max_FLOAT3",
    ] {
        inputs.push(l.f3(at, name)?);
    }
    let steps = match kind {
        "STEPPED" => Some(l.f3(at, "Steps_FLOAT3")?),
        "LINEAR" | "SMOOTHSTEP" | "SMOOTHERSTEP" => None,
        _ => return Err(l.bad_property(at, "interpolation_type")),
    };
    let clamp = l.flag(at, "clamp") && !kind.starts_with("SMOOTH");
    let mut parts = Vec::new();
    for i in 0..3 {
        let [x, a, b, low, high] = [0, 1, 2, 3, 4].map(|k| l.graph.component(inputs[k], i));
        let t = l.op(OpCode::range_factor, &[x, a, b]);
        let t = match steps {
            Some(steps) => {
                let n = l.graph.component(steps, i);
                let (zero, one) = (l.graph.f1(0.0), l.graph.f1(1.0));
                l.op(OpCode::map_range_stepped, &[t, zero, one, zero, one, n])
            }
            None => shaped(l, kind, t),
        };
        let value = l.op(OpCode::math_mix, &[low, high, t]);
        parts.push(if clamp {
            l.op(OpCode::clamp_range, &[value, low, high])
        } else {
            value
        });
    }
    Ok(Value::Vector(l.graph.combine(&parts)))
}

fn shaped(l: &mut Lowering, kind: &str, t: NodeId) -> NodeId {
    let op = match kind {
        "SMOOTHSTEP" => OpCode::map_range_smooth,
        "SMOOTHERSTEP" => OpCode::map_range_smoother,
        _ => return t,
    };
    let (zero, one) = (l.graph.f1(0.0), l.graph.f1(1.0));
    l.op(op, &[t, zero, one, zero, one])
}

/// `ShaderNodeValue`.
pub(super) fn value(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let content = l.source(at).outputs.first().and_then(|o| o.value.first());
    let x = content.copied().unwrap_or(0.0);
    Ok(Value::Float(l.graph.f1(x)))
}

/// `ShaderNodeLightFalloff`: a strength, multiplied with a power of the distance.
pub(super) fn light_falloff(l: &mut Lowering, at: At, output: &str) -> Lowered<Value> {
    let strength = l.f1(at, "Strength")?;
    let smooth = l.f1(at, "Smooth")?;
    let d = l.graph.value(crate::input::InputKind::RayLength);
    let d2 = l.op(OpCode::math_multiply, &[d, d]);
    let sum = l.op(OpCode::math_add, &[smooth, d2]);
    let softened = l.op(OpCode::math_divide, &[d2, sum]);
    let strength = if l.known(smooth) == Some(0.0) {
        strength
    } else {
        l.op(OpCode::math_multiply, &[strength, softened])
    };
    Ok(Value::Float(match output {
        "Linear" => l.op(OpCode::math_multiply, &[strength, d]),
        "Constant" => l.op(OpCode::math_multiply, &[strength, d2]),
        _ => strength,
    }))
}
