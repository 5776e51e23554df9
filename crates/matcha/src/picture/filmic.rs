//! Filmic as Blender shows it (Troy Sobotka's): a logarithm over 16.5 stops, a curve, and
//! bright colours that fade to white.

use glam::Vec3;

const MIDDLE_GREY: f32 = 0.18;
/// Stops below middle grey at which the curve begins.
const STOPS_BELOW: f32 = 10.0;
/// Stops that the curve spans.
const STOPS: f32 = 16.5;
/// Stops above middle grey from which colours fade, and at which they are white.
const FADE: [f32; 2] = [6.0, 15.0];

/// The curve of base contrast over the logarithm, both 0 to 1: evenly spaced samples of
/// what Blender 4.5 shows; linear between them it is within 0.25/255.
const CURVE: [f32; 33] = [
    0.00000, 0.00197, 0.00448, 0.00770, 0.01180, 0.01703, 0.02369, 0.03213, 0.04280, 0.05622,
    0.07300, 0.09385, 0.11950, 0.15071, 0.18817, 0.23238, 0.28353, 0.34088, 0.40448, 0.47245,
    0.54219, 0.61156, 0.67853, 0.74096, 0.79716, 0.84611, 0.88737, 0.92107, 0.94773, 0.96809,
    0.98303, 0.99339, 1.00000,
];

/// Linear Rec.709 to what an sRGB display is sent.
pub(super) fn display(color: [f32; 3]) -> [f32; 3] {
    let color = Vec3::from_array(color.map(|x| x.clamp(0.0, 1e6)));
    fade(color).to_array().map(|x| {
        let stops = (x.max(1e-10) / MIDDLE_GREY).log2();
        curve(((stops + STOPS_BELOW) / STOPS).clamp(0.0, 1.0))
    })
}

/// Mixes a colour with the grey of its largest channel, the more the brighter it is.
fn fade(color: Vec3) -> Vec3 {
    let [first, last] = FADE.map(|stops| MIDDLE_GREY * stops.exp2());
    let largest = color.max_element();
    let share = ((largest - first) / (last - first))
        .clamp(0.0, 1.0)
        .powf(1.1);
    color.lerp(Vec3::splat(largest), share)
}

fn curve(x: f32) -> f32 {
    let position = x * (CURVE.len() - 1) as f32;
    let index = (position as usize).min(CURVE.len() - 2);
    let [a, b] = [CURVE[index], CURVE[index + 1]];
    a + (b - a) * (position - index as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What Blender 4.5's own Filmic made of these colours (`blender/tests/view_reference.py`).
    #[test]
    fn colours_come_out_as_in_blender() {
        crate::picture::view::tests::check_reference(
            include_str!("../../tests/data/filmic.csv"),
            display,
            0,
        );
    }

    #[test]
    fn nothing_is_not_a_number() {
        for x in [-1e30, 0.0, 1e30, f32::INFINITY] {
            assert!(display([x, 0.0, 0.5]).iter().all(|v| v.is_finite()));
        }
    }
}
