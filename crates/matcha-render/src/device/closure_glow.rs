//! What a hit's closures do without scattering: all that shadow rays ask for. Kernels that
//! need no more are spared a set of lobes.

use glam::Vec3;
use matcha_shade::device::math::{dot, is_finite3, max, pow_positive, splat3, sqrt, vec3};

use super::closure_kind::{
    CLOSURE_BACKGROUND, CLOSURE_EMISSION, CLOSURE_HOLDOUT, CLOSURE_MODEL_STEP, CLOSURE_PRINCIPLED,
    CLOSURE_ROW_WEIGHT, CLOSURE_TRANSPARENT, PRINCIPLED_ROW_ALPHA, PRINCIPLED_ROW_COAT_IOR,
    PRINCIPLED_ROW_COAT_NORMAL, PRINCIPLED_ROW_COAT_TINT, PRINCIPLED_ROW_COAT_WEIGHT,
    PRINCIPLED_ROW_EMISSION_COLOR, PRINCIPLED_ROW_EMISSION_STRENGTH,
};
use super::closure_lobe::{closure_normal, closure_valid};
use super::closure_rows::{
    ClosureRows, closure_color, closure_number, closure_share, closure_triple,
};
use super::closure_set::{CLOSURE_WEIGHT_CUTOFF, closure_passes};
use super::lobe::ClosureFrame;

/// What a closure does but scattering.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosureGlow {
    /// Emitted radiance, W·sr⁻¹·m⁻².
    pub emission: Vec3,
    /// Fraction of light that passes straight through.
    pub transparency: Vec3,
    /// Weight with which the film is made transparent.
    pub holdout: Vec3,
}

/// A closure's part in a hit's emission, transparency and holdout, as
/// [`super::closure_prepare::closure_prepare`] adds them where nothing is to scatter.
pub fn closure_glow(kind: u32, rows: ClosureRows, frame: ClosureFrame) -> ClosureGlow {
    let family = kind % CLOSURE_MODEL_STEP;
    let weight = closure_triple(rows, CLOSURE_ROW_WEIGHT);
    let mut glow = ClosureGlow {
        emission: Vec3::ZERO,
        transparency: Vec3::ZERO,
        holdout: Vec3::ZERO,
    };
    if family == CLOSURE_EMISSION || family == CLOSURE_BACKGROUND {
        glow.emission = weight;
    } else if family == CLOSURE_TRANSPARENT {
        glow.transparency = closure_passing(weight);
    } else if family == CLOSURE_HOLDOUT {
        glow.holdout = weight;
    } else if family == CLOSURE_PRINCIPLED {
        let alpha = closure_share(rows, PRINCIPLED_ROW_ALPHA);
        let coat = max(closure_number(rows, PRINCIPLED_ROW_COAT_WEIGHT), 0.0);
        let mut left = weight;
        if alpha < 1.0 {
            glow.transparency = closure_passing(weight * (1.0 - alpha));
            left *= alpha;
        }
        if coat > CLOSURE_WEIGHT_CUTOFF {
            let bent = closure_normal(rows, PRINCIPLED_ROW_COAT_NORMAL, frame.n);
            left = principled_tinted(rows, frame, closure_valid(frame, bent), left);
        }
        glow.emission = principled_emitted(rows, left);
    }
    glow
}

/// A transparency, 0 where it is too small to count.
#[inline]
fn closure_passing(weight: Vec3) -> Vec3 {
    if closure_passes(weight) {
        weight
    } else {
        Vec3::ZERO
    }
}

/// What a Principled closure emits of the weight that is left below its coat.
#[inline]
pub fn principled_emitted(rows: ClosureRows, left: Vec3) -> Vec3 {
    let strength = closure_number(rows, PRINCIPLED_ROW_EMISSION_STRENGTH);
    let emitted = closure_triple(rows, PRINCIPLED_ROW_EMISSION_COLOR) * strength * left;
    if is_finite3(emitted) {
        emitted
    } else {
        Vec3::ZERO
    }
}

/// The index of refraction of the coat.
#[inline(always)]
pub fn principled_coat_ior(rows: ClosureRows) -> f32 {
    max(closure_number(rows, PRINCIPLED_ROW_COAT_IOR), 1.0)
}

/// What the coat of the normal `normal` lets through of `weight`: its tint is that of one
/// thickness, and light crosses more of it at an angle (Beer).
#[inline]
pub fn principled_tinted(
    rows: ClosureRows,
    frame: ClosureFrame,
    normal: Vec3,
    weight: Vec3,
) -> Vec3 {
    let mut left = weight;
    let tint = closure_color(rows, PRINCIPLED_ROW_COAT_TINT);
    if tint.x != 1.0 || tint.y != 1.0 || tint.z != 1.0 {
        let coat = max(closure_number(rows, PRINCIPLED_ROW_COAT_WEIGHT), 0.0);
        let ior = principled_coat_ior(rows);
        let cosine = dot(frame.wo, normal);
        let inside = sqrt(max(1.0 - (1.0 - cosine * cosine) / (ior * ior), 1.0e-6));
        let thickness = 1.0 / inside;
        let absorbed = vec3(
            pow_positive(tint.x, thickness),
            pow_positive(tint.y, thickness),
            pow_positive(tint.z, thickness),
        );
        left *= splat3(1.0) + (absorbed - splat3(1.0)) * coat;
    }
    left
}
