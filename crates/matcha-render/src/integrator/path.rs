//! A path in flight and the rules that end it.

use crate::scene::Settings;
use glam::Vec3;

/// Kind of the ray that a path currently follows, and what happened to the path before.
pub mod flags {
    pub use crate::device::path_flags::{
        PATH_CAMERA as CAMERA, PATH_DIFFUSE as DIFFUSE, PATH_DIFFUSE_ANCESTOR as DIFFUSE_ANCESTOR,
        PATH_FEATURES_DONE as FEATURES_DONE, PATH_GLOSSY as GLOSSY, PATH_REFLECT as REFLECT,
        PATH_SHADOW as SHADOW, PATH_SINGULAR as SINGULAR, PATH_TERMINATE as TERMINATE,
        PATH_TRANSMIT as TRANSMIT,
    };
}

/// Everything that a path carries from one surface to the next.
#[derive(Clone, Copy, Debug)]
pub struct Path {
    /// Pixel inside the tile.
    pub pixel: u32,
    /// Sample index of the pixel.
    pub sample: u32,
    /// Seed of the pixel's sequence.
    pub seed: u32,
    /// First unused dimension of the sequence.
    pub dimension: u32,
    /// Ray origin, world space.
    pub origin: Vec3,
    /// Unit ray direction.
    pub direction: Vec3,
    /// Start of the ray, metres.
    pub t_min: f32,
    /// End of the ray, metres.
    pub t_max: f32,
    /// Surface that the ray leaves: instance and primitive, `accel::NOTHING` for none.
    pub leaves: [u32; 2],
    /// Product of closure weights over probabilities.
    pub throughput: Vec3,
    /// Radiance gathered so far.
    pub radiance: Vec3,
    /// Part of the pixel that is covered: 1 minus what passed through to nothing.
    pub alpha: f32,
    /// See [`flags`].
    pub flags: u32,
    /// Bounces so far.
    pub bounce: u16,
    /// Bounces off diffuse closures.
    pub diffuse: u16,
    /// Bounces off glossy closures.
    pub glossy: u16,
    /// Bounces through surfaces.
    pub transmission: u16,
    /// Transparent surfaces passed.
    pub transparent: u16,
    /// Solid-angle density with which the last direction was sampled.
    pub scatter_pdf: f32,
    /// Smallest `scatter_pdf` of the path, for Cycles' "filter glossy".
    pub min_pdf: f32,
    /// Point of the last scattering, for the densities of lights that are hit.
    pub mis_origin: Vec3,
    /// Normal there as light selection took it; zero for transmissive surfaces.
    pub mis_normal: Vec3,
    /// Width of the ray cone at the ray's origin, metres.
    pub cone_width: f32,
    /// Spread of the ray cone, radians.
    pub cone_spread: f32,
    /// Cacheable nodes found in the cache so far.
    pub nodes_found: f32,
    /// Features for the film.
    pub albedo: Vec3,
    /// Features for the film.
    pub normal: Vec3,
    /// Features for the film; negative while nothing is hit.
    pub depth: f32,
}

/// How a closure scattered a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ScatterKind {
    /// One of `DIFFUSE`, `GLOSSY`.
    pub diffuse: bool,
    /// Perfectly sharp.
    pub singular: bool,
    /// Through the surface.
    pub transmit: bool,
}

impl Path {
    /// Counts a bounce and sets the ray's kind; marks the path to end at the next surface
    /// where a limit is passed (as in Cycles: a limit of 0 still shows direct light, and what
    /// the last ray meets still adds its emission).
    pub fn count_bounce(&mut self, kind: ScatterKind, settings: &Settings) {
        let kept = flags::FEATURES_DONE | flags::DIFFUSE_ANCESTOR;
        let mut next = self.flags & kept;
        self.bounce += 1;
        let mut ends = u32::from(self.bounce) > settings.max_bounces;
        if kind.transmit {
            self.transmission += 1;
            next |= flags::TRANSMIT;
            ends |= u32::from(self.transmission) > settings.transmission_bounces;
        } else {
            next |= flags::REFLECT;
            let (count, limit) = if kind.diffuse {
                (&mut self.diffuse, settings.diffuse_bounces)
            } else {
                (&mut self.glossy, settings.glossy_bounces)
            };
            *count += 1;
            ends |= u32::from(*count) > limit;
        }
        next |= if kind.diffuse {
            flags::DIFFUSE | flags::DIFFUSE_ANCESTOR
        } else {
            flags::GLOSSY
        };
        if kind.singular {
            next |= flags::SINGULAR;
        }
        if ends {
            next |= flags::TERMINATE;
        }
        self.flags = next;
    }

    /// Counts a pass through a transparent surface; false where the limit is reached.
    pub fn count_transparent(&mut self, settings: &Settings) -> bool {
        self.transparent += 1;
        u32::from(self.transparent) <= settings.transparent_bounces
    }

    /// Probability with which Russian roulette lets the path live on.
    ///
    /// The square root keeps paths alive longer than their throughput alone would: their
    /// light is not known yet, and a killed path costs its whole prefix.
    pub fn survival(&self) -> f32 {
        if self.bounce == 0 {
            return 1.0;
        }
        self.throughput.max_element().sqrt().clamp(0.0, 1.0)
    }

    /// Roughness below which closures are blurred, as Cycles' filter glossy asks
    /// (0: nothing is blurred).
    pub fn blur_roughness(&self, settings: &Settings) -> f32 {
        if settings.blur_glossy <= 0.0 {
            return 0.0;
        }
        let blur = self.min_pdf / settings.blur_glossy;
        if blur < 1.0 {
            (1.0 - blur).sqrt() * 0.5
        } else {
            0.0
        }
    }
}

/// Clamps a contribution by the mean of its channels, as Cycles does:
/// `bounce` 0 is direct light.
pub fn clamp_contribution(light: Vec3, bounce: u32, settings: &Settings) -> Vec3 {
    if !light.is_finite() {
        return Vec3::ZERO;
    }
    let limit = if bounce == 0 {
        settings.clamp_direct
    } else {
        settings.clamp_indirect
    };
    let sum = light.abs().element_sum();
    if limit > 0.0 && sum > 3.0 * limit {
        light * (3.0 * limit / sum)
    } else {
        light
    }
}

/// Weight of a technique with density `a` against one with density `b`
/// (power heuristic, Veach 1997, section 9.2.4).
pub fn power_heuristic(a: f32, b: f32) -> f32 {
    if !a.is_finite() {
        return 1.0;
    }
    // Squares of large densities overflow; the ratio does not.
    let ratio = b / a;
    1.0 / (1.0 + ratio * ratio)
}
