//! All lobes of a hit asked about one direction: a known one, or one that a lobe samples.

use glam::Vec3;
use matcha_shade::device::math::{clamp, dot};

use super::closure_set::{CLOSURE_NO_LOBE, LobeSet, closure_set_pick};
use super::lobe::{LOBE_TRANSLUCENT, lobe_sample, lobe_sample_none, lobe_value};

/// A direction that the lobes are asked about.
#[derive(Clone, Copy, Debug)]
pub struct ClosureQuery {
    /// There is something to ask.
    pub asked: bool,
    /// The direction, unless a lobe samples it.
    pub wi: Vec3,
    /// The lobe that samples it, or `CLOSURE_NO_LOBE`.
    pub lobe: u32,
    /// Numbers for that, in [0, 1).
    pub u: Vec3,
}

/// What the lobes say about a direction.
#[derive(Clone, Copy, Debug)]
pub struct ClosureAnswer {
    /// Unit direction away from the surface.
    pub wi: Vec3,
    /// f · |cos| of all lobes, sr⁻¹.
    pub value: Vec3,
    /// The part of `value` that diffuse lobes make.
    pub diffuse: Vec3,
    /// Sum of densities times sampling weights, sr⁻¹.
    pub pdf: f32,
    /// Of the lobe that sampled the direction, `SCATTER_` constants; 0: nothing was sampled.
    pub flags: u32,
    /// Its roughness.
    pub roughness: f32,
    /// Its relative index of refraction where the direction is transmitted, else 1.
    pub eta: f32,
}

/// Nothing is asked.
#[inline(always)]
pub fn closure_no_query() -> ClosureQuery {
    ClosureQuery {
        asked: false,
        wi: Vec3::ZERO,
        lobe: CLOSURE_NO_LOBE,
        u: Vec3::ZERO,
    }
}

/// Sums all lobes for one direction. The lobe that samples the direction comes first. Known and
/// sampled directions are asked about in one place, because drivers inline functions.
#[inline]
pub fn closure_set_ask(set: &LobeSet, query: ClosureQuery) -> ClosureAnswer {
    let mut answer = ClosureAnswer {
        wi: query.wi,
        value: Vec3::ZERO,
        diffuse: Vec3::ZERO,
        pdf: 0.0,
        flags: 0,
        roughness: 1.0,
        eta: 1.0,
    };
    let sampled = query.lobe != CLOSURE_NO_LOBE;
    let mut i = if sampled { query.lobe } else { 0 };
    let mut k = 0;
    while query.asked && k < set.count {
        let lobe = set.lobes[i as usize];
        let mut sample = lobe_sample_none();
        if sampled && k == 0 {
            sample = lobe_sample(lobe, set.frame, query.u);
            if sample.flags == 0 {
                break;
            }
            answer.wi = sample.wi;
            answer.roughness = sample.roughness;
            answer.eta = sample.eta;
        }
        let at = lobe_value(lobe, set.frame, answer.wi, sample);
        if sampled && k == 0 {
            if at.pdf <= 0.0 {
                break;
            }
            answer.flags = sample.flags;
        }
        let value = at.value * lobe.weight;
        answer.value += value;
        if lobe.kind <= LOBE_TRANSLUCENT {
            answer.diffuse += value;
        }
        answer.pdf += at.pdf * lobe.sample_weight;
        k += 1;
        i = if sampled && k <= query.lobe { k - 1 } else { k };
    }
    answer
}

/// What to ask about the known direction `wi`. Light from behind the shading normal counts only
/// where some lobe transmits.
#[inline]
pub fn closure_set_towards(set: &LobeSet, wi: Vec3) -> ClosureQuery {
    let mut query = closure_no_query();
    let hidden = !set.transmits && dot(set.frame.n, wi) < 0.0;
    query.asked = !hidden;
    query.wi = wi;
    query
}

/// What to ask to sample a direction with `u` in [0, 1)³: `u.z` selects the lobe. Nothing where it
/// falls on the transparency.
#[inline]
pub fn closure_set_draw(set: &LobeSet, u: Vec3) -> ClosureQuery {
    let mut query = closure_no_query();
    let pick = closure_set_pick(set, u.z * set.sum);
    if pick.lobe != CLOSURE_NO_LOBE {
        let share = set.lobes[pick.lobe as usize].sample_weight;
        let rest = clamp(pick.rest / share, 0.0, 1.0 - f32::EPSILON);
        query.asked = true;
        query.lobe = pick.lobe;
        query.u = Vec3::new(u.x, u.y, rest);
    }
    query
}
