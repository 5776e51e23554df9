//! Cycles, nodes Vector Math, Vector Rotate, Mapping and Normal.

use super::math::*;
use super::scalar::*;

/// Component-wise quotient, 0 where a divisor is 0.
#[inline(always)]
pub fn vector_divide(a: Vec3, b: Vec3) -> Vec3 {
    safe_divide3(a, b)
}

/// `a` on the line along `b`.
#[inline(always)]
pub fn vector_project(a: Vec3, b: Vec3) -> Vec3 {
    b * safe_divide(dot(a, b), dot(b, b))
}

/// `a` mirrored at the plane with normal `b`.
#[inline(always)]
pub fn vector_reflect(a: Vec3, b: Vec3) -> Vec3 {
    let n = normalize(b);
    a - n * (2.0 * dot(a, n))
}

/// `a` refracted at the plane with normal `b`; zero on total reflection.
#[inline(always)]
pub fn vector_refract(a: Vec3, b: Vec3, eta: f32) -> Vec3 {
    let n = normalize(b);
    let cosine = dot(n, a);
    let k = 1.0 - eta * eta * (1.0 - cosine * cosine);
    let refracted = a * eta - n * (eta * cosine + sqrt(max(k, 0.0)));
    select3(vec3(0.0, 0.0, 0.0), refracted, k >= 0.0)
}

/// `a`, turned where `b` and `c` point the same way.
#[inline(always)]
pub fn vector_faceforward(a: Vec3, b: Vec3, c: Vec3) -> Vec3 {
    select3(-a, a, dot(c, b) < 0.0)
}

/// Distance of two points.
#[inline(always)]
pub fn vector_distance(a: Vec3, b: Vec3) -> f32 {
    length(a - b)
}

/// Component-wise multiple of `b` at or below `a`.
#[inline(always)]
pub fn vector_snap(a: Vec3, b: Vec3) -> Vec3 {
    floor3(safe_divide3(a, b)) * b
}

/// Component-wise smallest whole number not below.
#[inline(always)]
pub fn vector_ceil(a: Vec3) -> Vec3 {
    vec3(ceil(a.x), ceil(a.y), ceil(a.z))
}

/// Component-wise remainder with the sign of `a`.
#[inline(always)]
pub fn vector_modulo(a: Vec3, b: Vec3) -> Vec3 {
    vec3(modulo(a.x, b.x), modulo(a.y, b.y), modulo(a.z, b.z))
}

/// Component-wise [`scalar_wrap`].
#[inline(always)]
pub fn vector_wrap(a: Vec3, high: Vec3, low: Vec3) -> Vec3 {
    vec3(
        scalar_wrap(a.x, high.x, low.x),
        scalar_wrap(a.y, high.y, low.y),
        scalar_wrap(a.z, high.z, low.z),
    )
}

/// Component-wise fraction.
#[inline(always)]
pub fn vector_fraction(a: Vec3) -> Vec3 {
    a - floor3(a)
}

/// Component-wise power.
#[inline(always)]
pub fn vector_power(a: Vec3, b: Vec3) -> Vec3 {
    vec3(pow(a.x, b.x), pow(a.y, b.y), pow(a.z, b.z))
}

/// Component-wise sign.
#[inline(always)]
pub fn vector_sign(a: Vec3) -> Vec3 {
    vec3(scalar_sign(a.x), scalar_sign(a.y), scalar_sign(a.z))
}

/// Component-wise sine.
#[inline(always)]
pub fn vector_sine(a: Vec3) -> Vec3 {
    vec3(sin(a.x), sin(a.y), sin(a.z))
}

/// Component-wise cosine.
#[inline(always)]
pub fn vector_cosine(a: Vec3) -> Vec3 {
    vec3(cos(a.x), cos(a.y), cos(a.z))
}

/// Component-wise tangent.
#[inline(always)]
pub fn vector_tangent(a: Vec3) -> Vec3 {
    vec3(tan(a.x), tan(a.y), tan(a.z))
}

/// a · b + c by component.
#[inline(always)]
pub fn vector_multiply_add(a: Vec3, b: Vec3, c: Vec3) -> Vec3 {
    a * b + c
}

/// Mean of the components.
#[inline(always)]
pub fn vector_average(a: Vec3) -> f32 {
    (a.x + a.y + a.z) * (1.0 / 3.0)
}

/// Component-wise mix, one factor a component.
#[inline(always)]
pub fn vector_mix_each(a: Vec3, b: Vec3, t: Vec3) -> Vec3 {
    a + (b - a) * t
}

/// `v` turned about the origin by Euler angles, X first, then Y, then Z.
#[inline(always)]
pub fn vector_euler(v: Vec3, angles: Vec3) -> Vec3 {
    let sx = sin(angles.x);
    let cx = cos(angles.x);
    let sy = sin(angles.y);
    let cy = cos(angles.y);
    let sz = sin(angles.z);
    let cz = cos(angles.z);
    let y1 = v.y * cx - v.z * sx;
    let z1 = v.y * sx + v.z * cx;
    let x2 = v.x * cy + z1 * sy;
    let z2 = z1 * cy - v.x * sy;
    vec3(x2 * cz - y1 * sz, x2 * sz + y1 * cz, z2)
}

/// The inverse of [`vector_euler`].
#[inline(always)]
pub fn vector_euler_inverse(v: Vec3, angles: Vec3) -> Vec3 {
    let sx = sin(angles.x);
    let cx = cos(angles.x);
    let sy = sin(angles.y);
    let cy = cos(angles.y);
    let sz = sin(angles.z);
    let cz = cos(angles.z);
    let x1 = v.x * cz + v.y * sz;
    let y1 = v.y * cz - v.x * sz;
    let x2 = x1 * cy - v.z * sy;
    let z2 = x1 * sy + v.z * cy;
    vec3(x2, y1 * cx + z2 * sx, z2 * cx - y1 * sx)
}

/// `v` turned about `axis` by `angle` (O. Rodrigues 1840); unchanged where the axis is zero.
#[inline(always)]
pub fn vector_rotate_axis(v: Vec3, axis: Vec3, angle: f32) -> Vec3 {
    let k = normalize(axis);
    let c = cos(angle);
    let s = sin(angle);
    let turned = v * c + cross(k, v) * s + k * (dot(k, v) * (1.0 - c));
    select3(v, turned, dot(axis, axis) > 0.0)
}

/// Rows of a 3×4 matrix times a point: one component.
#[inline(always)]
pub fn vector_affine_row(p: Vec3, row: Vec3, offset: f32) -> f32 {
    dot(p, row) + offset
}

/// Cycles, node Normal: the cosine between both.
#[inline(always)]
pub fn vector_normal_dot(a: Vec3, b: Vec3) -> f32 {
    dot(normalize(a), normalize(b))
}
