//! Rendering in slices of samples, watched and stoppable.

use crate::arguments::{Cache, Device, Options, SceneArguments};
use crate::interrupt;
use crate::loading;
use crate::picture::view::View;
use crate::progress::Watch;
use anyhow::{Result, bail};
use matcha_render::backend::{Backend, Control, Statistics};
use matcha_render::cpu::CpuBackend;
use matcha_render::prepare::Prepared;
use serde::Serialize;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

/// Samples of each pixel that are rendered in one go: enough for whole batches, few
/// enough to compare fairly on a machine whose speed drifts.
const SLICE: u32 = 8;

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
        if let Some(lacks) = lacks {
            tracing::warn!("{lacks}");
        }
        let prepared = Prepared::new(loaded, options.resolution)?;
        for (material, report) in prepared.reports() {
            for item in &report.items {
                tracing::warn!(
                    "{} (material \"{material}\", node \"{}\"): {}",
                    item.kind,
                    item.node,
                    item.substitute
                );
            }
        }
        if scene.strict && !prepared.reports().is_empty() {
            bail!(
                "{}: not everything is supported, and strict was asked for",
                scene.scene.display()
            );
        }
        Ok(Self {
            prepared: Arc::new(prepared),
            samples,
            view,
        })
    }

    /// A renderer of the scene.
    pub fn backend(&self, options: &Options, cache: Cache) -> Result<CpuBackend> {
        match options.device {
            Device::Auto | Device::Cpu => {
                let options = options.render_options(cache);
                Ok(CpuBackend::new(self.prepared.clone(), &options)?)
            }
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

/// Renders all samples with all backends, slice by slice, the order turned around each
/// time, so that what else the machine does hits all alike. False if it was interrupted.
pub(crate) fn render(loaded: &Loaded, backends: &mut [&mut CpuBackend]) -> Result<bool> {
    let control = interrupt::stoppable();
    let total = loaded.pixel_samples() * backends.len() as u64;
    let watch = Watch::start(control.clone(), total);
    for (k, slice) in loaded.slices().enumerate() {
        let count = backends.len();
        for turn in 0..count {
            let index = if k % 2 == 0 { turn } else { count - 1 - turn };
            backends[index].render(slice.clone(), &control)?;
            if control.stopped() {
                break;
            }
        }
        if control.stopped() {
            break;
        }
    }
    drop(watch);
    finished(&control, backends)
}

fn finished(control: &Control, backends: &[&mut CpuBackend]) -> Result<bool> {
    let nothing = backends
        .iter()
        .any(|backend| backend.film().total_samples() == 0);
    if control.stopped() && nothing {
        bail!("stopped before there was anything to save");
    }
    Ok(!control.stopped())
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
    #[serde(flatten)]
    statistics: Statistics,
}

impl FullStatistics {
    pub fn of(loaded: &Loaded, backend: &CpuBackend) -> Self {
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
            statistics,
        }
    }
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
