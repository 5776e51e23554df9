//! Ashikhmin's two models: the anisotropic Phong lobe, and velvet.

use glam::Vec3;
use matcha_shade::device::math::{
    PI, abs, atan, clamp, cos, cross, dot, exp, log2, max, min, normalize, select, sin, splat3,
    sqrt, tan, vec2,
};

use super::lobe::{
    ClosureFrame, ClosureLobe, LOBE_SINGULAR_DENSITY, LobeSample, LobeValue, SCATTER_DIFFUSE,
    SCATTER_GLOSSY, SCATTER_REFLECT, SCATTER_SINGULAR, lobe_sample_none,
};
use super::lobe_microfacet::lobe_roughness;
use super::mapping::{mapping_cone, mapping_frame, mapping_place};

/// Largest α that counts as a mirror.
const LOBE_MIRROR: f32 = 1.0e-4;

/// Phong exponent of a roughness α: both have the same curvature at the peak as Beckmann.
#[inline(always)]
pub fn lobe_phong_exponent(alpha: f32) -> f32 {
    2.0 / (alpha * alpha) - 2.0
}

/// log₂ cos θ from sin² θ, also where the cosine rounds to 1.
#[inline(always)]
pub fn lobe_log_cosine(sine2: f32) -> f32 {
    let near = -sine2 * (1.0 + sine2 * (0.5 + sine2 * (1.0 / 3.0))) * core::f32::consts::LOG2_E;
    0.5 * select(log2(max(1.0 - sine2, 1.0e-30)), near, sine2 < 1.0e-2)
}

/// Ashikhmin–Shirley without its Fresnel factor (Ashikhmin and Shirley 2000, "An
/// Anisotropic Phong BRDF Model", equations 4 and 8).
#[inline]
pub fn lobe_ashikhmin_eval(lobe: ClosureLobe, frame: ClosureFrame, wi: Vec3) -> LobeValue {
    let cos_wi = dot(lobe.normal, wi);
    let below = cos_wi <= 0.0 || lobe.cos_wo <= 0.0 || dot(frame.n, wi) < 0.0;
    if below || max(lobe.alpha_x, lobe.alpha_y) <= LOBE_MIRROR {
        LobeValue {
            value: splat3(0.0),
            pdf: 0.0,
        }
    } else {
        let h = normalize(frame.wo + wi);
        let cos_h = max(abs(dot(h, frame.wo)), 1.0e-6);
        let hx = dot(lobe.tangent, h);
        let hy = dot(cross(lobe.normal, lobe.tangent), h);
        let sine2 = hx * hx + hy * hy;
        let nx = lobe_phong_exponent(lobe.alpha_x);
        let ny = lobe_phong_exponent(lobe.alpha_y);
        let mean = (nx * hx * hx + ny * hy * hy) / max(sine2, 1.0e-20);
        let exponent = select(nx, mean, sine2 > 1.0e-20);
        let lobe_height =
            exp(exponent * lobe_log_cosine(min(sine2, 1.0)) * core::f32::consts::LN_2);
        let norm = sqrt((nx + 1.0) * (ny + 1.0)) / (8.0 * PI);
        let pdf = norm * lobe_height / cos_h;
        let pump = max(max(cos_wi, lobe.cos_wo), 1.0e-6);
        LobeValue {
            value: splat3(cos_wi * pdf / pump),
            pdf,
        }
    }
}

/// Azimuth of an anisotropic Phong half vector for `u` in [0, 1), by quadrants mirrored
/// into each other (Ashikhmin and Shirley 2000, equation 9).
#[inline]
pub fn lobe_ashikhmin_azimuth(u: f32, nx: f32, ny: f32) -> f32 {
    let turned = 4.0 * u;
    let quadrant = select(
        select(select(3.0, 2.0, turned < 3.0), 1.0, turned < 2.0),
        0.0,
        turned < 1.0,
    );
    let within = turned - quadrant;
    let odd = quadrant == 1.0 || quadrant == 3.0;
    let folded = clamp(select(within, 1.0 - within, odd), 0.0, 0.999_999_8);
    let angle = atan(sqrt((nx + 1.0) / (ny + 1.0)) * tan(0.5 * PI * folded));
    let half_turns =
        select(0.0, 1.0, quadrant == 1.0 || quadrant == 2.0) + select(0.0, 2.0, quadrant == 3.0);
    half_turns * PI + select(angle, -angle, odd)
}

