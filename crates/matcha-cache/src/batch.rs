//! Look-ups and insertions of a whole batch. One look-up in a table of hundreds of
//! megabytes waits for memory most of its time; a batch waits once, and not at all if
//! there is other work between the two steps that it takes:
//!
//! 1. [`Table::prepare`] hashes all texels in lanes and asks for their cells.
//! 2. [`Table::look_up_prepared`] compares fingerprints, of every node that has its values
//!    in these cells. [`Table::insert_prepared`] puts what was not found.

use crate::device::key_hash::{NodeSeed, cell_of, fingerprint_at, hash_shared_texel};
use crate::sync::Ordering;
use crate::table::{Cell, EMPTY, fingerprint_of, value_of};
use crate::{CacheCounts, Insertion, Table};

/// Most words that one call of [`Table::look_up_prepared`] looks up a texel.
pub const MOST_SEEDS: usize = 16;

/// The hashes of a batch's texels for nodes that share cells.
#[derive(Clone, Debug, Default)]
pub struct Keys {
    /// Number of the cell.
    cell: Vec<u32>,
    /// What fingerprints are made of.
    rest: Vec<u32>,
}

impl Keys {
    /// Number of texels.
    pub fn len(&self) -> usize {
        self.cell.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.cell.is_empty()
    }
}

/// What a look-up in batches gives.
#[derive(Clone, Debug, Default)]
pub struct Found {
    words: Vec<u32>,
    masks: Vec<u16>,
    seeds: usize,
}

impl Found {
    /// The words of one seed; 0 where not found.
    pub fn words(&self, seed: usize) -> &[u32] {
        let n = self.masks.len();
        assert!(seed < self.seeds, "seed {seed} of {}", self.seeds);
        &self.words[seed * n..][..n]
    }

    /// For each texel bit `s` says whether the word of seed `s` was found.
    pub fn masks(&self) -> &[u16] {
        &self.masks
    }

    fn reset(&mut self, seeds: usize, n: usize) {
        self.seeds = seeds;
        self.words.resize(self.words.len().max(seeds * n), 0);
        self.masks.clear();
        self.masks.resize(n, 0);
    }
}

/// The hash over rows of texels, for a number of cells, compiled for what this CPU has.
pub(crate) struct HashRows(HashOf);

type HashOf = fn(NodeSeed, u32, [&[i32]; 3], &mut Keys);

#[inline(always)]
fn hash_lanes(node: NodeSeed, cells: u32, [level, i, j]: [&[i32]; 3], keys: &mut Keys) {
    let n = level.len();
    let (i, j, rest) = (&i[..n], &j[..n], &mut keys.rest[..n]);
    for (k, cell) in keys.cell[..n].iter_mut().enumerate() {
        let hash = hash_shared_texel(node, level[k], i[k], j[k]);
        *cell = cell_of(hash.cell, cells);
        rest[k] = hash.rest;
    }
}

fn hash_portable(node: NodeSeed, cells: u32, texels: [&[i32]; 3], keys: &mut Keys) {
    hash_lanes(node, cells, texels, keys);
}

#[cfg(all(target_arch = "x86_64", not(loom)))]
mod x86 {
    use super::*;

    #[target_feature(enable = "avx2")]
    fn hash_avx2_lanes(node: NodeSeed, cells: u32, texels: [&[i32]; 3], keys: &mut Keys) {
        hash_lanes(node, cells, texels, keys);
    }

    #[target_feature(enable = "avx512f,avx512dq,avx512vl")]
    fn hash_avx512_lanes(node: NodeSeed, cells: u32, texels: [&[i32]; 3], keys: &mut Keys) {
        hash_lanes(node, cells, texels, keys);
    }

    pub(super) fn hash_avx2(node: NodeSeed, cells: u32, texels: [&[i32]; 3], keys: &mut Keys) {
        // SAFETY: chosen only where `best` found AVX2.
        unsafe { hash_avx2_lanes(node, cells, texels, keys) }
    }

    pub(super) fn hash_avx512(node: NodeSeed, cells: u32, texels: [&[i32]; 3], keys: &mut Keys) {
        // SAFETY: chosen only where `best` found these parts of AVX-512.
        unsafe { hash_avx512_lanes(node, cells, texels, keys) }
    }

