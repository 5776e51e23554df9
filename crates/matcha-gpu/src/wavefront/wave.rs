//! Steps of waves as dispatches.

use super::kernels::Kernels;
use super::layout::{
    QUEUE_ACTIVE, QUEUE_ESCAPED, QUEUE_HITS, QUEUE_LAYER_HITS, QUEUE_MISSES, QUEUE_TASKS,
};
use super::stages::{Form, LAYER_QUEUES, Place, Step};
use super::state::{Part, SlotMemory};
use crate::batch::{Batch, BatchTime, Extent, Runner};
use crate::error::GpuError;
use crate::memory::Memory;
use crate::pipeline::Kernel;
use crate::sort::CountingSort;
use std::time::Duration;

/// Everything that a wave runs over.
pub(super) struct Wave<'a> {
    pub runner: &'a mut Runner,
    pub scene: &'a Memory,
    pub table: Option<&'a Memory>,
    pub slots: &'a SlotMemory,
    pub kernels: &'a Kernels,
    pub form: &'a Form,
}

/// Bounces that the host hands over at once where nothing asks it in between.
const BOUNCES: u32 = 4;
/// Layers of transparent surfaces, likewise.
const LAYERS_AT_ONCE: u32 = 10;

impl Wave<'_> {
    /// Some bounces of all paths of a part, finished ones replaced. Returns the time of the
    /// longest dispatch, zero where the device does not tell.
    pub fn run(&mut self, part: &Part) -> Result<Duration, GpuError> {
        if self.form.transparent && self.form.layers > LAYERS_AT_ONCE {
            return self.run_stepwise(part);
        }
        let mut steps = Vec::new();
        for _ in 0..BOUNCES {
            steps.extend(self.form.until_shadows());
            self.form
                .add_layers(LAYER_QUEUES, self.form.layers, &mut steps);
            steps.push(Step::Collect);
        }
        // Counted, so that the host sees what is in flight.
        steps.extend(self.form.regenerate());
        self.run_steps(&steps, part)
    }

    /// One bounce, with the host asking from time to time whether shadow rays are still among
    /// transparent surfaces.
    fn run_stepwise(&mut self, part: &Part) -> Result<Duration, GpuError> {
        let mut time = self.run_steps(&self.form.until_shadows(), part)?;
        let mut queues = LAYER_QUEUES;
        let mut left = self.form.layers;
        while left > 0 && self.slots.count(queues[0])? > 0 {
            let now = left.min(LAYERS_AT_ONCE);
            let mut steps = Vec::new();
            queues = self.form.add_layers(queues, now, &mut steps);
            time = time.max(self.run_steps(&steps, part)?);
            left -= now;
        }
        let mut steps = vec![Step::Collect];
        steps.extend(self.form.regenerate());
        Ok(time.max(self.run_steps(&steps, part)?))
    }

    /// Some steps in one batch. Returns the time of the longest dispatch.
    pub fn run_steps(&mut self, steps: &[Step], part: &Part) -> Result<Duration, GpuError> {
        let recorder = Recorder {
            scene: self.scene,
            table: self.table,
            slots: self.slots,
            kernels: self.kernels,
            form: self.form,
        };
        let mut batch = self.runner.batch();
        for step in steps {
            recorder.record(&mut batch, *step, part)?;
        }
        Ok(longest(&batch.run()?))
    }
}

/// Time of the longest dispatch of a batch, zero where the device does not tell.
fn longest(time: &BatchTime) -> Duration {
    let dispatches = time.dispatches.iter().map(|(_, time)| *time);
    dispatches.max().unwrap_or(Duration::ZERO)
}

/// Records steps into batches.
struct Recorder<'a> {
    scene: &'a Memory,
    table: Option<&'a Memory>,
    slots: &'a SlotMemory,
    kernels: &'a Kernels,
    form: &'a Form,
}

