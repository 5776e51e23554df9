//! A counting sort on the device: `src/wgsl/sort.wgsl` and the dispatches around it.

use crate::batch::{Batch, Extent};
use crate::error::GpuError;
use crate::memory::{Memory, Sections};
use crate::pipeline::Kernel;
use crate::shader::Library;
use std::sync::Arc;

/// The kernels of a sort: what they count and where they put it, their WGSL knows.
pub struct CountingSort {
    count: Arc<Kernel>,
    scan: Arc<Kernel>,
    place: Arc<Kernel>,
}

/// Sections with an element for each of the most items that are sorted.
pub const ITEMS: [&str; 2] = ["sort_keys", "sort_ranks"];
/// Sections with an element for each of the most different keys.
const KEYS: [&str; 2] = ["sort_bins", "sort_starts"];

/// Adds what sorts by at most so many different keys need, beside [`ITEMS`].
///
/// # Errors
/// If the library has no sort.
pub fn add_keys(sections: &mut Sections, library: &Library, keys: u64) -> Result<(), GpuError> {
    for name in KEYS {
        sections.zeroed(library, name, keys)?;
    }
    Ok(())
}

impl CountingSort {
    /// A sort whose first and last kernel (see `sort.wgsl`) have these names.
    ///
    /// # Errors
    /// If a kernel cannot be made.
    pub fn new(
        count: &str,
        place: &str,
        kernel: impl Fn(&str) -> Result<Arc<Kernel>, GpuError>,
    ) -> Result<CountingSort, GpuError> {
        Ok(CountingSort {
            count: kernel(count)?,
            scan: kernel("sort_scan")?,
            place: kernel(place)?,
        })
    }

    /// Sorts as many items as `extent` has invocations for, by keys less than `keys`.
    pub fn dispatch(
        &self,
        batch: &mut Batch,
        memories: &[&Memory],
        arguments: &[u32],
        keys: u32,
        extent: Extent,
    ) {
        let mut stage = |kernel: &Kernel, arguments: &[u32], extent| {
            batch.dispatch("sort", kernel, memories, arguments, extent);
        };
        stage(&self.count, arguments, extent);
        stage(&self.scan, &[keys], Extent::Items(1));
        stage(&self.place, arguments, extent);
    }
}
