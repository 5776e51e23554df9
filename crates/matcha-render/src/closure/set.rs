//! The lobes of one hit: methods for what device code does with them.

use crate::device::closure_set::{
    CLOSURE_CAPACITY, LobeSet, closure_set_albedo, closure_set_begin, closure_set_eval,
    closure_set_has_bsdf, closure_set_has_eval, closure_set_normal, closure_set_reflects_only,
    closure_set_sample,
};
pub use crate::device::closure_set::{Evaluated, Scattered};
use crate::device::fresnel::FRESNEL_NONE;
use crate::device::lobe::{ClosureFrame, ClosureLobe, LOBE_DIFFUSE};
use crate::device::ray_kind::RAY_ALL;
use glam::Vec3;

/// What happened to a scattered path; the bits are those of the device code.
pub mod flags {
    pub use crate::device::lobe::{
        SCATTER_DIFFUSE as DIFFUSE, SCATTER_GLOSSY as GLOSSY, SCATTER_REFLECT as REFLECT,
        SCATTER_SINGULAR as SINGULAR, SCATTER_TRANSMIT as TRANSMIT,
        SCATTER_TRANSPARENT as TRANSPARENT,
    };
}

impl Default for LobeSet {
    fn default() -> Self {
        let up = Vec3::Z;
        Self {
            frame: ClosureFrame {
                n: up,
                ng: up,
                wo: up,
                backfacing: false,
                bump_correction: true,
            },
            lobes: [EMPTY; CLOSURE_CAPACITY as usize],
            count: 0,
            sum: 0.0,
            through: 0.0,
            transmits: false,
            spreads: false,
            albedo: Vec3::ZERO,
            emission: Vec3::ZERO,
            transparency: Vec3::ZERO,
            holdout: Vec3::ZERO,
            dropped: 0,
        }
    }
}

const EMPTY: ClosureLobe = ClosureLobe {
    kind: LOBE_DIFFUSE,
    fresnel: FRESNEL_NONE,
    reflects: 1.0,
    weight: Vec3::ZERO,
    sample_weight: 0.0,
    normal: Vec3::Z,
    tangent: Vec3::X,
    alpha_x: 1.0,
    alpha_y: 1.0,
    ior: 1.0,
    energy: 1.0,
    f0: Vec3::ZERO,
    tint: Vec3::ZERO,
    cos_wo: 1.0,
    lambda_wo: 0.0,
};

impl LobeSet {
    /// An empty set.
    pub fn new() -> Self {
        Self::default()
    }

    /// Empties the set for a new hit.
    pub fn begin(&mut self, frame: &ClosureFrame) {
        closure_set_begin(self, *frame);
    }

    /// The lobes.
    pub fn lobes(&self) -> &[ClosureLobe] {
        &self.lobes[..self.count as usize]
    }

    /// Whether there is anything that a path can go on with, transparency included.
    pub fn has_bsdf(&self) -> bool {
        closure_set_has_bsdf(self)
    }

    /// Whether [`LobeSet::eval`] can be other than zero: some lobe is not singular.
    pub fn has_eval(&self) -> bool {
        closure_set_has_eval(self)
    }

    /// Whether every lobe reflects: light from behind the surface is lost.
    pub fn reflects_only(&self) -> bool {
        closure_set_reflects_only(self)
    }

    /// Estimate of the reflectance and transmittance of all lobes, for the albedo layer.
    pub fn albedo(&self) -> Vec3 {
        closure_set_albedo(self)
    }

    /// Mean normal of the lobes, unit; the shading normal where there is none.
    pub fn normal(&self) -> Vec3 {
        closure_set_normal(self)
    }

    /// Value and density of all lobes for the direction `wi`. Singular lobes are not in it,
    /// and light from behind the shading normal counts only where some lobe transmits.
    pub fn eval(&self, wi: Vec3) -> Evaluated {
        closure_set_eval(self, wi, RAY_ALL)
    }

    /// Samples a direction with `u` in [0, 1)³: `u.z` selects the lobe. None where the
    /// direction fell on the wrong side of the surface.
    pub fn sample(&self, u: Vec3) -> Option<Scattered> {
        let scattered = closure_set_sample(self, u);
        (scattered.flags != 0).then_some(scattered)
    }
}
