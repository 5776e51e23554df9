//! From one surface to the next: coverage, features, scattering, transparency, roulette.

use glam::Vec3;
use matcha_shade::device::math::{MAX, abs3, is_finite3, min};

use super::path_flags::{
    PATH_CAMERA, PATH_DIFFUSE, PATH_ENDS, PATH_FEATURES_DONE, PATH_SURVIVED, PATH_TRANSMIT,
};
use super::path_ray::ray_offset_origin;
use super::path_start::{DRAW_LIGHT_KEEP, DRAW_PER_SURFACE, DRAW_ROULETTE};
use super::path_state::{
    Path, PathSettings, ScatterKind, path_count_bounce, path_count_transparent, path_max_element,
    path_survival, path_uncover,
};
use super::ray_kind::{RAY_CAMERA, RAY_DIFFUSE, RAY_GLOSSY, RAY_TRANSMISSION};
use super::sobol::sobol_1d;

/// A direction in which a path goes on, and where from.
#[derive(Clone, Copy, Debug)]
pub struct PathTurn {
    /// The surface point, world space.
    pub position: Vec3,
    /// Its geometric normal, unit.
    pub true_normal: Vec3,
    /// The normal that light selection relied on; zero where light may come from behind.
    pub selection_normal: Vec3,
    /// Width of the ray cone at the point, metres.
    pub cone_width: f32,
    /// Spread of the cone after the scattering.
    pub cone_spread: f32,
    /// Instance and triangle.
    pub leaves: [u32; 2],
    /// Unit direction to go on in.
    pub wi: Vec3,
    /// Density of the direction, sr⁻¹.
    pub pdf: f32,
    /// How it was scattered.
    pub kind: ScatterKind,
}

/// The `RAY_` bit of the ray that a path follows.
#[inline]
pub fn path_ray_mask(flags: u32) -> u32 {
    if (flags & PATH_CAMERA) != 0 {
        RAY_CAMERA
    } else if (flags & PATH_TRANSMIT) != 0 {
        RAY_TRANSMISSION
    } else if (flags & PATH_DIFFUSE) != 0 {
        RAY_DIFFUSE
    } else {
        RAY_GLOSSY
    }
}

/// Cuts a holdout closure or object out of the pixel's coverage; true where nothing is left
/// of the path. `cut` is the part that is held out.
#[inline]
pub fn path_hold_out(path: &mut Path, cut: f32) -> bool {
    if cut > 0.0 {
        path_uncover(path, min(cut, 1.0));
    }
    cut >= 1.0
}

/// Albedo, normal and depth of the first surface that is more than half opaque.
#[inline]
pub fn path_note_features(
    path: &mut Path,
    albedo: Vec3,
    normal: Vec3,
    transparency: Vec3,
    depth: f32,
) {
    let transparent = transparency.x + transparency.y + transparency.z > 1.5;
    if (path.flags & PATH_FEATURES_DONE) == 0 && !transparent {
        path.flags |= PATH_FEATURES_DONE;
        path.albedo = albedo;
        path.normal = normal;
        path.depth = depth;
    }
}

/// Cycles' light threshold: a contribution below it is kept with a probability in proportion
/// to it. The factor that makes up for the dropped ones; 0 where it is dropped.
#[inline]
pub fn path_keep_small(path: &Path, value: Vec3, threshold: f32) -> f32 {
    let size = path_max_element(abs3(value));
    if size >= threshold {
        return 1.0;
    }
    let keep = size / threshold;
    let draw = sobol_1d(path.seed, path.sample, path.dimension + DRAW_LIGHT_KEEP);
    if draw < keep { 1.0 / keep } else { 0.0 }
}

/// Whether Russian roulette lets a path with a probability of survival live on.
#[inline]
pub fn path_draws_life(path: &Path, survival: f32) -> bool {
    let mut lives = survival >= 1.0;
    if !lives {
        let draw = sobol_1d(path.seed, path.sample, path.dimension + DRAW_ROULETTE);
        lives = draw < survival;
    }
    lives
}

/// Makes up in a path's throughput for the paths that Russian roulette has ended.
#[inline]
pub fn path_survive(path: &mut Path, survival: f32) {
    path.throughput /= survival;
    path.flags |= PATH_SURVIVED;
}

/// Russian roulette at the surface that a path has reached; false where the path ends without
/// it. Where the surface may emit, a path that ends is marked, and ends when it has added that:
/// light that a path meets is never at stake.
#[inline]
pub fn path_reaches(path: &mut Path, emits: bool, settings: PathSettings) -> bool {
    let lives = path_draws_life(path, path_survival(path, settings));
    if !lives {
        path.flags |= PATH_ENDS;
    }
    lives || emits
}

/// Sends the path on in a sampled direction with a weight; false where it ends.
///
/// Russian roulette is played at once after diffuse scattering, which saves the ray: the light
/// that it could meet is found by next-event estimation. Other paths play at the next surface
/// ([`path_reaches`]), so that none is ended that would have met a light or the world.
#[inline]
pub fn path_scatter(path: &mut Path, weight: Vec3, turn: PathTurn, settings: PathSettings) -> bool {
    path.throughput *= weight;
    path_count_bounce(path, turn.kind, settings);
    path.mis_origin = turn.position;
    path.mis_normal = turn.selection_normal;
    path.scatter_pdf = turn.pdf;
    if !turn.kind.singular {
        path.min_pdf = min(path.min_pdf, turn.pdf);
    }
    path.origin = ray_offset_origin(turn.position, turn.true_normal, turn.wi);
    path.direction = turn.wi;
    path.t_min = 0.0;
    path.t_max = MAX;
    path.leaves = turn.leaves;
    path.cone_width = turn.cone_width;
    path.cone_spread = turn.cone_spread;
    path.dimension += DRAW_PER_SURFACE;
    if !is_finite3(path.throughput) || path_max_element(path.throughput) <= 0.0 {
        return false;
    }
    let mut lives = true;
    if turn.kind.diffuse {
        let survival = path_survival(path, settings);
        lives = path_draws_life(path, survival);
        path_survive(path, survival);
    }
    lives
}

/// Sends the path straight through the surface that it met at the distance `t`; false where
/// it ends.
#[inline]
pub fn path_pass_through(
    path: &mut Path,
    weight: Vec3,
    leaves: [u32; 2],
    t: f32,
    settings: PathSettings,
) -> bool {
    path.throughput *= weight;
    path.t_min = t;
    path.leaves = leaves;
    path.dimension += DRAW_PER_SURFACE;
    path_count_transparent(path, settings) && path_max_element(path.throughput) > 0.0
}
