//! The path tracer: stages over a batch of paths.
//!
//! A thread drives a batch of paths (2,048)  through the same stages that a GPU runs as
//! kernels: generate, traverse, shade (footprint, look-up, evaluation, closures, light
//! samples), shadows, [film](crate::film).
//! Finished paths are replaced at once, so that the batch stays full.

mod direct;
mod networks;
pub mod path;
mod shade;
pub mod worker;

pub use direct::shadow_ray;
pub use networks::{Networks, build_lobes, radiance};

use crate::accel::{Hit, Ray, visibility_mask};
use crate::device::path_meet::path_info;
use crate::device::path_start::path_start;
use crate::device::path_state::film_add;
use crate::device::path_step::path_ray_mask;
use crate::film::{PixelSums, Tile, filter::FilterTable};
use crate::node_cache::CacheLayout;
use crate::prepare::Prepared;
use crate::scene::Scene;
use crate::surface::PathInfo;
use glam::Vec3;
use matcha_cache::Table;
use matcha_shade::program::Program;
use path::{Path, PathSettings};

/// The material cache as a frame uses it.
#[derive(Clone, Copy)]
pub struct FrameCache<'a> {
    /// The table.
    pub table: &'a Table,
    /// Where each material's values are in it.
    pub layouts: &'a [CacheLayout],
    /// Added to the level of the virtual texture.
    pub level_offset: f32,
}

/// Everything that is read while rendering, the same for all threads.
pub struct Frame<'a> {
    /// The scene and everything derived from it.
    pub prepared: &'a Prepared,
    /// Programs of the materials, cached or not.
    pub programs: &'a [Program],
    /// The pixel filter.
    pub filter: &'a FilterTable,
    /// The material cache.
    pub cache: Option<FrameCache<'a>>,
    /// Seed of the picture.
    pub seed: u32,
}

impl Frame<'_> {
    pub(crate) fn scene(&self) -> &Scene {
        self.prepared.scene()
    }

    pub(crate) fn program(&self, material: u32) -> &Program {
        &self.programs[material as usize]
    }

    /// The world's program, or its radiance where it is the same everywhere.
    pub(crate) fn world_program(&self) -> Result<&Program, Vec3> {
        self.prepared.world()
    }

    pub(crate) fn material_of(&self, hit: &Hit) -> u32 {
        self.prepared.material_of(hit)
    }

    pub(crate) fn is_holdout(&self, hit: &Hit) -> bool {
        self.scene().instances[hit.instance as usize].holdout
    }

    pub(crate) fn has_transparent_shadows(&self) -> bool {
        self.prepared.has_transparent_shadows()
    }

    /// Kinds of rays that see the world: `RAY_` bits.
    pub(crate) fn world_visibility(&self) -> u32 {
        visibility_mask(&self.scene().world.visibility).into()
    }

    /// What the rules of paths ask of the settings.
    pub(crate) fn rules(&self) -> PathSettings {
        self.prepared.rules
    }

    /// A path from the camera through a pixel of a tile.
    pub(crate) fn start_path(&self, tile: &Tile, pixel: u32, index: u32) -> Path {
        let [x, y] = tile.pixel(pixel);
        let filter = self.filter.view();
        path_start(self.prepared.camera, filter, self.seed, x, y, pixel, index)
    }
}

impl Path {
    /// The ray that the path follows.
    pub fn ray(&self) -> Ray {
        Ray {
            origin: self.origin,
            direction: self.direction,
            t_min: self.t_min,
            t_max: self.t_max,
            mask: path_ray_mask(self.flags) as u8,
            excluded: self.leaves,
        }
    }

    /// What networks may know of the path whose last segment has a length (metres).
    pub(crate) fn info(&self, ray_length: f32) -> PathInfo {
        path_info(self, ray_length)
    }

    /// Adds the finished path to its pixel.
    pub(crate) fn add_to(&self, sums: &mut [PixelSums]) {
        film_add(&mut sums[self.pixel as usize], self);
    }
}

#[cfg(test)]
mod tests;
