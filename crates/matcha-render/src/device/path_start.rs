//! Where paths begin: the pixel filter, the camera, and the draws of a path's sequence.

use glam::{Vec2, Vec3};
use matcha_shade::device::math::{MAX, abs, clamp, negate_if, splat3, sqrt, to_int, vec2};

use super::camera::{CameraRay, RasterCamera, camera_ray};
use super::path_flags::PATH_CAMERA;
use super::path_state::Path;
use super::sobol::{sobol_2d, sobol_pixel_seed};

/// Draw of a path's sequence for the place in the pixel.
pub const DRAW_FILTER: u32 = 0;
/// Draw for the place on the lens.
pub const DRAW_LENS: u32 = 1;
/// First draw of the first surface.
pub const DRAW_FIRST_SURFACE: u32 = 2;
/// Draws that one surface uses.
pub const DRAW_PER_SURFACE: u32 = 4;
/// Of a surface: which light (x), and where on it (y, z).
pub const DRAW_LIGHT: u32 = 0;
/// Of a surface: whether a small contribution is kept.
pub const DRAW_LIGHT_KEEP: u32 = 1;
/// Of a surface: which closure (z), or straight through, and its direction (x, y).
pub const DRAW_SCATTER: u32 = 2;
/// Of a surface: Russian roulette.
pub const DRAW_ROULETTE: u32 = 3;

/// No instance and no primitive.
pub const PATH_LEAVES_NOTHING: u32 = 0xffff_ffff;

/// The pixel filter.
#[derive(Clone, Copy, Debug)]
pub struct FilterView<'a> {
    /// Inverse of the filter's cumulative distribution, by the fourth root of the tail's share,
    /// pixels; at least two entries.
    pub inverse: &'a [f32],
}

/// Offset from the pixel's centre along one axis, pixels, for `u` in [0, 1].
#[inline]
pub fn filter_offset(filter: FilterView, u: f32) -> f32 {
    let centred = 2.0 * clamp(u, 0.0, 1.0) - 1.0;
    let share = 1.0 - abs(centred);
    let intervals = filter.inverse.len() as u32 - 1;
    let x = sqrt(sqrt(share)) * (intervals as f32);
    let mut i = to_int(x) as u32;
    if i >= intervals {
        i = intervals - 1;
    }
    let a = filter.inverse[i as usize];
    let b = filter.inverse[(i + 1) as usize];
    negate_if(a + (b - a) * (x - (i as f32)), centred < 0.0)
}

/// The camera's ray of a sample of a pixel (column and row from the top).
#[inline]
pub fn path_camera_ray(
    camera: RasterCamera,
    filter: FilterView,
    x: u32,
    y: u32,
    seed: u32,
    index: u32,
) -> CameraRay {
    let place = sobol_2d(seed, index, DRAW_FILTER);
    let lens = sobol_2d(seed, index, DRAW_LENS);
    let offset = vec2(
        filter_offset(filter, place.x),
        filter_offset(filter, place.y),
    );
    let raster: Vec2 = vec2((x as f32) + 0.5, (y as f32) + 0.5) + offset;
    camera_ray(camera, raster, lens)
}

/// A path from the camera: sample `index` of the pixel in column `x` and row `y` of the
/// picture with the seed `picture`; `pixel` is what the film calls it.
#[inline]
pub fn path_start(
    camera: RasterCamera,
    filter: FilterView,
    picture: u32,
    x: u32,
    y: u32,
    pixel: u32,
    index: u32,
) -> Path {
    let seed = sobol_pixel_seed(x, y, picture);
    let ray = path_camera_ray(camera, filter, x, y, seed, index);
    let zero: Vec3 = splat3(0.0);
    Path {
        pixel,
        sample: index,
        seed,
        dimension: DRAW_FIRST_SURFACE,
        origin: ray.origin,
        direction: ray.direction,
        t_min: ray.t_min,
        t_max: ray.t_max,
        leaves: [PATH_LEAVES_NOTHING, PATH_LEAVES_NOTHING],
        throughput: splat3(1.0),
        radiance: zero,
        alpha: 1.0,
        flags: PATH_CAMERA,
        bounce: 0,
        diffuse: 0,
        glossy: 0,
        transmission: 0,
        transparent: 0,
        scatter_pdf: MAX,
        min_pdf: MAX,
        mis_origin: ray.origin,
        mis_normal: zero,
        cone_width: ray.cone_width,
        cone_spread: ray.cone_spread,
        nodes_found: 0.0,
        albedo: zero,
        normal: zero,
        depth: -1.0,
    }
}
