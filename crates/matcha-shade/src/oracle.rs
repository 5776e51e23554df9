//! A slow interpreter over the lowered material, for tests: one point, one node at a
//! time, no pass, no program. Operations run by their scalar kernels; weights of
//! closures are multiplied out along the tree, in f64.

use crate::closure::ClosureKind;
use crate::graph::{Graph, NodeKind};
use crate::input::Input;
use crate::material::{ClosureNode, MaterialGraph};
use crate::vm::{Textures, scalar};

/// A closure at the point.
#[derive(Clone, Debug, PartialEq)]
pub struct ShadedClosure {
    /// Which.
    pub kind: ClosureKind,
    /// With all mix factors; a closure that is reached several ways has the sum.
    pub weight: [f64; 3],
    /// All components of all parameters.
    pub params: Vec<f32>,
}

/// What the material is at one point.
#[derive(Clone, Debug, PartialEq)]
pub struct Shaded {
    /// Every leaf that the root reaches, in the order of the leaves.
    pub closures: Vec<ShadedClosure>,
    /// Whether all values on the way were finite, and the weights far from overflow:
    /// simplification is free to change what infinities and not-a-numbers lead to.
    pub finite: bool,
}

/// Evaluates a material at the point whose quantities `input` tells.
pub fn shade(
    material: &MaterialGraph,
    input: &dyn Fn(Input) -> [f32; 4],
    textures: &dyn Textures,
) -> Shaded {
    let values = values(&material.graph, input, textures);
    let finite = values.iter().flatten().all(|x| x.is_finite());
    let nodes = material.closures.nodes();
    let mut weights = vec![None::<f64>; nodes.len()];
    if let Some(root) = material.closures.root {
        weights[root.0 as usize] = Some(1.0);
    }
    let mut closures = Vec::new();
    for (at, node) in nodes.iter().enumerate().rev() {
        let Some(factor) = weights[at] else { continue };
        let mut give = |to: crate::material::ClosureId, share: f64| {
            *weights[to.0 as usize].get_or_insert(0.0) += factor * share;
        };
        match node {
            ClosureNode::None => {}
            ClosureNode::Add(a, b) => {
                give(*a, 1.0);
                give(*b, 1.0);
            }
            ClosureNode::Mix { fac, a, b } => {
                let t = f64::from(values[fac.index()][0]).clamp(0.0, 1.0);
                give(*a, 1.0 - t);
                give(*b, t);
            }
            ClosureNode::Leaf {
                kind,
                weight,
                params,
                ..
            } => {
                let own = values[weight.index()];
                let components = |p: &crate::graph::NodeId| {
                    values[p.index()][..material.graph.ty(*p).width()].to_vec()
                };
                closures.push(ShadedClosure {
                    kind: *kind,
                    weight: std::array::from_fn(|i| f64::from(own[i]) * factor),
                    params: params.iter().flat_map(components).collect(),
                });
            }
        }
    }
    closures.reverse();
    let mut weights = closures.iter().flat_map(|c: &ShadedClosure| &c.weight);
    let in_range = weights.all(|w| w.abs() < 1e30);
    Shaded {
        finite: finite && in_range,
        closures,
    }
}

/// Every node's value.
fn values(
    graph: &Graph,
    input: &dyn Fn(Input) -> [f32; 4],
    textures: &dyn Textures,
) -> Vec<[f32; 4]> {
    let mut values: Vec<[f32; 4]> = Vec::with_capacity(graph.nodes().len());
    for node in graph.nodes() {
        let mut operands = Vec::new();
        for &i in &node.inputs {
            operands.extend(&values[i.index()][..graph.ty(i).width()]);
        }
        let mut value = match node.kind {
            NodeKind::Const(value) => value,
            NodeKind::Input(which) => input(which),
            NodeKind::Apply(op, aux) => scalar::apply(op, aux, &operands),
            NodeKind::Extract(first) => first_four(&operands[first as usize..]),
            NodeKind::Combine => first_four(&operands),
            NodeKind::Table(table) => {
                scalar::look_up(&graph.tables()[table.0 as usize], operands[0])
            }
            NodeKind::Texture(texture) => {
                let mut out = [[0.0f32]; 4];
                let pair = |i: usize| [&operands[i..=i], &operands[i + 1..=i + 1]];
                let [r, g, b, a] = &mut out;
                textures.sample(texture, 1, pair(0), pair(2), pair(4), [r, g, b, a]);
                out.map(|[x]| x)
            }
        };
        value[node.ty.width()..].fill(0.0);
        values.push(value);
    }
    values
}

fn first_four(components: &[f32]) -> [f32; 4] {
    std::array::from_fn(|i| components.get(i).copied().unwrap_or(0.0))
}
