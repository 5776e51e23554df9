//! From a hit to a point: position, normals, footprint.

use crate::device::mapping::{MappingFrame, mapping_place};
use crate::device::surface_cone::{cone_ellipse, cone_width_at};
use crate::device::surface_path::PathInfo;
use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3};
use matcha_shade::device::math::{MAX, cross, dot, min, select, sqrt, vec2, vec3};

/// Where an instance stands, and what that does to directions.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct SurfacePlacement {
    /// Object space's axes in the world.
    pub axes: MappingFrame,
    /// Object space's origin in the world, metres.
    pub origin: Vec3,
    /// Object normals to world normals: columns of the inverse transpose, scaled.
    pub normals: MappingFrame,
    /// −1 where the transform mirrors, else 1.
    pub handedness: f32,
}

/// What is stored of a triangle, in the space of its object.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceTriangle {
    /// Positions, metres.
    pub corners: [Vec3; 3],
    /// Shading normals, unit.
    pub normals: [Vec3; 3],
    /// There are no shading normals.
    pub is_flat: bool,
}

/// A point on a surface, and the footprint around it.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct SurfacePoint {
    /// World position, metres.
    pub position: Vec3,
    /// Shading normal before bump, unit, on the viewer's side of the surface.
    pub normal: Vec3,
    /// Geometric normal, unit, on the viewer's side.
    pub true_normal: Vec3,
    /// Unit direction to where the ray came from.
    pub outgoing: Vec3,
    /// Half axes of the footprint in the tangent plane, world space, metres; the long one first.
    pub axes: [Vec3; 2],
    /// Width of the ray cone at the point, metres.
    pub cone_width: f32,
    /// Weights of the triangle's second and third corners.
    pub weights: Vec2,
    /// Change of the weights along the axes.
    pub weights_along: [Vec2; 2],
    /// Where shadow rays may start so that the triangles' facets cast no shadow onto their own
    /// smooth surface; equal to the position on flat triangles.
    pub shadow_origin: Vec3,
    /// Index into `Scene::instances`.
    pub instance: u32,
    /// Triangle of the instance's mesh.
    pub primitive: u32,
    /// 1 where the back of the triangle is seen.
    pub backfacing: u32,
    /// What the path knows.
    pub path: PathInfo,
}

/// Unit length, or `fallback` where there is none.
#[inline(always)]
pub fn surface_unit_or(v: Vec3, fallback: Vec3) -> Vec3 {
    let squared = dot(v, v);
    // Between the least normal number and the largest finite one.
    if squared > 1.175_494_4e-38 && squared <= MAX {
        v / sqrt(squared)
    } else {
        fallback
    }
}

/// A direction of an object in the world.
#[inline(always)]
pub fn surface_direction(placement: &SurfacePlacement, v: Vec3) -> Vec3 {
    mapping_place(placement.axes, v.x, v.y, v.z)
}

/// A point of an object in the world.
#[inline(always)]
pub fn surface_position(placement: &SurfacePlacement, p: Vec3) -> Vec3 {
    mapping_place(placement.axes, p.x, p.y, p.z) + placement.origin
}

/// An object's normal in the world; not of unit length.
#[inline(always)]
pub fn surface_normal(placement: &SurfacePlacement, n: Vec3) -> Vec3 {
    mapping_place(placement.normals, n.x, n.y, n.z)
}

/// Change of the weights of the second and third corner along a vector in the triangle's plane.
#[inline(always)]
pub fn surface_weights_along(axis: Vec3, ab: Vec3, ac: Vec3) -> Vec2 {
    let normal = cross(ab, ac);
    let squared = dot(normal, normal);
    let mut weights = vec2(0.0, 0.0);
    if squared > 0.0 {
        let scaled = normal / squared;
        weights = vec2(dot(cross(axis, ac), scaled), dot(cross(ab, axis), scaled));
    }
    weights
}

