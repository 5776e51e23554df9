//! Look-ups and insertions of a whole batch. One look-up in a table of hundreds of
//! megabytes waits for memory most of its time; a batch waits once: all keys are
//! hashed in lanes, all their cells prefetched, and only then are entries compared,
//! without branches. While a block is compared, the next one's cells are on their way.

use crate::device::key_hash::{KeyHash, NodeSeed, hash_texel};
use crate::sync::{AtomicU64, Ordering};
use crate::table::{fingerprint_of, value_of};
use crate::{CacheCounts, Table};

/// Keys that are in flight together.
const BLOCK: usize = 64;

/// Texels of a block, then their hashes.
struct Block {
    level: [i32; BLOCK],
    i: [i32; BLOCK],
    j: [i32; BLOCK],
    cell: [u32; BLOCK],
    fingerprint: [u32; BLOCK],
}

impl Block {
    fn new() -> Self {
        Self {
            level: [0; BLOCK],
            i: [0; BLOCK],
            j: [0; BLOCK],
            cell: [0; BLOCK],
            fingerprint: [0; BLOCK],
        }
    }
}

/// The hash over a block, compiled for what this CPU has.
pub(crate) struct HashBlock(fn(NodeSeed, &mut Block));

#[inline(always)]
fn hash_lanes(node: NodeSeed, block: &mut Block) {
    for k in 0..BLOCK {
        let hash = hash_texel(node, block.level[k], block.i[k], block.j[k]);
        block.cell[k] = hash.cell;
        block.fingerprint[k] = hash.fingerprint;
    }
}

fn hash_portable(node: NodeSeed, block: &mut Block) {
    hash_lanes(node, block);
}

#[cfg(all(target_arch = "x86_64", not(loom)))]
mod x86 {
    use super::*;

    #[target_feature(enable = "avx2")]
    fn hash_avx2_lanes(node: NodeSeed, block: &mut Block) {
        hash_lanes(node, block);
    }

    #[target_feature(enable = "avx512f,avx512dq,avx512vl")]
    fn hash_avx512_lanes(node: NodeSeed, block: &mut Block) {
        hash_lanes(node, block);
    }

    pub(super) fn hash_avx2(node: NodeSeed, block: &mut Block) {
        // SAFETY: chosen only where `best` found AVX2.
        unsafe { hash_avx2_lanes(node, block) }
    }

    pub(super) fn hash_avx512(node: NodeSeed, block: &mut Block) {
        // SAFETY: chosen only where `best` found these parts of AVX-512.
        unsafe { hash_avx512_lanes(node, block) }
    }

    pub(super) fn best() -> fn(NodeSeed, &mut Block) {
        if is_x86_feature_detected!("avx512dq") && is_x86_feature_detected!("avx512vl") {
            hash_avx512
        } else if is_x86_feature_detected!("avx2") {
            hash_avx2
        } else {
            hash_portable
        }
    }
}

impl HashBlock {
    pub(crate) fn for_this_cpu() -> Self {
        #[cfg(all(target_arch = "x86_64", not(loom)))]
        return Self(x86::best());
        #[cfg(not(all(target_arch = "x86_64", not(loom))))]
        return Self(hash_portable);
    }
}

/// Asks for the cache lines of a cell.
#[inline(always)]
fn prefetch(cell: &[AtomicU64]) {
    #[cfg(all(target_arch = "x86_64", not(loom), not(miri)))]
    for entry in cell.iter().step_by(8).chain(cell.last()) {
        // SAFETY: a prefetch is a hint and reads nothing; SSE is part of x86-64.
        unsafe {
            use core::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
            _mm_prefetch::<_MM_HINT_T0>(core::ptr::from_ref(entry).cast());
        }
    }
    #[cfg(not(all(target_arch = "x86_64", not(loom), not(miri))))]
    let _ = cell;
}

