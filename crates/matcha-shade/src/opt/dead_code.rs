//! Dead-code elimination: what no closure reads goes.

use crate::opt::{Network, rewrite};

/// Runs the pass.
pub fn run(network: &Network) -> Network {
    rewrite(network, |graph, node| graph.push_node(node))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::InputKind;
    use crate::ops::OpCode;
    use crate::opt::fold::network_of;

    #[test]
    fn unread_values_go_and_read_ones_stay() {
        let network = network_of(|g| {
            let p = g.value(InputKind::Position);
            let unread = g.apply(OpCode::vector_add, &[p, p]);
            g.apply(OpCode::vector_add, &[unread, p]);
            g.apply(OpCode::vector_dot, &[p, p])
        });
        let after = run(&network);
        assert_eq!(network.graph.nodes().len(), 7);
        assert_eq!(after.graph.nodes().len(), 5);
        assert_eq!(after.statistics("").operations, 1);
    }
}
