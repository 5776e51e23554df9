//! A compiled network as a Graphviz drawing.

use crate::cacheability::dependencies;
use crate::compile::Compiled;
use crate::graph::{Graph, NodeId, NodeKind};
use crate::input::Dependency;
use std::fmt::Write;

/// Draws the optimised graph: a node a value, filled where it depends on one UV set
/// alone, with a double border where it is cached.
pub fn dot(compiled: &Compiled) -> String {
    let graph = &compiled.network.graph;
    let dependencies = dependencies(graph);
    let live = compiled.network.live();
    let mut text = String::from("digraph material {\n  rankdir=LR;\n  node [shape=box];\n");
    for id in graph.ids().filter(|id| live[id.index()]) {
        let cached = compiled.cached.iter().any(|(c, _)| *c == id);
        let mut style = match dependencies[id.index()] {
            Dependency::Uv(_) => ", style=filled, fillcolor=lightblue".to_owned(),
            _ => String::new(),
        };
        if cached {
            style.push_str(", peripheries=2, penwidth=2");
        }
        let _ = writeln!(text, "  n{} [label={:?}{style}];", id.0, label(graph, id));
        for input in &graph.node(id).inputs {
            let _ = writeln!(text, "  n{} -> n{};", input.0, id.0);
        }
    }
    for (k, closure) in compiled.network.closures.iter().enumerate() {
        let _ = writeln!(
            text,
            "  c{k} [label=\"{:?}\", shape=ellipse];",
            closure.kind
        );
        let _ = writeln!(text, "  n{} -> c{k} [label=\"weight\"];", closure.weight.0);
        for (value, parameter) in closure.params.iter().zip(closure.kind.parameters()) {
            let _ = writeln!(
                text,
                "  n{} -> c{k} [label=\"{}\"];",
                value.0, parameter.name
            );
        }
    }
    text.push_str("}\n");
    text
}

fn label(graph: &Graph, id: NodeId) -> String {
    let node = graph.node(id);
    match node.kind {
        NodeKind::Const(value) => {
            let numbers: Vec<String> = value[..node.ty.width()]
                .iter()
                .map(|x| format!("{x}"))
                .collect();
            numbers.join(" ")
        }
        NodeKind::Input(input) => format!("{:?}.{:?}", input.kind, input.part),
        NodeKind::Apply(op, _) => op.info().name.to_owned(),
        NodeKind::Extract(first) => format!("[{first}..{}]", first as usize + node.ty.width()),
        NodeKind::Combine => "combine".to_owned(),
        NodeKind::Texture(texture) => format!("image {}", texture.image),
        NodeKind::Table(table) => format!("table {}", table.0),
    }
}
