//! The material cache's table of a rendering: group 3.

use crate::device::Device;
use crate::error::GpuError;
use crate::memory::Memory;
use crate::shader::Library;
use crate::table;
use matcha_cache::TableSize;
use matcha_render::backend::{CacheMode, CacheStatistics};
use matcha_render::flat::FlatScene;

/// Number of the bind group.
const GROUP: u32 = 3;

/// Places the table that a mode asks for, smaller if the device has no memory for it and nobody
/// asked for the size; `None` where nothing is to be kept.
pub(super) fn place(
    device: &Device,
    library: &Library,
    mode: &CacheMode,
    flat: &FlatScene,
) -> Result<Option<Memory>, GpuError> {
    let CacheMode::Paper { cells, entries, .. } = *mode else {
        return Ok(None);
    };
    let asked = TableSize {
        cells: cells.unwrap_or(TableSize::PAPER.cells),
        entries: entries.unwrap_or(TableSize::PAPER.entries),
    };
    // A scene without cacheable nodes needs none, but kernels want to be bound to one.
    let mut size = if flat.programs().regions() == 0 && cells.is_none() {
        TableSize { cells: 1, ..asked }
    } else {
        asked
    };
    loop {
        match place_size(device, library, size) {
            Ok(memory) => {
                if size != asked && flat.programs().regions() > 0 {
                    tracing::warn!(
                        "the material cache of {} × {} entries does not fit into the device's memory: {} cells are used",
                        asked.cells,
                        asked.entries,
                        size.cells
                    );
                }
                return Ok(Some(memory));
            }
            Err(GpuError::OutOfMemory { .. } | GpuError::Placement(_))
                if cells.is_none() && size.cells > 1024 =>
            {
                size.cells /= 2;
            }
            Err(error) => return Err(error),
        }
    }
}

fn place_size(device: &Device, library: &Library, size: TableSize) -> Result<Memory, GpuError> {
    table::sections(library, size)?.place(device, GROUP, &[])
}

/// Added to the level of the virtual texture.
pub(super) fn level_offset(mode: &CacheMode) -> f32 {
    match *mode {
        CacheMode::Paper { level_offset, .. } => level_offset,
        CacheMode::Off => 0.0,
    }
}

/// What became of insertions so far. A device that fails says so elsewhere.
pub(super) fn read_counts(memory: &Memory) -> CacheStatistics {
    let counts = table::counts(memory).unwrap_or_default();
    let capacity = table::capacity(memory);
    CacheStatistics {
        inserts: counts.stored,
        refused: counts.refused,
        races_lost: counts.lost,
        occupied: counts.stored,
        capacity,
        bytes: 8 * capacity,
        ..CacheStatistics::default()
    }
}