/// How far a point lies below a corner's tangent plane, times the corner's weight, along the
/// corner's normal; zero above. `from` is the way from the corner to the point.
#[inline(always)]
pub fn surface_below(from: Vec3, corner_normal: Vec3, fallback: Vec3, weight: f32) -> Vec3 {
    let normal = surface_unit_or(corner_normal, fallback);
    normal * (min(dot(from, normal), 0.0) * weight)
}

/// Way from a point with these weights to where its shadow rays start.
///
/// Hanika 2021, "Hacking the shadow terminator" (Ray Tracing Gems II, chapter 4): the point is
/// projected onto the corners' tangent planes where it lies below them, and these projections
/// are interpolated.
#[inline(always)]
pub fn surface_lift(normals: [Vec3; 3], fallback: Vec3, weights: Vec2, ab: Vec3, ac: Vec3) -> Vec3 {
    let from = ab * weights.x + ac * weights.y;
    let first = 1.0 - weights.x - weights.y;
    vec3(0.0, 0.0, 0.0)
        - surface_below(from, normals[0], fallback, first)
        - surface_below(from - ab, normals[1], fallback, weights.x)
        - surface_below(from - ac, normals[2], fallback, weights.y)
}

/// Whether three corners share one normal.
#[inline(always)]
pub fn surface_is_facet(normals: [Vec3; 3]) -> bool {
    let a = normals[0];
    let b = normals[1];
    let c = normals[2];
    a.x == b.x && a.y == b.y && a.z == b.z && a.x == c.x && a.y == c.y && a.z == c.z
}

/// The point that a ray hit, `distance` metres from where the ray began, and its footprint.
/// `weights` are those of the triangle's second and third corners.
#[inline(always)]
pub fn surface_point(
    instance: u32,
    primitive: u32,
    distance: f32,
    weights: Vec2,
    triangle: &SurfaceTriangle,
    placement: &SurfacePlacement,
    path: PathInfo,
) -> SurfacePoint {
    let direction = path.direction;
    let a = triangle.corners[0];
    let object_ab = triangle.corners[1] - a;
    let object_ac = triangle.corners[2] - a;
    let on_object = a + object_ab * weights.x + object_ac * weights.y;
    let position = surface_position(placement, on_object);
    let ab = surface_direction(placement, object_ab);
    let ac = surface_direction(placement, object_ac);
    let front = surface_unit_or(cross(ab, ac) * placement.handedness, -direction);
    let backfacing = dot(front, direction) > 0.0;
    let sign = select(1.0, -1.0, backfacing);
    let true_normal = front * sign;
    let cone_width = cone_width_at(path.cone_width, path.cone_spread, distance);
    let axes = cone_ellipse(direction, true_normal, cone_width);
    let mut normal = true_normal;
    let mut shadow_origin = position;
    if !triangle.is_flat {
        let normal_a = surface_normal(placement, triangle.normals[0]) * sign;
        if surface_is_facet(triangle.normals) {
            normal = surface_unit_or(normal_a, true_normal);
        } else {
            let normal_b = surface_normal(placement, triangle.normals[1]) * sign;
            let normal_c = surface_normal(placement, triangle.normals[2]) * sign;
            let first = 1.0 - weights.x - weights.y;
            let sum = normal_a * first + normal_b * weights.x + normal_c * weights.y;
            normal = surface_unit_or(sum, true_normal);
            let normals = [normal_a, normal_b, normal_c];
            shadow_origin = position + surface_lift(normals, true_normal, weights, ab, ac);
        }
    }
    SurfacePoint {
        position,
        normal,
        true_normal,
        outgoing: -direction,
        axes,
        cone_width,
        weights,
        weights_along: [
            surface_weights_along(axes[0], ab, ac),
            surface_weights_along(axes[1], ab, ac),
        ],
        shadow_origin,
        instance,
        primitive,
        backfacing: backfacing as u32,
        path,
    }
}
