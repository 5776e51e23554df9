//! Blender's lights.

use super::schema;
use crate::error::{Checked, Fault};
use crate::plain::hierarchy::{Placed, to_z_up_aimed};
use crate::report::{Report, ReportKind};
use glam::{Vec2, Vec3};
use matcha_render::scene::{Light, LightShape, Scene};

pub(super) fn add(
    source: schema::Light,
    placed: &Placed,
    scene: &mut Scene,
    report: &mut Report,
) -> Checked<()> {
    let place = format!("light \"{}\"", source.name);
    if source.portal {
        let what = ReportKind::Feature("light portals are not supported".into());
        report.add(what, &place, "left out; the world is sampled as a whole");
        return Ok(());
    }
    let power = Vec3::from_array(source.color) * source.energy * source.exposure.exp2();
    let lengths = [
        source.radius,
        source.size[0],
        source.size[1],
        source.angle,
        source.spread,
        source.blend,
    ];
    if !power.is_finite() || !lengths.iter().all(|x| x.is_finite() && *x >= 0.0) {
        return Err(Fault::new(
            place,
            "its power or one of its sizes is negative or not finite",
        ));
    }
    scene.lights.push(Light {
        shape: shape(&source, placed).ok_or_else(|| {
            Fault::new(
                place,
                format!(
                    "its type {} or shape {} is not known",
                    source.kind, source.shape
                ),
            )
        })?,
        transform: to_z_up_aimed(placed.world),
        power,
        tree: source.tree,
        cast_shadow: source.cast_shadow,
        use_mis: source.use_mis,
        visibility: source.visibility.into(),
        max_bounces: source.max_bounces,
        normalize: source.normalize,
        random: source.random,
        name: source.name,
    });
    Ok(())
}

/// Only area lights grow with their object, as in Cycles.
fn shape(source: &schema::Light, placed: &Placed) -> Option<LightShape> {
    let &schema::Light {
        radius,
        soft_falloff,
        angle,
        blend,
        spread,
        size: [x, y],
        ..
    } = source;
    Some(match source.kind.as_str() {
        "POINT" => LightShape::Point {
            radius,
            soft_falloff,
        },
        "SPOT" => LightShape::Spot {
            radius,
            angle,
            blend,
            soft_falloff,
        },
        "SUN" => LightShape::Sun { angle },
        "AREA" => {
            let scale = |column: usize| placed.world.col(column).truncate().length() as f32;
            let size = Vec2::new(x * scale(0), y * scale(1));
            let ellipse = match source.shape.as_str() {
                "SQUARE" | "RECTANGLE" => false,
                "DISK" | "ELLIPSE" => true,
                _ => return None,
            };
            LightShape::Area {
                size,
                ellipse,
                spread,
            }
        }
        _ => return None,
    })
}
