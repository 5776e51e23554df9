//! Voronoi Texture. A detail that is a constant makes exactly its octaves; one that
//! varies makes all sixteen, each with the share that it has.

use super::noise::{Coordinate, dimensions, scaled_coordinate};
use super::{At, Lowered, Lowering, Value};
use crate::closure::Ty;
use crate::device::voronoi::{
    METRIC_CHEBYCHEV, METRIC_EUCLIDEAN, METRIC_MANHATTAN, METRIC_MINKOWSKI,
};
use crate::graph::NodeId;
use crate::ops::OpCode;
use crate::shifted::HELD;

/// Largest detail.
const MOST_DETAIL: f32 = 15.0;

#[derive(Clone, Copy, PartialEq, Eq)]
enum Feature {
    First,
    Second,
    Smooth,
    Edge,
    Radius,
}

/// A cell's place: corner, the coordinate inside of it.
#[derive(Clone, Copy)]
struct Cell {
    c: NodeId,
    cw: NodeId,
    f: NodeId,
    fw: NodeId,
}

/// The node's settings.
struct Settings {
    feature: Feature,
    dims: usize,
    metric: u32,
    randomness: NodeId,
    smoothness: NodeId,
    exponent: NodeId,
    scale: NodeId,
}

/// `ShaderNodeTexVoronoi`.
pub(super) fn voronoi(l: &mut Lowering, at: At, output: &str) -> Lowered<Value> {
    let s = settings(l, at)?;
    let place = scaled_coordinate(l, at, s.dims)?;
    if s.feature == Feature::Radius {
        return Ok(match output {
            "Radius" => Value::Float(radius(l, &s, place)),
            other => l.zero(kind_of(other)),
        });
    }
    if output == "Radius" || (s.feature == Feature::Edge && output != "Distance") {
        return Ok(l.zero(kind_of(output)));
    }
    let sum = octaves(l, at, &s, place, output)?;
    let normalize = l.flag(at, "normalize");
    Ok(match output {
        "Distance" => {
            let scaled = if normalize {
                let max = max_distance(l, &s);
                let top = if s.feature == Feature::Edge {
                    sum.amplitudes
                } else {
                    multiply(l, sum.amplitudes, max)
                };
                l.op(OpCode::math_divide, &[sum.value, top])
            } else {
                sum.value
            };
            Value::Float(scaled)
        }
        "Color" => {
            let color = if normalize && l.known(sum.amplitudes) != Some(1.0) {
                let top = l.splat(sum.amplitudes);
                l.op(OpCode::vector_divide, &[sum.value, top])
            } else {
                sum.value
            };
            Value::Color(color)
        }
        "Position" => {
            let place = l.graph.extract(sum.value, 0, Ty::F3);
            let scale = l.splat(s.scale);
            Value::Vector(l.op(OpCode::vector_divide, &[place, scale]))
        }
        "W" => {
            let w = l.graph.component(sum.value, 3);
            Value::Float(l.op(OpCode::math_divide, &[w, s.scale]))
        }
        _ => return Err(l.bad_output(at, output)),
    })
}

fn kind_of(output: &str) -> &'static str {
    match output {
        "Color" => "RGBA",
        "Position" => "VECTOR",
        _ => "VALUE",
    }
}

fn settings(l: &mut Lowering, at: At) -> Lowered<Settings> {
    let feature = match l.text(at, "feature", "F1").as_str() {
        "F1" => Feature::First,
        "F2" => Feature::Second,
        "SMOOTH_F1" => Feature::Smooth,
        "DISTANCE_TO_EDGE" => Feature::Edge,
        "N_SPHERE_RADIUS" => Feature::Radius,
        _ => return Err(l.bad_property(at, "feature")),
    };
    let metric = match l.text(at, "distance", "EUCLIDEAN").as_str() {
        "EUCLIDEAN" => METRIC_EUCLIDEAN,
        "MANHATTAN" => METRIC_MANHATTAN,
        "CHEBYCHEV" => METRIC_CHEBYCHEV,
        "MINKOWSKI" => METRIC_MINKOWSKI,
        _ => return Err(l.bad_property(at, "distance")),
    };
    let smoothness = l.f1_or(at, "Smoothness", 1.0)?;
    let plain = l.known(smoothness) == Some(0.0) && feature == Feature::Smooth;
    Ok(Settings {
        feature: if plain { Feature::First } else { feature },
        dims: dimensions(l, at, "voronoi_dimensions")?,
        metric,
        randomness: l.f1_or(at, "Randomness", 1.0)?,
        smoothness,
        exponent: l.f1_or(at, "Exponent", 0.5)?,
        scale: l.f1(at, "Scale")?,
    })
}

