//! AgX as Blender 4 shows it (Troy Sobotka's, in Eary Chow's form): the formation that
//! its OCIO configuration holds as a table, computed instead. In Rec.2020: inset of the
//! primaries, log2 from −10 to +6.5 stops around middle grey, a sigmoid, 2.4 as display
//! power, part of the way back to the hue before, outset, and out-of-gamut colours
//! brought in at equal luminance.

use super::view::srgb;
use glam::{Mat3, Vec3, vec3};

/// Rows of a matrix.
const fn rows(r0: [f32; 3], r1: [f32; 3], r2: [f32; 3]) -> Mat3 {
    Mat3::from_cols_array(&[
        r0[0], r1[0], r2[0], r0[1], r1[1], r2[1], r0[2], r1[2], r2[2],
    ])
}

/// ITU-R BT.2087: Rec.709 to Rec.2020.
const TO_2020: Mat3 = rows(
    [0.627_403_9, 0.329_283, 0.043_313_06],
    [0.069_097_29, 0.919_540_4, 0.011_362_315],
    [0.016_391_44, 0.088_013_31, 0.895_595_3],
);

/// And back.
const FROM_2020: Mat3 = rows(
    [1.660_491, -0.587_641_1, -0.072_849_86],
    [-0.124_550_48, 1.132_899_9, -0.008_349_422],
    [-0.018_150_763, -0.100_578_9, 1.118_729_7],
);

/// Primaries rotated by 3, −1 and −2 degrees and drawn in by 0.4, 0.22 and 0.13
/// (Blender's `config.ocio`, colour space "AgX Log").
const INSET: Mat3 = rows(
    [0.856_627_15, 0.095_121_24, 0.048_251_606],
    [0.137_318_97, 0.761_242, 0.101_439_04],
    [0.111_898_21, 0.076_799_42, 0.811_302_37],
);

/// Undoes an inset of 0.4, 0.22 and 0.04 without rotation.
const OUTSET: Mat3 = rows(
    [1.127_100_6, -0.110_606_64, -0.016_493_939],
    [-0.141_329_76, 1.157_823_7, -0.016_493_939],
    [-0.141_329_76, -0.110_606_64, 1.251_936_4],
);

const LUMINANCE_2020: Vec3 = vec3(0.2627, 0.678, 0.0593);
const LUMINANCE_709: Vec3 = vec3(0.212_67, 0.715_15, 0.072_17);

const MIDDLE_GREY: f32 = 0.18;
const STOPS_BELOW: f32 = 10.0;
const STOPS: f32 = 16.5;
const DISPLAY_POWER: f32 = 2.4;
/// How much of the hue's change is taken back.
const HUE_KEPT: f32 = 0.4;

/// Linear Rec.709 to what an sRGB display is sent.
pub(super) fn display(color: [f32; 3]) -> [f32; 3] {
    // More than the eye or the curve can tell apart, and no infinities below.
    let color = Vec3::from_array(color.map(|x| x.clamp(-1e6, 1e6)));
    let inset = INSET * into_gamut(TO_2020 * color, LUMINANCE_2020);
    let formed = Vec3::from_array(inset.to_array().map(form));
    let outset = OUTSET * keep_hue(inset, formed);
    into_gamut(FROM_2020 * outset, LUMINANCE_709)
        .to_array()
        .map(srgb)
}

/// One channel from scene to linear display.
fn form(x: f32) -> f32 {
    let stops = (x.max(1e-10) / MIDDLE_GREY).log2();
    let position = ((stops + STOPS_BELOW) / STOPS).clamp(0.0, 1.0);
    sigmoid(position).clamp(0.0, 1.0).powf(DISPLAY_POWER)
}

/// Two arms of `t / (1 + t^p)^(1/p)`, p = 1.5, that meet in middle grey with a slope of
/// 2.4 and end in (0, 0) and (1, 1).
fn sigmoid(x: f32) -> f32 {
    const SLOPE: f32 = 2.4;
    let pivot_x = STOPS_BELOW / STOPS;
    let pivot_y = MIDDLE_GREY.powf(1.0 / DISPLAY_POWER);
    let arm = |dx: f32, length: f32, height: f32| {
        let scale = arm_scale(SLOPE * length, height);
        let t = SLOPE * dx / scale;
        scale * t / (1.0 + t.powf(1.5)).powf(1.0 / 1.5)
    };
    if x < pivot_x {
        pivot_y - arm(pivot_x - x, pivot_x, pivot_y)
    } else {
        pivot_y + arm(x - pivot_x, 1.0 - pivot_x, 1.0 - pivot_y)
    }
}

