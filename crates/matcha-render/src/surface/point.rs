//! From a hit to a point: position, normals, footprint.

use super::cone::{ellipse_axes, width_at};
use super::tables::{SurfaceTables, unit_or};
use crate::accel::Hit;
use crate::scene::Scene;
use glam::{Vec2, Vec3};

/// What the path that arrives at a point knows.
#[derive(Clone, Copy, Debug, Default)]
pub struct PathInfo {
    /// Unit direction of the ray, towards the point.
    pub direction: Vec3,
    /// Kind of the ray: `integrator::path::flags`.
    pub flags: u32,
    /// Width of the ray cone where the ray began, metres.
    pub cone_width: f32,
    /// Growth of the cone per metre.
    pub cone_spread: f32,
    /// Length of the last segment as networks read it, metres.
    pub ray_length: f32,
    /// Bounces so far.
    pub bounce: u16,
    /// Diffuse ones.
    pub diffuse: u16,
    /// Glossy ones.
    pub glossy: u16,
    /// Transmitting ones.
    pub transmission: u16,
    /// Transparent surfaces passed.
    pub transparent: u16,
}

/// A point on a surface, and the footprint around it.
#[derive(Clone, Copy, Debug)]
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
    /// The back of the triangle is seen.
    pub backfacing: bool,
    /// What the path knows.
    pub path: PathInfo,
}

impl SurfaceTables {
    /// The point that a ray hit, and its footprint. `hit.t` is in metres: the ray's direction was
    /// of unit length.
    pub fn point(&self, scene: &Scene, hit: &Hit, path: &PathInfo) -> SurfacePoint {
        let instance = &scene.instances[hit.instance as usize];
        let mesh = &scene.meshes[instance.mesh as usize];
        let placed = &self.placed[hit.instance as usize];
        let corners = mesh.indices[hit.primitive as usize].map(|v| mesh.positions[v as usize]);
        let [a, ab, ac] = [corners[0], corners[1] - corners[0], corners[2] - corners[0]];
        let position = instance
            .transform
            .transform_point3(a + ab * hit.u + ac * hit.v);
        let [ab, ac] = [ab, ac].map(|edge| instance.transform.transform_vector3(edge));
        let across = ab.cross(ac) * placed.handedness;
        let front = unit_or(across, -path.direction);
        let backfacing = front.dot(path.direction) > 0.0;
        let true_normal = if backfacing { -front } else { front };
        let cone_width = width_at(path.cone_width, path.cone_spread, hit.t);
        let axes = ellipse_axes(path.direction, true_normal, cone_width);
        let mut point = SurfacePoint {
            position,
            normal: true_normal,
            true_normal,
            outgoing: -path.direction,
            axes,
            cone_width,
            weights: Vec2::new(hit.u, hit.v),
            weights_along: axes.map(|axis| weights_along(axis, ab, ac)),
            shadow_origin: position,
            instance: hit.instance,
            primitive: hit.primitive,
            backfacing,
            path: *path,
        };
        if let Some(normals) = mesh.corner_normals.get(hit.primitive as usize)
            && (normals[0] != normals[1] || normals[0] != normals[2])
        {
            let sign = if backfacing { -1.0 } else { 1.0 };
            let normals = normals.map(|n| Vec3::from(placed.normals * glam::Vec3A::from(n)) * sign);
            point.smooth(normals, ab, ac);
        } else if let Some(normals) = mesh.corner_normals.get(hit.primitive as usize) {
            let sign = if backfacing { -1.0 } else { 1.0 };
            let normal = Vec3::from(placed.normals * glam::Vec3A::from(normals[0])) * sign;
            point.normal = unit_or(normal, true_normal);
        }
        point
    }
}

impl SurfacePoint {
    /// Weight of the triangle's first corner.
    #[inline(always)]
    pub fn first_weight(&self) -> f32 {
        1.0 - self.weights.x - self.weights.y
    }

    /// Shading normal from the corners' world normals, and where shadow rays start.
    #[inline(always)]
    fn smooth(&mut self, normals: [Vec3; 3], ab: Vec3, ac: Vec3) {
        let weights = [self.first_weight(), self.weights.x, self.weights.y];
        let sum = normals[0] * weights[0] + normals[1] * weights[1] + normals[2] * weights[2];
        self.normal = unit_or(sum, self.true_normal);
        // Hanika 2021, "Hacking the shadow terminator" (Ray Tracing Gems II, chapter 4): the point
        // is projected onto the corners' tangent planes where it lies below them, and these
        // projections are interpolated.
        let from_first = ab * self.weights.x + ac * self.weights.y;
        let from = [from_first, from_first - ab, from_first - ac];
        let mut lift = Vec3::ZERO;
        for corner in 0..3 {
            let normal = unit_or(normals[corner], self.true_normal);
            lift -= normal * (from[corner].dot(normal).min(0.0) * weights[corner]);
        }
        self.shadow_origin = self.position + lift;
    }
}

/// Change of the weights of the second and third corner along a vector in the triangle's plane.
#[inline(always)]
fn weights_along(axis: Vec3, ab: Vec3, ac: Vec3) -> Vec2 {
    let normal = ab.cross(ac);
    let squared = normal.length_squared();
    if squared > 0.0 {
        let scaled = normal / squared;
        Vec2::new(axis.cross(ac).dot(scaled), ab.cross(axis).dot(scaled))
    } else {
        Vec2::ZERO
    }
}
