//! The sRGB transfer function by the processor's exact powers, and by a table of them.

use crate::device::texture_color::{
    SRGB_EXPONENT, SRGB_LINE_END, SRGB_LINE_SLOPE, SRGB_OFFSET, SRGB_SCALE,
};

/// Linear light of an encoded number, both 0 to 1 and beyond.
pub(super) fn to_linear(encoded: f32) -> f32 {
    if encoded <= SRGB_LINE_END {
        encoded.max(0.0) / SRGB_LINE_SLOPE
    } else {
        ((encoded + SRGB_OFFSET) / SRGB_SCALE).powf(SRGB_EXPONENT)
    }
}

/// The inverse of [`to_linear`].
pub(super) fn to_encoded(linear: f32) -> f32 {
    if linear <= 0.003_130_8 {
        linear.max(0.0) * SRGB_LINE_SLOPE
    } else {
        SRGB_SCALE * linear.powf(1.0 / SRGB_EXPONENT) - SRGB_OFFSET
    }
}

/// Steps of the table: with linear interpolation its error is below 1e-7.
const STEPS: usize = 2048;

/// [`to_linear`] by a table.
#[derive(Clone, Debug)]
pub(super) struct Decoder {
    /// Value at the step and difference to the next one.
    table: Box<[[f32; 2]; STEPS]>,
}

impl Decoder {
    pub(super) fn new() -> Self {
        let at = |i: usize| to_linear(i as f32 / STEPS as f32);
        Self {
            table: Box::new(std::array::from_fn(|i| [at(i), at(i + 1) - at(i)])),
        }
    }

    #[inline(always)]
    pub(super) fn linear(&self, encoded: f32) -> f32 {
        let x = encoded * STEPS as f32;
        let step = x as i32;
        match self.table.get(step as usize) {
            Some([value, slope]) if x >= 0.0 => value + slope * (x - step as f32),
            _ => to_linear(encoded),
        }
    }
}
