//! The machine.
pub mod kernel;
