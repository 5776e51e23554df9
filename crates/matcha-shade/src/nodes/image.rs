//! Image and Environment Texture.

use super::coordinates::texture_coordinate;
use super::{At, Lowered, Lowering, Value};
use crate::closure::Ty;
use crate::graph::{AlphaHandling, Encoding, Graph, Interpolation, NodeId, TextureRef};
use crate::input::Part;
use crate::ops::OpCode;
use crate::source::Extension;

/// `ShaderNodeTexImage`.
pub(super) fn image(l: &mut Lowering, at: At, output: &str) -> Lowered<Value> {
    let Some(texture) = texture_of(l, at, false)? else {
        return Ok(missing(l, at, output));
    };
    let p = texture_coordinate(l, at)?;
    let found = match l.text(at, "projection", "FLAT").as_str() {
        "FLAT" => {
            let uv = l.graph.extract(p, 0, Ty::F2);
            look_up(l, texture, uv)
        }
        "SPHERE" => round(l, texture, p, OpCode::sphere_uv),
        "TUBE" => round(l, texture, p, OpCode::tube_uv),
        "BOX" => boxed(l, at, texture, p)?,
        _ => return Err(l.bad_property(at, "projection")),
    };
    Ok(picked(l, found, output))
}

/// `ShaderNodeTexEnvironment`.
pub(super) fn environment(l: &mut Lowering, at: At, output: &str) -> Lowered<Value> {
    let Some(texture) = texture_of(l, at, true)? else {
        return Ok(missing(l, at, output));
    };
    let p = texture_coordinate(l, at)?;
    let op = match l.text(at, "projection", "EQUIRECTANGULAR").as_str() {
        "EQUIRECTANGULAR" => OpCode::equirectangular_uv,
        "MIRROR_BALL" => OpCode::mirror_ball_uv,
        _ => return Err(l.bad_property(at, "projection")),
    };
    let direction = l.op(OpCode::vector_normalize, &[p]);
    let uv = l.op(op, &[direction]);
    let none = l.graph.f2([0.0; 2]);
    let found = l.graph.texture(texture, uv, none, none);
    Ok(picked(l, found, output))
}

fn texture_of(l: &Lowering, at: At, environment: bool) -> Lowered<Option<TextureRef>> {
    let Some(image) = l.source(at).image else {
        return Ok(None);
    };
    let interpolation = match l.text(at, "interpolation", "Linear").as_str() {
        "Closest" => Interpolation::Closest,
        "Linear" => Interpolation::Linear,
        "Cubic" => Interpolation::Cubic,
        "Smart" => Interpolation::Smart,
        _ => return Err(l.bad_property(at, "interpolation")),
    };
    let extension = match l.text(at, "extension", "REPEAT").as_str() {
        "REPEAT" => Extension::Repeat,
        "EXTEND" => Extension::Extend,
        "CLIP" => Extension::Clip,
        "MIRROR" => Extension::Mirror,
        _ => return Err(l.bad_property(at, "extension")),
    };
    let alpha = if environment {
        AlphaHandling::Associated
    } else if l.is_read(at, "Alpha") {
        AlphaHandling::Unassociated
    } else {
        AlphaHandling::Associated
    };
    Ok(Some(TextureRef {
        image,
        interpolation,
        extension,
        alpha,
        no_footprint: environment,
    }))
}

fn missing(l: &mut Lowering, at: At, output: &str) -> Value {
    l.substitute(
        at,
        "an image texture without an image",
        "magenta, as Cycles has it",
    );
    match output {
        "Alpha" => Value::Float(l.graph.f1(1.0)),
        _ => Value::Color(l.graph.f3([1.0, 0.0, 1.0])),
    }
}

fn picked(l: &mut Lowering, found: NodeId, output: &str) -> Value {
    match output {
        "Alpha" => Value::Float(l.graph.component(found, 3)),
        _ => {
            let color = l.graph.extract(found, 0, Ty::F3);
            Value::Color(l.graph.means(color, Encoding::Color))
        }
    }
}

fn look_up(l: &mut Lowering, texture: TextureRef, uv: NodeId) -> NodeId {
    look_up_in(&mut l.graph, texture, uv)
}

/// A look-up with the footprint that the coordinate has.
pub(super) fn look_up_in(graph: &mut Graph, texture: TextureRef, uv: NodeId) -> NodeId {
    let [da, db] = [Part::AxisA, Part::AxisB].map(|axis| {
        let there = graph.shifted(uv, axis, 1.0);
        if there == uv {
            graph.f2([0.0; 2])
        } else {
            graph.apply(OpCode::pair_subtract, &[there, uv])
        }
    });
    graph.texture(texture, uv, da, db)
}

fn round(l: &mut Lowering, texture: TextureRef, p: NodeId, op: OpCode) -> NodeId {
    let two = l.graph.f3([2.0; 3]);
    let minus = l.graph.f3([-1.0; 3]);
    let centred = l.op(OpCode::vector_multiply_add, &[p, two, minus]);
    let uv = l.op(op, &[centred]);
    look_up(l, texture, uv)
}

/// Three projections, mixed by the normal.
fn boxed(l: &mut Lowering, at: At, texture: TextureRef, p: NodeId) -> Lowered<NodeId> {
    l.substitute(
        at,
        "the projection Box of ShaderNodeTexImage",
        "sides chosen by the normal in the world's space",
    );
    let blend = l.number(at, "projection_blend", 0.0);
    let normal = l.default_normal();
    let blend = l.graph.f1(blend);
    let weights = l.op(OpCode::box_weights, &[normal, blend]);
    let [x, y, z] = [0, 1, 2].map(|i| l.graph.component(p, i));
    let sides = [(y, z, true, 0), (x, z, false, 1), (y, x, false, 2)];
    let mut sum: Option<NodeId> = None;
    for (u, v, flips_below, axis) in sides {
        let u = flipped(l, u, normal, axis, flips_below);
        let uv = l.graph.combine(&[u, v]);
        let found = look_up(l, texture, uv);
        let weight = l.graph.component(weights, axis);
        let parts = [0, 1, 2, 3].map(|i| {
            let x = l.graph.component(found, i);
            match sum {
                None => l.op(OpCode::math_multiply, &[x, weight]),
                Some(sum) => {
                    let before = l.graph.component(sum, i);
                    l.op(OpCode::math_multiply_add, &[x, weight, before])
                }
            }
        });
        sum = Some(l.graph.combine(&parts));
    }
    Ok(sum.unwrap_or(p))
}

/// u, or 1 − u on the side where the picture would be mirrored.
fn flipped(l: &mut Lowering, u: NodeId, normal: NodeId, axis: usize, below: bool) -> NodeId {
    let n = l.graph.component(normal, axis);
    let zero = l.graph.f1(0.0);
    let op = if below {
        OpCode::math_less_than
    } else {
        OpCode::math_greater_than
    };
    let flips = l.op(op, &[n, zero]);
    let one = l.graph.f1(1.0);
    let other = l.op(OpCode::math_subtract, &[one, u]);
    l.op(OpCode::math_mix, &[u, other, flips])
}
