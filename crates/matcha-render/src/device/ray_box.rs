//! What the walks of both devices agree on when they test boxes, and before they begin.

use glam::Vec3;
use matcha_shade::device::math::{abs, dot, is_finite, is_finite3, select, vec3};

/// Grows the far side of a box test so that rounding never misses a box: Ize 2013, "Robust BVH
/// ray traversal", equation 2, gives 1 + 2γ(3), γ(n) being about n half units in the last
/// place; with whole units it is 1 + 2γ(6), enough for a device that rounds thrice more.
pub const BOX_FAR_SLACK: f32 = 1.0000007;

/// The least magnitude of a direction's component in box tests: its inverse stays finite.
pub const BOX_LEAST_DIRECTION: f32 = 1e-18;

/// Inverse of a component of a direction, finite.
#[inline(always)]
pub fn box_inverse_component(d: f32) -> f32 {
    let least = select(BOX_LEAST_DIRECTION, -BOX_LEAST_DIRECTION, d < 0.0);
    1.0 / select(d, least, abs(d) < BOX_LEAST_DIRECTION)
}

/// Inverse of a direction, finite.
#[inline(always)]
pub fn box_inverse(direction: Vec3) -> Vec3 {
    vec3(
        box_inverse_component(direction.x),
        box_inverse_component(direction.y),
        box_inverse_component(direction.z),
    )
}

/// False if a coordinate is not a finite number or the direction is zero: such a ray hits nothing.
#[inline(always)]
pub fn ray_is_sound(origin: Vec3, direction: Vec3) -> bool {
    let length_squared = dot(direction, direction);
    is_finite3(origin) && is_finite(length_squared) && length_squared > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slack_is_six_units_in_the_last_place() {
        assert_eq!(BOX_FAR_SLACK, 1.0 + 6.0 * f32::EPSILON);
    }
}
