//! Blender's lights.

use super::schema;
use crate::error::{Checked, Fault};
use crate::plain::hierarchy::{Placed, to_z_up_aimed, to_z_up_aimed_scaled};
use crate::report::{Report, ReportKind};
use glam::{Affine3A, Vec2, Vec3};
use matcha_render::scene::{Light, LightShape, Scene};

/// Cosines between axes up to which a light counts as undistorted: matrices come in single
/// precision.
const DISTORTION: f64 = 1e-3;

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
    report_distortion(&source, placed, &place, report);
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
        transform: transform(&source, placed),
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

/// A spot's cone stretches with its object, as in Cycles.
fn transform(source: &schema::Light, placed: &Placed) -> Affine3A {
    if source.kind == "SPOT" {
        let stretched = to_z_up_aimed_scaled(placed.world);
        if stretched.matrix3.determinant() != 0.0 {
            return stretched;
        }
    }
    to_z_up_aimed(placed.world)
}

/// Cycles lets an area light's sides be slanted.
fn report_distortion(source: &schema::Light, placed: &Placed, place: &str, report: &mut Report) {
    let axes = [0, 1, 2].map(|column| placed.world.col(column).truncate());
    let slant = |a: usize, b: usize| axes[a].normalize_or_zero().dot(axes[b].normalize_or_zero());
    let sheared = [slant(0, 1), slant(1, 2), slant(2, 0)]
        .iter()
        .any(|cosine| cosine.abs() > DISTORTION);
    if source.kind == "AREA" && sheared {
        let what = ReportKind::Feature("sheared area lights are not supported".into());
        let instead = "its sides are perpendicular to its direction and each other";
        report.add(what, place, instead);
    }
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
