//! Render settings and the world.

use super::schema;
use crate::error::{Checked, Fault};
use glam::Vec3;
use matcha_render::scene::{PixelFilter, Scene, Settings, ViewSettings, World};

/// Larger pictures than this a side are taken for a mistake (pixels).
const LARGEST_SIDE: u32 = 65_536;

pub(super) fn apply(
    settings: Option<&schema::Settings>,
    world: Option<&schema::World>,
    scene: &mut Scene,
) -> Checked<()> {
    if let Some(settings) = settings {
        scene.settings = convert(settings)?;
    }
    if let Some(world) = world {
        let color = Vec3::from_array(world.color);
        if !color.is_finite() {
            return Err(Fault::new(
                format!("world \"{}\"", world.name),
                "its colour is not finite",
            ));
        }
        scene.world = World {
            tree: world.tree,
            color,
            visibility: world.visibility.into(),
            importance_sample: world.importance_sample,
            map_resolution: world.map_resolution.min(LARGEST_SIDE),
        };
    }
    Ok(())
}

fn convert(s: &schema::Settings) -> Checked<Settings> {
    let place = "MATCHA_cycles settings";
    let [width, height] = s.resolution;
    if !(1..=LARGEST_SIDE).contains(&width) || !(1..=LARGEST_SIDE).contains(&height) {
        return Err(Fault::new(
            place,
            format!("a picture of {width} x {height} pixels is not possible"),
        ));
    }
    if !(s.pixel_aspect > 0.0 && s.pixel_aspect.is_finite()) {
        return Err(Fault::new(
            place,
            format!("the pixel aspect {} is not possible", s.pixel_aspect),
        ));
    }
    let numbers = [
        s.clamp_direct,
        s.clamp_indirect,
        s.blur_glossy,
        s.light_threshold,
        s.exposure,
        s.filter.width,
    ];
    if !numbers
        .into_iter()
        .chain([s.view.exposure, s.view.gamma])
        .all(f32::is_finite)
    {
        return Err(Fault::new(place, "a number is not finite"));
    }
    Ok(Settings {
        resolution: s.resolution,
        pixel_aspect: s.pixel_aspect,
        samples: s.samples,
        max_bounces: s.max_bounces,
        diffuse_bounces: s.diffuse_bounces,
        glossy_bounces: s.glossy_bounces,
        transmission_bounces: s.transmission_bounces,
        transparent_bounces: s.transparent_bounces,
        min_bounces: s.min_bounces,
        clamp_direct: s.clamp_direct,
        clamp_indirect: s.clamp_indirect,
        blur_glossy: s.blur_glossy,
        reflective_caustics: s.reflective_caustics,
        refractive_caustics: s.refractive_caustics,
        light_threshold: s.light_threshold,
        filter: filter(&s.filter)?,
        exposure: s.exposure,
        transparent_film: s.transparent_film,
        view: ViewSettings {
            transform: s.view.transform.clone(),
            look: s.view.look.clone(),
            exposure: s.view.exposure,
            gamma: s.view.gamma,
        },
        // A seed is 32 bits without a sign, in Blender with one.
        seed: s.seed as u32,
    })
}

fn filter(filter: &schema::Filter) -> Checked<PixelFilter> {
    match filter.kind.as_str() {
        "BOX" => Ok(PixelFilter::Box),
        "GAUSSIAN" => Ok(PixelFilter::Gaussian(filter.width)),
        "BLACKMAN_HARRIS" => Ok(PixelFilter::BlackmanHarris(filter.width)),
        other => Err(Fault::new(
            "MATCHA_cycles settings",
            format!("the pixel filter {other} is not known"),
        )),
    }
}
