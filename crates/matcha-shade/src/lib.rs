//! Materials: from a node tree to a program, and the machine that runs it.
pub mod closure;
pub mod input;
pub mod source;
