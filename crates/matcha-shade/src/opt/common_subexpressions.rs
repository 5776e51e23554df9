//! Common-subexpression elimination: equal nodes become one.

use crate::closure::Ty;
use crate::graph::{Encoding, Node, NodeId, NodeKind, TableId, TextureRef};
use crate::input::Input;
use crate::ops::OpCode;
use crate::opt::{Network, rewrite};
use std::collections::HashMap;

/// A node's kind with bits for numbers, so that it can be hashed.
#[derive(PartialEq, Eq, Hash)]
enum Key {
    Const([u32; 4]),
    Input(Input),
    Apply(OpCode, u32),
    Extract(u8),
    Combine,
    Texture(TextureRef),
    Table(TableId),
}

impl From<&NodeKind> for Key {
    fn from(kind: &NodeKind) -> Key {
        match *kind {
            NodeKind::Const(value) => Key::Const(value.map(f32::to_bits)),
            NodeKind::Input(input) => Key::Input(input),
            NodeKind::Apply(op, aux) => Key::Apply(op, aux),
            NodeKind::Extract(first) => Key::Extract(first),
            NodeKind::Combine => Key::Combine,
            NodeKind::Texture(texture) => Key::Texture(texture),
            NodeKind::Table(table) => Key::Table(table),
        }
    }
}

/// Runs the pass.
pub fn run(network: &Network) -> Network {
    let mut seen: HashMap<(Key, Vec<NodeId>, Ty), NodeId> = HashMap::new();
    rewrite(network, |graph, node: Node| {
        let key = (Key::from(&node.kind), node.inputs.clone(), node.ty);
        match seen.get(&key) {
            Some(&id) => {
                if let Some(encoding) = agreed(graph.node(id).encoding, node.encoding) {
                    graph.means(id, encoding);
                }
                id
            }
            None => {
                let id = graph.push_node(node);
                seen.insert(key, id);
                id
            }
        }
    })
}

/// What two equal values mean. Where their authors disagree it must be the encoding
/// that can hold anything.
fn agreed(a: Option<Encoding>, b: Option<Encoding>) -> Option<Encoding> {
    match (a, b) {
        (Some(a), Some(b)) if a != b => Some(Encoding::Vector),
        (Some(a), _) => Some(a),
        (None, b) => b,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::InputKind;
    use crate::opt::fold::network_of;

    #[test]
    fn equal_values_are_computed_once() {
        let network = network_of(|g| {
            let twice: Vec<NodeId> = (0..2)
                .map(|_| {
                    let p = g.value(InputKind::Position);
                    let s = g.f1(3.0);
                    g.apply(OpCode::vector_scale, &[p, s])
                })
                .collect();
            g.apply(OpCode::vector_add, &[twice[0], twice[1]])
        });
        assert_eq!(network.statistics("").operations, 3);
        assert_eq!(run(&network).statistics("").operations, 2);
    }

    #[test]
    fn zeros_of_different_sign_stay_apart() {
        let network = network_of(|g| {
            let a = g.f1(0.0);
            let b = g.f1(-0.0);
            let c = g.value(InputKind::Pointiness);
            g.combine(&[a, b, c])
        });
        assert_eq!(run(&network).statistics("").nodes, 4);
    }

    #[test]
    fn disagreeing_authors_get_the_encoding_that_holds_anything() {
        let network = network_of(|g| {
            let mut one = |encoding| {
                let p = g.value(InputKind::Position);
                let q = g.apply(OpCode::vector_add, &[p, p]);
                g.means(q, encoding)
            };
            let a = one(Encoding::Color);
            let b = one(Encoding::Normal);
            g.apply(OpCode::vector_subtract, &[a, b])
        });
        let network = run(&network);
        let meanings: Vec<_> = network
            .graph
            .nodes()
            .iter()
            .filter_map(|n| n.encoding)
            .collect();
        assert_eq!(meanings, [Encoding::Vector]);
    }
}
