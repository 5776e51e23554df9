//! What a device that renders must offer, and what is asked of it.

use crate::accel::AccelError;
use crate::film::Film;
use matcha_cache::CacheError;
use matcha_shade::nodes::LowerError;
use matcha_shade::vm::Isa;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Whether, and how, results of node networks are kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CacheMode {
    /// Every network is evaluated at every hit: the reference.
    Off,
    /// The paper's cache (Fujieda and Harada 2022).
    Paper {
        /// Number of cells; `None`: the paper's 10⁷, or what fits into memory.
        cells: Option<u64>,
        /// Entries a cell; `None`: the paper's 10.
        entries: Option<u32>,
        /// Added to the level λ of the virtual texture: positive is finer.
        level_offset: f32,
    },
}

/// How the threads of a processor go about their work. No picture depends on it but for the
/// order in which a pixel's samples are added, which is that of the batch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CpuSchedule {
    /// Paths in flight on one thread, at least 1.
    pub batch_paths: usize,
    /// Most hits that node networks are evaluated for at once, at least 1.
    pub group_hits: usize,
    /// Instructions that networks run in, where the processor has them.
    pub isa: Isa,
}

impl Default for CpuSchedule {
    /// What was fastest: `docs/adr/0005-batches-and-shadows.md`.
    fn default() -> Self {
        Self {
            batch_paths: 2048,
            group_hits: 512,
            isa: Isa::best(),
        }
    }
}

/// Settings of one rendering that are not the scene's.
#[derive(Clone, Debug)]
pub struct RenderOptions {
    /// Picture size in pixels; `None`: the scene's.
    pub resolution: Option<[u32; 2]>,
    /// Threads; `None`: one for each core.
    pub threads: Option<usize>,
    /// Seed; `None`: the scene's.
    pub seed: Option<u32>,
    /// The material cache.
    pub cache: CacheMode,
    /// For processors; graphics devices have no use for it.
    pub schedule: CpuSchedule,
}

impl Default for RenderOptions {
    fn default() -> Self {
        Self {
            resolution: None,
            threads: None,
            seed: None,
            cache: CacheMode::Off,
            schedule: CpuSchedule::default(),
        }
    }
}

/// Why a scene cannot be rendered.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// A node tree makes no sense.
    #[error("{0}")]
    Lower(#[from] LowerError),
    /// The geometry cannot be used.
    #[error("{0}")]
    Accel(#[from] AccelError),
    /// The material cache cannot be made.
    #[error("{0}")]
    Cache(#[from] CacheError),
    /// The picture's size is impossible.
    #[error("a picture of {0} × {1} pixels cannot be rendered: each side must be 1 to 65536")]
    Resolution(u32, u32),
    /// The scene refers to something that is not there.
    #[error("{0}")]
    Scene(String),
    /// Threads could not be started.
    #[error("cannot start the render threads: {0}")]
    Threads(String),
    /// A device fails, in the words of the crate that drives it.
    #[error("{0}")]
    Device(Box<dyn std::error::Error + Send + Sync>),
}

/// How a rendering is watched and stopped from outside.
#[derive(Debug, Default)]
pub struct Control {
    stop: AtomicBool,
    samples: AtomicU64,
    first: OnceLock<Instant>,
}

impl Control {
    /// Asks the rendering to end soon; what is on the film stays.
    pub fn stop(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }

    /// True once somebody asked to stop.
    pub fn stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// Adds to the number of pixel samples that are done.
    pub fn add_samples(&self, samples: u64) {
        if samples > 0 {
            self.first.get_or_init(Instant::now);
        }
        self.samples.fetch_add(samples, Ordering::Relaxed);
    }

    /// When the first pixel sample was done.
    pub fn first_sample(&self) -> Option<Instant> {
        self.first.get().copied()
    }

    /// Pixel samples done so far.
    pub fn samples(&self) -> u64 {
        self.samples.load(Ordering::Relaxed)
    }
}

/// State of the material cache.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct CacheStatistics {
    /// Look-ups of cacheable nodes.
    pub lookups: u64,
    /// Look-ups that found the node's value.
    pub hits: u64,
    /// Values stored.
    pub inserts: u64,
    /// Values not stored because the cell was full.
    pub refused: u64,
    /// Values not stored because another thread stored in the same entry first.
    pub races_lost: u64,
    /// Values not stored because their encoding cannot hold them (a processor's only).
    pub unencodable: u64,
    /// Entries in use.
    pub occupied: u64,
    /// Entries in all.
    pub capacity: u64,
    /// Bytes of the table.
    pub bytes: u64,
}

/// What a rendering cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Statistics {
    /// Wall-clock time spent in rendering (preparation excluded), seconds.
    pub seconds: f64,
    /// Wall-clock time in which the cache's memory was cleared, not in `seconds`. On the CPU.
    pub table_seconds: f64,
    /// Time spent in evaluating node networks, over all threads, seconds.
    pub network_seconds: f64,
    /// Time spent by all threads, seconds.
    pub thread_seconds: f64,
    /// Rays traced: camera, scattered and shadow rays.
    pub rays: u64,
    /// Shading points at which a network ran.
    pub shaded: u64,
    /// Nodes found in the cache.
    pub nodes_found: u64,
    /// Pixel samples. `samples` in files are those of one pixel.
    #[serde(rename = "pixel_samples")]
    pub samples: u64,
    /// The cache; all zero where it is off.
    pub cache: CacheStatistics,
}

impl Statistics {
    /// Share of the threads' time that went into node networks, 0 to 1.
    pub fn material_share(&self) -> f64 {
        if self.thread_seconds > 0.0 {
            self.network_seconds / self.thread_seconds
        } else {
            0.0
        }
    }
}

/// Times of a device that runs kernels; nothing on the CPU.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct KernelTimes {
    /// Time spent in compiling kernels, or in reading compiled ones, seconds.
    pub pipeline_seconds: f64,
    /// Device time of each stage, seconds; empty where the device has no clock.
    pub stage_seconds: BTreeMap<&'static str, f64>,
}

/// Memory of images on a device that packs them in blocks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct TextureMemory {
    /// Bytes of all images' texels.
    pub bytes: u64,
    /// Bytes that they would be more without blocks.
    pub bytes_saved: u64,
    /// Resolutions of images in blocks.
    pub packed_levels: u32,
    /// Resolutions of images of bytes that stay as they are: those for which blocks would be off
    /// by too much, or would be no smaller.
    pub kept_levels: u32,
}

/// A device with a scene on it.
pub trait Backend {
    /// The device's name for people and reports.
    fn device(&self) -> String;

    /// Adds samples `range` of every pixel to the film and returns the time that it took.
    /// Returns early when `control` asks to stop.
    ///
    /// # Errors
    /// Device failures; the film keeps what it has.
    fn render(&mut self, range: Range<u32>, control: &Control) -> Result<Duration, RenderError>;

    /// The picture so far.
    fn film(&self) -> &Film;

    /// Totals so far.
    fn statistics(&self) -> Statistics;

    /// Bytes of programs and film, and of what the device holds beside them (the cache's
    /// are in the statistics, the scene's are the prepared scene's).
    fn bytes(&self) -> usize;

    /// Memory of images, where they were to be packed.
    fn texture_memory(&self) -> Option<TextureMemory> {
        None
    }

    /// Times of kernels so far.
    fn kernel_times(&self) -> KernelTimes {
        KernelTimes::default()
    }
}
