//! The prelude of device code: the functions that the translation to WGSL knows by name.
//!
//! Everything is branch free in lanes: both arms are computed, then selected. Errors are
//! against the exact function; `tests/math.rs` holds them.
//! None of these calls the C library, whose functions stop a loop over lanes from
//! becoming vector instructions.

use core::hint::select_unpredictable;
pub use glam::{Vec2, Vec3};

/// π.
pub const PI: f32 = core::f32::consts::PI;
/// 2π.
pub const TAU: f32 = core::f32::consts::TAU;
/// ln 2.
pub const LN_2: f32 = core::f32::consts::LN_2;
/// log₂ e.
pub const LOG2_E: f32 = core::f32::consts::LOG2_E;
/// 1/π.
pub const FRAC_1_PI: f32 = core::f32::consts::FRAC_1_PI;
/// Largest finite number.
pub const MAX: f32 = f32::MAX;

/// A pair.
#[inline(always)]
pub fn vec2(x: f32, y: f32) -> Vec2 {
    Vec2 { x, y }
}

/// A triple.
#[inline(always)]
pub fn vec3(x: f32, y: f32, z: f32) -> Vec3 {
    Vec3 { x, y, z }
}

/// The same number three times.
#[inline(always)]
pub fn splat3(x: f32) -> Vec3 {
    vec3(x, x, x)
}

/// `true_value` where `cond` holds, else `false_value`; both are computed. The argument
/// order is WGSL's.
#[inline(always)]
pub fn select(false_value: f32, true_value: f32, cond: bool) -> f32 {
    select_unpredictable(cond, true_value, false_value)
}

/// [`select`] of whole numbers.
#[inline(always)]
pub fn select_u32(false_value: u32, true_value: u32, cond: bool) -> u32 {
    select_unpredictable(cond, true_value, false_value)
}

/// [`select`] of triples.
#[inline(always)]
pub fn select3(false_value: Vec3, true_value: Vec3, cond: bool) -> Vec3 {
    vec3(
        select(false_value.x, true_value.x, cond),
        select(false_value.y, true_value.y, cond),
        select(false_value.z, true_value.z, cond),
    )
}

/// Bits of a number.
#[inline(always)]
pub fn bits_of(x: f32) -> u32 {
    x.to_bits()
}

/// The number with these bits.
#[inline(always)]
pub fn float_of(bits: u32) -> f32 {
    f32::from_bits(bits)
}

/// Whether a number is neither infinite nor not a number.
#[inline(always)]
pub fn is_finite(x: f32) -> bool {
    // By its bits: graphics devices may take every number to be finite.
    (bits_of(x) & 0x7f80_0000) != 0x7f80_0000
}

/// [`is_finite`] of every component.
#[inline(always)]
pub fn is_finite3(v: Vec3) -> bool {
    is_finite(v.x) && is_finite(v.y) && is_finite(v.z)
}

/// Product modulo 2³².
#[inline(always)]
pub fn wrapping_mul(a: u32, b: u32) -> u32 {
    a.wrapping_mul(b)
}

/// Sum modulo 2³².
#[inline(always)]
pub fn wrapping_add(a: u32, b: u32) -> u32 {
    a.wrapping_add(b)
}

/// Difference modulo 2³².
#[inline(always)]
pub fn wrapping_sub(a: u32, b: u32) -> u32 {
    a.wrapping_sub(b)
}

/// Bits rotated to the left by `n` in 1..=31.
#[inline(always)]
pub fn rotate_left(x: u32, n: u32) -> u32 {
    x.rotate_left(n)
}

/// The smaller; `b` where one is not a number.
#[inline(always)]
pub fn min(a: f32, b: f32) -> f32 {
    select(b, a, a < b)
}

/// The larger; `b` where one is not a number.
#[inline(always)]
pub fn max(a: f32, b: f32) -> f32 {
    select(b, a, a > b)
}

/// `x` limited to [`low`, `high`]; `low` where `x` is not a number.
#[inline(always)]
pub fn clamp(x: f32, low: f32, high: f32) -> f32 {
    min(max(x, low), high)
}

/// `x` limited to [0, 1].
#[inline(always)]
pub fn saturate(x: f32) -> f32 {
    clamp(x, 0.0, 1.0)
}

/// Absolute value.
#[inline(always)]
pub fn abs(x: f32) -> f32 {
    float_of(bits_of(x) & 0x7fff_ffff)
}

/// `x` with its sign turned where `cond` holds.
#[inline(always)]
pub fn negate_if(x: f32, cond: bool) -> f32 {
    float_of(bits_of(x) ^ select_u32(0, 0x8000_0000, cond))
}

/// Square root; of a negative number not a number.
#[inline(always)]
pub fn sqrt(x: f32) -> f32 {
    x.sqrt()
}

