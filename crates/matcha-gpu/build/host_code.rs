//! Rust for the host out of what kernels are made of: constants of host layers, and access to the
//! structs that they keep in columns, so that neither is written twice.

use crate::memory::section::column_declarations;
use matcha_wgsl::{LayoutField, Module, Translation, Ty};
use std::collections::BTreeSet;
use std::fmt::Write;

/// The host code for some layers.
pub fn host_code(device: &Translation, layers: &[Module]) -> String {
    let mut text = String::new();
    let mut structs = BTreeSet::new();
    let mut sections = String::new();
    for layer in layers {
        constants(&layer.source, &mut text);
        for (_, name, of) in column_declarations(&layer.source) {
            columns(device, &of, &mut structs, &mut text);
            let _ = writeln!(sections, "    ({name:?}, {}),", word_list(&of));
        }
    }
    let _ = writeln!(
        text,
        "/// Sections in columns, and what their words are.\n\
         pub const COLUMNS: &[(&str, &[Word])] = &[\n{sections}];"
    );
    text
}

/// The whole-numbered constants of a layer.
fn constants(source: &str, text: &mut String) {
    for line in source.lines() {
        let constant = line.strip_prefix("const ").and_then(|rest| {
            let (name, value) = rest.strip_suffix("u;")?.split_once(" = ")?;
            Some((name.trim_end_matches(": u32"), value))
        });
        if let Some((name, value)) = constant
            && value.bytes().all(|b| b.is_ascii_alphanumeric())
        {
            let _ = writeln!(
                text,
                "/// `{name}` of the kernels.\npub const {name}: u32 = {value};"
            );
        }
    }
}

fn word_list(of: &str) -> String {
    format!("{}_WORDS", of.to_uppercase())
}

/// Access to a struct and to those inside of it, each once.
fn columns(device: &Translation, of: &str, known: &mut BTreeSet<String>, text: &mut String) {
    let (Some(layout), Some(place)) = (device.layout(of), device.struct_place(of)) else {
        return;
    };
    if !known.insert(of.to_owned()) {
        return;
    }
    for field in &layout.fields {
        if let Ty::Struct(inner) = &field.ty {
            columns(device, inner, known, text);
        }
    }
    let _ = writeln!(
        text,
        "/// The words of a `{of}`.\npub const {}: &[Word] = &[",
        word_list(of)
    );
    layout.fields.iter().for_each(|field| words(field, text));
    text.push_str("];\n");
    let direct: Vec<&str> = layout
        .fields
        .iter()
        .map(|field| field.path.as_str())
        .filter(|path| !path.contains(['.', '[']))
        .collect();
    let loads: Vec<String> = direct
        .iter()
        .map(|f| format!("{f}: Column::load(next)"))
        .collect();
    let stores: Vec<String> = direct
        .iter()
        .map(|f| format!("self.{f}.store(put);"))
        .collect();
    let _ = writeln!(
        text,
        "impl Column for {} {{\n\
         fn load(next: &mut dyn FnMut() -> u32) -> Self {{ Self {{ {} }} }}\n\
         fn store(&self, put: &mut dyn FnMut(u32)) {{ {} }}\n}}",
        rust_path(&place.path, of),
        loads.join(", "),
        stores.join(" ")
    );
}

/// A field's words, if it has no fields or elements of its own.
fn words(field: &LayoutField, text: &mut String) {
    let (parts, float): (&[&str], bool) = match &field.ty {
        Ty::F32 => (&[""], true),
        Ty::U32 | Ty::I32 | Ty::Bool => (&[""], false),
        Ty::Vec2 => (&[".x", ".y"], true),
        Ty::Vec3 => (&[".x", ".y", ".z"], true),
        _ => return,
    };
    for part in parts {
        let path = format!("{}{part}", field.path);
        let _ = writeln!(text, "    Word {{ path: {path:?}, float: {float} }},");
    }
}

/// `crates/matcha-render/src/device/lobe.rs` and `Lobe` make `matcha_render::device::lobe::Lobe`.
fn rust_path(file: &str, name: &str) -> String {
    let file = file.trim_start_matches("crates/").trim_end_matches(".rs");
    let module = file.replacen("/src/", "/", 1).replace('-', "_");
    format!("{}::{name}", module.replace('/', "::"))
}
