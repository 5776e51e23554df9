//! A closure's weight and parameters, as a program returns them for one point.

use glam::Vec3;
use matcha_shade::device::math::{MAX, is_finite, is_finite3, length, max3, saturate, vec3};

use super::closure_kind::{
    CLOSURE_BACKGROUND, CLOSURE_EMISSION, CLOSURE_ROW_WEIGHT, NORMAL_ROW_NORMAL,
};

/// The rows of one closure of one point.
#[derive(Clone, Copy, Debug)]
pub struct ClosureRows<'a> {
    /// Weight and parameters in the order of `matcha_shade::closure`.
    pub row: &'a [f32],
}

/// Row `i`; 0 where it is not finite.
#[inline(always)]
pub fn closure_number(rows: ClosureRows, i: u32) -> f32 {
    let value = rows.row[i as usize];
    if is_finite(value) { value } else { 0.0 }
}

/// Three rows from `i` on; those that are not finite read 0.
#[inline(always)]
pub fn closure_triple(rows: ClosureRows, i: u32) -> Vec3 {
    vec3(
        closure_number(rows, i),
        closure_number(rows, i + 1),
        closure_number(rows, i + 2),
    )
}

/// Row `i`, at least 0 and at most 1.
#[inline(always)]
pub fn closure_share(rows: ClosureRows, i: u32) -> f32 {
    saturate(closure_number(rows, i))
}

/// Three rows from `i` on as a colour, at least 0.
#[inline(always)]
pub fn closure_color(rows: ClosureRows, i: u32) -> Vec3 {
    max3(closure_triple(rows, i), Vec3::ZERO)
}

/// `v` as a unit vector; `otherwise` where it has no direction.
#[inline(always)]
pub fn closure_unit(v: Vec3, otherwise: Vec3) -> Vec3 {
    let l = length(v);
    if l > 0.0 && l <= MAX {
        v * (1.0 / l)
    } else {
        otherwise
    }
}

/// The normal that displacement as bump gives: the parameter of the closure
/// `CLOSURE_SHADING_NORMAL`, or `otherwise` where that has no direction.
#[inline]
pub fn closure_shading_normal(rows: ClosureRows, otherwise: Vec3) -> Vec3 {
    let x = rows.row[NORMAL_ROW_NORMAL as usize];
    let y = rows.row[(NORMAL_ROW_NORMAL + 1) as usize];
    let z = rows.row[(NORMAL_ROW_NORMAL + 2) as usize];
    closure_unit(vec3(x, y, z), otherwise)
}

/// Radiance of a closure of a world or light, W·sr⁻¹·m⁻²: 0 if it emits nothing, or numbers
/// that are not finite.
#[inline]
pub fn closure_radiance(kind: u32, rows: ClosureRows) -> Vec3 {
    let x = rows.row[CLOSURE_ROW_WEIGHT as usize];
    let y = rows.row[(CLOSURE_ROW_WEIGHT + 1) as usize];
    let z = rows.row[(CLOSURE_ROW_WEIGHT + 2) as usize];
    let weight = vec3(x, y, z);
    let emits = kind == CLOSURE_EMISSION || kind == CLOSURE_BACKGROUND;
    if emits && is_finite3(weight) {
        weight
    } else {
        Vec3::ZERO
    }
}
