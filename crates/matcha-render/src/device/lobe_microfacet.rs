//! Microfacet lobes: reflection, refraction, or both, with height-correlated masking.

use glam::Vec3;
use matcha_shade::device::math::{
    abs, cross, dot, length, max, select, select3, splat3, sqrt, vec2, vec3,
};

use super::fresnel::{
    FRESNEL_F82, FRESNEL_NONE, FRESNEL_REMAPPED, fresnel_f0, fresnel_f82, fresnel_interface,
    fresnel_position,
};
use super::lobe::{
    ClosureFrame, ClosureLobe, LOBE_GGX, LOBE_SINGULAR_ALPHA2, LOBE_SINGULAR_DENSITY, LobeSample,
    LobeValue, SCATTER_GLOSSY, SCATTER_REFLECT, SCATTER_SINGULAR, SCATTER_TRANSMIT,
    lobe_sample_none,
};
use super::microfacet::{
    microfacet_alpha_tan_squared, microfacet_beckmann_density, microfacet_beckmann_lambda,
    microfacet_beckmann_sample, microfacet_ggx_density, microfacet_ggx_lambda,
    microfacet_ggx_sample,
};

/// Indices of refraction this close to 1 do not bend light.
const LOBE_SAME_MEDIUM: f32 = 1.0e-4;

/// What a microfacet reflects and lets through.
#[derive(Clone, Copy, Debug)]
pub struct LobeSides {
    /// Reflected fraction, with its tint.
    pub reflect: Vec3,
    /// Refracted fraction, with its tint.
    pub transmit: Vec3,
    /// Probability of sampling the reflection.
    pub probability: f32,
    /// Cosine between the microfacet's normal and the refracted direction, at least 0.
    pub cos_transmitted: f32,
}

/// Fresnel factors of a lobe's microfacet under the cosine `cos_h`.
#[inline(always)]
pub fn lobe_sides(lobe: ClosureLobe, cos_h: f32) -> LobeSides {
    if lobe.fresnel == FRESNEL_F82 {
        let reflect = fresnel_f82(abs(cos_h), lobe.f0, lobe.tint) * lobe.reflects;
        LobeSides {
            reflect,
            transmit: splat3(0.0),
            probability: 1.0,
            cos_transmitted: 0.0,
        }
    } else {
        let interface = fresnel_interface(cos_h, lobe.ior);
        let f = interface.reflectance;
        let total = f >= 1.0;
        let s = fresnel_position(f, fresnel_f0(lobe.ior));
        let remapped = lobe.f0 + (splat3(1.0) - lobe.f0) * s;
        let none = lobe.fresnel == FRESNEL_NONE;
        let r = select3(splat3(f), remapped, lobe.fresnel == FRESNEL_REMAPPED);
        let reflect = select3(r, splat3(1.0), none) * lobe.reflects;
        let open = splat3(select(1.0, 0.0, total));
        let transmit = select3(splat3(1.0) - r, open, none) * lobe.tint;
        let sum_r = reflect.x + reflect.y + reflect.z;
        let sum_t = transmit.x + transmit.y + transmit.z;
        LobeSides {
            reflect,
            transmit,
            probability: sum_r / max(sum_r + sum_t, 1.0e-30),
            cos_transmitted: interface.cos_transmitted,
        }
    }
}

/// Smith's Λ of the unit vector `v` for the lobe's distribution.
#[inline(always)]
pub fn lobe_lambda(lobe: ClosureLobe, v: Vec3) -> f32 {
    let y = cross(lobe.normal, lobe.tangent);
    let local = vec3(dot(lobe.tangent, v), dot(y, v), dot(lobe.normal, v));
    let t = microfacet_alpha_tan_squared(local, lobe.alpha_x, lobe.alpha_y);
    if lobe.kind == LOBE_GGX {
        microfacet_ggx_lambda(t)
    } else {
        microfacet_beckmann_lambda(t)
    }
}

/// Density of microfacet normals at the unit vector `h`.
#[inline(always)]
pub fn lobe_density(lobe: ClosureLobe, h: Vec3) -> f32 {
    let y = cross(lobe.normal, lobe.tangent);
    let hx = dot(lobe.tangent, h) / lobe.alpha_x;
    let hy = dot(y, h) / lobe.alpha_y;
    let slope = hx * hx + hy * hy;
    let z = dot(lobe.normal, h);
    let alpha2 = lobe.alpha_x * lobe.alpha_y;
    if lobe.kind == LOBE_GGX {
        microfacet_ggx_density(slope, z, alpha2)
    } else {
        microfacet_beckmann_density(slope, z, alpha2)
    }
}

/// Value and density for a known half vector (Walter et al. 2007, equations 14, 17, 20 and
/// 21; density of visible normals: Heitz and d'Eon 2014, equation 2); `jacobian` is that of
/// wi to h times |wo·h|.
#[inline(always)]
pub fn lobe_microfacet_at(
    lobe: ClosureLobe,
    h: Vec3,
    wi: Vec3,
    jacobian: f32,
    fraction: Vec3,
    probability: f32,
) -> LobeValue {
    let common = lobe_density(lobe, h) * jacobian / lobe.cos_wo;
    let masked = common / (1.0 + lobe.lambda_wo + lobe_lambda(lobe, wi));
    LobeValue {
        value: fraction * (masked * lobe.energy),
        pdf: probability * common / (1.0 + lobe.lambda_wo),
    }
}

