//! Sampling of triangles: uniform in solid angle where they look large, in area else.

use crate::device::light_rectangle::light_area_pdf;
use glam::{Vec2, Vec3};
use matcha_shade::device::math::{
    abs, acos, atan2, clamp, cos, cross, dot, max, normalize, select, sin, sqrt, vec2,
};

/// A triangle is sampled by solid angle when its longest edge is longer than this part of
/// the distance to its centroid: farther away, its density over area is almost constant.
pub const LIGHT_TRIANGLE_NEAR: f32 = 0.5;

/// Corners of a triangle in world space, metres.
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct LightTriangle {
    /// Corner of the barycentric coordinates (0, 0).
    pub a: Vec3,
    /// Corner of (1, 0).
    pub b: Vec3,
    /// Corner of (0, 1).
    pub c: Vec3,
}

/// A sampled point of a triangle.
#[derive(Clone, Copy, Debug)]
pub struct LightTrianglePoint {
    /// Barycentric coordinates: weights of corners b and c.
    pub uv: Vec2,
    /// Density over solid angle at the point of view; 0: no sample.
    pub pdf: f32,
}

/// Solid angle of a triangle seen from `p` (Van Oosterom and Strackee 1983, eq. 8), steradians.
#[inline(always)]
pub fn light_triangle_solid_angle(triangle: LightTriangle, p: Vec3) -> f32 {
    let a = normalize(triangle.a - p);
    let b = normalize(triangle.b - p);
    let c = normalize(triangle.c - p);
    // The triple product is taken of differences: of the unit vectors themselves it cancels.
    let volume = abs(dot(a, cross(b - a, c - a)));
    2.0 * atan2(volume, 1.0 + dot(a, b) + dot(b, c) + dot(a, c))
}

/// Whether a triangle is sampled by solid angle from `p`.
#[inline(always)]
pub fn light_triangle_near(triangle: LightTriangle, p: Vec3) -> bool {
    let ab = triangle.b - triangle.a;
    let ac = triangle.c - triangle.a;
    let bc = triangle.c - triangle.b;
    let longest = max(max(dot(ab, ab), dot(ac, ac)), dot(bc, bc));
    let to = (triangle.a + triangle.b + triangle.c) * (1.0 / 3.0) - p;
    longest > dot(to, to) * (LIGHT_TRIANGLE_NEAR * LIGHT_TRIANGLE_NEAR)
}

/// Barycentric coordinates uniform in area (Heitz 2019, "A Low-Distortion Map Between
/// Triangle and Square").
#[inline(always)]
pub fn light_triangle_uniform(u: Vec2) -> Vec2 {
    let upper = u.y > u.x;
    let x = select(u.x - 0.5 * u.y, 0.5 * u.x, upper);
    let y = select(0.5 * u.y, u.y - 0.5 * u.x, upper);
    vec2(x, y)
}

/// Density over solid angle at `p` with which `light_triangle_sample` finds the point at
/// `distance` in the unit direction `direction`.
#[inline(always)]
pub fn light_triangle_pdf(triangle: LightTriangle, p: Vec3, direction: Vec3, distance: f32) -> f32 {
    if light_triangle_near(triangle, p) {
        let solid_angle = light_triangle_solid_angle(triangle, p);
        return select(0.0, 1.0 / max(solid_angle, 1e-30), solid_angle > 1e-12);
    }
    let normal = cross(triangle.b - triangle.a, triangle.c - triangle.a);
    let twice_area = sqrt(dot(normal, normal));
    let cosine = abs(dot(normal, direction)) / max(twice_area, 1e-30);
    light_area_pdf(0.5 * twice_area, distance * distance, cosine)
}

/// Direction from `p` into the triangle, uniform in solid angle: Arvo 1995, "Stratified
/// Sampling of Spherical Triangles". Not normalised where the triangle is degenerate.
#[inline(always)]
pub fn light_triangle_direction(
    triangle: LightTriangle,
    p: Vec3,
    solid_angle: f32,
    u: Vec2,
) -> Vec3 {
    let a = normalize(triangle.a - p);
    let b = normalize(triangle.b - p);
    let c = normalize(triangle.c - p);
    let cos_c = dot(a, b);
    // Angle at corner a, between the planes (a, b) and (a, c).
    let plane_b = normalize(cross(a, b - a));
    let plane_c = normalize(cross(a, c - a));
    let cos_alpha = clamp(dot(plane_b, plane_c), -1.0, 1.0);
    let sin_alpha = sqrt(max(1.0 - cos_alpha * cos_alpha, 0.0));
    let phi = u.x * solid_angle - acos(cos_alpha);
    let s = sin(phi);
    let t = cos(phi);
    let x = t - cos_alpha;
    let y = s + sin_alpha * cos_c;
    let numerator = (y * t - x * s) * cos_alpha - y;
    let denominator = (y * s + x * t) * sin_alpha;
    let ratio = numerator / select(denominator, 1.0, denominator == 0.0);
    let q = clamp(select(ratio, 1.0, denominator == 0.0), -1.0, 1.0);
    // c − (c·a) a without cancellation for near corners.
    let edge = (c - a) - a * dot(c - a, a);
    let corner = a * q + normalize(edge) * sqrt(max(1.0 - q * q, 0.0));
    let z = 1.0 - u.y * (1.0 - dot(corner, b));
    let away = (corner - b) - b * dot(corner - b, b);
    let length = sqrt(max(dot(away, away), 1e-36));
    b * z + away * (sqrt(max(1.0 - z * z, 0.0)) / length)
}

/// Barycentric coordinates at which a line from `p` meets the triangle's plane, moved into
/// the triangle where rounding put them outside.
#[inline(always)]
pub fn light_triangle_meet(triangle: LightTriangle, p: Vec3, direction: Vec3) -> Vec2 {
    let ab = triangle.b - triangle.a;
    let ac = triangle.c - triangle.a;
    let normal = cross(direction, ac);
    let determinant = dot(ab, normal);
    let inverse = 1.0 / select(determinant, 1.0, determinant == 0.0);
    let from = p - triangle.a;
    let x = clamp(dot(from, normal) * inverse, 0.0, 1.0);
    let y = clamp(dot(direction, cross(from, ab)) * inverse, 0.0, 1.0);
    let sum = max(x + y, 1.0);
    vec2(x / sum, y / sum)
}

/// Samples a point of the triangle as seen from `p`.
#[inline]
pub fn light_triangle_sample(triangle: LightTriangle, p: Vec3, u: Vec2) -> LightTrianglePoint {
    if light_triangle_near(triangle, p) {
        let solid_angle = light_triangle_solid_angle(triangle, p);
        let direction = light_triangle_direction(triangle, p, solid_angle, u);
        let pdf = select(0.0, 1.0 / max(solid_angle, 1e-30), solid_angle > 1e-12);
        return LightTrianglePoint {
            uv: light_triangle_meet(triangle, p, direction),
            pdf,
        };
    }
    let uv = light_triangle_uniform(u);
    let to = triangle.a + (triangle.b - triangle.a) * uv.x + (triangle.c - triangle.a) * uv.y - p;
    let distance = sqrt(dot(to, to));
    let direction = to * (1.0 / max(distance, 1e-30));
    let pdf = light_triangle_pdf(triangle, p, direction, distance);
    LightTrianglePoint { uv, pdf }
}
