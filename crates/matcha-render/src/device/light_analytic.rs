//! Analytic lights: spheres, points, discs that face the shading point, spots, rectangles,
//! ellipses and suns, with the radiance that Cycles 4.5 gives them.
//!
//! A light without extent has no density over solid angle; it answers with the density that
//! makes `radiance / pdf` its irradiance (its "radiance" is an intensity, W·sr⁻¹, or for a
//! sharp sun an irradiance, W·m⁻²), and is never combined with BSDF samples.

use crate::device::light_rectangle::{
    LIGHT_RECTANGLE_SMALL, LightPatch, light_area_pdf, light_ellipse_point, light_rectangle_point,
    light_rectangle_seen,
};
use crate::device::mapping::{
    MappingFrame, mapping_cone, mapping_cosine, mapping_disk, mapping_frame, mapping_one_minus_cos,
    mapping_place,
};
use glam::{Vec2, Vec3};
use matcha_shade::device::math::{
    PI, abs, clamp, dot, dot2, max, min, normalize, select, sqrt, vec2, vec3,
};

/// Lambertian sphere (point or spot light with a radius).
pub const LIGHT_SPHERE: u32 = 0;
/// Disc that faces the shading point (point or spot light with soft falloff).
pub const LIGHT_DISC: u32 = 1;
/// Point without extent.
pub const LIGHT_POINT: u32 = 2;
/// One-sided rectangle.
pub const LIGHT_RECTANGLE: u32 = 3;
/// One-sided ellipse.
pub const LIGHT_ELLIPSE: u32 = 4;
/// Sun with an angular diameter.
pub const LIGHT_SUN: u32 = 5;
/// Sun without extent.
pub const LIGHT_SHARP_SUN: u32 = 6;

/// Distance that stands for infinitely far: a number, because WGSL has no infinity.
pub const LIGHT_FAR: f32 = f32::MAX;

/// An analytic light, ready to be sampled.
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct AnalyticLight {
    /// One of the `LIGHT_` kinds.
    pub kind: u32,
    /// Centre, metres.
    pub center: Vec3,
    /// Unit axes in x and y, and the direction in which it shines in z.
    pub axes: MappingFrame,
    /// Full lengths of an area light, metres.
    pub size: Vec2,
    /// Radius, metres.
    pub radius: f32,
    /// Radiance without attenuation, W·sr⁻¹·m⁻² (intensity or irradiance of a light without extent).
    pub radiance: Vec3,
    /// Tangent of half of an area light's spread; 0: no limit.
    pub tan_half_spread: f32,
    /// Cycles' normalisation of the spread: 1 / (tan h − h) with h half of the spread.
    pub spread_scale: f32,
    /// 1 for a spot.
    pub spot: u32,
    /// Rows of the inverse of the spot's linear transform: world to the light's space.
    pub to_local_x: Vec3,
    /// Second row.
    pub to_local_y: Vec3,
    /// Third row.
    pub to_local_z: Vec3,
    /// Cosine of half of a spot's cone in the light's space.
    pub cos_half_cone: f32,
    /// 1 / ((1 − `cos_half_cone`) · blend), the slope of the cone's edge.
    pub cone_slope: f32,
    /// 1 − cosine of the half angle of a cone that holds the spot's beam in the world, or of
    /// a sun's half angle.
    pub one_minus_cos: f32,
}

/// A direction towards a light.
#[derive(Clone, Copy, Debug)]
pub struct LightDirection {
    /// Unit direction from the shading point to the light.
    pub direction: Vec3,
    /// Distance, metres; infinite for a sun.
    pub distance: f32,
    /// Point on the light (of a sun: the direction).
    pub point: Vec3,
    /// Normal of the light there, unit.
    pub normal: Vec3,
    /// Density over solid angle; 0: no sample.
    pub pdf: f32,
}

/// No sample.
#[inline(always)]
pub fn light_no_direction() -> LightDirection {
    let zero = vec3(0.0, 0.0, 0.0);
    LightDirection {
        direction: zero,
        distance: 0.0,
        point: zero,
        normal: zero,
        pdf: 0.0,
    }
}