/// Truncated toward zero, clamped to ±2³⁰ first. Not a number gives −2³⁰.
#[inline(always)]
pub fn to_int(x: f32) -> i32 {
    let limited = clamp(x, -1_073_741_824.0, 1_073_741_824.0);
    // SAFETY: `clamp` returns a number in ±2³⁰, whatever `x` is, which fits in an i32.
    unsafe { limited.to_int_unchecked() }
}

/// Largest whole number not above `x`, exact for every finite `x`.
#[inline(always)]
pub fn floor(x: f32) -> f32 {
    let truncated = to_int(x) as f32;
    let lowered = truncated - select(0.0, 1.0, truncated > x);
    // From 2²³ on every number is whole already.
    select(x, lowered, abs(x) < 8_388_608.0)
}

/// Smallest whole number not below `x`.
#[inline(always)]
pub fn ceil(x: f32) -> f32 {
    -floor(-x)
}

/// `x` without its fraction.
#[inline(always)]
pub fn trunc(x: f32) -> f32 {
    select(x, to_int(x) as f32, abs(x) < 8_388_608.0)
}

/// `x` minus its floor: in [0, 1].
#[inline(always)]
pub fn fract(x: f32) -> f32 {
    x - floor(x)
}

/// Linear interpolation, `a` at 0.
#[inline(always)]
pub fn mix(a: f32, b: f32, t: f32) -> f32 {
    a + (b - a) * t
}

/// [`mix`] of triples.
#[inline(always)]
pub fn mix3(a: Vec3, b: Vec3, t: f32) -> Vec3 {
    a + (b - a) * t
}

/// Component-wise smaller.
#[inline(always)]
pub fn min3(a: Vec3, b: Vec3) -> Vec3 {
    vec3(min(a.x, b.x), min(a.y, b.y), min(a.z, b.z))
}

/// Component-wise larger.
#[inline(always)]
pub fn max3(a: Vec3, b: Vec3) -> Vec3 {
    vec3(max(a.x, b.x), max(a.y, b.y), max(a.z, b.z))
}

/// Component-wise absolute value.
#[inline(always)]
pub fn abs3(a: Vec3) -> Vec3 {
    vec3(abs(a.x), abs(a.y), abs(a.z))
}

/// Component-wise floor.
#[inline(always)]
pub fn floor3(a: Vec3) -> Vec3 {
    vec3(floor(a.x), floor(a.y), floor(a.z))
}

/// Component-wise limit to [0, 1].
#[inline(always)]
pub fn saturate3(a: Vec3) -> Vec3 {
    vec3(saturate(a.x), saturate(a.y), saturate(a.z))
}

/// Scalar product.
#[inline(always)]
pub fn dot(a: Vec3, b: Vec3) -> f32 {
    a.x * b.x + a.y * b.y + a.z * b.z
}

/// Scalar product of pairs.
#[inline(always)]
pub fn dot2(a: Vec2, b: Vec2) -> f32 {
    a.x * b.x + a.y * b.y
}

/// Vector product.
#[inline(always)]
pub fn cross(a: Vec3, b: Vec3) -> Vec3 {
    vec3(
        a.y * b.z - a.z * b.y,
        a.z * b.x - a.x * b.z,
        a.x * b.y - a.y * b.x,
    )
}

/// Euclidean length.
#[inline(always)]
pub fn length(a: Vec3) -> f32 {
    sqrt(dot(a, a))
}

/// Euclidean length of a pair.
#[inline(always)]
pub fn length2(a: Vec2) -> f32 {
    sqrt(dot2(a, a))
}

/// Unit vector; zero where `a` is zero.
#[inline(always)]
pub fn normalize(a: Vec3) -> Vec3 {
    let l = length(a);
    let inverse = 1.0 / select(1.0, l, l > 0.0);
    a * inverse
}

/// Quotient; 0 where the divisor is 0.
#[inline(always)]
pub fn safe_divide(a: f32, b: f32) -> f32 {
    let quotient = a / select(1.0, b, b != 0.0);
    select(0.0, quotient, b != 0.0)
}

/// Component-wise [`safe_divide`].
#[inline(always)]
pub fn safe_divide3(a: Vec3, b: Vec3) -> Vec3 {
    vec3(
        safe_divide(a.x, b.x),
        safe_divide(a.y, b.y),
        safe_divide(a.z, b.z),
    )
}

/// Remainder with the sign of `a` (C's `fmod`); 0 where `b` is 0. Exact while a/b < 2²³.
#[inline(always)]
pub fn modulo(a: f32, b: f32) -> f32 {
    let quotient = trunc(safe_divide(a, b));
    let rest = a - quotient * b;
    // The rounded quotient may be one too far; then the rest has the wrong sign.
    let wrong = rest * a < 0.0;
    let repaired = select(rest, rest + negate_if(abs(b), a < 0.0), wrong);
    select(0.0, repaired, b != 0.0)
}

