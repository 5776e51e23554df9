//! Cameras of glTF, and one for files that have none.

use super::hierarchy::{Placed, to_z_up_aimed};
use crate::error::{Checked, Fault};
use crate::file::Document;
use crate::report::{Report, ReportKind};
use glam::{Affine3A, Mat3, Vec3};
use gltf::json::camera::Camera as GltfCamera;
use matcha_render::scene::{Camera, Projection, Scene, SensorFit};

/// Takes the first camera of the scene, or makes one.
pub(crate) fn choose(
    document: &Document<'_>,
    placed: &[Placed],
    scene: &mut Scene,
    report: &mut Report,
) -> Checked<()> {
    let nodes = &document.root.nodes;
    let mut found = placed
        .iter()
        .filter_map(|p| nodes[p.node].camera.map(|camera| (p, camera.value())));
    let Some((place, index)) = found.next() else {
        frame(scene);
        report.add(
            ReportKind::Note("no camera in the file".into()),
            "",
            "one that sees all of the scene was made",
        );
        return Ok(());
    };
    if found.next().is_some() {
        report.add(
            ReportKind::Note("several cameras".into()),
            &place.name,
            "the first one is used",
        );
    }
    let source = &document.root.cameras[index];
    scene.camera = convert(source, &format!("cameras[{index}]"))?;
    scene.camera.transform = to_z_up_aimed(place.world);
    if let Some(aspect) = source.perspective.as_ref().and_then(|p| p.aspect_ratio) {
        let [_, height] = scene.settings.resolution;
        scene.settings.resolution[0] = (height as f32 * aspect.clamp(0.05, 20.0)).round() as u32;
    }
    Ok(())
}

fn convert(source: &GltfCamera, place: &str) -> Checked<Camera> {
    let (projection, near, far) = if let Some(p) = &source.perspective {
        if !(p.yfov > 0.0 && p.yfov < std::f32::consts::PI) {
            return Err(Fault::new(
                place,
                format!("its field of view of {} radians is not possible", p.yfov),
            ));
        }
        let tan_half_width = (0.5 * p.yfov).tan();
        (
            Projection::Perspective {
                tan_half_width,
                fit: SensorFit::Vertical,
            },
            p.znear,
            p.zfar,
        )
    } else if let Some(o) = &source.orthographic {
        // `ymag` is half of the height.
        let scale = 2.0 * o.ymag.abs();
        if !(scale > 0.0 && scale.is_finite()) {
            return Err(Fault::new(
                place,
                format!("its height of {scale} m is not possible"),
            ));
        }
        (
            Projection::Orthographic {
                scale,
                fit: SensorFit::Vertical,
            },
            o.znear,
            Some(o.zfar),
        )
    } else {
        return Err(Fault::new(place, "is neither perspective nor orthographic"));
    };
    let mut camera = Camera {
        projection,
        ..Camera::default()
    };
    camera.clip[0] = if near.is_finite() {
        near.max(0.0)
    } else {
        camera.clip[0]
    };
    camera.clip[1] = far.filter(|far| *far > camera.clip[0]).unwrap_or(f32::MAX);
    Ok(camera)
}

/// A camera that looks at the whole scene from the front, the right and above.
fn frame(scene: &mut Scene) {
    let mut bounds: Option<(Vec3, Vec3)> = None;
    for instance in &scene.instances {
        for &p in &scene.meshes[instance.mesh as usize].positions {
            let p = instance.transform.transform_point3(p);
            let (low, high) = bounds.unwrap_or((p, p));
            bounds = Some((low.min(p), high.max(p)));
        }
    }
    let (low, high) = bounds.unwrap_or((-Vec3::ONE, Vec3::ONE));
    let (centre, radius) = (0.5 * (low + high), (0.5 * (high - low).length()).max(1e-3));
    let Projection::Perspective { tan_half_width, .. } = scene.camera.projection else {
        return;
    };
    let [width, height] = scene.settings.resolution.map(|side| side as f32);
    let half_angle = (tan_half_width * height.min(width) / height.max(width)).atan();
    let z = Vec3::new(0.5, -1.0, 0.5).normalize();
    let distance = 1.02 * radius / half_angle.sin();
    let x = Vec3::Z.cross(z).normalize();
    scene.camera.transform =
        Affine3A::from_mat3_translation(Mat3::from_cols(x, z.cross(x), z), centre + distance * z);
    scene.camera.focus_distance = distance;
    scene.camera.clip = [1e-3 * radius, 10.0 * distance];
}
