//! A network in Graphviz' language, as it is after all passes: cacheable nodes filled
//! green, what lies under them only, and is skipped on a hit, light green.

use super::inspect::name_of;
use matcha_shade::cacheability;
use matcha_shade::compile::Compiled;
use matcha_shade::graph::{Graph, NodeId, NodeKind};
use std::fmt::Write;

pub(super) fn draw(name: &str, compiled: &Compiled) -> String {
    let network = &compiled.network;
    let graph = &network.graph;
    let live = network.live();
    let colors = colors(compiled);
    let dependencies = cacheability::dependencies(graph);
    let mut dot = format!(
        "digraph {} {{\n  rankdir=BT; node [shape=box, style=filled];\n",
        quoted(name)
    );
    for id in graph.ids().filter(|id| live[id.index()]) {
        let label = format!(
            "{}\\n{}",
            label(graph, id),
            name_of(dependencies[id.index()])
        );
        let color = colors[id.index()];
        let _ = writeln!(
            dot,
            "  n{} [label={}, fillcolor=\"{color}\"];",
            id.0,
            quoted(&label)
        );
        for input in &graph.node(id).inputs {
            let _ = writeln!(dot, "  n{} -> n{};", input.0, id.0);
        }
    }
    for (k, closure) in network.closures.iter().enumerate() {
        let label = quoted(&format!("{:?}", closure.kind));
        let _ = writeln!(
            dot,
            "  c{k} [label={label}, shape=ellipse, fillcolor=\"#ffd8a8\"];"
        );
        let inputs = std::iter::once(&closure.weight).chain(&closure.params);
        for input in inputs.filter(|input| !matches!(graph.node(**input).kind, NodeKind::Const(_)))
        {
            let _ = writeln!(dot, "  n{} -> c{k};", input.0);
        }
    }
    dot + "}\n"
}

fn colors(compiled: &Compiled) -> Vec<&'static str> {
    let graph = &compiled.network.graph;
    let mut colors = vec!["#ffffff"; graph.nodes().len()];
    let mut stack: Vec<NodeId> = compiled.cached.iter().map(|&(id, _)| id).collect();
    while let Some(id) = stack.pop() {
        for &input in &graph.node(id).inputs {
            if colors[input.index()] == "#ffffff" {
                colors[input.index()] = "#d8f5a2";
                stack.push(input);
            }
        }
    }
    for &(id, _) in &compiled.cached {
        colors[id.index()] = "#74b816";
    }
    colors
}

fn label(graph: &Graph, id: NodeId) -> String {
    let node = graph.node(id);
    match node.kind {
        NodeKind::Const(value) => format!("{:?}", &value[..node.ty.width()]),
        NodeKind::Input(input) => format!("{:?} {:?}", input.kind, input.part),
        NodeKind::Apply(op, _) => format!("{op:?}"),
        NodeKind::Extract(first) => format!("component {first}"),
        NodeKind::Combine => "combine".into(),
        NodeKind::Texture(texture) => format!("image {}", texture.image),
        NodeKind::Table(table) => format!("table {}", table.0),
    }
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\\\""))
}
