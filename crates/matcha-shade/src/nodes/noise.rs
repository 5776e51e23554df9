//! Noise Texture and White Noise.

use super::coordinates::texture_coordinate;
use super::{At, Lowered, Lowering, Value};
use crate::closure::Ty;
use crate::device::fractal;
use crate::device::hash::{unit_hash1, unit_hash2};
use crate::graph::NodeId;
use crate::ops::OpCode;

/// A coordinate of up to four dimensions: what a dimension does not use is zero.
#[derive(Clone, Copy)]
pub(super) struct Coordinate {
    pub p: NodeId,
    pub w: NodeId,
    pub dims: usize,
}

/// The dimensions that a property names.
pub(super) fn dimensions(l: &Lowering, at: At, name: &str) -> Lowered<usize> {
    match l.text(at, name, "3D").as_str() {
        "1D" => Ok(1),
        "2D" => Ok(2),
        "3D" => Ok(3),
        "4D" => Ok(4),
        _ => Err(l.bad_property(at, name)),
    }
}

/// A texture's coordinate from its sockets, times its scale.
pub(super) fn scaled_coordinate(l: &mut Lowering, at: At, dims: usize) -> Lowered<Coordinate> {
    let scale = l.f1(at, "Scale")?;
    let p = if dims > 1 {
        let v = texture_coordinate(l, at)?;
        match l.known(scale) {
            Some(1.0) => v,
            _ => l.op(OpCode::vector_scale, &[v, scale]),
        }
    } else {
        l.graph.f3([0.0; 3])
    };
    let w = if dims == 1 || dims == 4 {
        let w = l.f1(at, "W")?;
        l.op(OpCode::math_multiply, &[w, scale])
    } else {
        l.graph.f1(0.0)
    };
    Ok(Coordinate {
        p: used(l, p, dims),
        w,
        dims,
    })
}

/// A triple without the components that a number of dimensions does not use, so that
/// the value does not depend on them.
fn used(l: &mut Lowering, p: NodeId, dims: usize) -> NodeId {
    if dims != 2 || l.graph.constant_value(p).is_some() {
        return p;
    }
    let xy = l.graph.extract(p, 0, Ty::F2);
    let zero = l.graph.f1(0.0);
    l.graph.combine(&[xy, zero])
}

/// Everything but the coordinate.
struct Octaves {
    detail: NodeId,
    roughness: NodeId,
    lacunarity: NodeId,
    offset: NodeId,
    gain: NodeId,
    /// `None`: fractional Brownian motion.
    kind: Option<u32>,
    normalized: u32,
}

/// `ShaderNodeTexNoise`.
pub(super) fn noise(l: &mut Lowering, at: At, output: &str) -> Lowered<Value> {
    let dims = dimensions(l, at, "noise_dimensions")?;
    let place = scaled_coordinate(l, at, dims)?;
    let octaves = octaves(l, at)?;
    let distortion = l.f1(at, "Distortion")?;
    let place = distorted(l, place, distortion);
    let fac = fractal_noise(l, place, &octaves);
    if output != "Color" {
        return Ok(Value::Float(fac));
    }
    // The noises of green and blue are read further on; the first seeds are the distortion's.
    let channels = [dims, dims + 1].map(|seed| {
        let there = moved(l, place, seed);
        fractal_noise(l, there, &octaves)
    });
    Ok(Value::Color(l.graph.combine(&[
        fac,
        channels[0],
        channels[1],
    ])))
}

fn octaves(l: &mut Lowering, at: At) -> Lowered<Octaves> {
    let kind = match l.text(at, "noise_type", "FBM").as_str() {
        "FBM" => None,
        "MULTIFRACTAL" => Some(fractal::FRACTAL_MULTI),
        "HYBRID_MULTIFRACTAL" => Some(fractal::FRACTAL_HYBRID),
        "RIDGED_MULTIFRACTAL" => Some(fractal::FRACTAL_RIDGED),
        "HETERO_TERRAIN" => Some(fractal::FRACTAL_HETERO),
        _ => return Err(l.bad_property(at, "noise_type")),
    };
    let has_normalize = l.source(at).props.contains_key("normalize");
    Ok(Octaves {
        detail: l.f1(at, "Detail")?,
        roughness: l.f1(at, "Roughness")?,
        lacunarity: l.f1_or(at, "Lacunarity", 2.0)?,
        offset: l.f1_or(at, "Offset", 0.0)?,
        gain: l.f1_or(at, "Gain", 1.0)?,
        kind,
        normalized: u32::from(!has_normalize || l.flag(at, "normalize")),
    })
}

