//! Paths in waves: every stage is a kernel over all paths in flight.
//!
//! A *slot* carries one path at a time. It belongs to one pixel and to every n-th of its samples,
//! and has sums of its own, so that a picture does not depend on the order in which the device
//! works on slots. Stages append slots to queues; the next stage is dispatched over what is in its
//! queue, without the host knowing how much that is.

mod bisect;
mod kernels;
#[doc(hidden)]
pub mod layout;
mod scene;
#[doc(hidden)]
pub mod slot_copy;
pub(crate) mod stages;
pub(crate) mod state;
mod table;
mod totals;
mod wave;

pub use bisect::GpuFrom;
#[doc(hidden)]
pub use bisect::StepRecord;
pub use stages::Stage;
#[doc(hidden)]
pub use stages::{Place, Step};
pub use totals::WavefrontStatistics;

use crate::adapter::Kind;
use crate::backend::{GpuOptions, MaterialStage};
use crate::batch::Runner;
use crate::device::Device;
use crate::error::GpuError;
use crate::machine::switch;
use crate::memory::Memory;
use crate::pipeline::Pipelines;
use crate::shader::{Library, LinkError};
use crate::twin::Twin;
use bisect::Bisection;
use kernels::Kernels;
use matcha_render::backend::{CacheMode, Control, RenderOptions, TextureMemory};
use matcha_render::film::Film;
use matcha_render::flat::FlatScene;
use matcha_render::prepare::Prepared;
use stages::Form;
use state::{Part, SlotMemory};
use std::ops::Range;
use std::sync::Arc;
use std::time::{Duration, Instant};
use totals::Totals;
use wave::Wave;

/// A dispatch should not be longer, so that a desktop stays usable and no watchdog fires.
const LONGEST_DISPATCH: Duration = Duration::from_millis(100);

/// A scene on a device, with paths in flight.
pub struct Wavefront {
    runner: Runner,
    scene: Memory,
    table: Option<Memory>,
    slots: SlotMemory,
    kernels: Kernels,
    form: Form,
    /// Which stages are left to the processor, if anybody asks for it.
    bisection: Option<Bisection>,
    /// Slots that are in use: fewer than there are where dispatches would take too long.
    in_use: u32,
    width: u32,
    textures: Option<TextureMemory>,
    totals: Totals,
    time: Duration,
}

impl Wavefront {
    /// Puts a scene on the device and makes the kernels.
    ///
    /// # Errors
    /// If the device has no memory for it, or refuses a kernel.
    pub fn new(
        device: &Device,
        pipelines: &Pipelines,
        prepared: &Arc<Prepared>,
        options: &RenderOptions,
        gpu: &GpuOptions,
    ) -> Result<Wavefront, GpuError> {
        Self::with_library(device, pipelines, prepared, options, gpu, |_| Ok(()))
    }

    /// The same with a change to the kernels' text: for tests that must fail.
    ///
    /// # Errors
    /// Likewise, and if the change cannot be made.
    #[doc(hidden)]
    pub fn with_library(
        device: &Device,
        pipelines: &Pipelines,
        prepared: &Arc<Prepared>,
        options: &RenderOptions,
        gpu: &GpuOptions,
        change: impl FnOnce(&mut Library) -> Result<(), LinkError>,
    ) -> Result<Wavefront, GpuError> {
        let cached = options.cache != CacheMode::Off;
        let invalid = |message: String| GpuError::Invalid {
            what: "the scene".to_owned(),
            message,
        };
        let programs = prepared
            .programs(cached)
            .map_err(|error| invalid(error.to_string()))?;
        let flat = FlatScene::with_textures(prepared, &programs, gpu.compress_textures);
        let textures = flat.texture_memory();
        let mut library = Library::in_dialect(device.dialect())?;
        change(&mut library)?;
        library.add(
            "the scene's operations",
            &switch(flat.programs().operations()),
        )?;
        library.set_constant("TEXTURE_HAS_BLOCKS", gpu.compress_textures.into())?;
        library.set_constant("MACHINE_REGISTERS", registers(flat.programs().registers()))?;
        let table = table::place(device, &library, &options.cache, &flat)?;
        let tables: Vec<&Memory> = table.iter().collect();
        let scene = scene::place(device, &mut library, prepared, &flat, &tables)?;
        let seed = options.seed.unwrap_or(prepared.scene().settings.seed);
        let [width, height] = prepared.resolution();
        let mut others = tables.clone();
        others.push(&scene);
        let offset = table::level_offset(&options.cache);
        let software = device.report().kind == Kind::Software;
        let setting = state::Setting {
            seed,
            offset,
            pixels: width * height,
            sorted: gpu.sort_queues.unwrap_or(!software),
        };
        let slots = SlotMemory::place(device, &library, &flat, &setting, &others)?;
        let form = Form {
            cached: table.is_some(),
            inline: gpu.material_stage == MaterialStage::Inline,
            world: flat.world_program().is_some(),
            light_programs: flat.has_light_programs(),
            transparent: flat.has_transparent_shadows(),
            layers: flat.rules().transparent_bounces + 1,
            sorted: setting.sorted,
            programs: flat.programs().count() as u32,
            regions: flat.programs().regions() as u32,
        };
        let kernels = Kernels::new(
            pipelines,
            &library,
            &scene,
            slots.memory(),
            table.as_ref(),
            &form,
        )?;
        let bisection = gpu.gpu_from.map(|from| {
            let twin = Twin::new(flat, form.clone(), seed, offset);
            Bisection { from, twin }
        });
        let mut wavefront = Wavefront {
            bisection,
            runner: Runner::new(device)?,
            in_use: slots.capacity(),
            scene,
            table,
            slots,
            kernels,
            form,
            width,
            textures,
            totals: Totals::default(),
            time: Duration::ZERO,
        };
        pipelines.timed(|| wavefront.run_empty())?;
        // Without the time that this took.
        wavefront.runner = Runner::new(device)?;
        Ok(wavefront)
    }

