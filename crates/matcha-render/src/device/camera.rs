//! Camera rays: pinhole, thin lens, parallel and panoramic, as Cycles defines them.
//!
//! Camera space has +X to the right, +Y up and +Z forward. Raster coordinates count
//! pixels from the TOP left corner of the picture.

use crate::device::mapping::{MappingFrame, mapping_disk, mapping_place};
use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3};
use matcha_shade::device::math::{
    PI, abs, cos, dot, floor, max, min, normalize, select, sin, sqrt, vec2, vec3,
};

/// Perspective projection through a thin lens.
pub const CAMERA_PERSPECTIVE: u32 = 0;
/// Parallel rays.
pub const CAMERA_ORTHOGRAPHIC: u32 = 1;
/// Full equirectangular panorama.
pub const CAMERA_PANORAMA: u32 = 2;

/// A camera, ready for one picture size.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct RasterCamera {
    /// One of the `CAMERA_` constants.
    pub kind: u32,
    /// Position, metres, world space.
    pub origin: Vec3,
    /// Unit axes of camera space in the world: right, up, forward.
    pub axes: MappingFrame,
    /// Camera-space x and y of the raster's origin, on the plane z = 1 (perspective), in
    /// metres (orthographic), or as fractions of the panorama.
    pub corner: Vec2,
    /// Change of them per pixel to the right and per pixel down.
    pub step: Vec2,
    /// Near and far clipping distance along the view axis, metres.
    pub clip: Vec2,
    /// Lens radius, metres; 0 is a pinhole.
    pub lens_radius: f32,
    /// Factor on the lens' x: the inverse of Blender's anamorphic ratio.
    pub lens_squeeze: f32,
    /// Blades of the aperture; less than 3 is round.
    pub blades: f32,
    /// Rotation of the blades, radians.
    pub blades_rotation: f32,
    /// Distance of the plane in focus along the view axis, metres.
    pub focus: f32,
}

/// A ray from the camera with its cone.
#[derive(Clone, Copy, Debug)]
pub struct CameraRay {
    /// Start, world space.
    pub origin: Vec3,
    /// Unit direction, world space.
    pub direction: Vec3,
    /// Distance at which the ray enters the clipping range, metres.
    pub t_min: f32,
    /// Distance at which it leaves the clipping range, metres.
    pub t_max: f32,
    /// Width of the ray cone at the origin, metres (Akenine-Möller et al. 2021).
    pub cone_width: f32,
    /// Spread of the ray cone: growth of its width per metre.
    pub cone_spread: f32,
}

/// Point of the aperture in units of the lens radius: a disk, or a regular polygon with a
/// corner at the angle `blades_rotation` ± half a blade, as Cycles' aperture sampling has it.
#[inline(always)]
pub fn camera_aperture(camera: RasterCamera, u: Vec2) -> Vec2 {
    let mut point = mapping_disk(u);
    if camera.blades >= 3.0 {
        let blade = min(floor(u.x * camera.blades), camera.blades - 1.0);
        // Square root warp: uniform barycentric coordinates in the blade's triangle.
        let root = sqrt(max(u.x * camera.blades - blade, 0.0));
        let b = u.y * root;
        let a = 1.0 - root;
        let half = PI / camera.blades;
        let x = (a + b) * cos(half);
        let y = (a - b) * sin(half);
        let turn = camera.blades_rotation + 2.0 * half * blade;
        point = vec2(cos(turn) * x - sin(turn) * y, sin(turn) * x + cos(turn) * y);
    }
    vec2(point.x * camera.lens_squeeze, point.y)
}

/// Ray through a point of the raster. The cone's width is that of a square with the
/// pixel's solid angle.
#[inline]
pub fn camera_ray(camera: RasterCamera, raster: Vec2, lens: Vec2) -> CameraRay {
    let x = camera.corner.x + raster.x * camera.step.x;
    let y = camera.corner.y + raster.y * camera.step.y;
    if camera.kind == CAMERA_PANORAMA {
        return camera_ray_panorama(camera, x, y, lens);
    }
    let mut origin = vec3(0.0, 0.0, 0.0);
    let mut direction = vec3(x, y, 1.0);
    if camera.kind == CAMERA_ORTHOGRAPHIC {
        origin = vec3(x, y, 0.0);
        direction = vec3(0.0, 0.0, 1.0);
    }
    let cosine = 1.0 / sqrt(dot(direction, direction));
    if camera.lens_radius > 0.0 {
        let point = camera_aperture(camera, lens) * camera.lens_radius;
        let on_lens = vec3(point.x, point.y, 0.0);
        direction = direction * camera.focus - on_lens;
        origin += on_lens;
    }
    direction = normalize(direction);
    let area = abs(camera.step.x * camera.step.y);
    let parallel = camera.kind == CAMERA_ORTHOGRAPHIC;
    CameraRay {
        origin: camera.origin + mapping_place(camera.axes, origin.x, origin.y, origin.z),
        direction: mapping_place(camera.axes, direction.x, direction.y, direction.z),
        t_min: camera.clip.x / direction.z,
        t_max: camera.clip.y / direction.z,
        cone_width: select(0.0, sqrt(area), parallel),
        cone_spread: select(sqrt(area * cosine) * cosine, 0.0, parallel),
    }
}

/// Panoramic ray; `x` runs from 0 at the left edge to 1, `y` from 0 at the bottom to 1. The
/// picture's centre looks along the view axis.
#[inline]
pub fn camera_ray_panorama(camera: RasterCamera, x: f32, y: f32, lens: Vec2) -> CameraRay {
    let longitude = 2.0 * PI * (x - 0.5);
    let latitude = PI * (y - 0.5);
    let level = cos(latitude);
    let mut direction = vec3(
        level * sin(longitude),
        sin(latitude),
        level * cos(longitude),
    );
    let mut origin = vec3(0.0, 0.0, 0.0);
    if camera.lens_radius > 0.0 {
        let right = vec3(cos(longitude), 0.0, -sin(longitude));
        let up = vec3(
            -sin(latitude) * sin(longitude),
            level,
            -sin(latitude) * cos(longitude),
        );
        let point = camera_aperture(camera, lens) * camera.lens_radius;
        origin = right * point.x + up * point.y;
        direction = normalize(direction * camera.focus - origin);
    }
    let solid_angle = abs(camera.step.x * camera.step.y) * 2.0 * PI * PI * abs(level);
    CameraRay {
        origin: camera.origin + mapping_place(camera.axes, origin.x, origin.y, origin.z),
        direction: mapping_place(camera.axes, direction.x, direction.y, direction.z),
        t_min: camera.clip.x,
        t_max: camera.clip.y,
        cone_width: 0.0,
        cone_spread: sqrt(solid_angle),
    }
}
