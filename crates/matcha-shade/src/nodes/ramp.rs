//! Colour ramps and curves: tables.

use super::error::LowerError;
use super::{At, Lowered, Lowering, Value};
use crate::graph::{NodeId, Table};
use crate::ops::OpCode;
use crate::source::{Curves, Ramp};

/// Samples of a ramp that is baked here.
const BAKED: usize = 256;

/// `ShaderNodeValToRGB`.
pub(super) fn color_ramp(l: &mut Lowering, at: At, output: &str) -> Lowered<Value> {
    let Some(ramp) = &l.source(at).ramp else {
        return Err(LowerError::Content(l.place(at), "colour ramp"));
    };
    let samples = if ramp.table.len() >= 8 {
        ramp.table.clone()
    } else {
        if !matches!(ramp.interpolation.as_str(), "LINEAR" | "CONSTANT" | "EASE")
            || ramp.color_mode != "RGB"
        {
            l.substitute(
                at,
                "a colour ramp without its table",
                "linear interpolation",
            );
        }
        baked(ramp)
    };
    let rows = (0..4)
        .map(|c| samples.iter().skip(c).step_by(4).copied().collect())
        .collect();
    let table = l.graph.table(Table {
        rows,
        interpolate: ramp.interpolation != "CONSTANT",
        extrapolate: false,
    });
    let fac = l.f1(at, "Fac")?;
    let found = l.graph.look_up(table, fac);
    Ok(match output {
        "Alpha" => Value::Float(l.graph.component(found, 3)),
        _ => Value::Color(l.graph.extract(found, 0, crate::closure::Ty::F3)),
    })
}

/// A ramp's stops as a table, r g b a each.
fn baked(ramp: &Ramp) -> Vec<f32> {
    (0..BAKED)
        .flat_map(|i| ramp_at(ramp, i as f32 / (BAKED - 1) as f32))
        .collect()
}

fn ramp_at(ramp: &Ramp, x: f32) -> [f32; 4] {
    let color = |s: &[f32; 5]| [s[1], s[2], s[3], s[4]];
    let after = ramp.stops.iter().position(|s| s[0] > x);
    let (below, above) = match after {
        None => return ramp.stops.last().map_or([0.0; 4], color),
        Some(0) => return color(&ramp.stops[0]),
        Some(at) => (&ramp.stops[at - 1], &ramp.stops[at]),
    };
    let t = (x - below[0]) / (above[0] - below[0]);
    let t = match ramp.interpolation.as_str() {
        "CONSTANT" => 0.0,
        "EASE" => t * t * (3.0 - 2.0 * t),
        _ => t,
    };
    let (a, b) = (color(below), color(above));
    [0, 1, 2, 3].map(|i| a[i] + (b[i] - a[i]) * t)
}

/// `ShaderNodeRGBCurve`.
pub(super) fn rgb_curves(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let color = l.f3(at, "Color")?;
    let fac = l.f1(at, "Fac")?;
    let curved = through_curves(l, at, color)?;
    Ok(Value::Color(mixed(l, color, curved, fac)))
}

/// `ShaderNodeVectorCurve`.
pub(super) fn vector_curves(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let vector = l.f3(at, "Vector")?;
    let fac = l.f1(at, "Fac")?;
    let curved = through_curves(l, at, vector)?;
    Ok(Value::Vector(mixed(l, vector, curved, fac)))
}

/// `ShaderNodeFloatCurve`.
pub(super) fn float_curve(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let value = l.f1(at, "Value")?;
    let fac = l.f1(at, "Factor")?;
    let curves = curves_of(l, at, 1)?;
    let curved = through(l, curves, 0, value);
    Ok(Value::Float(match l.known(fac) {
        Some(1.0) => curved,
        _ => l.op(OpCode::math_mix, &[value, curved, fac]),
    }))
}

fn mixed(l: &mut Lowering, plain: NodeId, curved: NodeId, fac: NodeId) -> NodeId {
    match l.known(fac) {
        Some(1.0) => curved,
        _ => l.op(OpCode::vector_mix, &[plain, curved, fac]),
    }
}

fn curves_of<'a>(l: &Lowering<'a>, at: At, wanted: usize) -> Lowered<&'a Curves> {
    match &l.source(at).curves {
        Some(c) if c.tables.len() >= wanted && c.tables.iter().all(|t| t.len() >= 2) => Ok(c),
        _ => Err(LowerError::Content(l.place(at), "curves")),
    }
}

fn through_curves(l: &mut Lowering, at: At, triple: NodeId) -> Lowered<NodeId> {
    let curves = curves_of(l, at, 3)?;
    let parts = [0, 1, 2].map(|i| {
        let x = l.graph.component(triple, i);
        through(l, curves, i, x)
    });
    Ok(l.graph.combine(&parts))
}

/// One number through one curve; its range is brought to [0, 1] first.
fn through(l: &mut Lowering, curves: &Curves, which: usize, x: NodeId) -> NodeId {
    let table = l.graph.table(Table {
        rows: vec![curves.tables[which].clone()],
        interpolate: true,
        extrapolate: curves.extend == "EXTRAPOLATED",
    });
    let [low, high] = curves.range;
    let place = if [low, high] == [0.0, 1.0] {
        x
    } else {
        let scale = 1.0 / (high - low);
        let (scale, offset) = (l.graph.f1(scale), l.graph.f1(-low * scale));
        l.op(OpCode::math_multiply_add, &[x, scale, offset])
    };
    l.graph.look_up(table, place)
}
