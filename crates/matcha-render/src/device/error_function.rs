//! The error function and its inverse, for Beckmann slopes.

use matcha_shade::device::math::{abs, exp, log, max, negate_if, select, sqrt};

/// erf x, absolute error 5·10⁻⁷ (Abramowitz and Stegun 1964, 7.1.26).
#[inline(always)]
pub fn error_function(x: f32) -> f32 {
    let a = abs(x);
    let t = 1.0 / (1.0 + 0.327_591_1 * a);
    let p = 1.061_405_4 * t - 1.453_152;
    let p = p * t + 1.421_413_7;
    let p = p * t - 0.284_496_74;
    let p = p * t + 0.254_829_6;
    negate_if(1.0 - p * t * exp(-a * a), x < 0.0)
}

/// erf⁻¹ x for |x| < 1, relative error 10⁻⁵ (Giles 2010, "Approximating the erfinv
/// function", single precision).
#[inline(always)]
pub fn inverse_error_function(x: f32) -> f32 {
    let w = -log(max((1.0 - x) * (1.0 + x), 1.0e-30));
    let c = w - 2.5;
    let p = 2.810_226_4e-8 * c + 3.432_739_4e-7;
    let p = p * c - 3.523_387_7e-6;
    let p = p * c - 4.391_506_5e-6;
    let p = p * c + 2.185_808_7e-4;
    let p = p * c - 1.253_725e-3;
    let p = p * c - 4.177_681_6e-3;
    let p = p * c + 0.246_640_73;
    let central = p * c + 1.501_409_4;
    let t = sqrt(max(w, 0.0)) - 3.0;
    let q = -2.002_142_6e-4 * t + 1.009_505_6e-4;
    let q = q * t + 1.349_343_2e-3;
    let q = q * t - 3.673_428_4e-3;
    let q = q * t + 5.739_507_7e-3;
    let q = q * t - 7.622_461_3e-3;
    let q = q * t + 9.438_870_5e-3;
    let q = q * t + 1.001_674;
    let tail = q * t + 2.832_976_8;
    x * select(tail, central, w < 5.0)
}
