//! Blender's lights as the sampling code takes them.
//!
//! Units follow Cycles 4.5. A point or spot light of P watts is a Lambertian sphere of
//! radiance P / (4π² r²), an area light P / (π A), and a sun of E W·m⁻² a disc of
//! E / (π sin² h) with half angle h; without `normalize` the area is left out. A point
//! without radius has the intensity P / 4π, with or without `normalize`'s area of 4 m².

use super::groups::Group;
use super::world::luminance;
use crate::accel::visibility_mask;
use crate::device::light_analytic::{
    AnalyticLight, LIGHT_DISC, LIGHT_ELLIPSE, LIGHT_POINT, LIGHT_RECTANGLE, LIGHT_SHARP_SUN,
    LIGHT_SPHERE, LIGHT_SUN,
};
use crate::device::light_group::{
    LIGHT_GROUP_BALL, LIGHT_GROUP_DISC, LIGHT_GROUP_DISTANT, LIGHT_GROUP_RECTANGLE,
};
use crate::device::light_importance::LightBounds;
use crate::device::light_view::{
    LIGHT_CASTS_SHADOW, LIGHT_GROUP_IS_LIGHT, LIGHT_IS_MET, LIGHT_NONE, LightOf,
};
use crate::device::mapping::MappingFrame;
use crate::scene::{Light, LightShape};
use glam::{Mat3, Vec2, Vec3};
use std::f32::consts::{FRAC_1_PI, FRAC_PI_2, FRAC_PI_4, PI};

/// Spreads below this (radians) are rendered with it: Cycles' limit case of parallel light
/// has no density that BSDF samples could meet.
const LEAST_SPREAD: f32 = 2e-3;

/// True for lights at infinity.
pub fn is_sun(light: &AnalyticLight) -> bool {
    light.kind == LIGHT_SUN || light.kind == LIGHT_SHARP_SUN
}

/// Converts a light; `None` where it cannot shine: black, without area, or not finite. Its
/// slot in the groups is still to be set.
pub fn convert(light: &Light, index: u32) -> Option<LightOf> {
    let matrix = Mat3::from(light.transform.matrix3);
    let center: Vec3 = light.transform.translation.into();
    let axes = MappingFrame {
        x: matrix.x_axis.normalize_or_zero(),
        y: matrix.y_axis.normalize_or_zero(),
        z: -matrix.z_axis.normalize_or_zero(),
    };
    let blank = AnalyticLight {
        kind: LIGHT_POINT,
        center,
        axes,
        size: Vec2::ZERO,
        radius: 0.0,
        radiance: Vec3::ZERO,
        tan_half_spread: 0.0,
        spread_scale: 0.0,
        spot: 0,
        to_local_x: Vec3::X,
        to_local_y: Vec3::Y,
        to_local_z: Vec3::Z,
        cos_half_cone: -1.0,
        cone_slope: 0.0,
        one_minus_cos: 2.0,
    };
    let shape = match light.shape {
        LightShape::Point {
            radius,
            soft_falloff,
        } => ball(blank, light, radius, soft_falloff),
        LightShape::Spot {
            radius,
            angle,
            blend,
            soft_falloff,
        } => spot(
            ball(blank, light, radius, soft_falloff),
            matrix,
            angle,
            blend,
        )?,
        LightShape::Sun { angle } => sun(blank, light, angle),
        LightShape::Area {
            size,
            ellipse,
            spread,
        } => area(blank, light, matrix, size, ellipse, spread)?,
    };
    let sane = center.is_finite() && shape.radiance.is_finite() && axes.z != Vec3::ZERO;
    // A light with a node tree may shine whatever its colour is; without power it cannot.
    let power = shape.radiance.abs().max_element();
    (sane && power > 0.0).then_some(LightOf {
        scene_light: index,
        tree: light.tree.unwrap_or(LIGHT_NONE),
        flags: flags(light, &shape),
        visibility: u32::from(visibility_mask(&light.visibility)),
        max_bounces: light.max_bounces,
        slot: LIGHT_NONE,
        shape,
    })
}

fn flags(light: &Light, shape: &AnalyticLight) -> u32 {
    let has_extent = !matches!(shape.kind, LIGHT_POINT | LIGHT_SHARP_SUN);
    let shadow = if light.cast_shadow {
        LIGHT_CASTS_SHADOW
    } else {
        0
    };
    let met = if light.use_mis && has_extent {
        LIGHT_IS_MET
    } else {
        0
    };
    shadow | met
}

/// Point light, or the body of a spot.
fn ball(blank: AnalyticLight, light: &Light, radius: f32, soft_falloff: bool) -> AnalyticLight {
    let radius = if radius.is_finite() {
        radius.max(0.0)
    } else {
        0.0
    };
    let (kind, area) = match radius {
        r if r <= 0.0 => (LIGHT_POINT, 4.0),
        r if soft_falloff => (LIGHT_DISC, 4.0 * PI * r * r),
        r => (LIGHT_SPHERE, 4.0 * PI * r * r),
    };
    let area = if light.normalize { area } else { 1.0 };
    AnalyticLight {
        kind,
        radius,
        radiance: light.power * (FRAC_1_PI / area),
        ..blank
    }
}

