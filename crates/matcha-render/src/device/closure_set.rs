//! The lobes of one hit together.

use glam::Vec3;
use matcha_shade::device::math::{MAX, abs, clamp, dot, max};

use super::closure_rows::closure_unit;
use super::fresnel::FRESNEL_F82;
use super::lobe::{
    ClosureFrame, ClosureLobe, LOBE_BECKMANN, LOBE_SINGULAR_ALPHA2, LOBE_SINGULAR_DENSITY,
    LOBE_TRANSLUCENT, SCATTER_TRANSMIT, SCATTER_TRANSPARENT, lobe_eval, lobe_sample,
};
use super::ray_kind::{RAY_ALL, RAY_DIFFUSE, RAY_GLOSSY, RAY_TRANSMISSION};

/// Lobes that one hit can have; further ones are counted in [`LobeSet::dropped`] and left
/// out. A Principled closure needs up to seven.
pub const CLOSURE_CAPACITY: u32 = 24;

/// Weights below this make no lobe (mean of the channels; Cycles' cutoff).
pub const CLOSURE_WEIGHT_CUTOFF: f32 = 1.0e-5;

/// No lobe.
const CLOSURE_NO_LOBE: u32 = 0xffff_ffff;

/// The closures of a hit. Reuse one per thread: [`closure_set_begin`] empties it.
#[derive(Clone, Debug)]
pub struct LobeSet {
    /// The hit.
    pub frame: ClosureFrame,
    /// Lobes, of which `count` are meant; as many as [`CLOSURE_CAPACITY`] says.
    pub lobes: [ClosureLobe; 24],
    /// Number of lobes.
    pub count: u32,
    /// Sum of the lobes' sampling weights and of `through`.
    pub sum: f32,
    /// Sampling weight of the transparency.
    pub through: f32,
    /// Some lobe transmits.
    pub transmits: bool,
    /// Some lobe is not perfectly sharp.
    pub spreads: bool,
    /// Sum of the lobes' estimated weight × reflectance.
    pub albedo: Vec3,
    /// Emitted radiance towards `wo`, W·sr⁻¹·m⁻²; of a world, its radiance.
    pub emission: Vec3,
    /// Fraction of light that passes straight through.
    pub transparency: Vec3,
    /// Weight with which the film is made transparent.
    pub holdout: Vec3,
    /// Lobes that did not fit.
    pub dropped: u32,
}

/// All lobes of a hit together, for one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evaluated {
    /// f · |cos|, sr⁻¹.
    pub value: Vec3,
    /// The part of `value` that diffuse lobes make.
    pub diffuse: Vec3,
    /// Density with which [`closure_set_sample`] takes the direction, sr⁻¹.
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
    /// Of the lobe that was sampled, `SCATTER_` constants; 0: nothing was sampled.
    pub flags: u32,
    /// Roughness of the sampled lobe, 1 for diffuse ones, 0 for transparency.
    pub roughness: f32,
    /// Relative index of refraction of a transmitted direction, else 1.
    pub eta: f32,
}

/// Which lobe a number selects.
#[derive(Clone, Copy, Debug)]
pub struct ClosurePick {
    /// Its index; `CLOSURE_NO_LOBE` where transparency is selected, or nothing.
    pub lobe: u32,
    /// What is left of the number, up to the lobe's sampling weight.
    pub rest: f32,
}

/// Mean of the channels.
#[inline(always)]
pub fn closure_mean(color: Vec3) -> f32 {
    (color.x + color.y + color.z) * (1.0 / 3.0)
}

/// Whether a colour is black.
#[inline(always)]
pub fn closure_black(color: Vec3) -> bool {
    color.x == 0.0 && color.y == 0.0 && color.z == 0.0
}

/// Empties a set for a new hit.
#[inline]
pub fn closure_set_begin(set: &mut LobeSet, frame: ClosureFrame) {
    set.frame = frame;
    set.count = 0;
    set.sum = 0.0;
    set.through = 0.0;
    set.transmits = false;
    set.spreads = false;
    set.albedo = Vec3::ZERO;
    set.emission = Vec3::ZERO;
    set.transparency = Vec3::ZERO;
    set.holdout = Vec3::ZERO;
    set.dropped = 0;
}

