//! Bump, and displacement as bump.

use super::{At, Lowered, Lowering, Value};
use crate::closure::Ty;
use crate::graph::{Encoding, NodeId, NodeKind};
use crate::input::{InputKind, Part};
use crate::ops::OpCode;

/// Fraction of the footprint between heights where the node names none, as in Cycles.
pub(super) const FILTER_WIDTH: f32 = 0.1;

/// `ShaderNodeBump`.
pub(super) fn bump(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let normal = l.normal_input(at, "Normal")?;
    if !l.is_linked(at, "Height") {
        return Ok(Value::Vector(normal));
    }
    let height = l.f1(at, "Height")?;
    let strength = l.f1(at, "Strength")?;
    let mut distance = l.f1(at, "Distance")?;
    if l.flag(at, "invert") {
        let minus = l.graph.f1(-1.0);
        distance = l.op(OpCode::math_multiply, &[distance, minus]);
    }
    let width = l.f1_or(at, "Filter Width", FILTER_WIDTH)?;
    let width = match l.known(width) {
        Some(width) => width.clamp(0.001, 10.0),
        None => {
            l.substitute(at, "a Filter Width that varies", "the default width");
            FILTER_WIDTH
        }
    };
    Ok(Value::Vector(bent(
        l, height, normal, strength, distance, width,
    )))
}

/// The normal bent by a height.
pub(super) fn bent(
    l: &mut Lowering,
    height: NodeId,
    normal: NodeId,
    strength: NodeId,
    distance: NodeId,
    width: f32,
) -> NodeId {
    let [ahead_a, ahead_b] =
        [Part::AxisA, Part::AxisB].map(|axis| l.graph.shifted(height, axis, width));
    if ahead_a == height && ahead_b == height {
        return normal;
    }
    let width = l.graph.f1(width);
    let change = l.op(OpCode::bump_change, &[height, ahead_a, ahead_b, width]);
    let (tangents, change) = match only_uv(l, height) {
        Some(set) => {
            let a = l.graph.input(InputKind::Uv(set), Part::AxisA);
            let b = l.graph.input(InputKind::Uv(set), Part::AxisB);
            let gradient = l.op(OpCode::uv_gradient, &[change, a, b]);
            let u = l.graph.value(InputKind::DpDu(set));
            let v = l.graph.value(InputKind::DpDv(set));
            ([u, v], gradient)
        }
        None => {
            let a = l.graph.input(InputKind::Position, Part::AxisA);
            let b = l.graph.input(InputKind::Position, Part::AxisB);
            ([a, b], change)
        }
    };
    let inputs = [normal, tangents[0], tangents[1], change];
    let slope = l.op(OpCode::bump_surface_gradient, &inputs);
    let bent = l.op(OpCode::bump_bend, &[normal, slope, strength, distance]);
    l.graph.means(bent, Encoding::Normal)
}

/// The UV set that is all that a value depends on.
fn only_uv(l: &Lowering, value: NodeId) -> Option<u16> {
    let mut reached = vec![false; value.index() + 1];
    reached[value.index()] = true;
    let mut set = None;
    for at in (0..=value.index()).rev() {
        if !reached[at] {
            continue;
        }
        let node = &l.graph.nodes()[at];
        if let NodeKind::Input(input) = node.kind {
            match (input.kind, set) {
                (InputKind::Uv(k), None) => set = Some(k),
                (InputKind::Uv(k), Some(other)) if k == other => {}
                _ => return None,
            }
        }
        for input in &node.inputs {
            reached[input.index()] = true;
        }
    }
    set
}

/// `ShaderNodeDisplacement`. While an output's displacement is lowered, vectors are in a
/// frame whose Z axis is the normal, so that a height of UV alone stays one.
pub(super) fn displacement(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let height = l.f1(at, "Height")?;
    let middle = l.f1(at, "Midlevel")?;
    let scale = l.f1(at, "Scale")?;
    let above = match l.known(middle) {
        Some(0.0) => height,
        _ => l.op(OpCode::math_subtract, &[height, middle]),
    };
    let mut high = l.op(OpCode::math_multiply, &[above, scale]);
    if l.is_linked(at, "Normal") {
        let along = l.f3(at, "Normal")?;
        let normal = l.default_normal();
        let cosine = l.op(OpCode::vector_dot, &[along, normal]);
        high = l.op(OpCode::math_multiply, &[high, cosine]);
    }
    if l.text(at, "space", "OBJECT") == "OBJECT" {
        l.displacement_in_object_space = true;
    }
    if !l.in_displacement {
        let normal = l.default_normal();
        return Ok(Value::Vector(l.op(OpCode::vector_scale, &[normal, high])));
    }
    l.has_displacement_node = true;
    let zero = l.graph.f1(0.0);
    Ok(Value::Vector(l.graph.combine(&[zero, zero, high])))
}

/// `ShaderNodeVectorDisplacement`: its part along the normal.
pub(super) fn vector_displacement(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let space = l.text(at, "space", "TANGENT");
    let scale = l.f1(at, "Scale")?;
    let middle = l.f1(at, "Midlevel")?;
    let vector = l.f3(at, "Vector")?;
    let axis = if space == "TANGENT" {
        l.substitute(
            at,
            "ShaderNodeVectorDisplacement",
            "its part along the normal",
        );
        1
    } else {
        l.substitute(at, "ShaderNodeVectorDisplacement", "no displacement");
        return Ok(l.zero("VECTOR"));
    };
    let part = l.graph.component(vector, axis);
    let above = l.op(OpCode::math_subtract, &[part, middle]);
    let high = l.op(OpCode::math_multiply, &[above, scale]);
    let zero = l.graph.f1(0.0);
    l.has_displacement_node = true;
    Ok(Value::Vector(l.graph.combine(&[zero, zero, high])))
}

/// The default normal bent by the displacement that an output was given.
pub(super) fn displaced_normal(l: &mut Lowering, displacement: NodeId) -> NodeId {
    let normal = l.graph.value(InputKind::Normal);
    let height = if l.has_displacement_node {
        l.graph.component(displacement, 2)
    } else {
        l.op(OpCode::vector_dot, &[displacement, normal])
    };
    debug_assert_eq!(l.graph.ty(height), Ty::F1);
    let one = l.graph.f1(1.0);
    let distance = if l.displacement_in_object_space {
        // Heights are in the object's unit: how long a step is in the world and there.
        let world = l.graph.input(InputKind::Position, Part::AxisA);
        let object = l.graph.input(InputKind::Object, Part::AxisA);
        l.op(OpCode::length_ratio, &[world, object])
    } else {
        one
    };
    bent(l, height, normal, one, distance, FILTER_WIDTH)
}
