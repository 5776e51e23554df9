//! Every node against Cycles: `data/nodes.json` holds nodes with their settings, inputs
//! and what Blender 4.5's Cycles gave for them (`blender/tests/node_reference.py`).

mod support;

use matcha_shade::compile::{Options, compile};
use matcha_shade::input::InputKind;
use matcha_shade::material::MaterialKind;
use matcha_shade::nodes::{self, Names};
use matcha_shade::rows::Rows;
use matcha_shade::source::{Link, NodeTree, Property, Socket, SourceNode};
use matcha_shade::vm::{Isa, Machine};
use serde_json::Value;
use std::collections::BTreeMap;
use support::Formulas;

fn reference() -> Value {
    let text = include_str!("data/nodes.json");
    serde_json::from_str(text).expect("nodes.json is JSON")
}

fn socket(identifier: &str, kind: &str, value: Vec<f32>) -> Socket {
    Socket {
        identifier: identifier.into(),
        name: identifier.into(),
        kind: kind.into(),
        value,
        hide_value: false,
        enabled: true,
    }
}

fn node(kind: &str, inputs: Vec<Socket>, outputs: Vec<Socket>) -> SourceNode {
    SourceNode {
        name: kind.into(),
        kind: kind.into(),
        props: BTreeMap::new(),
        inputs,
        outputs,
        muted: false,
        internal_links: vec![],
        tree: None,
        image: None,
        ramp: None,
        curves: None,
        texture_mapping: None,
        object_from_world: None,
    }
}

/// Adds the nodes that read `a` or `a.x`; returns the socket to link from.
fn source(tree: &mut NodeTree, text: &str) -> [u32; 2] {
    let (name, part) = text.split_once('.').unwrap_or((text, ""));
    let outputs = ["Color", "Vector"].map(|n| socket(n, "VECTOR", vec![]));
    let mut attribute = node("ShaderNodeAttribute", vec![], outputs.into());
    let property = Property::Text(name.into());
    attribute.props.insert("attribute_name".into(), property);
    tree.nodes.push(attribute);
    let at = tree.nodes.len() as u32 - 1;
    if part.is_empty() {
        return [at, 1];
    }
    let outputs = ["X", "Y", "Z"].map(|n| socket(n, "VALUE", vec![]));
    let input = socket("Vector", "VECTOR", vec![0.0; 3]);
    tree.nodes
        .push(node("ShaderNodeSeparateXYZ", vec![input], outputs.into()));
    tree.links.push(Link {
        from: [at, 1],
        to: [at + 1, 0],
    });
    let index = ["x", "y", "z"].iter().position(|p| *p == part);
    [at + 1, index.expect("a component") as u32]
}

fn tree_of(case: &Value) -> NodeTree {
    let mut tree = NodeTree {
        name: "case".into(),
        ..NodeTree::default()
    };
    let text = |v: &Value| v.as_str().expect("a text").to_owned();
    let output = socket(&text(&case["output"][0]), &text(&case["output"][1]), vec![]);
    let mut tested = node(&text(&case["type"]), vec![], vec![output]);
    tested.props = serde_json::from_value(case["props"].clone()).expect("properties");
    if let Some(ramp) = case.get("ramp") {
        tested.ramp = Some(serde_json::from_value(ramp.clone()).expect("a ramp"));
    }
    if let Some(curves) = case.get("curves") {
        tested.curves = Some(serde_json::from_value(curves.clone()).expect("curves"));
    }
    if let Some(value) = case.get("value") {
        tested.outputs.insert(0, socket("Normal", "VECTOR", vec![]));
        tested.outputs[0].value = serde_json::from_value(value.clone()).expect("a vector");
    }
    let mut wires = vec![];
    for (identifier, entry) in case["inputs"].as_object().expect("inputs") {
        let value = match &entry[1] {
            Value::String(source) => {
                wires.push((tested.inputs.len() as u32, source.clone()));
                vec![0.0; 4]
            }
            Value::Array(list) => list.iter().map(|x| x.as_f64().unwrap() as f32).collect(),
            Value::Bool(flag) => vec![f32::from(*flag)],
            number => vec![number.as_f64().expect("a number") as f32],
        };
        tested
            .inputs
            .push(socket(identifier, &text(&entry[0]), value));
    }
    let output_index = tested.outputs.len() as u32 - 1;
    tree.nodes.push(tested);
    for (input, text) in wires {
        let from = source(&mut tree, &text);
        tree.links.push(Link {
            from,
            to: [0, input],
        });
    }
    let inputs = vec![
        socket("Color", "RGBA", vec![1.0; 4]),
        socket("Strength", "VALUE", vec![1.0]),
    ];
    let emission = node(
        "ShaderNodeEmission",
        inputs,
        vec![socket("Emission", "SHADER", vec![])],
    );
    let surface = vec![socket("Surface", "SHADER", vec![])];
    tree.nodes.push(emission);
    tree.nodes
        .push(node("ShaderNodeOutputMaterial", surface, vec![]));
    let last = tree.nodes.len() as u32;
    tree.links.push(Link {
        from: [0, output_index],
        to: [last - 2, 0],
    });
    tree.links.push(Link {
        from: [last - 2, 0],
        to: [last - 1, 0],
    });
    tree
}

