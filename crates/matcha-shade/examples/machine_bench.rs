//! Nanoseconds a point of every operation and of some networks, one point at a time and
//! in lanes for each instruction set, as markdown.
//!
//! `cargo run --release -p matcha-shade --example machine_bench [-- FILTER]`

mod timing;

use matcha_shade::closure::ClosureKind;
use matcha_shade::compile::{Options, compile};
use matcha_shade::graph::{Graph, NodeId, Span, Table};
use matcha_shade::input::InputKind;
use matcha_shade::material::MaterialGraph;
use matcha_shade::ops::{self, OpCode};
use matcha_shade::opt::Optimise;
use matcha_shade::program::Program;
use matcha_shade::vm::{Isa, Rows};
use timing::time;

/// Hits in a group.
const POINTS: usize = 1024;
/// Copies of an operation in the program that times it.
const COPIES: usize = 16;
/// Numbers that operands are drawn from: attributes of four components.
const ATTRIBUTES: u16 = 4;

fn main() {
    let filter = std::env::args().nth(1).unwrap_or_default();
    let sets = Isa::available();
    let heads: Vec<String> = sets.iter().map(|s| format!("{s:?}")).collect();
    println!(
        "| networks, ns a point | words | {} | lanes gain |",
        heads.join(" | ")
    );
    println!("|---|---|{}---|", "---|".repeat(sets.len()));
    for (name, material) in networks() {
        if name.contains(&filter) {
            let program = plain(&material, Optimise::Rounding);
            row(
                name,
                Some(program.words().len()),
                &times(&program, [0.05, 0.95], POINTS),
            );
        }
    }
    group_sizes(&filter);
    println!(
        "\n| operations, ns a point | table's cost | {} | lanes gain |",
        heads.join(" | ")
    );
    println!("|---|---|{}---|", "---|".repeat(sets.len()));
    for op in ops::all().filter(|op| op.info().name.contains(&filter)) {
        let domain = op.info().domain;
        // Few points where one costs much, so that the best of several runs can be taken.
        let points = if op.info().cost < 5.0 {
            POINTS
        } else {
            POINTS / 16
        };
        let with = times(&plain(&copies(Some(op)), Optimise::Nothing), domain, points);
        let without = times(&plain(&copies(None), Optimise::Nothing), domain, points);
        let each: Vec<f64> = with
            .iter()
            .zip(without)
            .map(|(a, b)| ((a - b) / COPIES as f64).max(0.0))
            .collect();
        let cells: Vec<String> = each.iter().map(|t| format!("{t:.2}")).collect();
        let gain = each[0] / each[each.len() - 1].max(0.01);
        let info = op.info();
        println!(
            "| {} | {} | {} | {gain:.1}× |",
            info.name,
            info.cost,
            cells.join(" | ")
        );
    }
}

/// The networks over groups of different sizes, with the best instruction set.
fn group_sizes(filter: &str) {
    let sizes = [1, 4, 16, 17, 32, 64, 256, 1024, 4096];
    let heads: Vec<String> = sizes.iter().map(usize::to_string).collect();
    println!("\n| hits in a group, ns a point | {} |", heads.join(" | "));
    println!("|---|{}", "---|".repeat(sizes.len()));
    for (name, material) in networks() {
        if name.contains(filter) {
            let program = plain(&material, Optimise::Rounding);
            let inputs = inputs(&program, [0.05, 0.95], 4096);
            let each = sizes.map(|n| format!("{:.1}", time(&program, Isa::best(), &inputs, n)));
            println!("| {name} | {} |", each.join(" | "));
        }
    }
}

fn row(name: &str, words: Option<usize>, times: &[f64]) {
    let cells: Vec<String> = times.iter().map(|t| format!("{t:.1}")).collect();
    let gain = times[0] / times[times.len() - 1];
    let words = words.map_or(String::new(), |w| w.to_string());
    println!("| {name} | {words} | {} | {gain:.1}× |", cells.join(" | "));
}

fn plain(material: &MaterialGraph, optimise: Optimise) -> Program {
    let options = Options {
        cache: false,
        optimise,
        ..Options::default()
    };
    compile(material, &options)
        .expect("the program fits")
        .program
}

/// Nanoseconds a point for each instruction set, the best of several runs.
fn times(program: &Program, domain: [f32; 2], points: usize) -> Vec<f64> {
    let inputs = inputs(program, domain, points);
    let sets = Isa::available().into_iter();
    sets.map(|isa| time(program, isa, &inputs, points))
        .collect()
}

