//! Which values are worth a place in the cache (Fujieda and Harada 2022, section 3.1):
//! highest nodes that depend on one UV set and nothing else, if they cost more than a
//! look-up does.

use crate::closure::Ty;
use crate::compile::CostModel;
use crate::graph::{Encoding, Graph, NodeId, NodeKind};
use crate::input::Dependency;
use crate::ops::OpCode;
use crate::opt::Network;

/// What a value depends on if it is made of two.
pub fn join(a: Dependency, b: Dependency) -> Dependency {
    match (a, b) {
        (Dependency::Uv(one), Dependency::Uv(other)) if one != other => Dependency::Surface,
        _ => a.max(b),
    }
}

/// Every node's dependency.
pub fn dependencies(graph: &Graph) -> Vec<Dependency> {
    let mut of: Vec<Dependency> = Vec::with_capacity(graph.nodes().len());
    for node in graph.nodes() {
        let own = match node.kind {
            NodeKind::Input(input) => input.kind.dependency(),
            _ => Dependency::Constant,
        };
        of.push(node.inputs.iter().fold(own, |d, i| join(d, of[i.index()])));
    }
    of
}

/// A node's own cost, ns a point, without its inputs'.
pub fn own_cost(graph: &Graph, id: NodeId, model: &CostModel) -> f32 {
    match graph.node(id).kind {
        NodeKind::Apply(op, _) => op.info().cost * model.operation_scale,
        NodeKind::Texture(_) => model.texture_ns,
        NodeKind::Table(_) => model.table_ns,
        _ => 0.0,
    }
}

/// Cost of everything that the outputs need, computed once.
pub fn network_cost(network: &Network, model: &CostModel) -> f32 {
    let live = network.live();
    let ids = network.graph.ids().filter(|id| live[id.index()]);
    ids.map(|id| own_cost(&network.graph, id, model)).sum()
}

/// Rewrites a network so that no highest cacheable node is wider than a cache value can
/// be: a colour with alpha is cached as a colour and a number.
pub fn split_wide(network: &Network) -> Network {
    let wide: Vec<bool> = {
        let candidates = candidates(network);
        let mut wide = vec![false; network.graph.nodes().len()];
        for id in candidates {
            wide[id.index()] = network.graph.ty(id) == Ty::F4;
        }
        wide
    };
    if !wide.contains(&true) {
        return network.clone();
    }
    // `rewrite` visits live nodes in order; the old index is found by counting.
    let live = network.live();
    let mut old = network.graph.ids().filter(|id| live[id.index()]);
    crate::opt::rewrite(network, |graph, node| {
        let is_wide = wide[old.next().expect("one live node a step").index()];
        let id = graph.push_node(node);
        if !is_wide {
            return id;
        }
        let color = graph.extract(id, 0, Ty::F3);
        let alpha = graph.component(id, 3);
        graph.combine(&[color, alpha])
    })
}

/// The nodes to cache and the UV set of each: set by set, a set's nodes in order of
/// evaluation. Choose on a network after [`split_wide`].
pub fn choose(network: &Network, model: &CostModel) -> Vec<(NodeId, u16)> {
    let dependencies = dependencies(&network.graph);
    let set_of = |id: NodeId| match dependencies[id.index()] {
        Dependency::Uv(set) => (id, set),
        other => unreachable!("candidates depend on one UV set, not on {other:?}"),
    };
    let mut chosen: Vec<(NodeId, u16)> = candidates(network)
        .into_iter()
        .filter(|&id| network.graph.ty(id) != Ty::F4)
        .map(set_of)
        .collect();
    chosen.sort_by_key(|&(_, set)| set);
    let mut choice = Choice {
        network,
        model,
        chosen,
    };
    choice.drop_what_does_not_pay();
    choice.chosen
}

/// Highest nodes that depend on one UV set alone and contain an operation.
fn candidates(network: &Network) -> Vec<NodeId> {
    let graph = &network.graph;
    let dependencies = dependencies(graph);
    let live = network.live();
    let is_uv = |id: NodeId| matches!(dependencies[id.index()], Dependency::Uv(_));
    let mut highest = vec![false; graph.nodes().len()];
    let mut mark = |id: NodeId| {
        let node = graph.node(id);
        // A value too wide for the cache that was put together is its parts.
        let parts = match node.kind {
            NodeKind::Combine if node.ty == Ty::F4 => &node.inputs[..],
            _ => &[id],
        };
        for &part in parts.iter().filter(|&&part| is_uv(part)) {
            highest[whole(graph, part).index()] = true;
        }
    };
    network.outputs().for_each(&mut mark);
    for id in graph.ids().filter(|&id| live[id.index()] && !is_uv(id)) {
        graph.node(id).inputs.iter().copied().for_each(&mut mark);
    }
    let computes = contains_operation(graph);
    let height = heights(graph, &live, is_uv);
    graph
        .ids()
        .filter(|id| highest[id.index()] && computes[id.index()] && !height[id.index()])
        .collect()
}