/// Octaves summed up. For the edge, `amplitudes` is the largest distance.
struct Sum {
    value: NodeId,
    amplitudes: NodeId,
}

fn octaves(l: &mut Lowering, at: At, s: &Settings, c: Coordinate, output: &str) -> Lowered<Sum> {
    let detail = l.f1_or(at, "Detail", 0.0)?;
    let roughness = l.f1_or(at, "Roughness", 0.5)?;
    let roughness = clamped(l, roughness, 0.0, 1.0);
    let lacunarity = l.f1_or(at, "Lacunarity", 2.0)?;
    let known = l.known(detail).map(|d| d.clamp(0.0, MOST_DETAIL));
    let count = if l.known(roughness) == Some(0.0) {
        1
    } else {
        known.unwrap_or(MOST_DETAIL).ceil() as usize + 1
    };
    let one = l.graph.f1(1.0);
    let (mut scale, mut amplitude) = (one, one);
    let mut sum: Option<Sum> = None;
    for i in 0..count {
        let octave = octave(l, s, c, scale, output);
        let share = match (known, i) {
            (_, 0) => one,
            (Some(d), _) => l.graph.f1((d - (i as f32 - 1.0)).clamp(0.0, 1.0)),
            (None, _) => {
                let before = l.graph.f1(i as f32 - 1.0);
                let over = l.op(OpCode::math_subtract, &[detail, before]);
                l.op(OpCode::math_saturate, &[over])
            }
        };
        let weight = multiply(l, amplitude, share);
        sum = Some(match sum {
            None => first(l, s, octave),
            Some(sum) => added(l, s, sum, octave, weight, scale, output),
        });
        scale = multiply(l, scale, lacunarity);
        amplitude = multiply(l, amplitude, roughness);
    }
    Ok(match sum {
        Some(sum) => sum,
        None => Sum {
            value: one,
            amplitudes: one,
        },
    })
}

fn first(l: &mut Lowering, s: &Settings, octave: NodeId) -> Sum {
    let amplitudes = if s.feature == Feature::Edge {
        max_distance(l, s)
    } else {
        l.graph.f1(1.0)
    };
    Sum {
        value: octave,
        amplitudes,
    }
}

fn added(
    l: &mut Lowering,
    s: &Settings,
    sum: Sum,
    octave: NodeId,
    weight: NodeId,
    scale: NodeId,
    output: &str,
) -> Sum {
    if s.feature == Feature::Edge {
        let here = l.op(OpCode::math_divide, &[octave, scale]);
        let nearer = l.op(OpCode::math_minimum, &[sum.value, here]);
        let most = max_distance(l, s);
        let most = l.op(OpCode::math_divide, &[most, scale]);
        return Sum {
            value: l.op(OpCode::math_mix, &[sum.value, nearer, weight]),
            amplitudes: l.op(OpCode::math_mix, &[sum.amplitudes, most, weight]),
        };
    }
    let amplitudes = l.op(OpCode::math_add, &[sum.amplitudes, weight]);
    let value = match output {
        "Distance" => l.op(OpCode::math_multiply_add, &[octave, weight, sum.value]),
        "Color" => {
            let part = l.op(OpCode::vector_scale, &[octave, weight]);
            l.op(OpCode::vector_add, &[sum.value, part])
        }
        _ => {
            let parts = [0, 1, 2, 3].map(|i| {
                let old = l.graph.component(sum.value, i);
                let new = l.graph.component(octave, i);
                let new = l.op(OpCode::math_divide, &[new, scale]);
                l.op(OpCode::math_mix, &[old, new, weight])
            });
            l.graph.combine(&parts)
        }
    };
    Sum { value, amplitudes }
}

/// Corner and inside of the cell that a coordinate is in. The corner is held or not.
fn cell(l: &mut Lowering, c: Coordinate, scale: NodeId, hold: u32) -> Cell {
    let plain = l.known(scale) == Some(1.0);
    let p = if plain {
        c.p
    } else {
        l.op(OpCode::vector_scale, &[c.p, scale])
    };
    let w = if plain {
        c.w
    } else {
        l.op(OpCode::math_multiply, &[c.w, scale])
    };
    let zero = l.graph.f1(0.0);
    let (corner, inside) = if c.dims > 1 {
        let corner = l.graph.apply_aux(OpCode::vector_floor, hold, &[p]);
        (corner, l.op(OpCode::vector_subtract, &[p, corner]))
    } else {
        (c.p, c.p)
    };
    let (cw, fw) = if c.dims == 1 || c.dims == 4 {
        let corner = l.graph.apply_aux(OpCode::math_floor, hold, &[w]);
        (corner, l.op(OpCode::math_subtract, &[w, corner]))
    } else {
        (zero, zero)
    };
    Cell {
        c: corner,
        cw,
        f: inside,
        fw,
    }
}

