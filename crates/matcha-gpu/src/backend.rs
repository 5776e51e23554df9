//! The GPU as a rendering device.

use crate::adapter::{self, Adapter, Wanted};
use crate::device::Device;
use crate::error::GpuError;
use crate::pipeline::Pipelines;
use crate::wavefront::{GpuFrom, Wavefront};
use matcha_cache::TableSize;
use matcha_render::backend::{
    Backend, CacheMode, Control, KernelTimes, RenderError, RenderOptions, Statistics, TextureMemory,
};
use matcha_render::film::Film;
use matcha_render::prepare::Prepared;
use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// How networks are evaluated when results are kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MaterialStage {
    /// As in the paper: a hit looks a node up and evaluates it at once if it is not there.
    Inline,
    /// All hits look their nodes up; only those that miss are evaluated, side by side.
    #[default]
    Split,
}

/// What is asked of the GPU beside what is asked of every device.
#[derive(Clone, Debug)]
pub struct GpuOptions {
    /// The adapter.
    pub wanted: Wanted,
    /// How networks are evaluated when results are kept.
    pub material_stage: MaterialStage,
    /// Whether hits and misses are sorted by what is to be evaluated; by default where it
    /// pays: on GPUs, whose neighbouring invocations run the same instruction, but not on drivers
    /// on the processor.
    pub sort_queues: Option<bool>,
    /// Which stages are left to the processor, to find out where devices differ; without it the
    /// device takes all of them, several bounces at once.
    pub gpu_from: Option<GpuFrom>,
    /// Trace rays by the adapter's ray queries instead of by our own walk: experimental.
    pub ray_queries: bool,
    /// Images of bytes are packed in blocks: a quarter of the memory, at an error
    /// ([`matcha_render::flat::BLOCK_ERROR`]).
    pub compress_textures: bool,
    /// Where compiled kernels are kept.
    pub cache_folder: Option<PathBuf>,
}

impl Default for GpuOptions {
    fn default() -> Self {
        Self {
            wanted: Wanted::Best,
            material_stage: MaterialStage::default(),
            sort_queues: None,
            gpu_from: None,
            ray_queries: false,
            compress_textures: false,
            cache_folder: None,
        }
    }
}

/// An open device and its kernels: what all renderings of a process share.
pub struct Gpu {
    device: Device,
    pipelines: Pipelines,
    options: GpuOptions,
}

impl Gpu {
    /// Opens the adapter that is asked for.
    ///
    /// # Errors
    /// If there is none, it lacks something, or the driver refuses.
    pub fn open(options: GpuOptions) -> Result<Arc<Gpu>, GpuError> {
        let adapter = adapter::choose(adapter::adapters(), &options.wanted)?;
        Gpu::open_adapter(&adapter, options)
    }

    /// Opens an adapter, whatever the options want.
    ///
    /// # Errors
    /// If it has no ray queries and they are asked for, or the driver refuses.
    pub fn open_adapter(adapter: &Adapter, options: GpuOptions) -> Result<Arc<Gpu>, GpuError> {
        let device = Device::open_with(adapter, options.ray_queries)?;
        let pipelines = Pipelines::new(&device, options.cache_folder.as_deref());
        Ok(Arc::new(Gpu {
            device,
            pipelines,
            options,
        }))
    }

    /// The device.
    pub fn device(&self) -> &Device {
        &self.device
    }

    /// Its kernels so far.
    pub fn pipelines(&self) -> &Pipelines {
        &self.pipelines
    }
}

impl Drop for Gpu {
    fn drop(&mut self) {
        // A device in trouble may not answer, and what it compiled is not to be trusted.
        if self.device.trouble().is_ok() {
            self.pipelines.save();
        }
    }
}

/// A prepared scene on a GPU, and a film.
pub struct GpuBackend {
    gpu: Arc<Gpu>,
    wavefront: Wavefront,
    film: Film,
    time: Duration,
}

impl GpuBackend {
    /// Puts a prepared scene on the device and makes the kernels.
    ///
    /// # Errors
    /// If the device has no memory for it, or refuses a kernel.
    pub fn new(
        gpu: &Arc<Gpu>,
        prepared: &Arc<Prepared>,
        options: &RenderOptions,
    ) -> Result<GpuBackend, GpuError> {
        if let CacheMode::Paper { cells, entries, .. } = options.cache {
            let paper = TableSize::PAPER;
            let asked = TableSize {
                cells: cells.unwrap_or(paper.cells),
                entries: entries.unwrap_or(paper.entries),
            };
            asked.check()?;
        }
        let [width, height] = prepared.resolution();
        Ok(GpuBackend {
            wavefront: Wavefront::new(
                &gpu.device,
                &gpu.pipelines,
                prepared,
                options,
                &gpu.options,
            )?,
            gpu: gpu.clone(),
            film: Film::new(width, height, prepared.scene().settings.exposure),
            time: Duration::ZERO,
        })
    }
}

impl Backend for GpuBackend {
    fn device(&self) -> String {
        let report = self.gpu.device.report();
        format!("{}, {}", report.name, report.backend)
    }

    fn render(&mut self, range: Range<u32>, control: &Control) -> Result<Duration, RenderError> {
        let start = Instant::now();
        let rendered = self.wavefront.render(range, control, &mut self.film);
        let time = start.elapsed();
        self.time += time;
        rendered?;
        Ok(time)
    }

    fn film(&self) -> &Film {
        &self.film
    }

    /// All time is the device's: the share of networks is that of the wall-clock time.
    fn statistics(&self) -> Statistics {
        let counted = self.wavefront.statistics();
        let seconds = self.time.as_secs_f64();
        Statistics {
            seconds,
            table_seconds: 0.0,
            network_seconds: counted.network_seconds,
            thread_seconds: seconds,
            rays: counted.rays,
            shaded: counted.shaded,
            nodes_found: counted.nodes_found,
            samples: self.film.total_samples(),
            cache: counted.cache,
        }
    }

    fn bytes(&self) -> usize {
        self.film.bytes() + self.wavefront.bytes()
    }

    fn texture_memory(&self) -> Option<TextureMemory> {
        self.wavefront.texture_memory()
    }

    fn kernel_times(&self) -> KernelTimes {
        KernelTimes {
            pipeline_seconds: self.gpu.pipelines.seconds(),
            stage_seconds: self.wavefront.statistics().stage_seconds,
        }
    }
}