fn spot(ball: AnalyticLight, matrix: Mat3, angle: f32, blend: f32) -> Option<AnalyticLight> {
    let inverse = matrix.inverse();
    if !inverse.is_finite() {
        return None;
    }
    let rows = inverse.transpose();
    let half = 0.5 * angle.clamp(0.0, PI);
    let cos_half_cone = half.cos();
    // A scaled light has an elliptic beam; this circular cone holds it.
    let widest = matrix
        .x_axis
        .length_squared()
        .max(matrix.y_axis.length_squared());
    let tangent = half.tan() * (widest / matrix.z_axis.length_squared()).sqrt();
    let around = if half >= FRAC_PI_2 - 1e-4 {
        FRAC_PI_2
    } else {
        tangent.atan()
    };
    Some(AnalyticLight {
        spot: 1,
        to_local_x: rows.x_axis,
        to_local_y: rows.y_axis,
        to_local_z: rows.z_axis,
        cos_half_cone,
        cone_slope: 1.0 / ((1.0 - cos_half_cone) * blend.clamp(0.0, 1.0)).max(1e-7),
        one_minus_cos: 2.0 * (0.5 * around).sin().powi(2),
        ..ball
    })
}

fn sun(blank: AnalyticLight, light: &Light, angle: f32) -> AnalyticLight {
    let half = 0.5 * angle.clamp(0.0, PI);
    let area = if half > 0.0 {
        PI * half.sin().powi(2)
    } else {
        1.0
    };
    AnalyticLight {
        kind: if half > 0.0 {
            LIGHT_SUN
        } else {
            LIGHT_SHARP_SUN
        },
        radiance: light.power / if light.normalize { area } else { 1.0 },
        one_minus_cos: 2.0 * (0.5 * half).sin().powi(2),
        ..blank
    }
}

fn area(
    blank: AnalyticLight,
    light: &Light,
    matrix: Mat3,
    size: Vec2,
    ellipse: bool,
    spread: f32,
) -> Option<AnalyticLight> {
    let size = size * Vec2::new(matrix.x_axis.length(), matrix.y_axis.length());
    let area = size.x * size.y * if ellipse { FRAC_PI_4 } else { 1.0 };
    if !area.is_finite() || area <= 0.0 {
        return None;
    }
    let half = 0.5 * spread.clamp(LEAST_SPREAD, PI);
    let wide = half > FRAC_PI_2 - 1e-4;
    // tan h − h, by its series where it cancels.
    let open = if half > 0.05 {
        half.tan() - half
    } else {
        half.powi(3) / 3.0
    };
    Some(AnalyticLight {
        kind: if ellipse {
            LIGHT_ELLIPSE
        } else {
            LIGHT_RECTANGLE
        },
        size,
        radiance: light.power * FRAC_1_PI / if light.normalize { area } else { 1.0 },
        tan_half_spread: if wide { 0.0 } else { half.tan() },
        spread_scale: if wide { 1.0 } else { 1.0 / open },
        ..blank
    })
}

/// Bounds of a local light for the light tree.
pub fn bounds(light: &AnalyticLight) -> LightBounds {
    let radiance = luminance(light.radiance.abs()).max(1e-12);
    let area_light = matches!(light.kind, LIGHT_RECTANGLE | LIGHT_ELLIPSE);
    let half = if area_light {
        let (x, y) = (light.axes.x * light.size.x, light.axes.y * light.size.y);
        if light.kind == LIGHT_ELLIPSE {
            0.5 * (x * x + y * y).map(f32::sqrt)
        } else {
            0.5 * (x.abs() + y.abs())
        }
    } else {
        Vec3::splat(light.radius)
    };
    // All of a ball shines to every side, a spot only around its axis.
    let (cos_normals, cos_emission) = match (area_light, light.spot != 0) {
        (true, _) if light.tan_half_spread > 0.0 => (1.0, light.tan_half_spread.atan().cos()),
        (true, _) => (1.0, 0.0),
        (_, true) => (1.0, 1.0 - light.one_minus_cos),
        _ => (-1.0, 0.0),
    };
    let power = match light.kind {
        LIGHT_RECTANGLE => radiance * light.size.x * light.size.y * peak(light),
        LIGHT_ELLIPSE => radiance * light.size.x * light.size.y * FRAC_PI_4 * peak(light),
        LIGHT_POINT => radiance,
        _ => radiance * PI * light.radius * light.radius,
    };
    LightBounds {
        low: light.center - half,
        high: light.center + half,
        axis: light.axes.z,
        cos_normals,
        cos_emission,
        power,
        two_sided: false,
    }
}

/// The group of analytic light `index`.
pub fn group(light: &AnalyticLight, index: u32) -> Group {
    let mut group = Group::boxed(bounds(light), LIGHT_GROUP_IS_LIGHT | index);
    group.half = Vec3::X * light.radius;
    group.kind = match light.kind {
        LIGHT_RECTANGLE | LIGHT_ELLIPSE => {
            group.half = light.axes.x * (0.5 * light.size.x);
            group.side = light.axes.y * (0.5 * light.size.y);
            LIGHT_GROUP_RECTANGLE
        }
        LIGHT_DISC => LIGHT_GROUP_DISC,
        LIGHT_SUN | LIGHT_SHARP_SUN => {
            group.bounds.cos_normals = 1.0;
            group.bounds.cos_emission = if light.kind == LIGHT_SUN {
                1.0 - light.one_minus_cos
            } else {
                1.0
            };
            group.bounds.power = sun_irradiance(light);
            LIGHT_GROUP_DISTANT
        }
        _ => LIGHT_GROUP_BALL,
    };
    group
}

/// Factor of a limited spread along the axis.
fn peak(light: &AnalyticLight) -> f32 {
    if light.tan_half_spread > 0.0 {
        light.tan_half_spread * light.spread_scale
    } else {
        1.0
    }
}

/// Luminous irradiance of a sun on a surface that faces it.
fn sun_irradiance(light: &AnalyticLight) -> f32 {
    let radiance = luminance(light.radiance.abs());
    if light.kind == LIGHT_SHARP_SUN {
        return radiance;
    }
    // ∫ cos over the cone: π sin² h, with 1 − cos h known.
    radiance * PI * light.one_minus_cos * (2.0 - light.one_minus_cos)
}
