//! The optimiser: passes over a material's values and weighted closures. Each rebuilds
//! the graph; none changes a value by more than the operations' stated errors, except
//! where a value is infinite or not a number (0·x is taken to be 0).

pub mod closures;
pub mod common_subexpressions;
pub mod dead_code;
pub mod flatten;
pub mod fold;
pub mod simplify;

use crate::closure::ClosureKind;
use crate::compile::PassStatistics;
use crate::graph::{Graph, Node, NodeId, NodeKind};
use crate::material::MaterialGraph;

/// A closure with everything above it multiplied into its weight.
#[derive(Clone, Debug, PartialEq)]
pub struct WeightedClosure {
    /// Which.
    pub kind: ClosureKind,
    /// F3: colour, strength and mix factors.
    pub weight: NodeId,
    /// In the kind's order.
    pub params: Vec<NodeId>,
}

/// Values and what is made of them.
#[derive(Clone, Debug, Default)]
pub struct Network {
    /// The values.
    pub graph: Graph,
    /// The closures, in the order that the renderer sees them.
    pub closures: Vec<WeightedClosure>,
}

impl Network {
    /// The values that the closures read: weight, then parameters, closure by closure.
    pub fn outputs(&self) -> impl Iterator<Item = NodeId> + '_ {
        self.closures
            .iter()
            .flat_map(|c| std::iter::once(c.weight).chain(c.params.iter().copied()))
    }

    /// Whether each node is needed for an output.
    pub fn live(&self) -> Vec<bool> {
        let mut live = vec![false; self.graph.nodes().len()];
        for id in self.outputs() {
            live[id.index()] = true;
        }
        for id in self.graph.ids().rev() {
            if live[id.index()] {
                for input in &self.graph.node(id).inputs {
                    live[input.index()] = true;
                }
            }
        }
        live
    }

    /// The network's size.
    pub fn statistics(&self, pass: &'static str) -> PassStatistics {
        let live = self.live();
        let needed = || self.graph.ids().filter(|id| live[id.index()]);
        PassStatistics {
            pass,
            nodes: needed().count(),
            operations: needed()
                .filter(|&id| is_operation(&self.graph.node(id).kind))
                .count(),
        }
    }
}

/// Whether a node becomes a word.
pub fn is_operation(kind: &NodeKind) -> bool {
    matches!(
        kind,
        NodeKind::Apply(..) | NodeKind::Texture(_) | NodeKind::Table(_)
    )
}

/// Rebuilds a network: `step` gets each live node, its inputs already those of the new
/// graph, and says which node of the new graph has its value.
pub(crate) fn rewrite(
    network: &Network,
    mut step: impl FnMut(&mut Graph, Node) -> NodeId,
) -> Network {
    let live = network.live();
    let mut graph = network.graph.without_nodes();
    let mut moved = vec![NodeId(0); live.len()];
    for id in network.graph.ids().filter(|id| live[id.index()]) {
        let mut node = network.graph.node(id).clone();
        for input in &mut node.inputs {
            *input = moved[input.index()];
        }
        graph.set_span(node.span);
        moved[id.index()] = step(&mut graph, node);
    }
    let closures = network
        .closures
        .iter()
        .map(|c| WeightedClosure {
            kind: c.kind,
            weight: moved[c.weight.index()],
            params: c.params.iter().map(|p| moved[p.index()]).collect(),
        })
        .collect();
    Network { graph, closures }
}

/// A pass.
type Pass = (&'static str, fn(&Network) -> Network);

/// How far the optimiser may go.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Optimise {
    /// Not at all: the network as it was lowered.
    Nothing,
    /// Every bit of a value stays (but for the sign of zeros, and for what infinities
    /// and not-a-numbers lead to).
    Exact,
    /// A value may change by the operations' rounding, as by taking `b` for
    /// `a + (b − a)·1`.
    #[default]
    Rounding,
}

fn passes(how: Optimise) -> [Pass; 5] {
    let simplify: Pass = match how {
        Optimise::Rounding => ("simplify", simplify::run),
        _ => ("simplify", simplify::run_exact),
    };
    [
        ("fold", fold::run),
        simplify,
        ("common", common_subexpressions::run),
        ("closures", closures::run),
        ("dead", dead_code::run),
    ]
}

/// Rounds of all passes at most. Each round that changes anything makes the network
/// smaller; what is left after so many is still correct.
const ROUNDS: usize = 8;

/// Flattens a material's closures and runs all passes until nothing changes. The
/// statistics are of the lowered network and after each pass of the first round, and
/// of the end.
pub fn optimise(material: &MaterialGraph, how: Optimise) -> (Network, Vec<PassStatistics>) {
    let mut network = flatten::run(material);
    let mut statistics = vec![network.statistics("flatten")];
    if how == Optimise::Nothing {
        return (network, statistics);
    }
    for (name, pass) in passes(how) {
        network = pass(&network);
        statistics.push(network.statistics(name));
    }
    network = settle(network, how, ROUNDS);
    statistics.push(network.statistics("settled"));
    (network, statistics)
}

/// Runs the passes until the network stays the same, `rounds` times at most.
pub(crate) fn settle(mut network: Network, how: Optimise, rounds: usize) -> Network {
    if how == Optimise::Nothing {
        return network;
    }
    for _ in 0..rounds {
        let size = (network.graph.nodes().len(), network.closures.len());
        for (_, pass) in passes(how) {
            network = pass(&network);
        }
        if size == (network.graph.nodes().len(), network.closures.len()) {
            break;
        }
    }
    network
}
