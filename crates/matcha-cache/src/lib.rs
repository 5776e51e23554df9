//! The material cache: a fixed table that all threads fill and read without locks
//! (Fujieda and Harada 2022, sections 3.2 and 3.3), the keys it is asked with, and the
//! encodings that put a node's value into 32 bits.
//!
//! An entry is one 64-bit word, fingerprint and value together, and is written once by
//! one compare-and-swap. So a reader sees a whole entry or an empty one, whatever the
//! memory model, and relaxed ordering is enough: nothing else is published through it.
//!
//! * [`Table`] is the table, [`TableSize`] its size.
//! * [`device`] holds the hashes and encodings, in the subset of Rust that GPUs share.
//! * [`ValueKind`] says how a value of some type is laid into words.
//! * [`CacheCounts`] are statistics that each thread keeps for itself.
//!
//! Built with `--cfg loom`, the atomics are loom's and the table can be model-checked.

mod batch;
mod counts;
pub mod device;
mod error;
mod size;
mod storage;
mod sync;
mod table;
mod value;

pub use batch::{Found, Keys, MOST_SEEDS};
pub use counts::CacheCounts;
pub use device::key_hash::{NODES_A_CELL, NodeSeed};
pub use error::CacheError;
pub use size::{TableSize, available_memory, fitting_size};
pub use table::{Insertion, Table, node_seed};
pub use value::{MOST_WORDS, ValueKind};
