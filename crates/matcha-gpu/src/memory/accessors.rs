//! WGSL functions that reach into sections. The build script reads this file, too.
//!
//! | class | functions of a section `X` |
//! | --- | --- |
//! | all | `count_X()` |
//! | `read` | `word_X(i)` |
//! | `read4` | `quad_X(i) -> vec4u` |
//! | `write` | `word_X(i)`, `put_X(i, word)` |
//! | `write4` | `quad_X(i)`, `put_X(i, quad)` |
//! | `atomic` | `word_X(i)`, `put_X(i, word)`, and with the value before: `add_X`, `or_X`, `and_X`, `min_X`, `max_X`, `swap_X(i, word) -> u32`; `compare_X(i, expected, new) -> Exchanged` |
//! | `atomic64` | `long_X(i) -> u64`, `put_X`, `compare_X(i, expected, new) -> Exchanged64` |
//! | `plain` | `word_X(i)` |
//!
//! `i` counts elements of the class: words, quads, 64-bit numbers. Offsets and counts come
//! from the group's header, so that the text depends on a scene only where a section needs
//! more than one binding.

use super::placement::{Placed, Placement};
use super::section::Class;
use std::fmt::Write;

/// What `compare_X` of an `atomic` section gives.
const EXCHANGED: &str = "\
/// Outcome of a compare-and-exchange: the value before, and whether the new one is there.
struct Exchanged { old: u32, exchanged: bool }
";

/// What `compare_X` of an `atomic64` section gives.
const EXCHANGED_64: &str = "\
/// Outcome of a compare-and-exchange of 64 bits: the value before, and whether the new one is there.
struct Exchanged64 { old: u64, exchanged: bool }
";

/// Types that accessors of all groups share.
pub fn shared_types(atomics_64: bool) -> String {
    let more = if atomics_64 { EXCHANGED_64 } else { "" };
    format!("{EXCHANGED}{more}")
}

/// The binding of an acceleration structure.
pub fn structure(name: &str, group: u32, binding: usize) -> String {
    format!("@group({group}) @binding({binding}) var {name}: acceleration_structure;\n")
}

/// The bindings of group `group` and all accessors of its sections.
pub fn accessors(placement: &Placement, group: u32) -> String {
    let mut text = String::new();
    let quads = placement.header_words / 4;
    let _ = writeln!(
        text,
        "@group({group}) @binding(0) var<uniform> header_{group}: array<vec4u, {quads}>;"
    );
    for (index, arena) in placement.arenas.iter().enumerate() {
        let access = if arena.class.read_only() {
            "read"
        } else {
            "read_write"
        };
        let name = arena_name(placement, index, group);
        let _ = writeln!(
            text,
            "@group({group}) @binding({}) var<storage, {access}> {name}: array<{}>;",
            index + 1,
            arena.class.wgsl()
        );
    }
    for section in &placement.sections {
        let accessors = Accessors {
            placement,
            section,
            group,
        };
        accessors.write(&mut text);
    }
    text
}

fn arena_name(placement: &Placement, index: usize, group: u32) -> String {
    let arena = &placement.arenas[index];
    format!("{}_{group}_{}", arena.class.name(), arena.number)
}

/// Writes the functions of one section.
struct Accessors<'p> {
    placement: &'p Placement,
    section: &'p Placed,
    group: u32,
}

