//! A path in flight and the rules that end it.

use super::path_flags::{
    PATH_CAMERA, PATH_DIFFUSE, PATH_DIFFUSE_ANCESTOR, PATH_FEATURES_DONE, PATH_GLOSSY,
    PATH_REFLECT, PATH_SINGULAR, PATH_SURVIVED, PATH_TERMINATE, PATH_TRANSMIT,
};
use glam::Vec3;
use matcha_shade::device::math::{
    MAX, abs3, clamp, is_finite, is_finite3, max, min, select, splat3, sqrt,
};

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
    /// End of the ray, metres; the largest number where it has none.
    pub t_max: f32,
    /// Surface that the ray leaves: instance and primitive, all bits set for none.
    pub leaves: [u32; 2],
    /// Product of closure weights over probabilities.
    pub throughput: Vec3,
    /// Radiance gathered so far.
    pub radiance: Vec3,
    /// Part of the pixel that is covered: 1 minus what passed through to nothing.
    pub alpha: f32,
    /// The `PATH_` bits: kind of the ray, and what happened to the path before.
    pub flags: u32,
    /// Bounces so far.
    pub bounce: u32,
    /// Bounces off diffuse closures.
    pub diffuse: u32,
    /// Bounces off glossy closures.
    pub glossy: u32,
    /// Bounces through surfaces.
    pub transmission: u32,
    /// Transparent surfaces passed.
    pub transparent: u32,
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

/// Where a path's ray meets a triangle, and the triangle's weights of its second and third
/// corner.
#[derive(Clone, Copy, Debug)]
pub struct PathHit {
    /// Distance, metres.
    pub t: f32,
    /// Weight of the second corner.
    pub u: f32,
    /// Weight of the third corner.
    pub v: f32,
    /// Index into `Scene::instances`.
    pub instance: u32,
    /// Triangle of the instance's mesh.
    pub primitive: u32,
}

/// What the samples of a pixel add up to.
#[derive(Clone, Copy, Debug)]
pub struct FilmSums {
    /// Radiance, linear Rec.709.
    pub radiance: Vec3,
    /// Coverage.
    pub alpha: f32,
    /// Albedo of the first surface that is not transparent.
    pub albedo: Vec3,
    /// Its shading normal, world space.
    pub normal: Vec3,
    /// Distance to it from the camera, metres.
    pub depth: f32,
    /// Samples that hit a surface: the divisor of `depth`.
    pub depth_samples: f32,
    /// Cacheable nodes found in the cache along the whole path.
    pub nodes_found: f32,
    /// Number of samples.
    pub samples: f32,
}

/// Adds a finished path.
#[inline]
pub fn film_add(sums: &mut FilmSums, path: &Path) {
    sums.radiance += path.radiance;
    sums.alpha += clamp(path.alpha, 0.0, 1.0);
    sums.albedo += path.albedo;
    sums.normal += path.normal;
    sums.depth += max(path.depth, 0.0);
    sums.depth_samples += select(0.0, 1.0, path.depth >= 0.0);
    sums.nodes_found += path.nodes_found;
    sums.samples += 1.0;
}

/// What of a scene's settings the rules of a path ask.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, bytemuck::Pod, bytemuck::Zeroable)]
pub struct PathSettings {
    /// Largest number of bounces in all.
    pub max_bounces: u32,
    /// Likewise after diffuse closures.
    pub diffuse_bounces: u32,
    /// Likewise after glossy closures.
    pub glossy_bounces: u32,
    /// Likewise after transmission.
    pub transmission_bounces: u32,
    /// Number of transparent surfaces that a ray passes.
    pub transparent_bounces: u32,
    /// Russian roulette begins after this many bounces.
    pub roulette_bounce: u32,
    /// Clamp of a direct contribution (mean of the channels), 0: none.
    pub clamp_direct: f32,
    /// Clamp of an indirect contribution, 0: none.
    pub clamp_indirect: f32,
    /// Cycles' filter glossy.
    pub blur_glossy: f32,
    /// Caustics by reflection: 0 or 1.
    pub reflective_caustics: u32,
    /// Caustics by refraction: 0 or 1.
    pub refractive_caustics: u32,
    /// Light contributions below this may be dropped at random (Cycles' threshold).
    pub light_threshold: f32,
    /// The world is not seen by the camera, alpha is 0 there: 0 or 1.
    pub transparent_film: u32,
}

/// How a closure scattered a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ScatterKind {
    /// By a diffuse closure; else by a glossy one.
    pub diffuse: bool,
    /// Perfectly sharp.
    pub singular: bool,
    /// Through the surface.
    pub transmit: bool,
}

/// The largest of three components.
#[inline(always)]
pub fn path_max_element(v: Vec3) -> f32 {
    max(max(v.x, v.y), v.z)
}

