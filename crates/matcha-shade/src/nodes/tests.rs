//! Groups, muted nodes, conversions, and trees that make no sense.

use super::*;
use crate::closure::ClosureKind;
use crate::graph::NodeKind;
use crate::input::InputKind;
use crate::material::ClosureNode;
use crate::source::{Link, Property, Socket};
use std::collections::BTreeMap;

fn socket(identifier: &str, kind: &str, value: &[f32]) -> Socket {
    Socket {
        identifier: identifier.into(),
        name: identifier.into(),
        kind: kind.into(),
        value: value.to_vec(),
        hide_value: false,
        enabled: true,
    }
}

fn node(kind: &str, inputs: Vec<Socket>, outputs: Vec<Socket>) -> SourceNode {
    SourceNode {
        name: format!("my {kind}"),
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

fn link(from: [u32; 2], to: [u32; 2]) -> Link {
    Link { from, to }
}

fn math(operation: &str, a: f32, b: f32) -> SourceNode {
    let inputs = vec![
        socket("Value", "VALUE", &[a]),
        socket("Value_001", "VALUE", &[b]),
    ];
    let mut node = node(
        "ShaderNodeMath",
        inputs,
        vec![socket("Value", "VALUE", &[])],
    );
    let operation = Property::Text(operation.into());
    node.props.insert("operation".into(), operation);
    node
}

fn emission() -> SourceNode {
    let inputs = vec![
        socket("Color", "RGBA", &[1.0, 0.5, 0.25, 1.0]),
        socket("Strength", "VALUE", &[2.0]),
    ];
    node(
        "ShaderNodeEmission",
        inputs,
        vec![socket("Emission", "SHADER", &[])],
    )
}

fn output() -> SourceNode {
    let inputs = vec![
        socket("Surface", "SHADER", &[]),
        socket("Volume", "SHADER", &[]),
        socket("Displacement", "VECTOR", &[0.0; 3]),
    ];
    node("ShaderNodeOutputMaterial", inputs, vec![])
}

/// A tree whose last two nodes are an emission and the output it goes to.
fn emitting(mut nodes: Vec<SourceNode>, mut links: Vec<Link>) -> NodeTree {
    nodes.push(emission());
    nodes.push(output());
    let last = nodes.len() as u32 - 1;
    links.push(link([last - 1, 0], [last, 0]));
    NodeTree {
        name: "tree".into(),
        nodes,
        links,
    }
}

fn lowered(trees: &[NodeTree]) -> Result<(MaterialGraph, LowerReport), LowerError> {
    let names = Names {
        uv: &[String::new()],
        attributes: &[],
    };
    lower(trees, 0, names, "Oak", MaterialKind::Surface)
}

/// The weight of the only closure, folded.
fn weight(trees: &[NodeTree]) -> [f32; 3] {
    let (material, _) = lowered(trees).expect("it lowers");
    let options = crate::compile::Options {
        cache: false,
        ..Default::default()
    };
    let program = crate::compile::compile(&material, &options)
        .expect("it compiles")
        .program;
    if program.closures.is_empty() {
        return [0.0; 3];
    }
    [0, 1, 2].map(|row| program.constant_output(row).expect("a constant"))
}

#[test]
fn an_emission_is_colour_times_strength() {
    assert_eq!(weight(&[emitting(vec![], vec![])]), [2.0, 1.0, 0.5]);
}

#[test]
fn links_replace_values_and_convert() {
    // 3 + 4 into the strength; a number into the colour is three equal ones.
    let tree = emitting(
        vec![math("ADD", 3.0, 4.0)],
        vec![link([0, 0], [1, 1]), link([0, 0], [1, 0])],
    );
    assert_eq!(weight(&[tree]), [49.0; 3]);
}

#[test]
fn a_colour_is_its_luminance_and_a_vector_its_mean() {
    let mut rgb = node(
        "ShaderNodeRGB",
        vec![],
        vec![socket("Color", "RGBA", &[1.0, 0.0, 0.0, 1.0])],
    );
    rgb.name = "red".into();
    let tree = emitting(vec![rgb], vec![link([0, 0], [1, 1])]);
    let w = weight(&[tree]);
    assert!((w[0] - 0.212_672_9).abs() < 1e-6, "{w:?}");
    let combine = node(
        "ShaderNodeCombineXYZ",
        vec![
            socket("X", "VALUE", &[3.0]),
            socket("Y", "VALUE", &[0.0]),
            socket("Z", "VALUE", &[0.0]),
        ],
        vec![socket("Vector", "VECTOR", &[])],
    );
    let tree = emitting(vec![combine], vec![link([0, 0], [1, 1])]);
    assert_eq!(weight(&[tree])[0], 1.0);
}

/// A group that doubles its input.
fn doubling() -> NodeTree {
    let input = node(
        "NodeGroupInput",
        vec![],
        vec![socket("Socket_0", "VALUE", &[])],
    );
    let output = node(
        "NodeGroupOutput",
        vec![socket("Socket_1", "VALUE", &[0.0])],
        vec![],
    );
    NodeTree {
        name: "twice".into(),
        nodes: vec![input, math("MULTIPLY", 0.0, 2.0), output],
        links: vec![link([0, 0], [1, 0]), link([1, 0], [2, 0])],
    }
}

fn group(tree: u32, value: f32) -> SourceNode {
    let inputs = vec![socket("Socket_0", "VALUE", &[value])];
    let mut group = node(
        "ShaderNodeGroup",
        inputs,
        vec![socket("Socket_1", "VALUE", &[])],
    );
    group.tree = Some(tree);
    group
}

#[test]
fn groups_are_inlined_each_with_its_own_inputs() {
    let nodes = vec![group(1, 5.0), group(1, 0.0)];
    let links = vec![link([0, 0], [1, 0]), link([1, 0], [2, 1])];
    // 5, doubled by one group, doubled by the other.
    let inlined = weight(&[emitting(nodes, links), doubling()]);
    assert_eq!(inlined, [20.0, 10.0, 5.0]);
    // The same without groups.
    let nodes = vec![math("MULTIPLY", 5.0, 2.0), math("MULTIPLY", 0.0, 2.0)];
    let links = vec![link([0, 0], [1, 0]), link([1, 0], [2, 1])];
    assert_eq!(weight(&[emitting(nodes, links)]), inlined);
}

#[test]
fn groups_nest() {
    let mut outer = doubling();
    outer.nodes[1] = group(2, 0.0);
    let tree = emitting(vec![group(1, 3.0)], vec![link([0, 0], [1, 1])]);
    assert_eq!(weight(&[tree, outer, doubling()])[0], 6.0);
}

#[test]
fn muted_nodes_hand_on_and_reroutes_too() {
    let mut muted = math("MULTIPLY", 7.0, 100.0);
    muted.muted = true;
    muted.internal_links = vec![[0, 0]];
    let reroute = node(
        "NodeReroute",
        vec![socket("Input", "VALUE", &[0.0])],
        vec![socket("Output", "VALUE", &[])],
    );
    let nodes = vec![muted, reroute, math("ADD", 3.0, 4.0)];
    let mut links = vec![link([0, 0], [1, 0]), link([1, 0], [3, 1])];
    // Where nothing comes in, Cycles hands zero on, not the socket's own value.
    assert_eq!(weight(&[emitting(nodes.clone(), links.clone())]), [0.0; 3]);
    links.push(link([2, 0], [0, 0]));
    assert_eq!(weight(&[emitting(nodes, links)])[0], 7.0);
}

/// A checker texture whose coordinate is linked to a group's input, a muted node or a reroute.
fn checker_behind(mut source: SourceNode) -> NodeTree {
    source.outputs = vec![socket("Vector", "VECTOR", &[])];
    let checker = node(
        "ShaderNodeTexChecker",
        vec![
            socket("Vector", "VECTOR", &[0.0; 3]),
            socket("Color1", "RGBA", &[1.0; 4]),
            socket("Color2", "RGBA", &[0.0; 4]),
            socket("Scale", "VALUE", &[5.0]),
        ],
        vec![socket("Color", "RGBA", &[])],
    );
    let links = vec![link([0, 0], [1, 0]), link([1, 0], [2, 0])];
    emitting(vec![source, checker], links)
}

#[test]
fn what_a_light_reads_of_a_surface_is_zero_and_said() {
    for (kind, output) in [
        ("ShaderNodeTexCoord", "UV"),
        ("ShaderNodeTexCoord", "Object"),
        ("ShaderNodeNewGeometry", "Parametric"),
        ("ShaderNodeObjectInfo", "Random"),
    ] {
        let source = node(kind, vec![], vec![socket(output, "VECTOR", &[])]);
        let mut tree = emitting(vec![source], vec![link([0, 0], [1, 1])]);
        tree.nodes[2].kind = "ShaderNodeOutputLight".into();
        let names = Names {
            uv: &[String::new()],
            attributes: &[],
        };
        let (_, report) = lower(&[tree], 0, names, "Lamp", MaterialKind::Light).expect(kind);
        let said: Vec<String> = report.items.iter().map(|item| item.kind.clone()).collect();
        assert_eq!(said, [format!("the output {output} of {kind} in a light")]);
    }
}

#[test]
fn a_missing_uv_map_is_zero() {
    let mut map = node("ShaderNodeUVMap", vec![], vec![socket("UV", "VECTOR", &[])]);
    let name = Property::Text("Second".into());
    map.props.insert("uv_map".into(), name);
    assert_eq!(
        weight(&[emitting(vec![map], vec![link([0, 0], [1, 1])])]),
        [0.0; 3]
    );
}

#[test]
fn a_coordinate_that_nothing_feeds_is_the_default() {
    let reads_generated = |trees: &[NodeTree]| {
        let (material, _) = lowered(trees).expect("it lowers");
        material.graph.nodes().iter().any(|node| {
            matches!(node.kind, NodeKind::Input(input) if input.kind == InputKind::Generated)
        })
    };
    let vector = || vec![socket("Vector", "VECTOR", &[0.5; 3])];
    let mut muted = node("ShaderNodeMapping", vector(), vec![]);
    muted.muted = true;
    muted.internal_links = vec![[0, 0]];
    assert!(reads_generated(&[checker_behind(muted)]));
    let reroute = node("NodeReroute", vector(), vec![]);
    assert!(reads_generated(&[checker_behind(reroute)]));

    let mut inner = checker_behind(node("NodeGroupInput", vec![], vec![]));
    inner.nodes[3] = node(
        "NodeGroupOutput",
        vec![socket("Shader", "SHADER", &[])],
        vec![],
    );
    let mut group = node(
        "ShaderNodeGroup",
        vector(),
        vec![socket("Shader", "SHADER", &[])],
    );
    group.tree = Some(1);
    let mut outer = emitting(vec![group, math("ADD", 1.0, 1.0)], vec![]);
    outer.links = vec![link([0, 0], [3, 0])];
    assert!(reads_generated(&[outer.clone(), inner.clone()]));
    outer.links.push(link([1, 0], [0, 0]));
    assert!(!reads_generated(&[outer, inner]));
}

#[test]
fn a_chain_of_any_length_lowers() {
    let count = 100_000;
    let nodes = (0..count).map(|_| math("ADD", 1.0, 0.0)).collect();
    let mut links: Vec<Link> = (1..count).map(|i| link([i - 1, 0], [i, 0])).collect();
    links.push(link([count - 1, 0], [count, 1]));
    assert!(lowered(&[emitting(nodes, links)]).is_ok());
}

#[test]
fn cycles_are_named() {
    let nodes = vec![math("ADD", 1.0, 0.0), math("ADD", 1.0, 0.0)];
    let links = vec![
        link([0, 0], [1, 0]),
        link([1, 0], [0, 0]),
        link([1, 0], [2, 1]),
    ];
    let error = lowered(&[emitting(nodes, links)]).expect_err("a cycle");
    let text = error.to_string();
    assert_eq!(
        text,
        "material \"Oak\", node \"my ShaderNodeMath\": its input depends on its own output"
    );
}

#[test]
fn a_group_in_itself_is_named() {
    let mut inner = doubling();
    inner.nodes[1] = group(1, 0.0);
    let tree = emitting(vec![group(1, 3.0)], vec![link([0, 0], [1, 1])]);
    let error = lowered(&[tree, inner]).expect_err("nested");
    assert!(
        matches!(&error, LowerError::Nested(_, name) if name == "twice"),
        "{error}"
    );
}

#[test]
fn loose_links_missing_sockets_and_bad_modes_are_errors() {
    let tree = emitting(vec![math("ADD", 1.0, 1.0)], vec![link([0, 3], [1, 1])]);
    assert!(matches!(lowered(&[tree]), Err(LowerError::Link { .. })));
    let mut short = math("ADD", 1.0, 1.0);
    short.inputs.pop();
    let tree = emitting(vec![short], vec![link([0, 0], [1, 1])]);
    assert!(matches!(lowered(&[tree]), Err(LowerError::Socket(_, s)) if s == "Value_001"));
    let tree = emitting(
        vec![math("CONJUGATE", 1.0, 1.0)],
        vec![link([0, 0], [1, 1])],
    );
    assert!(
        matches!(lowered(&[tree]), Err(LowerError::Property(_, p, v)) if p == "operation" && v == "CONJUGATE")
    );
    assert!(matches!(
        lowered(&[]),
        Err(LowerError::Tree { tree: 0, .. })
    ));
}

#[test]
fn unknown_nodes_are_reported_once_and_replaced() {
    let unknown = node(
        "ShaderNodeTexGabor",
        vec![],
        vec![socket("Value", "VALUE", &[])],
    );
    let links = vec![link([0, 0], [1, 1]), link([0, 0], [1, 0])];
    let tree = emitting(vec![unknown], links);
    let (_, report) = lowered(std::slice::from_ref(&tree)).expect("it lowers");
    assert_eq!(report.items.len(), 1);
    assert_eq!(report.items[0].kind, "ShaderNodeTexGabor");
    assert_eq!(report.items[0].node, "my ShaderNodeTexGabor");
    assert_eq!(weight(&[tree]), [0.25; 3]);
}

/// What is not honoured of nodes that are known: with what is reported.
#[rustfmt::skip]
fn not_honoured() -> Vec<(SourceNode, &'static str)> {
    let make = |kind: &str, output: (&str, &str), inputs: &[(&str, &str, f32)], props: &[(&str, &str)]| {
        let inputs = inputs.iter().map(|(name, ty, value)| {
            let width = match *ty { "VALUE" => 1, "RGBA" => 4, _ => 3 };
            socket(name, ty, &vec![*value; width])
        });
        let mut made = node(kind, inputs.collect(), vec![socket(output.0, output.1, &[])]);
        for (key, value) in props {
            made.props.insert((*key).into(), Property::Text((*value).into()));
        }
        made
    };
    let shader = ("BSDF", "SHADER");
    let color = ("Color", "RGBA");
    let vector = ("Vector", "VECTOR");
    let film = [("Color", "RGBA", 1.0), ("Roughness", "VALUE", 0.1), ("IOR", "VALUE", 1.5), ("Thin Film Thickness", "VALUE", 300.0)];
    let displaced = [("Vector", "VECTOR", 0.1), ("Midlevel", "VALUE", 0.0), ("Scale", "VALUE", 1.0)];
    let bump = [("Strength", "VALUE", 1.0), ("Distance", "VALUE", 1.0), ("Height", "VALUE", 0.0)];
    vec![
        (make("ShaderNodeBsdfMetallic", shader, &[("Base Color", "RGBA", 0.5), ("Roughness", "VALUE", 0.2)], &[("distribution", "GGX")]), "ShaderNodeBsdfMetallic"),
        (make("ShaderNodeBsdfToon", shader, &[("Color", "RGBA", 0.5)], &[]), "ShaderNodeBsdfToon"),
        (make("ShaderNodeBsdfGlass", shader, &film, &[("distribution", "GGX")]), "a thin film on glass"),
        (make("ShaderNodeBsdfPrincipled", shader, &film[3..], &[("distribution", "GGX"), ("subsurface_method", "BURLEY")]), "a thin film on ShaderNodeBsdfPrincipled"),
        (make("ShaderNodeSubsurfaceScattering", ("BSSRDF", "SHADER"), &[("Color", "RGBA", 0.5), ("Scale", "VALUE", 1.0), ("Radius", "VECTOR", 1.0)], &[]), "ShaderNodeSubsurfaceScattering"),
        (make("ShaderNodeVolumeScatter", ("Volume", "SHADER"), &[], &[]), "ShaderNodeVolumeScatter"),
        (make("ShaderNodeTexImage", color, &[], &[]), "an image texture without an image"),
        (make("ShaderNodeAttribute", color, &[], &[("attribute_type", "OBJECT")]), "an attribute of type OBJECT"),
        (make("ShaderNodeAttribute", color, &[], &[("attribute_type", "GEOMETRY"), ("attribute_name", "dirt")]), "the missing attribute \"dirt\""),
        (make("ShaderNodeUVMap", ("UV", "VECTOR"), &[], &[("uv_map", "Second")]), "the missing UV map \"Second\""),
        (make("ShaderNodeTexCoord", ("Normal", "VECTOR"), &[], &[]), "the output Normal of ShaderNodeTexCoord"),
        (make("ShaderNodeLightPath", ("Is Volume Scatter Ray", "VALUE"), &[], &[]), "the output Is Volume Scatter Ray of ShaderNodeLightPath"),
        (make("ShaderNodeVectorTransform", vector, &[("Vector", "VECTOR", 1.0)], &[("convert_from", "WORLD"), ("convert_to", "CAMERA")]), "ShaderNodeVectorTransform"),
        (make("ShaderNodeNormalMap", ("Normal", "VECTOR"), &[("Strength", "VALUE", 1.0), ("Color", "RGBA", 0.5)], &[("space", "OBJECT")]), "the object space of ShaderNodeNormalMap"),
        (make("ShaderNodeVectorDisplacement", ("Displacement", "VECTOR"), &displaced, &[("space", "OBJECT")]), "ShaderNodeVectorDisplacement"),
        (make("ShaderNodeBump", ("Normal", "VECTOR"), &bump, &[]), ""),
    ]
}

#[test]
fn what_is_not_honoured_of_known_nodes_is_reported() {
    for (source, kind) in not_honoured() {
        let shader = source.outputs[0].kind == "SHADER";
        let mut tree = emitting(vec![source], vec![]);
        if shader {
            tree.links = vec![link([0, 0], [2, 0])];
        } else {
            tree.links.push(link([0, 0], [1, 0]));
        }
        let (_, report) = lowered(&[tree]).unwrap_or_else(|error| panic!("{kind}: {error}"));
        let kinds: Vec<&str> = report.items.iter().map(|item| item.kind.as_str()).collect();
        let expected: &[&str] = if kind.is_empty() { &[] } else { &[kind] };
        assert_eq!(kinds, expected);
    }
}

fn glossy_with_displacement(space: &str) -> MaterialGraph {
    let uv = node("ShaderNodeUVMap", vec![], vec![socket("UV", "VECTOR", &[])]);
    let inputs = vec![
        socket("Height", "VALUE", &[0.0]),
        socket("Midlevel", "VALUE", &[0.5]),
        socket("Scale", "VALUE", &[1.0]),
        socket("Normal", "VECTOR", &[0.0; 3]),
    ];
    let mut displacement = node(
        "ShaderNodeDisplacement",
        inputs,
        vec![socket("Displacement", "VECTOR", &[])],
    );
    displacement
        .props
        .insert("space".into(), Property::Text(space.into()));
    let inputs = vec![
        socket("Color", "RGBA", &[1.0; 4]),
        socket("Roughness", "VALUE", &[0.0]),
        socket("Normal", "VECTOR", &[0.0; 3]),
    ];
    let diffuse = node(
        "ShaderNodeBsdfDiffuse",
        inputs,
        vec![socket("BSDF", "SHADER", &[])],
    );
    let nodes = vec![uv, displacement, diffuse, output()];
    let links = vec![
        link([0, 0], [1, 0]),
        link([1, 0], [3, 2]),
        link([2, 0], [3, 0]),
    ];
    let tree = NodeTree {
        name: "tree".into(),
        nodes,
        links,
    };
    lowered(&[tree]).expect("it lowers").0
}

#[test]
fn a_displacement_bends_the_normals_that_nothing_names() {
    let material = glossy_with_displacement("WORLD");
    let Some(root) = material.closures.root else {
        panic!("no closure");
    };
    let nodes = material.closures.nodes();
    let ClosureNode::Add(surface, bent) = nodes[root.0 as usize] else {
        panic!("no normal beside the surface");
    };
    let (
        ClosureNode::Leaf { params, .. },
        ClosureNode::Leaf {
            kind: ClosureKind::ShadingNormal,
            params: bent,
            ..
        },
    ) = (&nodes[surface.0 as usize], &nodes[bent.0 as usize])
    else {
        panic!("no leaves");
    };
    assert_eq!(params[1], bent[0]);
    let normal = material.graph.node(params[1]);
    assert!(matches!(normal.kind, NodeKind::Apply(op, _) if op.info().name == "bump_bend"));
    // The height is of UV alone: its gradient in UV is what the cache may keep.
    let reads_gradient = |m: &MaterialGraph| {
        let nodes = m.graph.nodes();
        nodes
            .iter()
            .any(|n| matches!(n.kind, NodeKind::Apply(op, _) if op.info().name == "uv_gradient"))
    };
    assert!(reads_gradient(&material));
    assert!(reads_gradient(&glossy_with_displacement("OBJECT")));
}

#[test]
fn every_node_type_is_in_the_table_once() {
    let mut kinds: Vec<&str> = nodes().map(|n| n.kind).collect();
    let count = kinds.len();
    kinds.sort_unstable();
    kinds.dedup();
    assert_eq!(kinds.len(), count);
}

/// `docs/nodes.md`, from the table.
fn documentation() -> String {
    let mut text = String::from(
        "# Nodes\n\nThe node types of Blender that are lowered, from the table in\n\
         `crates/matcha-shade/src/nodes/table.rs`. Groups, reroutes and muted nodes are followed.\n\
         Anything else is reported and replaced: a closure by grey diffuse, a colour by grey, a\n\
         vector by zeros, a number by 0.5. `MATCHA_WRITE_DOCS=1 cargo test -p matcha-shade` writes\n\
         this file anew.\n\n| menu | type | limits |\n|---|---|---|\n",
    );
    for node in nodes() {
        text += &format!("| {} | `{}` | {} |\n", node.menu, node.kind, node.limits);
    }
    text
}

#[test]
fn the_documentation_of_nodes_is_current() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/nodes.md");
    if std::env::var_os("MATCHA_WRITE_DOCS").is_some() {
        std::fs::write(&path, documentation()).expect("docs/nodes.md can be written");
    }
    let found = std::fs::read_to_string(&path).expect("docs/nodes.md");
    assert_eq!(
        found,
        documentation(),
        "docs/nodes.md is not what the table says"
    );
}
