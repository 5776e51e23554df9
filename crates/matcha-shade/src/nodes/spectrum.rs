//! Blackbody and Wavelength: colours of spectra, as tables that are made once.

use super::{At, Lowered, Lowering, Value};
use crate::graph::Table;
use crate::ops::OpCode;

/// Samples of a table; a multiple of the observer's entries between its ends, plus one.
const SAMPLES: usize = 801;
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
    for nanometres in 380..=780 {
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

/// The CIE 1931 observer, linear between the table's entries, zero outside of it.
fn color_matching(nanometres: f64) -> [f64; 3] {
    let place = (nanometres - NANOMETRES[0]) / STEP;
    let below = place.floor();
    let last = OBSERVER.len() - 1;
    if !(0.0..=last as f64).contains(&below) {
        return [0.0; 3];
    }
    let (a, b) = (
        OBSERVER[below as usize],
        OBSERVER[(below as usize + 1).min(last)],
    );
    [0, 1, 2].map(|i| a[i] + (b[i] - a[i]) * (place - below))
}

/// XYZ to linear Rec.709 (ITU-R BT.709, white D65).
fn rec709([x, y, z]: [f64; 3]) -> [f64; 3] {
    [
        3.240_454_2 * x - 1.537_138_5 * y - 0.498_531_4 * z,
        -0.969_266 * x + 1.876_010_8 * y + 0.041_556 * z,
        0.055_643_4 * x - 0.204_025_9 * y + 1.057_225_2 * z,
    ]
}

/// Nanometres between entries of [`OBSERVER`].
const STEP: f64 = 5.0;

/// Colour matching functions x, y, z of the CIE 1931 standard observer (CIE 15:2004,
/// table T.4) from 380 to 780 nm.
#[rustfmt::skip]
const OBSERVER: [[f64; 3]; 81] = [
    [0.0014, 0.0, 0.0065],
    [0.0022, 0.0001, 0.0105],
    [0.0042, 0.0001, 0.0201],
    [0.0076, 0.0002, 0.0362],
    [0.0143, 0.0004, 0.0679],
    [0.0232, 0.0006, 0.1102],
    [0.0435, 0.0012, 0.2074],
    [0.0776, 0.0022, 0.3713],
    [0.1344, 0.004, 0.6456],
    [0.2148, 0.0073, 1.0391],
    [0.2839, 0.0116, 1.3856],
    [0.3285, 0.0168, 1.623],
    [0.3483, 0.023, 1.7471],
    [0.3481, 0.0298, 1.7826],
    [0.3362, 0.038, 1.7721],
    [0.3187, 0.048, 1.7441],
    [0.2908, 0.06, 1.6692],
    [0.2511, 0.0739, 1.5281],
    [0.1954, 0.091, 1.2876],
    [0.1421, 0.1126, 1.0419],
    [0.0956, 0.139, 0.813],
    [0.058, 0.1693, 0.6162],
    [0.032, 0.208, 0.4652],
    [0.0147, 0.2586, 0.3533],
    [0.0049, 0.323, 0.272],
    [0.0024, 0.4073, 0.2123],
    [0.0093, 0.503, 0.1582],
    [0.0291, 0.6082, 0.1117],
    [0.0633, 0.71, 0.0782],
    [0.1096, 0.7932, 0.0573],
    [0.1655, 0.862, 0.0422],
    [0.2257, 0.9149, 0.0298],
    [0.2904, 0.954, 0.0203],
    [0.3597, 0.9803, 0.0134],
    [0.4334, 0.995, 0.0087],
    [0.5121, 1.0, 0.0057],
    [0.5945, 0.995, 0.0039],
    [0.6784, 0.9786, 0.0027],
    [0.7621, 0.952, 0.0021],
    [0.8425, 0.9154, 0.0018],
    [0.9163, 0.87, 0.0017],
    [0.9786, 0.8163, 0.0014],
    [1.0263, 0.757, 0.0011],
    [1.0567, 0.6949, 0.001],
    [1.0622, 0.631, 0.0008],
    [1.0456, 0.5668, 0.0006],
    [1.0026, 0.503, 0.0003],
    [0.9384, 0.4412, 0.0002],
    [0.8544, 0.381, 0.0002],
    [0.7514, 0.321, 0.0001],
    [0.6424, 0.265, 0.0],
    [0.5419, 0.217, 0.0],
    [0.4479, 0.175, 0.0],
    [0.3608, 0.1382, 0.0],
    [0.2835, 0.107, 0.0],
    [0.2187, 0.0816, 0.0],
    [0.1649, 0.061, 0.0],
    [0.1212, 0.0446, 0.0],
    [0.0874, 0.032, 0.0],
    [0.0636, 0.0232, 0.0],
    [0.0468, 0.017, 0.0],
    [0.0329, 0.0119, 0.0],
    [0.0227, 0.0082, 0.0],
    [0.0158, 0.0057, 0.0],
    [0.0114, 0.0041, 0.0],
    [0.0081, 0.0029, 0.0],
    [0.0058, 0.0021, 0.0],
    [0.0041, 0.0015, 0.0],
    [0.0029, 0.001, 0.0],
    [0.002, 0.0007, 0.0],
    [0.0014, 0.0005, 0.0],
    [0.001, 0.0004, 0.0],
    [0.0007, 0.0002, 0.0],
    [0.0005, 0.0002, 0.0],
    [0.0003, 0.0001, 0.0],
    [0.0002, 0.0001, 0.0],
    [0.0002, 0.0001, 0.0],
    [0.0001, 0.0, 0.0],
    [0.0001, 0.0, 0.0],
    [0.0001, 0.0, 0.0],
    [0.0, 0.0, 0.0],
];
