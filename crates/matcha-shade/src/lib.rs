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
pub mod oracle;
pub mod program;
#[cfg(test)]
mod properties;
pub mod rows;
mod shifted;
pub mod source;
pub mod vm;

pub use nodes::LowerError;

// The tests' support speaks of the crate as its users do.
#[cfg(test)]
extern crate self as matcha_shade;
