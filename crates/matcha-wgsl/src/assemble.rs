//! WGSL that assembles values from words, and takes them apart again.

use crate::emit::Line;
use crate::layout::{Structs, words};
use crate::names::escaped;
use crate::types::Ty;
use crate::view::{read_function, type_name, word_function};
use std::collections::{BTreeMap, BTreeSet};

/// Arrays up to this length are written out; longer ones have a loop.
const UNROLLED: usize = 8;

/// Where words are.
pub(crate) enum Memory {
    /// In a view's field: a host function gives the word at an address.
    Field { view: String, field: String },
    /// In columns: host functions `NAME_get` and `NAME_set` have the word of the `i`-th value.
    Columns { name: String },
}

/// A generated function.
#[derive(Clone, Debug)]
pub(crate) struct Assembly {
    pub uses: BTreeSet<String>,
    pub lines: Vec<Line>,
}

/// Generates functions for types, each once.
pub(crate) struct Assembler<'a> {
    pub memory: Memory,
    pub structs: &'a Structs,
    /// The line that the WGSL is said to come from.
    pub line: usize,
    /// The functions by name.
    pub functions: BTreeMap<String, Assembly>,
}

impl Assembler<'_> {
    /// The expression that reads a value, of a function's `address` and more words.
    pub fn read(&mut self, ty: &Ty, address: &str) -> String {
        let scalar = |word: String| match ty {
            Ty::F32 | Ty::I32 => format!("bitcast<{}>({word})", ty.wgsl()),
            Ty::Bool => format!("({word} != 0u)"),
            _ => word,
        };
        match ty {
            Ty::Vec2 | Ty::Vec3 => {
                let count = words(self.structs, ty);
                let parts: Vec<String> = (0..count)
                    .map(|k| self.read(&Ty::F32, &plus(address, k)))
                    .collect();
                format!("{}({})", ty.wgsl(), parts.join(", "))
            }
            Ty::Struct(_) | Ty::Array(..) => {
                let name = self.reader(ty);
                format!("{name}({})", self.passed(address))
            }
            _ => scalar(self.word(address)),
        }
    }

    /// The statements that write a value.
    pub fn write(&mut self, ty: &Ty, address: &str, value: &str) -> Vec<String> {
        let Memory::Columns { name } = &self.memory else {
            return Vec::new();
        };
        let set = |address: &str, word: String| format!("{name}_set({address}, i, {word});");
        match ty {
            Ty::F32 | Ty::I32 => vec![set(address, format!("bitcast<u32>({value})"))],
            Ty::Bool => vec![set(address, format!("select(0u, 1u, {value})"))],
            Ty::Vec2 | Ty::Vec3 => (0..words(self.structs, ty))
                .zip(["x", "y", "z"])
                .map(|(k, part)| set(&plus(address, k), format!("bitcast<u32>({value}.{part})")))
                .collect(),
            Ty::Struct(_) | Ty::Array(..) => {
                let writer = self.writer(ty);
                vec![format!("{writer}({address}, i, {value});")]
            }
            _ => vec![set(address, value.to_owned())],
        }
    }

    /// The name of the function that reads a type at `address`; it is made if need be.
    pub fn reader(&mut self, ty: &Ty) -> String {
        let name = match &self.memory {
            Memory::Field { view, field } => read_function(view, field, ty),
            Memory::Columns { name } => format!("read_{name}_{}", type_name(ty)),
        };
        if self.functions.contains_key(&name) {
            return name;
        }
        let parameters = match self.memory {
            Memory::Field { .. } => "address: u32",
            Memory::Columns { .. } => "address: u32, i: u32",
        };
        let body = match ty {
            Ty::Array(of, length) if *length > UNROLLED => self.loop_reading(ty, of, *length),
            _ => self.whole_reading(ty),
        };
        let head = format!("fn {name}({parameters}) -> {} {{", ty.wgsl());
        self.add(&name, ty, head, body);
        name
    }

    fn writer(&mut self, ty: &Ty) -> String {
        let Memory::Columns { name } = &self.memory else {
            return String::new();
        };
        let name = format!("write_{name}_{}", type_name(ty));
        if self.functions.contains_key(&name) {
            return name;
        }
        let body = match ty {
            Ty::Array(of, length) if *length > UNROLLED => self.loop_writing(of, *length),
            _ => {
                let mut body = Vec::new();
                for (offset, part, ty) in self.parts(ty) {
                    body.extend(self.write(&ty, &plus("address", offset), &format!("value{part}")));
                }
                body
            }
        };
        let ty_name = ty.wgsl();
        let head = format!("fn {name}(address: u32, i: u32, value: {ty_name}) {{");
        self.add(&name, ty, head, body);
        name
    }

    fn add(&mut self, name: &str, ty: &Ty, head: String, body: Vec<String>) {
        let indented = body.iter().map(|text| format!("    {text}"));
        let lines = [head].into_iter().chain(indented).chain(["}".to_owned()]);
        let lines = lines.map(|text| (text, self.line)).collect();
        let mut uses = BTreeSet::new();
        for (_, _, part) in self
            .parts(ty)
            .iter()
            .chain([&(0, String::new(), ty.clone())])
        {
            match (part, &self.memory) {
                (Ty::Struct(part), _) => drop(uses.insert(part.clone())),
                (_, Memory::Field { view, field }) => drop(uses.insert(word_function(view, field))),
                _ => {}
            }
            if let Memory::Field { view, field } = &self.memory
                && matches!(part, Ty::Struct(_) | Ty::Array(..))
            {
                let reader = read_function(view, field, part);
                if reader != name {
                    uses.insert(reader);
                }
            }
        }
        self.functions
            .insert(name.to_owned(), Assembly { uses, lines });
    }

    /// Offset, text behind the value and type of each direct part.
    fn parts(&self, ty: &Ty) -> Vec<(u32, String, Ty)> {
        let parts: Vec<(String, Ty)> = match ty {
            Ty::Struct(name) => {
                let fields = self.structs.get(name).into_iter().flatten();
                fields
                    .map(|(field, ty)| (format!(".{}", escaped(field)), ty.clone()))
                    .collect()
            }
            Ty::Array(of, length) => (0..*length)
                .map(|k| (format!("[{k}]"), (**of).clone()))
                .collect(),
            _ => {
                let names = [".x", ".y", ".z"].into_iter();
                let names = names.take(words(self.structs, ty) as usize);
                names.map(|name| (name.to_owned(), Ty::F32)).collect()
            }
        };
        let mut offset = 0;
        parts
            .into_iter()
            .map(|(part, ty)| {
                let at = offset;
                offset += words(self.structs, &ty);
                (at, part, ty)
            })
            .collect()
    }

    fn whole_reading(&mut self, ty: &Ty) -> Vec<String> {
        let mut lines = vec![format!("return {}(", ty.wgsl())];
        for (offset, _, part) in self.parts(ty) {
            let read = self.read(&part, &plus("address", offset));
            lines.push(format!("    {read},"));
        }
        lines.push(");".to_owned());
        lines
    }

    fn loop_reading(&mut self, ty: &Ty, of: &Ty, length: usize) -> Vec<String> {
        let stride = words(self.structs, of);
        let read = self.read(of, &format!("address + k * {stride}u"));
        vec![
            format!("var all: {};", ty.wgsl()),
            format!("for (var k = 0u; k < {length}u; k += 1u) {{"),
            format!("    all[k] = {read};"),
            "}".to_owned(),
            "return all;".to_owned(),
        ]
    }

    fn loop_writing(&mut self, of: &Ty, length: usize) -> Vec<String> {
        let stride = words(self.structs, of);
        let writes = self.write(of, &format!("address + k * {stride}u"), "all[k]");
        let head = format!("for (var k = 0u; k < {length}u; k += 1u) {{");
        // Only a variable's element can be chosen at run time.
        let mut lines = vec!["var all = value;".to_owned(), head];
        lines.extend(writes.iter().map(|text| format!("    {text}")));
        lines.push("}".to_owned());
        lines
    }

    fn word(&self, address: &str) -> String {
        match &self.memory {
            Memory::Field { view, field } => format!("{}({address})", word_function(view, field)),
            Memory::Columns { name } => format!("{name}_get({address}, i)"),
        }
    }

    fn passed(&self, address: &str) -> String {
        match self.memory {
            Memory::Field { .. } => address.to_owned(),
            Memory::Columns { .. } => format!("{address}, i"),
        }
    }
}

/// An address and some words.
fn plus(address: &str, words: u32) -> String {
    match (address, words) {
        (_, 0) => address.to_owned(),
        ("0u", _) => format!("{words}u"),
        _ => format!("{address} + {words}u"),
    }
}
