//! Cycles, node Math, as far as it is more than one function of [`super::math`].

use super::math::*;

/// Quotient, 0 where the divisor is 0.
#[inline(always)]
pub fn scalar_divide(a: f32, b: f32) -> f32 {
    safe_divide(a, b)
}

/// aᵇ; 0 where that is not a number.
#[inline(always)]
pub fn scalar_power(a: f32, b: f32) -> f32 {
    pow(a, b)
}

/// Logarithm of `a` to the base `b`; 0 where it does not exist.
#[inline(always)]
pub fn scalar_logarithm(a: f32, b: f32) -> f32 {
    let defined = (a > 0.0) & (b > 0.0);
    let ratio = safe_divide(log2(max(a, 1.0e-37)), log2(max(b, 1.0e-37)));
    select(0.0, ratio, defined)
}

/// Square root, 0 of negative numbers.
#[inline(always)]
pub fn scalar_sqrt(a: f32) -> f32 {
    sqrt(max(a, 0.0))
}

/// 1/√a, 0 where a is not positive.
#[inline(always)]
pub fn scalar_inverse_sqrt(a: f32) -> f32 {
    select(0.0, 1.0 / sqrt(max(a, 1.0e-37)), a > 0.0)
}

/// 1 where a < b.
#[inline(always)]
pub fn scalar_less_than(a: f32, b: f32) -> f32 {
    select(0.0, 1.0, a < b)
}

/// 1 where a > b.
#[inline(always)]
pub fn scalar_greater_than(a: f32, b: f32) -> f32 {
    select(0.0, 1.0, a > b)
}

/// The nearest whole number, halves upward.
#[inline(always)]
pub fn scalar_round(a: f32) -> f32 {
    floor(a + 0.5)
}

/// −1, 0 or 1.
#[inline(always)]
pub fn scalar_sign(a: f32) -> f32 {
    select(0.0, negate_if(1.0, a < 0.0), a != 0.0)
}

/// The multiple of `b` at or below `a`.
#[inline(always)]
pub fn scalar_snap(a: f32, b: f32) -> f32 {
    floor(safe_divide(a, b)) * b
}

/// `a` repeated between `high` and `low`.
#[inline(always)]
pub fn scalar_wrap(a: f32, high: f32, low: f32) -> f32 {
    let range = high - low;
    select(
        low,
        a - range * floor(safe_divide(a - low, range)),
        range != 0.0,
    )
}

/// A triangle wave of height `b`.
#[inline(always)]
pub fn scalar_pingpong(a: f32, b: f32) -> f32 {
    let wave = abs(fract(safe_divide(a - b, b * 2.0)) * b * 2.0 - b);
    select(0.0, wave, b != 0.0)
}

/// 1 where a and b differ by at most c.
#[inline(always)]
pub fn scalar_compare(a: f32, b: f32, c: f32) -> f32 {
    let near = abs(a - b) <= max(c, 1.192_092_9e-7);
    select(0.0, 1.0, near | (a == b))
}

/// Smooth minimum, cubic (I. Quilez, "Smooth minimum", 2013).
#[inline(always)]
pub fn scalar_smooth_minimum(a: f32, b: f32, k: f32) -> f32 {
    let h = safe_divide(max(k - abs(a - b), 0.0), k);
    min(a, b) - h * h * h * k * (1.0 / 6.0)
}

/// Smooth maximum.
#[inline(always)]
pub fn scalar_smooth_maximum(a: f32, b: f32, k: f32) -> f32 {
    -scalar_smooth_minimum(-a, -b, k)
}

/// Cycles, node Clamp: limits exchanged where they are the wrong way round.
#[inline(always)]
pub fn scalar_clamp_range(x: f32, low: f32, high: f32) -> f32 {
    clamp(x, min(low, high), max(low, high))
}

/// Cycles, node Map Range, linear.
#[inline(always)]
pub fn scalar_map_range(x: f32, from_min: f32, from_max: f32, to_min: f32, to_max: f32) -> f32 {
    let t = safe_divide(x - from_min, from_max - from_min);
    select(0.0, to_min + t * (to_max - to_min), from_max != from_min)
}

/// Cycles, node Map Range, stepped.
#[inline(always)]
pub fn scalar_map_range_stepped(
    x: f32,
    from_min: f32,
    from_max: f32,
    to_min: f32,
    to_max: f32,
    steps: f32,
) -> f32 {
    let t = safe_divide(x - from_min, from_max - from_min);
    let stepped = select(
        0.0,
        safe_divide(floor(t * (steps + 1.0)), steps),
        steps > 0.0,
    );
    select(
        0.0,
        to_min + stepped * (to_max - to_min),
        from_max != from_min,
    )
}

/// Cycles, node Map Range, smooth step.
#[inline(always)]
pub fn scalar_map_range_smooth(
    x: f32,
    from_min: f32,
    from_max: f32,
    to_min: f32,
    to_max: f32,
) -> f32 {
    let t = saturate(safe_divide(x - from_min, from_max - from_min));
    let smooth = t * t * (3.0 - 2.0 * t);
    select(
        0.0,
        to_min + smooth * (to_max - to_min),
        from_max != from_min,
    )
}

/// Cycles, node Map Range, smoother step.
#[inline(always)]
pub fn scalar_map_range_smoother(
    x: f32,
    from_min: f32,
    from_max: f32,
    to_min: f32,
    to_max: f32,
) -> f32 {
    let t = saturate(safe_divide(x - from_min, from_max - from_min));
    let smooth = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    select(
        0.0,
        to_min + smooth * (to_max - to_min),
        from_max != from_min,
    )
}

/// Cycles, node Map Range of vectors, one component: the quotient is 0, not the result,
/// where the range is empty.
#[inline(always)]
pub fn scalar_range_factor(x: f32, from_min: f32, from_max: f32) -> f32 {
    safe_divide(x - from_min, from_max - from_min)
}
