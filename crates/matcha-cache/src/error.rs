//! What can go wrong when a table is made.

/// Why a table could not be made.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CacheError {
    /// A count of zero.
    #[error(
        "a cache of {cells} cells of {entries} entries holds nothing: both counts must be at least 1"
    )]
    Empty {
        /// Cells asked for.
        cells: u64,
        /// Entries of each.
        entries: u32,
    },
    /// More cells than the 32-bit cell hash can tell apart, or more entries than are scanned.
    #[error(
        "a cache of {cells} cells of {entries} entries is beyond the limit of 4294967295 cells and 1024 entries"
    )]
    TooMany {
        /// Cells asked for.
        cells: u64,
        /// Entries of each.
        entries: u32,
    },
    /// More bytes than there are.
    #[error("a cache of {cells} cells of {entries} entries needs {} MiB, but only {} MiB of memory are available", bytes >> 20, available >> 20)]
    TooLarge {
        /// Cells asked for.
        cells: u64,
        /// Entries of each.
        entries: u32,
        /// Bytes that they take.
        bytes: u64,
        /// Bytes that the system offers.
        available: u64,
    },
    /// The allocator said no.
    #[error("the system refused {} MiB of memory for the cache", bytes >> 20)]
    Refused {
        /// Bytes asked for.
        bytes: u64,
    },
}
