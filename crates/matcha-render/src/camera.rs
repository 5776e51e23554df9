//! The camera of a scene, prepared for one picture size.

use crate::device::camera::{
    CAMERA_ORTHOGRAPHIC, CAMERA_PANORAMA, CAMERA_PERSPECTIVE, CameraRay, RasterCamera, camera_ray,
};
use crate::device::mapping::MappingFrame;
use crate::scene::{Camera, Projection, SensorFit};
use glam::{Vec2, Vec3, vec2};

/// Prepares a camera for a picture of `resolution` pixels whose aspect (width over height of
/// one pixel) is `pixel_aspect`. Follows Blender: the field of view spans the side that the
/// sensor fit names (AUTO: the longer, in units of the pixel aspect), and the shift counts in
/// units of that side, in both directions.
pub fn prepare(camera: &Camera, resolution: [u32; 2], pixel_aspect: f32) -> RasterCamera {
    let size = Vec2::new(resolution[0].max(1) as f32, resolution[1].max(1) as f32);
    let (kind, half) = match camera.projection {
        Projection::Perspective {
            tan_half_width,
            fit,
        } => (
            CAMERA_PERSPECTIVE,
            half_sides(size, pixel_aspect, fit, tan_half_width),
        ),
        Projection::Orthographic { scale, fit } => (
            CAMERA_ORTHOGRAPHIC,
            half_sides(size, pixel_aspect, fit, 0.5 * scale),
        ),
        Projection::Equirectangular => (
            CAMERA_PANORAMA,
            HalfSides {
                sides: Vec2::splat(0.5),
                fitted: 0.5,
            },
        ),
    };
    let middle = camera.shift * (2.0 * half.fitted)
        + if kind == CAMERA_PANORAMA {
            Vec2::splat(0.5)
        } else {
            Vec2::ZERO
        };
    let axis = |v: glam::Vec3A| Vec3::from(v).normalize_or_zero();
    let matrix = camera.transform.matrix3;
    let (blades, blades_rotation) = camera.blades;
    RasterCamera {
        kind,
        origin: camera.transform.translation.into(),
        axes: MappingFrame {
            x: axis(matrix.x_axis),
            y: axis(matrix.y_axis),
            z: -axis(matrix.z_axis),
        },
        corner: vec2(middle.x - half.sides.x, middle.y + half.sides.y),
        step: vec2(2.0, -2.0) * half.sides / size,
        clip: Vec2::from(camera.clip),
        lens_radius: camera.aperture_radius.max(0.0),
        lens_squeeze: 1.0 / camera.aperture_ratio.max(1e-3),
        blades: blades as f32,
        blades_rotation,
        // Cycles' smallest focal distance.
        focus: camera.focus_distance.max(1e-5),
    }
}

/// Ray of a pixel (column, row from the top). `filter_offset` is in pixels from the pixel's
/// centre, `lens` in [0, 1)².
pub fn pixel_ray(
    camera: &RasterCamera,
    pixel: [u32; 2],
    filter_offset: Vec2,
    lens: Vec2,
) -> CameraRay {
    let centre = vec2(pixel[0] as f32 + 0.5, pixel[1] as f32 + 0.5);
    camera_ray(*camera, centre + filter_offset, lens)
}

struct HalfSides {
    sides: Vec2,
    fitted: f32,
}

fn half_sides(size: Vec2, pixel_aspect: f32, fit: SensorFit, fitted: f32) -> HalfSides {
    let ratio = vec2(size.x * pixel_aspect, size.y);
    let horizontal = match fit {
        SensorFit::Auto => ratio.x > ratio.y,
        SensorFit::Horizontal => true,
        SensorFit::Vertical => false,
    };
    let sides = if horizontal {
        vec2(fitted, fitted * ratio.y / ratio.x)
    } else {
        vec2(fitted * ratio.x / ratio.y, fitted)
    };
    HalfSides { sides, fitted }
}

#[cfg(test)]
#[allow(clippy::excessive_precision)] // Numbers as Blender printed them.
mod blender_projection;
#[cfg(test)]
mod tests;
