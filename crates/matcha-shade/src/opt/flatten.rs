//! Closure flattening: from a tree of mixes and sums to a list of weighted closures.

use crate::graph::{Graph, NodeId};
use crate::material::{ClosureNode, MaterialGraph};
use crate::ops::OpCode;
use crate::opt::{Network, WeightedClosure};

/// Runs the pass. A closure that is reached along several ways gets the sum of their
/// weights. Mix factors are clamped to [0, 1], as Cycles' Mix Shader does.
pub fn run(material: &MaterialGraph) -> Network {
    let mut graph = material.graph.clone();
    let nodes = material.closures.nodes();
    // Parents come after their children, so backwards every weight is complete when
    // its node is reached.
    let mut weights: Vec<Option<NodeId>> = vec![None; nodes.len()];
    if let Some(root) = material.closures.root {
        weights[root.0 as usize] = Some(graph.f1(1.0));
    }
    let mut closures = Vec::new();
    for (at, node) in nodes.iter().enumerate().rev() {
        let Some(factor) = weights[at] else { continue };
        match node {
            ClosureNode::None => {}
            ClosureNode::Add(a, b) => {
                for child in [a, b] {
                    add_weight(&mut graph, &mut weights[child.0 as usize], factor);
                }
            }
            ClosureNode::Mix { fac, a, b } => {
                let (wa, wb) = split(&mut graph, factor, *fac);
                add_weight(&mut graph, &mut weights[a.0 as usize], wa);
                add_weight(&mut graph, &mut weights[b.0 as usize], wb);
            }
            ClosureNode::Leaf {
                kind,
                weight,
                params,
                span,
            } => {
                graph.set_span(*span);
                let weight = graph.apply(OpCode::vector_scale, &[*weight, factor]);
                closures.push(WeightedClosure {
                    kind: *kind,
                    weight,
                    params: params.clone(),
                });
            }
        }
    }
    closures.reverse();
    Network { graph, closures }
}

/// (w·(1 − t), w·t) with t the clamped factor.
fn split(graph: &mut Graph, weight: NodeId, fac: NodeId) -> (NodeId, NodeId) {
    let t = graph.apply(OpCode::math_saturate, &[fac]);
    let one = graph.f1(1.0);
    let rest = graph.apply(OpCode::math_subtract, &[one, t]);
    (
        graph.apply(OpCode::math_multiply, &[weight, rest]),
        graph.apply(OpCode::math_multiply, &[weight, t]),
    )
}

fn add_weight(graph: &mut Graph, sum: &mut Option<NodeId>, weight: NodeId) {
    *sum = Some(match *sum {
        Some(before) => graph.apply(OpCode::math_add, &[before, weight]),
        None => weight,
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closure::ClosureKind;
    use crate::graph::Span;
    use crate::opt::{Optimise, ROUNDS, settle};

    fn leaf(
        material: &mut MaterialGraph,
        kind: ClosureKind,
        color: [f32; 3],
    ) -> crate::material::ClosureId {
        let weight = material.graph.f3(color);
        material
            .closures
            .leaf(&material.graph, kind, weight, vec![], Span::default())
    }

    fn weights(material: &MaterialGraph) -> Vec<(ClosureKind, [f32; 4])> {
        let network = settle(run(material), Optimise::Exact, ROUNDS);
        let value = |id| {
            network
                .graph
                .constant_value(id)
                .expect("constant weights fold")
        };
        network
            .closures
            .iter()
            .map(|c| (c.kind, value(c.weight)))
            .collect()
    }

    #[test]
    fn mixes_and_sums_multiply_into_weights() {
        let mut m = MaterialGraph::default();
        let a = leaf(&mut m, ClosureKind::Transparent, [1.0, 0.5, 0.25]);
        let b = leaf(&mut m, ClosureKind::Holdout, [1.0; 3]);
        let quarter = m.graph.f1(0.25);
        let mix = m.closures.mix(&m.graph, quarter, a, b);
        let c = leaf(&mut m, ClosureKind::Emission, [8.0; 3]);
        m.closures.root = Some(m.closures.add(mix, c));
        assert_eq!(
            weights(&m),
            [
                (ClosureKind::Transparent, [0.75, 0.375, 0.1875, 0.0]),
                (ClosureKind::Holdout, [0.25, 0.25, 0.25, 0.0]),
                (ClosureKind::Emission, [8.0, 8.0, 8.0, 0.0]),
            ]
        );
    }

    #[test]
    fn a_shared_closure_comes_once() {
        let mut m = MaterialGraph::default();
        let a = leaf(&mut m, ClosureKind::Transparent, [1.0; 3]);
        let half = m.graph.f1(0.5);
        let none = m.closures.none();
        let mix = m.closures.mix(&m.graph, half, a, none);
        m.closures.root = Some(m.closures.add(mix, a));
        assert_eq!(
            weights(&m),
            [(ClosureKind::Transparent, [1.5, 1.5, 1.5, 0.0])]
        );
    }

    #[test]
    fn a_factor_outside_of_its_range_is_clamped() {
        let mut m = MaterialGraph::default();
        let a = leaf(&mut m, ClosureKind::Transparent, [1.0; 3]);
        let b = leaf(&mut m, ClosureKind::Holdout, [1.0; 3]);
        let two = m.graph.f1(2.0);
        m.closures.root = Some(m.closures.mix(&m.graph, two, a, b));
        assert_eq!(weights(&m), [(ClosureKind::Holdout, [1.0, 1.0, 1.0, 0.0])]);
    }

    #[test]
    fn what_the_root_does_not_reach_is_gone() {
        let mut m = MaterialGraph::default();
        leaf(&mut m, ClosureKind::Transparent, [1.0; 3]);
        m.closures.root = Some(m.closures.none());
        assert_eq!(weights(&m), []);
    }
}
