//! Views, references and columns on a device against the same code on the processor.

use crate::adapter::{Device, Point};
use crate::memory_probes::{
    self as probes, ProbeItem, ProbeNode, ProbeSet, ProbeView, probe_hash, probe_make,
};
use crate::support::{device_modules, module};
use crate::{COUNT, points, probe_wgsl};
use matcha_wgsl::{Module, Translation, Value, translate};

const FILE: &str = "matcha-wgsl/tests/device/memory_probes.rs";

fn code(probes: Module) -> Translation {
    let mut modules = device_modules();
    modules.push(probes);
    translate(&modules).unwrap_or_else(|e| panic!("{e}"))
}

/// Random words as nodes; floats are whole, so that no bits are lost on the way.
fn nodes(count: usize) -> Vec<ProbeNode> {
    let seeds = points::words(count, 11);
    let number = |word: u32| (word & 0xffff) as f32;
    let node = |w: &Point| ProbeNode {
        at: glam::Vec3::new(number(w[0]), number(w[1]), number(w[2])),
        child: w[3],
        weights: std::array::from_fn(|i| w[4 + i]),
        kind: (w[1] >> 8) as i32 - 1000,
        pair: glam::Vec2::new(number(w[5]), number(w[6])),
    };
    seeds.iter().map(node).collect()
}

/// Host functions for a field, over the words themselves.
fn host(field: &str, words: &[u32], elements: usize) -> String {
    let count = words.len();
    let list: Vec<String> = words.iter().map(|w| format!("{w}u")).collect();
    format!(
        "var<private> {field}_words: array<u32, {count}> = array<u32, {count}>({});\n\
         fn word_ProbeView_{field}(i: u32) -> u32 {{ return {field}_words[i]; }}\n\
         fn count_ProbeView_{field}() -> u32 {{ return {elements}u; }}\n",
        list.join(", ")
    )
}

/// How many points differ between a device and the processor for some code of the probes.
fn differing(device: &Device, code: &Translation) -> usize {
    let nodes = nodes(13);
    let order = [4, 2, 0, 10, 1, 11, 3, 7];
    let view = ProbeView {
        nodes: &nodes,
        order: &order,
        bias: -77,
        corners: [nodes[5].at, nodes[6].at],
        root: nodes[9],
    };
    let wgsl = [
        host("nodes", bytemuck::cast_slice(view.nodes), nodes.len()),
        host("order", view.order, order.len()),
        host("bias", &[view.bias as u32], 1),
        host("corners", bytemuck::cast_slice(&view.corners), 2),
        host("root", bytemuck::cast_slice(&[view.root]), 1),
        probe_wgsl(code, "probe_view"),
    ]
    .concat();
    let points = points::words(COUNT, 12);
    let there = device.run(&wgsl, &points);
    let pairs = points.iter().zip(there);
    pairs
        .filter(|(point, there)| probes::probe_view(**point, view) != *there)
        .count()
}

#[test]
fn views_give_the_same_bits() {
    let Some(device) = Device::find() else { return };
    assert_eq!(differing(&device, &code(module(FILE))), 0);
}

/// A view whose elements are laid out otherwise must turn the comparison red.
#[test]
fn a_shifted_field_is_noticed() {
    let Some(device) = Device::find() else { return };
    let mut shifted = module(FILE);
    let (sound, wrong) = (
        "    pub kind: i32,\n    pub pair: Vec2,",
        "    pub pair: Vec2,\n    pub kind: i32,",
    );
    assert!(shifted.source.contains(sound));
    shifted.source = shifted.source.replacen(sound, wrong, 1);
    assert!(differing(&device, &code(shifted)) > COUNT / 2);
}

#[test]
fn references_are_written_in_order() {
    let Some(device) = Device::find() else { return };
    let code = code(module(FILE));
    let points = points::words(COUNT, 13);
    let there = device.run(&probe_wgsl(&code, "probe_references"), &points);
    for (point, there) in points.iter().zip(there) {
        assert_eq!(there, probes::probe_references(*point), "at {point:?}");
    }
}

/// What is stored is loaded again, and lies at the words that the layout says.
#[test]
fn columns_hold_what_was_stored() {
    let Some(device) = Device::find() else { return };
    let code = code(module(FILE));
    let columns = code.columns("ProbeSet", "kept").expect("the struct");
    let word = |path: &str| columns.layout.offset(path).expect("the field");
    let words: Vec<String> = (0..13).map(|i| format!("inputs[p + {i}u]")).collect();
    let wgsl = format!(
        "{}{}
const ALL = {}u;
var<private> kept: array<u32, ALL * 4u>;
fn kept_get(word: u32, i: u32) -> u32 {{ return kept[word * 4u + i]; }}
fn kept_set(word: u32, i: u32, value: u32) {{ kept[word * 4u + i] = value; }}
fn run(point: Point, immediate: u32) -> vec4u {{
    let p = point.first;
    let made = probe_make(array<u32, 13>({}));
    let i = immediate & 3u;
    store_kept(i, made);
    store_kept((i + 1u) & 3u, probe_make(array<u32, 13>()));
    var again = load_kept(i);
    let whole = probe_hash(&again);
    store_kept_history(i, array<u32, 3>(1u, 2u, 3u));
    let part = kept_get({}u, i) ^ kept_get({}u, i) ^ load_kept_count(i);
    var rest = load_kept(i);
    return vec4u(whole, part, kept_get({}u, i), probe_hash(&rest));
}}
",
        code.needed(["probe_make", "probe_hash", "ProbeSet"])
            .source
            .text(),
        columns.source.text(),
        columns.layout.words,
        words.join(", "),
        word("items[9].level"),
        word("at"),
        word("frozen"),
    );
    let points = points::words(COUNT, 14);
    let there = device.run(&wgsl, &points);
    for (point, there) in points.iter().zip(there) {
        let made = probe_make(*point);
        let rest = ProbeSet {
            history: [1, 2, 3],
            ..made
        };
        let part = made.items[9].level as u32 ^ made.at.x.to_bits() ^ made.count;
        let here = [
            probe_hash(&made),
            part,
            u32::from(made.frozen),
            probe_hash(&rest),
        ];
        assert_eq!(there, here, "at {point:?}");
    }
}

/// Layouts are those of the processor.
#[test]
fn layouts_are_of_the_processor() {
    let code = code(module(FILE));
    let view = &code.views["ProbeView"];
    let stride = |name: &str| view.field(name).expect("the field").words as usize;
    assert_eq!(4 * stride("nodes"), size_of::<ProbeNode>());
    assert_eq!(4 * stride("corners"), size_of::<[glam::Vec3; 2]>());
    let node = code.layout("ProbeNode").expect("the struct");
    let word = |path: &str| node.offset(path).expect("the field") as usize;
    assert_eq!(4 * word("child"), std::mem::offset_of!(ProbeNode, child));
    assert_eq!(
        4 * word("weights[0]"),
        std::mem::offset_of!(ProbeNode, weights)
    );
    assert_eq!(4 * word("pair"), std::mem::offset_of!(ProbeNode, pair));
    // A bool is a word in columns, a byte in Rust.
    let item = code.layout("ProbeItem").expect("the struct");
    assert_eq!(item.words, 6);
    assert!(size_of::<ProbeItem>() <= 24);
    let lobe = &code.constants["LOBE_BECKMANN"];
    assert_eq!(
        *lobe,
        Value::U32(matcha_render::device::lobe::LOBE_BECKMANN)
    );
}