/// Whether a lobe lets light through.
#[inline(always)]
pub fn lobe_transmits(lobe: ClosureLobe) -> bool {
    let tinted = lobe.kind > LOBE_TRANSLUCENT && lobe.fresnel != FRESNEL_F82;
    lobe.kind == LOBE_TRANSLUCENT || tinted && !closure_black(lobe.tint)
}

/// Whether a lobe's value can be other than zero: it is not perfectly sharp.
#[inline(always)]
pub fn lobe_spreads(lobe: ClosureLobe) -> bool {
    let microfacet = lobe.kind > LOBE_TRANSLUCENT && lobe.kind <= LOBE_BECKMANN;
    !microfacet || lobe.alpha_x * lobe.alpha_y > LOBE_SINGULAR_ALPHA2
}

/// Adds a lobe; `albedo` is an estimate of its weight × reflectance.
#[inline]
pub fn closure_set_push(set: &mut LobeSet, lobe: ClosureLobe, albedo: Vec3) {
    if set.count >= CLOSURE_CAPACITY {
        set.dropped += 1;
    } else {
        set.lobes[set.count as usize] = lobe;
        set.count += 1;
        set.sum += lobe.sample_weight;
        set.albedo += albedo;
        set.transmits = set.transmits || lobe_transmits(lobe);
        set.spreads = set.spreads || lobe_spreads(lobe);
    }
}

/// Whether a transparency is large enough to count.
#[inline(always)]
pub fn closure_passes(weight: Vec3) -> bool {
    abs(closure_mean(weight)) >= CLOSURE_WEIGHT_CUTOFF
}

/// Lets light straight through.
#[inline]
pub fn closure_set_add_transparency(set: &mut LobeSet, weight: Vec3) {
    if closure_passes(weight) {
        let share = abs(closure_mean(weight));
        set.transparency += weight;
        set.through += share;
        set.sum += share;
    }
}

/// Whether there is anything that a path can go on with, transparency included.
#[inline(always)]
pub fn closure_set_has_bsdf(set: &LobeSet) -> bool {
    set.sum > 0.0
}

/// Whether [`closure_set_eval`] can be other than zero.
#[inline(always)]
pub fn closure_set_has_eval(set: &LobeSet) -> bool {
    set.spreads
}

/// Whether every lobe reflects: light from behind the surface is lost.
#[inline(always)]
pub fn closure_set_reflects_only(set: &LobeSet) -> bool {
    !set.transmits
}

/// Estimate of the reflectance and transmittance of all lobes, for the albedo layer.
#[inline(always)]
pub fn closure_set_albedo(set: &LobeSet) -> Vec3 {
    set.albedo
}

/// Mean normal of the lobes, unit; the shading normal where there is none.
#[inline]
pub fn closure_set_normal(set: &LobeSet) -> Vec3 {
    let mut sum = Vec3::ZERO;
    let mut i = 0;
    while i < set.count {
        sum += set.lobes[i as usize].normal * set.lobes[i as usize].sample_weight;
        i += 1;
    }
    closure_unit(sum, set.frame.n)
}

/// The `RAY_` bits of the rays that a lobe scatters; glass scatters two kinds, and what one of them
/// sees lights all of it.
#[inline(always)]
pub fn lobe_ray_kind(lobe: ClosureLobe) -> u32 {
    if lobe.kind <= LOBE_TRANSLUCENT {
        RAY_DIFFUSE
    } else if lobe_transmits(lobe) && lobe.reflects != 0.0 {
        RAY_GLOSSY | RAY_TRANSMISSION
    } else if lobe_transmits(lobe) {
        RAY_TRANSMISSION
    } else {
        RAY_GLOSSY
    }
}

/// Adds every lobe but number `skip` that scatters one of the `kinds` of rays (`RAY_` bits);
/// densities are multiplied by sampling weights.
#[inline]
pub fn closure_set_accumulate(
    set: &LobeSet,
    wi: Vec3,
    skip: u32,
    kinds: u32,
    total: &mut Evaluated,
) {
    let mut i = 0;
    while i < set.count {
        let lobe = set.lobes[i as usize];
        if i != skip && (kinds & lobe_ray_kind(lobe)) != 0 {
            let at = lobe_eval(lobe, set.frame, wi);
            let value = at.value * lobe.weight;
            total.value += value;
            if lobe.kind <= LOBE_TRANSLUCENT {
                total.diffuse += value;
            }
            total.pdf += at.pdf * lobe.sample_weight;
        }
        i += 1;
    }
}

