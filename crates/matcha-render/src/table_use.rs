//! How many cells of the cache's table are in use.
//!
//! The paper's table takes 763 MiB, which are cleared in the time of a few million look-ups, and
//! many scenes fill a hundredth of it. So a rendering begins with few cells, sees what some tiles
//! of the picture store, and goes on with as many as all tiles will need, at most the table's.
//! What was stored until then is evaluated again; what is found does not depend on it.

use matcha_cache::{CacheError, Table, TableSize};

/// Cells before anything is known of the scene: 20 MiB with ten entries in each.
const FIRST_CELLS: u64 = 1 << 18;

/// Cells for each entry that the first samples of the whole picture will store. Later samples
/// store less: with 64 instead of 8 it was 1.5 to 1.7 times as many in SHELF and the tea room.
const CELLS_AN_ENTRY: u64 = 8;

/// With more entries than half its cells, a table gets more cells: squares of a table that
/// share their cells fill unevenly, some long before all.
const LEAST_CELLS_AN_ENTRY: u64 = 2;

/// Decides it.
#[derive(Debug)]
pub(crate) struct TableUse {
    /// Entries stored before the table was last emptied.
    dropped: u64,
    /// Something is known of the scene.
    seen: bool,
}

impl TableUse {
    /// A table that begins with few cells.
    ///
    /// # Errors
    /// If the whole table cannot be had.
    pub fn begin(size: TableSize) -> Result<(Table, Self), CacheError> {
        let table = Table::with_cells_in_use(size, FIRST_CELLS)?;
        let cells = Self {
            dropped: 0,
            seen: table.cells_in_use() == size.cells,
        };
        Ok((table, cells))
    }

    /// Whether some tiles must tell before all are rendered.
    pub fn wants_to_see(&self) -> bool {
        !self.seen
    }

    /// Changes the cells in use to what `inserts` entries, stored by `share` of the picture, need.
    pub fn foresee(&mut self, table: &mut Table, inserts: u64, share: f64) {
        self.seen = true;
        let all = (self.entries(inserts) as f64 / share) as u64;
        self.grow(table, inserts, all.saturating_mul(CELLS_AN_ENTRY));
    }

    /// Makes room where more was stored than was foreseen.
    pub fn keep_room(&mut self, table: &mut Table, inserts: u64) {
        let entries = self.entries(inserts);
        if LEAST_CELLS_AN_ENTRY * entries > table.cells_in_use() {
            self.grow(table, inserts, entries.saturating_mul(CELLS_AN_ENTRY));
        }
    }

    /// Entries that are taken, of all that were ever stored.
    pub fn entries(&self, inserts: u64) -> u64 {
        inserts - self.dropped
    }

    fn grow(&mut self, table: &mut Table, inserts: u64, cells: u64) {
        let cells = cells.min(table.size().cells);
        if cells > table.cells_in_use() {
            table.use_cells(cells);
            self.dropped = inserts;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn begin(cells: u64) -> (Table, TableUse) {
        TableUse::begin(TableSize { cells, entries: 2 }).unwrap()
    }

    #[test]
    fn the_table_grows_to_what_tiles_foretell_and_to_what_comes() {
        let (mut table, mut cells) = begin(10_000_000);
        assert_eq!(table.cells_in_use(), FIRST_CELLS);
        assert!(cells.wants_to_see());
        cells.foresee(&mut table, 10_000, 0.1);
        assert!(!cells.wants_to_see());
        assert_eq!((table.cells_in_use(), cells.entries(10_000)), (800_000, 0));
        cells.keep_room(&mut table, 10_000 + 400_000);
        assert_eq!(table.cells_in_use(), 800_000, "half an entry a cell");
        cells.keep_room(&mut table, 10_000 + 500_000);
        assert_eq!(table.cells_in_use(), 4_000_000);
        cells.keep_room(&mut table, 510_000 + 3_000_000);
        assert_eq!(table.cells_in_use(), 10_000_000, "all");
        cells.keep_room(&mut table, 3_510_000 + 90_000_000);
        assert_eq!(cells.entries(93_510_000), 90_000_000, "there are no more");
    }

    #[test]
    fn few_entries_keep_few_cells() {
        let (mut table, mut cells) = begin(1_000_000);
        cells.foresee(&mut table, 100, 0.1);
        assert_eq!(table.cells_in_use(), FIRST_CELLS);
        assert_eq!(cells.entries(100), 100, "nothing was dropped");
    }

    #[test]
    fn a_small_table_is_used_whole() {
        let (table, cells) = begin(1000);
        assert_eq!(table.cells_in_use(), 1000);
        assert!(!cells.wants_to_see());
    }
}