/// Part of the light's radiance that leaves in the direction −`direction` towards `p`: the
/// cone of a spot (Cycles: a smoothstep in the cosine), the grid of an area light's spread
/// (Cycles: the part of a slit that its walls do not hide), 1 for others.
#[inline]
pub fn light_attenuation(light: &AnalyticLight, p: Vec3, direction: Vec3) -> f32 {
    if light.spot != 0 {
        let from = p - light.center;
        if light.kind == LIGHT_SPHERE && dot(from, from) <= light.radius * light.radius {
            return 1.0;
        }
        let local = vec3(
            -dot(light.to_local_x, direction),
            -dot(light.to_local_y, direction),
            -dot(light.to_local_z, direction),
        );
        let cosine = -local.z / sqrt(max(dot(local, local), 1e-36));
        let t = clamp((cosine - light.cos_half_cone) * light.cone_slope, 0.0, 1.0);
        return t * t * (3.0 - 2.0 * t);
    }
    if light.tan_half_spread > 0.0 {
        let cosine = -dot(direction, light.axes.z);
        let tangent = sqrt(max(1.0 - cosine * cosine, 0.0)) / max(cosine, 1e-6);
        let open = max(light.tan_half_spread - tangent, 0.0) * light.spread_scale;
        return select(0.0, open, cosine > 0.0);
    }
    1.0
}

/// Samples a direction from `p` towards the light. `n` is the unit normal at `p`, or zero
/// where light may come from both sides (used inside of spheres only).
#[inline]
pub fn light_direction_sample(light: &AnalyticLight, p: Vec3, n: Vec3, u: Vec2) -> LightDirection {
    if light.kind == LIGHT_RECTANGLE || light.kind == LIGHT_ELLIPSE {
        return light_area_sample(light, p, u);
    }
    if light.kind == LIGHT_SPHERE {
        return light_sphere_sample(light, p, n, u);
    }
    if light.kind == LIGHT_DISC || light.kind == LIGHT_POINT {
        return light_disc_sample(light, p, u);
    }
    light_sun_sample(light, u)
}

/// Density over solid angle with which [`light_direction_sample`] finds the unit direction
/// `direction`, which is known to meet the light at `distance`.
#[inline]
pub fn light_direction_pdf(
    light: &AnalyticLight,
    p: Vec3,
    n: Vec3,
    direction: Vec3,
    distance: f32,
) -> f32 {
    if light.kind == LIGHT_RECTANGLE || light.kind == LIGHT_ELLIPSE {
        return light_area_direction_pdf(light, p, direction, distance);
    }
    if light.kind == LIGHT_SPHERE {
        return light_sphere_pdf(light, p, n, direction);
    }
    if light.kind == LIGHT_DISC {
        let cosine = dot(normalize(light.center - p), direction);
        let area = PI * light.radius * light.radius;
        return light_area_pdf(area, distance * distance, cosine);
    }
    if light.kind == LIGHT_SUN {
        return light_cone_pdf(light.one_minus_cos);
    }
    0.0
}

/// Density of directions uniform in a cone.
#[inline(always)]
pub fn light_cone_pdf(one_minus_cos: f32) -> f32 {
    1.0 / (2.0 * PI * max(one_minus_cos, 1e-12))
}

/// Samples a sun.
#[inline]
pub fn light_sun_sample(light: &AnalyticLight, u: Vec2) -> LightDirection {
    let mut direction = -light.axes.z;
    let mut pdf = 1.0;
    if light.kind == LIGHT_SUN {
        let local = mapping_cone(u, light.one_minus_cos);
        let towards = mapping_frame(-light.axes.z);
        direction = mapping_place(towards, local.x, local.y, local.z);
        pdf = light_cone_pdf(light.one_minus_cos);
    }
    LightDirection {
        direction,
        distance: LIGHT_FAR,
        point: direction,
        normal: -direction,
        pdf,
    }
}

