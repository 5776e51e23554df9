//! Cycles, node Mix Color: the blend modes, `t` the factor, `a` below, `b` above.

use super::color::*;
use super::math::*;

/// Sum.
#[inline(always)]
pub fn blend_add(t: f32, a: Vec3, b: Vec3) -> Vec3 {
    a + b * t
}

/// Product.
#[inline(always)]
pub fn blend_multiply(t: f32, a: Vec3, b: Vec3) -> Vec3 {
    mix3(a, a * b, t)
}

/// Difference.
#[inline(always)]
pub fn blend_subtract(t: f32, a: Vec3, b: Vec3) -> Vec3 {
    a - b * t
}

/// Product of the complements.
#[inline(always)]
pub fn blend_screen(t: f32, a: Vec3, b: Vec3) -> Vec3 {
    let one = vec3(1.0, 1.0, 1.0);
    one - (one - b * t) * (one - a)
}

/// One channel of [`blend_overlay`].
#[inline(always)]
pub fn blend_overlay_channel(t: f32, a: f32, b: f32) -> f32 {
    let keep = 1.0 - t;
    let dark = a * (keep + 2.0 * t * b);
    let bright = 1.0 - (keep + 2.0 * t * (1.0 - b)) * (1.0 - a);
    select(bright, dark, a < 0.5)
}

/// Product in the dark, screen in the bright.
#[inline(always)]
pub fn blend_overlay(t: f32, a: Vec3, b: Vec3) -> Vec3 {
    vec3(
        blend_overlay_channel(t, a.x, b.x),
        blend_overlay_channel(t, a.y, b.y),
        blend_overlay_channel(t, a.z, b.z),
    )
}

/// One channel of [`blend_divide`].
#[inline(always)]
pub fn blend_divide_channel(t: f32, a: f32, b: f32) -> f32 {
    select(a, (1.0 - t) * a + t * safe_divide(a, b), b != 0.0)
}

/// Quotient; a channel that divides by 0 stays.
#[inline(always)]
pub fn blend_divide(t: f32, a: Vec3, b: Vec3) -> Vec3 {
    vec3(
        blend_divide_channel(t, a.x, b.x),
        blend_divide_channel(t, a.y, b.y),
        blend_divide_channel(t, a.z, b.z),
    )
}

/// Absolute difference.
#[inline(always)]
pub fn blend_difference(t: f32, a: Vec3, b: Vec3) -> Vec3 {
    mix3(a, abs3(a - b), t)
}

/// Softer difference.
#[inline(always)]
pub fn blend_exclusion(t: f32, a: Vec3, b: Vec3) -> Vec3 {
    max3(mix3(a, a + b - a * b * 2.0, t), vec3(0.0, 0.0, 0.0))
}

/// The darker, by channel.
#[inline(always)]
pub fn blend_darken(t: f32, a: Vec3, b: Vec3) -> Vec3 {
    mix3(a, min3(a, b), t)
}

/// The lighter, by channel.
#[inline(always)]
pub fn blend_lighten(t: f32, a: Vec3, b: Vec3) -> Vec3 {
    mix3(a, max3(a, b), t)
}

/// One channel of [`blend_dodge`].
#[inline(always)]
pub fn blend_dodge_channel(t: f32, a: f32, b: f32) -> f32 {
    let rest = 1.0 - t * b;
    let dodged = select(min(safe_divide(a, rest), 1.0), 1.0, rest <= 0.0);
    select(a, dodged, a != 0.0)
}

/// Brightens towards 1.
#[inline(always)]
pub fn blend_dodge(t: f32, a: Vec3, b: Vec3) -> Vec3 {
    vec3(
        blend_dodge_channel(t, a.x, b.x),
        blend_dodge_channel(t, a.y, b.y),
        blend_dodge_channel(t, a.z, b.z),
    )
}

/// One channel of [`blend_burn`].
#[inline(always)]
pub fn blend_burn_channel(t: f32, a: f32, b: f32) -> f32 {
    let rest = 1.0 - t + t * b;
    select(saturate(1.0 - safe_divide(1.0 - a, rest)), 0.0, rest <= 0.0)
}

/// Darkens towards 0.
#[inline(always)]
pub fn blend_burn(t: f32, a: Vec3, b: Vec3) -> Vec3 {
    vec3(
        blend_burn_channel(t, a.x, b.x),
        blend_burn_channel(t, a.y, b.y),
        blend_burn_channel(t, a.z, b.z),
    )
}

/// Hue of `b`, where it has one.
#[inline(always)]
pub fn blend_hue(t: f32, a: Vec3, b: Vec3) -> Vec3 {
    let above = color_to_hsv(b);
    let below = color_to_hsv(a);
    let mixed = mix3(a, color_from_hsv(vec3(above.x, below.y, below.z)), t);
    select3(a, mixed, above.y != 0.0)
}

/// Saturation of `b`.
#[inline(always)]
pub fn blend_saturation(t: f32, a: Vec3, b: Vec3) -> Vec3 {
    let above = color_to_hsv(b);
    let below = color_to_hsv(a);
    let mixed = color_from_hsv(vec3(below.x, mix(below.y, above.y, t), below.z));
    select3(a, mixed, below.y != 0.0)
}

/// Value of `b`.
#[inline(always)]
pub fn blend_value(t: f32, a: Vec3, b: Vec3) -> Vec3 {
    let above = color_to_hsv(b);
    let below = color_to_hsv(a);
    color_from_hsv(vec3(below.x, below.y, mix(below.z, above.z, t)))
}

/// Hue and saturation of `b`.
#[inline(always)]
pub fn blend_color(t: f32, a: Vec3, b: Vec3) -> Vec3 {
    let above = color_to_hsv(b);
    let below = color_to_hsv(a);
    let mixed = mix3(a, color_from_hsv(vec3(above.x, above.y, below.z)), t);
    select3(a, mixed, above.y != 0.0)
}

/// Soft light.
#[inline(always)]
pub fn blend_soft_light(t: f32, a: Vec3, b: Vec3) -> Vec3 {
    let one = vec3(1.0, 1.0, 1.0);
    let screen = one - (one - b) * (one - a);
    a * (1.0 - t) + ((one - a) * b * a + a * screen) * t
}

/// Linear light.
#[inline(always)]
pub fn blend_linear_light(t: f32, a: Vec3, b: Vec3) -> Vec3 {
    a + (b * 2.0 - vec3(1.0, 1.0, 1.0)) * t
}
