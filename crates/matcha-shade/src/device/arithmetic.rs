//! Sums and products.

use crate::device::math::{clamp, to_int};
use glam::{Vec2, Vec3};

/// a + b.
#[inline(always)]
pub fn scalar_add(a: f32, b: f32) -> f32 {
    a + b
}

/// a − b.
#[inline(always)]
pub fn scalar_subtract(a: f32, b: f32) -> f32 {
    a - b
}

/// a · b.
#[inline(always)]
pub fn scalar_multiply(a: f32, b: f32) -> f32 {
    a * b
}

/// a · b + c, rounded twice.
#[inline(always)]
pub fn scalar_multiply_add(a: f32, b: f32, c: f32) -> f32 {
    a * b + c
}

/// a + b.
#[inline(always)]
pub fn vector_add(a: Vec3, b: Vec3) -> Vec3 {
    a + b
}

/// a − b.
#[inline(always)]
pub fn vector_subtract(a: Vec3, b: Vec3) -> Vec3 {
    a - b
}

/// a · b, by component.
#[inline(always)]
pub fn vector_multiply(a: Vec3, b: Vec3) -> Vec3 {
    a * b
}

/// a · s.
#[inline(always)]
pub fn vector_scale(a: Vec3, s: f32) -> Vec3 {
    a * s
}

/// a − b.
#[inline(always)]
pub fn pair_subtract(a: Vec2, b: Vec2) -> Vec2 {
    a - b
}

/// Trip count of [`halves_step`].
#[inline(always)]
pub fn halves_count(_x: f32, count: f32) -> u32 {
    to_int(clamp(count, 0.0, 24.0)) as u32
}

/// (term, sum).
#[inline(always)]
pub fn halves_init(x: f32, _count: f32) -> [f32; 2] {
    [x, 0.0]
}

/// Adds a term and halves it.
#[inline(always)]
pub fn halves_step(_i: u32, _x: f32, _count: f32, state: [f32; 2]) -> [f32; 2] {
    [state[0] * 0.5, state[1] + state[0]]
}

/// The sum.
#[inline(always)]
pub fn halves_finish(_x: f32, _count: f32, state: [f32; 2]) -> f32 {
    state[1]
}