/// Remainder with the sign of `b`; 0 where `b` is 0.
#[inline(always)]
pub fn floored_modulo(a: f32, b: f32) -> f32 {
    select(0.0, a - floor(safe_divide(a, b)) * b, b != 0.0)
}

/// 2ˣ, relative error 2·10⁻⁷; 0 below −126, 2¹²⁸⁻ above 127.999.
#[inline(always)]
pub fn exp2(x: f32) -> f32 {
    let limited = clamp(x, -126.0, 127.999_99);
    let whole = floor(limited + 0.5);
    select(0.0, exp2_scaled(limited - whole, whole), x > -126.0)
}

/// eˣ, relative error 4·10⁻⁷ for |x| ≤ 80.
#[inline(always)]
pub fn exp(x: f32) -> f32 {
    // log2(e) in two parts, so that the product's rounding does not grow with x.
    let limited = clamp(x, -87.3, 88.7);
    let whole = floor(limited * LOG2_E + 0.5);
    let rest = (limited - whole * 0.693_359_4) - whole * -2.121_944_4e-4;
    let value = exp2_scaled(rest * LOG2_E, whole);
    select(0.0, value, x > -87.3)
}

/// 2^(f + whole) for |f| ≤ 0.5.
#[inline(always)]
pub fn exp2_scaled(f: f32, whole: f32) -> f32 {
    let p = 0.000_154_780_22 * f + 0.001_340_043_2;
    let p = p * f + 0.009_617_995;
    let p = p * f + 0.055_503_27;
    let p = p * f + 0.240_226_5;
    let p = p * f + LN_2;
    let p = p * f + 1.0;
    // Two factors, because 2¹²⁸ is no number while 2¹²⁸·0.99 is one.
    let half = to_int(whole) >> 1;
    let rest = to_int(whole) - half;
    p * float_of(((half + 127) as u32) << 23) * float_of(((rest + 127) as u32) << 23)
}

/// log₂ x for normal x > 0, error 2·10⁻⁷ of max(|log₂ x|, 0.1); −127 for 0 and below.
#[inline(always)]
pub fn log2(x: f32) -> f32 {
    let bits = bits_of(x);
    // Mantissa in [√½, √2): the constant is the bits of √½.
    let shifted = wrapping_sub(bits, 0x3f35_04f3);
    let exponent = (shifted as i32) >> 23;
    let m = float_of(wrapping_sub(bits, (exponent << 23) as u32));
    let s = (m - 1.0) / (m + 1.0);
    let s2 = s * s;
    // 2·atanh(s)/ln 2, its series.
    let p = s2 * 0.320_598_9 + 0.412_198_6;
    let p = p * s2 + 0.577_078;
    let p = p * s2 + 0.961_796_7;
    let p = p * s2 + 2.885_39;
    select(-127.0, exponent as f32 + s * p, x > 1.0e-38)
}

/// Natural logarithm for x > 0; −88.03 for 0 and below.
#[inline(always)]
pub fn log(x: f32) -> f32 {
    log2(x) * LN_2
}

/// xʸ for x ≥ 0: relative error about 2·10⁻⁷·(1 + |y log₂ x|). 0⁰ is 1.
#[inline(always)]
pub fn pow_positive(x: f32, y: f32) -> f32 {
    let value = exp2(y * log2(x));
    let at_zero = select(select(MAX, 0.0, y > 0.0), 1.0, y == 0.0);
    select(value, at_zero, x <= 0.0)
}

/// xʸ as C's `pow`, with 0 where that is not a number (negative base, broken exponent).
#[inline(always)]
pub fn pow(x: f32, y: f32) -> f32 {
    let magnitude = pow_positive(abs(x), y);
    let whole = floor(y) == y;
    let odd = whole & (floor(y * 0.5) * 2.0 != y);
    let negative = select(0.0, negate_if(magnitude, odd), whole);
    select(magnitude, negative, x < 0.0)
}

/// sin r for |r| ≤ π/2, relative error 10⁻⁷.
#[inline(always)]
pub fn sin_quarter(r: f32) -> f32 {
    let r2 = r * r;
    let p = r2 * 2.608_932_7e-6 - 1.981_111_3e-4;
    let p = p * r2 + 8.333_088e-3;
    let p = p * r2 - 0.166_666_6;
    r + r * r2 * p
}

/// x − m·π/2, the constant in three parts (Cody and Waite 1980).
#[inline(always)]
pub fn minus_half_turns(x: f32, m: f32) -> f32 {
    ((x - m * 1.570_312_5) - m * 4.837_513e-4) - m * 7.549_79e-8
}

