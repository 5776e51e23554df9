//! `KHR_lights_punctual`, in Blender's units.
//!
//! The extension is photometric, Blender is radiometric. One watt of green light at the
//! peak of the eye's sensitivity is 683 lumens (the definition of the candela since
//! 1979), and this is the factor that Blender's own glTF exporter uses for all light.
//! * Point: Blender's power Φ leaves a sphere evenly, so its intensity is Φ / 4π W/sr.
//!   With I candela: Φ = 4π I / 683.
//! * Spot: both sides agree that the cone does not concentrate the light: as a point.
//! * Sun: Blender's strength is the irradiance of a surface that faces it; E lux are E / 683 W/m².

use super::hierarchy::{Placed, to_z_up_aimed};
use crate::error::{Checked, Fault};
use crate::file::Document;
use crate::report::{Report, ReportKind};
use glam::Vec3;
use gltf::json::extensions::scene::khr_lights_punctual::{Light as GltfLight, Type};
use gltf::json::validation::Checked as Valid;
use matcha_render::scene::{Light, LightShape, Scene, Shader};
use std::f32::consts::{FRAC_PI_2, PI};

const LUMENS_PER_WATT: f32 = 683.0;

/// Adds the light of a node, if it has one.
pub(crate) fn push(
    document: &Document<'_>,
    placed: &Placed,
    scene: &mut Scene,
    report: &mut Report,
) -> Checked<()> {
    let node = &document.root.nodes[placed.node];
    let Some(reference) = node
        .extensions
        .as_ref()
        .and_then(|e| e.khr_lights_punctual.as_ref())
    else {
        return Ok(());
    };
    let all: &[GltfLight] = document.root.as_ref();
    let index = reference.light.value();
    let place = format!("extensions.KHR_lights_punctual.lights[{index}]");
    let light = all
        .get(index)
        .ok_or_else(|| Fault::new(place.clone(), "does not exist"))?;
    let (shape, factor) = shape(light, &place)?;
    let power = Vec3::from_array(light.color) * light.intensity * factor;
    if !power.is_finite() || power.min_element() < 0.0 {
        return Err(Fault::new(
            place,
            "its colour or intensity is negative or not finite",
        ));
    }
    if light.range.is_some() {
        let what = ReportKind::Feature("the range of lights is not supported".into());
        report.add(
            what,
            &placed.name,
            "the light falls off with the square of the distance",
        );
    }
    scene.lights.push(Light {
        name: light.name.clone().unwrap_or_else(|| placed.name.clone()),
        transform: to_z_up_aimed(placed.world),
        shape,
        power,
        ..Light::default()
    });
    Ok(())
}

/// The shape, and watts (or W/m²) per unit of intensity.
fn shape(light: &GltfLight, place: &str) -> Checked<(LightShape, f32)> {
    let point = 4.0 * PI / LUMENS_PER_WATT;
    match (light.type_, &light.spot) {
        (Valid::Valid(Type::Directional), _) => {
            Ok((LightShape::Sun { angle: 0.0 }, 1.0 / LUMENS_PER_WATT))
        }
        (Valid::Valid(Type::Point), _) => Ok((
            LightShape::Point {
                radius: 0.0,
                soft_falloff: false,
            },
            point,
        )),
        (Valid::Valid(Type::Spot), Some(spot)) => {
            let (inner, outer) = (spot.inner_cone_angle, spot.outer_cone_angle);
            if !(inner >= 0.0 && inner < outer && outer <= FRAC_PI_2) {
                return Err(Fault::new(
                    place,
                    format!("its cone angles {inner} and {outer} are not possible"),
                ));
            }
            // Blender's blend is the share of the cone's height (1 - cos) in which light fades.
            let blend = (inner.cos() - outer.cos()) / (1.0 - outer.cos()).max(1e-6);
            let shape = LightShape::Spot {
                radius: 0.0,
                angle: 2.0 * outer,
                blend,
                soft_falloff: false,
            };
            Ok((shape, point))
        }
        _ => Err(Fault::new(
            place,
            "has a type that KHR_lights_punctual does not know",
        )),
    }
}

/// A scene in which nothing shines is lit by a mild constant world.
pub(crate) fn ensure_some(scene: &mut Scene, report: &mut Report) {
    let emits = |shader: &Shader| match shader {
        Shader::Gltf(material) => material.emission != Vec3::ZERO,
        Shader::Cycles(_) => true,
    };
    if scene.lights.is_empty()
        && !scene
            .materials
            .iter()
            .any(|material| emits(&material.shader))
    {
        scene.world.color = Vec3::splat(0.5);
        report.add(
            ReportKind::Note("no light in the file".into()),
            "",
            "lit by a constant world of radiance 0.5",
        );
    }
}
