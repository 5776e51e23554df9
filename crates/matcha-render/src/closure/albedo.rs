//! Estimates of a lobe's reflectance, and the energy of multiple scattering.

use super::set::mean;
use super::tables::{dielectric_position, glass_albedo, reflection_albedo, schlick_position};
use crate::device::fresnel::{FRESNEL_DIELECTRIC, FRESNEL_F82, FRESNEL_REMAPPED, fresnel_f0};
use crate::device::lobe::ClosureLobe;
use crate::device::lobe_microfacet::{lobe_roughness, lobe_sides};
use glam::Vec3;

/// What a lobe reflects and transmits of uniform light, without its weight.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reflectance {
    pub reflected: Vec3,
    pub transmitted: Vec3,
}

/// Which table describes what a lobe loses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sides {
    /// A lobe that only reflects.
    Reflection,
    /// Glass.
    Both,
}

/// Estimates the effect of a microfacet lobe's Fresnel factor towards `wo`; the microfacets
/// themselves are taken to lose nothing. Cycles' estimate, from the same kind of tables.
pub(super) fn estimate(lobe: &ClosureLobe) -> Reflectance {
    let sides = lobe_sides(*lobe, lobe.cos_wo);
    let roughness = lobe_roughness(*lobe);
    let between = |s: f32| (lobe.f0 + (Vec3::ONE - lobe.f0) * s) * lobe.reflect_tint;
    let reflected = match lobe.fresnel {
        _ if sides.reflect == Vec3::ZERO => Vec3::ZERO,
        FRESNEL_REMAPPED => between(dielectric_position(roughness, lobe.cos_wo, lobe.ior)),
        FRESNEL_F82 => between(schlick_position(roughness, lobe.cos_wo)),
        FRESNEL_DIELECTRIC if lobe.ior > 1.0 => {
            let f0 = fresnel_f0(lobe.ior);
            let s = dielectric_position(roughness, lobe.cos_wo, lobe.ior);
            lobe.reflect_tint * (f0 + (1.0 - f0) * s)
        }
        _ => sides.reflect,
    };
    Reflectance {
        reflected,
        transmitted: sides.transmit,
    }
}

/// Scales a GGX lobe up to the energy that it loses by scattering once only (Turquin 2019,
/// "Practical multiple scattering compensation for microfacet models"), tinted by the mean
/// single-scattering reflectance `tint` for each further bounce (Kulla and Conty 2017,
/// slides 27 to 30).
pub(super) fn preserve_energy(lobe: &mut ClosureLobe, sides: Sides, tint: Vec3) {
    let roughness = lobe_roughness(*lobe);
    let (albedo, mean_albedo) = match sides {
        Sides::Both => glass_albedo(roughness, lobe.cos_wo, lobe.ior),
        Sides::Reflection => reflection_albedo(roughness, lobe.cos_wo),
    };
    let albedo = albedo.max(1.0e-4);
    let missing = (1.0 - albedo) / albedo;
    lobe.energy = 1.0 + missing;
    let further =
        tint * mean_albedo / (Vec3::ONE - tint * (1.0 - mean_albedo)).max(Vec3::splat(1.0e-6));
    let darkening = (Vec3::ONE + further * missing) / lobe.energy;
    lobe.weight *= darkening;
    lobe.sample_weight *= mean(darkening);
}
