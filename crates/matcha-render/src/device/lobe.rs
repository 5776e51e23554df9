//! One scattering lobe of a surface: what closures are made of once their parameters are
//! known. Which lobes a closure has is decided on the host (`crate::closure`).

use glam::Vec3;
use matcha_shade::device::math::splat3;

use super::lobe_ashikhmin::{
    lobe_ashikhmin_eval, lobe_ashikhmin_sample, lobe_velvet_eval, lobe_velvet_sample,
};
use super::lobe_microfacet::{lobe_microfacet_eval, lobe_microfacet_sample};
use super::lobe_soft::{lobe_shadow, lobe_soft_eval, lobe_soft_sample};

/// Lambert.
pub const LOBE_DIFFUSE: u32 = 0;
/// Oren–Nayar with multiple scattering.
pub const LOBE_OREN_NAYAR: u32 = 1;
/// Sheen as a linearly transformed cosine.
pub const LOBE_SHEEN: u32 = 2;
/// Lambert through the surface.
pub const LOBE_TRANSLUCENT: u32 = 3;
/// Trowbridge–Reitz microfacets.
pub const LOBE_GGX: u32 = 4;
/// Beckmann microfacets.
pub const LOBE_BECKMANN: u32 = 5;
/// Ashikhmin–Shirley's Phong lobe.
pub const LOBE_ASHIKHMIN_SHIRLEY: u32 = 6;
/// Ashikhmin's velvet.
pub const LOBE_VELVET: u32 = 7;

/// Scattered by a diffuse lobe.
pub const SCATTER_DIFFUSE: u32 = 1;
/// Scattered by a glossy lobe.
pub const SCATTER_GLOSSY: u32 = 2;
/// Perfectly sharp: the density stands for a delta and is [`LOBE_SINGULAR_DENSITY`].
pub const SCATTER_SINGULAR: u32 = 4;
/// To the side of `wo`.
pub const SCATTER_REFLECT: u32 = 8;
/// Through the surface.
pub const SCATTER_TRANSMIT: u32 = 16;
/// Straight on, unchanged.
pub const SCATTER_TRANSPARENT: u32 = 32;

/// Product of the two α below which a lobe is perfectly sharp.
pub const LOBE_SINGULAR_ALPHA2: f32 = 2.0e-10;
/// Density that stands for a delta: so high that every other technique's weight vanishes.
pub const LOBE_SINGULAR_DENSITY: f32 = 1.0e6;

/// A lobe, ready to be evaluated for one `wo`. A set of them is a graphics device's largest
/// private memory: fields are shared between kinds.
#[derive(Clone, Copy, Debug)]
pub struct ClosureLobe {
    /// One of the `LOBE_` constants.
    pub kind: u32,
    /// One of the `FRESNEL_` constants.
    pub fresnel: u32,
    /// 1; 0 where the lobe only refracts.
    pub reflects: f32,
    /// Factor on the lobe.
    pub weight: Vec3,
    /// Share in sampling, not normalised.
    pub sample_weight: f32,
    /// Unit normal of the lobe.
    pub normal: Vec3,
    /// Unit vector across the normal: axis of `alpha_x`; for sheen, azimuth of `wo`.
    pub tangent: Vec3,
    /// Roughness α (square of what artists set), 0 to 1; sheen: LTC coefficient a.
    pub alpha_x: f32,
    /// Along cross(normal, tangent); sheen: LTC coefficient b; Oren–Nayar: B.
    pub alpha_y: f32,
    /// Relative index of refraction, behind over in front.
    pub ior: f32,
    /// Factor that gives back what single scattering loses, 1 or more.
    pub energy: f32,
    /// Reflectance at normal incidence.
    pub f0: Vec3,
    /// Factor on what is refracted, zero where the lobe only reflects; edge coefficient of
    /// the F82 model; Oren–Nayar: multiple scattering but for wi.
    pub tint: Vec3,
    /// Cosine between normal and wo.
    pub cos_wo: f32,
    /// Smith's Λ of wo; Oren–Nayar: A.
    pub lambda_wo: f32,
}

/// Geometry of a surface point for its closures; every vector is a unit vector.
#[derive(Clone, Copy, Debug)]
pub struct ClosureFrame {
    /// Shading normal on the side of `wo`: interpolated, and bent by displacement as bump.
    pub n: Vec3,
    /// Geometric normal on the side of `wo`.
    pub ng: Vec3,
    /// Towards where the path came from.
    pub wo: Vec3,
    /// `wo` sees the back of the surface: indices of refraction are inverted.
    pub backfacing: bool,
    /// Bent normals are corrected and their terminator softened (a material's "bump map
    /// correction", on by default).
    pub bump_correction: bool,
}

/// A lobe's value for a pair of directions, without its weight.
#[derive(Clone, Copy, Debug)]
pub struct LobeValue {
    /// f · |cos|, sr⁻¹.
    pub value: Vec3,
    /// Density with which the lobe's sampling takes this direction, sr⁻¹.
    pub pdf: f32,
}

/// A sampled direction, without the lobe's weight.
#[derive(Clone, Copy, Debug)]
pub struct LobeSample {
    /// Unit direction away from the surface.
    pub wi: Vec3,
    /// f · |cos|, sr⁻¹.
    pub value: Vec3,
    /// Density, sr⁻¹.
    pub pdf: f32,
    /// `SCATTER_` flags; 0: nothing was sampled.
    pub flags: u32,
    /// Square root of the mean α: 1 for diffuse lobes.
    pub roughness: f32,
    /// Relative index of refraction of a transmitted direction, else 1.
    pub eta: f32,
}

/// Value and density of a lobe for the direction `wi`. Lobes that are perfectly sharp have
/// none.
#[inline(always)]
pub fn lobe_eval(lobe: ClosureLobe, frame: ClosureFrame, wi: Vec3) -> LobeValue {
    if lobe.kind <= LOBE_TRANSLUCENT {
        let soft = lobe_soft_eval(lobe, frame.wo, wi);
        let shadow = lobe_shadow(lobe, frame, wi);
        LobeValue {
            value: soft.value * shadow,
            pdf: soft.pdf,
        }
    } else if lobe.kind <= LOBE_BECKMANN {
        lobe_microfacet_eval(lobe, frame, wi)
    } else if lobe.kind == LOBE_ASHIKHMIN_SHIRLEY {
        lobe_ashikhmin_eval(lobe, frame, wi)
    } else {
        lobe_velvet_eval(lobe, frame.wo, wi)
    }
}

/// Samples a direction from a lobe with `u` in [0, 1)³; its third component chooses
/// between reflection and refraction.
#[inline(always)]
pub fn lobe_sample(lobe: ClosureLobe, frame: ClosureFrame, u: Vec3) -> LobeSample {
    if lobe.kind <= LOBE_TRANSLUCENT {
        lobe_soft_sample(lobe, frame, u)
    } else if lobe.kind <= LOBE_BECKMANN {
        lobe_microfacet_sample(lobe, frame, u)
    } else if lobe.kind == LOBE_ASHIKHMIN_SHIRLEY {
        lobe_ashikhmin_sample(lobe, frame, u)
    } else {
        lobe_velvet_sample(lobe, frame, u)
    }
}

/// Nothing was sampled.
#[inline(always)]
pub fn lobe_sample_none() -> LobeSample {
    LobeSample {
        wi: splat3(0.0),
        value: splat3(0.0),
        pdf: 0.0,
        flags: 0,
        roughness: 1.0,
        eta: 1.0,
    }
}
