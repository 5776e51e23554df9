//! Translates the workspace's device code into WGSL and has naga validate it together with
//! the host layers, so that a mistake in either is an error of `cargo build` at its line.

use matcha_wgsl::{
    DispatchForm, FieldPlace, Module, Source, Translation, check, operations, translate,
};
use memory::placement::{Placement, PlacementLimits};
use memory::section::{
    Declaration, column_declarations, constants, constants_text, declarations, structures,
};
use naga::valid::Capabilities;
use prelude::Dialect;
use std::error::Error;
use std::fmt::Write;
use std::path::{Path, PathBuf};

// What the crate puts kernels together with at run time.
#[path = "src/memory"]
#[allow(dead_code)]
mod memory {
    pub mod accessors;
    pub mod placement;
    pub mod section;
}
#[path = "build/host_code.rs"]
mod host_code;
#[path = "src/shader/items.rs"]
#[allow(dead_code)]
mod items;
#[path = "src/shader/prelude.rs"]
#[allow(dead_code)]
mod prelude;
#[path = "src/machine/switch.rs"]
mod switch;

/// Folders of device modules, from the folder of crates.
const DEVICE_MODULES: [&str; 3] = [
    "matcha-shade/src/device",
    "matcha-cache/src/device",
    "matcha-render/src/device",
];

/// Capabilities that kernels for devices with 64-bit atomic operations may use.
const ATOMICS_64: Capabilities = Capabilities::SHADER_INT64
    .union(Capabilities::SHADER_INT64_ATOMIC_MIN_MAX)
    .union(Capabilities::SHADER_INT64_ATOMIC_ALL_OPS);

/// Host layers whose constants and columns the host reads and writes, too.
const WAVE_LAYERS: &str = "/wave_";

/// How operations get at an instruction's operands (`src/wgsl/machine.wgsl`).
const MACHINE: DispatchForm = DispatchForm {
    name: "machine",
    parameters: "word: u32",
    arguments: "word",
    operand: "machine_operand(word, {}u)",
    immediate: "machine_immediate(word)",
};

fn main() {
    if let Err(error) = build() {
        // One line each: cargo shows them as errors of this crate.
        for line in error.to_string().lines() {
            println!("cargo::error={line}");
        }
    }
}

fn build() -> Result<(), Box<dyn Error>> {
    let crates = PathBuf::from("..");
    let mut modules = Vec::new();
    for folder in DEVICE_MODULES {
        modules.extend(files(&crates, folder, "rs")?);
    }
    let device = translate(&modules)?;
    let host_layers = files(&crates, "matcha-gpu/src/wgsl", "wgsl")?;
    let table = file(&crates, "matcha-shade/src/ops.rs")?;
    let families = files(&crates, "matcha-shade/src/ops", "rs")?;
    let operations = operations(&table, &families, &device)?;
    let mut code = device.source.clone();
    code.append(&operations.source());
    code.append(&operations.one_by_one(&MACHINE));
    code.append(&Source::written("views", &view_sections(&device)));
    for layer in &host_layers {
        code.append(&columns(&device, layer)?);
    }
    let codes: Vec<u16> = operations.entries.iter().map(|entry| entry.code).collect();
    let mut all = code.clone();
    all.append(&Source::written(
        "the machine's switch",
        &switch::switch(&codes),
    ));
    // Every host layer is in one of the two.
    for has in [false, true] {
        let dialect = Dialect {
            atomics_64: has,
            ray_queries: has,
        };
        validate(&all, &host_layers, dialect)?;
    }
    let waves = host_layers
        .iter()
        .filter(|layer| layer.path.contains(WAVE_LAYERS))
        .cloned();
    let host_code = host_code::host_code(&device, &waves.collect::<Vec<_>>());
    embed(&code, &host_layers, &host_code)
}

/// Declares the fields of all views as sections.
fn view_sections(device: &Translation) -> String {
    let mut text = String::new();
    for view in device.views.values() {
        for field in &view.fields {
            let class = match field.place {
                FieldPlace::Buffer => "read",
                FieldPlace::Header { .. } => "plain",
            };
            let name = field.name.trim_start_matches("r#");
            let _ = writeln!(text, "//@ {class} {}_{name} {}", view.name, field.words);
        }
    }
    text
}

/// Sections and functions for the structs in columns that a host layer declares.
fn columns(device: &Translation, layer: &Module) -> Result<Source, Box<dyn Error>> {
    let mut all = Source::default();
    for (line, name, of) in column_declarations(&layer.source) {
        let Some(columns) = device.columns(&of, &name) else {
            let path = &layer.path;
            return Err(format!("{path}:{line}: there is no device struct `{of}`").into());
        };
        let words = columns.layout.words;
        let access = format!(
            "//@ write {name} {words}\n\
             fn {name}_get(word: u32, i: u32) -> u32 {{ return word_{name}(word * count_{name}() + i); }}\n\
             fn {name}_set(word: u32, i: u32, value: u32) {{ put_{name}(word * count_{name}() + i, value); }}\n"
        );
        all.append(&Source::written("columns", &access));
        all.append(&columns.source);
    }
    Ok(all)
}

