//! Values of a struct in columns: word `w` of all of them, then word `w + 1` of all of them.
//! Neighbouring invocations then read neighbouring words.

use crate::assemble::{Assembler, Memory};
use crate::diagnostic::Place;
use crate::layout::{Layout, words};
use crate::names::escaped;
use crate::source::Source;
use crate::translation::Translation;
use crate::types::Ty;
use std::collections::BTreeMap;

/// Access to a struct's values in columns.
#[derive(Clone, Debug)]
pub struct Columns {
    /// For the prefix `p` and the struct `S`: `load_p(i: u32) -> S` and `store_p(i: u32,
    /// value: S)`, and for each field `f` of type `F`, `load_p_f(i: u32) -> F` and
    /// `store_p_f(i: u32, value: F)`.
    ///
    /// They call two functions of the host layer: `p_get(word: u32, i: u32) -> u32` and
    /// `p_set(word: u32, i: u32, value: u32)`. The struct's own definition is not part of it:
    /// name the struct in [`Translation::needed`].
    pub source: Source,
    /// What the words are.
    pub layout: Layout,
}

impl Translation {
    /// Access to values of a device struct in columns; `None` if there is no such struct.
    pub fn columns(&self, name: &str, prefix: &str) -> Option<Columns> {
        let place = self.struct_places.get(name)?;
        let mut assembler = Assembler {
            memory: Memory::Columns {
                name: prefix.to_owned(),
            },
            structs: &self.structs,
            line: place.line,
            functions: BTreeMap::new(),
        };
        let whole = Ty::Struct(name.to_owned());
        let mut lines = functions(&mut assembler, prefix, 0, &whole);
        let mut offset = 0;
        for (field, ty) in self.structs.get(name).into_iter().flatten() {
            let suffixed = format!("{prefix}_{}", plain(field));
            lines.extend(functions(&mut assembler, &suffixed, offset, ty));
            offset += words(&self.structs, ty);
        }
        let mut source = Source::default();
        for function in assembler.functions.values() {
            for (text, _) in &function.lines {
                source.push(text, place.clone());
            }
        }
        lines
            .iter()
            .for_each(|text| source.push(text, place.clone()));
        let layout = Layout::of(&self.structs, name);
        Some(Columns { source, layout })
    }

    /// A struct's words.
    pub fn layout(&self, name: &str) -> Option<Layout> {
        self.structs.get(name)?;
        Some(Layout::of(&self.structs, name))
    }

    /// Where a struct is defined.
    pub fn struct_place(&self, name: &str) -> Option<&Place> {
        self.struct_places.get(name)
    }
}

/// `load_` and `store_` of what begins at a word.
fn functions(assembler: &mut Assembler, name: &str, offset: u32, ty: &Ty) -> Vec<String> {
    let address = format!("{offset}u");
    let read = assembler.read(ty, &address);
    let ty_name = ty.wgsl();
    let mut lines = vec![
        format!("fn load_{name}(i: u32) -> {ty_name} {{ return {read}; }}"),
        format!("fn store_{name}(i: u32, value: {ty_name}) {{"),
    ];
    for text in assembler.write(ty, &address, "value") {
        lines.push(format!("    {text}"));
    }
    lines.push("}".to_owned());
    lines
}

fn plain(field: &str) -> String {
    escaped(field.strip_prefix("r#").unwrap_or(field))
}
