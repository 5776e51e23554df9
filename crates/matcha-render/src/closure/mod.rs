//! Closures of a hit: from the rows that a program returns to lobes that can be evaluated
//! and sampled. All of that is device code (`crate::device::closure_prepare`, `closure_set`);
//! here are its names for the rest of the renderer, and its tables.
//!
//! `docs/closures.md` lists models and sources. Directions point away from the surface;
//! values contain the cosine.

mod code;
pub mod integrate;
mod prepare;
mod set;
pub mod tables;

#[cfg(test)]
mod chi_squared;
#[cfg(test)]
mod fixtures;
#[cfg(test)]
mod reference;
#[cfg(test)]
mod tests;

pub use crate::device::closure_set::LobeSet;
pub use crate::device::lobe::ClosureFrame as Frame;
pub use code::{code, most_lobes};
pub use prepare::{ClosureContext, prepare_closure};
pub use set::{Evaluated, Scattered, flags};