fn fractal_noise(l: &mut Lowering, c: Coordinate, o: &Octaves) -> NodeId {
    let base = [c.p, c.w, o.detail, o.roughness, o.lacunarity];
    match o.kind {
        None => {
            let op = [
                OpCode::noise_fbm_1d,
                OpCode::noise_fbm_2d,
                OpCode::noise_fbm_3d,
                OpCode::noise_fbm_4d,
            ][c.dims - 1];
            l.graph.apply_aux(op, o.normalized, &base)
        }
        Some(kind) => {
            let op = [
                OpCode::noise_fractal_1d,
                OpCode::noise_fractal_2d,
                OpCode::noise_fractal_3d,
                OpCode::noise_fractal_4d,
            ][c.dims - 1];
            let [p, w, detail, roughness, lacunarity] = base;
            let inputs = [p, w, detail, roughness, lacunarity, o.offset, o.gain];
            l.graph.apply_aux(op, kind, &inputs)
        }
    }
}

/// Fractional Brownian motion in three dimensions, normalised.
pub(super) fn plain_noise(
    l: &mut Lowering,
    p: NodeId,
    detail: NodeId,
    roughness: NodeId,
) -> NodeId {
    let (w, lacunarity) = (l.graph.f1(0.0), l.graph.f1(2.0));
    l.graph.apply_aux(
        OpCode::noise_fbm_3d,
        1,
        &[p, w, detail, roughness, lacunarity],
    )
}

fn distorted(l: &mut Lowering, c: Coordinate, distortion: NodeId) -> Coordinate {
    if l.known(distortion) == Some(0.0) {
        return c;
    }
    let axes = c.dims;
    let bends: Vec<NodeId> = (0..axes)
        .map(|seed| {
            let there = moved(l, c, seed);
            let noise = signed(l, there);
            l.op(OpCode::math_multiply, &[noise, distortion])
        })
        .collect();
    let zero = l.graph.f1(0.0);
    let on_p = |i: usize| {
        if c.dims > 1 && i < c.dims {
            bends[i]
        } else {
            zero
        }
    };
    let p = if c.dims > 1 {
        let bend = l.graph.combine(&[on_p(0), on_p(1), on_p(2)]);
        l.op(OpCode::vector_add, &[c.p, bend])
    } else {
        c.p
    };
    let w = match c.dims {
        1 => l.op(OpCode::math_add, &[c.w, bends[0]]),
        4 => l.op(OpCode::math_add, &[c.w, bends[3]]),
        _ => c.w,
    };
    Coordinate { p, w, ..c }
}

/// The coordinate moved by a seed's random offset, 100 to 200 an axis.
fn moved(l: &mut Lowering, c: Coordinate, seed: usize) -> Coordinate {
    let seed = seed as f32;
    let by = |axis: usize| {
        let random = if c.dims == 1 {
            unit_hash1(seed)
        } else {
            unit_hash2(seed, axis as f32)
        };
        100.0 + 100.0 * random
    };
    let p = if c.dims > 1 {
        let z = if c.dims > 2 { by(2) } else { 0.0 };
        let offset = l.graph.f3([by(0), by(1), z]);
        l.op(OpCode::vector_add, &[c.p, offset])
    } else {
        c.p
    };
    let w = match c.dims {
        1 | 4 => {
            let offset = l.graph.f1(by(if c.dims == 1 { 0 } else { 3 }));
            l.op(OpCode::math_add, &[c.w, offset])
        }
        _ => c.w,
    };
    Coordinate { p, w, ..c }
}

fn signed(l: &mut Lowering, c: Coordinate) -> NodeId {
    match c.dims {
        1 => l.op(OpCode::noise_signed_1d, &[c.w]),
        2 => {
            let xy = l.graph.extract(c.p, 0, Ty::F2);
            l.op(OpCode::noise_signed_2d, &[xy])
        }
        3 => l.op(OpCode::noise_signed_3d, &[c.p]),
        _ => l.op(OpCode::noise_signed_4d, &[c.p, c.w]),
    }
}

/// `ShaderNodeTexWhiteNoise`.
pub(super) fn white_noise(l: &mut Lowering, at: At, output: &str) -> Lowered<Value> {
    let dims = dimensions(l, at, "noise_dimensions")?;
    let p = if dims > 1 {
        l.f3(at, "Vector")?
    } else {
        l.graph.f3([0.0; 3])
    };
    let p = used(l, p, dims);
    let inputs = match dims {
        1 => vec![l.f1(at, "W")?],
        2 | 3 => vec![p],
        _ => vec![p, l.f1(at, "W")?],
    };
    let color = output == "Color";
    let op = match (dims, color) {
        (1, false) => OpCode::white_noise_1d,
        (2, false) => OpCode::white_noise_2d,
        (3, false) => OpCode::white_noise_3d,
        (_, false) => OpCode::white_noise_4d,
        (1, true) => OpCode::white_noise_color_1d,
        (2, true) => OpCode::white_noise_color_2d,
        (3, true) => OpCode::white_noise_color_3d,
        (_, true) => OpCode::white_noise_color_4d,
    };
    let value = l.op(op, &inputs);
    Ok(if color {
        Value::Color(value)
    } else {
        Value::Float(value)
    })
}
