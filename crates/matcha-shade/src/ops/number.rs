//! Operations on numbers: Cycles, nodes Math, Clamp and Map Range.

use crate::device::{math, scalar};

operations! {
    family number;

    /// a / b, 0 where b is 0. Cycles, Math.
    math_divide(a: F1, b: F1) -> F1 {
        cost: 0.5, error: 1e-4,
        eval: scalar::scalar_divide,
    }

    /// aᵇ, 0 where that is not a number. Cycles, Math.
    math_power(a: F1, b: F1) -> F1 {
        cost: 2.7, error: 1e-4,
        eval: scalar::scalar_power,
    }

    /// Logarithm of a to the base b, 0 where it does not exist. Cycles, Math.
    math_logarithm(a: F1, b: F1) -> F1 {
        cost: 1.9, error: 1e-3,
        eval: scalar::scalar_logarithm,
    }

    /// √a, 0 of negative numbers. Cycles, Math.
    math_sqrt(a: F1) -> F1 {
        cost: 0.3, error: 1e-6,
        eval: scalar::scalar_sqrt,
    }

    /// 1/√a, 0 where a is not positive. Cycles, Math.
    math_inverse_sqrt(a: F1) -> F1 {
        cost: 0.6, error: 1e-4,
        eval: scalar::scalar_inverse_sqrt,
    }

    /// |a|. Cycles, Math.
    math_absolute(a: F1) -> F1 {
        cost: 0.1, error: 0.0,
        eval: math::abs,
    }

    /// 1 where a < b, else 0. Cycles, Math.
    math_less_than(a: F1, b: F1) -> F1 {
        cost: 0.3, error: 0.0,
        eval: scalar::scalar_less_than,
    }

    /// 1 where a > b, else 0. Cycles, Math.
    math_greater_than(a: F1, b: F1) -> F1 {
        cost: 0.3, error: 0.0,
        eval: scalar::scalar_greater_than,
    }

    /// −1, 0 or 1. Cycles, Math.
    math_sign(a: F1) -> F1 {
        cost: 0.1, error: 0.0,
        eval: scalar::scalar_sign,
    }

    /// The nearest whole number, halves upward. Cycles, Math.
    math_round(a: F1) -> F1 {
        cost: 0.4, error: 0.0,
        eval: scalar::scalar_round,
    }

    /// The largest whole number not above a. Cycles, Math.
    math_floor(a: F1) -> F1 {
        cost: 0.3, error: 0.0,
        eval: math::floor,
    }

    /// The smallest whole number not below a. Cycles, Math.
    math_ceil(a: F1) -> F1 {
        cost: 0.3, error: 0.0,
        eval: math::ceil,
    }

    /// a without its fraction. Cycles, Math.
    math_truncate(a: F1) -> F1 {
        cost: 0.2, error: 0.0,
        eval: math::trunc,
    }

    /// a minus its floor. Cycles, Math.
    math_fraction(a: F1) -> F1 {
        cost: 0.4, error: 1e-6,
        eval: math::fract,
    }

    /// The remainder of a / b with the sign of a, 0 where b is 0. Cycles, Math.
    math_modulo(a: F1, b: F1) -> F1 {
        cost: 1.1, error: 1e-4,
        eval: math::modulo,
    }

    /// The remainder of a / b with the sign of b, 0 where b is 0. Cycles, Math.
    math_floored_modulo(a: F1, b: F1) -> F1 {
        cost: 1.1, error: 1e-4,
        eval: math::floored_modulo,
    }

    /// a repeated between b (high) and c (low). Cycles, Math.
    math_wrap(a: F1, b: F1, c: F1) -> F1 {
        cost: 1.1, error: 1e-4,
        eval: scalar::scalar_wrap,
    }

    /// The multiple of b at or below a. Cycles, Math.
    math_snap(a: F1, b: F1) -> F1 {
        cost: 1.0, error: 1e-4,
        eval: scalar::scalar_snap,
    }

    /// A triangle wave of height b. Cycles, Math.
    math_pingpong(a: F1, b: F1) -> F1 {
        cost: 1.3, error: 1e-4,
        eval: scalar::scalar_pingpong,
    }

    /// 1 where |a − b| ≤ c, else 0. Cycles, Math.
    math_compare(a: F1, b: F1, c: F1) -> F1 {
        cost: 0.4, error: 0.0,
        eval: scalar::scalar_compare,
    }

    /// The smaller, blended over c. Cycles, Math.
    math_smooth_minimum(a: F1, b: F1, c: F1) -> F1 {
        cost: 1.0, error: 1e-5,
        eval: scalar::scalar_smooth_minimum,
    }

    /// The larger, blended over c. Cycles, Math.
    math_smooth_maximum(a: F1, b: F1, c: F1) -> F1 {
        cost: 1.0, error: 1e-5,
        eval: scalar::scalar_smooth_maximum,
    }

    /// eᵃ. Cycles, Math.
    math_exponent(a: F1) -> F1 {
        cost: 1.8, error: 1e-6,
        eval: math::exp,
    }

    /// sin a. Cycles, Math.
    math_sine(a: F1) -> F1 {
        cost: 1.4, error: 1e-6,
        eval: math::sin,
    }

    /// cos a. Cycles, Math.
    math_cosine(a: F1) -> F1 {
        cost: 1.4, error: 1e-6,
        eval: math::cos,
    }

    /// tan a. Cycles, Math.
    math_tangent(a: F1) -> F1 {
        cost: 1.8, error: 1e-3,
        eval: math::tan,
    }

    /// Arc sine of a limited to [−1, 1]. Cycles, Math.
    math_arcsine(a: F1) -> F1 {
        cost: 1.3, error: 1e-6,
        eval: math::asin,
    }

    /// Arc cosine of a limited to [−1, 1]. Cycles, Math.
    math_arccosine(a: F1) -> F1 {
        cost: 1.4, error: 1e-6,
        eval: math::acos,
    }

    /// Arc tangent. Cycles, Math.
    math_arctangent(a: F1) -> F1 {
        cost: 1.5, error: 1e-6,
        eval: math::atan,
    }

    /// Angle of the point (b, a). Cycles, Math.
    math_arctan2(a: F1, b: F1) -> F1 {
        cost: 2.0, error: 1e-6,
        eval: math::atan2,
    }

    /// Hyperbolic sine. Cycles, Math.
    math_sinh(a: F1) -> F1 {
        cost: 2.3, error: 1e-5,
        eval: math::sinh,
    }

    /// Hyperbolic cosine. Cycles, Math.
    math_cosh(a: F1) -> F1 {
        cost: 2.2, error: 1e-5,
        eval: math::cosh,
    }

    /// Hyperbolic tangent. Cycles, Math.
    math_tanh(a: F1) -> F1 {
        cost: 2.4, error: 1e-5,
        eval: math::tanh,
    }

    /// x limited to the range of both. Cycles, Clamp, *Range*.
    clamp_range(x: F1, low: F1, high: F1) -> F1 {
        cost: 0.4, error: 0.0,
        eval: scalar::scalar_clamp_range,
    }

    /// min(max(x, low), high). Cycles, Clamp, *Min Max*.
    clamp_min_max(x: F1, low: F1, high: F1) -> F1 {
        cost: 0.3, error: 0.0,
        eval: math::clamp,
    }

    /// x from one range to another, linearly; 0 where the first is empty. Cycles, Map Range.
    map_range_linear(x: F1, from_min: F1, from_max: F1, to_min: F1, to_max: F1) -> F1 {
        cost: 0.7, error: 1e-4,
        eval: scalar::scalar_map_range,
    }

    /// x from one range to another, in steps; 0 where the first is empty. Cycles, Map Range.
    map_range_stepped(x: F1, from_min: F1, from_max: F1, to_min: F1, to_max: F1, steps: F1) -> F1 {
        cost: 1.5, error: 1e-4,
        eval: scalar::scalar_map_range_stepped,
    }

    /// x from one range to another, by a smooth step; 0 where the first is empty. Cycles, Map Range.
    map_range_smooth(x: F1, from_min: F1, from_max: F1, to_min: F1, to_max: F1) -> F1 {
        cost: 0.9, error: 1e-4,
        eval: scalar::scalar_map_range_smooth,
    }

    /// x from one range to another, by a smoother step; 0 where the first is empty. Cycles, Map Range.
    map_range_smoother(x: F1, from_min: F1, from_max: F1, to_min: F1, to_max: F1) -> F1 {
        cost: 1.1, error: 1e-4,
        eval: scalar::scalar_map_range_smoother,
    }

    /// Where x lies in a range, 0 where it is empty. Cycles, Map Range of vectors.
    range_factor(x: F1, from_min: F1, from_max: F1) -> F1 {
        cost: 0.5, error: 1e-4,
        eval: scalar::scalar_range_factor,
    }
}
