//! Wave, Gradient, Checker, Brick and Magic Texture.

use super::coordinates::texture_coordinate;
use super::noise::plain_noise;
use super::{At, Lowered, Lowering, Value};
use crate::closure::Ty;
use crate::graph::NodeId;
use crate::ops::OpCode;

/// A number as the output that was asked for.
fn number_output(l: &mut Lowering, x: NodeId, output: &str) -> Value {
    if output == "Color" {
        Value::Color(l.splat(x))
    } else {
        Value::Float(x)
    }
}

fn scaled(l: &mut Lowering, at: At) -> Lowered<NodeId> {
    let p = texture_coordinate(l, at)?;
    let scale = l.f1(at, "Scale")?;
    Ok(l.op(OpCode::vector_scale, &[p, scale]))
}

/// `ShaderNodeTexWave`.
pub(super) fn wave(l: &mut Lowering, at: At, output: &str) -> Lowered<Value> {
    let p = scaled(l, at)?;
    let (op, property) = match l.text(at, "wave_type", "BANDS").as_str() {
        "BANDS" => (OpCode::wave_bands, "bands_direction"),
        "RINGS" => (OpCode::wave_rings, "rings_direction"),
        _ => return Err(l.bad_property(at, "wave_type")),
    };
    let direction = match l.text(at, property, "X").as_str() {
        "X" => 0,
        "Y" => 1,
        "Z" => 2,
        "DIAGONAL" | "SPHERICAL" => 3,
        _ => return Err(l.bad_property(at, property)),
    };
    let profile = match l.text(at, "wave_profile", "SIN").as_str() {
        "SIN" => 0,
        "SAW" => 1,
        "TRI" => 2,
        _ => return Err(l.bad_property(at, "wave_profile")),
    };
    let phase = l.graph.apply_aux(op, direction, &[p]);
    let offset = l.f1_or(at, "Phase Offset", 0.0)?;
    let phase = l.op(OpCode::math_add, &[phase, offset]);
    let phase = wave_distortion(l, at, p, phase)?;
    let value = l.graph.apply_aux(OpCode::wave_profile, profile, &[phase]);
    Ok(number_output(l, value, output))
}

fn wave_distortion(l: &mut Lowering, at: At, p: NodeId, phase: NodeId) -> Lowered<NodeId> {
    let distortion = l.f1(at, "Distortion")?;
    if l.known(distortion) == Some(0.0) {
        return Ok(phase);
    }
    let scale = l.f1(at, "Detail Scale")?;
    let detail = l.f1(at, "Detail")?;
    let roughness = l.f1_or(at, "Detail Roughness", 0.5)?;
    let place = l.op(OpCode::wave_noise_place, &[p, scale]);
    let noise = plain_noise(l, place, detail, roughness);
    let (two, minus) = (l.graph.f1(2.0), l.graph.f1(-1.0));
    let signed = l.op(OpCode::math_multiply_add, &[noise, two, minus]);
    Ok(l.op(OpCode::math_multiply_add, &[signed, distortion, phase]))
}

/// `ShaderNodeTexGradient`.
pub(super) fn gradient(l: &mut Lowering, at: At, output: &str) -> Lowered<Value> {
    let kind = match l.text(at, "gradient_type", "LINEAR").as_str() {
        "LINEAR" => 0,
        "QUADRATIC" => 1,
        "EASING" => 2,
        "DIAGONAL" => 3,
        "RADIAL" => 4,
        "QUADRATIC_SPHERE" => 5,
        "SPHERICAL" => 6,
        _ => return Err(l.bad_property(at, "gradient_type")),
    };
    let p = texture_coordinate(l, at)?;
    let value = l.graph.apply_aux(OpCode::gradient_value, kind, &[p]);
    Ok(number_output(l, value, output))
}

/// `ShaderNodeTexChecker`.
pub(super) fn checker(l: &mut Lowering, at: At, output: &str) -> Lowered<Value> {
    let p = scaled(l, at)?;
    let first = l.op(OpCode::checker_value, &[p]);
    if output != "Color" {
        return Ok(Value::Float(first));
    }
    let [a, b] = [l.f3(at, "Color1")?, l.f3(at, "Color2")?];
    Ok(Value::Color(l.op(OpCode::vector_mix, &[b, a, first])))
}

/// `ShaderNodeTexBrick`.
pub(super) fn brick(l: &mut Lowering, at: At, output: &str) -> Lowered<Value> {
    let p = scaled(l, at)?;
    let width = l.f1(at, "Brick Width")?;
    let height = l.f1(at, "Row Height")?;
    let offset = l.number(at, "offset", 0.5);
    let squash = l.number(at, "squash", 1.0);
    let frequencies = ["offset_frequency", "squash_frequency"]
        .map(|name| l.number(at, name, 2.0).clamp(0.0, 99.0) as u32);
    let (offset, squash) = (l.graph.f1(offset), l.graph.f1(squash));
    let packed = frequencies[0] | (frequencies[1] << 16);
    let inputs = [p, width, height, offset, squash];
    let place = l.graph.apply_aux(OpCode::brick_place, packed, &inputs);
    let [size, smooth] = [l.f1(at, "Mortar Size")?, l.f1(at, "Mortar Smooth")?];
    let mortar = l.op(OpCode::brick_mortar, &[place, height, size, smooth]);
    if output != "Color" {
        return Ok(Value::Float(mortar));
    }
    let random = l.graph.component(place, 3);
    let bias = l.f1(at, "Bias")?;
    let sum = l.op(OpCode::math_add, &[random, bias]);
    let tint = l.op(OpCode::math_saturate, &[sum]);
    let [a, b] = [l.f3(at, "Color1")?, l.f3(at, "Color2")?];
    let stone = l.op(OpCode::vector_mix, &[a, b, tint]);
    let between = l.f3(at, "Mortar")?;
    Ok(Value::Color(
        l.op(OpCode::vector_mix, &[stone, between, mortar]),
    ))
}

/// `ShaderNodeTexMagic`.
pub(super) fn magic(l: &mut Lowering, at: At, output: &str) -> Lowered<Value> {
    let p = texture_coordinate(l, at)?;
    let scale = l.f1(at, "Scale")?;
    let depth = l.number(at, "turbulence_depth", 2.0).clamp(0.0, 10.0) as u32;
    let distortion = l.f1(at, "Distortion")?;
    let color = l
        .graph
        .apply_aux(OpCode::magic_color, depth, &[p, scale, distortion]);
    debug_assert_eq!(l.graph.ty(color), Ty::F3);
    Ok(if output == "Color" {
        Value::Color(color)
    } else {
        Value::Float(l.op(OpCode::vector_average, &[color]))
    })
}
