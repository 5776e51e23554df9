//! Colours: luminance, HSV and HSL (A. R. Smith, "Color Gamut Transform Pairs", 1978),
//! and Cycles' nodes on colours.

use super::math::*;

/// Relative luminance of linear Rec.709.
#[inline(always)]
pub fn color_luminance(c: Vec3) -> f32 {
    0.212_672_9 * c.x + 0.715_152_2 * c.y + 0.072_175 * c.z
}

/// Hue, saturation, value.
#[inline(always)]
pub fn color_to_hsv(c: Vec3) -> Vec3 {
    let high = max(c.x, max(c.y, c.z));
    let low = min(c.x, min(c.y, c.z));
    let range = high - low;
    let saturation = safe_divide(range, high);
    let r = safe_divide(high - c.x, range);
    let g = safe_divide(high - c.y, range);
    let b = safe_divide(high - c.z, range);
    let sixths = select(
        select(4.0 + g - r, 2.0 + r - b, c.y == high),
        b - g,
        c.x == high,
    );
    let hue = sixths * (1.0 / 6.0);
    let hue = select(hue, hue + 1.0, hue < 0.0);
    vec3(select(0.0, hue, saturation != 0.0), saturation, high)
}

/// One channel of [`color_from_hsv`]; `shift` in sixths of a turn.
#[inline(always)]
pub fn color_hsv_channel(hue: f32, saturation: f32, value: f32, shift: f32) -> f32 {
    let h = hue * 6.0 + shift;
    let k = h - 6.0 * floor(h * (1.0 / 6.0));
    value - value * saturation * clamp(min(k, 4.0 - k), 0.0, 1.0)
}

/// Colour of hue, saturation, value. Outside of [0, 1] a hue is in the sixth sector, as
/// in Cycles, with the fraction that it has.
#[inline(always)]
pub fn color_from_hsv(hsv: Vec3) -> Vec3 {
    let outside = (hsv.x < 0.0) | (hsv.x > 1.0);
    let hue = select(hsv.x, (5.0 + fract(hsv.x * 6.0)) * (1.0 / 6.0), outside);
    vec3(
        color_hsv_channel(hue, hsv.y, hsv.z, 5.0),
        color_hsv_channel(hue, hsv.y, hsv.z, 3.0),
        color_hsv_channel(hue, hsv.y, hsv.z, 1.0),
    )
}

/// Hue, saturation, lightness.
#[inline(always)]
pub fn color_to_hsl(c: Vec3) -> Vec3 {
    let high = max(c.x, max(c.y, c.z));
    let low = min(c.x, min(c.y, c.z));
    let range = high - low;
    let lightness = min(1.0, (high + low) * 0.5);
    let dark = safe_divide(range, high + low);
    let bright = safe_divide(range, 2.0 - high - low);
    let saturation = select(dark, bright, lightness > 0.5);
    let from_red = safe_divide(c.y - c.z, range) + select(0.0, 6.0, c.y < c.z);
    let from_green = safe_divide(c.z - c.x, range) + 2.0;
    let from_blue = safe_divide(c.x - c.y, range) + 4.0;
    let sixths = select(
        select(from_blue, from_green, c.y == high),
        from_red,
        c.x == high,
    );
    let gray = range == 0.0;
    vec3(
        select(sixths * (1.0 / 6.0), 0.0, gray),
        select(saturation, 0.0, gray),
        lightness,
    )
}

/// Colour of hue, saturation, lightness.
#[inline(always)]
pub fn color_from_hsl(hsl: Vec3) -> Vec3 {
    let h = hsl.x * 6.0;
    let chroma = (1.0 - abs(2.0 * hsl.z - 1.0)) * hsl.y;
    let r = saturate(abs(h - 3.0) - 1.0);
    let g = saturate(2.0 - abs(h - 2.0));
    let b = saturate(2.0 - abs(h - 4.0));
    vec3(
        (r - 0.5) * chroma + hsl.z,
        (g - 0.5) * chroma + hsl.z,
        (b - 0.5) * chroma + hsl.z,
    )
}

/// Cycles, node Hue/Saturation/Value.
#[inline(always)]
pub fn color_adjust_hsv(c: Vec3, hue: f32, saturation: f32, value: f32, fac: f32) -> Vec3 {
    let hsv = color_to_hsv(c);
    let turned = vec3(
        fract(hsv.x + hue + 0.5),
        saturate(hsv.y * saturation),
        hsv.z * value,
    );
    max3(mix3(c, color_from_hsv(turned), fac), vec3(0.0, 0.0, 0.0))
}

/// Cycles, node Invert Color.
#[inline(always)]
pub fn color_invert(c: Vec3, fac: f32) -> Vec3 {
    mix3(c, vec3(1.0 - c.x, 1.0 - c.y, 1.0 - c.z), fac)
}

/// Cycles, node Brightness/Contrast.
#[inline(always)]
pub fn color_bright_contrast(c: Vec3, bright: f32, contrast: f32) -> Vec3 {
    let b = bright - contrast * 0.5;
    max3(c * (1.0 + contrast) + vec3(b, b, b), vec3(0.0, 0.0, 0.0))
}

/// Cycles, node Gamma: components that are not positive stay.
#[inline(always)]
pub fn color_gamma(c: Vec3, gamma: f32) -> Vec3 {
    vec3(
        select(c.x, pow_positive(c.x, gamma), (c.x > 0.0) | (gamma == 0.0)),
        select(c.y, pow_positive(c.y, gamma), (c.y > 0.0) | (gamma == 0.0)),
        select(c.z, pow_positive(c.z, gamma), (c.z > 0.0) | (gamma == 0.0)),
    )
}
