//! Mappings from the unit square to disks, cones and spheres that keep areas, and the
//! frames in which they are placed.

use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3};
use matcha_shade::device::math::{PI, cos, max, select, sin, sqrt, vec2, vec3};

/// Right-handed frame around a unit vector.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct MappingFrame {
    /// First tangent.
    pub x: Vec3,
    /// Second tangent.
    pub y: Vec3,
    /// The vector itself.
    pub z: Vec3,
}

/// Frame around the unit vector `z` (Duff et al. 2017, "Building an Orthonormal Basis,
/// Revisited", listing 3).
#[inline(always)]
pub fn mapping_frame(z: Vec3) -> MappingFrame {
    let sign = select(1.0, -1.0, z.z < 0.0);
    let a = -1.0 / (sign + z.z);
    let b = z.x * z.y * a;
    MappingFrame {
        x: vec3(1.0 + sign * z.x * z.x * a, sign * b, -sign * z.x),
        y: vec3(b, sign + z.y * z.y * a, -z.y),
        z,
    }
}

/// Vector with the given components in a frame.
#[inline(always)]
pub fn mapping_place(frame: MappingFrame, x: f32, y: f32, z: f32) -> Vec3 {
    frame.x * x + frame.y * y + frame.z * z
}

/// Point of the unit disk, uniform in area, from [0, 1)² (Shirley and Chiu 1997).
#[inline(always)]
pub fn mapping_disk(u: Vec2) -> Vec2 {
    let a = 2.0 * u.x - 1.0;
    let b = 2.0 * u.y - 1.0;
    let wide = a * a > b * b;
    let radius = select(b, a, wide);
    let minor = select(a, b, wide);
    let ratio = minor / select(radius, 1.0, radius == 0.0);
    let turn = 0.25 * PI * ratio;
    let angle = select(0.5 * PI - turn, turn, wide);
    vec2(radius * cos(angle), radius * sin(angle))
}

/// Unit direction in the cone around +Z whose half angle has the given 1 − cosine (0 to 2),
/// uniform in solid angle; density 1 / (2π · `one_minus_cos`).
#[inline(always)]
pub fn mapping_cone(u: Vec2, one_minus_cos: f32) -> Vec3 {
    let disk = mapping_disk(u);
    // The squared radius is uniform in [0, 1): it serves as the fraction of the cone's height.
    let height = (disk.x * disk.x + disk.y * disk.y) * one_minus_cos;
    // sin θ / r with sin²θ = h (2 − h) and r² = h / one_minus_cos.
    let scale = sqrt(max(one_minus_cos * (2.0 - height), 0.0));
    vec3(disk.x * scale, disk.y * scale, 1.0 - height)
}

/// Unit direction of the hemisphere around +Z; density cos θ / π (Malley).
#[inline(always)]
pub fn mapping_cosine(u: Vec2) -> Vec3 {
    let disk = mapping_disk(u);
    vec3(
        disk.x,
        disk.y,
        sqrt(max(1.0 - disk.x * disk.x - disk.y * disk.y, 0.0)),
    )
}

/// 1 − cos θ from sin² θ of an angle up to a right one, without cancellation.
#[inline(always)]
pub fn mapping_one_minus_cos(sine_squared: f32) -> f32 {
    sine_squared / (1.0 + sqrt(max(1.0 - sine_squared, 0.0)))
}