/// Samples a disc that faces `p`, or a point.
#[inline]
pub fn light_disc_sample(light: &AnalyticLight, p: Vec3, u: Vec2) -> LightDirection {
    let to = light.center - p;
    let d2 = dot(to, to);
    if d2 < 1e-20 {
        return light_no_direction();
    }
    let axis = to * (1.0 / sqrt(d2));
    let frame = mapping_frame(axis);
    let disc = mapping_disk(u) * light.radius;
    let offset = frame.x * disc.x + frame.y * disc.y;
    let distance = sqrt(d2 + dot2(disc, disc));
    let direction = (to + offset) * (1.0 / distance);
    let area = PI * light.radius * light.radius;
    let pdf = light_area_pdf(area, distance * distance, dot(axis, direction));
    LightDirection {
        direction,
        distance,
        point: light.center + offset,
        normal: -direction,
        pdf: select(pdf, d2, light.kind == LIGHT_POINT),
    }
}

/// 1 − cosine of the half angle under which a sphere is seen from the squared distance `d2`.
#[inline(always)]
pub fn light_sphere_cap(radius: f32, d2: f32) -> f32 {
    mapping_one_minus_cos(min(radius * radius / d2, 1.0))
}

/// True where a spot's beam is narrower than its sphere looks, so that the beam is sampled.
#[inline(always)]
pub fn light_samples_beam(light: &AnalyticLight, cap: f32) -> bool {
    light.spot != 0 && light.one_minus_cos < cap
}

/// Samples a sphere: outside, the visible cap by solid angle (or a spot's beam where that is
/// smaller); inside, all directions by the cosine, or uniformly where `n` is zero.
#[inline]
pub fn light_sphere_sample(light: &AnalyticLight, p: Vec3, n: Vec3, u: Vec2) -> LightDirection {
    let to = light.center - p;
    let d2 = dot(to, to);
    let outside = d2 > light.radius * light.radius;
    let mut direction = mapping_cone(u, 2.0);
    if outside {
        let cap = light_sphere_cap(light.radius, d2);
        let beam = light_samples_beam(light, cap);
        let local = mapping_cone(u, select(cap, light.one_minus_cos, beam));
        let axis = to * (1.0 / sqrt(d2));
        let mut frame = mapping_frame(axis);
        if beam {
            frame = mapping_frame(-light.axes.z);
        }
        direction = mapping_place(frame, local.x, local.y, local.z);
    } else if dot(n, n) > 0.0 {
        let local = mapping_cosine(u);
        direction = mapping_place(mapping_frame(n), local.x, local.y, local.z);
    }
    let mut distance = light_sphere_distance(light, p, direction);
    if outside && distance < 0.0 {
        if light_samples_beam(light, light_sphere_cap(light.radius, d2)) {
            return light_no_direction();
        }
        // The rim of the cap, which rounding put beside the sphere.
        distance = dot(to, direction);
    }
    let normal = normalize(p + direction * distance - light.center);
    LightDirection {
        direction,
        distance,
        point: light.center + normal * light.radius,
        normal,
        pdf: light_sphere_pdf(light, p, n, direction),
    }
}

/// Density of [`light_sphere_sample`] in a direction that meets the sphere.
#[inline]
pub fn light_sphere_pdf(light: &AnalyticLight, p: Vec3, n: Vec3, direction: Vec3) -> f32 {
    let to = light.center - p;
    let d2 = dot(to, to);
    if d2 > light.radius * light.radius {
        let cap = light_sphere_cap(light.radius, d2);
        let beam = light_samples_beam(light, cap);
        let along = -dot(direction, light.axes.z);
        let inside = !beam || 1.0 - along <= light.one_minus_cos;
        return select(
            0.0,
            light_cone_pdf(select(cap, light.one_minus_cos, beam)),
            inside,
        );
    }
    let cosine = max(dot(n, direction), 0.0) / PI;
    select(0.25 / PI, cosine, dot(n, n) > 0.0)
}

