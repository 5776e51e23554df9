//! Blender's thin-lens camera.

use super::schema;
use crate::error::{Checked, Fault};
use crate::plain::hierarchy::{Placed, to_z_up_aimed};
use crate::report::{Report, ReportKind};
use glam::{Affine3A, Vec2};
use matcha_render::scene::{Camera, Projection, Scene, SensorFit};

/// Metres in a millimetre.
const MILLIMETRE: f32 = 1e-3;

/// A camera keeps nothing of its scale but that it is mirrored.
fn aimed(placed: &Placed) -> Affine3A {
    let mut aimed = to_z_up_aimed(placed.world);
    if placed.world.determinant() < 0.0 {
        aimed.matrix3.x_axis = -aimed.matrix3.x_axis;
    }
    aimed
}

pub(super) fn set(
    source: &schema::Camera,
    placed: &Placed,
    scene: &mut Scene,
    report: &mut Report,
) -> Checked<()> {
    let place = format!("camera \"{}\"", placed.name);
    let numbers = [
        source.lens,
        source.sensor_width,
        source.sensor_height,
        source.ortho_scale,
    ];
    let bad = |x: &f32| !(x.is_finite() && *x > 0.0);
    let [near, far] = source.clip;
    if numbers.iter().any(bad)
        || !source.shift.iter().all(|x| x.is_finite())
        || !(near < far && near >= 0.0)
    {
        return Err(Fault::new(
            place,
            "its lens, sensor, scale, shift or clipping is not possible",
        ));
    }
    let mut camera = Camera {
        transform: aimed(placed),
        projection: projection(source, &place, report),
        shift: Vec2::from_array(source.shift),
        clip: source.clip,
        ..Camera::default()
    };
    if let Some(dof) = source.dof.as_ref().filter(|dof| dof.enabled) {
        lens(source, dof, &place, &mut camera)?;
    }
    scene.camera = camera;
    Ok(())
}

fn projection(source: &schema::Camera, place: &str, report: &mut Report) -> Projection {
    let fit = match source.sensor_fit.as_str() {
        "HORIZONTAL" => SensorFit::Horizontal,
        "VERTICAL" => SensorFit::Vertical,
        _ => SensorFit::Auto,
    };
    match source.kind.as_str() {
        "ORTHO" => Projection::Orthographic {
            scale: source.ortho_scale,
            fit,
        },
        "PANO" => {
            if source.panorama != "EQUIRECTANGULAR" {
                let what = ReportKind::Feature(format!(
                    "panoramas of type {} are not supported",
                    source.panorama
                ));
                report.add(what, place, "rendered as a full equirectangular one");
            }
            Projection::Equirectangular
        }
        _ => {
            let sensor = if fit == SensorFit::Vertical {
                source.sensor_height
            } else {
                source.sensor_width
            };
            Projection::Perspective {
                tan_half_width: sensor / (2.0 * source.lens),
                fit,
            }
        }
    }
}

/// The f-number is focal length over the lens's diameter. An orthographic camera has no
/// focal length; Cycles takes one metre.
fn lens(
    source: &schema::Camera,
    dof: &schema::DepthOfField,
    place: &str,
    camera: &mut Camera,
) -> Checked<()> {
    let focal_length = if source.kind == "ORTHO" {
        1.0
    } else {
        source.lens * MILLIMETRE
    };
    let numbers = [dof.fstop, dof.focus_distance, dof.rotation, dof.ratio];
    if !numbers.iter().all(|x| x.is_finite()) || dof.fstop <= 0.0 || dof.ratio <= 0.0 {
        return Err(Fault::new(place, "its depth of field is not possible"));
    }
    camera.aperture_radius = focal_length / (2.0 * dof.fstop);
    // A focus at the lens itself would divide by zero.
    camera.focus_distance = dof.focus_distance.max(1e-5);
    camera.blades = (dof.blades, dof.rotation);
    camera.aperture_ratio = dof.ratio;
    Ok(())
}
