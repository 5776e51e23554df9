//! The machine: runs a program over a group of hits, a word at a time over 16 lanes.
//!
//! For every region it asks the cache for the whole group at once, evaluates the
//! region's words over the hits that were not found, put together without gaps, at
//! their virtual texels' centres, and stores their values. Then the other words run over all
//! hits. A result depends only on the hit's own inputs, bit for bit: not on the other
//! hits of the group, their number or order, nor on the instruction set.

mod core;
pub mod kernel;
mod region;
pub mod scalar;
mod tables;
mod texels;

use kernel::Kernel;
pub use kernel::{Isa, LANES};

pub use crate::rows::Rows;

pub use texels::{Texel, Texels};

use self::core::Core;
use self::region::Cached;
use crate::graph::TextureRef;
use crate::ops;
use crate::program::{Program, Region};

/// Images, for the machine.
pub trait Textures {
    /// Samples `n` points. Every slice holds `n` numbers: coordinates, their change
    /// along the footprint's two axes, and the result (linear colour, alpha).
    fn sample(
        &self,
        texture: TextureRef,
        n: usize,
        uv: [&[f32]; 2],
        da: [&[f32]; 2],
        db: [&[f32]; 2],
        out: [&mut [f32]; 4],
    );
}

/// The material cache, for the machine. One material's: [`CachedValue::node`] numbers its
/// nodes.
///
/// [`CachedValue::node`]: crate::program::CachedValue::node
pub trait NodeCache {
    /// Looks a region's values up at all texels. Where all of them are found, `found`
    /// becomes true and the column of `out` the values (a row for each component, value
    /// after value).
    fn look_up(&mut self, region: &Region, texels: &Texels, out: &mut Rows, found: &mut [bool]);

    /// Stores what was not found: the values at texel `which[k]` are column k, and become
    /// what a look-up would give, so that it does not matter who came first.
    fn store(&mut self, region: &Region, texels: &Texels, which: &[u32], values: &mut Rows);
}

/// What a run did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RunCounts {
    /// Look-ups in the cache: hits times regions.
    pub look_ups: u64,
    /// Of those, found.
    pub found: u64,
    /// Image samples.
    pub texture_samples: u64,
}

/// Registers and scratch memory of one thread.
pub struct Machine {
    isa: Isa,
    kernels: Vec<Kernel>,
    registers: Rows,
    cached: Cached,
}

impl Machine {
    /// A machine for an instruction set, or for the best that this processor has.
    /// One that the processor lacks is replaced by the best.
    pub fn new(isa: Option<Isa>) -> Self {
        let available = Isa::available();
        let isa = isa.filter(|i| available.contains(i)).unwrap_or(Isa::best());
        let kernels = ops::all()
            .map(|op| isa.kernel(&op.info().kernels))
            .collect();
        Machine {
            isa,
            kernels,
            registers: Rows::default(),
            cached: Cached::default(),
        }
    }

    /// Puts another kernel in an operation's place, for tests that must fail.
    #[cfg(test)]
    pub(crate) fn replace_kernel(&mut self, op: ops::OpCode, kernel: Kernel) {
        self.kernels[op.0 as usize] = kernel;
    }

    /// The instruction set in use.
    pub fn isa(&self) -> Isa {
        self.isa
    }

    /// Runs a program over `n` hits. `inputs` has the program's input rows, `texels` what
    /// [`Texels::of_regions`] made of them; `out` is given the program's output rows (for
    /// each closure: weight, then parameters). Without a cache the regions of a program
    /// are evaluated at their virtual texels all the same, for every hit.
    ///
    /// # Panics
    /// If `inputs` has fewer rows or points than asked for, or `texels` are not this
    /// program's and group's.
    #[allow(clippy::too_many_arguments)]
    pub fn run(
        &mut self,
        program: &Program,
        n: usize,
        inputs: &Rows,
        texels: &[Texels],
        textures: &dyn Textures,
        cache: Option<&mut dyn NodeCache>,
        out: &mut Rows,
    ) -> RunCounts {
        assert!(inputs.rows() >= program.input_rows(), "rows of the inputs");
        assert!(
            inputs.points() >= n || program.input_rows() == 0,
            "points of the inputs"
        );
        assert!(
            texels.len() >= program.regions().len(),
            "texels for each region"
        );
        out.resize(program.output_rows(), n);
        let mut counts = RunCounts::default();
        if n == 0 {
            return counts;
        }
        let Machine {
            isa,
            kernels,
            registers,
            cached,
        } = self;
        registers.resize(1, program.slots() * LANES);
        let group = Group {
            program,
            n,
            inputs,
            texels,
            textures,
        };
        let registers = registers.row_mut(0);
        // So that a test sees it if a word reads what a skipped region did not write.
        #[cfg(debug_assertions)]
        registers.fill(f32::NAN);
        if *isa == Isa::Scalar {
            run_group::<1>(&group, kernels, registers, cached, cache, out, &mut counts);
        } else {
            run_group::<LANES>(&group, kernels, registers, cached, cache, out, &mut counts);
        }
        counts
    }
}

/// One call of [`Machine::run`].
struct Group<'a> {
    program: &'a Program,
    n: usize,
    inputs: &'a Rows,
    texels: &'a [Texels],
    textures: &'a dyn Textures,
}

fn run_group<const N: usize>(
    group: &Group,
    kernels: &[Kernel],
    registers: &mut [f32],
    cached: &mut Cached,
    mut cache: Option<&mut dyn NodeCache>,
    out: &mut Rows,
    counts: &mut RunCounts,
) {
    let program = group.program;
    let mut core = Core::<N>::new(program, kernels, registers, group.textures);
    cached.prepare(program.regions().len());
    for (region, texels) in program.regions().iter().zip(group.texels) {
        assert_eq!(texels.len(), group.n, "a texel for each point");
        // A reborrow that the loop can repeat.
        let cache = cache.as_mut().map(|c| &mut **c as &mut dyn NodeCache);
        cached.run(region, texels, &mut core, cache, counts);
    }
    let words = program.rest()..program.words().len();
    for start in (0..group.n).step_by(N) {
        let active = N.min(group.n - start);
        for &row in program.loads() {
            let row = row as usize;
            core.load(row, &group.inputs.row(row)[start..], active);
        }
        for (region, values) in program.regions().iter().zip(&cached.results) {
            let mut rows = 0..region.width();
            for value in &region.values {
                let first = value.result as usize;
                for (register, row) in (first..first + value.ty.width()).zip(&mut rows) {
                    core.load(register, &values.row(row)[start..], active);
                }
            }
        }
        core.execute(words.clone(), active);
        for (row, &operand) in out
            .rows_mut(0, program.output_rows())
            .zip(program.outputs())
        {
            row[start..start + N].copy_from_slice(core.value(operand));
        }
    }
    counts.texture_samples += core.texture_samples;
}
