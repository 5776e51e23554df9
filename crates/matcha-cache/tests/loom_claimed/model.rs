//! `crates/matcha-gpu/src/wgsl/table_int32.wgsl` in Rust, line by line, on one cell: entries of
//! two words, a fingerprint that is claimed and a value, complemented, that is published after
//! it. All orderings are relaxed, as in WGSL.

use loom::sync::atomic::{AtomicU32, Ordering::Relaxed};
use matcha_cache::Insertion;

/// An entry: nobody's while the fingerprint is zero, not published while the value is.
#[derive(Default)]
struct Entry {
    fingerprint: AtomicU32,
    value: AtomicU32,
}

/// A cell, its entries in the order in which they are taken.
pub struct Cell {
    entries: Vec<Entry>,
    mistake: Option<Mistake>,
}

/// What makes the protocol wrong: for tests that must fail.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Mistake {
    /// The value is published before the entry is claimed.
    PublishedEarly,
    /// Whoever saw an empty entry takes it.
    NoExchange,
    /// A claimed entry is read although its value is not there yet.
    ReadEarly,
}

impl Cell {
    pub fn new(entries: u32, mistake: Option<Mistake>) -> Cell {
        Cell {
            entries: (0..entries).map(|_| Entry::default()).collect(),
            mistake,
        }
    }

    fn makes(&self, mistake: Mistake) -> bool {
        self.mistake == Some(mistake)
    }

    /// `table_find`.
    pub fn find(&self, key: u32) -> Option<u32> {
        for entry in &self.entries {
            let fingerprint = entry.fingerprint.load(Relaxed);
            if fingerprint == key {
                let value = entry.value.load(Relaxed);
                return (value != 0 || self.makes(Mistake::ReadEarly)).then_some(!value);
            }
            if fingerprint == 0 {
                break;
            }
        }
        None
    }

    /// `table_put`. It does not count losing to the same key, which here is [`Insertion::Lost`] as
    /// in `Table::insert`. Exchanges that fail without a reason, after which WGSL tries again, are
    /// not among what loom models.
    pub fn put(&self, key: u32, word: u32) -> Insertion {
        for entry in &self.entries {
            let fingerprint = entry.fingerprint.load(Relaxed);
            if fingerprint == 0 {
                return self.claim(entry, key, word);
            }
            if fingerprint == key {
                return Insertion::Present;
            }
        }
        Insertion::Full
    }

    fn claim(&self, entry: &Entry, key: u32, word: u32) -> Insertion {
        if self.makes(Mistake::PublishedEarly) {
            entry.value.store(!word, Relaxed);
        }
        if self.makes(Mistake::NoExchange) {
            entry.fingerprint.store(key, Relaxed);
        } else {
            let exchanged = entry.fingerprint.compare_exchange(0, key, Relaxed, Relaxed);
            if exchanged.is_err() {
                return Insertion::Lost;
            }
        }
        entry.value.store(!word, Relaxed);
        Insertion::Stored
    }
}