fn inputs(program: &Program, domain: [f32; 2], points: usize) -> Rows {
    let mut inputs = Rows::new(program.input_rows(), points);
    let mut state = 1u32;
    for row in 0..program.input_rows() {
        for x in inputs.row_mut(row) {
            state = state.wrapping_mul(747796405).wrapping_add(2891336453);
            let unit = (state >> 8) as f32 / (1 << 24) as f32;
            *x = domain[0] + (domain[1] - domain[0]) * unit;
        }
    }
    inputs
}

fn of_total(m: &mut MaterialGraph, total: NodeId) {
    let weight = m.graph.combine(&[total, total, total]);
    let leaf = m.closures.leaf(
        &m.graph,
        ClosureKind::Transparent,
        weight,
        vec![],
        Span::default(),
    );
    m.closures.root = Some(leaf);
}

/// Copies of an operation with different operands, summed; or the sums alone.
fn copies(op: Option<OpCode>) -> MaterialGraph {
    let mut m = MaterialGraph::default();
    let g = &mut m.graph;
    let pool = pool(g);
    let mut total = g.f1(0.0);
    for copy in 0..COPIES {
        let value = match op {
            Some(op) => {
                let value = with_operands(g, op, &pool, copy);
                g.component(value, 0)
            }
            None => pool[copy % pool.len()],
        };
        total = g.apply(OpCode::math_add, &[total, value]);
    }
    of_total(&mut m, total);
    m
}

fn pool(g: &mut Graph) -> Vec<NodeId> {
    let mut pool = Vec::new();
    for attribute in 0..ATTRIBUTES {
        let value = g.value(InputKind::Attribute(attribute));
        pool.extend((0..4).map(|i| g.component(value, i)));
    }
    pool
}

/// The operation with operands from the pool, save for those whose size decides the
/// time: these are what a user would set.
fn with_operands(g: &mut Graph, op: OpCode, pool: &[NodeId], copy: usize) -> NodeId {
    let info = op.info();
    let mut next = copy * 7;
    let mut operands = Vec::new();
    for operand in info.operands() {
        let fixed = match operand.name {
            "detail" => Some(2.0),
            "roughness" | "smoothness" => Some(0.5),
            "lacunarity" => Some(2.0),
            "randomness" => Some(1.0),
            "count" => Some(4.0),
            _ => None,
        };
        let node = match fixed {
            Some(x) => g.f1(x),
            None => {
                let parts: Vec<NodeId> = (0..operand.ty.width())
                    .map(|i| pool[(next + i * 3) % pool.len()])
                    .collect();
                g.combine(&parts)
            }
        };
        next += 5;
        operands.push(node);
    }
    let aux = u32::from(info.name == "magic_color") * 2;
    g.apply_aux(op, aux, &operands)
}

/// The programs of the prototype's table (docs/adr/0003-lane-machine.md).
fn networks() -> Vec<(&'static str, MaterialGraph)> {
    vec![
        ("100 words of math, mix, vector", network(0, 0, 100, 0)),
        ("10 fBm 3D/4D + 60 math", network(10, 0, 60, 0)),
        (
            "6 Voronoi + 6 fBm + 80 math + 4 ramps",
            network(6, 6, 80, 4),
        ),
    ]
}

fn network(noises: usize, cells: usize, math: usize, ramps: usize) -> MaterialGraph {
    let mut m = MaterialGraph::default();
    let g = &mut m.graph;
    let mut values = pool(g);
    for k in 0..noises {
        let op = if k % 2 == 0 {
            OpCode::noise_fbm_3d
        } else {
            OpCode::noise_fbm_4d
        };
        values.push(with_operands(g, op, &values, k));
    }
    for k in 0..cells {
        let value = with_operands(g, OpCode::voronoi_f1_3d, &values, k);
        values.push(g.component(value, 0));
    }
    let table = g.table(Table {
        rows: (0..4)
            .map(|r| {
                (0..256)
                    .map(|i| ((i * (r + 3)) % 256) as f32 / 255.0)
                    .collect()
            })
            .collect(),
        interpolate: true,
        extrapolate: false,
    });
    for _ in 0..ramps {
        let value = g.look_up(table, values[values.len() - 1]);
        values.push(g.component(value, 1));
    }
    let kinds = [
        OpCode::math_add,
        OpCode::math_multiply,
        OpCode::vector_mix,
        OpCode::math_multiply_add,
        OpCode::mix_overlay,
        OpCode::math_maximum,
        OpCode::vector_multiply,
        OpCode::math_mix,
    ];
    for k in 0..math {
        let newest: Vec<NodeId> = values.iter().rev().take(14).copied().collect();
        let value = with_operands(g, kinds[k % kinds.len()], &newest, k * 3);
        values.push(g.component(value, 0));
    }
    let total = values[values.len() - 14..].to_vec();
    let total = total
        .into_iter()
        .reduce(|a, b| g.apply(OpCode::math_add, &[a, b]));
    of_total(&mut m, total.expect("fourteen values"));
    m
}
