//! Algebraic simplification: operations whose constant operand decides the result, and
//! rearrangements of components that cancel out.

use crate::graph::{Graph, Node, NodeId, NodeKind};
use crate::ops::OpCode;
use crate::opt::{Network, rewrite};

/// What an operation is where one of its operands is a certain constant.
enum Result {
    /// Another operand.
    Operand(usize),
    /// That constant.
    Constant(f32),
    /// An operation on some of the operands.
    Apply(OpCode, &'static [usize]),
}

/// One row: where all components of the operand are `equals`, the operation is `result`.
struct Rule {
    op: OpCode,
    operand: usize,
    equals: f32,
    result: Result,
    /// Whether the value stays the same to the last bit (but for the sign of a zero).
    exact: bool,
}

const fn rule(op: OpCode, operand: usize, equals: f32, result: Result) -> Rule {
    Rule {
        op,
        operand,
        equals,
        result,
        exact: true,
    }
}

/// A rule that changes the value by the operation's rounding.
const fn rounding(op: OpCode, operand: usize, equals: f32, result: Result) -> Rule {
    Rule {
        exact: false,
        ..rule(op, operand, equals, result)
    }
}

/// The rules. The first that fits is taken.
const RULES: &[Rule] = &{
    use Result::*;
    [
        rule(OpCode::math_add, 0, 0.0, Operand(1)),
        rule(OpCode::math_add, 1, 0.0, Operand(0)),
        rule(OpCode::math_subtract, 1, 0.0, Operand(0)),
        rule(OpCode::math_multiply, 0, 1.0, Operand(1)),
        rule(OpCode::math_multiply, 1, 1.0, Operand(0)),
        rule(OpCode::math_multiply, 0, 0.0, Constant(0.0)),
        rule(OpCode::math_multiply, 1, 0.0, Constant(0.0)),
        rule(OpCode::math_multiply_add, 0, 0.0, Operand(2)),
        rule(OpCode::math_multiply_add, 1, 0.0, Operand(2)),
        rule(
            OpCode::math_multiply_add,
            0,
            1.0,
            Apply(OpCode::math_add, &[1, 2]),
        ),
        rule(
            OpCode::math_multiply_add,
            1,
            1.0,
            Apply(OpCode::math_add, &[0, 2]),
        ),
        rule(
            OpCode::math_multiply_add,
            2,
            0.0,
            Apply(OpCode::math_multiply, &[0, 1]),
        ),
        rule(OpCode::math_mix, 2, 0.0, Operand(0)),
        rounding(OpCode::math_mix, 2, 1.0, Operand(1)),
        rule(OpCode::vector_add, 0, 0.0, Operand(1)),
        rule(OpCode::vector_add, 1, 0.0, Operand(0)),
        rule(OpCode::vector_subtract, 1, 0.0, Operand(0)),
        rule(OpCode::vector_multiply, 0, 1.0, Operand(1)),
        rule(OpCode::vector_multiply, 1, 1.0, Operand(0)),
        rule(OpCode::vector_multiply, 0, 0.0, Constant(0.0)),
        rule(OpCode::vector_multiply, 1, 0.0, Constant(0.0)),
        rule(OpCode::vector_scale, 1, 1.0, Operand(0)),
        rule(OpCode::vector_scale, 1, 0.0, Constant(0.0)),
        rule(OpCode::vector_scale, 0, 0.0, Constant(0.0)),
        rule(OpCode::vector_mix, 2, 0.0, Operand(0)),
        rounding(OpCode::vector_mix, 2, 1.0, Operand(1)),
        rule(OpCode::vector_mix_each, 2, 0.0, Operand(0)),
        rounding(OpCode::vector_mix_each, 2, 1.0, Operand(1)),
        rule(OpCode::math_divide, 1, 1.0, Operand(0)),
        rounding(OpCode::math_power, 1, 1.0, Operand(0)),
        rule(OpCode::mix_add, 0, 0.0, Operand(1)),
        rule(OpCode::mix_multiply, 0, 0.0, Operand(1)),
        rule(OpCode::mix_subtract, 0, 0.0, Operand(1)),
        rounding(OpCode::mix_screen, 0, 0.0, Operand(1)),
        rounding(OpCode::mix_overlay, 0, 0.0, Operand(1)),
        rule(OpCode::mix_divide, 0, 0.0, Operand(1)),
        rule(OpCode::mix_difference, 0, 0.0, Operand(1)),
        rule(OpCode::mix_exclusion, 0, 0.0, Operand(1)),
        rule(OpCode::mix_darken, 0, 0.0, Operand(1)),
        rule(OpCode::mix_lighten, 0, 0.0, Operand(1)),
        rounding(OpCode::mix_hue, 0, 0.0, Operand(1)),
        rounding(OpCode::mix_saturation, 0, 0.0, Operand(1)),
        rounding(OpCode::mix_value, 0, 0.0, Operand(1)),
        rounding(OpCode::mix_color, 0, 0.0, Operand(1)),
        rounding(OpCode::mix_soft_light, 0, 0.0, Operand(1)),
        rule(OpCode::mix_linear_light, 0, 0.0, Operand(1)),
        // Not dodge and burn: they clamp even where the factor is 0.
        rule(OpCode::vector_dot, 0, 0.0, Constant(0.0)),
        rule(OpCode::vector_dot, 1, 0.0, Constant(0.0)),
    ]
};

/// Operations (a, b, ..) that are a where a and b are the same value.
const IDEMPOTENT: &[OpCode] = &[
    OpCode::math_minimum,
    OpCode::math_maximum,
    OpCode::math_mix,
    OpCode::vector_mix,
];

/// Runs the pass with all rules.
pub fn run(network: &Network) -> Network {
    run_rules(network, true)
}

/// Runs the pass with those rules that keep every bit.
pub fn run_exact(network: &Network) -> Network {
    run_rules(network, false)
}

fn run_rules(network: &Network, rounding: bool) -> Network {
    rewrite(network, |graph, node| {
        let encoding = node.encoding;
        let simpler = match node.kind {
            NodeKind::Apply(op, _) => operation(graph, op, &node, rounding),
            NodeKind::Extract(first) => extract(graph, first as usize, &node),
            NodeKind::Combine => combine(graph, &node),
            _ => None,
        };
        let Some(id) = simpler else {
            return graph.push_node(node);
        };
        match encoding {
            Some(encoding) if graph.node(id).encoding.is_none() => graph.means(id, encoding),
            _ => id,
        }
    })
}

fn operation(graph: &mut Graph, op: OpCode, node: &Node, rounding: bool) -> Option<NodeId> {
    if IDEMPOTENT.contains(&op) && node.inputs[0] == node.inputs[1] {
        return Some(node.inputs[0]);
    }
    if op == OpCode::math_saturate && is_apply(graph, node.inputs[0], OpCode::math_saturate) {
        return Some(node.inputs[0]);
    }
    let rule = RULES
        .iter()
        .filter(|r| r.op == op && (rounding || r.exact))
        .find(|r| all_components_are(graph, node.inputs[r.operand], r.equals))?;
    Some(match rule.result {
        Result::Operand(i) => node.inputs[i],
        Result::Constant(x) => graph.constant(node.ty, [x; 4]),
        Result::Apply(op, operands) => {
            let inputs: Vec<NodeId> = operands.iter().map(|&i| node.inputs[i]).collect();
            graph.apply(op, &inputs)
        }
    })
}

fn is_apply(graph: &Graph, id: NodeId, op: OpCode) -> bool {
    matches!(graph.node(id).kind, NodeKind::Apply(o, _) if o == op)
}

fn all_components_are(graph: &Graph, id: NodeId, x: f32) -> bool {
    let width = graph.ty(id).width();
    graph
        .constant_value(id)
        .is_some_and(|v| v[..width].iter().all(|&c| c == x))
}

/// Components of components, and components of something that was put together.
fn extract(graph: &mut Graph, first: usize, node: &Node) -> Option<NodeId> {
    let from = node.inputs[0];
    match graph.node(from).kind {
        NodeKind::Extract(outer) => {
            let source = graph.node(from).inputs[0];
            Some(graph.extract(source, outer as usize + first, node.ty))
        }
        NodeKind::Combine => {
            let parts = graph.node(from).inputs.clone();
            let wanted = first..first + node.ty.width();
            let mut at = 0;
            for part in parts {
                let end = at + graph.ty(part).width();
                if at <= wanted.start && wanted.end <= end {
                    return Some(graph.extract(part, wanted.start - at, node.ty));
                }
                at = end;
            }
            None
        }
        _ => None,
    }
}

/// All components of one value put together again in order.
fn combine(graph: &mut Graph, node: &Node) -> Option<NodeId> {
    let mut at = 0;
    let mut source = None;
    for &part in &node.inputs {
        let NodeKind::Extract(first) = graph.node(part).kind else {
            return None;
        };
        let from = graph.node(part).inputs[0];
        if first as usize != at || *source.get_or_insert(from) != from {
            return None;
        }
        at += graph.ty(part).width();
    }
    source.filter(|&s| graph.ty(s) == node.ty)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closure::Ty;
    use crate::input::InputKind;
    use crate::opt::fold::network_of;

    /// Operations that are left of what `build` makes.
    fn left(build: impl FnOnce(&mut Graph) -> NodeId) -> usize {
        run(&network_of(build)).statistics("").operations
    }

    #[test]
    fn mix_by_zero_or_one_is_a_side() {
        for (t, side) in [(0.0, InputKind::Position), (1.0, InputKind::Normal)] {
            let network = run(&network_of(|g| {
                let a = g.value(InputKind::Position);
                let b = g.value(InputKind::Normal);
                let t = g.f1(t);
                g.apply(OpCode::vector_mix, &[a, b, t])
            }));
            let weight = network.graph.node(network.closures[0].weight);
            assert!(matches!(weight.kind, NodeKind::Input(i) if i.kind == side));
        }
    }

    #[test]
    fn neutral_and_absorbing_operands() {
        let by = |op, k: f32| {
            left(|g| {
                let x = g.value(InputKind::Pointiness);
                let k = g.f1(k);
                g.apply(op, &[x, k])
            })
        };
        assert_eq!(by(OpCode::math_multiply, 1.0), 0);
        assert_eq!(by(OpCode::math_multiply, 0.0), 0);
        assert_eq!(by(OpCode::math_add, 0.0), 0);
        assert_eq!(by(OpCode::math_add, 1.0), 1);
        assert_eq!(by(OpCode::math_multiply, 0.5), 1);
    }

    #[test]
    fn every_rule_keeps_the_value() {
        for rule in RULES {
            for sample in 0..200 {
                keeps_the_value(rule, sample);
            }
        }
    }

    /// The operands' ranges in all their components.
    fn ranges(op: OpCode) -> Vec<std::ops::Range<usize>> {
        let ends = op.info().operands().scan(0, |at, o| {
            *at += o.ty.width();
            Some(*at - o.ty.width()..*at)
        });
        ends.collect()
    }

    fn keeps_the_value(rule: &Rule, sample: u32) {
        use crate::vm::scalar;
        let info = rule.op.info();
        let ranges = ranges(rule.op);
        let number = |i: usize| (sample as f32 * 0.37 + i as f32 * 0.71).sin() * 2.0;
        let mut operands: Vec<f32> = (0..info.operand_rows()).map(number).collect();
        if info.arguments[0].name == "t" {
            // Blends are defined for colours.
            operands.iter_mut().for_each(|x| *x = x.abs());
        }
        operands[ranges[rule.operand].clone()].fill(rule.equals);
        let whole = scalar::apply(rule.op, 0, &operands);
        let simple = match rule.result {
            Result::Operand(i) => operands[ranges[i].clone()].to_vec(),
            Result::Constant(x) => vec![x; info.result.width()],
            Result::Apply(op, which) => {
                let of = |&i: &usize| operands[ranges[i].clone()].to_vec();
                let picked: Vec<f32> = which.iter().flat_map(of).collect();
                scalar::apply(op, 0, &picked)[..op.info().result.width()].to_vec()
            }
        };
        for (a, b) in whole.iter().zip(simple) {
            let rounding = info.error.max(1e-6) * b.abs().max(1.0);
            let allowed = if rule.exact { 0.0 } else { rounding };
            assert!(
                (a - b).abs() <= allowed,
                "{} {operands:?}: {a}, {b}",
                info.name
            );
        }
    }

    #[test]
    fn components_taken_apart_and_put_together_vanish() {
        let network = network_of(|g| {
            let p = g.value(InputKind::Position);
            let q = g.apply(OpCode::vector_add, &[p, p]);
            let xy = g.extract(q, 0, Ty::F2);
            let z = g.component(q, 2);
            let y = g.component(xy, 1);
            let x = g.component(xy, 0);
            g.combine(&[x, y, z])
        });
        let once = run(&run(&network));
        assert_eq!(once.statistics("").nodes, 2);
    }
}