    pub(super) fn best() -> HashOf {
        if is_x86_feature_detected!("avx512dq") && is_x86_feature_detected!("avx512vl") {
            hash_avx512
        } else if is_x86_feature_detected!("avx2") {
            hash_avx2
        } else {
            hash_portable
        }
    }
}

impl HashRows {
    pub(crate) fn for_this_cpu() -> Self {
        #[cfg(all(target_arch = "x86_64", not(loom)))]
        return Self(x86::best());
        #[cfg(not(all(target_arch = "x86_64", not(loom))))]
        return Self(hash_portable);
    }
}

/// Asks for the first line of a cell. Entries are taken in order, so what is beyond it is
/// needed only where that line is full.
#[inline(always)]
fn prefetch(cell: Cell) {
    #[cfg(all(target_arch = "x86_64", not(loom), not(miri)))]
    // SAFETY: a prefetch is a hint and reads nothing; SSE is part of x86-64.
    unsafe {
        use core::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        _mm_prefetch::<_MM_HINT_T0>(cell.head.as_ptr().cast());
    }
    #[cfg(not(all(target_arch = "x86_64", not(loom), not(miri))))]
    let _ = cell;
}

impl Table {
    /// Hashes texels, given by the rows of their levels and indices, for the nodes that
    /// share cells with `node`, and asks memory for the cells.
    pub fn prepare(&self, node: NodeSeed, texels: [&[i32]; 3], keys: &mut Keys) {
        let n = texels[0].len();
        keys.cell.resize(n, 0);
        keys.rest.resize(n, 0);
        (self.hash_rows.0)(node, self.cells_in_use() as u32, texels, keys);
        for &number in &keys.cell {
            prefetch(self.cell(number));
        }
    }

    /// Looks words up, one for each seed, at all texels that `keys` were made of. All seeds
    /// must share cells with the one that the keys were prepared for.
    ///
    /// # Panics
    /// If there are more than [`MOST_SEEDS`] seeds.
    pub fn look_up_prepared(&self, keys: &Keys, seeds: &[NodeSeed], out: &mut Found) {
        assert!(seeds.len() <= MOST_SEEDS, "{} seeds", seeds.len());
        let n = keys.len();
        out.reset(seeds.len(), n);
        for (k, mask) in out.masks.iter_mut().enumerate() {
            let cell = self.cell(keys.cell[k]);
            for (s, &seed) in seeds.iter().enumerate() {
                let fingerprint = fingerprint_at(keys.rest[k], seed);
                let found = cell.find_near(s, fingerprint);
                *mask |= u16::from(found.is_some()) << s;
                out.words[s * n + k] = found.unwrap_or(0);
            }
        }
    }

    /// Stores a word of a node at texel `at` of those that `keys` were made of.
    pub fn insert_prepared(
        &self,
        keys: &Keys,
        at: usize,
        node: NodeSeed,
        word: u32,
        counts: &mut CacheCounts,
    ) -> Insertion {
        let fingerprint = fingerprint_at(keys.rest[at], node);
        let outcome = self.cell(keys.cell[at]).put(fingerprint, word);
        counts.count(outcome);
        outcome
    }
}

impl Cell<'_> {
    /// The word of a fingerprint, which is `place` entries behind the cell's first one if
    /// nothing but the nodes of one texel is in it, the most frequent case by far.
    #[inline(always)]
    fn find_near(self, place: usize, fingerprint: u32) -> Option<u32> {
        if let Some(entry) = self.head.get(place) {
            let word = entry.load(Ordering::Relaxed);
            if fingerprint_of(word) == fingerprint {
                return Some(value_of(word));
            }
        }
        self.find(fingerprint)
    }

    /// The word of a fingerprint. Entries are taken in order: behind a free one there is
    /// nothing.
    pub(crate) fn find(self, fingerprint: u32) -> Option<u32> {
        for entries in [self.head, self.tail] {
            for entry in entries {
                let word = entry.load(Ordering::Relaxed);
                if fingerprint_of(word) == fingerprint {
                    return Some(value_of(word));
                }
                if word == EMPTY {
                    return None;
                }
            }
        }
        None
    }
}