impl Recorder<'_> {
    /// Adds a step's dispatches; none for a step that the form does without.
    fn record(&self, batch: &mut Batch, step: Step, part: &Part) -> Result<(), GpuError> {
        let kernels = self.kernels;
        let (kernel, queue, argument) = match step {
            Step::Measure { queues, empty } => return self.measure(batch, queues, empty),
            Step::Regenerate => {
                self.regenerate(batch, part);
                return Ok(());
            }
            Step::Sort(place) => {
                self.sort_slots(batch, place);
                return Ok(());
            }
            Step::SortMisses => {
                let regions = self.form.regions;
                self.sort(batch, &kernels.sort_misses, QUEUE_MISSES, &[], regions);
                return Ok(());
            }
            Step::Traverse => (Some(&*kernels.traverse), QUEUE_ACTIVE, 0),
            Step::Meet => (Some(&*kernels.meet), QUEUE_ACTIVE, 0),
            Step::Escape => (Some(&*kernels.escape), QUEUE_ESCAPED, 0),
            Step::LookUp(place) => (kernels.look_up.as_deref(), place.queue(), place.at()),
            Step::Misses => {
                let sorted = self.form.sorts_misses().into();
                (kernels.misses.as_deref(), QUEUE_MISSES, sorted)
            }
            Step::Inline(place) => (kernels.inline.as_deref(), place.queue(), place.at()),
            Step::Evaluate(place) => (Some(&*kernels.evaluate), place.queue(), place.at()),
            Step::Shade => (Some(&*kernels.shade), QUEUE_HITS, 0),
            Step::Emit(place) => (Some(&*kernels.emit), place.queue(), place.at()),
            Step::Block => {
                let transparent = self.form.transparent.into();
                (Some(&*kernels.block), QUEUE_TASKS, transparent)
            }
            Step::Layer { from } => (kernels.layer.as_deref(), from, from),
            Step::Pass { to } => (kernels.pass.as_deref(), QUEUE_LAYER_HITS, to),
            Step::Collect => (Some(&*kernels.collect), QUEUE_TASKS, 0),
        };
        if let Some(kernel) = kernel {
            self.over(batch, step, kernel, queue, argument);
        }
        Ok(())
    }

    fn memories(&self) -> [&Memory; 2] {
        [self.scene, self.slots.memory()]
    }

    /// As many invocations as there are in a queue.
    fn extent(&self, queue: u32) -> Extent<'_> {
        Extent::Indirect(self.slots.sizes(), u64::from(queue) * 12)
    }

    /// A dispatch over a queue, bound to the table if the kernel reaches into it.
    fn over(&self, batch: &mut Batch, step: Step, kernel: &Kernel, queue: u32, argument: u32) {
        let [scene, slots] = self.memories();
        let mut memories = vec![scene, slots];
        if matches!(step, Step::LookUp(_) | Step::Misses | Step::Inline(_)) {
            memories.extend(self.table);
        }
        let extent = self.extent(queue);
        batch.dispatch(step.timed_as(), kernel, &memories, &[argument], extent);
    }

    fn regenerate(&self, batch: &mut Batch, part: &Part) {
        let (stage, kernel) = (Step::Regenerate.timed_as(), &self.kernels.regenerate);
        let extent = Extent::Items(part.slots());
        batch.dispatch(stage, kernel, &self.memories(), &part.arguments(), extent);
    }

    fn sort_slots(&self, batch: &mut Batch, place: Place) {
        let programs = self.form.programs;
        let arguments = [place.at(), programs];
        // One key more for what has no program.
        let sort = &self.kernels.sort_slots;
        self.sort(batch, sort, place.queue(), &arguments, programs + 1);
    }

    fn sort(
        &self,
        batch: &mut Batch,
        sort: &Option<CountingSort>,
        queue: u32,
        arguments: &[u32],
        keys: u32,
    ) {
        if let Some(sort) = sort {
            sort.dispatch(batch, &self.memories(), arguments, keys, self.extent(queue));
        }
    }

    fn measure(&self, batch: &mut Batch, queues: u32, empty: u32) -> Result<(), GpuError> {
        let step = Step::Measure { queues, empty };
        let arguments = [queues, empty];
        let extent = Extent::Items(1);
        let kernel = &self.kernels.measure;
        batch.dispatch(
            step.timed_as(),
            kernel,
            &self.memories(),
            &arguments,
            extent,
        );
        if queues == 0 {
            return Ok(());
        }
        self.slots.copy_sizes(batch)
    }
}
