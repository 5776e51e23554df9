//! The two hashes: avalanche, distribution over cells, independence of each other.
#![cfg(not(loom))]

use matcha_cache::NodeSeed;
use matcha_cache::device::key_hash::{KeyHash, cell_of, hash_texel};
use matcha_cache::{NODES_A_CELL, node_seed};

fn bits(seed: NodeSeed, level: i32, i: i32, j: i32) -> u64 {
    let hash = hash_texel(seed, level, i, j);
    u64::from(hash.cell) << 32 | u64::from(hash.fingerprint)
}

/// Share of keys for which flipping input bit `flip` flips output bit `o`, for each `o`.
fn flip_shares(flip: usize) -> [f64; 64] {
    const KEYS: u32 = 8192;
    let mut flips = [0u32; 64];
    for k in 0..KEYS {
        // Keys as they occur: small indices around zero, few levels, few nodes.
        let (level, i, j) = ((k % 16) as i32, (k / 91) as i32 - 45, (k % 91) as i32 - 45);
        let (material, node) = (k % 5, k % 7);
        let seed = node_seed(material, node, 0);
        let bit = 1 << (flip % 32);
        let other = match flip / 32 {
            0 => bits(seed, level ^ bit, i, j),
            1 => bits(seed, level, i ^ bit, j),
            2 => bits(seed, level, i, j ^ bit),
            3 => bits(node_seed(material ^ bit as u32, node, 0), level, i, j),
            _ => bits(node_seed(material, node ^ bit as u32, 0), level, i, j),
        };
        let changed = bits(seed, level, i, j) ^ other;
        for (o, count) in flips.iter_mut().enumerate() {
            *count += (changed >> o & 1) as u32;
        }
    }
    flips.map(|count| f64::from(count) / f64::from(KEYS))
}

#[test]
fn every_input_bit_flips_every_output_bit_half_of_the_time() {
    for flip in 0..160 {
        // The last bits of a node's number choose among those that share a cell.
        let shares_cell = (128..128 + NODES_A_CELL.ilog2() as usize).contains(&flip);
        // Those of i and j are the place in a square of texels.
        let place = match flip {
            32..35 => Some(32 + flip - 32),
            64..67 => Some(35 + flip - 64),
            _ => None,
        };
        for (o, share) in flip_shares(flip).into_iter().enumerate() {
            if o >= 32 && (shares_cell || place.is_some()) || (32..38).contains(&o) {
                let expected = f64::from(u8::from(place == Some(o)));
                assert_eq!(share, expected, "input bit {flip}, output bit {o}");
                continue;
            }
            assert!(
                (0.45..0.55).contains(&share),
                "input bit {flip}, output bit {o}: {share}"
            );
        }
    }
}

/// Chi² of counts against an even spread, in standard deviations from its mean.
fn deviation_from_even(counts: &[u32]) -> f64 {
    let total: u32 = counts.iter().sum();
    let expected = f64::from(total) / counts.len() as f64;
    let chi2: f64 = counts
        .iter()
        .map(|&c| (f64::from(c) - expected).powi(2) / expected)
        .sum();
    let degrees = (counts.len() - 1) as f64;
    (chi2 - degrees) / (2.0 * degrees).sqrt()
}

/// Every `step`-th texel of a plane, for nodes that do not share cells.
fn plane(step: usize) -> impl Iterator<Item = KeyHash> {
    let side = move || (-512..512).step_by(step);
    (0..4).flat_map(move |node| {
        let seed = node_seed(node / 2, NODES_A_CELL * node, 0);
        side().flat_map(move |i| side().map(move |j| hash_texel(seed, 7, i, j)))
    })
}

fn spread(slots: usize, step: usize, slot_of: impl Fn(KeyHash) -> usize) -> f64 {
    let mut counts = vec![0u32; slots];
    plane(step).for_each(|hash| counts[slot_of(hash)] += 1);
    deviation_from_even(&counts)
}

#[test]
fn squares_of_texels_spread_evenly() {
    for cells in [1024u32, 4096, 9984] {
        let square = |hash: KeyHash| cell_of(hash.cell, cells) as usize / 64;
        let deviation = spread(cells as usize / 64, 8, square);
        assert!(deviation.abs() < 5.0, "{cells} cells: {deviation}");
    }
}

#[test]
fn fingerprints_spread_evenly() {
    for shift in [0, 12, 20] {
        let bits = |hash: KeyHash| (hash.fingerprint >> shift & 4095) as usize;
        let deviation = spread(4096, 3, bits);
        assert!(deviation.abs() < 5.0, "bits from {shift}: {deviation}");
    }
}

/// Whatever the number of cells: a multiple of 64 or not, or fewer.
#[test]
fn every_cell_gets_its_share() {
    for cells in [1000u32, 37, 64, 65] {
        let mut counts = vec![0u32; cells as usize];
        plane(1).for_each(|hash| counts[cell_of(hash.cell, cells) as usize] += 1);
        let mean = counts.iter().sum::<u32>() / cells;
        let range = mean * 9 / 10..mean * 11 / 10;
        let bad = counts.iter().find(|count| !range.contains(count));
        assert_eq!(bad, None, "{cells} cells: {mean} in the mean");
    }
}

/// A square's 64 texels are the 64 cells of a page, each in its place.
#[test]
fn neighbours_are_neighbours() {
    let seed = node_seed(1, 2, 0);
    for (i, j) in [(0, 0), (-8, 16), (1 << 20, -(1 << 20))] {
        let first = cell_of(hash_texel(seed, 5, i, j).cell, 10_000_000);
        assert_eq!(first % 64, 0);
        for place in 0..64 {
            let hash = hash_texel(seed, 5, i + place % 8, j + place / 8);
            assert_eq!(cell_of(hash.cell, 10_000_000), first + place as u32);
        }
    }
}

#[test]
fn the_fingerprint_says_nothing_of_the_cell() {
    for shift in [0, 13, 26] {
        let joint = |hash: KeyHash| {
            let square = cell_of(hash.cell, 4096) & !63;
            (square | (hash.fingerprint >> shift & 63)) as usize
        };
        let deviation = spread(4096, 8, joint);
        assert!(
            deviation.abs() < 5.0,
            "fingerprint bits from {shift}: {deviation}"
        );
    }
}

/// 7.3 million neighbouring keys of several nodes and levels: pairs that agree in all 64 bits
/// would be expected once in a million runs.
#[test]
fn neighbouring_keys_differ() {
    let mut seen = Vec::new();
    for node in 0..4 {
        for level in [-1, 0, 8, 9] {
            let seed = node_seed(node, node, 0);
            for i in -170..170 {
                seen.extend((-170..170).map(|j| bits(seed, level, i, j)));
            }
        }
    }
    let total = seen.len();
    seen.sort_unstable();
    seen.dedup();
    assert_eq!(seen.len(), total);
}

/// Nodes that share a cell have different fingerprints there.
#[test]
fn nodes_in_one_cell_are_told_apart() {
    for (level, i, j) in [(0, 0, 0), (7, -3, 12), (30, 1 << 29, -5)] {
        let hashes = (0..NODES_A_CELL).flat_map(|node| {
            (0..3).map(move |part| hash_texel(node_seed(2, node, part), level, i, j))
        });
        let (mut cells, mut fingerprints): (Vec<u32>, Vec<u32>) =
            hashes.map(|hash| (hash.cell, hash.fingerprint)).unzip();
        cells.dedup();
        assert_eq!(cells.len(), 1);
        fingerprints.sort_unstable();
        fingerprints.dedup();
        assert_eq!(fingerprints.len(), 3 * NODES_A_CELL as usize);
    }
}
