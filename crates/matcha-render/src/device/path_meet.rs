//! Light that a path's ray meets: analytic lights on its way, suns, the world.

use glam::Vec3;
use matcha_shade::device::math::{bits_of, float_of, splat3};

use super::light_analytic::LIGHT_FAR;
use super::light_pdf::{LightMet, light_met, light_pdf_world, light_sun_met};
use super::light_sample::{LIGHT_EMITS_CONSTANT, LIGHT_EMITS_NOTHING};
use super::light_view::{LIGHT_NONE, LightView};
use super::light_visible::light_nearest;
use super::path_flags::{PATH_CAMERA, PATH_SHADOW};
use super::path_state::{Path, PathSettings, path_add_met, path_uncover};
use super::path_step::path_ray_mask;
use super::surface_cone::DIFFUSE_SPREAD;
use super::surface_path::PathInfo;

/// A light whose node tree the caller must evaluate before the path goes on.
#[derive(Clone, Copy, Debug)]
pub struct PathMeeting {
    /// Index into `LightView::lights`, or `LIGHT_NONE` where nothing is left to evaluate.
    pub light: u32,
    /// Radiance that the tree's emission multiplies.
    pub factor: Vec3,
    /// Density with which next-event estimation would have found the direction.
    pub pdf: f32,
    /// Distance to the light, metres.
    pub distance: f32,
    /// Where to go on: a distance, or the number of a sun.
    pub next: f32,
}

/// Nothing to evaluate.
#[inline(always)]
pub fn path_meets_nothing() -> PathMeeting {
    PathMeeting {
        light: LIGHT_NONE,
        factor: splat3(0.0),
        pdf: 0.0,
        distance: 0.0,
        next: 0.0,
    }
}

/// Adds a light that is met, if what it radiates is known; true if the caller must evaluate
/// it.
#[inline]
pub fn path_meet_one(path: &mut Path, met: LightMet, settings: PathSettings) -> bool {
    let counts = met.emission.kind != LIGHT_EMITS_NOTHING && path.bounce <= met.max_bounces;
    if counts && met.emission.kind == LIGHT_EMITS_CONSTANT {
        path_add_met(path, met.emission.radiance, met.pdf, settings);
    }
    counts && met.emission.kind != LIGHT_EMITS_CONSTANT
}

/// Adds the analytic lights that a path's ray meets between two distances; rays go through
/// them. Stops at a light with a node tree.
pub fn path_meet_lights(
    lights: LightView,
    path: &mut Path,
    from: f32,
    reach: f32,
    settings: PathSettings,
) -> PathMeeting {
    let kind = path_ray_mask(path.flags);
    let mut meeting = path_meets_nothing();
    let mut at = from;
    let mut more = lights.boxes.len() as u32 > 0;
    while more {
        let nearest = light_nearest(lights, path.origin, path.direction, at, reach, kind);
        more = nearest.index != LIGHT_NONE;
        if more {
            // The next number after a positive one.
            at = float_of(bits_of(nearest.distance) + 1);
            let met = light_met(
                lights,
                nearest.index,
                path.mis_origin,
                path.mis_normal,
                path.direction,
                nearest.distance,
            );
            if path_meet_one(path, met, settings) {
                meeting.light = met.index;
                meeting.factor = met.emission.radiance;
                meeting.pdf = met.pdf;
                meeting.distance = nearest.distance;
                meeting.next = at;
                more = false;
            }
        }
    }
    meeting
}

/// Adds the suns, from number `first` on, that a path sees which left the scene. Stops at one
/// with a node tree.
pub fn path_meet_suns(
    lights: LightView,
    path: &mut Path,
    first: u32,
    settings: PathSettings,
) -> PathMeeting {
    let kind = path_ray_mask(path.flags);
    let mut meeting = path_meets_nothing();
    let suns = lights.suns.len() as u32;
    let mut k = first;
    while k < suns {
        let p = path.mis_origin;
        let n = path.mis_normal;
        let met = light_sun_met(lights, k, p, n, path.direction, kind);
        k += 1;
        if path_meet_one(path, met, settings) {
            meeting.light = met.index;
            meeting.factor = met.emission.radiance;
            meeting.pdf = met.pdf;
            meeting.distance = LIGHT_FAR;
            meeting.next = k as f32;
            break;
        }
    }
    meeting
}

/// Where the film is transparent, takes a path that left the scene straight from the camera
/// out of the coverage; true if it did.
#[inline]
pub fn path_leaves_film(path: &mut Path, settings: PathSettings) -> bool {
    let leaves = settings.transparent_film != 0 && (path.flags & PATH_CAMERA) != 0;
    if leaves {
        path_uncover(path, 1.0);
    }
    leaves
}

/// Adds the world's radiance to a path that left the scene, where `visibility` (`RAY_` bits)
/// lets its ray see it.
#[inline]
pub fn path_meet_world(
    lights: LightView,
    path: &mut Path,
    radiance: Vec3,
    visibility: u32,
    settings: PathSettings,
) {
    if (visibility & path_ray_mask(path.flags)) != 0 {
        let pdf = light_pdf_world(lights, path.mis_origin, path.mis_normal, path.direction);
        path_add_met(path, radiance, pdf, settings);
    }
}

/// What networks may know of a path whose last segment has a length, metres.
#[inline(always)]
pub fn path_info(path: &Path, ray_length: f32) -> PathInfo {
    PathInfo {
        direction: path.direction,
        flags: path.flags,
        cone_width: path.cone_width,
        cone_spread: path.cone_spread,
        ray_length,
        bounce: path.bounce,
        diffuse: path.diffuse,
        glossy: path.glossy,
        transmission: path.transmission,
        transparent: path.transparent,
    }
}

/// What networks may know of a shadow ray. Its cone is as wide as after a diffuse bounce:
/// what light carries is blurred anyway.
#[inline(always)]
pub fn path_shadow_info(direction: Vec3, ray_length: f32) -> PathInfo {
    PathInfo {
        direction,
        flags: PATH_SHADOW,
        cone_width: 0.0,
        cone_spread: DIFFUSE_SPREAD,
        ray_length,
        bounce: 0,
        diffuse: 0,
        glossy: 0,
        transmission: 0,
        transparent: 0,
    }
}
