//! Order of evaluation: depth first, the input that needs most registers first, so
//! that few values are alive at a time.

use crate::graph::{Graph, NodeId};

/// Everything that `roots` need, inputs before users. Nothing below a node that `stop`
/// holds for is included.
pub(super) fn order(graph: &Graph, roots: &[NodeId], stop: impl Fn(NodeId) -> bool) -> Vec<NodeId> {
    let need = registers_needed(graph);
    let mut visited = vec![false; graph.nodes().len()];
    let mut order = Vec::new();
    // (node, whether its inputs are done)
    let mut stack: Vec<(NodeId, bool)> = Vec::new();
    for &root in roots {
        stack.push((root, false));
        while let Some((id, done)) = stack.pop() {
            if done {
                order.push(id);
                continue;
            }
            if std::mem::replace(&mut visited[id.index()], true) {
                continue;
            }
            stack.push((id, true));
            if !stop(id) {
                let mut inputs = graph.node(id).inputs.clone();
                inputs.sort_by_key(|i| need[i.index()]);
                stack.extend(inputs.into_iter().map(|i| (i, false)));
            }
        }
    }
    order
}

/// Registers that a value's evaluation takes if nothing is shared (Sethi and Ullman
/// 1970, for operands of any width).
fn registers_needed(graph: &Graph) -> Vec<u32> {
    let mut need: Vec<u32> = Vec::with_capacity(graph.nodes().len());
    for node in graph.nodes() {
        let mut inputs: Vec<(u32, u32)> = node
            .inputs
            .iter()
            .map(|i| (need[i.index()], graph.ty(*i).width() as u32))
            .collect();
        inputs.sort_by_key(|&(n, _)| std::cmp::Reverse(n));
        let mut held = 0;
        let mut most = node.ty.width() as u32;
        for (n, width) in inputs {
            most = most.max(held + n);
            held += width;
        }
        need.push(most.max(held));
    }
    need
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::InputKind;
    use crate::ops::OpCode;

    #[test]
    fn inputs_come_before_users_and_once() {
        let mut g = Graph::new();
        let p = g.value(InputKind::Position);
        let a = g.apply(OpCode::vector_add, &[p, p]);
        let b = g.apply(OpCode::vector_multiply, &[a, p]);
        let c = g.apply(OpCode::vector_subtract, &[b, a]);
        assert_eq!(order(&g, &[c, a], |_| false), [p, a, b, c]);
        assert_eq!(order(&g, &[c], |id| id == a), [a, p, b, c]);
    }
}