/// Counts a bounce and sets the ray's kind; marks the path to end at the next surface where a
/// limit is passed (as in Cycles: a limit of 0 still shows direct light, and what the last
/// ray meets still adds its emission).
#[inline]
pub fn path_count_bounce(path: &mut Path, kind: ScatterKind, settings: PathSettings) {
    let mut next = path.flags & (PATH_FEATURES_DONE | PATH_DIFFUSE_ANCESTOR);
    path.bounce += 1;
    let mut ends = path.bounce > settings.max_bounces;
    if kind.transmit {
        path.transmission += 1;
        next |= PATH_TRANSMIT;
        ends = ends || path.transmission > settings.transmission_bounces;
    } else if kind.diffuse {
        path.diffuse += 1;
        next |= PATH_REFLECT;
        ends = ends || path.diffuse > settings.diffuse_bounces;
    } else {
        path.glossy += 1;
        next |= PATH_REFLECT;
        ends = ends || path.glossy > settings.glossy_bounces;
    }
    next |= if kind.diffuse {
        PATH_DIFFUSE | PATH_DIFFUSE_ANCESTOR
    } else {
        PATH_GLOSSY
    };
    if kind.singular {
        next |= PATH_SINGULAR;
    }
    if ends {
        next |= PATH_TERMINATE;
    }
    path.flags = next;
}

/// Counts a pass through a transparent surface; false where the limit is reached.
#[inline]
pub fn path_count_transparent(path: &mut Path, settings: PathSettings) -> bool {
    path.transparent += 1;
    path.transparent <= settings.transparent_bounces
}

/// Probability with which Russian roulette lets a path live on that was scattered; 1 once it
/// has been played.
///
/// The square root keeps paths alive longer than their throughput alone would: their
/// light is not known yet, and a killed path costs its whole prefix.
#[inline]
pub fn path_survival(path: &Path, settings: PathSettings) -> f32 {
    if (path.flags & PATH_SURVIVED) != 0 || path.bounce < settings.roulette_bounce {
        return 1.0;
    }
    clamp(sqrt(path_max_element(path.throughput)), 0.0, 1.0)
}

/// Roughness below which closures are blurred, as Cycles' filter glossy asks
/// (0: nothing is blurred), from the smallest density of the path so far.
#[inline]
pub fn path_blur_roughness(min_pdf: f32, blur_glossy: f32) -> f32 {
    if min_pdf >= blur_glossy {
        return 0.0;
    }
    let blur = min_pdf / blur_glossy;
    sqrt(max(1.0 - blur, 0.0)) * 0.5
}

/// Clamps a contribution by the mean of its channels, as Cycles does: `bounce` 0 is direct
/// light. What is not finite becomes nothing.
#[inline]
pub fn path_clamped(light: Vec3, bounce: u32, settings: PathSettings) -> Vec3 {
    if !is_finite3(light) {
        return splat3(0.0);
    }
    let limit = select(settings.clamp_indirect, settings.clamp_direct, bounce == 0);
    let size = abs3(light);
    let sum = size.x + size.y + size.z;
    if limit > 0.0 && sum > 3.0 * limit {
        light * (3.0 * limit / sum)
    } else {
        light
    }
}

/// Weight of a technique with density `a` against one with density `b` (power heuristic,
/// Veach 1997, section 9.2.4); 1 where `a` stands for a certainty (the largest number).
#[inline]
pub fn path_power_heuristic(a: f32, b: f32) -> f32 {
    if a >= MAX || !is_finite(a) {
        return 1.0;
    }
    // Squares of large densities overflow; the ratio is limited.
    let ratio = min(b / a, 1.0e18);
    1.0 / (1.0 + ratio * ratio)
}

/// Weight of light that a path's ray meets, which next-event estimation finds with density
/// `pdf` too: all of it where nothing was sampled at the ray's origin.
#[inline]
pub fn path_weight_against(flags: u32, scatter_pdf: f32, pdf: f32) -> f32 {
    if (flags & (PATH_CAMERA | PATH_SINGULAR)) != 0 {
        1.0
    } else {
        path_power_heuristic(scatter_pdf, pdf)
    }
}

/// Bounces as the clamps count them for light that the ray meets: seen directly or after
/// one bounce is direct.
#[inline(always)]
pub fn path_light_bounce(bounce: u32) -> u32 {
    if bounce == 0 { 0 } else { bounce - 1 }
}

/// Adds light that the path's ray meets, with the density with which next-event estimation
/// would have found it.
#[inline]
pub fn path_add_met(path: &mut Path, radiance: Vec3, pdf: f32, settings: PathSettings) {
    let weight = path_weight_against(path.flags, path.scatter_pdf, pdf);
    let light = path.throughput * radiance * weight;
    path.radiance += path_clamped(light, path_light_bounce(path.bounce), settings);
}

/// Takes the part of the path's weight out of the pixel's coverage.
#[inline]
pub fn path_uncover(path: &mut Path, part: f32) {
    let t = path.throughput;
    path.alpha -= (t.x + t.y + t.z) / 3.0 * part;
}
