//! All device modules of the workspace translate, and naga accepts them.

use matcha_wgsl::{
    DispatchForm, Module, Operations, Source, Translation, check, operations, translate,
};
use naga::valid::Capabilities;
use std::path::{Path, PathBuf};

fn crates() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The `.rs` files of a folder, named from the workspace's root.
fn modules(folder: &str) -> Vec<Module> {
    let path = crates().join(folder);
    let mut names: Vec<_> = std::fs::read_dir(&path)
        .unwrap_or_else(|e| panic!("{}: {e}", path.display()))
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .filter(|name| name.ends_with(".rs"))
        .collect();
    names.sort();
    assert!(!names.is_empty(), "{folder} has no files");
    let read = |name: &String| Module {
        path: format!("crates/{folder}/{name}"),
        source: std::fs::read_to_string(path.join(name)).expect("a listed file reads"),
    };
    names.iter().map(read).collect()
}

fn device() -> Translation {
    let mut all = modules("matcha-shade/src/device");
    all.extend(modules("matcha-cache/src/device"));
    all.extend(modules("matcha-render/src/device"));
    translate(&all).unwrap_or_else(|e| panic!("{e}"))
}

fn table(device: &Translation) -> Operations {
    let path = crates().join("matcha-shade/src/ops.rs");
    let table = Module {
        path: "crates/matcha-shade/src/ops.rs".to_owned(),
        source: std::fs::read_to_string(path).expect("the table's file reads"),
    };
    operations(&table, &modules("matcha-shade/src/ops"), device).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn device_modules_and_operations_are_valid_wgsl() {
    let device = device();
    let operations = table(&device);
    let mut all = device.source.clone();
    all.append(&operations.source);
    all.append(&Source::written(
        "test.wgsl",
        "fn row(i: u32) -> f32 { return f32(i); }",
    ));
    all.append(&operations.dispatch(&DispatchForm {
        name: "execute",
        parameters: "immediate: u32",
        operand: "row({}u)",
        immediate: "immediate",
    }));
    if let Ok(path) = std::env::var("MATCHA_WGSL_OUT") {
        std::fs::write(path, all.text()).expect("the path is writable");
    }
    let module = check(&all, Capabilities::empty()).unwrap_or_else(|e| panic!("{e}"));
    println!(
        "{} device functions, {} operations, {} lines of WGSL, {} functions in naga",
        device.functions.len(),
        operations.entries.len(),
        all.text().lines().count(),
        module.functions.len()
    );
}