/// Distance at which a ray meets the sphere: its near side from outside, its far side from
/// inside; negative where it misses.
#[inline]
pub fn light_sphere_distance(light: &AnalyticLight, p: Vec3, direction: Vec3) -> f32 {
    let to = light.center - p;
    let along = dot(to, direction);
    // Squared distance of the ray's line from the centre, without cancellation.
    let across = to - direction * along;
    let half = light.radius * light.radius - dot(across, across);
    let outside = dot(to, to) > light.radius * light.radius;
    let root = sqrt(max(half, 0.0));
    let distance = select(along + root, along - root, outside);
    select(-1.0, distance, half >= 0.0)
}

/// The part of an area light that can shine on `p`: with a limited spread, the rectangle
/// around the circle in which the grid is open, cut by the light's own bounds, or that whole
/// circle where its area is smaller. `kind` 0: nothing.
#[derive(Clone, Copy, Debug)]
pub struct LightRegion {
    /// Part to sample.
    pub patch: LightPatch,
    /// `LIGHT_RECTANGLE`, `LIGHT_ELLIPSE`, or anything else for nothing.
    pub kind: u32,
}

/// See [`LightRegion`].
#[inline]
pub fn light_area_region(light: &AnalyticLight, p: Vec3) -> LightRegion {
    let mut patch = LightPatch {
        center: light.center,
        axes: light.axes,
        size: light.size,
    };
    if light.tan_half_spread <= 0.0 {
        return LightRegion {
            patch,
            kind: light.kind,
        };
    }
    let from = p - light.center;
    let foot = vec2(dot(from, light.axes.x), dot(from, light.axes.y));
    let reach = dot(from, light.axes.z) * light.tan_half_spread;
    let half = light.size * 0.5;
    let low = vec2(max(foot.x - reach, -half.x), max(foot.y - reach, -half.y));
    let high = vec2(min(foot.x + reach, half.x), min(foot.y + reach, half.y));
    let size = high - low;
    if size.x <= 0.0 || size.y <= 0.0 {
        return LightRegion {
            patch,
            kind: LIGHT_POINT,
        };
    }
    let ellipse = light.kind == LIGHT_ELLIPSE;
    let whole = 0.25 * PI * light.size.x * light.size.y;
    let circle = PI * reach * reach;
    if ellipse && min(whole, circle) <= size.x * size.y {
        if circle < whole {
            patch.center = light.center + light.axes.x * foot.x + light.axes.y * foot.y;
            patch.size = vec2(2.0 * reach, 2.0 * reach);
        }
        return LightRegion {
            patch,
            kind: LIGHT_ELLIPSE,
        };
    }
    let middle = (low + high) * 0.5;
    patch.center = light.center + light.axes.x * middle.x + light.axes.y * middle.y;
    patch.size = size;
    LightRegion {
        patch,
        kind: LIGHT_RECTANGLE,
    }
}

/// True where a point of the light's plane, in its axes from its centre, belongs to it.
#[inline(always)]
pub fn light_area_contains(light: &AnalyticLight, at: Vec2) -> bool {
    let x = 2.0 * at.x / light.size.x;
    let y = 2.0 * at.y / light.size.y;
    let rim = 1.000_001;
    let round = x * x + y * y <= rim;
    let square = abs(x) <= rim && abs(y) <= rim;
    (light.kind == LIGHT_ELLIPSE && round) || (light.kind == LIGHT_RECTANGLE && square)
}

/// Samples an area light: rectangles by solid angle, ellipses by area.
#[inline]
pub fn light_area_sample(light: &AnalyticLight, p: Vec3, u: Vec2) -> LightDirection {
    let region = light_area_region(light, p);
    let height = dot(p - light.center, light.axes.z);
    if height <= 0.0 || region.kind == LIGHT_POINT {
        return light_no_direction();
    }
    let to = region.patch.center - p;
    let seen = light_rectangle_seen(region.patch, p);
    let mut at = (u - vec2(0.5, 0.5)) * region.patch.size;
    if region.kind == LIGHT_ELLIPSE {
        at = light_ellipse_point(region.patch.size, u);
    } else if seen.solid_angle >= LIGHT_RECTANGLE_SMALL {
        let x = dot(to, light.axes.x);
        let y = dot(to, light.axes.y);
        at = light_rectangle_point(seen, u) - vec2(x, y);
    }
    let point = region.patch.center + light.axes.x * at.x + light.axes.y * at.y;
    let from_center = point - light.center;
    let on_light = vec2(
        dot(from_center, light.axes.x),
        dot(from_center, light.axes.y),
    );
    let offset = point - p;
    let distance = sqrt(dot(offset, offset));
    if distance < 1e-10 || !light_area_contains(light, on_light) {
        return light_no_direction();
    }
    let direction = offset * (1.0 / distance);
    let pdf = light_region_pdf(region, seen.solid_angle, direction, distance);
    LightDirection {
        direction,
        distance,
        point,
        normal: light.axes.z,
        pdf,
    }
}

