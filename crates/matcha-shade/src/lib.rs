//! Materials: from a node tree to a program, and the machine that runs it.
pub mod cacheability;
pub mod closure;
pub mod compile;
pub mod device;
mod emit;
pub mod graph;
pub mod input;
pub mod material;
pub mod nodes;
pub mod ops;
pub mod opt;
pub mod program;
pub mod rows;
mod shifted;
pub mod source;
pub mod vm;

pub use nodes::LowerError;