    /// Runs a wave without a path: some drivers compile a kernel when it first runs, and the
    /// picture's time should not have that in it.
    fn run_empty(&mut self) -> Result<(), GpuError> {
        let nothing = Part {
            first: 0,
            pixels: 1,
            streams: 1,
            width: self.width,
            first_sample: 0,
            end: 0,
        };
        self.slots.reset(&mut self.runner, &nothing)?;
        self.wave().run(&nothing)?;
        self.slots.take_counts().map(|_| ())
    }

    fn wave(&mut self) -> Wave<'_> {
        Wave {
            runner: &mut self.runner,
            scene: &self.scene,
            table: self.table.as_ref(),
            slots: &self.slots,
            kernels: &self.kernels,
            form: &self.form,
        }
    }

    /// Adds samples `range` of every pixel to the film and to `control`; returns early
    /// when that asks to stop.
    ///
    /// # Errors
    /// If the device fails; the film keeps what it has.
    pub fn render(
        &mut self,
        range: Range<u32>,
        control: &Control,
        film: &mut Film,
    ) -> Result<(), GpuError> {
        let start = Instant::now();
        let pixels = film.width() * film.height();
        let mut first = 0;
        while first < pixels && !range.is_empty() {
            let part = Part::new(first, pixels, self.in_use, self.width, &range);
            self.render_part(&part, control)?;
            self.slots.add_to(film, &part, control)?;
            if control.stopped() {
                break;
            }
            first += part.pixels;
        }
        self.time += start.elapsed();
        Ok(())
    }

    /// Renders all samples of a part of the picture into its slots.
    fn render_part(&mut self, part: &Part, control: &Control) -> Result<(), GpuError> {
        let mut part = part.clone();
        self.slots.reset(&mut self.runner, &part)?;
        loop {
            if control.stopped() {
                // What is in flight is left; samples that are done count.
                part.end = part.first_sample;
            }
            let longest = self.run_wave(&part)?;
            let counts = self.slots.take_counts()?;
            self.totals.add(&counts);
            self.adapt(longest);
            if counts.active == 0 || control.stopped() {
                return Ok(());
            }
        }
    }

    /// Some bounces. Returns the time of the longest dispatch, if that is known and matters.
    fn run_wave(&mut self, part: &Part) -> Result<Duration, GpuError> {
        let Some(mut bisection) = self.bisection.take() else {
            return self.wave().run(part);
        };
        let done = self.run_bisected(&mut bisection, part);
        self.bisection = Some(bisection);
        done.map(|()| LONGEST_DISPATCH)
    }

    /// Takes fewer slots for the next part if dispatches took too long.
    fn adapt(&mut self, longest: Duration) {
        if longest > LONGEST_DISPATCH {
            self.in_use = (self.in_use / 2).max(SlotMemory::FEWEST);
        } else if longest < LONGEST_DISPATCH / 4 {
            self.in_use = (self.in_use * 2).min(self.slots.capacity());
        }
    }

    /// Totals so far.
    pub fn statistics(&self) -> WavefrontStatistics {
        let counts = self.table.as_ref().map(table::read_counts);
        self.totals
            .statistics(counts, self.runner.stage_seconds(), self.time)
    }

    /// Memory of images, where they were to be packed.
    pub fn texture_memory(&self) -> Option<TextureMemory> {
        self.textures
    }

    /// Bytes of everything on the device but the cache's table.
    pub fn bytes(&self) -> usize {
        (self.scene.bytes() + self.slots.memory().bytes()) as usize
    }
}

/// Registers that kernels are compiled for: a few sizes, so that kernels are the same for many
/// scenes.
fn registers(needed: usize) -> u32 {
    (needed as u32).next_multiple_of(64).max(64)
}