/// Density of a direction into a region of an area light.
#[inline(always)]
pub fn light_region_pdf(
    region: LightRegion,
    solid_angle: f32,
    direction: Vec3,
    distance: f32,
) -> f32 {
    let product = region.patch.size.x * region.patch.size.y;
    let area = select(product, product * (0.25 * PI), region.kind == LIGHT_ELLIPSE);
    let planar = light_area_pdf(
        area,
        distance * distance,
        -dot(direction, region.patch.axes.z),
    );
    let spherical = region.kind == LIGHT_RECTANGLE && solid_angle >= LIGHT_RECTANGLE_SMALL;
    select(planar, 1.0 / max(solid_angle, 1e-12), spherical)
}

/// Density of [`light_area_sample`] in a direction that meets the light at `distance`.
#[inline]
pub fn light_area_direction_pdf(
    light: &AnalyticLight,
    p: Vec3,
    direction: Vec3,
    distance: f32,
) -> f32 {
    let region = light_area_region(light, p);
    if dot(p - light.center, light.axes.z) <= 0.0 || region.kind == LIGHT_POINT {
        return 0.0;
    }
    let seen = light_rectangle_seen(region.patch, p);
    let offset = p + direction * distance - region.patch.center;
    let x = 2.0 * dot(offset, light.axes.x) / region.patch.size.x;
    let y = 2.0 * dot(offset, light.axes.y) / region.patch.size.y;
    let round = region.kind == LIGHT_ELLIPSE;
    let inside = select(max(abs(x), abs(y)), sqrt(x * x + y * y), round) <= 1.000_01;
    let pdf = light_region_pdf(region, seen.solid_angle, direction, distance);
    select(0.0, pdf, inside)
}

/// Distance at which a ray meets the light's shape, negative where it misses. Lights without
/// extent and suns are never met. Area lights are met from their shining side only; discs
/// face the ray's origin.
#[inline]
pub fn light_distance(light: &AnalyticLight, p: Vec3, direction: Vec3) -> f32 {
    if light.kind == LIGHT_SPHERE {
        return light_sphere_distance(light, p, direction);
    }
    let to = light.center - p;
    if light.kind == LIGHT_DISC {
        let d2 = dot(to, to);
        let along = dot(direction, to);
        let distance = d2 / select(along, 1.0, along == 0.0);
        let offset = direction * distance - to;
        let met = along > 0.0 && dot(offset, offset) <= light.radius * light.radius;
        return select(-1.0, distance, met);
    }
    if light.kind == LIGHT_RECTANGLE || light.kind == LIGHT_ELLIPSE {
        let facing = dot(direction, light.axes.z);
        let distance = dot(to, light.axes.z) / select(facing, 1.0, facing == 0.0);
        let offset = direction * distance - to;
        let at = vec2(dot(offset, light.axes.x), dot(offset, light.axes.y));
        let met = facing < 0.0 && distance > 0.0 && light_area_contains(light, at);
        return select(-1.0, distance, met);
    }
    -1.0
}

/// True where a unit direction points into a sun's disc.
#[inline(always)]
pub fn light_sun_contains(light: &AnalyticLight, direction: Vec3) -> bool {
    // Half of the squared chord is 1 − cosine, without cancellation.
    let chord = direction + light.axes.z;
    light.kind == LIGHT_SUN && 0.5 * dot(chord, chord) <= light.one_minus_cos
}
