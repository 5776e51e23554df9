//! Materials: from a node tree to a program, and the machine that runs it.
pub mod closure;
pub mod device;
pub mod graph;
pub mod input;
pub mod material;
pub mod ops;
pub mod program;
mod shifted;
pub mod source;
pub mod vm;
