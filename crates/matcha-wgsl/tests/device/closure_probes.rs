//! Device code for tests: closures from their rows to values and samples.

use matcha_render::device::closure_lobe::ClosureContext;
use matcha_render::device::closure_prepare::closure_prepare;
use matcha_render::device::closure_rows::ClosureRows;
use matcha_render::device::closure_set::{
    LobeSet, closure_set_begin, closure_set_eval, closure_set_sample,
};
use matcha_render::device::closure_tables::ClosureTables;
use matcha_render::device::lobe::ClosureFrame;
use matcha_render::device::ray_kind::RAY_ALL;
use matcha_shade::device::math::*;

/// A number in [0, 1) of two words.
pub fn probe_random(a: u32, b: u32) -> f32 {
    let x = wrapping_mul(a ^ wrapping_mul(b, 0x9e37_79b9), 0x85eb_ca6b);
    let y = wrapping_mul(x ^ (x >> 15), 0xc2b2_ae35);
    ((y ^ (y >> 13)) >> 8) as f32 / 16_777_216.0
}

/// Row `i` of the closure of a point with the seed `seed`.
pub fn probe_row(seed: u32, i: u32) -> f32 {
    probe_random(seed, i) * 1.25
}

/// Entry `i` of the tables: whatever, it is the same on both sides.
pub fn probe_entry(i: u32) -> f32 {
    0.3 + 0.6 * probe_random(i, 77)
}

/// Three numbers in [0, 1).
pub fn probe_randoms(seed: u32, i: u32) -> Vec3 {
    vec3(
        probe_random(seed, i),
        probe_random(seed, i + 1),
        probe_random(seed, i + 2),
    )
}

/// The frame of a point.
pub fn probe_frame(seed: u32) -> ClosureFrame {
    let around = probe_randoms(seed, 100) - splat3(0.5);
    ClosureFrame {
        n: normalize(vec3(0.3 * around.x, 0.3 * around.y, 1.0)),
        ng: vec3(0.0, 0.0, 1.0),
        wo: normalize(vec3(around.x, around.y, 0.3 + around.z * 0.4)),
        backfacing: probe_random(seed, 103) < 0.3,
        bump_correction: probe_random(seed, 104) < 0.7,
    }
}

/// Value, density and sample of a closure of the code `kind`.
pub fn probe_lobes(
    set: &mut LobeSet,
    rows: ClosureRows,
    tables: ClosureTables,
    seed: u32,
    kind: u32,
) -> [f32; 8] {
    closure_set_begin(set, probe_frame(seed));
    let context = ClosureContext {
        blur: select(0.0, 0.1, probe_random(seed, 105) < 0.5),
        reflective_caustics: probe_random(seed, 106) < 0.9,
        refractive_caustics: probe_random(seed, 107) < 0.9,
        scatter: true,
    };
    closure_prepare(kind, rows, tables, context, set);
    let wi = normalize(probe_randoms(seed, 110) - vec3(0.5, 0.5, 0.2));
    let at = closure_set_eval(set, wi, RAY_ALL);
    let to = closure_set_sample(set, probe_randoms(seed, 120));
    [
        at.value.x + at.value.y + at.value.z,
        at.pdf,
        to.wi.x + 0.5 * to.wi.y + 0.25 * to.wi.z,
        to.weight.x + to.weight.y + to.weight.z,
        to.pdf,
        set.emission.x + set.transparency.y,
        set.albedo.x + set.albedo.y + set.albedo.z,
        set.sum,
    ]
}
