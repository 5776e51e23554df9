use super::*;
use matcha_shade::source::{Link, Socket};

fn socket(name: &str) -> Socket {
    Socket {
        identifier: name.into(),
        name: name.into(),
        kind: "VALUE".into(),
        value: vec![0.0],
        hide_value: false,
        enabled: true,
    }
}

fn node(name: &str) -> SourceNode {
    SourceNode {
        name: name.into(),
        kind: "ShaderNodeMath".into(),
        props: Default::default(),
        inputs: vec![socket("A"), socket("B")],
        outputs: vec![socket("Value")],
        muted: false,
        internal_links: Vec::new(),
        tree: None,
        image: None,
        ramp: None,
        curves: None,
        texture_mapping: None,
        object_from_world: None,
    }
}

fn tree(nodes: Vec<SourceNode>, links: &[(u32, u32)]) -> NodeTree {
    let links = links
        .iter()
        .map(|&(from, to)| Link {
            from: [from, 0],
            to: [to, 0],
        })
        .collect();
    NodeTree {
        name: "T".into(),
        nodes,
        links,
    }
}

fn check(list: &[NodeTree]) -> Result<(), String> {
    let names: Vec<String> = (0..list.len())
        .map(|i| format!("material \"M{i}\""))
        .collect();
    trees(list, 1, &names).map_err(|fault| format!("{}: {}", fault.place, fault.problem))
}

fn refused(list: &[NodeTree], sentence: &str) {
    assert_eq!(check(list).unwrap_err(), sentence);
}

#[test]
fn good_trees_pass() {
    let diamond = tree(
        vec![node("a"), node("b"), node("c"), node("d")],
        &[(0, 1), (0, 2), (1, 3), (2, 3)],
    );
    let mut group = node("g");
    group.tree = Some(0);
    let user = tree(vec![group.clone(), group], &[(0, 1)]);
    check(&[diamond, user]).unwrap();
}

#[test]
fn a_cycle_is_named_by_a_node_on_it() {
    // 0 → 1 → 2 → 1, and 3 behind the cycle.
    let list = [tree(
        vec![node("in"), node("x"), node("y"), node("out")],
        &[(0, 1), (1, 2), (2, 1), (2, 3)],
    )];
    let sentence = check(&list).unwrap_err();
    assert!(
        sentence == "material \"M0\", node \"x\": its input depends on its own output"
            || sentence == "material \"M0\", node \"y\": its input depends on its own output",
        "{sentence}"
    );
    refused(
        &[tree(vec![node("self")], &[(0, 0)])],
        "material \"M0\", node \"self\": its input depends on its own output",
    );
}

#[test]
fn a_group_inside_itself() {
    let (mut a, mut b) = (node("to b"), node("to a"));
    (a.tree, b.tree) = (Some(1), Some(0));
    refused(
        &[tree(vec![a], &[]), tree(vec![b], &[])],
        "material \"M1\", node \"to a\": the group \"T\" contains itself",
    );
}

#[test]
fn groups_that_multiply() {
    let mut list: Vec<NodeTree> = (1..40)
        .map(|next| {
            let mut g = node("g");
            g.tree = Some(next);
            tree(vec![g.clone(), g], &[])
        })
        .collect();
    list.push(tree(vec![node("leaf")], &[]));
    let sentence = check(&list).unwrap_err();
    assert!(
        sentence.contains("with its groups written out, more than 1000000"),
        "{sentence}"
    );
}

#[test]
fn loose_ends_and_missing_things() {
    refused(
        &[tree(vec![node("a")], &[(0, 7)])],
        "material \"M0\": link 0, from socket 0 of node 0 to socket 0 of node 7, has a loose end",
    );
    let mut image = node("a");
    image.image = Some(1);
    refused(
        &[tree(vec![image], &[])],
        "material \"M0\", node \"a\": its image 1 does not exist",
    );
    let mut group = node("a");
    group.tree = Some(9);
    refused(
        &[tree(vec![group], &[])],
        "material \"M0\", node \"a\": its group, tree 9, does not exist",
    );
    let mut muted = node("a");
    muted.internal_links = vec![[0, 4]];
    refused(
        &[tree(vec![muted], &[])],
        "material \"M0\", node \"a\": an internal link has no socket at its end",
    );
}

#[test]
fn tables_and_numbers() {
    let mut curve = node("c");
    curve.curves = Some(Curves {
        curves: Vec::new(),
        extend: "HORIZONTAL".into(),
        range: [0.0, 1.0],
        tables: vec![vec![0.0; 256]],
    });
    refused(
        &[tree(vec![curve], &[])],
        "material \"M0\", node \"c\": a curve's table has 256 numbers instead of 257",
    );
    let mut ramp = node("r");
    ramp.ramp = Some(Ramp {
        color_mode: "RGB".into(),
        interpolation: "LINEAR".into(),
        hue_interpolation: "NEAR".into(),
        stops: Vec::new(),
        table: vec![0.0; 3],
    });
    refused(
        &[tree(vec![ramp], &[])],
        "material \"M0\", node \"r\": its colour ramp's table has 3 numbers instead of four for each of 2 or more samples",
    );
    let mut matrix = node("m");
    matrix.texture_mapping = Some([f32::INFINITY; 16]);
    refused(
        &[tree(vec![matrix], &[])],
        "material \"M0\", node \"m\": its matrix is not finite",
    );
    let mut value = node("v");
    value.inputs[0].value = vec![f32::NAN];
    refused(
        &[tree(vec![value], &[])],
        "material \"M0\", node \"v\": the value of socket \"A\" is not 0 to 4 finite numbers",
    );
}
