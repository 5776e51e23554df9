//! Fresnel, Layer Weight and Normal Map.

use super::coordinates::uv_set;
use super::{At, Lowered, Lowering, Value};
use crate::input::InputKind;
use crate::ops::OpCode;

/// `ShaderNodeFresnel`.
pub(super) fn fresnel(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let ior = l.f1(at, "IOR")?;
    let normal = l.normal_input(at, "Normal")?;
    let incoming = l.graph.value(InputKind::Incoming);
    let back = l.graph.value(InputKind::Backfacing);
    let inputs = [ior, normal, incoming, back];
    Ok(Value::Float(l.op(OpCode::fresnel_factor, &inputs)))
}

/// `ShaderNodeLayerWeight`.
pub(super) fn layer_weight(l: &mut Lowering, at: At, output: &str) -> Lowered<Value> {
    let blend = l.f1(at, "Blend")?;
    let normal = l.normal_input(at, "Normal")?;
    let incoming = l.graph.value(InputKind::Incoming);
    Ok(Value::Float(match output {
        "Fresnel" => {
            let back = l.graph.value(InputKind::Backfacing);
            l.op(
                OpCode::layer_weight_fresnel,
                &[blend, normal, incoming, back],
            )
        }
        _ => l.op(OpCode::layer_weight_facing, &[blend, normal, incoming]),
    }))
}

/// `ShaderNodeNormalMap`.
pub(super) fn normal_map(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let color = l.f3(at, "Color")?;
    let strength = l.f1(at, "Strength")?;
    let normal = l.default_normal();
    let back = l.graph.value(InputKind::Backfacing);
    let space = l.text(at, "space", "TANGENT");
    if space == "TANGENT" {
        let name = l.text(at, "uv_map", "");
        let set = uv_set(l, at, &name);
        let smooth = l.graph.value(InputKind::Normal);
        let tangent = l.graph.value(InputKind::Tangent(set));
        let sign = l.graph.value(InputKind::TangentSign(set));
        let inputs = [color, strength, smooth, tangent, sign, back];
        return Ok(Value::Vector(l.op(OpCode::normal_map_tangent, &inputs)));
    }
    let mut n = l.op(OpCode::normal_map_vector, &[color]);
    if space.starts_with("BLENDER") {
        let flip = l.graph.f3([1.0, -1.0, -1.0]);
        n = l.op(OpCode::vector_multiply, &[n, flip]);
    }
    if space.ends_with("OBJECT") {
        l.substitute(
            at,
            "the object space of ShaderNodeNormalMap",
            "the world's space",
        );
    }
    Ok(Value::Vector(
        l.op(OpCode::normal_map_mix, &[n, strength, normal, back]),
    ))
}
