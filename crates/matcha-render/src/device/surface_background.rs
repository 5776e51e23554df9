//! Quantities of a ray that leaves the scene, as the world's program reads them.

use crate::device::surface_cone::cone_circle;
use crate::device::surface_path::{PathInfo, path_quantity};
use crate::device::surface_view::{CameraView, view_rotate, view_window};
use glam::Vec3;
use matcha_shade::device::input_code::*;
use matcha_shade::device::math::vec3;

/// Half axis that a part names of the cone's circle on the sphere of directions.
#[inline(always)]
pub fn background_along(part: u32, ray: PathInfo) -> Vec3 {
    let axes = cone_circle(ray.direction, ray.cone_spread);
    if part == INPUT_PART_AXIS_A {
        axes[0]
    } else {
        axes[1]
    }
}

/// A quantity by its code; unused components are 0. As in Cycles, positions of all kinds are the
/// direction, and normal and incoming its opposite.
#[inline(always)]
pub fn background_quantity(view: CameraView, ray: PathInfo, code: u32, part: u32) -> Vec3 {
    let direction = ray.direction;
    let is_value = part == INPUT_PART_VALUE;
    if code == INPUT_POSITION || code == INPUT_GENERATED || code == INPUT_OBJECT {
        return if is_value {
            direction
        } else {
            background_along(part, ray)
        };
    }
    if code == INPUT_NORMAL || code == INPUT_TRUE_NORMAL || code == INPUT_INCOMING {
        return if is_value {
            -direction
        } else {
            -background_along(part, ray)
        };
    }
    // Cycles adds the camera's position to a direction before it transforms it.
    if code == INPUT_CAMERA {
        let from = if is_value {
            direction
        } else {
            background_along(part, ray)
        };
        return view_rotate(view, from);
    }
    if code == INPUT_WINDOW {
        let here = view_window(view, view_rotate(view, direction));
        if is_value {
            return here;
        }
        let beside = direction + background_along(part, ray);
        return view_window(view, view_rotate(view, beside)) - here;
    }
    vec3(path_quantity(code, ray), 0.0, 0.0)
}
