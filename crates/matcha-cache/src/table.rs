//! The table: algorithm 1 of Fujieda and Harada 2022, and its reading side.

use crate::batch::HashRows;
use crate::device::key_hash::{KeyHash, NodeSeed, cell_of, hash_texel, seed_of_node};
use crate::storage::Storage;
use crate::sync::{AtomicU64, Ordering};
use crate::{CacheCounts, CacheError, TableSize, available_memory};

/// What became of an insertion. Whatever it is, the value that was to be stored is
/// good: the caller goes on with it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Insertion {
    /// Written.
    Stored,
    /// The key has a value already; the first one stays.
    Present,
    /// All entries of the cell belong to other keys.
    Full,
    /// Another thread took the entry in the same moment.
    Lost,
}

/// Seed of a cacheable node's keys. Nodes from a multiple of [`NODES_A_CELL`](crate::NODES_A_CELL) on share
/// their cells. `part` is 0, and counts up for values that take
/// several words.
pub fn node_seed(material: u32, node: u32, part: u32) -> NodeSeed {
    seed_of_node(material, node, part)
}

/// A fixed table of `cells × entries` entries, shared by all threads. Keys go to the cells that
/// are in use, at first all; memory of the others is never touched.
pub struct Table {
    storage: Storage,
    size: TableSize,
    cells_in_use: u64,
    pub(crate) hash_rows: HashRows,
}

impl core::fmt::Debug for Table {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Table")
            .field("size", &self.size)
            .finish_non_exhaustive()
    }
}

impl Table {
    /// An empty table. Memory is taken from the system as entries are written, but a
    /// table larger than what is available now is refused.
    pub fn new(size: TableSize) -> Result<Self, CacheError> {
        size.check()?;
        if let Some(available) = available_memory().filter(|&rest| size.bytes() > rest) {
            let TableSize { cells, entries } = size;
            return Err(CacheError::TooLarge {
                cells,
                entries,
                bytes: size.bytes(),
                available,
            });
        }
        let length = usize::try_from(size.capacity()).map_err(|_| CacheError::Refused {
            bytes: size.bytes(),
        })?;
        Ok(Self {
            storage: Storage::new(length)?,
            size,
            cells_in_use: size.cells,
            hash_rows: HashRows::for_this_cpu(),
        })
    }

    /// The same of which the first `cells` cells are in use, as after [`Table::use_cells`].
    #[cfg(not(loom))]
    pub fn with_cells_in_use(size: TableSize, cells: u64) -> Result<Self, CacheError> {
        let mut table = Self::new(size)?;
        // Nothing was written yet, so nothing is to be cleared.
        table.cells_in_use = 0;
        table.use_cells(cells);
        Ok(table)
    }

    /// Number of cells that keys go to.
    pub fn cells_in_use(&self) -> u64 {
        self.cells_in_use
    }

    /// Empties the table, and lets keys go to its first `cells` cells from now on, at least one
    /// and at most all. Their memory is taken from the system now, on all cores, instead of while
    /// they are filled: keys spread over all of it, so nearly all is needed soon.
    #[cfg(not(loom))]
    pub fn use_cells(&mut self, cells: u64) {
        let before = core::mem::replace(&mut self.cells_in_use, cells.clamp(1, self.size.cells));
        let now = self.cells_in_use;
        let (heads, tails) = self.heads_and_tails();
        for (words, of_a_cell) in [(heads, self.head()), (tails, self.tail())] {
            let [before, now] = [before, now].map(|cells| cells as usize * of_a_cell);
            let (used, rest) = words.split_at(before);
            on_all_cores(used, |part| {
                part.iter()
                    .for_each(|word| word.store(EMPTY, Ordering::Relaxed));
            });
            on_all_cores(&rest[..now.saturating_sub(before)], take);
        }
    }

    /// Its size.
    pub fn size(&self) -> TableSize {
        self.size
    }

    /// Number of entries that hold something, by looking at all of them: for tests.
    /// The sum of [`CacheCounts::inserts`] tells the same without.
    pub fn count_occupied(&self) -> u64 {
        let occupied = |word: &&AtomicU64| word.load(Ordering::Relaxed) != 0;
        self.storage.words().iter().filter(occupied).count() as u64
    }

    /// The word stored for a texel of a node.
    pub fn look_up(
        &self,
        node: NodeSeed,
        texel: [i32; 3],
        counts: &mut CacheCounts,
    ) -> Option<u32> {
        counts.lookups += 1;
        let found = self.find(self.hash(node, texel));
        counts.hits += u64::from(found.is_some());
        found
    }

