//! The stages of a wave, in order.

use super::state::{Part, QUEUES, SlotMemory};
use crate::batch::{Batch, BatchTime, Extent, Runner};
use crate::error::GpuError;
use crate::memory::Memory;
use crate::pipeline::{Kernel, KernelSource, Pipelines};
use crate::shader::Library;
use crate::sort::CountingSort;
use std::sync::Arc;
use std::time::Duration;

/// Queues, as `wave_state.wgsl` numbers them.
mod queue {
    pub const ACTIVE: u32 = 0;
    pub const HITS: u32 = 1;
    pub const ESCAPED: u32 = 2;
    pub const TASKS: u32 = 3;
    pub const EMITTERS: u32 = 4;
    pub const WORLD_TASKS: u32 = 5;
    pub const LIGHT_TASKS: u32 = 6;
    pub const LAYERS: u32 = 7;
    pub const LAYER_HITS: u32 = 8;
    pub const LAYERS_NEXT: u32 = 9;
    pub const MISSES: u32 = 10;
}

/// Where networks are evaluated, as `wave_networks.wgsl` numbers it, with the queue of slots.
#[derive(Clone, Copy)]
struct Place {
    at: u32,
    queue: u32,
    /// On a surface: programs have regions, and cached values.
    surface: bool,
}

const HITS: Place = Place {
    at: 0,
    queue: queue::HITS,
    surface: true,
};
const EMITTERS: Place = Place {
    at: 1,
    queue: queue::EMITTERS,
    surface: true,
};
const LAYERS: Place = Place {
    at: 2,
    queue: queue::LAYER_HITS,
    surface: true,
};
const ESCAPED: Place = Place {
    at: 3,
    queue: queue::ESCAPED,
    surface: false,
};
const WORLD_TASKS: Place = Place {
    at: 4,
    queue: queue::WORLD_TASKS,
    surface: false,
};
const LIGHT_TASKS: Place = Place {
    at: 5,
    queue: queue::LIGHT_TASKS,
    surface: false,
};

/// What a rendering needs of the stages.
#[derive(Clone, Debug)]
pub(super) struct Form {
    /// Values of nodes are kept.
    pub cached: bool,
    /// Hits look up and evaluate what is missing in one kernel.
    pub inline: bool,
    /// The world has a program.
    pub world: bool,
    /// Some light has one.
    pub light_programs: bool,
    /// Shadow rays pass transparent surfaces.
    pub transparent: bool,
    /// Most transparent surfaces on the way of a shadow ray.
    pub layers: u32,
    /// Hits and misses are sorted by what is to be evaluated.
    pub sorted: bool,
    /// Number of programs.
    pub programs: u32,
    /// Number of regions of all programs.
    pub regions: u32,
}

/// The kernels that a form needs.
pub(super) struct Kernels {
    measure: Arc<Kernel>,
    regenerate: Arc<Kernel>,
    traverse: Arc<Kernel>,
    meet: Arc<Kernel>,
    escape: Arc<Kernel>,
    evaluate: Arc<Kernel>,
    look_up: Option<Arc<Kernel>>,
    misses: Option<Arc<Kernel>>,
    inline: Option<Arc<Kernel>>,
    shade: Arc<Kernel>,
    emit: Arc<Kernel>,
    block: Arc<Kernel>,
    layer: Option<Arc<Kernel>>,
    pass: Option<Arc<Kernel>>,
    collect: Arc<Kernel>,
    sort_slots: Option<CountingSort>,
    sort_misses: Option<CountingSort>,
}

impl Kernels {
    /// Compiles them.
    pub(super) fn new(
        pipelines: &Pipelines,
        library: &Library,
        scene: &Memory,
        slots: &Memory,
        table: Option<&Memory>,
        form: &Form,
    ) -> Result<Kernels, GpuError> {
        let kernel = |name: &str, memories: &[&Memory]| {
            pipelines.kernel(&KernelSource {
                name,
                library,
                memories,
                constants: &[],
            })
        };
        let plain = |name: &str| kernel(name, &[scene, slots]);
        let cached = |name, wanted: bool| match table {
            Some(table) if wanted => kernel(name, &[scene, slots, table]).map(Some),
            _ => Ok(None),
        };
        let optional = |name, wanted: bool| wanted.then(|| plain(name)).transpose();
        let sort = |count, place, wanted: bool| {
            let sort = || CountingSort::new(count, place, plain);
            wanted.then(sort).transpose()
        };
        let sort_slots = form.sorted && form.programs > 1;
        let sort_misses = form.sorted && form.regions > 1 && form.cached && !form.inline;
        Ok(Kernels {
            sort_slots: sort("wave_sort_slots", "wave_place_slots", sort_slots)?,
            sort_misses: sort("wave_sort_misses", "wave_place_misses", sort_misses)?,
            measure: plain("wave_measure")?,
            regenerate: plain("wave_regenerate")?,
            traverse: plain("wave_traverse")?,
            meet: plain(if form.light_programs {
                "wave_meet_trees"
            } else {
                "wave_meet"
            })?,
            escape: plain(if form.light_programs {
                "wave_escape_trees"
            } else {
                "wave_escape"
            })?,
            evaluate: plain("wave_evaluate")?,
            look_up: cached("wave_look_up", !form.inline)?,
            misses: cached("wave_misses", !form.inline)?,
            inline: cached("wave_inline", form.inline)?,
            shade: plain("wave_shade")?,
            emit: plain("wave_emit")?,
            block: plain("wave_block")?,
            layer: optional("wave_layer", form.transparent)?,
            pass: optional("wave_pass", form.transparent)?,
            collect: plain("wave_collect")?,
        })
    }
}

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

