//! Quantities of a point: what programs read, from what is stored of the triangle.

use crate::device::surface_path::path_quantity;
use crate::device::surface_point::{
    SurfacePlacement, SurfacePoint, surface_direction, surface_normal, surface_unit_or,
};
use crate::device::surface_view::{CameraView, view_place, view_rotate, view_window};
use glam::{Vec2, Vec3};
use matcha_shade::device::input_code::*;
use matcha_shade::device::math::{MAX, abs, cross, dot, select, sqrt, vec2, vec3};

/// How a quantity that is linear over the triangle is made of its corners' values.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceBlend {
    /// Weights of the differences of the second and the third corner to the first.
    pub weights: Vec2,
    /// The first corner's value is added: the value itself, not its change.
    pub is_value: bool,
}

/// Change of a point's position with u and v.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceGradients {
    /// Metres per unit of u.
    pub u: Vec3,
    /// Metres per unit of v.
    pub v: Vec3,
}

/// A tangent with its sign.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceTangent {
    /// Unit, world space; zero where there is none.
    pub direction: Vec3,
    /// 1, or −1 where the frame is left-handed.
    pub sign: f32,
}

/// The blend that gives a part of a quantity.
#[inline(always)]
pub fn surface_blend(point: &SurfacePoint, part: u32) -> SurfaceBlend {
    let mut weights = point.weights;
    if part == INPUT_PART_AXIS_A {
        weights = point.weights_along[0];
    } else if part == INPUT_PART_AXIS_B {
        weights = point.weights_along[1];
    }
    SurfaceBlend {
        weights,
        is_value: part == INPUT_PART_VALUE,
    }
}

/// Blends numbers.
#[inline(always)]
pub fn surface_linear(blend: SurfaceBlend, a: f32, b: f32, c: f32) -> f32 {
    if blend.is_value {
        a + (b - a) * blend.weights.x + (c - a) * blend.weights.y
    } else {
        (b - a) * blend.weights.x + (c - a) * blend.weights.y
    }
}

/// Blends pairs.
#[inline(always)]
pub fn surface_linear2(blend: SurfaceBlend, corners: [Vec2; 3]) -> Vec2 {
    let a = corners[0];
    let ab = corners[1] - a;
    let ac = corners[2] - a;
    if blend.is_value {
        a + ab * blend.weights.x + ac * blend.weights.y
    } else {
        ab * blend.weights.x + ac * blend.weights.y
    }
}

/// Blends triples.
#[inline(always)]
pub fn surface_linear3(blend: SurfaceBlend, corners: [Vec3; 3]) -> Vec3 {
    let a = corners[0];
    let ab = corners[1] - a;
    let ac = corners[2] - a;
    if blend.is_value {
        a + ab * blend.weights.x + ac * blend.weights.y
    } else {
        ab * blend.weights.x + ac * blend.weights.y
    }
}

/// Half axis of the footprint that a part names.
#[inline(always)]
pub fn surface_axis(point: &SurfacePoint, part: u32) -> Vec3 {
    if part == INPUT_PART_AXIS_A {
        point.axes[0]
    } else {
        point.axes[1]
    }
}

/// Change of position with u and v of a triangle with these corners (object space) and UVs, in
/// the world; zero where UVs collapse.
#[inline(always)]
pub fn surface_gradients(
    placement: &SurfacePlacement,
    corners: [Vec3; 3],
    uv: [Vec2; 3],
) -> SurfaceGradients {
    let e1 = corners[1] - corners[0];
    let e2 = corners[2] - corners[0];
    let d1 = uv[1] - uv[0];
    let d2 = uv[2] - uv[0];
    let determinant = d1.x * d2.y - d1.y * d2.x;
    let inverse = 1.0 / select(1.0, determinant, determinant != 0.0);
    let mut u = vec3(0.0, 0.0, 0.0);
    let mut v = vec3(0.0, 0.0, 0.0);
    if determinant != 0.0 && abs(inverse) <= MAX {
        u = (e1 * d2.y - e2 * d1.y) * inverse;
        v = (e2 * d1.x - e1 * d2.x) * inverse;
    }
    SurfaceGradients {
        u: surface_direction(placement, u),
        v: surface_direction(placement, v),
    }
}

/// Change of the unit shading normal along an axis of the footprint; `normals` are the corners',
/// object space.
#[inline(always)]
pub fn surface_normal_along(
    point: &SurfacePoint,
    placement: &SurfacePlacement,
    normals: [Vec3; 3],
    part: u32,
) -> Vec3 {
    let value = surface_linear3(surface_blend(point, INPUT_PART_VALUE), normals);
    let along = surface_linear3(surface_blend(point, part), normals);
    let sum = surface_normal(placement, value);
    let change = surface_normal(placement, along);
    let length = sqrt(dot(sum, sum));
    if length <= 0.0 {
        return vec3(0.0, 0.0, 0.0);
    }
    let sign = select(1.0, -1.0, point.backfacing != 0);
    let unit = sum / length;
    (change - unit * dot(unit, change)) * (sign / length)
}