    /// Stores a word for a texel of a node, if there is room and nobody is faster.
    pub fn insert(
        &self,
        node: NodeSeed,
        texel: [i32; 3],
        value: u32,
        counts: &mut CacheCounts,
    ) -> Insertion {
        let outcome = self.put(self.hash(node, texel), value);
        counts.count(outcome);
        outcome
    }

    fn hash(&self, node: NodeSeed, [level, i, j]: [i32; 3]) -> KeyHash {
        hash_texel(node, level, i, j)
    }

    /// The entries of a cell.
    #[inline(always)]
    pub(crate) fn cell(&self, number: u32) -> Cell<'_> {
        let number = number as usize;
        let (head, tail) = (self.head(), self.tail());
        let (heads, tails) = self.heads_and_tails();
        Cell {
            head: &heads[number * head..][..head],
            tail: &tails[number * tail..][..tail],
        }
    }

    /// The first entries of all cells, and the rest of all cells.
    #[inline(always)]
    fn heads_and_tails(&self) -> (&[AtomicU64], &[AtomicU64]) {
        let heads = self.size.cells as usize * self.head();
        self.storage.words().split_at(heads)
    }

    /// Number of a cell's entries that lie in one line.
    #[inline(always)]
    fn head(&self) -> usize {
        HEAD.min(self.size.entries as usize)
    }

    /// Number of a cell's other entries.
    #[inline(always)]
    fn tail(&self) -> usize {
        self.size.entries as usize - self.head()
    }

    fn cell_named(&self, hash: KeyHash) -> Cell<'_> {
        self.cell(cell_of(hash.cell, self.cells_in_use as u32))
    }

    fn find(&self, hash: KeyHash) -> Option<u32> {
        self.cell_named(hash).find(hash.fingerprint)
    }

    fn put(&self, hash: KeyHash, value: u32) -> Insertion {
        self.cell_named(hash).put(hash.fingerprint, value)
    }
}

/// Does something with the parts of a list, one for each core.
#[cfg(not(loom))]
fn on_all_cores(words: &[AtomicU64], work: impl Fn(&[AtomicU64]) + Sync) {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let part = words.len().div_ceil(threads).max(1);
    std::thread::scope(|scope| {
        for part in words.chunks(part) {
            scope.spawn(|| work(part));
        }
    });
}

/// Takes memory from the system, page by page. A write that changes nothing: a read would not
/// make the page ours, and arithmetic that changes nothing is compiled to a read.
#[cfg(not(loom))]
fn take(words: &[AtomicU64]) {
    const WORDS_OF_A_PAGE: usize = 4096 / 8;
    for word in words.iter().step_by(WORDS_OF_A_PAGE) {
        let _ = word.compare_exchange(EMPTY, EMPTY, Ordering::Relaxed, Ordering::Relaxed);
    }
}

/// Entries of a cell that lie together in one line of 64 bytes. Those of all cells come
/// first, then the rest of each cell: a cell of ten entries would straddle two lines, but
/// the last two are looked at only where eight are taken.
const HEAD: usize = 8;

/// A cell's entries, in the order in which they are taken.
#[derive(Clone, Copy)]
pub(crate) struct Cell<'a> {
    pub(crate) head: &'a [AtomicU64],
    pub(crate) tail: &'a [AtomicU64],
}

impl Cell<'_> {
    /// Algorithm 1.
    pub(crate) fn put(self, fingerprint: u32, value: u32) -> Insertion {
        for entry in self.head.iter().chain(self.tail) {
            let word = entry.load(Ordering::Relaxed);
            if fingerprint_of(word) == fingerprint {
                return Insertion::Present;
            }
            if word == EMPTY {
                let new = word_of(fingerprint, value);
                let swap = entry.compare_exchange(EMPTY, new, Ordering::Relaxed, Ordering::Relaxed);
                return if swap.is_ok() {
                    Insertion::Stored
                } else {
                    Insertion::Lost
                };
            }
        }
        Insertion::Full
    }
}

/// An entry that nobody has written. No fingerprint is zero, so no written one is this.
pub(crate) const EMPTY: u64 = 0;

fn word_of(fingerprint: u32, value: u32) -> u64 {
    u64::from(fingerprint) << 32 | u64::from(value)
}

#[inline(always)]
pub(crate) fn fingerprint_of(word: u64) -> u32 {
    (word >> 32) as u32
}

#[inline(always)]
pub(crate) fn value_of(word: u64) -> u32 {
    word as u32
}

#[cfg(all(test, not(loom)))]
mod tests {
    use super::*;

    fn table(cells: u64, entries: u32) -> Table {
        Table::new(TableSize { cells, entries }).unwrap()
    }

