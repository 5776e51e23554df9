//! Estimates of a lobe's reflectance, and the energy of multiple scattering.

use glam::Vec3;
use matcha_shade::device::math::{max, max3, splat3};

use super::closure_set::closure_black;
use super::closure_tables::{
    ClosureTables, closure_dielectric_position, closure_glass_albedo, closure_reflection_albedo,
    closure_schlick_position,
};
use super::fresnel::{
    FRESNEL_DIELECTRIC, FRESNEL_F82, FRESNEL_REMAPPED, fresnel_f0, fresnel_mean_dielectric,
    fresnel_position,
};
use super::lobe::ClosureLobe;
use super::lobe_microfacet::{lobe_roughness, lobe_sides};

/// What a lobe reflects and transmits of uniform light, without its weight.
#[derive(Clone, Copy, Debug)]
pub struct ClosureReflectance {
    /// Reflected fraction.
    pub reflected: Vec3,
    /// Transmitted fraction.
    pub transmitted: Vec3,
}

/// What further bounces between microfacets do to a lobe that knows only the first.
#[derive(Clone, Copy, Debug)]
pub struct ClosureEnergy {
    /// Factor on the lobe, which gives back everything that single scattering loses.
    pub factor: f32,
    /// Factor on the lobe's weight: the colour that further bounces take on.
    pub darkening: Vec3,
}

/// Colour between `f0` and white.
#[inline(always)]
pub fn closure_towards_white(f0: Vec3, share: f32) -> Vec3 {
    f0 + (splat3(1.0) - f0) * share
}

/// Mean of the remapped dielectric reflectance between `f0` and 1.
#[inline]
pub fn closure_mean_remapped(ior: f32, f0: Vec3) -> Vec3 {
    let share = fresnel_position(fresnel_mean_dielectric(ior), fresnel_f0(ior));
    closure_towards_white(f0, share)
}

/// Estimates the effect of a microfacet lobe's Fresnel factor towards `wo`; the microfacets
/// themselves are taken to lose nothing. Cycles' estimate, from the same kind of tables.
#[inline]
pub fn closure_estimate(lobe: ClosureLobe, tables: ClosureTables) -> ClosureReflectance {
    let sides = lobe_sides(lobe, lobe.cos_wo);
    let roughness = lobe_roughness(lobe);
    let reflected = if closure_black(sides.reflect) {
        Vec3::ZERO
    } else if lobe.fresnel == FRESNEL_REMAPPED {
        let share = closure_dielectric_position(tables, roughness, lobe.cos_wo, lobe.ior);
        closure_towards_white(lobe.f0, share) * lobe.reflects
    } else if lobe.fresnel == FRESNEL_F82 {
        let share = closure_schlick_position(tables, roughness, lobe.cos_wo);
        closure_towards_white(lobe.f0, share) * lobe.reflects
    } else if lobe.fresnel == FRESNEL_DIELECTRIC && lobe.ior > 1.0 {
        let f0 = fresnel_f0(lobe.ior);
        let share = closure_dielectric_position(tables, roughness, lobe.cos_wo, lobe.ior);
        splat3(lobe.reflects * (f0 + (1.0 - f0) * share))
    } else {
        sides.reflect
    };
    ClosureReflectance {
        reflected,
        transmitted: sides.transmit,
    }
}

/// Energy that a GGX lobe loses by scattering once only (Turquin 2019, "Practical multiple
/// scattering compensation for microfacet models"), tinted by the mean single-scattering
/// reflectance `tint` for each further bounce (Kulla and Conty 2017, slides 27 to 30).
/// `both`: the lobe is glass.
#[inline]
pub fn closure_energy(
    lobe: ClosureLobe,
    tables: ClosureTables,
    both: bool,
    tint: Vec3,
) -> ClosureEnergy {
    let roughness = lobe_roughness(lobe);
    let albedo = if both {
        closure_glass_albedo(tables, roughness, lobe.cos_wo, lobe.ior)
    } else {
        closure_reflection_albedo(tables, roughness, lobe.cos_wo)
    };
    let directional = max(albedo.directional, 1.0e-4);
    let missing = (1.0 - directional) / directional;
    let factor = 1.0 + missing;
    let open = max3(splat3(1.0) - tint * (1.0 - albedo.mean), splat3(1.0e-6));
    let further = tint * albedo.mean / open;
    ClosureEnergy {
        factor,
        darkening: (splat3(1.0) + further * missing) / factor,
    }
}
