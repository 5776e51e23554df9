//! A path in flight: device code's state, and what only the host asks of it.

pub use crate::device::path_state::{Path, PathSettings, path_clamped};
use crate::scene::Settings;

/// Kind of the ray that a path currently follows, and what happened to the path before; the
/// bits are those of the device code.
pub mod flags {
    pub use crate::device::path_flags::{
        PATH_CAMERA as CAMERA, PATH_DIFFUSE as DIFFUSE, PATH_DIFFUSE_ANCESTOR as DIFFUSE_ANCESTOR,
        PATH_FEATURES_DONE as FEATURES_DONE, PATH_GLOSSY as GLOSSY, PATH_REFLECT as REFLECT,
        PATH_SHADOW as SHADOW, PATH_SINGULAR as SINGULAR, PATH_TERMINATE as TERMINATE,
        PATH_TRANSMIT as TRANSMIT,
    };
}

/// What the rules of a path ask of a scene's settings.
pub fn path_settings(settings: &Settings) -> PathSettings {
    PathSettings {
        max_bounces: settings.max_bounces,
        diffuse_bounces: settings.diffuse_bounces,
        glossy_bounces: settings.glossy_bounces,
        transmission_bounces: settings.transmission_bounces,
        transparent_bounces: settings.transparent_bounces,
        // The light of the first bounce is always worth its ray, as in Cycles.
        roulette_bounce: settings.min_bounces.saturating_add(2),
        clamp_direct: settings.clamp_direct,
        clamp_indirect: settings.clamp_indirect,
        blur_glossy: settings.blur_glossy,
        reflective_caustics: settings.reflective_caustics.into(),
        refractive_caustics: settings.refractive_caustics.into(),
        light_threshold: settings.light_threshold,
        transparent_film: settings.transparent_film.into(),
    }
}
