//! Constant folding, by the operations' own scalar kernels: a folded value is bit for
//! bit what the machine would have computed.

use crate::closure::Ty;
use crate::graph::{Graph, Node, NodeKind};
use crate::opt::{Network, rewrite};
use crate::vm::scalar;

/// Runs the pass.
pub fn run(network: &Network) -> Network {
    rewrite(network, |graph, node| match value(graph, &node) {
        Some(value) => {
            let id = graph.constant(node.ty, value);
            match node.encoding {
                Some(encoding) => graph.means(id, encoding),
                None => id,
            }
        }
        None => graph.push_node(node),
    })
}

/// The node's value, if its inputs are all constant.
fn value(graph: &Graph, node: &Node) -> Option<[f32; 4]> {
    if node.inputs.is_empty() {
        return None;
    }
    let mut operands = Vec::with_capacity(12);
    for &input in &node.inputs {
        operands.extend(&graph.constant_value(input)?[..graph.ty(input).width()]);
    }
    match node.kind {
        NodeKind::Apply(op, aux) => Some(scalar::apply(op, aux, &operands)),
        NodeKind::Extract(first) => Some(take(&operands[first as usize..], node.ty)),
        NodeKind::Combine => Some(take(&operands, node.ty)),
        NodeKind::Table(table) => Some(scalar::look_up(
            &graph.tables()[table.0 as usize],
            operands[0],
        )),
        NodeKind::Const(_) | NodeKind::Input(_) | NodeKind::Texture(_) => None,
    }
}

fn take(components: &[f32], ty: Ty) -> [f32; 4] {
    let mut value = [0.0; 4];
    value[..ty.width()].copy_from_slice(&components[..ty.width()]);
    value
}

/// Helper of the passes' tests: one value as a network's only output.
#[cfg(test)]
pub(crate) fn network_of(build: impl FnOnce(&mut Graph) -> crate::graph::NodeId) -> Network {
    use crate::closure::ClosureKind;
    use crate::opt::WeightedClosure;
    let mut graph = Graph::new();
    let value = build(&mut graph);
    let weight = match graph.ty(value).width() {
        3 => value,
        width => {
            let mut parts = vec![value];
            parts.extend((width..3).map(|_| graph.f1(0.5)));
            graph.combine(&parts)
        }
    };
    let closures = vec![WeightedClosure {
        kind: ClosureKind::Transparent,
        weight,
        params: vec![],
    }];
    Network { graph, closures }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::{NodeId, Table};
    use crate::input::InputKind;
    use crate::ops::OpCode;

    fn folded(build: impl FnOnce(&mut Graph) -> NodeId) -> Option<[f32; 4]> {
        let network = run(&network_of(build));
        network.graph.constant_value(network.closures[0].weight)
    }

    #[test]
    fn operations_extracts_and_tables_fold() {
        let value = folded(|g| {
            let v = g.f3([1.0, 2.0, 3.0]);
            let two = g.f1(2.0);
            let scaled = g.apply(OpCode::vector_scale, &[v, two]);
            let z = g.component(scaled, 2);
            let table = g.table(Table {
                rows: vec![vec![0.0, 10.0]],
                interpolate: true,
                extrapolate: true,
            });
            let y = g.look_up(table, z);
            let xy = g.extract(scaled, 0, Ty::F2);
            g.combine(&[xy, y])
        });
        assert_eq!(value, Some([2.0, 4.0, 60.0, 0.0]));
    }

    #[test]
    fn what_depends_on_the_point_stays() {
        let value = folded(|g| {
            let p = g.value(InputKind::Position);
            let two = g.f1(2.0);
            g.apply(OpCode::vector_scale, &[p, two])
        });
        assert_eq!(value, None);
    }
}
