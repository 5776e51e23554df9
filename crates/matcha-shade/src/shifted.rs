//! Derivatives over the footprint: a sub-graph's copy, evaluated beside the hit.

use crate::graph::{Graph, Node, NodeId, NodeKind};
use crate::input::{Input, Part};
use crate::ops::OpCode;

/// Bit of an operation's immediate: while a sub-graph is copied, the value stays that of
/// the hit. For whole numbers that choose which smooth piece is evaluated (the cell of
/// the nearest point), so that a copy evaluates the same piece without choosing again.
/// [`Graph::release_held`] takes the bit away when no copies are made any more.
pub(crate) const HELD: u32 = 1 << 31;

/// See [`Graph::shifted`].
pub(crate) fn shifted(graph: &mut Graph, root: NodeId, axis: Part, scale: f32) -> NodeId {
    assert_ne!(axis, Part::Value, "an axis");
    let reached = reachable(graph, root);
    let mut copies: Vec<NodeId> = graph.ids().take(root.index() + 1).collect();
    let home = graph.span();
    for id in graph.ids().take(root.index() + 1) {
        if !reached[id.index()] {
            continue;
        }
        let node = graph.node(id).clone();
        graph.set_span(node.span);
        copies[id.index()] = match node.kind {
            NodeKind::Input(Input {
                kind,
                part: Part::Value,
            }) if kind.is_differentiable() => {
                let change = graph.input(kind, axis);
                moved(graph, id, change, scale)
            }
            NodeKind::Apply(_, aux) if aux & HELD != 0 => id,
            _ => copy_if_changed(graph, id, node, &copies),
        };
    }
    graph.set_span(home);
    copies[root.index()]
}

fn copy_if_changed(graph: &mut Graph, id: NodeId, node: Node, copies: &[NodeId]) -> NodeId {
    let inputs: Vec<NodeId> = node.inputs.iter().map(|i| copies[i.index()]).collect();
    if inputs == node.inputs {
        id
    } else {
        graph.push_node(Node { inputs, ..node })
    }
}

/// `value + scale * change`, component by component, so that one operation does for
/// every width.
fn moved(graph: &mut Graph, value: NodeId, change: NodeId, scale: f32) -> NodeId {
    let scale = graph.f1(scale);
    let parts: Vec<NodeId> = (0..graph.ty(value).width())
        .map(|i| {
            let x = graph.component(value, i);
            let dx = graph.component(change, i);
            graph.apply(OpCode::math_multiply_add, &[dx, scale, x])
        })
        .collect();
    graph.combine(&parts)
}

fn reachable(graph: &Graph, root: NodeId) -> Vec<bool> {
    let mut reached = vec![false; root.index() + 1];
    reached[root.index()] = true;
    for at in (0..=root.index()).rev() {
        if reached[at] {
            for input in &graph.nodes()[at].inputs {
                reached[input.index()] = true;
            }
        }
    }
    reached
}