/// Tangent from those of the corners, object space, whose sign is `sign`.
#[inline(always)]
pub fn surface_tangent_of_corners(
    point: &SurfacePoint,
    placement: &SurfacePlacement,
    tangents: [Vec3; 3],
    sign: f32,
) -> SurfaceTangent {
    let tangent = surface_linear3(surface_blend(point, INPUT_PART_VALUE), tangents);
    SurfaceTangent {
        direction: surface_unit_or(surface_direction(placement, tangent), vec3(0.0, 0.0, 0.0)),
        sign: placement.handedness * sign,
    }
}

/// Tangent along the change of position with u.
#[inline(always)]
pub fn surface_tangent_of_gradients(
    point: &SurfacePoint,
    gradients: SurfaceGradients,
) -> SurfaceTangent {
    let front = point.normal * select(1.0, -1.0, point.backfacing != 0);
    let side = dot(cross(gradients.u, gradients.v), front);
    let along = gradients.u - front * dot(front, gradients.u);
    SurfaceTangent {
        direction: surface_unit_or(along, vec3(0.0, 0.0, 0.0)),
        sign: select(1.0, -1.0, side < 0.0),
    }
}

/// Inverse of a texture space's size along one axis; 0 where it has none.
#[inline(always)]
pub fn surface_generated_scale(size: f32) -> f32 {
    let inverse = 1.0 / select(1.0, size, size != 0.0);
    select(0.0, inverse, size != 0.0)
}

/// Generated coordinates in a texture space, from a part of the position in the object.
#[inline(always)]
pub fn surface_generated(object: Vec3, part: u32, origin: Vec3, size: Vec3) -> Vec3 {
    let mut offset = vec3(0.0, 0.0, 0.0);
    if part == INPUT_PART_VALUE {
        offset = origin;
    }
    let from = object - offset;
    vec3(
        from.x * surface_generated_scale(size.x),
        from.y * surface_generated_scale(size.y),
        from.z * surface_generated_scale(size.z),
    )
}

/// Camera coordinates.
#[inline(always)]
pub fn surface_camera(view: CameraView, point: &SurfacePoint, part: u32) -> Vec3 {
    if part == INPUT_PART_VALUE {
        view_place(view, point.position)
    } else {
        view_rotate(view, surface_axis(point, part))
    }
}

/// Window coordinates.
#[inline(always)]
pub fn surface_window(view: CameraView, point: &SurfacePoint, part: u32) -> Vec3 {
    let here = view_window(view, view_place(view, point.position));
    if part == INPUT_PART_VALUE {
        here
    } else {
        let beside = point.position + surface_axis(point, part);
        view_window(view, view_place(view, beside)) - here
    }
}

/// Barycentric coordinates: weights of the first and the second corner, as Cycles has them.
#[inline(always)]
pub fn surface_parametric(point: &SurfacePoint, part: u32) -> Vec2 {
    let blend = surface_blend(point, part);
    let first = surface_linear(blend, 1.0, 0.0, 0.0);
    vec2(first, blend.weights.x)
}

/// A quantity that needs no more than the point itself and the camera, by its code, and those of
/// the path; the change of the normal is not among them. Unused components are 0.
#[inline(always)]
pub fn surface_own_quantity(view: CameraView, point: &SurfacePoint, code: u32, part: u32) -> Vec3 {
    let mut value = vec3(0.0, 0.0, 0.0);
    if part != INPUT_PART_VALUE && !input_is_differentiable(code) {
        return value;
    }
    if code == INPUT_POSITION {
        value = if part == INPUT_PART_VALUE {
            point.position
        } else {
            surface_axis(point, part)
        };
    } else if code == INPUT_NORMAL {
        value = point.normal;
    } else if code == INPUT_TRUE_NORMAL {
        value = point.true_normal;
    } else if code == INPUT_INCOMING {
        value = point.outgoing;
    } else if code == INPUT_CAMERA {
        value = surface_camera(view, point, part);
    } else if code == INPUT_WINDOW {
        value = surface_window(view, point, part);
    } else if code == INPUT_PARAMETRIC {
        let pair = surface_parametric(point, part);
        value = vec3(pair.x, pair.y, 0.0);
    } else if code == INPUT_BACKFACING {
        value = vec3(point.backfacing as f32, 0.0, 0.0);
    } else {
        value = vec3(path_quantity(code, point.path), 0.0, 0.0);
    }
    value
}