    #[test]
    fn the_first_value_stays() {
        let table = table(16, 4);
        let node = node_seed(1, 2, 0);
        let mut counts = CacheCounts::default();
        assert_eq!(table.look_up(node, [3, -4, 5], &mut counts), None);
        assert_eq!(
            table.insert(node, [3, -4, 5], 7, &mut counts),
            Insertion::Stored
        );
        assert_eq!(
            table.insert(node, [3, -4, 5], 8, &mut counts),
            Insertion::Present
        );
        assert_eq!(table.look_up(node, [3, -4, 5], &mut counts), Some(7));
        let expected = CacheCounts {
            lookups: 2,
            hits: 1,
            inserts: 1,
            present: 1,
            ..CacheCounts::default()
        };
        assert_eq!(counts, expected);
        assert_eq!(table.count_occupied(), 1);
    }

    #[test]
    fn a_full_cell_refuses_and_keeps_what_it_has() {
        let table = table(1, 3);
        let node = node_seed(0, 0, 0);
        let mut counts = CacheCounts::default();
        for i in 0..5 {
            let expected = if i < 3 {
                Insertion::Stored
            } else {
                Insertion::Full
            };
            assert_eq!(
                table.insert(node, [0, i, 0], i as u32, &mut counts),
                expected
            );
        }
        for i in 0..5 {
            let expected = (i < 3).then_some(i as u32);
            assert_eq!(table.look_up(node, [0, i, 0], &mut counts), expected);
        }
        assert_eq!(counts.refused, 2);
    }

    /// Stores a thousand texels; how many entries are taken then, and how many of the words behind
    /// the first cells' are.
    fn fill(table: &Table, cells: usize) -> (u64, usize) {
        let node = node_seed(1, 1, 0);
        let mut counts = CacheCounts::default();
        for i in 0..1000 {
            table.insert(node, [0, i % 40, i / 40], i as u32, &mut counts);
        }
        let taken = |words: &[AtomicU64], of_a_cell: usize| {
            let behind = words[cells * of_a_cell..].iter();
            behind.filter(|w| w.load(Ordering::Relaxed) != 0).count()
        };
        let (heads, tails) = table.heads_and_tails();
        let beyond = taken(heads, table.head()) + taken(tails, table.tail());
        (table.count_occupied(), beyond)
    }

    #[test]
    fn keys_go_to_the_cells_in_use_and_a_change_empties_the_table() {
        let (cells, entries) = (100_000, 10);
        let mut table = Table::with_cells_in_use(TableSize { cells, entries }, 70).unwrap();
        assert_eq!(fill(&table, 70).1, 0);
        for cells in [50, 1000, 300, 100_000] {
            table.use_cells(cells);
            assert_eq!(table.count_occupied(), 0, "{cells}");
            let (taken, beyond) = fill(&table, cells as usize);
            assert!(taken > 400, "{taken}");
            assert_eq!(beyond, 0, "{cells}");
        }
        table.use_cells(1 << 40);
        assert_eq!(table.cells_in_use(), 100_000);
        table.use_cells(0);
        assert_eq!(table.cells_in_use(), 1);
    }

    #[test]
    fn value_zero_is_a_value() {
        let table = table(1, 1);
        let mut counts = CacheCounts::default();
        table.insert(node_seed(0, 0, 0), [0, 0, 0], 0, &mut counts);
        assert_eq!(
            table.look_up(node_seed(0, 0, 0), [0, 0, 0], &mut counts),
            Some(0)
        );
    }

    /// The hash is a bijection, so the key whose raw fingerprint is zero exists, but not
    /// within reach of a search; the remapped fingerprint is put and found as any other.
    #[test]
    fn the_fingerprint_that_stands_for_zero_works() {
        let table = table(1, 2);
        let zero = KeyHash {
            cell: 0,
            fingerprint: 0xFFFF_FFFF,
        };
        assert_eq!(table.find(zero), None);
        assert_eq!(table.put(zero, 0), Insertion::Stored);
        assert_eq!(
            table.put(
                KeyHash {
                    cell: 0,
                    fingerprint: 1
                },
                0
            ),
            Insertion::Stored
        );
        assert_eq!(table.find(zero), Some(0));
        assert_eq!(
            table.find(KeyHash {
                cell: 0,
                fingerprint: 2
            }),
            None
        );
    }

    #[test]
    fn a_table_beyond_memory_is_refused_in_a_sentence() {
        let error = Table::new(TableSize {
            cells: 4_000_000_000,
            entries: 1024,
        })
        .unwrap_err();
        assert!(
            error
                .to_string()
                .contains("4000000000 cells of 1024 entries"),
            "{error}"
        );
    }
}
