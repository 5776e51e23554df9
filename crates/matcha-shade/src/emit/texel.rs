//! A region's sub-graphs at their virtual texel: the texel's centre takes the place of
//! the hit's coordinate, its edges that of the footprint's axes.

use crate::closure::ClosureKind;
use crate::graph::{Graph, NodeId, NodeKind};
use crate::input::{Input, InputKind, Part};
use crate::opt::{self, Network, Optimise, WeightedClosure};

/// Registers that a `lookup` word fills: u, v, size.
pub(super) const REGISTERS: usize = 3;

/// The register of an input of [`at_centre`]'s graph.
pub(super) fn register(input: Input, texel: u16) -> u16 {
    match input.part {
        Part::Value => texel,
        // Only its first component is read.
        Part::AxisA => texel + 2,
        Part::AxisB => unreachable!("replaced by the first axis"),
    }
}

/// A graph with the sub-graphs of `roots` alone, optimised, and their values there. Axis A
/// is (size, 0) and axis B (0, size); the size is the first component of axis A.
pub(super) fn at_centre(
    graph: &Graph,
    roots: &[NodeId],
    set: u16,
    optimise: Optimise,
) -> (Graph, Vec<NodeId>) {
    let mut whole = graph.clone();
    // The values are parameters, so that the passes keep them whatever they are; the closure
    // is only its carrier and must not be black.
    let output = WeightedClosure {
        kind: ClosureKind::Holdout,
        weight: whole.f3([1.0; 3]),
        params: roots.to_vec(),
    };
    let network = Network {
        graph: whole,
        closures: vec![output],
    };
    let inner = opt::rewrite(&network, |graph, node| match node.kind {
        NodeKind::Input(Input {
            kind: InputKind::Uv(s),
            part: Part::AxisA,
        }) if s == set => {
            let size = size(graph, set);
            let zero = graph.f1(0.0);
            graph.combine(&[size, zero])
        }
        NodeKind::Input(Input {
            kind: InputKind::Uv(s),
            part: Part::AxisB,
        }) if s == set => {
            let size = size(graph, set);
            let zero = graph.f1(0.0);
            graph.combine(&[zero, size])
        }
        _ => graph.push_node(node),
    });
    let mut inner = opt::settle(inner, optimise, 4);
    let values = inner.closures.remove(0).params;
    (inner.graph, values)
}

fn size(graph: &mut Graph, set: u16) -> NodeId {
    let axis = graph.input(InputKind::Uv(set), Part::AxisA);
    graph.component(axis, 0)
}
