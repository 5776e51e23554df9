//! Device code: hashes and encodings, written once for CPU and GPU in the subset of
//! Rust that translates (free functions, plain numbers, no control flow but `if`).

pub mod encoding;
pub mod intrinsics;
pub mod key_hash;
pub mod value;
