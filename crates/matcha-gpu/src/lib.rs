//! The GPU.

pub mod trace;
