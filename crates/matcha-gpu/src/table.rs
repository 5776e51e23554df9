//! The material cache's table in the device's memory: `src/wgsl/table.wgsl` and one of its two
//! protocols, whichever the library holds.

use crate::error::GpuError;
use crate::memory::{Memory, Sections};
use crate::shader::Library;
use matcha_cache::TableSize;

/// Counters of the section `table_counts`.
const COUNTS: u64 = 3;
/// Sections whose elements are entries: of the 64-bit protocol, or both of the 32-bit one.
const ENTRIES: [&str; 3] = ["table_entries", "table_fingerprints", "table_values"];

/// What became of insertions. Those of keys that had a value are not counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TableCounts {
    /// Written.
    pub stored: u64,
    /// All entries of the cell belonged to other keys.
    pub refused: u64,
    /// Another invocation took the entry in the same moment.
    pub lost: u64,
}

/// The sections of an empty table of a size.
///
/// # Errors
/// If it has more entries than a device can number.
pub fn sections(library: &Library, size: TableSize) -> Result<Sections<'static>, GpuError> {
    let capacity = size.capacity();
    if size.cells > u64::from(u32::MAX) || capacity > u64::from(u32::MAX) {
        return Err(GpuError::OutOfMemory {
            what: "the material cache".to_owned(),
            bytes: size.bytes(),
        });
    }
    let mut sections = Sections::new();
    sections.filled(library, "table_size", vec![size.cells as u32, size.entries])?;
    sections.zeroed(library, "table_counts", COUNTS)?;
    for name in ENTRIES.iter().filter(|name| library.section(name).is_ok()) {
        sections.zeroed(library, name, capacity)?;
    }
    Ok(sections)
}

/// Entries of a table.
pub fn capacity(table: &Memory) -> u64 {
    let lengths = ENTRIES.map(|name| table.length(name));
    lengths.into_iter().flatten().next().unwrap_or(0)
}

/// Counts since the table was empty.
///
/// # Errors
/// If the device fails.
pub fn counts(table: &Memory) -> Result<TableCounts, GpuError> {
    let counts = table.read("table_counts", 0, COUNTS)?;
    let [stored, refused, lost] = [counts[0], counts[1], counts[2]].map(u64::from);
    Ok(TableCounts {
        stored,
        refused,
        lost,
    })
}

/// Makes a table empty again, in the order of `commands`.
///
/// # Errors
/// If it is none.
pub fn clear(table: &Memory, commands: &mut wgpu::CommandEncoder) -> Result<(), GpuError> {
    table.clear(commands, "table_counts")?;
    for name in ENTRIES.iter().filter(|name| table.holds(name)) {
        table.clear(commands, name)?;
    }
    Ok(())
}

/// Number of entries that hold something, by looking at all of them: for tests.
///
/// # Errors
/// If the device fails.
pub fn count_occupied(table: &Memory) -> Result<u64, GpuError> {
    let (name, words) = if table.holds(ENTRIES[0]) {
        (ENTRIES[0], 2)
    } else {
        (ENTRIES[1], 1)
    };
    let all = table.read(name, 0, capacity(table))?;
    let occupied = |entry: &&[u32]| entry.iter().any(|&word| word != 0);
    Ok(all.chunks_exact(words).filter(occupied).count() as u64)
}
