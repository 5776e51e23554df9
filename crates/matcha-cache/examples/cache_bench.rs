//! Nanoseconds per look-up, one by one and in batches, and per insertion.
//! `cargo run --release -p matcha-cache --example cache_bench`

use matcha_cache::device::encoding::{decode_color, encode_color};
use matcha_cache::{CacheCounts, Found, Keys, NodeSeed, Table, TableSize, node_seed};
use std::hint::black_box;
use std::time::Instant;

const LOOKUPS: usize = 4_000_000;

/// Half full, in the order in which the texels of a plane are counted.
fn fill(table: &Table, node: NodeSeed, counts: &mut CacheCounts) -> (usize, f64) {
    let total = table.size().capacity() as usize / 2;
    let mut keys = Keys::default();
    let start = Instant::now();
    for first in (0..total).step_by(4096) {
        let texels: Vec<[i32; 3]> = (first..total.min(first + 4096)).map(texel).collect();
        prepare(table, node, &texels, &mut keys);
        for k in 0..texels.len() {
            table.insert_prepared(&keys, k, node, (first + k) as u32, counts);
        }
    }
    (total, start.elapsed().as_secs_f64() * 1e9 / total as f64)
}

fn prepare(table: &Table, node: NodeSeed, texels: &[[i32; 3]], keys: &mut Keys) {
    let rows: [Vec<i32>; 3] = std::array::from_fn(|c| texels.iter().map(|t| t[c]).collect());
    table.prepare(node, rows.each_ref().map(|row| &row[..]), keys);
}

fn texel(index: usize) -> [i32; 3] {
    [10, (index & 0xFFFF) as i32 - 0x8000, (index >> 16) as i32]
}

/// Keys in no order, nine in ten of them stored.
fn random_keys(keys: usize) -> Vec<[i32; 3]> {
    let mut state = 1u64;
    let mut next = || {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 24) as usize
    };
    (0..LOOKUPS)
        .map(|_| texel(next() % (keys * 10 / 9)))
        .collect()
}

fn nanoseconds(start: Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e9 / LOOKUPS as f64
}

/// Each key depends on the value before it, as where work lies between look-ups.
fn one_by_one(table: &Table, node: NodeSeed, keys: &[[i32; 3]]) -> f64 {
    let mut counts = CacheCounts::default();
    let start = Instant::now();
    let mut last = 0;
    for &[level, i, j] in keys {
        let level = level + i32::from(black_box(last) == u32::MAX);
        last = table.look_up(node, [level, i, j], &mut counts).unwrap_or(0);
    }
    black_box(last);
    nanoseconds(start)
}

/// `nodes` values at each texel; nanoseconds a texel.
fn batched(table: &Table, seeds: &[NodeSeed], texels: &[[i32; 3]], batch: usize) -> f64 {
    let mut keys = Keys::default();
    let mut found = Found::default();
    // Rows as the renderer has them; making them is not part of a look-up.
    let rows: [Vec<i32>; 3] = std::array::from_fn(|c| texels.iter().map(|t| t[c]).collect());
    let start = Instant::now();
    for first in (0..texels.len() - batch).step_by(batch) {
        let rows = rows.each_ref().map(|row| &row[first..first + batch]);
        table.prepare(seeds[0], rows, &mut keys);
        table.look_up_prepared(&keys, seeds, &mut found);
        black_box(&found);
    }
    nanoseconds(start)
}

fn best_of(runs: usize, mut run: impl FnMut() -> f64) -> f64 {
    (0..runs).map(|_| run()).fold(f64::INFINITY, f64::min)
}

fn table_row(size: TableSize) {
    let table = Table::new(size).expect("memory for the table");
    let node = node_seed(1, 0, 0);
    let mut counts = CacheCounts::default();
    let (keys, insert_ns) = fill(&table, node, &mut counts);
    let keys = random_keys(keys);
    let single = best_of(3, || one_by_one(&table, node, &keys));
    let batches = [4, 16, 64, 512].map(|n| best_of(5, || batched(&table, &[node], &keys, n)));
    let [b4, b16, b64, b512] = batches;
    let seeds: Vec<NodeSeed> = (0..4).map(|node| node_seed(1, node, 0)).collect();
    let four = best_of(5, || batched(&table, &seeds, &keys, 512));
    println!(
        "| {}×{} | {} | {:.0} | {single:.0} | {b4:.1} | {b16:.1} | {b64:.1} | {b512:.1} | {four:.1} |",
        size.cells,
        size.entries,
        size.bytes() >> 20,
        insert_ns
    );
}

/// Largest and mean error of colours, in steps of an sRGB display's 8 bits: ours
/// against three linear 9-bit mantissas under a shared exponent, the usual format.
fn color_errors() {
    let display = |x: f32| {
        255.0
            * if x < 0.0031308 {
                12.92 * x
            } else {
                1.055 * x.powf(1.0 / 2.4) - 0.055
            }
    };
    let linear = |c: glam::Vec3| {
        let step = 2f32.powi(matcha_cache::device::encoding::shared_exponent(
            c.max_element(),
        )) / 511.0;
        (c / step).round() * step
    };
    let mut worst = [0f32; 2];
    let mut sum = [0f64; 2];
    let n = 64;
    for k in 0..n * n * n {
        let at = |m: i32| ((m % n) as f32 / n as f32).powf(2.2);
        let c = glam::vec3(at(k), at(k / n), at(k / n / n));
        for (m, decoded) in [decode_color(encode_color(c)), linear(c)]
            .into_iter()
            .enumerate()
        {
            for channel in 0..3 {
                let error = (display(c[channel]) - display(decoded[channel])).abs();
                worst[m] = worst[m].max(error);
                sum[m] += f64::from(error) / f64::from(3 * n * n * n);
            }
        }
    }
    println!("\n| colour in 32 bits | largest error, /255 in sRGB | mean |\n|---|---|---|");
    println!(
        "| roots, shared exponent (used) | {:.2} | {:.3} |",
        worst[0], sum[0]
    );
    println!(
        "| linear, shared exponent (RGB9E5) | {:.2} | {:.3} |",
        worst[1], sum[1]
    );
}

fn main() {
    println!(
        "| cells × entries | MiB | insert, ns | one by one, ns | batch of 4 | 16 | 64 | 512 | 512, 4 nodes |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    for (cells, entries) in [
        (10_000_000, 10),
        (12_500_000, 8),
        (6_250_000, 16),
        (840_000, 10),
        (1_050_000, 8),
        (1_000, 10),
    ] {
        table_row(TableSize { cells, entries });
    }
    color_errors();
}
