//! Device code: the functions behind the operations, in a subset of Rust that a
//! translator turns into WGSL.
pub mod arithmetic;
