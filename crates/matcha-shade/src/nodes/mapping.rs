//! Mapping, Vector Rotate and Vector Transform.

use super::{At, Lowered, Lowering, Value};
use crate::graph::NodeId;
use crate::ops::OpCode;

/// `ShaderNodeMapping`.
pub(super) fn mapping(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let v = l.f3(at, "Vector")?;
    let rotation = l.f3(at, "Rotation")?;
    let scale = l.f3(at, "Scale")?;
    let value = match l.text(at, "vector_type", "POINT").as_str() {
        "POINT" => {
            let scaled = l.op(OpCode::vector_multiply, &[v, scale]);
            let turned = turn(l, OpCode::vector_euler, scaled, rotation);
            let location = l.f3(at, "Location")?;
            l.op(OpCode::vector_add, &[turned, location])
        }
        "TEXTURE" => {
            let location = l.f3(at, "Location")?;
            let moved = l.op(OpCode::vector_subtract, &[v, location]);
            let turned = turn(l, OpCode::vector_euler_inverse, moved, rotation);
            l.op(OpCode::vector_divide, &[turned, scale])
        }
        "VECTOR" => {
            let scaled = l.op(OpCode::vector_multiply, &[v, scale]);
            turn(l, OpCode::vector_euler, scaled, rotation)
        }
        "NORMAL" => {
            let scaled = l.op(OpCode::vector_divide, &[v, scale]);
            let turned = turn(l, OpCode::vector_euler, scaled, rotation);
            l.op(OpCode::vector_normalize, &[turned])
        }
        _ => return Err(l.bad_property(at, "vector_type")),
    };
    Ok(Value::Vector(value))
}

/// A rotation by constant angles as a matrix, made once; by zero, nothing.
fn turn(l: &mut Lowering, op: OpCode, v: NodeId, angles: NodeId) -> NodeId {
    let Some([x, y, z, _]) = l.graph.constant_value(angles) else {
        return l.op(op, &[v, angles]);
    };
    if [x, y, z] == [0.0; 3] {
        return v;
    }
    let mut matrix = euler_matrix([x, y, z]);
    if op == OpCode::vector_euler_inverse {
        matrix = transposed(matrix);
    }
    affine(l, v, matrix, [0.0; 3])
}

/// Rows of the rotation X, then Y, then Z.
fn euler_matrix(angles: [f32; 3]) -> [[f32; 3]; 3] {
    let [(sx, cx), (sy, cy), (sz, cz)] = angles.map(|a| f64::from(a).sin_cos());
    let rows = [
        [cy * cz, sx * sy * cz - cx * sz, cx * sy * cz + sx * sz],
        [cy * sz, sx * sy * sz + cx * cz, cx * sy * sz - sx * cz],
        [-sy, sx * cy, cx * cy],
    ];
    rows.map(|row| row.map(|x| x as f32))
}

fn transposed(m: [[f32; 3]; 3]) -> [[f32; 3]; 3] {
    [0, 1, 2].map(|i| [m[0][i], m[1][i], m[2][i]])
}

/// A constant matrix times a point, plus an offset.
pub(super) fn affine(l: &mut Lowering, p: NodeId, rows: [[f32; 3]; 3], offset: [f32; 3]) -> NodeId {
    let parts = [0, 1, 2].map(|i| {
        let row = l.graph.f3(rows[i]);
        let offset = l.graph.f1(offset[i]);
        l.op(OpCode::vector_affine_row, &[p, row, offset])
    });
    l.graph.combine(&parts)
}

/// A 4×4 matrix, column by column, times a point.
pub(super) fn matrix_point(l: &mut Lowering, p: NodeId, m: &[f32; 16]) -> NodeId {
    let rows = [0, 1, 2].map(|i| [m[i], m[4 + i], m[8 + i]]);
    affine(l, p, rows, [m[12], m[13], m[14]])
}

/// `ShaderNodeVectorRotate`.
pub(super) fn rotate(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let v = l.f3(at, "Vector")?;
    let center = l.f3(at, "Center")?;
    let from = l.op(OpCode::vector_subtract, &[v, center]);
    let invert = l.flag(at, "invert");
    let kind = l.text(at, "rotation_type", "AXIS_ANGLE");
    let turned = match kind.as_str() {
        "EULER_XYZ" => {
            let rotation = l.f3(at, "Rotation")?;
            let op = if invert {
                OpCode::vector_euler_inverse
            } else {
                OpCode::vector_euler
            };
            turn(l, op, from, rotation)
        }
        _ => {
            let axis = match kind.as_str() {
                "AXIS_ANGLE" => l.f3(at, "Axis")?,
                "X_AXIS" => l.graph.f3([1.0, 0.0, 0.0]),
                "Y_AXIS" => l.graph.f3([0.0, 1.0, 0.0]),
                "Z_AXIS" => l.graph.f3([0.0, 0.0, 1.0]),
                _ => return Err(l.bad_property(at, "rotation_type")),
            };
            let mut angle = l.f1(at, "Angle")?;
            if invert {
                let minus = l.graph.f1(-1.0);
                angle = l.op(OpCode::math_multiply, &[angle, minus]);
            }
            l.op(OpCode::vector_rotate_axis, &[from, axis, angle])
        }
    };
    Ok(Value::Vector(l.op(OpCode::vector_add, &[turned, center])))
}

/// `ShaderNodeVectorTransform`: spaces of objects and cameras are no inputs of a program.
pub(super) fn transform(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let v = l.f3(at, "Vector")?;
    let from = l.text(at, "convert_from", "WORLD");
    if from != l.text(at, "convert_to", "OBJECT") {
        l.substitute(at, "ShaderNodeVectorTransform", "the vector as it is");
    }
    Ok(Value::Vector(v))
}