/// The scale at which an arm whose straight line would rise by `rise` ends at `height`.
fn arm_scale(rise: f32, height: f32) -> f32 {
    (rise.powf(-1.5) * ((rise / height).powf(1.5) - 1.0)).powf(-1.0 / 1.5)
}

/// `formed` with its hue turned part of the way to that of `before`; saturation and value
/// (HSV) stay.
fn keep_hue(before: Vec3, formed: Vec3) -> Vec3 {
    let (wanted, now) = (hue(before), hue(formed));
    let turn = (wanted - now + 0.5).rem_euclid(1.0) - 0.5;
    let hue = now + (1.0 - HUE_KEPT) * turn;
    let value = formed.max_element();
    let chroma = value - formed.min_element();
    let channel = |n: f32| {
        let k = (n + hue * 6.0).rem_euclid(6.0);
        value - chroma * k.min(4.0 - k).clamp(0.0, 1.0)
    };
    vec3(channel(5.0), channel(3.0), channel(1.0))
}

/// Hue of HSV, 0 to 1; of a grey, 0.
fn hue(c: Vec3) -> f32 {
    let (largest, chroma) = (c.max_element(), c.max_element() - c.min_element());
    if chroma <= 0.0 {
        return 0.0;
    }
    let sector = if largest == c.x {
        ((c.y - c.z) / chroma).rem_euclid(6.0)
    } else if largest == c.y {
        (c.z - c.x) / chroma + 2.0
    } else {
        (c.x - c.y) / chroma + 4.0
    };
    sector / 6.0
}

/// Lifts negative channels to zero, and darkens again to the luminance from before.
fn into_gamut(c: Vec3, weights: Vec3) -> Vec3 {
    let wanted = compensated_luminance(c, weights);
    let lifted = c + Vec3::splat((-c.min_element()).max(0.0));
    let now = compensated_luminance(lifted, weights);
    if now > wanted && now > 0.0 {
        lifted * (wanted / now)
    } else {
        lifted
    }
}

/// Luminance to which, in the dark, that of the opponent colour adds, so that negative
/// channels count less.
fn compensated_luminance(c: Vec3, weights: Vec3) -> f32 {
    let luminance = c.dot(weights);
    let opponent = Vec3::splat(c.max_element()) - c;
    let raised = opponent.max_element() - opponent.dot(weights) + luminance;
    let share = luminance.abs().powf(0.08).clamp(0.0, 1.0);
    raised + (luminance - raised) * share
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes(color: [f32; 3]) -> [f32; 3] {
        display(color).map(|x| x.clamp(0.0, 1.0) * 255.0)
    }

    #[test]
    fn ends_and_middle() {
        assert!(bytes([0.0; 3]).iter().all(|&x| x < 0.5));
        assert!(bytes([1e6; 3]).iter().all(|&x| x > 254.5));
        let grey = bytes([MIDDLE_GREY; 3]);
        assert!(
            grey.iter()
                .all(|x| (x / 255.0 - srgb(MIDDLE_GREY)).abs() < 0.002),
            "{grey:?}"
        );
    }

    #[test]
    fn greys_stay_grey_and_rise() {
        let mut last = -1.0;
        for k in -140..80 {
            let [r, g, b] = bytes([(k as f32 / 10.0).exp2(); 3]);
            assert!(
                (r - g).abs() < 0.1 && (b - g).abs() < 0.1 && g >= last - 1e-3,
                "{k} {r} {g} {b}"
            );
            last = g;
        }
    }

    #[test]
    fn nothing_is_not_a_number() {
        for x in [-1e30, -1.0, 0.0, 1e-30, 1e30, f32::INFINITY] {
            for y in [-5.0, 0.0, 3.0] {
                assert!(
                    display([x, y, 0.5]).iter().all(|v| v.is_finite()),
                    "{x} {y}"
                );
            }
        }
    }

    /// What Blender 4.5's own AgX made of these colours (`blender/tests/view_reference.py`).
    /// Blender interpolates a table of 57³ colours; this formula, sampled at the table's
    /// places and interpolated as there, strays by more than 2 in one of the 3,072 channels,
    /// a very bright green. Between the places the table itself strays in three more.
    #[test]
    fn colours_come_out_as_in_blender() {
        crate::picture::view::tests::check_reference(
            include_str!("../../tests/data/agx.csv"),
            display,
            4,
        );
    }
}
