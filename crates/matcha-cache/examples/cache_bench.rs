//! Nanoseconds per look-up, one by one and in batches, and per insertion.
//! `cargo run --release -p matcha-cache --example cache_bench`

use matcha_cache::device::encoding::{decode_color, encode_color};
use matcha_cache::{CacheCounts, NodeSeed, Table, TableSize, node_seed};
use std::hint::black_box;
use std::time::Instant;

const LOOKUPS: usize = 4_000_000;

/// Half full, in the order in which the texels of a plane are counted.
fn fill(table: &Table, node: NodeSeed, counts: &mut CacheCounts) -> (usize, f64) {
    let keys = table.size().capacity() as usize / 2;
    let start = Instant::now();
    for first in (0..keys).step_by(4096) {
        let n = 4096.min(keys - first);
        let texel = |k: usize| texel(first + k);
        table.insert_batch(node, n, texel, |k| (first + k) as u32, counts);
    }
    (keys, start.elapsed().as_secs_f64() * 1e9 / keys as f64)
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

fn batched(table: &Table, node: NodeSeed, keys: &[[i32; 3]], batch: usize) -> f64 {
    let mut counts = CacheCounts::default();
    let (mut values, mut found) = (vec![0; batch], vec![false; batch]);
    let start = Instant::now();
    for keys in keys.chunks_exact(batch) {
        table.look_up_batch(node, |k| keys[k], &mut values, &mut found, &mut counts);
        black_box(&values);
    }
    nanoseconds(start)
}

fn best_of(runs: usize, mut run: impl FnMut() -> f64) -> f64 {
    (0..runs).map(|_| run()).fold(f64::INFINITY, f64::min)
}

fn table_row(size: TableSize) {
    let table = Table::new(size).expect("memory for the table");
    let node = node_seed(1, 1, 0);
    let mut counts = CacheCounts::default();
    let (keys, insert_ns) = fill(&table, node, &mut counts);
    let keys = random_keys(keys);
    let single = best_of(3, || one_by_one(&table, node, &keys));
    let batches = [16, 64, 1024, 4096].map(|n| best_of(5, || batched(&table, node, &keys, n)));
    let [b16, b64, b1024, b4096] = batches;
    println!(
        "| {}×{} | {} | {:.0} | {single:.0} | {b16:.1} | {b64:.1} | {b1024:.1} | {b4096:.1} |",
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
        "| cells × entries | MiB | insert, ns | one by one, ns | batch of 16 | 64 | 1024 | 4096 |"
    );
    println!("|---|---|---|---|---|---|---|---|");
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