/// The files of a folder, named from the workspace's root, in the order of their names.
fn files(crates: &Path, folder: &str, extension: &str) -> Result<Vec<Module>, Box<dyn Error>> {
    let path = crates.join(folder);
    println!("cargo::rerun-if-changed={}", path.display());
    let entries = std::fs::read_dir(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    let mut names = Vec::new();
    for entry in entries {
        let name = entry?.file_name().into_string().unwrap_or_default();
        if Path::new(&name).extension().is_some_and(|e| e == extension) {
            names.push(name);
        }
    }
    names.sort();
    names
        .iter()
        .map(|name| file(crates, &format!("{folder}/{name}")))
        .collect()
}

fn file(crates: &Path, path: &str) -> Result<Module, Box<dyn Error>> {
    let full = crates.join(path);
    println!("cargo::rerun-if-changed={}", full.display());
    let source = std::fs::read_to_string(&full).map_err(|e| format!("{}: {e}", full.display()))?;
    Ok(Module {
        path: format!("crates/{path}"),
        source,
    })
}

/// Has naga look at everything at once, with accessors of all sections that are declared.
fn validate(code: &Source, host_layers: &[Module], dialect: Dialect) -> Result<(), Box<dyn Error>> {
    let mut all = Source::default();
    if dialect.ray_queries {
        all.append(&Source::written("directives", prelude::RAY_QUERIES));
    }
    all.append(code);
    all.append(&Source::written("prelude of kernels", &prelude::text()));
    let types = memory::accessors::shared_types(dialect.atomics_64);
    all.append(&Source::written("accessors", &types));
    let declared = declarations(code.text()).map_err(|e| e.to_string())?;
    let one = |declaration| (declaration, 1);
    let mut sections: Vec<_> = declared.into_iter().map(one).collect();
    for layer in host_layers {
        if !prelude::belongs(&layer.path, dialect) {
            continue;
        }
        all.append(&Source::written(&layer.path, &layer.source));
        let declared = declarations(&layer.source).map_err(|e| format!("{}: {e}", layer.path))?;
        sections.extend(declared.into_iter().map(one));
        for (k, name) in structures(&layer.source).iter().enumerate() {
            // In a group of their own, so that no binding is taken twice.
            let text = memory::accessors::structure(name, 2, k);
            all.append(&Source::written(&layer.path, &text));
        }
        let constants = constants(&layer.source);
        all.append(&Source::written(&layer.path, &constants_text(&constants)));
    }
    // A host layer may define what would be an accessor: where no buffer stands behind it.
    let defined: Vec<String> = host_layers
        .iter()
        .flat_map(|layer| items::items(&layer.source))
        .map(|item| item.name)
        .collect();
    sections.retain(|(section, _): &(Declaration, u64)| {
        !defined.contains(&format!("word_{}", section.name))
    });
    let unlimited = PlacementLimits {
        binding_bytes: u64::from(u32::MAX),
        storage_buffers: u32::MAX,
        uniform_bytes: u64::MAX,
    };
    let placement = Placement::new(&sections, &unlimited)?;
    let accessors = memory::accessors::accessors(&placement, 1);
    all.append(&Source::written("accessors", &accessors));
    let mut capabilities = Capabilities::empty();
    capabilities.set(ATOMICS_64, dialect.atomics_64);
    capabilities.set(Capabilities::RAY_QUERY, dialect.ray_queries);
    check(&all, capabilities)?;
    Ok(())
}

/// Writes what the crate includes.
fn embed(code: &Source, host_layers: &[Module], host_code: &str) -> Result<(), Box<dyn Error>> {
    let out = PathBuf::from(std::env::var("OUT_DIR")?);
    std::fs::write(out.join("host_code.rs"), host_code)?;
    std::fs::write(out.join("device.wgsl"), code.text())?;
    let mut rust = String::from(
        "pub const DEVICE_CODE: &str = include_str!(concat!(env!(\"OUT_DIR\"), \"/device.wgsl\"));\n\
         pub const HOST_LAYERS: &[(&str, &str)] = &[\n",
    );
    let root = std::env::var("CARGO_MANIFEST_DIR")?;
    for layer in host_layers {
        let name = layer.path.rsplit('/').next().unwrap_or_default();
        let path = Path::new(&root).join("src/wgsl").join(name);
        rust += &format!(
            "    ({name:?}, include_str!({:?})),\n",
            path.display().to_string()
        );
    }
    rust += "];\n";
    std::fs::write(out.join("embedded.rs"), rust)?;
    Ok(())
}
