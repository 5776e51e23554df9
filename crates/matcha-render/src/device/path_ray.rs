//! Rays that leave a surface: where they start, and what they may meet.

use glam::Vec3;
use matcha_shade::device::math::{
    MAX, abs, bits_of, clamp, dot, float_of, length, mix3, select, sqrt, to_int, vec3,
    wrapping_add, wrapping_sub,
};

/// Near the world's origin, in this distance of an axis, offsets have a fixed length.
pub const RAY_NEAR_ORIGIN: f32 = 0.03125;
/// That length, as a fraction of the normal.
pub const RAY_FIXED_OFFSET: f32 = 1.0 / 65536.0;
/// Offset elsewhere, units in the last place.
pub const RAY_ULPS: f32 = 256.0;
/// Cosine to the facet above which shadow rays start at the facet itself.
pub const RAY_GRAZING: f32 = 0.1;

/// A coordinate moved along a component of a normal.
#[inline(always)]
pub fn ray_offset_axis(p: f32, n: f32) -> f32 {
    let near = p + RAY_FIXED_OFFSET * n;
    let ulps = to_int(RAY_ULPS * n) as u32;
    let bits = if p < 0.0 {
        wrapping_sub(bits_of(p), ulps)
    } else {
        wrapping_add(bits_of(p), ulps)
    };
    select(float_of(bits), near, abs(p) < RAY_NEAR_ORIGIN)
}

/// Moves a point off a surface so far that rounding cannot leave it on the wrong side, and no
/// farther.
///
/// `normal` is the geometric normal, `direction` the ray that starts here: the side it goes
/// to is where the point moves. Wächter and Binder 2019, "A fast and robust method for
/// avoiding self-intersection" (Ray Tracing Gems, chapter 6): offsets in units in the last
/// place, with a fixed length near the origin.
#[inline]
pub fn ray_offset_origin(point: Vec3, normal: Vec3, direction: Vec3) -> Vec3 {
    let behind = dot(normal, direction) < 0.0;
    let side = if behind { -normal } else { normal };
    vec3(
        ray_offset_axis(point.x, side.x),
        ray_offset_axis(point.y, side.y),
        ray_offset_axis(point.z, side.z),
    )
}

/// Share of the way to the smooth surface that a shadow ray starts at: all of it where light
/// grazes the facet, nothing where it comes from well above, since lifting everywhere would
/// carry rays through thin objects (Cycles' shadow terminator offset, 0.1 by default). Where light
/// grazes the smooth surface too, both cosines count.
#[inline]
pub fn ray_terminator_lift(normal: Vec3, true_normal: Vec3, wi: Vec3) -> f32 {
    let smooth = dot(wi, normal);
    let facet = dot(wi, true_normal);
    let grazes_facet = clamp(1.0 - facet / RAY_GRAZING, 0.0, 1.0);
    let grazes_both = clamp(2.0 - (smooth + facet) / RAY_GRAZING, 0.0, 1.0);
    let lift = select(grazes_facet, grazes_both, smooth < RAY_GRAZING);
    select(0.0, lift, smooth > 0.0)
}

/// Start, direction and length of a shadow ray.
#[derive(Clone, Copy, Debug)]
pub struct ShadowSegment {
    /// Start, world space.
    pub origin: Vec3,
    /// Unit direction.
    pub direction: Vec3,
    /// Length, metres; the largest number towards a distant light.
    pub t_max: f32,
    /// It starts above its own facet, towards a light below: the facet is in its way.
    pub meets_own: bool,
}

/// Where the smooth surface and the facet of a point are.
#[derive(Clone, Copy, Debug)]
pub struct ShadowStart {
    /// The point.
    pub position: Vec3,
    /// Where rays start that graze the facet.
    pub shadow_origin: Vec3,
    /// Shading normal before bump, but bent by displacement, unit.
    pub normal: Vec3,
    /// Geometric normal, unit.
    pub true_normal: Vec3,
}

/// The shadow ray to a light's point (of a distant light only the direction `wi` counts); it
/// stops short of the light's own surface.
#[inline]
pub fn ray_to_light(from: ShadowStart, wi: Vec3, point: Vec3, distant: bool) -> ShadowSegment {
    let lift = ray_terminator_lift(from.normal, from.true_normal, wi);
    let start = mix3(from.position, from.shadow_origin, lift);
    let origin = ray_offset_origin(start, from.true_normal, wi);
    let meets_own = lift > 0.0 && dot(wi, from.true_normal) <= 0.0;
    if distant {
        return ShadowSegment {
            origin,
            direction: wi,
            t_max: MAX,
            meets_own,
        };
    }
    let to_light = point - origin;
    let squared = dot(to_light, to_light);
    let long = squared > 1.0e-36 && squared < MAX;
    let safe = select(1.0, squared, long);
    let unit = to_light * (1.0 / sqrt(safe));
    ShadowSegment {
        origin,
        direction: if long { unit } else { wi },
        t_max: length(to_light) * (1.0 - 1.0e-4),
        meets_own,
    }
}
