//! Rendering in slices of samples, watched and stoppable.

use crate::End;
use crate::arguments::{Cache, Options, SceneArguments};
use crate::device::Device;
use crate::interrupt;
use crate::loading;
use crate::picture::view::View;
use crate::progress::Watch;
use anyhow::{Result, anyhow, bail};
use matcha_cache::available_memory;
use matcha_render::backend::{
    Backend, Control, KernelTimes, RenderError, Statistics, TextureMemory,
};
use matcha_render::film::Film;
use matcha_render::prepare::Prepared;
use serde::Serialize;
use std::ops::Range;
use std::path::Path;
use std::sync::{Arc, OnceLock};
use std::time::Instant;

/// Samples of each pixel that are rendered in one go: enough for whole batches, few
/// enough to compare fairly on a machine whose speed drifts.
const SLICE: u32 = 8;

/// When the program began.
static START: OnceLock<Instant> = OnceLock::new();

/// Notes that the program begins now.
pub(crate) fn note_start() {
    START.get_or_init(Instant::now);
}

/// In strict mode, an error if anything was replaced by something else.
fn refuse_in_strict_mode(scene: &SceneArguments, substitutes: &[String]) -> Result<()> {
    match substitutes {
        [first, rest @ ..] if scene.strict => {
            let more = match rest.len() {
                0 => String::new(),
                n => format!("; {n} more like it"),
            };
            bail!(
                "{}: not everything is supported, and strict was asked for: {first}{more}",
                scene.scene.display()
            )
        }
        _ => Ok(()),
    }
}

/// A scene that is ready, and how it will be shown.
pub(crate) struct Loaded {
    prepared: Arc<Prepared>,
    /// Samples a pixel.
    pub samples: u32,
    /// The scene's view transform.
    pub view: View,
}

impl Loaded {
    /// Loads and prepares.
    pub fn new(scene: &SceneArguments, options: &Options) -> Result<Self> {
        let mut loaded = loading::load_scene(scene)?;
        let samples = options.samples.unwrap_or(loaded.settings.samples);
        if samples == 0 {
            bail!(
                "{}: asks for zero samples; give some with --samples",
                scene.scene.display()
            );
        }
        loaded.settings.samples = samples;
        let (view, lacks) = View::new(&loaded.settings.view);
        let prepared = Prepared::new(loaded, options.resolution)?;
        let mut substitutes: Vec<String> = lacks.into_iter().collect();
        for (material, report) in prepared.reports() {
            substitutes.extend(report.items.iter().map(|item| {
                format!(
                    "{} (material \"{material}\", node \"{}\"): {}",
                    item.kind, item.node, item.substitute
                )
            }));
        }
        refuse_in_strict_mode(scene, &substitutes)?;
        for substitute in &substitutes {
            tracing::warn!("{substitute}");
        }
        Ok(Self {
            prepared: Arc::new(prepared),
            samples,
            view,
        })
    }

    /// Renderers of the scene on a device, one for each cache.
    pub fn backends<const N: usize>(
        &self,
        device: &Device,
        options: &Options,
        caches: [Cache; N],
    ) -> Result<[Box<dyn Backend>; N]> {
        self.refuse_beyond_memory(N as u64)?;
        let caches = caches.map(|cache| options.render_options(cache));
        let backends = device.backends(&self.prepared, caches)?;
        if options.compress_textures {
            log_textures(backends.first().and_then(|b| b.texture_memory()));
        }
        Ok(backends)
    }

    /// An error if the films of several renderers do not fit into memory, where the program
    /// would be ended by the system instead, perhaps after hours.
    fn refuse_beyond_memory(&self, films: u64) -> Result<()> {
        let [width, height] = self.resolution();
        // As much again for what is made of a film when it is written.
        let needed = 2 * films * Film::bytes_of([width, height]);
        match available_memory() {
            Some(available) if needed > available => bail!(
                "a picture of {width} × {height} pixels needs {} MiB, but only {} MiB of memory \
                 are available: choose a smaller --resolution",
                needed >> 20,
                available >> 20
            ),
            _ => Ok(()),
        }
    }

    /// Picture size, pixels.
    pub fn resolution(&self) -> [u32; 2] {
        self.prepared.resolution()
    }

    /// The scene's name.
    pub fn name(&self) -> &str {
        &self.prepared.scene().name
    }

    /// Bytes of the prepared scene.
    pub fn bytes(&self) -> usize {
        self.prepared.bytes()
    }

    fn pixel_samples(&self) -> u64 {
        let [width, height] = self.resolution();
        u64::from(width) * u64::from(height) * u64::from(self.samples)
    }

    fn slices(&self) -> impl Iterator<Item = Range<u32>> + use<> {
        let end = self.samples;
        (0..end)
            .step_by(SLICE as usize)
            .map(move |start| start..(start + SLICE).min(end))
    }
}

