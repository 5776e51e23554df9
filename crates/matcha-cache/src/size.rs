//! How large the table is.

use crate::CacheError;
use serde::Serialize;

/// Number of cells and of entries in each (`N_c` and `N_e` in the paper).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct TableSize {
    /// Cells; the first hash picks one.
    pub cells: u64,
    /// Entries of a cell; the fingerprint picks one.
    pub entries: u32,
}

impl TableSize {
    /// The size that the paper measured to be best: 10⁷ × 10, 763 MiB.
    pub const PAPER: TableSize = TableSize {
        cells: 10_000_000,
        entries: 10,
    };

    /// Entries of all cells.
    pub fn capacity(self) -> u64 {
        self.cells.saturating_mul(u64::from(self.entries))
    }

    /// Memory of the entries, bytes.
    pub fn bytes(self) -> u64 {
        self.capacity().saturating_mul(8)
    }

    /// Refuses sizes that no table can have, whatever the memory.
    ///
    /// # Errors
    /// If it holds nothing, or more than a hash can tell apart.
    pub fn check(self) -> Result<(), CacheError> {
        let TableSize { cells, entries } = self;
        if cells == 0 || entries == 0 {
            return Err(CacheError::Empty { cells, entries });
        }
        if cells > u64::from(u32::MAX) || entries > 1024 {
            return Err(CacheError::TooMany { cells, entries });
        }
        Ok(())
    }
}

impl Default for TableSize {
    fn default() -> Self {
        Self::PAPER
    }
}

/// The requested size if it takes at most a quarter of `available` bytes, else the
/// same with fewer cells, so that it does. The caller says so when it changed.
pub fn fitting_size(requested: TableSize, available: u64) -> TableSize {
    let budget = available / 4;
    if requested.bytes() <= budget {
        return requested;
    }
    let cell_bytes = 8 * u64::from(requested.entries.max(1));
    TableSize {
        cells: (budget / cell_bytes).max(1),
        ..requested
    }
}

/// Memory that can be had without swapping, bytes: the smaller of the kernel's
/// `MemAvailable` and what a memory control group leaves. `None` where the system
/// does not say.
pub fn available_memory() -> Option<u64> {
    let system = std::fs::read_to_string("/proc/meminfo")
        .ok()
        .and_then(|text| parse_meminfo(&text))?;
    Some(control_group_rest().map_or(system, |rest| rest.min(system)))
}

fn parse_meminfo(text: &str) -> Option<u64> {
    let line = text
        .lines()
        .find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes * 1024)
}

fn control_group_rest() -> Option<u64> {
    let number = |name: &str| -> Option<u64> {
        let path = format!("/sys/fs/cgroup/{name}");
        std::fs::read_to_string(path).ok()?.trim().parse().ok()
    };
    Some(number("memory.max")?.saturating_sub(number("memory.current")?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_papers_table_is_763_mebibytes() {
        assert_eq!(TableSize::PAPER.bytes() / 1_048_576, 762);
        assert_eq!(TableSize::PAPER.bytes(), 800_000_000);
    }

    #[test]
    fn a_size_that_fits_stays() {
        assert_eq!(
            fitting_size(TableSize::PAPER, 3_200_000_000),
            TableSize::PAPER
        );
    }

    #[test]
    fn a_size_that_does_not_fit_shrinks_to_a_quarter() {
        let size = fitting_size(TableSize::PAPER, 400_000_000);
        assert_eq!(
            size,
            TableSize {
                cells: 1_250_000,
                entries: 10
            }
        );
        assert_eq!(fitting_size(TableSize::PAPER, 0).cells, 1);
    }

    #[test]
    fn meminfo_is_read_in_kibibytes() {
        let text = "MemTotal:       100 kB\nMemAvailable:    40 kB\n";
        assert_eq!(parse_meminfo(text), Some(40_960));
        assert_eq!(parse_meminfo("MemTotal: 1 kB"), None);
    }

    #[test]
    fn impossible_sizes_are_refused() {
        for (cells, entries) in [(0, 10), (10, 0), (1 << 32, 1), (1, 1025)] {
            assert!(TableSize { cells, entries }.check().is_err());
        }
    }
}
