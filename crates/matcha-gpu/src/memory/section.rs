//! Sections: named arrays in the device's memory, as shaders declare them. The build
//! script reads this file, too.

use std::fmt;

/// What kernels may do with a section, and what its elements are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// Words that kernels only read.
    Read,
    /// Quads of words (16 bytes) that kernels only read.
    Read4,
    /// Words.
    Write,
    /// Quads of words (16 bytes).
    Write4,
    /// Words for atomic operations.
    Atomic,
    /// 64-bit numbers for atomic operations.
    Atomic64,
    /// A few words that are the same for the whole dispatch, in the header.
    Plain,
}

/// All classes that have buffers, in the order of their bindings.
pub const STORED: [Class; 6] = [
    Class::Read,
    Class::Read4,
    Class::Write,
    Class::Write4,
    Class::Atomic,
    Class::Atomic64,
];

impl Class {
    /// Its name in declarations and in WGSL.
    pub fn name(self) -> &'static str {
        match self {
            Class::Read => "read",
            Class::Read4 => "read4",
            Class::Write => "write",
            Class::Write4 => "write4",
            Class::Atomic => "atomic",
            Class::Atomic64 => "atomic64",
            Class::Plain => "plain",
        }
    }

    /// Words of an element.
    pub fn words(self) -> u64 {
        match self {
            Class::Read4 | Class::Write4 => 4,
            Class::Atomic64 => 2,
            Class::Read | Class::Write | Class::Atomic | Class::Plain => 1,
        }
    }

    /// True if kernels never write it.
    pub fn read_only(self) -> bool {
        matches!(self, Class::Read | Class::Read4 | Class::Plain)
    }

    /// The element's type in WGSL.
    pub fn wgsl(self) -> &'static str {
        match self {
            Class::Read | Class::Write | Class::Plain => "u32",
            Class::Read4 | Class::Write4 => "vec4u",
            Class::Atomic => "atomic<u32>",
            Class::Atomic64 => "atomic<u64>",
        }
    }

    fn named(name: &str) -> Option<Class> {
        let all = STORED.into_iter().chain([Class::Plain]);
        all.into_iter().find(|class| class.name() == name)
    }
}

/// A section as a shader declares it: `//@ read4 bvh_nodes 5`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Declaration {
    /// Its name.
    pub name: String,
    /// Its class.
    pub class: Class,
    /// Elements of the class that `count_NAME` counts as one (for plain sections: how many
    /// words there are).
    pub stride: u32,
}

/// What is wrong with a declaration.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BadDeclaration {
    /// Line, from 1.
    pub line: usize,
    /// The line.
    pub text: String,
}

impl fmt::Display for BadDeclaration {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(
            f,
            "line {}: `{}` declares no section: it is //@ read|read4|write|write4|atomic|atomic64|plain NAME [STRIDE], //@ columns NAME STRUCT, //@ structure NAME or //@ constant NAME VALUE",
            self.line, self.text
        )
    }
}

/// The device structs that a WGSL file keeps in columns, in lines `//@ columns NAME STRUCT`:
/// line, name and struct. The build script makes a `write` section of each, with the struct's
/// words as its stride, and `load_NAME(i)`, `store_NAME(i, value)`, `load_NAME_field(i)`, ….
pub fn column_declarations(source: &str) -> Vec<(usize, String, String)> {
    let mut all = Vec::new();
    for (i, text) in source.lines().enumerate() {
        let words: Vec<&str> = text.split_whitespace().collect();
        if let ["//@", "columns", name, of] = words.as_slice() {
            all.push((i + 1, (*name).to_owned(), (*of).to_owned()));
        }
    }
    all
}

/// The acceleration structures that a WGSL file sends rays through, in lines
/// `//@ structure NAME`: bindings of their own, called by their names.
pub fn structures(source: &str) -> Vec<String> {
    let mut all = Vec::new();
    for text in source.lines() {
        let words: Vec<&str> = text.split_whitespace().collect();
        if let ["//@", "structure", name] = words.as_slice() {
            all.push((*name).to_owned());
        }
    }
    all
}

/// The whole-numbered constants that a WGSL file leaves to the host, in lines
/// `//@ constant NAME VALUE`; the value holds where the host gives none.
pub fn constants(source: &str) -> Vec<(String, u32)> {
    let mut all = Vec::new();
    for text in source.lines() {
        let words: Vec<&str> = text.split_whitespace().collect();
        if let ["//@", "constant", name, value] = words.as_slice()
            && let Ok(value) = value.parse()
        {
            all.push(((*name).to_owned(), value));
        }
    }
    all
}

/// Constants in WGSL.
pub fn constants_text(constants: &[(String, u32)]) -> String {
    let one = |(name, value): &(String, u32)| format!("const {name}: u32 = {value}u;\n");
    constants.iter().map(one).collect()
}

/// The sections that a WGSL file declares, in lines that begin with `//@`, but for columns and
/// structures.
pub fn declarations(source: &str) -> Result<Vec<Declaration>, BadDeclaration> {
    let mut all = Vec::new();
    for (i, text) in source.lines().enumerate() {
        let Some(words) = text.trim_start().strip_prefix("//@") else {
            continue;
        };
        if matches!(
            words.split_whitespace().next(),
            Some("columns" | "constant" | "structure")
        ) {
            continue;
        }
        let declaration = declaration(words).ok_or_else(|| BadDeclaration {
            line: i + 1,
            text: text.trim().to_owned(),
        })?;
        all.push(declaration);
    }
    Ok(all)
}

fn declaration(words: &str) -> Option<Declaration> {
    let mut words = words.split_whitespace();
    let class = Class::named(words.next()?)?;
    let name = words.next()?;
    let stride = match words.next() {
        Some(number) => number.parse().ok().filter(|&stride| stride > 0)?,
        None => 1,
    };
    let is_name = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    (is_name && words.next().is_none()).then(|| Declaration {
        name: name.to_owned(),
        class,
        stride,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn declarations_are_read() {
        let found = declarations("fn a() {}\n//@ read4 bvh_nodes 5\n  //@ plain sun_count\n");
        let expected = [
            ("bvh_nodes", Class::Read4, 5),
            ("sun_count", Class::Plain, 1),
        ];
        let expected = expected.map(|(name, class, stride)| Declaration {
            name: name.to_owned(),
            class,
            stride,
        });
        assert_eq!(found, Ok(expected.to_vec()));
    }

    #[test]
    fn a_wrong_declaration_names_its_line() {
        for wrong in [
            "//@ reed a",
            "//@ read",
            "//@ read a 0",
            "//@ read a 1 2",
            "//@ read a-b",
        ] {
            let error = declarations(&format!("\n{wrong}\n")).expect_err(wrong);
            assert_eq!((error.line, error.text.as_str()), (2, wrong));
        }
    }
}
