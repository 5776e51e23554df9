//! Rays through the scene on the device: the processor's hierarchy in a compressed form
//! ([`WideTree`]), and its walk in `wgsl/traverse_walk.wgsl`. Where a device is opened with ray
//! queries, its own acceleration structures ([`structure()`]) take their place.
//!
//! A node is 80 bytes: a coarse grid in space, and for each of its eight children the box in
//! steps of that grid, a byte a side (Ylitie, Karras and Laine 2017, "Efficient incoherent ray
//! traversal on GPUs through compressed wide BVHs"). Boxes only ever grow, so the device finds
//! what the processor finds. Nodes below a node lie one after another, and so do the triangles
//! of its leaves. A mesh that is placed is a node too: it holds the transform.
//!
//! Children lie in the slot that faces them, so that a ray visits them front to back by slot
//! numbers alone; the walk's stack then holds one entry a level, not one a child.

mod bodies;
mod grid;
mod node;
mod rays;
mod slots;
mod structure;
#[cfg(test)]
mod tests;
mod tree;

pub use grid::Grid;
pub use node::{NODE_QUADS, PlacedNode, TRIANGLE_QUADS, WideNode, WideTriangle};
pub use rays::{HIT_ROWS, RAY_ROWS, hits_of_rows, ray_rows};
pub use structure::structure;
pub use tree::{TraceError, WideTree};