impl<'a> Wave<'a> {
    fn stages(&self) -> Stages<'a> {
        Stages {
            scene: self.scene,
            table: self.table,
            slots: self.slots,
            kernels: self.kernels,
            form: self.form,
        }
    }

    /// Some bounces of all paths of a part, finished ones replaced. Returns the time of the
    /// longest dispatch, zero where the device does not tell.
    pub(super) fn run(&mut self, part: &Part) -> Result<Duration, GpuError> {
        let stages = self.stages();
        if self.form.transparent && self.form.layers > LAYERS_AT_ONCE {
            return self.run_stepwise(part);
        }
        let mut batch = self.runner.batch();
        for _ in 0..BOUNCES {
            stages.until_shadows(&mut batch, part)?;
            stages.layers(
                &mut batch,
                [queue::LAYERS, queue::LAYERS_NEXT],
                self.form.layers,
            )?;
            stages.collect(&mut batch);
        }
        // Counted, so that the host sees what is in flight.
        stages.regenerate(&mut batch, part);
        Ok(longest(&batch.run()?))
    }

    /// One bounce, with the host asking from time to time whether shadow rays are still among
    /// transparent surfaces.
    fn run_stepwise(&mut self, part: &Part) -> Result<Duration, GpuError> {
        let stages = self.stages();
        let mut batch = self.runner.batch();
        stages.until_shadows(&mut batch, part)?;
        let mut time = longest(&batch.run()?);
        let mut queues = [queue::LAYERS, queue::LAYERS_NEXT];
        let mut left = self.form.layers;
        while left > 0 && self.slots.count(queues[0])? > 0 {
            let now = left.min(LAYERS_AT_ONCE);
            let mut batch = self.runner.batch();
            queues = stages.layers(&mut batch, queues, now)?;
            time = time.max(longest(&batch.run()?));
            left -= now;
        }
        let mut batch = self.runner.batch();
        stages.collect(&mut batch);
        stages.regenerate(&mut batch, part);
        Ok(time.max(longest(&batch.run()?)))
    }
}

/// Time of the longest dispatch of a batch, zero where the device does not tell.
fn longest(time: &BatchTime) -> Duration {
    let dispatches = time.dispatches.iter().map(|(_, time)| *time);
    dispatches.max().unwrap_or(Duration::ZERO)
}

/// Records stages into batches.
struct Stages<'a> {
    scene: &'a Memory,
    table: Option<&'a Memory>,
    slots: &'a SlotMemory,
    kernels: &'a Kernels,
    form: &'a Form,
}

/// The bits of queues.
fn bits(queues: &[u32]) -> u32 {
    queues.iter().fold(0, |bits, queue| bits | 1 << queue)
}

