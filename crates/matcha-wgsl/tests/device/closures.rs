//! Closures on a device against the processor: prepared from random rows, evaluated, sampled.

use crate::adapter::{Device, Point};
use crate::closure_probes::{probe_entry, probe_lobes, probe_row};
use crate::support::module;
use crate::{COUNT, points};
use matcha_render::closure::{LobeSet, code};
use matcha_render::device::closure_rows::ClosureRows;
use matcha_render::device::closure_tables::{CLOSURE_TABLE_END, ClosureTables};
use matcha_shade::closure::{ClosureKind, Distribution, SheenModel};

/// Numbers of a point; the last two calls of the device give four of them each.
type Numbers = [f32; 8];

/// Rows that the largest closure has.
const ROWS: u32 = 51;

/// Share of points that may be on the other side of a branch: which lobe is sampled, and
/// what a microfacet does, is decided by comparing numbers that both sides round. Among them are
/// the densities of nearly sharp lobes, in which rounding is magnified by 1/α² (9 of 4,096 points
/// of glossy lobes on Mesa's driver, by up to half a percent).
const BRANCHES: f32 = 4.0e-3;

fn here(points: &[Point], kind: u32) -> Vec<Numbers> {
    let entries: Vec<f32> = (0..CLOSURE_TABLE_END).map(probe_entry).collect();
    let tables = ClosureTables { entry: &entries };
    let mut set = LobeSet::new();
    let mut numbers = |seed: u32| {
        let row: Vec<f32> = (0..ROWS).map(|i| probe_row(seed, i)).collect();
        probe_lobes(&mut set, ClosureRows { row: &row }, tables, seed, kind)
    };
    points.iter().map(|point| numbers(point[0])).collect()
}

fn there(device: &Device, points: &[Point], kind: u32) -> Vec<Numbers> {
    let probes = module("matcha-wgsl/tests/device/closure_probes.rs");
    let names = ["probe_lobes", "probe_row", "probe_entry"];
    let needed = super::support::device(vec![probes]).needed(names);
    let code = needed.source.text();
    let mut halves = [0, 4].map(|first| {
        let wgsl = format!(
            "{code}
var<private> seed: u32;
fn word_ClosureRows_row(i: u32) -> u32 {{ return bitcast<u32>(probe_row(seed, i)); }}
fn count_ClosureRows_row() -> u32 {{ return {ROWS}u; }}
fn word_ClosureTables_entry(i: u32) -> u32 {{ return bitcast<u32>(probe_entry(i)); }}
fn count_ClosureTables_entry() -> u32 {{ return {CLOSURE_TABLE_END}u; }}
fn run(point: Point, immediate: u32) -> vec4u {{
    seed = inputs[point.first];
    var lobes: LobeSet;
    let r = probe_lobes(&lobes, seed, {kind}u);
    return bitcast<vec4u>(vec4f(r[{first}], r[{first} + 1], r[{first} + 2], r[{first} + 3]));
}}
"
        );
        device.run(&wgsl, points)
    });
    let [first, last] = &mut halves;
    let both = first.iter().zip(last);
    both.map(|(a, b)| std::array::from_fn(|i| f32::from_bits(if i < 4 { a[i] } else { b[i - 4] })))
        .collect()
}

fn agree(a: f32, b: f32) -> bool {
    a == b || (a - b).abs() <= 1.0e-3 * b.abs().max(1.0e-2)
}

#[test]
fn closures_agree() {
    use ClosureKind::{Diffuse, Glass, Glossy, Principled, Refraction, Sheen, Subsurface};
    let Some(device) = Device::find() else { return };
    let points = points::words(COUNT, 21);
    let kinds = [
        Diffuse,
        Subsurface,
        Sheen(SheenModel::Ashikhmin),
        Sheen(SheenModel::Microfiber),
        Glossy(Distribution::MultiGgx),
        Glossy(Distribution::AshikhminShirley),
        Glass(Distribution::MultiGgx),
        Refraction(Distribution::Beckmann),
        Principled(Distribution::MultiGgx),
    ];
    let mut failures = Vec::new();
    for kind in kinds {
        let begin = std::time::Instant::now();
        let there = there(&device, &points, code(kind));
        let taken = begin.elapsed();
        let here = here(&points, code(kind));
        let apart = |(a, b): &(&Numbers, &Numbers)| !a.iter().zip(*b).all(|(a, b)| agree(*a, *b));
        let differing = there.iter().zip(&here).filter(apart).count();
        let lit = here.iter().filter(|numbers| numbers[0] > 0.0).count();
        println!("{kind:?}: {differing} of {COUNT} differ, {lit} lit, {taken:?}");
        if let Some(pair) = there.iter().zip(&here).find(apart) {
            println!("    {pair:?}");
        }
        if differing as f32 > BRANCHES * COUNT as f32 {
            failures.push(kind);
        }
        // Few random pairs of directions refract into each other.
        assert!(
            lit > COUNT / 100,
            "{kind:?}: only {lit} points say anything"
        );
    }
    assert!(
        failures.is_empty(),
        "{failures:?} differ on {}",
        device.name
    );
}
