//! Blackbody and Wavelength: colours of spectra, as tables that are made once.

use super::{At, Lowered, Lowering, Value};
use crate::graph::Table;
use crate::ops::OpCode;

/// Samples of a table.
const SAMPLES: usize = 512;
/// Temperatures that Cycles knows, kelvin.
const KELVIN: [f64; 2] = [800.0, 12_000.0];
/// Wavelengths that Cycles knows, nanometres.
const NANOMETRES: [f64; 2] = [380.0, 780.0];

/// `ShaderNodeBlackbody`. The table is over the inverse of the temperature, in which
/// the colour changes evenly.
pub(super) fn blackbody(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let kelvin = l.f1(at, "Temperature")?;
    let [cold, hot] = KELVIN.map(|t| 1.0 / t);
    let table = table(l, |t| blackbody_color(1.0 / (cold + (hot - cold) * t)));
    let one = l.graph.f1(1.0);
    let low = l.graph.f1(KELVIN[0] as f32);
    let limited = l.op(OpCode::math_maximum, &[kelvin, low]);
    let inverse = l.op(OpCode::math_divide, &[one, limited]);
    let scale = 1.0 / (hot - cold);
    let (scale, offset) = (l.graph.f1(scale as f32), l.graph.f1((-cold * scale) as f32));
    let place = l.op(OpCode::math_multiply_add, &[inverse, scale, offset]);
    Ok(Value::Color(l.graph.look_up(table, place)))
}

/// `ShaderNodeWavelength`.
pub(super) fn wavelength(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let length = l.f1(at, "Wavelength")?;
    let [low, high] = NANOMETRES;
    let table = table(l, |t| {
        let xyz = color_matching(low + (high - low) * t);
        let ends = if t <= 0.0 || t >= 1.0 {
            0.0
        } else {
            1.0 / 2.52
        };
        rec709(xyz).map(|c| (c * ends).max(0.0))
    });
    let scale = 1.0 / (high - low);
    let (scale, offset) = (l.graph.f1(scale as f32), l.graph.f1((-low * scale) as f32));
    let place = l.op(OpCode::math_multiply_add, &[length, scale, offset]);
    Ok(Value::Color(l.graph.look_up(table, place)))
}

fn table(l: &mut Lowering, color: impl Fn(f64) -> [f64; 3]) -> crate::graph::TableId {
    let samples: Vec<[f64; 3]> = (0..SAMPLES)
        .map(|i| color(i as f64 / (SAMPLES - 1) as f64))
        .collect();
    let rows = (0..3)
        .map(|c| samples.iter().map(|s| s[c] as f32).collect())
        .collect();
    l.graph.table(Table {
        rows,
        interpolate: true,
        extrapolate: false,
    })
}

/// Linear Rec.709 of a black body at luminance one (M. Planck 1901), without negative
/// parts.
pub(super) fn blackbody_color(kelvin: f64) -> [f64; 3] {
    let mut xyz = [0.0; 3];
    for nanometres in 360..=830 {
        let x = f64::from(nanometres);
        // Second radiation constant, nm·K.
        let power = x.powi(-5) / ((1.438_776_877e7 / (x * kelvin)).exp() - 1.0);
        for (sum, part) in xyz.iter_mut().zip(color_matching(x)) {
            *sum += part * power;
        }
    }
    let luminance = xyz[1];
    rec709(xyz.map(|v| v / luminance)).map(|c| c.max(0.0))
}

/// The CIE 1931 observer in closed form: C. Wyman, P.-P. Sloan, P. Shirley, "Simple
/// Analytic Approximations to the CIE XYZ Color Matching Functions", JCGT 2013.
fn color_matching(nanometres: f64) -> [f64; 3] {
    let lobe = |mean: f64, below: f64, above: f64| {
        let t = (nanometres - mean) * if nanometres < mean { below } else { above };
        (-0.5 * t * t).exp()
    };
    let x = 0.362 * lobe(442.0, 0.0624, 0.0374) + 1.056 * lobe(599.8, 0.0264, 0.0323)
        - 0.065 * lobe(501.1, 0.0490, 0.0382);
    let y = 0.821 * lobe(568.8, 0.0213, 0.0247) + 0.286 * lobe(530.9, 0.0613, 0.0322);
    let z = 1.217 * lobe(437.0, 0.0845, 0.0278) + 0.681 * lobe(459.0, 0.0385, 0.0725);
    [x, y, z]
}

/// XYZ to linear Rec.709 (ITU-R BT.709, white D65).
fn rec709([x, y, z]: [f64; 3]) -> [f64; 3] {
    [
        3.240_454_2 * x - 1.537_138_5 * y - 0.498_531_4 * z,
        -0.969_266 * x + 1.876_010_8 * y + 0.041_556 * z,
        0.055_643_4 * x - 0.204_025_9 * y + 1.057_225_2 * z,
    ]
}
