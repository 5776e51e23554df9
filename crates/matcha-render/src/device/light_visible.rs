//! Analytic lights on the way of a ray: those with a shape that the ray sees.
//!
//! As in Cycles, lights do not block: a ray that meets one takes its radiance and goes on,
//! so a caller asks again behind the hit. A camera ray sees each light that is visible to
//! the camera; a scattered ray sees those that take part in multiple importance sampling.

use crate::device::light_analytic::light_distance;
use crate::device::light_view::{LIGHT_IS_MET, LIGHT_NONE, LightView};
use crate::device::ray_kind::RAY_CAMERA;
use glam::Vec3;
use matcha_shade::device::math::{abs, max, max3, min, min3, select, vec3};

/// Whether a ray sees an analytic light; `kind` is the ray's `RAY_` bit.
#[inline(always)]
pub fn light_sees(view: LightView, index: u32, kind: u32) -> bool {
    let is_met = (view.lights[index as usize].flags & LIGHT_IS_MET) != 0;
    (view.lights[index as usize].visibility & kind) != 0 && (kind == RAY_CAMERA || is_met)
}

/// Reciprocal of a direction's coordinate, with an end.
#[inline(always)]
pub fn light_reciprocal(x: f32) -> f32 {
    1.0 / select(x, 1e-18, abs(x) < 1e-18)
}

/// Whether a ray meets a box of the hierarchy between two distances.
#[inline(always)]
pub fn light_box_met(
    view: LightView,
    node: u32,
    origin: Vec3,
    inverse: Vec3,
    t_min: f32,
    t_max: f32,
) -> bool {
    let a = (view.boxes[node as usize].low - origin) * inverse;
    let b = (view.boxes[node as usize].high - origin) * inverse;
    let near = min3(a, b);
    let far = max3(a, b);
    let from = max(max(near.x, near.y), max(near.z, t_min));
    let to = min(min(far.x, far.y), min(far.z, t_max));
    from * 0.999_999 <= to
}

/// The nearest light on a ray.
#[derive(Clone, Copy, Debug)]
pub struct LightNearest {
    /// Which analytic light, or `LIGHT_NONE`.
    pub index: u32,
    /// Its distance, metres.
    pub distance: f32,
}

/// Nearest visible analytic light between `t_min` and `t_max` on a ray with a unit direction.
/// Suns are not among them. `kind` is the ray's `RAY_` bit.
#[inline(always)]
pub fn light_nearest(
    view: LightView,
    origin: Vec3,
    direction: Vec3,
    t_min: f32,
    t_max: f32,
    kind: u32,
) -> LightNearest {
    let mut nearest = LightNearest {
        index: LIGHT_NONE,
        distance: t_max,
    };
    let inverse = vec3(
        light_reciprocal(direction.x),
        light_reciprocal(direction.y),
        light_reciprocal(direction.z),
    );
    // Halving keeps the depth below 32, and each level leaves one box behind.
    let mut stack = [0u32; 34];
    let mut size = 0;
    if view.boxes.len() as u32 > 0 {
        size = 1;
    }
    while size > 0 {
        size -= 1;
        let node = stack[size as usize];
        if light_box_met(view, node, origin, inverse, t_min, nearest.distance) {
            let first = view.boxes[node as usize].first;
            let end = first + view.boxes[node as usize].count;
            if first == end {
                stack[size as usize] = first;
                stack[(size + 1) as usize] = first + 1;
                size += 2;
            }
            let mut at = first;
            while at < end {
                let index = view.order[at as usize];
                if light_sees(view, index, kind) {
                    let shape = view.lights[index as usize].shape;
                    let t = light_distance(&shape, origin, direction);
                    if t > t_min && t < nearest.distance {
                        nearest = LightNearest { index, distance: t };
                    }
                }
                at += 1;
            }
        }
    }
    nearest
}
