//! Where values lie as words of 32 bits: in the order of their fields, without gaps, as
//! `#[repr(C)]` puts them.

use crate::types::Ty;
use std::collections::HashMap;

/// Fields of structs by name.
pub(crate) type Structs = HashMap<String, Vec<(String, Ty)>>;

/// Words of a value.
pub(crate) fn words(structs: &Structs, ty: &Ty) -> u32 {
    match ty {
        Ty::Vec2 => 2,
        Ty::Vec3 => 3,
        Ty::Array(of, length) => words(structs, of) * *length as u32,
        Ty::Struct(name) => {
            let fields = structs.get(name).into_iter().flatten();
            fields.map(|(_, ty)| words(structs, ty)).sum()
        }
        _ => 1,
    }
}

/// The word at which a struct's or vector's field begins.
pub(crate) fn field_offset(structs: &Structs, of: &Ty, field: &str) -> u32 {
    match of {
        Ty::Struct(name) => {
            let fields = structs.get(name).into_iter().flatten();
            let before = fields.take_while(|(name, _)| name != field);
            before.map(|(_, ty)| words(structs, ty)).sum()
        }
        _ => match field {
            "y" => 1,
            "z" => 2,
            _ => 0,
        },
    }
}

/// Why a type has no place in buffers.
pub(crate) enum Unstorable {
    /// A bool, of which Rust has one byte.
    Bool,
    /// A struct within itself.
    Cycle(String),
}

/// Refuses what is not all words, inside of the structs `open`.
pub(crate) fn storable(
    structs: &Structs,
    ty: &Ty,
    open: &mut Vec<String>,
) -> Result<(), Unstorable> {
    match ty {
        Ty::Bool => Err(Unstorable::Bool),
        Ty::Array(of, _) => storable(structs, of, open),
        Ty::Struct(name) if open.contains(name) => Err(Unstorable::Cycle(name.clone())),
        Ty::Struct(name) => {
            open.push(name.clone());
            for (_, ty) in structs.get(name).into_iter().flatten() {
                storable(structs, ty, open)?;
            }
            open.pop();
            Ok(())
        }
        _ => Ok(()),
    }
}

/// A part of a struct.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LayoutField {
    /// How device code names it: `at`, `lobes[2]`, `lobes[2].weight`.
    pub path: String,
    /// Its first word.
    pub offset: u32,
    /// Its words.
    pub words: u32,
    /// Its type.
    pub ty: Ty,
}

/// A struct as words. A bool is a word, 0 or 1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layout {
    /// Words of the whole.
    pub words: u32,
    /// Its fields, each before its own fields and elements.
    pub fields: Vec<LayoutField>,
}

impl Layout {
    pub(crate) fn of(structs: &Structs, name: &str) -> Layout {
        let ty = Ty::Struct(name.to_owned());
        let mut fields = Vec::new();
        parts(structs, &ty, "", 0, &mut fields);
        let words = words(structs, &ty);
        Layout { words, fields }
    }

    /// The first word of the field with this path.
    pub fn offset(&self, path: &str) -> Option<u32> {
        let field = self.fields.iter().find(|field| field.path == path)?;
        Some(field.offset)
    }
}

/// Lists the fields or elements of a value that begins at the word `offset`.
fn parts(structs: &Structs, of: &Ty, path: &str, mut offset: u32, list: &mut Vec<LayoutField>) {
    let named: Vec<(String, Ty)> = match of {
        Ty::Struct(name) => {
            let fields = structs.get(name).into_iter().flatten();
            let dot = if path.is_empty() { "" } else { "." };
            let named = |(field, ty): &(String, Ty)| (format!("{path}{dot}{field}"), ty.clone());
            fields.map(named).collect()
        }
        Ty::Array(of, length) => (0..*length)
            .map(|k| (format!("{path}[{k}]"), (**of).clone()))
            .collect(),
        _ => Vec::new(),
    };
    for (path, ty) in named {
        let words = words(structs, &ty);
        list.push(LayoutField {
            path: path.clone(),
            offset,
            words,
            ty: ty.clone(),
        });
        parts(structs, &ty, &path, offset, list);
        offset += words;
    }
}