/// What a component is taken from, where that fits into one cache value: one look-up
/// then serves all components.
fn whole(graph: &Graph, id: NodeId) -> NodeId {
    match graph.node(id).kind {
        NodeKind::Extract(_) => {
            let from = graph.node(id).inputs[0];
            if graph.ty(from) == Ty::F4 {
                id
            } else {
                whole(graph, from)
            }
        }
        _ => id,
    }
}

/// What the heights of bumps are made of that depend on more than UV. Such a bump takes
/// differences along the footprint's own axes, and a texel knows neither these nor how
/// far it is from its neighbours: its heights are steps.
fn heights(graph: &Graph, live: &[bool], is_uv: impl Fn(NodeId) -> bool) -> Vec<bool> {
    let mut height = vec![false; graph.nodes().len()];
    for id in graph.ids().rev().filter(|id| live[id.index()]) {
        let node = graph.node(id);
        let differs = matches!(node.kind, NodeKind::Apply(OpCode::bump_change, _));
        if height[id.index()] || differs && !is_uv(id) {
            for input in &node.inputs {
                height[input.index()] = true;
            }
        }
    }
    height
}

fn contains_operation(graph: &Graph) -> Vec<bool> {
    let mut contains = Vec::with_capacity(graph.nodes().len());
    for node in graph.nodes() {
        let below = node.inputs.iter().any(|i: &NodeId| contains[i.index()]);
        contains.push(below || crate::opt::is_operation(&node.kind));
    }
    contains
}

struct Choice<'a> {
    network: &'a Network,
    model: &'a CostModel,
    /// Sorted by set.
    chosen: Vec<(NodeId, u16)>,
}

impl Choice<'_> {
    /// Drops nodes that save less than it costs to find them once their cell is there:
    /// the worst first, for a dropped node's values are then there for the others too.
    /// Then drops sets whose nodes together do not pay for the look-up of the cell.
    fn drop_what_does_not_pay(&mut self) {
        if self.model.lookup_ns <= 0.0 {
            return;
        }
        loop {
            while let Some(worst) = self.worst_node() {
                self.chosen.remove(worst);
            }
            match self.worst_set() {
                Some(set) => self.chosen.retain(|&(_, other)| other != set),
                None => return,
            }
        }
    }

    fn worst_node(&self) -> Option<usize> {
        let mut known = self.computed_without_cache();
        for (id, _) in &self.chosen {
            known[id.index()] = true;
        }
        let saving = |&(id, _): &(NodeId, u16)| {
            let mut others = known.clone();
            others[id.index()] = false;
            self.cost_beyond(&others, &[id])
        };
        let (at, least) = self
            .chosen
            .iter()
            .map(saving)
            .enumerate()
            .min_by(|a, b| a.1.total_cmp(&b.1))?;
        (least <= self.model.value_ns).then_some(at)
    }

    fn worst_set(&self) -> Option<u16> {
        let computed = self.computed_without_cache();
        let of_one_set = |set: &[(NodeId, u16)]| {
            let nodes: Vec<NodeId> = set.iter().map(|&(id, _)| id).collect();
            let price = self.model.lookup_ns + self.model.value_ns * nodes.len() as f32;
            (self.cost_beyond(&computed, &nodes) <= price).then_some(set[0].1)
        };
        self.chosen.chunk_by(|a, b| a.1 == b.1).find_map(of_one_set)
    }

    /// Nodes that are computed for every hit, given what is cached.
    fn computed_without_cache(&self) -> Vec<bool> {
        let mut stop = vec![false; self.network.graph.nodes().len()];
        for (id, _) in &self.chosen {
            stop[id.index()] = true;
        }
        let mut computed = stop.clone();
        let outputs: Vec<NodeId> = self.network.outputs().collect();
        reach_from(&self.network.graph, &outputs, &mut computed);
        computed.iter().zip(stop).map(|(&c, s)| c && !s).collect()
    }

    /// Cost of what these nodes need beyond what is known already.
    fn cost_beyond(&self, known: &[bool], nodes: &[NodeId]) -> f32 {
        let graph = &self.network.graph;
        let mut reach = known.to_vec();
        reach_from(graph, nodes, &mut reach);
        graph
            .ids()
            .filter(|id| reach[id.index()] && !known[id.index()])
            .map(|id| own_cost(graph, id, self.model))
            .sum()
    }
}

