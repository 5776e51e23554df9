//! A table on a device, and kernels that insert numbered keys and look them up. The tests and the
//! example use a part each.
#![allow(dead_code)]

use matcha_cache::{NodeSeed, TableSize, node_seed};
use matcha_gpu::batch::{BatchTime, Extent, Runner};
use matcha_gpu::device::Device;
use matcha_gpu::memory::{Memory, Sections};
use matcha_gpu::pipeline::{KernelSource, Pipelines};
use matcha_gpu::shader::Library;
use matcha_gpu::table::{self, TableCounts};
use matcha_gpu::{GpuError, table::sections};

/// Which protocol entries are written by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Protocol {
    /// Claimed, then published: two words of 32 bits.
    Words,
    /// One compare-and-swap of 64 bits.
    Long,
}

impl Protocol {
    /// Those that a device can run.
    pub fn of(device: &Device) -> Vec<Protocol> {
        let mut all = vec![Protocol::Words];
        all.extend(device.has_atomics_64().then_some(Protocol::Long));
        all
    }

    /// All WGSL, with the trial's kernels.
    pub fn library(self) -> Result<Library, GpuError> {
        let mut library = Library::embedded(self == Protocol::Long)?;
        library.add("trial.wgsl", include_str!("trial.wgsl"))?;
        Ok(library)
    }
}

/// The node whose texels are the keys.
pub fn node() -> NodeSeed {
    node_seed(3, 5, 0)
}

/// The texel of a key: level and indices. `trial.wgsl` makes the same.
pub fn texel(key: u32) -> [i32; 3] {
    [
        (key % 5) as i32 - 2,
        (key / 5 % 1000) as i32 - 500,
        (key / 5000) as i32 - 3,
    ]
}

/// What a kernel of the trial is to do.
#[derive(Clone, Copy)]
pub struct Work {
    /// The kernel.
    pub kernel: &'static str,
    /// Different keys.
    pub keys: u32,
    /// Invocations.
    pub invocations: u32,
    /// Added to an invocation's number, which its values tell.
    pub writer: u32,
}

/// A table and what the kernels tell of it.
pub struct Trial {
    device: Device,
    library: Library,
    pipelines: Pipelines,
    table: Memory,
    report: Memory,
}

impl Trial {
    /// An empty table in bindings of at most so many bytes, and room for what `found` look-ups give.
    pub fn new(
        device: &Device,
        library: Library,
        size: TableSize,
        binding_bytes: u64,
        found: u32,
    ) -> Result<Trial, GpuError> {
        let mut table = sections(&library, size)?;
        table.limit_bindings(binding_bytes);
        let table = table.place(device, 2, &[])?;
        let mut report = Sections::new();
        report.zeroed(&library, "trial_found", 2 * u64::from(found))?;
        report.zeroed(&library, "trial_faults", 3)?;
        let report = report.place(device, 1, &[&table])?;
        Ok(Trial {
            device: device.clone(),
            library,
            pipelines: Pipelines::new(device, None),
            table,
            report,
        })
    }

    /// Runs kernels one after the other.
    pub fn run(&self, works: &[Work]) -> Result<BatchTime, GpuError> {
        let mut runner = Runner::new(&self.device)?;
        let mut batch = runner.batch();
        let memories = [&self.report, &self.table];
        for work in works {
            let kernel = self.pipelines.kernel(&KernelSource {
                name: work.kernel,
                library: &self.library,
                memories: &memories,
                constants: &[],
            })?;
            let NodeSeed { a, b, own } = node();
            let arguments = [a, b, own, work.keys, work.invocations, work.writer];
            let extent = Extent::Items(work.invocations);
            batch.dispatch(work.kernel, &kernel, &memories, &arguments, extent);
        }
        batch.run()
    }

    /// Looks keys up; what is found of each.
    pub fn look_up(&self, keys: u32) -> Result<Vec<Option<u32>>, GpuError> {
        self.run(&[Work {
            kernel: "trial_look_up",
            keys,
            invocations: keys,
            writer: 0,
        }])?;
        let length = self.report.length("trial_found")? / 2;
        let found = self.report.read("trial_found", 0, u64::from(keys))?;
        let words = self.report.read("trial_found", length, u64::from(keys))?;
        let pairs = found.into_iter().zip(words);
        Ok(pairs
            .map(|(found, word)| (found != 0).then_some(word))
            .collect())
    }

    /// Values of other keys, values that changed, keys that went.
    pub fn faults(&self) -> Result<[u32; 3], GpuError> {
        let faults = self.report.read("trial_faults", 0, 3)?;
        Ok([faults[0], faults[1], faults[2]])
    }

    /// What the table counted.
    pub fn counts(&self) -> Result<TableCounts, GpuError> {
        table::counts(&self.table)
    }

    /// Entries that hold something.
    pub fn occupied(&self) -> Result<u64, GpuError> {
        table::count_occupied(&self.table)
    }

    /// Empties the table.
    pub fn clear(&self) -> Result<(), GpuError> {
        let mut runner = Runner::new(&self.device)?;
        let mut batch = runner.batch();
        table::clear(&self.table, batch.commands())?;
        batch.run().map(|_| ())
    }
}