/// Value and presence of a fingerprint in a cell: every entry is looked at, none
/// branches. A fingerprint is in a cell at most once, so or-ing picks the one.
#[inline(always)]
fn compare(cell: &[AtomicU64], fingerprint: u32) -> (u32, bool) {
    let mut value = 0;
    let mut mask = 0;
    for entry in cell {
        let word = entry.load(Ordering::Relaxed);
        let same = 0u32.wrapping_sub(u32::from(fingerprint_of(word) == fingerprint));
        value |= value_of(word) & same;
        mask |= same;
    }
    (value, mask != 0)
}

impl Table {
    /// Looks up `n = values.len()` texels of a node; `texel_at(k)` is the k-th one's
    /// level and indices. `values[k]` is the stored word where `found[k]`, else 0.
    ///
    /// # Panics
    /// If `found` is shorter than `values`.
    pub fn look_up_batch(
        &self,
        node: NodeSeed,
        texel_at: impl Fn(usize) -> [i32; 3],
        values: &mut [u32],
        found: &mut [bool],
        counts: &mut CacheCounts,
    ) {
        let found = &mut found[..values.len()];
        let mut hits = 0;
        self.in_blocks(node, values.len(), texel_at, |block, first, n| {
            let values = &mut values[first..first + n];
            hits += self.compare_block(block, values, &mut found[first..first + n]);
        });
        counts.lookups += values.len() as u64;
        counts.hits += hits;
    }

    /// Stores `n` words of a node; `texel_at(k)` and `word_at(k)` give the k-th one's.
    pub fn insert_batch(
        &self,
        node: NodeSeed,
        n: usize,
        texel_at: impl Fn(usize) -> [i32; 3],
        word_at: impl Fn(usize) -> u32,
        counts: &mut CacheCounts,
    ) {
        self.in_blocks(node, n, texel_at, |block, first, n| {
            for k in 0..n {
                let hash = KeyHash {
                    cell: block.cell[k],
                    fingerprint: block.fingerprint[k],
                };
                counts.count(self.put(hash, word_at(first + k)));
            }
        });
    }

    /// Runs `work(block, first, n)` over blocks whose hashes are known and whose cells
    /// were prefetched one block ahead.
    #[inline(always)]
    fn in_blocks(
        &self,
        node: NodeSeed,
        n: usize,
        texel_at: impl Fn(usize) -> [i32; 3],
        mut work: impl FnMut(&Block, usize, usize),
    ) {
        let mut blocks = [Block::new(), Block::new()];
        let prepare = |block: &mut Block, first: usize| {
            let length = BLOCK.min(n - first);
            for k in 0..length {
                [block.level[k], block.i[k], block.j[k]] = texel_at(first + k);
            }
            (self.hash_block.0)(node, block);
            for k in 0..length {
                prefetch(self.cell(block.cell[k]));
            }
        };
        if n > 0 {
            prepare(&mut blocks[0], 0);
        }
        for first in (0..n).step_by(BLOCK) {
            let [current, next] = &mut blocks;
            if first + BLOCK < n {
                prepare(next, first + BLOCK);
            }
            work(current, first, BLOCK.min(n - first));
            blocks.swap(0, 1);
        }
    }

    /// Compares a block; returns the number of keys found.
    #[inline(always)]
    fn compare_block(&self, block: &Block, values: &mut [u32], found: &mut [bool]) -> u64 {
        match self.size().entries {
            4 => self.compare_cells::<4>(block, values, found),
            8 => self.compare_cells::<8>(block, values, found),
            10 => self.compare_cells::<10>(block, values, found),
            16 => self.compare_cells::<16>(block, values, found),
            _ => self.compare_cells::<0>(block, values, found),
        }
    }

    /// With the number of entries known to the compiler, 0 where it is not.
    fn compare_cells<const ENTRIES: usize>(
        &self,
        block: &Block,
        values: &mut [u32],
        found: &mut [bool],
    ) -> u64 {
        let mut hits = 0;
        for (k, (value, found)) in values.iter_mut().zip(found).enumerate() {
            let cell = self.cell(block.cell[k]);
            (*value, *found) = match cell.first_chunk::<ENTRIES>() {
                Some(cell) if ENTRIES > 0 => compare(cell, block.fingerprint[k]),
                _ => compare(cell, block.fingerprint[k]),
            };
            hits += u64::from(*found);
        }
        hits
    }
}
