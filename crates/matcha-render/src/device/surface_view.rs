//! The camera as node networks see it: camera and window coordinates.

use crate::device::camera::{CAMERA_ORTHOGRAPHIC, CAMERA_PANORAMA, RasterCamera};
use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3};
use matcha_shade::device::math::{PI, TAU, asin, atan2, dot, length, max, vec2, vec3};

/// A prepared camera and the size of its picture.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct CameraView {
    /// The camera, prepared for the resolution.
    pub camera: RasterCamera,
    /// Size of the picture, pixels.
    pub resolution: Vec2,
}

/// A direction in camera space.
#[inline(always)]
pub fn view_rotate(view: CameraView, direction: Vec3) -> Vec3 {
    vec3(
        dot(view.camera.axes.x, direction),
        dot(view.camera.axes.y, direction),
        dot(view.camera.axes.z, direction),
    )
}

/// Position in camera space, metres: x to the right, y up, z forward (Cycles, Texture Coordinate
/// node).
#[inline(always)]
pub fn view_place(view: CameraView, position: Vec3) -> Vec3 {
    view_rotate(view, position - view.camera.origin)
}

/// Position in the picture, 0 to 1 from its lower left corner, of a point or a direction in
/// camera space; z is 0.
#[inline(always)]
pub fn view_window(view: CameraView, p: Vec3) -> Vec3 {
    let mut plane = vec2(0.0, 0.0);
    if view.camera.kind == CAMERA_ORTHOGRAPHIC {
        plane = vec2(p.x, p.y);
    } else if view.camera.kind == CAMERA_PANORAMA {
        // A length of zero has no latitude; the least normal number keeps the quotient one.
        let latitude = asin(p.y / max(length(p), 1.175_494_4e-38));
        plane = vec2(atan2(p.x, p.z) / TAU + 0.5, latitude / PI + 0.5);
    } else if p.z != 0.0 {
        plane = vec2(p.x, p.y) / p.z;
    }
    let raster = (plane - view.camera.corner) / view.camera.step / view.resolution;
    vec3(raster.x, 1.0 - raster.y, 0.0)
}
