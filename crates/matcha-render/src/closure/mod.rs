//! Closures of a hit: from the rows that a program returns to lobes that can be evaluated
//! and sampled. The mathematics is device code (`crate::device`); deciding which lobes
//! there are, and loops over them, is the host layer here.
//!
//! `docs/closures.md` lists models and sources. Directions point away from the surface;
//! values contain the cosine.

mod albedo;
pub mod integrate;
mod prepare;
mod principled;
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

pub use crate::device::lobe::ClosureFrame as Frame;
pub use prepare::{ClosureContext, prepare_closure};
pub use set::{Evaluated, LobeSet, Scattered, flags};