/// One octave's distance, colour or position (F4).
///
/// Beside the hit, a Euclidean distance is that to the point, or border, that is nearest
/// at the hit: a bump's slope is that of the piece of surface that the hit is on, and
/// the search is made once instead of three times. Colours and positions jump from cell
/// to cell, and a bump of them is made of those jumps: they search anew.
fn octave(l: &mut Lowering, s: &Settings, c: Coordinate, scale: NodeId, output: &str) -> NodeId {
    if s.feature == Feature::Smooth {
        let at = cell(l, c, scale, 0);
        return smooth(l, s, [at.c, at.cw, at.f, at.fw, s.randomness], output);
    }
    let is_smooth_piece = match s.feature {
        Feature::First => output == "Distance" && (s.metric == METRIC_EUCLIDEAN || s.dims == 1),
        Feature::Edge => s.dims > 1,
        _ => false,
    };
    let hold = if is_smooth_piece { HELD } else { 0 };
    let at = cell(l, c, scale, hold);
    let base = [at.c, at.cw, at.f, at.fw, s.randomness];
    let found = nearest(l, s, base, hold);
    let number = l.graph.component(found, 1);
    let [c, cw, f, fw, randomness] = base;
    let at_dims = |ops: [OpCode; 4]| ops[s.dims - 1];
    match (s.feature, output) {
        (Feature::Edge, _) => edge(l, s, base, number, hold),
        (_, "Distance") if is_smooth_piece => {
            let op = at_dims([
                OpCode::voronoi_distance_1d,
                OpCode::voronoi_distance_2d,
                OpCode::voronoi_distance_3d,
                OpCode::voronoi_distance_4d,
            ]);
            l.op(op, &[c, cw, f, fw, randomness, number])
        }
        (_, "Distance") => l.graph.component(found, 0),
        (_, "Color") => {
            let op = at_dims([
                OpCode::voronoi_color_1d,
                OpCode::voronoi_color_2d,
                OpCode::voronoi_color_3d,
                OpCode::voronoi_color_4d,
            ]);
            l.op(op, &[c, cw, number])
        }
        _ => {
            let op = at_dims([
                OpCode::voronoi_position_1d,
                OpCode::voronoi_position_2d,
                OpCode::voronoi_position_3d,
                OpCode::voronoi_position_4d,
            ]);
            l.op(op, &[c, cw, randomness, number])
        }
    }
}

fn edge(l: &mut Lowering, s: &Settings, base: [NodeId; 5], number: NodeId, hold: u32) -> NodeId {
    let [c, cw, f, fw, randomness] = base;
    let op = [
        OpCode::voronoi_edge_1d,
        OpCode::voronoi_edge_2d,
        OpCode::voronoi_edge_3d,
        OpCode::voronoi_edge_4d,
    ][s.dims - 1];
    let inputs = [c, cw, f, fw, randomness, number];
    let found = l.graph.apply_aux(op, hold, &inputs);
    if s.dims == 1 {
        return l.graph.component(found, 0);
    }
    let beyond = l.graph.component(found, 1);
    let op = [
        OpCode::voronoi_border_2d,
        OpCode::voronoi_border_3d,
        OpCode::voronoi_border_4d,
    ][s.dims - 2];
    l.op(op, &[c, cw, f, fw, randomness, number, beyond])
}

/// Distance and number of the cell that the feature is about.
fn nearest(l: &mut Lowering, s: &Settings, base: [NodeId; 5], hold: u32) -> NodeId {
    let always_euclidean = matches!(s.feature, Feature::Edge | Feature::Radius);
    if s.feature != Feature::Second && (s.metric == METRIC_EUCLIDEAN || always_euclidean) {
        let op = [
            OpCode::voronoi_f1_1d,
            OpCode::voronoi_f1_2d,
            OpCode::voronoi_f1_3d,
            OpCode::voronoi_f1_4d,
        ][s.dims - 1];
        return l.graph.apply_aux(op, hold, &base);
    }
    let ops = if s.feature == Feature::Second {
        [
            OpCode::voronoi_second_1d,
            OpCode::voronoi_second_2d,
            OpCode::voronoi_second_3d,
            OpCode::voronoi_second_4d,
        ]
    } else {
        [
            OpCode::voronoi_nearest_1d,
            OpCode::voronoi_nearest_2d,
            OpCode::voronoi_nearest_3d,
            OpCode::voronoi_nearest_4d,
        ]
    };
    let [c, cw, f, fw, randomness] = base;
    let inputs = [c, cw, f, fw, randomness, s.exponent];
    l.graph.apply_aux(ops[s.dims - 1], s.metric, &inputs)
}