/// Samples Ashikhmin–Shirley by its half vector.
#[inline]
pub fn lobe_ashikhmin_sample(lobe: ClosureLobe, frame: ClosureFrame, u: Vec3) -> LobeSample {
    let nx = lobe_phong_exponent(lobe.alpha_x);
    let ny = lobe_phong_exponent(lobe.alpha_y);
    let phi = lobe_ashikhmin_azimuth(u.x, nx, ny);
    let c = cos(phi);
    let s = sin(phi);
    let exponent = nx * c * c + ny * s * s;
    // cos θ = u^(1/(e+1)); sin θ from 1 − cos² would round to zero for sharp lobes.
    let log_cos = log2(max(1.0 - u.y, 1.0e-30)) / (exponent + 1.0);
    let square = 2.0 * log_cos * core::f32::consts::LN_2;
    let near = -square * (1.0 + square * (0.5 + square * (1.0 / 6.0)));
    let sine2 = select(1.0 - exp(square), near, square > -1.0e-2);
    let sine = sqrt(max(sine2, 0.0));
    let cosine = sqrt(max(1.0 - sine2, 0.0));
    let y = cross(lobe.normal, lobe.tangent);
    let placed = lobe.tangent * (sine * c) + y * (sine * s) + lobe.normal * cosine;
    let mirror = max(lobe.alpha_x, lobe.alpha_y) <= LOBE_MIRROR;
    let h0 = if mirror { lobe.normal } else { placed };
    let h = h0 * select(1.0, -1.0, dot(h0, frame.wo) < 0.0);
    let wi = h * (2.0 * dot(h, frame.wo)) - frame.wo;
    let at = if mirror {
        LobeValue {
            value: splat3(LOBE_SINGULAR_DENSITY),
            pdf: LOBE_SINGULAR_DENSITY,
        }
    } else {
        lobe_ashikhmin_eval(lobe, frame, wi)
    };
    if lobe.cos_wo <= 0.0 || at.pdf <= 0.0 || dot(frame.ng, wi) <= 0.0 {
        lobe_sample_none()
    } else {
        let sharpness = if mirror {
            SCATTER_SINGULAR
        } else {
            SCATTER_GLOSSY
        };
        LobeSample {
            wi,
            value: at.value,
            pdf: at.pdf,
            flags: sharpness | SCATTER_REFLECT,
            roughness: lobe_roughness(lobe),
            eta: 1.0,
        }
    }
}

/// Velvet: an inverted Gaussian of normals around the horizon with Cook and Torrance's
/// V-groove masking (Ashikhmin, Premože and Shirley 2000, section 4.1). `alpha_x` is the
/// Gaussian's standard deviation.
#[inline]
pub fn lobe_velvet_eval(lobe: ClosureLobe, wo: Vec3, wi: Vec3) -> LobeValue {
    let cos_wi = dot(lobe.normal, wi);
    let h = normalize(wo + wi);
    let cos_nh = dot(lobe.normal, h);
    let cos_h = abs(dot(wo, h));
    let undefined = abs(cos_nh) >= 1.0 - 1.0e-5 || cos_h <= 1.0e-5;
    if cos_wi <= 0.0 || lobe.cos_wo <= 0.0 || undefined {
        LobeValue {
            value: splat3(0.0),
            pdf: 0.0,
        }
    } else {
        let ratio = 2.0 * max(cos_nh / cos_h, 1.0e-5);
        let masking = min(1.0, ratio * min(lobe.cos_wo, cos_wi));
        let sine2 = 1.0 - cos_nh * cos_nh;
        let inverse = 1.0 / (lobe.alpha_x * lobe.alpha_x);
        let gaussian = exp(-inverse * cos_nh * cos_nh / sine2);
        let density = gaussian * inverse / (PI * sine2 * sine2);
        LobeValue {
            value: splat3(0.25 * density * masking / lobe.cos_wo),
            pdf: 0.5 / PI,
        }
    }
}

/// Samples velvet: uniformly, its lobe is broad.
#[inline]
pub fn lobe_velvet_sample(lobe: ClosureLobe, frame: ClosureFrame, u: Vec3) -> LobeSample {
    let local = mapping_cone(vec2(u.x, u.y), 1.0);
    let wi = mapping_place(mapping_frame(lobe.normal), local.x, local.y, local.z);
    let at = lobe_velvet_eval(lobe, frame.wo, wi);
    if at.pdf <= 0.0 || dot(frame.ng, wi) <= 0.0 {
        lobe_sample_none()
    } else {
        LobeSample {
            wi,
            value: at.value,
            pdf: at.pdf,
            flags: SCATTER_DIFFUSE | SCATTER_REFLECT,
            roughness: 1.0,
            eta: 1.0,
        }
    }
}
