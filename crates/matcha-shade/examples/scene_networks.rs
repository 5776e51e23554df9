//! Nanoseconds a point of every material network of an exported scene, as markdown. Images
//! cost nothing here; hits have random quantities of plausible size.
//!
//! `cargo run --release -p matcha-shade --example scene_networks -- SCENE.glb`

mod timing;

use matcha_shade::compile::{Options, compile};
use matcha_shade::input::{InputKind, Part};
use matcha_shade::material::MaterialKind;
use matcha_shade::nodes::{Names, lower};
use matcha_shade::program::Program;
use matcha_shade::source::NodeTree;
use matcha_shade::vm::{Isa, Rows};
use serde_json::Value;
use std::collections::BTreeMap;
use timing::time;

/// Hits in a group.
const POINTS: usize = 64;

fn main() {
    let path = std::env::args().nth(1).expect("the path of a .glb");
    let file = std::fs::read(&path).expect("a readable file");
    let root = json_chunk(&file).expect("binary glTF");
    let own = &root["extensions"]["MATCHA_cycles"];
    let trees: Vec<NodeTree> =
        serde_json::from_value(own["trees"].clone()).expect("node trees of the extension");
    let sets = Isa::available();
    let heads: Vec<String> = sets.iter().map(|s| format!("{s:?}")).collect();
    println!(
        "| network | operations lowered | left | words | slots | {} | regions | words in them |",
        heads.join(" | ")
    );
    println!("|---|---|---|---|---|{}---|---|", "---|".repeat(sets.len()));
    let mut totals = vec![0.0; sets.len()];
    let mut uses = BTreeMap::new();
    for material in root["materials"].as_array().into_iter().flatten() {
        let Some(tree) = material["extensions"]["MATCHA_cycles"]["tree"].as_u64() else {
            continue;
        };
        let name = material["name"].as_str().unwrap_or("?");
        measure(&trees, tree as u32, name, &sets, &mut totals, &mut uses);
    }
    let totals: Vec<String> = totals.iter().map(|t| format!("{t:.0}")).collect();
    println!("| all | | | | | {} | | |", totals.join(" | "));
    print_uses(&uses);
}

/// The operations that the networks spend their time in, by the table's costs.
fn print_uses(uses: &BTreeMap<&'static str, (usize, f64)>) {
    let mut uses: Vec<_> = uses.iter().collect();
    uses.sort_by(|a, b| b.1.1.total_cmp(&a.1.1));
    println!("\n| operation | words | estimated ns in all |\n|---|---|---|");
    for (name, (count, cost)) in uses.iter().take(20) {
        println!("| {name} | {count} | {cost:.0} |");
    }
}

fn json_chunk(file: &[u8]) -> Option<Value> {
    let length = u32::from_le_bytes(file.get(12..16)?.try_into().ok()?) as usize;
    serde_json::from_slice(file.get(20..20 + length)?).ok()
}

fn measure(
    trees: &[NodeTree],
    tree: u32,
    name: &str,
    sets: &[Isa],
    totals: &mut [f64],
    uses: &mut BTreeMap<&'static str, (usize, f64)>,
) {
    let names = Names {
        uv: &[],
        attributes: &[],
    };
    let (graph, _) = match lower(trees, tree, names, name, MaterialKind::Surface) {
        Ok(lowered) => lowered,
        Err(error) => return eprintln!("{name}: {error}"),
    };
    let plain = compile(
        &graph,
        &Options {
            cache: false,
            ..Options::default()
        },
    );
    let cached = compile(&graph, &Options::default());
    let (Ok(plain), Ok(cached)) = (plain, cached) else {
        return eprintln!("{name}: too large");
    };
    let sizes = (plain.passes.first(), plain.passes.last());
    let (Some(first), Some(last)) = sizes else {
        return;
    };
    for op in plain.program.words().iter().filter_map(|w| w.operation()) {
        let (count, cost) = uses.entry(op.info().name).or_default();
        *count += 1;
        *cost += f64::from(op.info().cost);
    }
    let inputs = hits(&plain.program);
    let mut cells = Vec::new();
    for (isa, total) in sets.iter().zip(totals) {
        let each = time(&plain.program, *isa, &inputs, POINTS);
        *total += each;
        cells.push(format!("{each:.0}"));
    }
    println!(
        "| {name} | {} | {} | {} | {} | {} | {} | {} |",
        first.operations,
        last.operations,
        plain.program.words().len(),
        plain.program.slots(),
        cells.join(" | "),
        cached.program.cacheable(),
        cached.program.rest(),
    );
}

/// Quantities of hits: coordinates within a unit or two, footprints of a thousandth.
fn hits(program: &Program) -> Rows {
    let mut rows = Rows::new(program.input_rows(), POINTS);
    let mut state = 1u32;
    let mut number = |low: f32, high: f32| {
        state = state.wrapping_mul(747796405).wrapping_add(2891336453);
        low + (high - low) * ((state >> 8) as f32 / (1 << 24) as f32)
    };
    for &(input, first) in &program.inputs {
        for row in first..first + input.kind.width() {
            let (low, high) = match (input.part, input.kind) {
                (Part::Value, InputKind::Uv(_) | InputKind::Generated) => (0.0, 1.0),
                (Part::Value, _) => (-1.0, 1.0),
                _ => (-0.001, 0.001),
            };
            rows.row_mut(row).fill_with(|| number(low, high));
        }
    }
    rows
}
