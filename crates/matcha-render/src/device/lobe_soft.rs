//! Diffuse lobes: Lambert, Oren–Nayar, sheen, and Lambert through the surface.

use glam::Vec3;
use matcha_shade::device::math::{
    PI, acos, clamp, cross, dot, max, normalize, saturate, select, splat3, sqrt, vec2, vec3,
};

use super::lobe::{
    ClosureFrame, ClosureLobe, LOBE_OREN_NAYAR, LOBE_SHEEN, LOBE_TRANSLUCENT, LobeSample,
    LobeValue, SCATTER_DIFFUSE, SCATTER_REFLECT, SCATTER_TRANSMIT, lobe_sample_none,
};
use super::mapping::{mapping_cosine, mapping_disk, mapping_frame, mapping_place};
use super::shading_normal::shading_normal_shadow;

const LOBE_INVERSE_PI: f32 = 1.0 / PI;

/// Value of a diffuse lobe. The shadow of bent normals is not part of it.
#[inline(always)]
pub fn lobe_soft_eval(lobe: ClosureLobe, wo: Vec3, wi: Vec3) -> LobeValue {
    let cosine = dot(lobe.normal, wi);
    if lobe.kind == LOBE_SHEEN {
        lobe_sheen_eval(lobe, wi)
    } else if lobe.kind == LOBE_OREN_NAYAR {
        let c = max(cosine, 0.0);
        let value = lobe_oren_nayar_intensity(lobe, wo, wi, c) * c;
        LobeValue {
            value,
            pdf: c * LOBE_INVERSE_PI,
        }
    } else {
        let through = lobe.kind == LOBE_TRANSLUCENT;
        let pdf = max(select(cosine, -cosine, through), 0.0) * LOBE_INVERSE_PI;
        LobeValue {
            value: splat3(pdf),
            pdf,
        }
    }
}

/// Factor on a diffuse lobe whose normal is not the surface's shading normal.
#[inline(always)]
pub fn lobe_shadow(lobe: ClosureLobe, frame: ClosureFrame, wi: Vec3) -> f32 {
    let n = lobe.normal;
    if n.x != frame.n.x || n.y != frame.n.y || n.z != frame.n.z {
        shading_normal_shadow(frame.n, n, wi, frame.bump_correction)
    } else {
        1.0
    }
}

/// Samples a diffuse lobe.
#[inline(always)]
pub fn lobe_soft_sample(lobe: ClosureLobe, frame: ClosureFrame, u: Vec3) -> LobeSample {
    let through = lobe.kind == LOBE_TRANSLUCENT;
    let wi = if lobe.kind == LOBE_SHEEN {
        lobe_sheen_direction(lobe, u)
    } else {
        let local = mapping_cosine(vec2(u.x, u.y));
        let around = lobe.normal * select(1.0, -1.0, through);
        mapping_place(mapping_frame(around), local.x, local.y, local.z)
    };
    let height = dot(frame.ng, wi);
    if select(height, -height, through) <= 0.0 {
        lobe_sample_none()
    } else {
        let soft = lobe_soft_eval(lobe, frame.wo, wi);
        let shadow = lobe_shadow(lobe, frame, wi);
        LobeSample {
            wi,
            value: soft.value * shadow,
            pdf: soft.pdf,
            flags: if through {
                SCATTER_DIFFUSE | SCATTER_TRANSMIT
            } else {
                SCATTER_DIFFUSE | SCATTER_REFLECT
            },
            roughness: 1.0,
            eta: 1.0,
        }
    }
}

/// Directional albedo of Oren–Nayar's B term over B: the G of Fujii 2012 ("Improvements of
/// Oren–Nayar", qualitative model) as OpenPBR writes it; `cosine` from 0 to 1.
#[inline]
pub fn lobe_oren_nayar_loss(cosine: f32) -> f32 {
    let c = clamp(cosine, 0.0, 1.0);
    let sine = sqrt(max(1.0 - c * c, 0.0));
    let theta = acos(c);
    let tangent = sine / max(c, 1.0e-6);
    let exact =
        sine * (theta - 2.0 / 3.0 - sine * c) + 2.0 / 3.0 * tangent * (1.0 - sine * sine * sine);
    // tan θ overflows at the horizon; first order in cos θ there.
    let limit = 0.5 * PI - 2.0 / 3.0 - c;
    select(exact, limit, c < 1.0e-4)
}

/// Oren–Nayar's radiance factor f(wo, wi) with Fujii's single scattering and OpenPBR's
/// multiple scattering; `cos_wi` is the clamped cosine. A is `lambda_wo`, B `alpha_y`.
#[inline(always)]
pub fn lobe_oren_nayar_intensity(lobe: ClosureLobe, wo: Vec3, wi: Vec3, cos_wi: f32) -> Vec3 {
    let a = lobe.lambda_wo;
    let b = lobe.alpha_y;
    let cos_wo = max(lobe.cos_wo, 0.0);
    let s = dot(wi, wo) - cos_wi * cos_wo;
    let t = select(s, s / max(max(cos_wi, cos_wo), 1.0e-20), s > 0.0);
    let albedo = a * PI + b * lobe_oren_nayar_loss(cos_wi);
    splat3(a + b * t) + lobe.tint * (1.0 - albedo)
}

/// Density of the sheen's linearly transformed cosine, which is its value too (Zeltner,
/// Burley and Chiang 2022, equations 7 to 9): the inverse transform takes `wi` to
/// (a x + b z, a y, z) in the frame whose x axis is the azimuth of wo.
#[inline(always)]
pub fn lobe_sheen_eval(lobe: ClosureLobe, wi: Vec3) -> LobeValue {
    let a = lobe.alpha_x;
    let z = dot(lobe.normal, wi);
    let x = a * dot(lobe.tangent, wi) + lobe.alpha_y * z;
    let y = a * dot(cross(lobe.normal, lobe.tangent), wi);
    let length2 = max(x * x + y * y + z * z, 1.0e-20);
    let ratio = a / length2;
    let pdf = max(z, 0.0) * LOBE_INVERSE_PI * ratio * ratio;
    LobeValue {
        value: splat3(pdf),
        pdf,
    }
}

/// A direction distributed as [`lobe_sheen_eval`].
#[inline(always)]
pub fn lobe_sheen_direction(lobe: ClosureLobe, u: Vec3) -> Vec3 {
    let disk = mapping_disk(vec2(u.x, u.y));
    let z = sqrt(saturate(1.0 - disk.x * disk.x - disk.y * disk.y));
    let local = normalize(vec3(disk.x - z * lobe.alpha_y, disk.y, z * lobe.alpha_x));
    let y = cross(lobe.normal, lobe.tangent);
    lobe.tangent * local.x + y * local.y + lobe.normal * local.z
}
