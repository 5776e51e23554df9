//! What a GPU language offers by itself. This crate is compiled alone for its model
//! checker, so it names the handful that it needs instead of depending on the shading
//! crate; names and meanings are those of that crate's device mathematics.

/// The bits of a float.
#[inline(always)]
pub fn bits_of(x: f32) -> u32 {
    x.to_bits()
}

/// The float with these bits.
#[inline(always)]
pub fn float_of(bits: u32) -> f32 {
    f32::from_bits(bits)
}

/// `if_true` where the condition holds; both are computed, nothing branches.
#[inline(always)]
pub fn select<T>(if_false: T, if_true: T, condition: bool) -> T {
    core::hint::select_unpredictable(condition, if_true, if_false)
}

/// The smaller; the other one if one is NaN.
#[inline(always)]
pub fn min(a: f32, b: f32) -> f32 {
    a.min(b)
}

/// The larger; the other one if one is NaN.
#[inline(always)]
pub fn max(a: f32, b: f32) -> f32 {
    a.max(b)
}

/// Magnitude.
#[inline(always)]
pub fn abs(x: f32) -> f32 {
    x.abs()
}

/// Square root of `x ≥ 0`.
#[inline(always)]
pub fn sqrt(x: f32) -> f32 {
    x.sqrt()
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

/// Upper half of the 64-bit product.
#[inline(always)]
pub fn multiply_high(a: u32, b: u32) -> u32 {
    ((a as u64 * b as u64) >> 32) as u32
}