/// Sine, error 2·10⁻⁷ for |x| ≤ 10⁴; loses |x|·10⁻¹¹ above.
#[inline(always)]
pub fn sin(x: f32) -> f32 {
    let k = floor(x * FRAC_1_PI + 0.5);
    let r = minus_half_turns(x, k * 2.0);
    negate_if(sin_quarter(r), (to_int(k) & 1) != 0)
}

/// Cosine, error as [`sin`].
#[inline(always)]
pub fn cos(x: f32) -> f32 {
    let k = floor(x * FRAC_1_PI);
    let r = minus_half_turns(x, k * 2.0 + 1.0);
    negate_if(sin_quarter(r), (to_int(k) & 1) == 0)
}

/// Tangent.
#[inline(always)]
pub fn tan(x: f32) -> f32 {
    sin(x) / cos(x)
}

/// Arc tangent of `t` in [0, 1], error 10⁻⁷.
#[inline(always)]
pub fn atan_unit(t: f32) -> f32 {
    let t2 = t * t;
    let p = t2 * 2.974_589_8e-3 - 1.658_118_2e-2;
    let p = p * t2 + 4.355_353_6e-2;
    let p = p * t2 - 7.580_578e-2;
    let p = p * t2 + 0.106_789_4;
    let p = p * t2 - 0.142_142_1;
    let p = p * t2 + 0.199_941_37;
    let p = p * t2 - 0.333_331_67;
    t + t * t2 * p
}

/// Angle of the point (x, y) in (−π, π], error 4·10⁻⁷; 0 at the origin.
#[inline(always)]
pub fn atan2(y: f32, x: f32) -> f32 {
    let ax = abs(x);
    let ay = abs(y);
    let steep = ay > ax;
    let angle = atan_unit(safe_divide(min(ax, ay), max(ax, ay)));
    let angle = select(angle, 0.5 * PI - angle, steep);
    let angle = select(angle, PI - angle, x < 0.0);
    negate_if(angle, y < 0.0)
}

/// Arc tangent.
#[inline(always)]
pub fn atan(x: f32) -> f32 {
    atan2(x, 1.0)
}

/// Arc sine of `x` limited to [−1, 1], error 3·10⁻⁷.
#[inline(always)]
pub fn asin(x: f32) -> f32 {
    let a = min(abs(x), 1.0);
    let outer = a > 0.5;
    let z = select(a, sqrt(0.5 - 0.5 * a), outer);
    let z2 = z * z;
    let p = z2 * 0.042_218_555 + 0.024_147_608;
    let p = p * z2 + 0.045_477_097;
    let p = p * z2 + 0.074_952_42;
    let p = p * z2 + 0.166_667_54;
    let inner = z + z * z2 * p;
    negate_if(select(inner, 0.5 * PI - 2.0 * inner, outer), x < 0.0)
}

/// Arc cosine of `x` limited to [−1, 1], error 4·10⁻⁷.
#[inline(always)]
pub fn acos(x: f32) -> f32 {
    0.5 * PI - asin(x)
}

/// Hyperbolic sine, relative error 10⁻⁶.
#[inline(always)]
pub fn sinh(x: f32) -> f32 {
    let e = exp(abs(x));
    let far = 0.5 * (e - 1.0 / e);
    let x2 = x * x;
    let near = x + x * x2 * (0.166_666_67 + x2 * (8.333_334e-3 + x2 * 1.984_127e-4));
    select(negate_if(far, x < 0.0), near, abs(x) < 0.5)
}

/// Hyperbolic cosine, relative error 10⁻⁶.
#[inline(always)]
pub fn cosh(x: f32) -> f32 {
    let e = exp(abs(x));
    0.5 * (e + 1.0 / e)
}

/// Hyperbolic tangent, relative error 10⁻⁶.
#[inline(always)]
pub fn tanh(x: f32) -> f32 {
    let e = exp(2.0 * min(abs(x), 20.0));
    let far = 1.0 - 2.0 / (e + 1.0);
    let x2 = x * x;
    let p = x2 * -6.282_474e-3 + 2.107_776e-2;
    let p = p * x2 - 5.385_386e-2;
    let p = p * x2 + 0.133_326_02;
    let p = p * x2 - 0.333_333_2;
    select(negate_if(far, x < 0.0), x + x * x2 * p, abs(x) < 0.55)
}

/// Hermite step from 0 at `low` to 1 at `high`; a hard step where they are equal.
#[inline(always)]
pub fn smoothstep(low: f32, high: f32, x: f32) -> f32 {
    let t = saturate(safe_divide(x - low, high - low));
    t * t * (3.0 - 2.0 * t)
}
