//! From a lowered material to a program.

use crate::cacheability;
use crate::emit::emit;
use crate::graph::NodeId;
use crate::material::MaterialGraph;
use crate::opt::{self, Network, Optimise};
use crate::program::{Program, ProgramError};
use crate::vm::Isa;

/// Estimated costs, ns a point in lanes, of what is not an operation of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CostModel {
    /// What the table's costs (measured with AVX-512) are multiplied by.
    pub operation_scale: f32,
    /// A look-up of a virtual texel's cell in the material cache, and the share of its
    /// misses. The nodes of a UV set are cached if they cost more together.
    /// With 0 every highest node is cached, as in the paper.
    pub lookup_ns: f32,
    /// Finding and decoding one node's value in the cell. A node is cached if it adds more.
    pub value_ns: f32,
    /// An image look-up.
    pub texture_ns: f32,
    /// A ramp's or curve's look-up.
    pub table_ns: f32,
}

impl CostModel {
    /// Costs on an instruction set. The scales are the ratios of the networks in
    /// `docs/results/machine.md`.
    pub fn of(isa: Isa) -> Self {
        let operation_scale = match isa {
            Isa::Avx512 => 1.0,
            Isa::Avx2 => 1.9,
            Isa::Baseline => 10.0,
            Isa::Scalar => 25.0,
        };
        CostModel {
            operation_scale,
            lookup_ns: 40.0,
            value_ns: 6.0,
            texture_ns: 80.0,
            table_ns: 3.0,
        }
    }
}

impl Default for CostModel {
    /// Of the processor's best instruction set, which is the one that a machine uses.
    fn default() -> Self {
        CostModel::of(Isa::best())
    }
}

/// How to compile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Whether cacheable nodes get regions.
    pub cache: bool,
    /// How far the graph is optimised.
    pub optimise: Optimise,
    /// Costs.
    pub cost: CostModel,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            cache: true,
            optimise: Optimise::default(),
            cost: CostModel::default(),
        }
    }
}

/// A graph's size after a pass.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PassStatistics {
    /// The pass.
    pub pass: &'static str,
    /// Nodes that the closures need.
    pub nodes: usize,
    /// Those of them that are operations, images or table look-ups.
    pub operations: usize,
}

/// A program and how it came about.
#[derive(Clone, Debug)]
pub struct Compiled {
    /// What the machine runs.
    pub program: Program,
    /// What it was emitted from.
    pub network: Network,
    /// The network's nodes that are looked up, in the order of the regions' values, each
    /// with its UV set.
    pub cached: Vec<(NodeId, u16)>,
    /// Sizes, in order of the passes.
    pub passes: Vec<PassStatistics>,
}

/// Compiles a material.
pub fn compile(material: &MaterialGraph, options: &Options) -> Result<Compiled, ProgramError> {
    let (mut network, passes) = opt::optimise(material, options.optimise);
    let cached = if options.cache {
        network = cacheability::split_wide(&network);
        cacheability::choose(&network, &options.cost)
    } else {
        Vec::new()
    };
    let program = emit(&network, &cached, options, &material.name, material.kind)?;
    Ok(Compiled {
        program,
        network,
        cached,
        passes,
    })
}