/// Value and density of a microfacet lobe.
#[inline(always)]
pub fn lobe_microfacet_eval(lobe: ClosureLobe, frame: ClosureFrame, wi: Vec3) -> LobeValue {
    let through = dot(lobe.normal, wi) < 0.0;
    let sharp = lobe.alpha_x * lobe.alpha_y <= LOBE_SINGULAR_ALPHA2;
    let same_side = (dot(frame.n, wi) < 0.0) == through;
    let straight = through && abs(lobe.ior - 1.0) < LOBE_SAME_MEDIUM;
    if lobe.cos_wo <= 0.0 || sharp || !same_side || straight {
        LobeValue {
            value: splat3(0.0),
            pdf: 0.0,
        }
    } else {
        let sum = select3(wi, wi * lobe.ior, through) + frame.wo;
        let reach = max(length(sum), 1.0e-20);
        // On the side of wo, also where the index in front is the larger one.
        let h0 = sum * (1.0 / reach);
        let h = h0 * select(1.0, -1.0, through && dot(h0, frame.wo) < 0.0);
        let cos_ho = dot(h, frame.wo);
        let cos_hi = dot(h, wi);
        let scale = lobe.ior / reach;
        let jacobian = select(0.25, scale * scale * abs(cos_ho * cos_hi), through);
        // Light cannot refract to the same side of a microfacet, nor off its back.
        let possible = !through || (cos_hi < 0.0 && dot(h, lobe.normal) > 0.0);
        let sides = lobe_sides(lobe, cos_ho);
        let fraction = select3(sides.reflect, sides.transmit, through);
        let probability = select(sides.probability, 1.0 - sides.probability, through);
        let used = select(0.0, 1.0, possible);
        lobe_microfacet_at(lobe, h, wi, jacobian * used, fraction, probability)
    }
}

/// Samples a visible microfacet and then one of its two sides by energy.
#[inline(always)]
pub fn lobe_microfacet_sample(lobe: ClosureLobe, frame: ClosureFrame, u: Vec3) -> LobeSample {
    let sharp = lobe.alpha_x * lobe.alpha_y <= LOBE_SINGULAR_ALPHA2;
    let h = if sharp {
        lobe.normal
    } else {
        lobe_visible_normal(lobe, frame.wo, u)
    };
    let cos_ho = dot(h, frame.wo);
    let sides = lobe_sides(lobe, cos_ho);
    let sum = sides.reflect + sides.transmit;
    let through = u.z >= sides.probability;
    let mirrored = h * (2.0 * cos_ho) - frame.wo;
    let inverse = 1.0 / lobe.ior;
    let refracted = h * (inverse * cos_ho - sides.cos_transmitted) - frame.wo * inverse;
    let wi = select3(mirrored, refracted, through);
    let same_side = (dot(frame.ng, wi) < 0.0) == through;
    if lobe.cos_wo <= 0.0 || cos_ho <= 0.0 || sum.x + sum.y + sum.z <= 0.0 || !same_side {
        lobe_sample_none()
    } else {
        let fraction = select3(sides.reflect, sides.transmit, through);
        let probability = select(sides.probability, 1.0 - sides.probability, through);
        let straight = through && abs(lobe.ior - 1.0) < LOBE_SAME_MEDIUM;
        let singular = sharp || straight;
        // Its square must stay a normal number: others are slow.
        let bend = max(abs(sides.cos_transmitted - cos_ho * inverse), 1.0e-12);
        let refraction = cos_ho * sides.cos_transmitted / (bend * bend);
        let jacobian = select(0.25, refraction, through);
        let at = if singular {
            LobeValue {
                value: fraction * (lobe.energy * LOBE_SINGULAR_DENSITY),
                pdf: probability * LOBE_SINGULAR_DENSITY,
            }
        } else {
            lobe_microfacet_at(lobe, h, wi, jacobian, fraction, probability)
        };
        let sharpness = if singular {
            SCATTER_SINGULAR
        } else {
            SCATTER_GLOSSY
        };
        let side = if through {
            SCATTER_TRANSMIT
        } else {
            SCATTER_REFLECT
        };
        LobeSample {
            wi,
            value: at.value,
            pdf: at.pdf,
            flags: sharpness | side,
            roughness: lobe_roughness(lobe),
            eta: select(1.0, lobe.ior, through),
        }
    }
}

/// A microfacet normal visible from `wo`, distributed as the lobe's kind says.
#[inline(always)]
pub fn lobe_visible_normal(lobe: ClosureLobe, wo: Vec3, u: Vec3) -> Vec3 {
    let y = cross(lobe.normal, lobe.tangent);
    let local = vec3(dot(lobe.tangent, wo), dot(y, wo), lobe.cos_wo);
    let u2 = vec2(u.x, u.y);
    let h = if lobe.kind == LOBE_GGX {
        microfacet_ggx_sample(local, lobe.alpha_x, lobe.alpha_y, u2)
    } else {
        microfacet_beckmann_sample(local, lobe.alpha_x, lobe.alpha_y, u2)
    };
    lobe.tangent * h.x + y * h.y + lobe.normal * h.z
}

/// The roughness that an artist would set for a lobe's α: fourth root of their product.
#[inline(always)]
pub fn lobe_roughness(lobe: ClosureLobe) -> f32 {
    sqrt(sqrt(lobe.alpha_x * lobe.alpha_y))
}
