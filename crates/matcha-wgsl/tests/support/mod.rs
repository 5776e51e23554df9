//! The workspace's device code, for tests.

use matcha_wgsl::{Module, Operations, Translation, operations, translate};
use std::path::{Path, PathBuf};

fn crates() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The `.rs` files of a folder, named from the workspace's root.
pub fn modules(folder: &str) -> Vec<Module> {
    let path = crates().join(folder);
    let mut names: Vec<_> = std::fs::read_dir(&path)
        .unwrap_or_else(|e| panic!("{}: {e}", path.display()))
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .filter(|name| name.ends_with(".rs"))
        .collect();
    names.sort();
    assert!(!names.is_empty(), "{folder} has no files");
    names
        .iter()
        .map(|name| module(&format!("{folder}/{name}")))
        .collect()
}

/// A file, by its path from `crates`.
pub fn module(path: &str) -> Module {
    let source = std::fs::read_to_string(crates().join(path));
    Module {
        path: format!("crates/{path}"),
        source: source.unwrap_or_else(|e| panic!("{path}: {e}")),
    }
}

/// Every device module.
pub fn device_modules() -> Vec<Module> {
    let mut all = modules("matcha-shade/src/device");
    all.extend(modules("matcha-cache/src/device"));
    all.extend(modules("matcha-render/src/device"));
    all
}

/// Every device module and `more`, translated.
pub fn device(more: Vec<Module>) -> Translation {
    let mut all = device_modules();
    all.extend(more);
    translate(&all).unwrap_or_else(|e| panic!("{e}"))
}

/// The table of operations over a translation.
pub fn table(device: &Translation) -> Operations {
    let table = module("matcha-shade/src/ops.rs");
    operations(&table, &modules("matcha-shade/src/ops"), device).unwrap_or_else(|e| panic!("{e}"))
}
