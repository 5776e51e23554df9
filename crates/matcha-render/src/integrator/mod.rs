//! The path tracer: stages over a batch of paths.
//!
//! A thread drives [`worker::BATCH`] paths through the same stages that a GPU runs as
//! kernels: generate, traverse, shade (footprint, look-up, evaluation, closures, light
//! samples), shadows, [film](crate::film).
//! Finished paths are replaced at once, so that the batch stays full.

mod direct;
mod networks;
pub mod path;
mod sample;
mod shade;
pub mod worker;

pub use networks::Networks;

use crate::accel::{Hit, NOTHING, Ray, ray_kind};
use crate::camera::pixel_ray;
use crate::device::sobol::sobol_pixel_seed;
use crate::film::{PixelSums, Tile, filter::FilterTable};
use crate::light::RayKind;
use crate::node_cache::CacheLayout;
use crate::prepare::Prepared;
use crate::scene::{Scene, Settings};
use crate::surface::PathInfo;
use glam::Vec3;
use matcha_cache::Table;
use matcha_shade::program::Program;
use path::{Path, flags, power_heuristic};

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

    pub(crate) fn settings(&self) -> &Settings {
        &self.scene().settings
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

    pub(crate) fn world_is_seen_by(&self, path: &Path) -> bool {
        path.ray_kind().sees(&self.scene().world.visibility)
    }

    /// A path from the camera through a pixel of a tile.
    pub(crate) fn start_path(&self, tile: &Tile, pixel: u32, index: u32) -> Path {
        let [x, y] = tile.pixel(pixel);
        let seed = sobol_pixel_seed(x, y, self.seed);
        let offset = self
            .filter
            .offset(sample::camera(seed, index, sample::FILTER));
        let lens = sample::camera(seed, index, sample::LENS);
        let ray = pixel_ray(&self.prepared.camera, [x, y], offset, lens);
        Path {
            pixel,
            sample: index,
            seed,
            dimension: sample::FIRST_SURFACE,
            origin: ray.origin,
            direction: ray.direction,
            t_min: ray.t_min,
            t_max: ray.t_max,
            leaves: [NOTHING; 2],
            throughput: Vec3::ONE,
            radiance: Vec3::ZERO,
            alpha: 1.0,
            flags: flags::CAMERA,
            bounce: 0,
            diffuse: 0,
            glossy: 0,
            transmission: 0,
            transparent: 0,
            scatter_pdf: f32::INFINITY,
            min_pdf: f32::INFINITY,
            mis_origin: ray.origin,
            mis_normal: Vec3::ZERO,
            cone_width: ray.cone_width,
            cone_spread: ray.cone_spread,
            nodes_found: 0.0,
            albedo: Vec3::ZERO,
            normal: Vec3::ZERO,
            depth: -1.0,
        }
    }
}

impl Path {
    /// The ray that the path follows.
    pub(crate) fn ray(&self) -> Ray {
        Ray {
            origin: self.origin,
            direction: self.direction,
            t_min: self.t_min,
            t_max: self.t_max,
            mask: self.ray_mask(),
            excluded: self.leaves,
        }
    }

    /// Kind of the ray for the visibility of what it meets.
    pub(crate) fn ray_kind(&self) -> RayKind {
        if self.flags & flags::CAMERA != 0 {
            RayKind::Camera
        } else if self.flags & flags::TRANSMIT != 0 {
            RayKind::Transmission
        } else if self.flags & flags::DIFFUSE != 0 {
            RayKind::Diffuse
        } else {
            RayKind::Glossy
        }
    }

    fn ray_mask(&self) -> u8 {
        match self.ray_kind() {
            RayKind::Camera => ray_kind::CAMERA,
            RayKind::Transmission => ray_kind::TRANSMISSION,
            RayKind::Diffuse => ray_kind::DIFFUSE,
            RayKind::Glossy => ray_kind::GLOSSY,
        }
    }

    /// What networks may know of the path whose last segment has a length (metres).
    pub(crate) fn info(&self, ray_length: f32) -> PathInfo {
        PathInfo {
            direction: self.direction,
            flags: self.flags,
            cone_width: self.cone_width,
            cone_spread: self.cone_spread,
            ray_length,
            bounce: self.bounce,
            diffuse: self.diffuse,
            glossy: self.glossy,
            transmission: self.transmission,
            transparent: self.transparent,
        }
    }

    /// Weight of light that the ray meets, which next-event estimation finds with density
    /// `pdf` too: all of it where nothing was sampled at the ray's origin.
    pub(crate) fn weight_against(&self, pdf: f32) -> f32 {
        if self.flags & (flags::CAMERA | flags::SINGULAR) != 0 {
            1.0
        } else {
            power_heuristic(self.scatter_pdf, pdf)
        }
    }

    /// Bounces as the clamps count them for light that the ray meets: seen directly or
    /// after one bounce is direct.
    pub(crate) fn light_bounce(&self) -> u32 {
        u32::from(self.bounce).saturating_sub(1)
    }

    /// Adds the finished path to its pixel.
    pub(crate) fn add_to(&self, sums: &mut [PixelSums]) {
        let hit = self.depth >= 0.0;
        sums[self.pixel as usize].add(&PixelSums {
            radiance: self.radiance.extend(self.alpha.clamp(0.0, 1.0)),
            albedo: self.albedo,
            normal: self.normal,
            depth: self.depth.max(0.0),
            depth_samples: f32::from(u8::from(hit)),
            nodes_found: self.nodes_found,
            samples: 1.0,
        });
    }
}
