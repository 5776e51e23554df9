//! The table under real threads: values are a function of their keys, so every hit
//! can be checked.
#![cfg(not(loom))]

use matcha_cache::{CacheCounts, Found, Keys, NodeSeed, Table, TableSize, node_seed};

const NODES: u32 = 7;

fn seeds() -> Vec<NodeSeed> {
    (0..NODES)
        .map(|node| node_seed(node / 3, node, 0))
        .collect()
}

fn value(node: usize, [level, i, j]: [i32; 3]) -> u32 {
    let mix = |h: u32, x: u32| (h ^ x).wrapping_mul(0x85EB_CA6B).rotate_left(13);
    [level, i, j]
        .iter()
        .fold(node as u32, |h, &x| mix(h, x as u32))
}

/// A sequence of numbers that differs by thread.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> u32 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 33) as u32
    }

    /// A texel of a small plane around zero, so that threads meet.
    fn texel(&mut self, side: u32) -> [i32; 3] {
        let mut index = || (self.next() % side) as i32 - side as i32 / 2;
        [index() % 4, index(), index()]
    }
}

fn hammer(table: &Table, thread: u64, rounds: usize, side: u32) -> CacheCounts {
    let seeds = seeds();
    let mut numbers = Numbers(thread);
    let mut counts = CacheCounts::default();
    let (mut keys, mut found) = (Keys::default(), Found::default());
    for round in 0..rounds {
        // Nodes 0 to 3 and 4 to 6 are of different materials or share no cells.
        let nodes = [&[0, 1, 2][..], &[3], &[4, 5], &[6]][numbers.next() as usize % 4];
        let texels: Vec<[i32; 3]> = (0..100).map(|_| numbers.texel(side)).collect();
        let rows: [Vec<i32>; 3] = std::array::from_fn(|c| texels.iter().map(|t| t[c]).collect());
        table.prepare(
            seeds[nodes[0]],
            rows.each_ref().map(|row| &row[..]),
            &mut keys,
        );
        let own: Vec<NodeSeed> = nodes.iter().map(|&node| seeds[node]).collect();
        table.look_up_prepared(&keys, &own, &mut found);
        counts.lookups += (100 * nodes.len()) as u64;
        for (s, &node) in nodes.iter().enumerate() {
            for (k, &texel) in texels.iter().enumerate() {
                let word = value(node, texel);
                if found.masks()[k] >> s & 1 == 1 {
                    counts.hits += 1;
                    assert_eq!(found.words(s)[k], word);
                } else if round % 2 == 0 {
                    table.insert_prepared(&keys, k, own[s], word, &mut counts);
                } else {
                    table.insert(own[s], texel, word, &mut counts);
                    if let Some(seen) = table.look_up(own[s], texel, &mut counts) {
                        assert_eq!(seen, word);
                    }
                }
            }
        }
    }
    counts
}

fn hammer_with_threads(size: TableSize, side: u32) -> (Table, CacheCounts) {
    let table = Table::new(size).unwrap();
    let mut total = CacheCounts::default();
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..8)
            .map(|t| {
                scope.spawn({
                    let table = &table;
                    move || hammer(table, t, 400, side)
                })
            })
            .collect();
        for thread in threads {
            total += thread.join().unwrap();
        }
    });
    (table, total)
}

#[test]
fn no_hit_is_wrong_and_no_insert_is_miscounted() {
    for size in [
        TableSize {
            cells: 200_000,
            entries: 10,
        },
        TableSize {
            cells: 1_000,
            entries: 8,
        },
        TableSize {
            cells: 37,
            entries: 3,
        },
        TableSize {
            cells: 1,
            entries: 1,
        },
    ] {
        // Few keys for the table with one entry, so that its key surely comes again.
        let side = if size.capacity() == 1 { 4 } else { 64 };
        let (table, counts) = hammer_with_threads(size, side);
        assert_eq!(counts.inserts, table.count_occupied(), "{size:?}");
        assert!(
            counts.hits > 0 && counts.hits < counts.lookups,
            "{counts:?}"
        );
        let small = size.capacity() < 20_000;
        // Nodes that share a cell fill some cells early: a twelfth of the large table is used.
        let refused_many = counts.refused * 100 > counts.inserts;
        assert_eq!(refused_many, small, "{counts:?}");
    }
}

/// A key that is not in the table is found with a chance of 2⁻³² for each entry of its
/// cell. The test shortens fingerprints to see that: it asks how often two fingerprints
/// of a full table's cells agree in 20 bits.
#[test]
fn fingerprints_collide_as_often_as_chance_says() {
    use matcha_cache::device::key_hash::{cell_of, hash_texel};
    let seed = node_seed(1, 1, 0);
    let cells = 1000u32;
    let mut fingerprints = vec![Vec::new(); cells as usize];
    for i in 0..100i32 {
        for j in 0..100 {
            let hash = hash_texel(seed, 8, i, j);
            fingerprints[cell_of(hash.cell, cells) as usize].push(hash.fingerprint);
        }
    }
    let (mut compared, mut agree) = (0u64, 0u64);
    for i in 100..2000i32 {
        for j in 0..200 {
            let hash = hash_texel(seed, 8, i, j);
            for fingerprint in &fingerprints[cell_of(hash.cell, cells) as usize] {
                compared += 1;
                agree += u64::from((fingerprint ^ hash.fingerprint) & 0xF_FFFF == 0);
            }
        }
    }
    let expected = compared as f64 / f64::from(1 << 20);
    let deviation = (agree as f64 - expected) / expected.sqrt();
    assert!(
        compared > 3_000_000 && deviation.abs() < 5.0,
        "{agree} of {compared}"
    );
}

/// And the whole fingerprint: ten million absent keys in a full table of 10 entries a
/// cell make 0.02 false hits in the mean. Seeing three would be a broken hash.
#[test]
fn absent_keys_are_not_found() {
    let table = Table::new(TableSize {
        cells: 1000,
        entries: 10,
    })
    .unwrap();
    let mut counts = CacheCounts::default();
    let node = node_seed(9, 9, 0);
    for k in 0..100_000 {
        table.insert(node, [5, k % 316, k / 316], k as u32, &mut counts);
    }
    assert_eq!(counts.inserts, 10_000);
    let (mut keys, mut found) = (Keys::default(), Found::default());
    let mut false_hits = 0;
    let (levels, i): (Vec<i32>, Vec<i32>) = (0..1000).map(|k| (5, 200_000 + k)).unzip();
    for block in 0..10_000 {
        table.prepare(node, [&levels, &i, &[block; 1000]], &mut keys);
        table.look_up_prepared(&keys, &[node], &mut found);
        false_hits += found.masks().iter().filter(|&&mask| mask != 0).count();
    }
    assert!(false_hits < 3, "{false_hits} false hits");
}