impl Accessors<'_> {
    fn write(&self, text: &mut String) {
        let name = &self.section.declaration.name;
        let count = self.header(self.section.slot + 1);
        let _ = writeln!(text, "fn count_{name}() -> u32 {{ return {count}; }}");
        match self.section.declaration.class {
            Class::Plain => {
                let at = self.section.offset;
                let group = self.group;
                let _ = writeln!(
                    text,
                    "fn word_{name}(i: u32) -> u32 {{ let at = {at}u + i; return header_{group}[at >> 2u][at & 3u]; }}"
                );
            }
            Class::Read => self.function(text, "word", "", "u32", "return {};"),
            Class::Read4 => self.function(text, "quad", "", "vec4u", "return {};"),
            Class::Write => {
                self.function(text, "word", "", "u32", "return {};");
                self.function(text, "put", ", value: u32", "", "{} = value; return;");
            }
            Class::Write4 => {
                self.function(text, "quad", "", "vec4u", "return {};");
                self.function(text, "put", ", value: vec4u", "", "{} = value; return;");
            }
            Class::Atomic => self.atomic(text, "word", "u32", "Exchanged"),
            Class::Atomic64 => self.atomic(text, "long", "u64", "Exchanged64"),
        }
    }

    fn atomic(&self, text: &mut String, load: &str, ty: &str, exchanged: &str) {
        let value = format!(", value: {ty}");
        self.function(text, load, "", ty, "return atomicLoad(&{});");
        self.function(text, "put", &value, "", "atomicStore(&{}, value); return;");
        let operations: &[(&str, &str)] = &[
            ("add", "Add"),
            ("or", "Or"),
            ("and", "And"),
            ("min", "Min"),
            ("max", "Max"),
            ("swap", "Exchange"),
        ];
        for (name, operation) in operations {
            let body = format!("return atomic{operation}(&{{}}, value);");
            self.function(text, name, &value, ty, &body);
        }
        let body = format!(
            "let r = atomicCompareExchangeWeak(&{{}}, expected, value); return {exchanged}(r.old_value, r.exchanged);"
        );
        let parameters = format!(", expected: {ty}, value: {ty}");
        self.function(text, "compare", &parameters, exchanged, &body);
    }

    /// A function whose body has `{}` where the element stands.
    fn function(&self, text: &mut String, prefix: &str, parameters: &str, ty: &str, body: &str) {
        let name = &self.section.declaration.name;
        let result = if ty.is_empty() {
            String::new()
        } else {
            format!(" -> {ty}")
        };
        let _ = write!(text, "fn {prefix}_{name}(i: u32{parameters}){result} {{");
        let capacity = self
            .placement
            .binding_length(self.section.declaration.class);
        let last = self.section.arenas - 1;
        for k in 0..=last {
            let arena = arena_name(self.placement, self.section.arena + k, self.group);
            let element = if last == 0 {
                format!("{arena}[{} + i]", self.header(self.section.slot))
            } else {
                format!("{arena}[i - {}u]", k as u64 * capacity)
            };
            let body = body.replace("{}", &element);
            if k == last {
                // A `return;` at the end of a function is of no use.
                let _ = write!(text, " {}", body.trim_end_matches(" return;"));
            } else {
                let _ = write!(text, " if i < {}u {{ {body} }}", (k as u64 + 1) * capacity);
            }
        }
        let _ = writeln!(text, " }}");
    }

    /// A word of the header.
    fn header(&self, word: u32) -> String {
        let component = ["x", "y", "z", "w"][word as usize % 4];
        format!("header_{}[{}].{component}", self.group, word / 4)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::memory::placement::PlacementLimits;
    use crate::memory::section::declarations;

    fn placement(binding_bytes: u64) -> Placement {
        let source = "//@ read a\n//@ read4 b 2\n//@ write c\n//@ write4 d\n//@ atomic e\n//@ atomic64 f\n//@ plain g 5";
        let limits = PlacementLimits {
            binding_bytes,
            storage_buffers: 64,
            uniform_bytes: 65536,
        };
        let declared = declarations(source).expect("they are declarations");
        let sections: Vec<_> = declared.into_iter().map(|d| (d, 1000)).collect();
        Placement::new(&sections, &limits).expect("they fit")
    }

    #[test]
    fn accessors_are_valid_wgsl_with_one_binding_or_several() {
        for binding_bytes in [1 << 20, 2048] {
            let text = format!(
                "{}{}",
                shared_types(true),
                accessors(&placement(binding_bytes), 1)
            );
            let module = wgpu::naga::front::wgsl::parse_str(&text);
            let module = module.unwrap_or_else(|e| panic!("{}", e.emit_to_string(&text)));
            let flags = wgpu::naga::valid::ValidationFlags::all();
            let capabilities = wgpu::naga::valid::Capabilities::all();
            wgpu::naga::valid::Validator::new(flags, capabilities)
                .validate(&module)
                .unwrap_or_else(|e| panic!("{}", e.emit_to_string(&text)));
        }
    }

    #[test]
    fn a_section_in_several_bindings_is_found_by_comparing() {
        let placement = placement(2048);
        let text = accessors(&placement, 0);
        let word = text.lines().find(|line| line.starts_with("fn word_c"));
        assert_eq!(
            word,
            Some(
                "fn word_c(i: u32) -> u32 { if i < 512u { return write_0_0[i - 0u]; } return write_0_1[i - 512u]; }"
            )
        );
    }
}
