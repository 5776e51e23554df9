//! Vector Math and what puts vectors together and takes them apart.

use super::{At, Lowered, Lowering, Value};
use crate::ops::OpCode;

/// `ShaderNodeVectorMath`.
pub(super) fn vector_math(l: &mut Lowering, at: At, output: &str) -> Lowered<Value> {
    let operation = l.text(at, "operation", "ADD");
    let Some((op, sockets)) = operation_of(&operation) else {
        return Err(l.bad_property(at, "operation"));
    };
    let is_number = matches!(operation.as_str(), "DOT_PRODUCT" | "DISTANCE" | "LENGTH");
    if is_number != (output == "Value") {
        // The output that the mode switches off is zero.
        return Ok(l.zero(if output == "Value" { "VALUE" } else { "VECTOR" }));
    }
    let mut inputs = Vec::new();
    for name in sockets {
        inputs.push(match *name {
            "Scale" => l.f1(at, name)?,
            _ => l.f3(at, name)?,
        });
    }
    let value = l.op(op, &inputs);
    Ok(if is_number {
        Value::Float(value)
    } else {
        Value::Vector(value)
    })
}

const ONE: &[&str] = &["Vector"];
const TWO: &[&str] = &["Vector", "Vector_001"];
const THREE: &[&str] = &["Vector", "Vector_001", "Vector_002"];
const SCALED: &[&str] = &["Vector", "Scale"];
const TWO_SCALED: &[&str] = &["Vector", "Vector_001", "Scale"];

fn operation_of(name: &str) -> Option<(OpCode, &'static [&'static str])> {
    Some(match name {
        "ADD" => (OpCode::vector_add, TWO),
        "SUBTRACT" => (OpCode::vector_subtract, TWO),
        "MULTIPLY" => (OpCode::vector_multiply, TWO),
        "DIVIDE" => (OpCode::vector_divide, TWO),
        "MULTIPLY_ADD" => (OpCode::vector_multiply_add, THREE),
        "CROSS_PRODUCT" => (OpCode::vector_cross, TWO),
        "PROJECT" => (OpCode::vector_project, TWO),
        "REFLECT" => (OpCode::vector_reflect, TWO),
        "REFRACT" => (OpCode::vector_refract, TWO_SCALED),
        "FACEFORWARD" => (OpCode::vector_faceforward, THREE),
        "DOT_PRODUCT" => (OpCode::vector_dot, TWO),
        "DISTANCE" => (OpCode::vector_distance, TWO),
        "LENGTH" => (OpCode::vector_length, ONE),
        "SCALE" => (OpCode::vector_scale, SCALED),
        "NORMALIZE" => (OpCode::vector_normalize, ONE),
        "ABSOLUTE" => (OpCode::vector_absolute, ONE),
        "POWER" => (OpCode::vector_power, TWO),
        "SIGN" => (OpCode::vector_sign, ONE),
        "MINIMUM" => (OpCode::vector_minimum, TWO),
        "MAXIMUM" => (OpCode::vector_maximum, TWO),
        "FLOOR" => (OpCode::vector_floor, ONE),
        "CEIL" => (OpCode::vector_ceil, ONE),
        "FRACTION" => (OpCode::vector_fraction, ONE),
        "MODULO" => (OpCode::vector_modulo, TWO),
        "WRAP" => (OpCode::vector_wrap, THREE),
        "SNAP" => (OpCode::vector_snap, TWO),
        "SINE" => (OpCode::vector_sine, ONE),
        "COSINE" => (OpCode::vector_cosine, ONE),
        "TANGENT" => (OpCode::vector_tangent, ONE),
        _ => return None,
    })
}

/// `ShaderNodeCombineXYZ`.
pub(super) fn combine(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let parts = [l.f1(at, "X")?, l.f1(at, "Y")?, l.f1(at, "Z")?];
    Ok(Value::Vector(triple(l, &parts)))
}

/// Three numbers as a triple; a constant where all are.
pub(super) fn triple(l: &mut Lowering, parts: &[crate::graph::NodeId; 3]) -> crate::graph::NodeId {
    match parts.map(|p| l.known(p)) {
        [Some(x), Some(y), Some(z)] => l.graph.f3([x, y, z]),
        _ => l.graph.combine(parts),
    }
}

/// `ShaderNodeSeparateXYZ`.
pub(super) fn separate(l: &mut Lowering, at: At, output: &str) -> Lowered<Value> {
    let vector = l.f3(at, "Vector")?;
    component_of(l, at, vector, output, &["X", "Y", "Z"])
}

/// The component that an output's name stands for.
pub(super) fn component_of(
    l: &mut Lowering,
    at: At,
    vector: crate::graph::NodeId,
    output: &str,
    names: &[&str; 3],
) -> Lowered<Value> {
    match names.iter().position(|n| *n == output) {
        Some(index) => Ok(Value::Float(l.graph.component(vector, index))),
        None => Err(l.bad_output(at, output)),
    }
}

/// `ShaderNodeNormal`.
pub(super) fn normal(l: &mut Lowering, at: At, output: &str) -> Lowered<Value> {
    let content = &l.source(at).outputs.first().map(|o| o.value.clone());
    let given = match content.as_deref() {
        Some([x, y, z]) => l.graph.f3([*x, *y, *z]),
        _ => l.graph.f3([0.0, 0.0, 1.0]),
    };
    if output == "Dot" {
        let normal = l.f3(at, "Normal")?;
        return Ok(Value::Float(
            l.op(OpCode::vector_normal_dot, &[given, normal]),
        ));
    }
    Ok(Value::Vector(l.op(OpCode::vector_normalize, &[given])))
}