fn smooth(l: &mut Lowering, s: &Settings, base: [NodeId; 5], output: &str) -> NodeId {
    let plain = s.metric == METRIC_EUCLIDEAN;
    let name = match output {
        "Distance" => "distance",
        "Color" => "color",
        _ => "position",
    };
    let metric = if plain { "" } else { "_metric" };
    let name = format!("voronoi_smooth_{name}{metric}_{}d", s.dims);
    let op = OpCode::by_name(&name).unwrap_or(OpCode::voronoi_smooth_distance_4d);
    let [c, cw, f, fw, randomness] = base;
    let inputs = [c, cw, f, fw, randomness, s.smoothness, s.exponent];
    let found = l.graph.apply_aux(op, s.metric, &inputs);
    if name.contains("position") {
        let parts = [0, 1, 2].map(|i| {
            if i >= s.dims || s.dims == 1 {
                return l.graph.f1(0.0);
            }
            let inside = l.graph.component(found, i);
            let corner = l.graph.component(c, i);
            l.op(OpCode::math_add, &[inside, corner])
        });
        let w = l.graph.component(found, 3);
        let w = l.op(OpCode::math_add, &[w, cw]);
        return l.graph.combine(&[parts[0], parts[1], parts[2], w]);
    }
    found
}

fn radius(l: &mut Lowering, s: &Settings, c: Coordinate) -> NodeId {
    let one = l.graph.f1(1.0);
    let at = cell(l, c, one, 0);
    let base = [at.c, at.cw, at.f, at.fw, s.randomness];
    let found = nearest(l, s, base, 0);
    let number = l.graph.component(found, 1);
    let op = [
        OpCode::voronoi_radius_1d,
        OpCode::voronoi_radius_2d,
        OpCode::voronoi_radius_3d,
        OpCode::voronoi_radius_4d,
    ][s.dims - 1];
    l.op(op, &[at.c, at.cw, at.f, at.fw, s.randomness, number])
}

/// The distance that normalising divides by: from a cell's corner to the farthest point.
fn max_distance(l: &mut Lowering, s: &Settings) -> NodeId {
    let randomness = clamped(l, s.randomness, 0.0, 1.0);
    let half = l.graph.f1(0.5);
    let side = match l.known(randomness) {
        Some(r) => l.graph.f1(0.5 + 0.5 * r),
        None => l.op(OpCode::math_multiply_add, &[randomness, half, half]),
    };
    let dims = s.dims as f32;
    let factor = match (s.feature, s.dims, s.metric) {
        (Feature::Edge, ..) | (_, 1, _) | (_, _, METRIC_CHEBYCHEV) => l.graph.f1(1.0),
        (_, _, METRIC_EUCLIDEAN) => l.graph.f1(dims.sqrt()),
        (_, _, METRIC_MANHATTAN) => l.graph.f1(dims),
        _ => {
            let (one, dims) = (l.graph.f1(1.0), l.graph.f1(dims));
            let inverse = l.op(OpCode::math_divide, &[one, s.exponent]);
            l.op(OpCode::math_power, &[dims, inverse])
        }
    };
    let distance = multiply(l, side, factor);
    if s.feature == Feature::Second {
        let two = l.graph.f1(2.0);
        return multiply(l, distance, two);
    }
    distance
}

fn multiply(l: &mut Lowering, a: NodeId, b: NodeId) -> NodeId {
    match (l.known(a), l.known(b)) {
        (Some(x), Some(y)) => l.graph.f1(x * y),
        (Some(1.0), _) => b,
        (_, Some(1.0)) => a,
        _ => l.op(OpCode::math_multiply, &[a, b]),
    }
}

fn clamped(l: &mut Lowering, x: NodeId, low: f32, high: f32) -> NodeId {
    match l.known(x) {
        Some(v) => l.graph.f1(v.clamp(low, high)),
        None => {
            let (low, high) = (l.graph.f1(low), l.graph.f1(high));
            l.op(OpCode::clamp_min_max, &[x, low, high])
        }
    }
}
