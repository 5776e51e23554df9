//! From a filtered texel to a colour: alpha, then the sRGB transfer function (IEC 61966-2-1).

use matcha_shade::device::math::{max, pow_positive, safe_divide};

/// Encoded number up to which the transfer function is a line.
pub const SRGB_LINE_END: f32 = 0.040_45;
/// The line's slope, encoded over linear.
pub const SRGB_LINE_SLOPE: f32 = 12.92;
/// Offset of the curve.
pub const SRGB_OFFSET: f32 = 0.055;
/// The curve's number where linear light is 1: 1 plus the offset.
pub const SRGB_SCALE: f32 = 1.055;
/// Exponent of the curve.
pub const SRGB_EXPONENT: f32 = 2.4;

/// Linear light of an encoded number, both 0 to 1 and beyond; relative error 5·10⁻⁷.
#[inline(always)]
pub fn srgb_to_linear(encoded: f32) -> f32 {
    if encoded <= SRGB_LINE_END {
        max(encoded, 0.0) / SRGB_LINE_SLOPE
    } else {
        pow_positive((encoded + SRGB_OFFSET) / SRGB_SCALE, SRGB_EXPONENT)
    }
}

/// Colour without the alpha that it was multiplied by; where alpha is 0 or 1 as it is.
#[inline(always)]
pub fn texture_unassociated(value: f32, alpha: f32) -> f32 {
    if alpha != 0.0 && alpha != 1.0 {
        safe_divide(value, alpha)
    } else {
        value
    }
}