/// Marks everything that `from` needs, not going on below what is marked already.
fn reach_from(graph: &Graph, from: &[NodeId], marked: &mut [bool]) {
    let mut stack: Vec<NodeId> = from.to_vec();
    while let Some(id) = stack.pop() {
        if !std::mem::replace(&mut marked[id.index()], true) {
            stack.extend(&graph.node(id).inputs);
        }
    }
}

/// How a cached value is packed: what its author says, else what its operation says,
/// else what holds anything of its type.
pub fn encoding(graph: &Graph, id: NodeId) -> Encoding {
    let node = graph.node(id);
    let fits = |e: &Encoding| match e {
        Encoding::Color | Encoding::Normal => node.ty == Ty::F3,
        Encoding::Scalar => node.ty == Ty::F1,
        Encoding::Gradient => node.ty == Ty::F2,
        Encoding::Vector => matches!(node.ty, Ty::F2 | Ty::F3),
    };
    let derived = match node.kind {
        NodeKind::Apply(op, _) => op.info().encoding,
        NodeKind::Table(table) => {
            let rows = &graph.tables()[table.0 as usize].rows;
            let is_color = rows.iter().flatten().all(|&x| x >= 0.0);
            is_color.then_some(Encoding::Color)
        }
        // An image's colour; it is the only value of four components of its own.
        NodeKind::Extract(0) if graph.ty(node.inputs[0]) == Ty::F4 => Some(Encoding::Color),
        _ => None,
    };
    let general = if node.ty == Ty::F1 {
        Encoding::Scalar
    } else {
        Encoding::Vector
    };
    node.encoding
        .filter(fits)
        .or(derived.filter(fits))
        .unwrap_or(general)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compile::CostModel;
    use crate::input::{InputKind, Part};
    use crate::opt::fold::network_of;
    use crate::vm::Isa;

    fn costs(lookup_ns: f32) -> CostModel {
        CostModel {
            lookup_ns,
            value_ns: 0.0,
            ..CostModel::of(Isa::Avx512)
        }
    }

    /// One UV set's coordinate through an operation that costs `series_of_halves`.
    fn costly(g: &mut Graph, set: u16) -> NodeId {
        let uv = g.value(InputKind::Uv(set));
        let (u, v) = (g.component(uv, 0), g.component(uv, 1));
        g.apply(OpCode::series_of_halves, &[u, v])
    }

    fn tinted(g: &mut Graph, values: &[NodeId]) -> NodeId {
        let mut color = g.value(InputKind::Position);
        for &value in values {
            color = g.apply(OpCode::vector_scale, &[color, value]);
        }
        color
    }

    #[test]
    fn dependencies_join() {
        use Dependency::*;
        assert_eq!(join(Constant, Uv(3)), Uv(3));
        assert_eq!(join(Uv(3), Uv(3)), Uv(3));
        assert_eq!(join(Uv(3), Uv(4)), Surface);
        assert_eq!(join(View, Uv(4)), View);
        assert_eq!(join(Path, View), Path);
    }

    #[test]
    fn the_highest_node_of_one_set_is_chosen() {
        let network = network_of(|g| {
            let a = costly(g, 0);
            let b = g.apply(OpCode::math_add, &[a, a]);
            tinted(g, &[b])
        });
        let chosen = choose(&network, &costs(0.0));
        assert_eq!(chosen.len(), 1);
        let kind = network.graph.node(chosen[0].0).kind;
        assert_eq!(kind, NodeKind::Apply(OpCode::math_add, 0));
    }

    /// A bump of a height that `beside` joins.
    fn bumped(beside: InputKind) -> Network {
        network_of(|g| {
            let a = costly(g, 0);
            let other = g.value(beside);
            let b = g.component(other, 0);
            let height = g.apply(OpCode::math_add, &[a, b]);
            let [ahead_a, ahead_b] =
                [Part::AxisA, Part::AxisB].map(|axis| g.shifted(height, axis, 0.1));
            let width = g.f1(0.1);
            let change = g.apply(OpCode::bump_change, &[height, ahead_a, ahead_b, width]);
            let x = g.component(change, 0);
            tinted(g, &[x])
        })
    }

    #[test]
    fn heights_of_more_than_uv_are_not_chosen() {
        assert_eq!(choose(&bumped(InputKind::Position), &costs(0.0)), []);
        assert_eq!(choose(&bumped(InputKind::Uv(0)), &costs(0.0)).len(), 1);
    }

    #[test]
    fn two_sets_meet_below_the_choice() {
        let network = network_of(|g| {
            let (a, b) = (costly(g, 0), costly(g, 1));
            let sum = g.apply(OpCode::math_add, &[a, b]);
            tinted(g, &[sum])
        });
        let sets: Vec<u16> = choose(&network, &costs(0.0)).iter().map(|c| c.1).collect();
        assert_eq!(sets, [0, 1]);
    }

    #[test]
    fn constants_inputs_and_views_are_never_chosen() {
        let network = network_of(|g| {
            let uv = g.value(InputKind::Uv(0));
            let u = g.component(uv, 0);
            let axis = g.input(InputKind::Uv(0), Part::AxisA);
            let swapped = g.component(axis, 1);
            let view = g.value(InputKind::Incoming);
            let seen = g.apply(OpCode::vector_dot, &[view, view]);
            let two = g.f1(2.0);
            tinted(g, &[u, swapped, seen, two])
        });
        assert_eq!(choose(&network, &costs(0.0)), []);
    }

    #[test]
    fn a_look_up_must_be_cheaper_than_what_it_saves() {
        let network = network_of(|g| {
            let a = costly(g, 0);
            tinted(g, &[a])
        });
        let cost = OpCode::series_of_halves.info().cost;
        assert_eq!(choose(&network, &costs(cost * 0.9)).len(), 1);
        assert_eq!(choose(&network, &costs(cost * 1.1)).len(), 0);
    }

    #[test]
    fn what_little_a_node_adds_to_another_is_not_looked_up() {
        // The rest needs both `a`, which is costly, and `b`, which adds little to it.
        let network = network_of(|g| {
            let a = costly(g, 0);
            let b = g.apply(OpCode::math_add, &[a, a]);
            tinted(g, &[a, b])
        });
        let cost = OpCode::series_of_halves.info().cost;
        assert_eq!(choose(&network, &costs(0.0)).len(), 2);
        let model = CostModel {
            value_ns: 0.7 * cost,
            ..costs(0.1 * cost)
        };
        let chosen = choose(&network, &model);
        let kinds: Vec<NodeKind> = chosen
            .iter()
            .map(|c| network.graph.node(c.0).kind)
            .collect();
        assert_eq!(kinds, [NodeKind::Apply(OpCode::series_of_halves, 0)]);
        let lookup_ns = 0.4 * cost;
        assert_eq!(choose(&network, &CostModel { lookup_ns, ..model }), []);
    }

    #[test]
    fn nodes_of_a_set_share_a_look_up() {
        let network = network_of(|g| {
            let a = costly(g, 0);
            let b = g.apply(OpCode::math_sine, &[a]);
            let c = costly(g, 1);
            tinted(g, &[a, b, c])
        });
        let (series, sine) = (
            OpCode::series_of_halves.info().cost,
            OpCode::math_sine.info().cost,
        );
        // One series would not pay for a look-up, but with the sine that uses it, it does.
        let model = CostModel {
            value_ns: 0.1 * sine,
            ..costs(series + 0.5 * sine)
        };
        let sets = |model| -> Vec<u16> { choose(&network, &model).iter().map(|c| c.1).collect() };
        assert_eq!(sets(model), [0, 0]);
        // The sine is not worth an entry of its own, and without it the set is not either.
        let value_ns = 1.1 * sine;
        assert_eq!(sets(CostModel { value_ns, ..model }), []);
    }

    #[test]
    fn a_wide_value_is_cached_in_two_parts() {
        let network = network_of(|g| {
            let uv = g.value(InputKind::Uv(0));
            let place = g.combine(&[uv, uv]);
            let table = g.table(crate::graph::Table {
                rows: vec![vec![0.0, 1.0]; 4],
                interpolate: true,
                extrapolate: false,
            });
            let u = g.component(place, 0);
            let wide = g.look_up(table, u);
            let height = g.value(InputKind::Pointiness);
            let mortar = g.apply(OpCode::brick_mortar, &[wide, height, height, height]);
            tinted(g, &[mortar])
        });
        let network = crate::opt::settle(split_wide(&network), crate::opt::Optimise::Nothing, 1);
        let types: Vec<Ty> = choose(&network, &costs(0.0))
            .iter()
            .map(|c| network.graph.ty(c.0))
            .collect();
        assert_eq!(types, [Ty::F3, Ty::F1]);
    }
}
