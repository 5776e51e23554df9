//! Any bytes load or are refused; nothing panics, hangs or takes more than 64 MB.
//! Run with `cargo +nightly fuzz run load_glb_bytes`.

#![no_main]

use libfuzzer_sys::fuzz_target;
use matcha_import::{LoadOptions, load_bytes};

fuzz_target!(|bytes: &[u8]| {
    let options = LoadOptions { memory_limit: Some(64 << 20), ..LoadOptions::default() };
    let _ = load_bytes("fuzz.glb", bytes, &options, &mut |_| {});
});
