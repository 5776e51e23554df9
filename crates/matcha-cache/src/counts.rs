//! Statistics. Every thread counts for itself, in plain integers, and whoever drives
//! the threads adds them up: shared counters would cost more than a look-up does.

use crate::Insertion;
use core::ops::AddAssign;
use serde::Serialize;

/// What happened to one thread's look-ups and insertions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct CacheCounts {
    /// Keys looked up.
    pub lookups: u64,
    /// Keys found.
    pub hits: u64,
    /// Entries written; the sum over all threads is the number of occupied entries.
    pub inserts: u64,
    /// Insertions that found every entry of their cell taken.
    pub refused: u64,
    /// Insertions that lost the race for an entry.
    pub lost: u64,
    /// Insertions whose key was there already (two hits of one batch on one texel).
    pub present: u64,
    /// Values that their encoding cannot hold (NaN, infinite, out of range): never stored.
    pub unencodable: u64,
}

impl CacheCounts {
    pub(crate) fn count(&mut self, outcome: Insertion) {
        match outcome {
            Insertion::Stored => self.inserts += 1,
            Insertion::Present => self.present += 1,
            Insertion::Full => self.refused += 1,
            Insertion::Lost => self.lost += 1,
        }
    }
}

impl AddAssign for CacheCounts {
    fn add_assign(&mut self, other: Self) {
        self.lookups += other.lookups;
        self.hits += other.hits;
        self.inserts += other.inserts;
        self.refused += other.refused;
        self.lost += other.lost;
        self.present += other.present;
        self.unencodable += other.unencodable;
    }
}
