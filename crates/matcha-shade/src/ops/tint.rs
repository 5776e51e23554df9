//! Operations on colours: Cycles, nodes Mix Color, Hue/Saturation/Value, Invert and others.

use crate::device::{blend, color};

operations! {
    family tint;

    /// Cycles, Mix Color, *Add*.
    mix_add(t: F1, a: F3, b: F3) -> Color {
        cost: 0.2, error: 1e-5,
        domain: [0.0, 1.0],
        eval: blend::blend_add,
    }

    /// Cycles, Mix Color, *Multiply*.
    mix_multiply(t: F1, a: F3, b: F3) -> Color {
        cost: 0.3, error: 1e-5,
        domain: [0.0, 1.0],
        eval: blend::blend_multiply,
    }

    /// Cycles, Mix Color, *Subtract*.
    mix_subtract(t: F1, a: F3, b: F3) -> Color {
        cost: 0.2, error: 1e-5,
        domain: [0.0, 1.0],
        eval: blend::blend_subtract,
    }

    /// Cycles, Mix Color, *Screen*.
    mix_screen(t: F1, a: F3, b: F3) -> Color {
        cost: 0.3, error: 1e-5,
        domain: [0.0, 1.0],
        eval: blend::blend_screen,
    }

    /// Cycles, Mix Color, *Overlay*.
    mix_overlay(t: F1, a: F3, b: F3) -> Color {
        cost: 0.4, error: 1e-5,
        domain: [0.0, 1.0],
        eval: blend::blend_overlay,
    }

    /// Cycles, Mix Color, *Divide*.
    mix_divide(t: F1, a: F3, b: F3) -> Color {
        cost: 0.6, error: 1e-3,
        domain: [0.0, 1.0],
        eval: blend::blend_divide,
    }

    /// Cycles, Mix Color, *Difference*.
    mix_difference(t: F1, a: F3, b: F3) -> Color {
        cost: 0.3, error: 1e-5,
        domain: [0.0, 1.0],
        eval: blend::blend_difference,
    }

    /// Cycles, Mix Color, *Exclusion*.
    mix_exclusion(t: F1, a: F3, b: F3) -> Color {
        cost: 0.4, error: 1e-5,
        domain: [0.0, 1.0],
        eval: blend::blend_exclusion,
    }

    /// Cycles, Mix Color, *Darken*.
    mix_darken(t: F1, a: F3, b: F3) -> Color {
        cost: 0.3, error: 1e-5,
        domain: [0.0, 1.0],
        eval: blend::blend_darken,
    }

    /// Cycles, Mix Color, *Lighten*.
    mix_lighten(t: F1, a: F3, b: F3) -> Color {
        cost: 0.3, error: 1e-5,
        domain: [0.0, 1.0],
        eval: blend::blend_lighten,
    }

    /// Cycles, Mix Color, *Dodge*.
    mix_dodge(t: F1, a: F3, b: F3) -> Color {
        cost: 0.8, error: 1e-3,
        domain: [0.0, 1.0],
        eval: blend::blend_dodge,
    }

    /// Cycles, Mix Color, *Burn*.
    mix_burn(t: F1, a: F3, b: F3) -> Color {
        cost: 0.9, error: 1e-3,
        domain: [0.0, 1.0],
        eval: blend::blend_burn,
    }

    /// Cycles, Mix Color, *Hue*.
    mix_hue(t: F1, a: F3, b: F3) -> Color {
        cost: 3.6, error: 1e-3,
        domain: [0.0, 1.0],
        eval: blend::blend_hue,
    }

    /// Cycles, Mix Color, *Saturation*.
    mix_saturation(t: F1, a: F3, b: F3) -> Color {
        cost: 3.8, error: 1e-3,
        domain: [0.0, 1.0],
        eval: blend::blend_saturation,
    }

    /// Cycles, Mix Color, *Value*.
    mix_value(t: F1, a: F3, b: F3) -> Color {
        cost: 3.5, error: 1e-3,
        domain: [0.0, 1.0],
        eval: blend::blend_value,
    }

    /// Cycles, Mix Color, *Color*.
    mix_color(t: F1, a: F3, b: F3) -> Color {
        cost: 3.7, error: 1e-3,
        domain: [0.0, 1.0],
        eval: blend::blend_color,
    }

    /// Cycles, Mix Color, *Soft Light*.
    mix_soft_light(t: F1, a: F3, b: F3) -> Color {
        cost: 0.5, error: 1e-5,
        domain: [0.0, 1.0],
        eval: blend::blend_soft_light,
    }

    /// Cycles, Mix Color, *Linear Light*.
    mix_linear_light(t: F1, a: F3, b: F3) -> Color {
        cost: 0.3, error: 1e-5,
        domain: [0.0, 1.0],
        eval: blend::blend_linear_light,
    }

    /// Relative luminance of linear Rec.709: a colour as a number.
    color_luminance(c: F3) -> F1 {
        cost: 0.1, error: 1e-6,
        eval: color::color_luminance,
    }

    /// Hue, saturation, value.
    color_to_hsv(c: F3) -> F3 {
        cost: 1.4, error: 1e-3,
        domain: [0.0, 1.0],
        eval: color::color_to_hsv,
    }

    /// Colour of hue, saturation, value.
    color_from_hsv(hsv: F3) -> Color {
        cost: 1.8, error: 1e-5,
        domain: [0.0, 1.0],
        eval: color::color_from_hsv,
    }

    /// Hue, saturation, lightness.
    color_to_hsl(c: F3) -> F3 {
        cost: 1.5, error: 1e-3,
        domain: [0.0, 1.0],
        eval: color::color_to_hsl,
    }

    /// Colour of hue, saturation, lightness.
    color_from_hsl(hsl: F3) -> Color {
        cost: 0.4, error: 1e-5,
        domain: [0.0, 1.0],
        eval: color::color_from_hsl,
    }

    /// Cycles, Hue/Saturation/Value.
    color_adjust_hsv(c: F3, hue: F1, saturation: F1, value: F1, fac: F1) -> Color {
        cost: 4.3, error: 1e-3,
        domain: [0.0, 1.0],
        eval: color::color_adjust_hsv,
    }

    /// Cycles, Invert Color.
    color_invert(c: F3, fac: F1) -> Color {
        cost: 0.4, error: 1e-6,
        eval: color::color_invert,
    }

    /// Cycles, Brightness/Contrast.
    color_bright_contrast(c: F3, bright: F1, contrast: F1) -> Color {
        cost: 0.4, error: 1e-5,
        eval: color::color_bright_contrast,
    }

    /// Cycles, Gamma; components that are not positive stay.
    color_gamma(c: F3, gamma: F1) -> Color {
        cost: 3.5, error: 1e-4,
        eval: color::color_gamma,
    }
}
