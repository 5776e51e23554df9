//! The lobes of one hit.

use crate::device::lobe::{
    ClosureFrame, ClosureLobe, LOBE_BECKMANN, LOBE_DIFFUSE, LOBE_SINGULAR_ALPHA2,
    LOBE_SINGULAR_DENSITY, LOBE_TRANSLUCENT, lobe_eval, lobe_sample,
};
use glam::Vec3;

/// What happened to a scattered path; the bits are those of the device code.
pub mod flags {
    pub use crate::device::lobe::{
        SCATTER_DIFFUSE as DIFFUSE, SCATTER_GLOSSY as GLOSSY, SCATTER_REFLECT as REFLECT,
        SCATTER_SINGULAR as SINGULAR, SCATTER_TRANSMIT as TRANSMIT,
        SCATTER_TRANSPARENT as TRANSPARENT,
    };
}

/// Lobes that one hit can have; further ones are counted in [`LobeSet::dropped`] and left
/// out. A Principled closure needs up to six.
const CAPACITY: usize = 24;

/// Weights below this make no lobe (mean of the channels; Cycles' cutoff).
pub(super) const WEIGHT_CUTOFF: f32 = 1.0e-5;

/// All lobes of a hit together, for one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evaluated {
    /// f · |cos|, sr⁻¹.
    pub value: Vec3,
    /// The part of `value` that diffuse lobes make.
    pub diffuse: Vec3,
    /// Density with which [`LobeSet::sample`] takes the direction, sr⁻¹.
    pub pdf: f32,
}

/// A sampled direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scattered {
    /// Unit direction away from the surface.
    pub wi: Vec3,
    /// f · |cos| / pdf of all lobes together.
    pub weight: Vec3,
    /// Density of the mixture of all lobes, sr⁻¹; very large for singular lobes and
    /// transparency.
    pub pdf: f32,
    /// Of the lobe that was sampled: see [`flags`].
    pub flags: u32,
    /// Roughness of the sampled lobe, 1 for diffuse ones, 0 for transparency.
    pub roughness: f32,
    /// Relative index of refraction of a transmitted direction, else 1.
    pub eta: f32,
}

/// The closures of a hit. Reuse one per thread: [`LobeSet::begin`] empties it.
#[derive(Clone, Debug)]
pub struct LobeSet {
    frame: ClosureFrame,
    lobes: [ClosureLobe; CAPACITY],
    count: usize,
    /// Sum of the lobes' sampling weights and of `through`.
    sum: f32,
    /// Sampling weight of the transparency.
    through: f32,
    /// Some lobe transmits.
    transmits: bool,
    /// Emitted radiance towards `wo`, W·sr⁻¹·m⁻²; of a world, its radiance.
    pub emission: Vec3,
    /// Fraction of light that passes straight through.
    pub transparency: Vec3,
    /// Weight with which the film is made transparent.
    pub holdout: Vec3,
    /// Lobes that did not fit.
    pub dropped: u32,
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
            lobes: [EMPTY; CAPACITY],
            count: 0,
            sum: 0.0,
            through: 0.0,
            transmits: false,
            emission: Vec3::ZERO,
            transparency: Vec3::ZERO,
            holdout: Vec3::ZERO,
            dropped: 0,
        }
    }
}