/// The emission of the case at every point.
fn evaluate(case: &Value, points: &[Vec<[f32; 3]>], isa: Isa) -> Vec<[f32; 3]> {
    let trees = [tree_of(case)];
    let attributes = ["a", "b", "c"].map(String::from);
    let names = Names {
        uv: &[String::new()],
        attributes: &attributes,
    };
    let (material, report) = nodes::lower(&trees, 0, names, "case", MaterialKind::Surface)
        .unwrap_or_else(|e| panic!("{e}"));
    assert!(report.items.is_empty(), "{:?}", report.items);
    let options = Options {
        cache: false,
        ..Options::default()
    };
    let program = compile(&material, &options).expect("it compiles").program;
    let n = points[0].len();
    let mut inputs = Rows::new(program.input_rows().max(1), n);
    for (input, row) in &program.inputs {
        let InputKind::Attribute(index) = input.kind else {
            panic!("{case}: reads {input:?}");
        };
        for (k, point) in points[index as usize].iter().enumerate() {
            for (i, x) in point.iter().enumerate() {
                inputs.set(row + i, k, *x);
            }
            inputs.set(row + 3, k, 1.0);
        }
    }
    let mut out = Rows::default();
    let mut machine = Machine::new(Some(isa));
    machine.run(&program, n, &inputs, &[], &Formulas, None, &mut out);
    if program.closures.is_empty() {
        return vec![[0.0; 3]; n];
    }
    (0..n).map(|k| [0, 1, 2].map(|i| out.get(i, k))).collect()
}

/// Largest error relative to max(1, |expected|) that a case may have, and how many of its
/// numbers may be anything because a step function's argument lies on a step.
fn tolerance(case: &Value) -> (f32, usize) {
    let kind = case["type"].as_str().unwrap_or("");
    let text = |name: &str| case["props"][name].as_str().unwrap_or("");
    match kind {
        // Poles, and powers of large numbers.
        "ShaderNodeMath" if matches!(text("operation"), "TANGENT" | "POWER" | "LOGARITHM") => {
            (2e-4, 0)
        }
        "ShaderNodeVectorMath" if text("operation") == "TANGENT" => (5e-4, 0),
        "ShaderNodeBlackbody" => (2e-3, 0),
        "ShaderNodeWavelength" => (1e-4, 0),
        _ => (2e-5, 0),
    }
}

#[test]
fn nodes_give_what_cycles_gives() {
    let data = reference();
    let points: Vec<Vec<[f32; 3]>> =
        serde_json::from_value(data["points"].clone()).expect("points");
    let mut failures = vec![];
    for case in data["cases"].as_array().expect("cases") {
        let expected: Vec<[f32; 3]> =
            serde_json::from_value(case["expected"].clone()).expect("numbers");
        let (allowed, free) = tolerance(case);
        for isa in [Isa::Scalar, Isa::best()] {
            let got = evaluate(case, &points, isa);
            let mut wrong = vec![];
            for (k, (g, e)) in got.iter().zip(&expected).enumerate() {
                for (g, e) in g.iter().zip(e) {
                    let error = (g - e).abs() / e.abs().max(1.0);
                    if error.is_nan() || error > allowed {
                        wrong.push((error, k, *g, *e));
                    }
                }
            }
            if wrong.len() > free {
                let worst = wrong
                    .iter()
                    .max_by(|x, y| x.0.total_cmp(&y.0))
                    .expect("one");
                failures.push(format!(
                    "{} {} {}: {} wrong, worst {worst:?} ({isa:?})",
                    case["type"],
                    case["props"],
                    case["output"],
                    wrong.len()
                ));
            }
        }
    }
    assert!(
        failures.is_empty(),
        "{} fail:\n{}",
        failures.len(),
        failures.join("\n")
    );
}
