//! The test of a ray against a triangle, by the signs of Plücker products of ray and edges (as
//! Embree's robust mode does). Two triangles that share an edge get exactly opposite signs for
//! it, so that no ray slips between.
//!
//! Corners are given relative to the ray's origin.

use glam::{Vec2, Vec3};
use matcha_shade::device::math::{cross, dot, select, vec2, vec3};

/// On which side of its three edges a ray passes: of those opposite the second, the third and
/// the first corner. Divided by their sum these are the corners' weights.
#[inline(always)]
pub fn triangle_sides(a: Vec3, b: Vec3, c: Vec3, direction: Vec3) -> Vec3 {
    let u = dot(cross(c - a, c + a), direction);
    let v = dot(cross(a - b, a + b), direction);
    let w = dot(cross(b - c, b + c), direction);
    vec3(u, v, w)
}

/// True if a ray passes all edges on one side.
#[inline(always)]
pub fn triangle_inside(sides: Vec3) -> bool {
    let up = sides.x >= 0.0 && sides.y >= 0.0 && sides.z >= 0.0;
    let down = sides.x <= 0.0 && sides.y <= 0.0 && sides.z <= 0.0;
    (up || down) && sides.x + sides.y + sides.z != 0.0
}

/// Distance to the triangle's plane in units of the direction's length; −1, which is never a
/// hit, where they are parallel.
#[inline(always)]
pub fn triangle_distance(a: Vec3, b: Vec3, c: Vec3, direction: Vec3) -> f32 {
    let normal = cross(a - b, c - a);
    let facing = dot(normal, direction);
    select(dot(normal, a) / facing, -1.0, facing == 0.0)
}

/// Weights of the second and the third corner where the ray is inside.
#[inline(always)]
pub fn triangle_weights(sides: Vec3) -> Vec2 {
    let sum = sides.x + sides.y + sides.z;
    vec2(sides.x / sum, sides.y / sum)
}
