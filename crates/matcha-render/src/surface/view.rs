//! The camera as node networks see it: camera and window coordinates.

use crate::device::camera::{CAMERA_ORTHOGRAPHIC, CAMERA_PANORAMA, RasterCamera};
use glam::{Vec2, Vec3};
use std::f32::consts::{PI, TAU};

/// A prepared camera and the size of its picture.
#[derive(Clone, Copy, Debug)]
pub struct View {
    camera: RasterCamera,
    resolution: Vec2,
}

impl View {
    /// `resolution` in pixels, that for which the camera was prepared.
    pub fn new(camera: RasterCamera, resolution: [u32; 2]) -> Self {
        let resolution = Vec2::new(resolution[0].max(1) as f32, resolution[1].max(1) as f32);
        Self { camera, resolution }
    }

    /// Position in camera space, metres: x to the right, y up, z forward (Cycles, Texture
    /// Coordinate node).
    #[inline]
    pub fn camera_coordinates(&self, position: Vec3) -> Vec3 {
        self.rotate(position - self.camera.origin)
    }

    /// A direction in camera space.
    pub fn camera_coordinates_of(&self, direction: Vec3) -> Vec3 {
        self.rotate(direction)
    }

    fn rotate(&self, direction: Vec3) -> Vec3 {
        let axes = &self.camera.axes;
        Vec3::new(
            axes.x.dot(direction),
            axes.y.dot(direction),
            axes.z.dot(direction),
        )
    }

    /// Position in the picture, 0 to 1 from its lower left corner; z is 0.
    pub fn window_coordinates(&self, position: Vec3) -> Vec3 {
        self.window(self.camera_coordinates(position))
    }

    /// The same for a point at infinity.
    pub fn window_coordinates_of(&self, direction: Vec3) -> Vec3 {
        self.window(self.rotate(direction))
    }

    fn window(&self, p: Vec3) -> Vec3 {
        let plane = match self.camera.kind {
            CAMERA_ORTHOGRAPHIC => p.truncate(),
            CAMERA_PANORAMA => {
                let latitude = (p.y / p.length().max(f32::MIN_POSITIVE))
                    .clamp(-1.0, 1.0)
                    .asin();
                Vec2::new(p.x.atan2(p.z) / TAU + 0.5, latitude / PI + 0.5)
            }
            _ if p.z != 0.0 => p.truncate() / p.z,
            _ => Vec2::ZERO,
        };
        let raster = (plane - self.camera.corner) / self.camera.step / self.resolution;
        Vec3::new(raster.x, 1.0 - raster.y, 0.0)
    }
}