impl Stages<'_> {
    fn memories(&self) -> [&Memory; 2] {
        [self.scene, self.slots.memory()]
    }

    /// A dispatch over a queue.
    fn over(
        &self,
        batch: &mut Batch,
        stage: &'static str,
        kernel: &Kernel,
        queue: u32,
        argument: u32,
    ) {
        let extent = Extent::Indirect(self.slots.sizes(), u64::from(queue) * 12);
        batch.dispatch(stage, kernel, &self.memories(), &[argument], extent);
    }

    /// The same for a kernel that reaches into the table.
    fn over_cached(
        &self,
        batch: &mut Batch,
        stage: &'static str,
        kernel: &Kernel,
        queue: u32,
        argument: u32,
    ) {
        let Some(table) = self.table else { return };
        let [scene, slots] = self.memories();
        let extent = Extent::Indirect(self.slots.sizes(), u64::from(queue) * 12);
        batch.dispatch(stage, kernel, &[scene, slots, table], &[argument], extent);
    }

    /// Sorts a queue.
    fn sort(
        &self,
        batch: &mut Batch,
        sort: &CountingSort,
        queue: u32,
        arguments: &[u32],
        keys: u32,
    ) {
        let extent = Extent::Indirect(self.slots.sizes(), u64::from(queue) * 12);
        sort.dispatch(batch, &self.memories(), arguments, keys, extent);
    }

    /// Makes the sizes of dispatches over queues, and empties others.
    fn measure(&self, batch: &mut Batch, queues: &[u32], empty: &[u32]) -> Result<(), GpuError> {
        let arguments = [bits(queues), bits(empty)];
        let kernel = &self.kernels.measure;
        batch.dispatch(
            "queues",
            kernel,
            &self.memories(),
            &arguments,
            Extent::Items(1),
        );
        let memory = self.slots.memory();
        memory.copy(
            batch.commands(),
            "wave_sizes",
            0,
            3 * QUEUES,
            self.slots.sizes(),
        )
    }

    fn regenerate(&self, batch: &mut Batch, part: &Part) {
        // Counts of the last bounce are no longer needed.
        let empty = [bits(&[]), (1 << QUEUES) - 1];
        batch.dispatch(
            "queues",
            &self.kernels.measure,
            &self.memories(),
            &empty,
            Extent::Items(1),
        );
        let extent = Extent::Items(part.slots());
        batch.dispatch(
            "regenerate",
            &self.kernels.regenerate,
            &self.memories(),
            &part.arguments(),
            extent,
        );
    }

    /// All stages up to shadow rays among opaque surfaces.
    fn until_shadows(&self, batch: &mut Batch, part: &Part) -> Result<(), GpuError> {
        let kernels = self.kernels;
        self.regenerate(batch, part);
        self.measure(batch, &[queue::ACTIVE], &[])?;
        self.over(batch, "traverse", &kernels.traverse, queue::ACTIVE, 0);
        self.over(batch, "lights", &kernels.meet, queue::ACTIVE, 0);
        self.measure(batch, &[queue::HITS, queue::ESCAPED], &[])?;
        if self.form.world {
            self.networks(batch, ESCAPED)?;
        }
        self.over(batch, "lights", &kernels.escape, queue::ESCAPED, 0);
        self.networks(batch, HITS)?;
        self.over(batch, "shade", &kernels.shade, queue::HITS, 0);
        let waiting = [
            queue::TASKS,
            queue::EMITTERS,
            queue::WORLD_TASKS,
            queue::LIGHT_TASKS,
        ];
        self.measure(batch, &waiting, &[])?;
        self.emitters(batch)?;
        self.over(
            batch,
            "shadow",
            &kernels.block,
            queue::TASKS,
            self.form.transparent.into(),
        );
        Ok(())
    }

    /// What shadow rays bring.
    fn collect(&self, batch: &mut Batch) {
        self.over(batch, "accumulate", &self.kernels.collect, queue::TASKS, 0);
    }

    /// Evaluates programs at a place.
    fn networks(&self, batch: &mut Batch, place: Place) -> Result<(), GpuError> {
        let kernels = self.kernels;
        if let Some(sort) = kernels.sort_slots.as_ref().filter(|_| place.surface) {
            let programs = self.form.programs;
            // One more for what has none.
            self.sort(
                batch,
                sort,
                place.queue,
                &[place.at, programs],
                programs + 1,
            );
        }
        if place.surface && self.form.cached {
            if let Some(inline) = &kernels.inline {
                self.over_cached(batch, "evaluate", inline, place.queue, place.at);
                return Ok(());
            }
            if let (Some(look_up), Some(misses)) = (&kernels.look_up, &kernels.misses) {
                self.over_cached(batch, "lookup", look_up, place.queue, place.at);
                self.measure(batch, &[queue::MISSES], &[])?;
                if let Some(sort) = &kernels.sort_misses {
                    self.sort(batch, sort, queue::MISSES, &[], self.form.regions);
                }
                let sorted = kernels.sort_misses.is_some().into();
                self.over_cached(batch, "misses", misses, queue::MISSES, sorted);
                self.measure(batch, &[], &[queue::MISSES])?;
            }
        }
        self.over(batch, "evaluate", &kernels.evaluate, place.queue, place.at);
        Ok(())
    }

    /// The radiance of sampled lights that is not known.
    fn emitters(&self, batch: &mut Batch) -> Result<(), GpuError> {
        let mut places = vec![EMITTERS];
        places.extend(self.form.world.then_some(WORLD_TASKS));
        places.extend(self.form.light_programs.then_some(LIGHT_TASKS));
        for place in places {
            self.networks(batch, place)?;
            self.over(batch, "shade", &self.kernels.emit, place.queue, place.at);
        }
        Ok(())
    }

    /// Some transparent surfaces on the way of shadow rays, one layer after the other: of those
    /// in the first queue, into the second and back. Returns them in the order for going on.
    fn layers(
        &self,
        batch: &mut Batch,
        mut queues: [u32; 2],
        count: u32,
    ) -> Result<[u32; 2], GpuError> {
        let (Some(layer), Some(pass)) = (&self.kernels.layer, &self.kernels.pass) else {
            return Ok(queues);
        };
        for _ in 0..count {
            let [from, to] = queues;
            self.measure(batch, &[from], &[to, queue::LAYER_HITS])?;
            self.over(batch, "shadow", layer, from, from);
            self.measure(batch, &[queue::LAYER_HITS], &[])?;
            self.networks(batch, LAYERS)?;
            self.over(batch, "shade", pass, queue::LAYER_HITS, to);
            queues = [to, from];
        }
        Ok(queues)
    }
}