/// Says what packed images save.
fn log_textures(memory: Option<TextureMemory>) {
    let Some(memory) = memory else {
        tracing::warn!("--compress-textures is for GPUs: the CPU's images stay as they are");
        return;
    };
    let mebibytes = |bytes: u64| bytes as f64 / f64::from(1 << 20);
    tracing::info!(
        "images take {:.1} MiB, compression saves {:.1} MiB; {} of {} resolutions stay as they are",
        mebibytes(memory.bytes),
        mebibytes(memory.bytes_saved),
        memory.kept_levels,
        memory.kept_levels + memory.packed_levels
    );
}

/// How a rendering ended that has something to save.
#[derive(Debug)]
pub(crate) enum Outcome {
    /// With all samples.
    Complete,
    /// Somebody stopped it.
    Interrupted,
    /// The device failed.
    Failed(RenderError),
}

impl Outcome {
    /// How the command ends, once everything is saved in `place`.
    pub fn end(self, place: &Path) -> Result<End> {
        match self {
            Outcome::Complete => Ok(End::Done),
            Outcome::Interrupted => Ok(End::Interrupted),
            Outcome::Failed(error) => Err(anyhow!(
                "{error}; what was rendered so far is saved in {}",
                place.display()
            )),
        }
    }
}

/// Renders all samples with all backends, slice by slice, the order turned around each
/// time, so that what else the machine does hits all alike.
///
/// # Errors
/// If it ended early and a backend's film is empty.
pub(crate) fn render(loaded: &Loaded, backends: &mut [Box<dyn Backend>]) -> Result<Outcome> {
    let control = interrupt::stoppable();
    let total = loaded.pixel_samples() * backends.len() as u64;
    let watch = Watch::start(control.clone(), total);
    let rendered = loaded
        .slices()
        .enumerate()
        .try_for_each(|(k, slice)| render_slice(backends, k % 2 == 1, slice, &control));
    drop(watch);
    let empty = || backends.iter().any(|b| b.film().total_samples() == 0);
    match rendered {
        Err(error) if empty() => Err(error.into()),
        Err(error) => Ok(Outcome::Failed(error)),
        Ok(()) if !control.stopped() => Ok(Outcome::Complete),
        Ok(()) if empty() => bail!("stopped before there was anything to save"),
        Ok(()) => Ok(Outcome::Interrupted),
    }
}

fn render_slice(
    backends: &mut [Box<dyn Backend>],
    backwards: bool,
    slice: Range<u32>,
    control: &Control,
) -> Result<(), RenderError> {
    let count = backends.len();
    for turn in 0..count {
        let index = if backwards { count - 1 - turn } else { turn };
        if !control.stopped() {
            backends[index].render(slice.clone(), control)?;
        }
    }
    Ok(())
}

/// Everything that `--stats` writes of one rendering.
#[derive(Debug, Serialize)]
pub(crate) struct FullStatistics {
    device: String,
    resolution: [u32; 2],
    /// Fewest samples that a pixel has.
    samples: u32,
    material_share: f64,
    rays_per_second: f64,
    samples_per_second: f64,
    scene_bytes: usize,
    /// Programs and film.
    renderer_bytes: usize,
    /// Most memory that the process has had, where the system says.
    peak_bytes: Option<u64>,
    /// From the start of the program to the first pixel sample of any renderer.
    first_sample_seconds: Option<f64>,
    /// Of images that were to be compressed.
    textures: Option<TextureMemory>,
    #[serde(flatten)]
    kernels: KernelTimes,
    #[serde(flatten)]
    statistics: Statistics,
}

impl FullStatistics {
    pub fn of(loaded: &Loaded, backend: &dyn Backend) -> Self {
        let statistics = backend.statistics();
        let per_second = |n: u64| n as f64 / statistics.seconds.max(1e-9);
        Self {
            device: backend.device(),
            resolution: loaded.resolution(),
            samples: backend.film().samples(),
            material_share: statistics.material_share(),
            rays_per_second: per_second(statistics.rays),
            samples_per_second: per_second(statistics.samples),
            scene_bytes: loaded.bytes(),
            renderer_bytes: backend.bytes(),
            peak_bytes: peak_memory(),
            first_sample_seconds: first_sample_seconds(),
            textures: backend.texture_memory(),
            kernels: backend.kernel_times(),
            statistics,
        }
    }
}

fn first_sample_seconds() -> Option<f64> {
    let first = interrupt::stoppable().first_sample()?;
    Some(first.duration_since(*START.get()?).as_secs_f64())
}

/// Most resident memory of this process so far, bytes.
fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string(Path::new("/proc/self/status")).ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes * 1024)
}
