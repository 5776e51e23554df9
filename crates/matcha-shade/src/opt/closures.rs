//! Closure merging: black closures go, and closures that differ only in their weight
//! become one.

use crate::ops::OpCode;
use crate::opt::{Network, WeightedClosure};

/// Runs the pass.
pub fn run(network: &Network) -> Network {
    let mut graph = network.graph.clone();
    let mut closures: Vec<WeightedClosure> = Vec::new();
    for closure in &network.closures {
        if graph
            .constant_value(closure.weight)
            .is_some_and(|w| w[..3] == [0.0; 3])
        {
            continue;
        }
        let twin = closures
            .iter_mut()
            .find(|c| c.kind == closure.kind && c.params == closure.params);
        match twin {
            Some(twin) => {
                twin.weight = graph.apply(OpCode::vector_add, &[twin.weight, closure.weight]);
            }
            None => closures.push(closure.clone()),
        }
    }
    Network { graph, closures }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closure::ClosureKind;
    use crate::graph::Graph;
    use crate::input::InputKind;

    #[test]
    fn twins_merge_and_black_ones_go() {
        let mut graph = Graph::new();
        let p = graph.value(InputKind::Position);
        let black = graph.f3([0.0; 3]);
        let normal = graph.value(InputKind::Normal);
        let (kind, params) = (ClosureKind::Translucent, vec![normal]);
        let closure = |weight| WeightedClosure {
            kind,
            weight,
            params: params.clone(),
        };
        let closures = vec![closure(p), closure(black), closure(p)];
        let after = run(&Network { graph, closures });
        assert_eq!(after.closures.len(), 1);
        let weight = after.graph.node(after.closures[0].weight);
        assert_eq!(weight.inputs, [p, p]);
    }
}