/// Value and density for the direction `wi` of all lobes that scatter the `kinds` of rays (`RAY_`
/// bits) which see what is there. Singular lobes are not in it,
/// and light from behind the shading normal counts only where some lobe transmits.
pub fn closure_set_eval(set: &LobeSet, wi: Vec3, kinds: u32) -> Evaluated {
    let mut total = Evaluated {
        value: Vec3::ZERO,
        diffuse: Vec3::ZERO,
        pdf: 0.0,
    };
    let hidden = !set.transmits && dot(set.frame.n, wi) < 0.0;
    if !hidden {
        closure_set_accumulate(set, wi, CLOSURE_NO_LOBE, kinds, &mut total);
        total.pdf /= max(set.sum, f32::MIN_POSITIVE);
    }
    total
}

/// The lobe that `at`, from 0 to the set's sum, falls on.
#[inline]
pub fn closure_set_pick(set: &LobeSet, at: f32) -> ClosurePick {
    let mut rest = at;
    let mut i = 0;
    let mut found = false;
    while i < set.count && !found {
        let share = set.lobes[i as usize].sample_weight;
        if rest < share {
            found = true;
        } else {
            rest -= share;
            i += 1;
        }
    }
    if found {
        ClosurePick { lobe: i, rest }
    } else if set.through <= 0.0 && set.sum > 0.0 && abs(rest) <= MAX {
        // Rounding let it run past the last lobe although nothing is transparent.
        ClosurePick {
            lobe: set.count - 1,
            rest,
        }
    } else {
        ClosurePick {
            lobe: CLOSURE_NO_LOBE,
            rest,
        }
    }
}

/// Samples a direction with `u` in [0, 1)³: `u.z` selects the lobe. The other lobes'
/// values count too (one-sample model with the balance heuristic, Veach 1997, section
/// 9.2.4). Flags are 0 where the direction fell on the wrong side of the surface.
pub fn closure_set_sample(set: &LobeSet, u: Vec3) -> Scattered {
    let pick = closure_set_pick(set, u.z * set.sum);
    if pick.lobe == CLOSURE_NO_LOBE {
        closure_set_straight(set)
    } else {
        closure_set_sample_lobe(set, pick, u)
    }
}

/// Samples a direction from one lobe.
#[inline]
pub fn closure_set_sample_lobe(set: &LobeSet, pick: ClosurePick, u: Vec3) -> Scattered {
    let lobe = set.lobes[pick.lobe as usize];
    let rest = clamp(pick.rest / lobe.sample_weight, 0.0, 1.0 - f32::EPSILON);
    let scattered = lobe_sample(lobe, set.frame, Vec3::new(u.x, u.y, rest));
    if scattered.flags == 0 || scattered.pdf <= 0.0 {
        closure_scattered_nowhere()
    } else {
        let mut total = Evaluated {
            value: scattered.value * lobe.weight,
            diffuse: Vec3::ZERO,
            pdf: scattered.pdf * lobe.sample_weight,
        };
        if set.count > 1 {
            closure_set_accumulate(set, scattered.wi, pick.lobe, RAY_ALL, &mut total);
        }
        Scattered {
            wi: scattered.wi,
            weight: total.value * (set.sum / total.pdf),
            pdf: total.pdf / set.sum,
            flags: scattered.flags,
            roughness: scattered.roughness,
            eta: scattered.eta,
        }
    }
}

/// Straight on, if light passes at all.
#[inline]
pub fn closure_set_straight(set: &LobeSet) -> Scattered {
    if set.through > 0.0 {
        Scattered {
            wi: -set.frame.wo,
            weight: set.transparency * (set.sum / set.through),
            pdf: LOBE_SINGULAR_DENSITY * (set.through / set.sum),
            flags: SCATTER_TRANSPARENT | SCATTER_TRANSMIT,
            roughness: 0.0,
            eta: 1.0,
        }
    } else {
        closure_scattered_nowhere()
    }
}

/// Nothing was sampled.
#[inline(always)]
pub fn closure_scattered_nowhere() -> Scattered {
    Scattered {
        wi: Vec3::ZERO,
        weight: Vec3::ZERO,
        pdf: 0.0,
        flags: 0,
        roughness: 1.0,
        eta: 1.0,
    }
}
