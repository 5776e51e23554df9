//! Which draw of a path's Sobol sequence serves what.

use super::path::Path;
use crate::device::sobol::{sobol_1d, sobol_2d, sobol_3d};
use glam::{Vec2, Vec3};

/// Draw for the place in the pixel.
pub const FILTER: u32 = 0;
/// Draw for the place on the lens.
pub const LENS: u32 = 1;
/// First draw of the first surface.
pub const FIRST_SURFACE: u32 = 2;
/// Draws that one surface uses.
pub const PER_SURFACE: u32 = 4;

/// Draws of one surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Draw {
    /// Which light (x), and where on it (y, z).
    Light = 0,
    /// Whether a small contribution is kept.
    LightKeep = 1,
    /// Which closure (z), or straight through, and its direction (x, y).
    Scatter = 2,
    /// Russian roulette.
    Roulette = 3,
}

/// One number of a draw at the path's surface.
pub fn one(path: &Path, draw: Draw) -> f32 {
    sobol_1d(path.seed, path.sample, path.dimension + draw as u32)
}

/// Three numbers of a draw at the path's surface.
pub fn three(path: &Path, draw: Draw) -> Vec3 {
    sobol_3d(path.seed, path.sample, path.dimension + draw as u32)
}

/// Two numbers of a draw of the camera.
pub fn camera(seed: u32, sample: u32, draw: u32) -> Vec2 {
    sobol_2d(seed, sample, draw)
}
