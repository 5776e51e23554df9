//! How much memory a file may claim. A few bytes of a lying file can ask for
//! terabytes (accessors without data, pictures of 65,535 pixels squared, the same
//! array read by a million primitives), so every array is charged before it is made.

use crate::error::{Checked, Fault};
use std::sync::atomic::{AtomicU64, Ordering};

pub(crate) struct Budget {
    limit: u64,
    used: AtomicU64,
}

impl Budget {
    pub fn new(limit: u64) -> Self {
        Self {
            limit,
            used: AtomicU64::new(0),
        }
    }

    /// Claims bytes for what is read at `place`.
    pub fn charge(&self, bytes: u64, place: &str) -> Checked<()> {
        let before = self.used.fetch_add(bytes.min(1 << 60), Ordering::Relaxed);
        if before.saturating_add(bytes) <= self.limit {
            return Ok(());
        }
        let (need, limit) = (
            megabytes(before.saturating_add(bytes)),
            megabytes(self.limit),
        );
        Err(Fault::new(
            place,
            format!("the scene needs {need} MB from here on, more than the {limit} MB allowed"),
        ))
    }

    pub fn left(&self) -> u64 {
        self.limit.saturating_sub(self.used.load(Ordering::Relaxed))
    }
}

fn megabytes(bytes: u64) -> u64 {
    bytes.div_ceil(1_000_000)
}

/// Four fifths of what the system says is available; 8 GB where it does not say.
pub(crate) fn available_memory() -> u64 {
    let meminfo = std::fs::read_to_string("/proc/meminfo").unwrap_or_default();
    let kilobytes = meminfo
        .lines()
        .find_map(|line| line.strip_prefix("MemAvailable:"))
        .and_then(|rest| {
            rest.trim()
                .trim_end_matches("kB")
                .trim()
                .parse::<u64>()
                .ok()
        });
    kilobytes.map_or(8_000_000_000, |k| k * 1024 / 5 * 4)
}
