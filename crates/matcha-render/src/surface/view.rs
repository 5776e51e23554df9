//! The camera as node networks see it.

use crate::device::camera::RasterCamera;
use crate::device::surface_view::CameraView;
use glam::Vec2;

impl CameraView {
    /// `resolution` in pixels, that for which the camera was prepared.
    pub fn new(camera: RasterCamera, resolution: [u32; 2]) -> Self {
        let resolution = Vec2::new(resolution[0].max(1) as f32, resolution[1].max(1) as f32);
        Self { camera, resolution }
    }
}
