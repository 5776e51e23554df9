//! Which draw of a path's Sobol sequence serves what.

use super::path::Path;
use crate::device::path_start::{DRAW_LIGHT, DRAW_SCATTER};
use crate::device::sobol::sobol_3d;
use glam::Vec3;

/// Which light (x), and where on it (y, z).
pub fn light(path: &Path) -> Vec3 {
    sobol_3d(path.seed, path.sample, path.dimension + DRAW_LIGHT)
}

/// Which closure (z), or straight through, and its direction (x, y).
pub fn scatter(path: &Path) -> Vec3 {
    sobol_3d(path.seed, path.sample, path.dimension + DRAW_SCATTER)
}
