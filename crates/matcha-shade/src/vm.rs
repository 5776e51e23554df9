//! The machine: runs a program over a group of hits, a word at a time over 16 lanes.
//!
//! For every region it asks the cache for the whole group at once, evaluates the
//! region's words over the hits that were not found, put together without gaps, at
//! their virtual texels' centres, and stores them. Then the other words run over all
//! hits. A result depends only on the hit's own inputs, bit for bit: not on the other
//! hits of the group, their number or order, nor on the instruction set.

mod core;
pub mod kernel;
mod region;
pub mod scalar;
mod tables;

use kernel::Kernel;
pub use kernel::{Isa, LANES};

pub use crate::rows::Rows;

use self::core::Core;
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

/// A square of size 2^-level on the unbounded plane of a UV set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Texel {
    /// λ; larger is finer.
    pub level: i32,
    /// Position along u, in texels.
    pub i: i32,
    /// Position along v, in texels.
    pub j: i32,
}

/// The material cache, for the machine. One material's: `Region::node` numbers its nodes.
pub trait NodeCache {
    /// Looks all texels up. Where one is found, its `found` becomes true and its column
    /// of `out` (as many rows as the region's type has) the value.
    fn look_up(&mut self, region: &Region, texels: &[Texel], out: &mut Rows, found: &mut [bool]);

    /// Stores what was not found: the value of `texels[which[k]]` is column k.
    fn store(&mut self, region: &Region, texels: &[Texel], which: &[u32], values: &Rows);
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

/// Scratch memory of the regions of a run.
#[derive(Default)]
struct Cached {
    /// Results of all regions, over the whole group.
    results: Rows,
    /// One region's values as the cache gave them.
    values: Rows,
    /// Values of the points that were not found, without gaps.
    computed: Rows,
    texels: Vec<Texel>,
    found: Vec<bool>,
    missed: Vec<u32>,
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

    /// Runs a program over `n` hits. `inputs` has the program's input rows; `out` is
    /// given its output rows (for each closure: weight, then parameters). Without a
    /// cache the regions of a program are evaluated at their virtual texels all the
    /// same, for every hit. `level_offset` is added to λ.
    ///
    /// # Panics
    /// If `inputs` has fewer rows or points than asked for.
    #[allow(clippy::too_many_arguments)]
    pub fn run(
        &mut self,
        program: &Program,
        n: usize,
        inputs: &Rows,
        textures: &dyn Textures,
        cache: Option<&mut dyn NodeCache>,
        level_offset: f32,
        out: &mut Rows,
    ) -> RunCounts {
        assert!(inputs.rows() >= program.input_rows(), "rows of the inputs");
        assert!(
            inputs.points() >= n || program.input_rows() == 0,
            "points of the inputs"
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
            textures,
            level_offset,
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
    textures: &'a dyn Textures,
    level_offset: f32,
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
    let width = program.regions().iter().map(|r| r.ty.width()).sum();
    cached.results.resize(width, group.n);
    let mut first = 0;
    for region in program.regions() {
        // A reborrow that the loop can repeat.
        let cache = cache.as_mut().map(|c| &mut **c as &mut dyn NodeCache);
        region::run(group, region, &mut core, cached, cache, first, counts);
        first += region.ty.width();
    }
    let words = program.rest()..program.words().len();
    for start in (0..group.n).step_by(N) {
        let active = N.min(group.n - start);
        for row in 0..program.input_rows() {
            core.load(row, &group.inputs.row(row)[start..], active);
        }
        let mut row = 0;
        for region in program.regions() {
            for i in 0..region.ty.width() {
                core.load(
                    region.result as usize + i,
                    &cached.results.row(row)[start..],
                    active,
                );
                row += 1;
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
