//! Names that WGSL takes for itself.

use naga::keywords::wgsl::{BUILTIN_IDENTIFIERS, RESERVED};
use std::collections::HashSet;
use std::sync::LazyLock;

static TAKEN: LazyLock<HashSet<&str>> = LazyLock::new(|| {
    // The translator's own shorthands of types are predeclared too.
    let aliases = [
        "vec2f", "vec3f", "vec4f", "vec2u", "vec3u", "vec4u", "vec2i", "vec3i", "vec4i",
    ];
    RESERVED
        .iter()
        .chain(BUILTIN_IDENTIFIERS)
        .copied()
        .chain(aliases)
        .collect()
});

/// The name in WGSL of something that Rust names `name`: the same, with an underscore
/// behind it where WGSL keeps the name for itself. So `min` of device code is `min_`, and
/// WGSL written by hand still has its builtin.
pub(crate) fn escaped(name: &str) -> String {
    let name = name.strip_prefix("r#").unwrap_or(name);
    if TAKEN.contains(name) {
        return format!("{name}_");
    }
    if name.starts_with("__") || name == "_" {
        return format!("u{name}");
    }
    name.to_owned()
}

/// Unique names of one function's locals.
#[derive(Default)]
pub(crate) struct LocalNames(HashSet<String>);

impl LocalNames {
    /// A name like `name` that no other local of the function has.
    pub fn fresh(&mut self, name: &str) -> String {
        let base = escaped(name);
        let mut candidate = base.clone();
        let mut number = 1;
        while !self.0.insert(candidate.clone()) {
            candidate = format!("{base}_{number}");
            number += 1;
        }
        candidate
    }
}