const EMPTY: ClosureLobe = ClosureLobe {
    kind: LOBE_DIFFUSE,
    fresnel: 0,
    bent: false,
    weight: Vec3::ZERO,
    sample_weight: 0.0,
    albedo: Vec3::ZERO,
    normal: Vec3::Z,
    tangent: Vec3::X,
    alpha_x: 1.0,
    alpha_y: 1.0,
    ior: 1.0,
    energy: 1.0,
    f0: Vec3::ZERO,
    extra: Vec3::ZERO,
    reflect_tint: Vec3::ONE,
    transmit_tint: Vec3::ZERO,
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
        self.frame = *frame;
        self.count = 0;
        self.sum = 0.0;
        self.through = 0.0;
        self.transmits = false;
        self.emission = Vec3::ZERO;
        self.transparency = Vec3::ZERO;
        self.holdout = Vec3::ZERO;
        self.dropped = 0;
    }

    /// A lobe with neutral parameters.
    pub(super) fn blank() -> ClosureLobe {
        EMPTY
    }

    pub(super) fn push(&mut self, lobe: ClosureLobe) {
        if self.count == CAPACITY {
            self.dropped += 1;
            return;
        }
        self.lobes[self.count] = lobe;
        self.count += 1;
        self.sum += lobe.sample_weight;
        self.transmits |= lobe.kind == LOBE_TRANSLUCENT || lobe.transmit_tint != Vec3::ZERO;
    }

    pub(super) fn add_transparency(&mut self, weight: Vec3) {
        let mean = mean(weight).abs();
        if mean >= WEIGHT_CUTOFF {
            self.transparency += weight;
            self.through += mean;
            self.sum += mean;
        }
    }

    /// The lobes.
    pub fn lobes(&self) -> &[ClosureLobe] {
        &self.lobes[..self.count]
    }

    /// Whether there is anything that a path can go on with, transparency included.
    pub fn has_bsdf(&self) -> bool {
        self.sum > 0.0
    }

    /// Whether [`LobeSet::eval`] can be other than zero: some lobe is not singular.
    pub fn has_eval(&self) -> bool {
        self.lobes().iter().any(|l| {
            let microfacet = l.kind > LOBE_TRANSLUCENT && l.kind <= LOBE_BECKMANN;
            !microfacet || l.alpha_x * l.alpha_y > LOBE_SINGULAR_ALPHA2
        })
    }

    /// Whether every lobe reflects: light from behind the surface is lost.
    pub fn reflects_only(&self) -> bool {
        self.lobes()
            .iter()
            .all(|l| l.kind != LOBE_TRANSLUCENT && l.transmit_tint == Vec3::ZERO)
    }

    /// Estimate of the reflectance and transmittance of all lobes, for the albedo layer.
    pub fn albedo(&self) -> Vec3 {
        self.lobes().iter().map(|l| l.albedo).sum()
    }

    /// Mean normal of the lobes, unit; the shading normal where there is none.
    pub fn normal(&self) -> Vec3 {
        let sum: Vec3 = self
            .lobes()
            .iter()
            .map(|l| l.normal * l.sample_weight)
            .sum();
        sum.try_normalize().unwrap_or(self.frame.n)
    }

    /// Value and density of all lobes for the direction `wi`. Singular lobes are not in it,
    /// and light from behind the shading normal counts only where some lobe transmits.
    pub fn eval(&self, wi: Vec3) -> Evaluated {
        let mut total = Evaluated {
            value: Vec3::ZERO,
            diffuse: Vec3::ZERO,
            pdf: 0.0,
        };
        if !self.transmits && self.frame.n.dot(wi) < 0.0 {
            return total;
        }
        self.accumulate(wi, usize::MAX, &mut total);
        total.pdf /= self.sum.max(f32::MIN_POSITIVE);
        total
    }

    /// Adds every lobe but `skip`; densities are multiplied by sampling weights.
    fn accumulate(&self, wi: Vec3, skip: usize, total: &mut Evaluated) {
        for (i, lobe) in self.lobes().iter().enumerate() {
            if i == skip {
                continue;
            }
            let at = lobe_eval(*lobe, self.frame, wi);
            let value = at.value * lobe.weight;
            total.value += value;
            if lobe.kind <= LOBE_TRANSLUCENT {
                total.diffuse += value;
            }
            total.pdf += at.pdf * lobe.sample_weight;
        }
    }

    /// Samples a direction with `u` in [0, 1)³: `u.z` selects the lobe. The other lobes'
    /// values count too (one-sample model with the balance heuristic, Veach 1997, section
    /// 9.2.4). None where the direction fell on the wrong side of the surface.
    pub fn sample(&self, u: Vec3) -> Option<Scattered> {
        let mut at = u.z * self.sum;
        let mut picked = None;
        for (i, lobe) in self.lobes().iter().enumerate() {
            if at < lobe.sample_weight {
                picked = Some(i);
                break;
            }
            at -= lobe.sample_weight;
        }
        let Some(i) = picked.or_else(|| self.last_scattering(at)) else {
            return self.straight_on();
        };
        let lobe = &self.lobes[i];
        let rest = (at / lobe.sample_weight).clamp(0.0, 1.0 - f32::EPSILON);
        let scattered = lobe_sample(*lobe, self.frame, Vec3::new(u.x, u.y, rest));
        if scattered.flags == 0 || scattered.pdf <= 0.0 {
            return None;
        }
        let value = scattered.value * lobe.weight;
        let pdf = scattered.pdf * lobe.sample_weight;
        let mut total = Evaluated {
            value,
            diffuse: Vec3::ZERO,
            pdf,
        };
        if self.count > 1 {
            self.accumulate(scattered.wi, i, &mut total);
        }
        Some(Scattered {
            wi: scattered.wi,
            weight: total.value * (self.sum / total.pdf),
            pdf: total.pdf / self.sum,
            flags: scattered.flags,
            roughness: scattered.roughness,
            eta: scattered.eta,
        })
    }

    /// The last lobe, where rounding let `u` run past it although nothing is transparent.
    fn last_scattering(&self, past: f32) -> Option<usize> {
        (self.through <= 0.0 && self.count > 0 && past.is_finite()).then(|| self.count - 1)
    }

    fn straight_on(&self) -> Option<Scattered> {
        (self.through > 0.0).then(|| Scattered {
            wi: -self.frame.wo,
            weight: self.transparency * (self.sum / self.through),
            pdf: LOBE_SINGULAR_DENSITY * (self.through / self.sum),
            flags: flags::TRANSPARENT | flags::TRANSMIT,
            roughness: 0.0,
            eta: 1.0,
        })
    }
}

/// Mean of the channels.
pub(super) fn mean(color: Vec3) -> f32 {
    color.element_sum() * (1.0 / 3.0)
}
