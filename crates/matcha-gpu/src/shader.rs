//! WGSL put together: device code translated from Rust, host layers, accessors. A kernel
//! gets only the items that it needs.

pub mod items;
pub mod prelude;

use crate::memory::Memory;
use crate::memory::section::{Declaration, constants, constants_text, declarations, structures};
use items::{Item, items, workgroup_size};
use prelude::Dialect;
use std::collections::{BTreeMap, BTreeSet};

mod embedded {
    include!(concat!(env!("OUT_DIR"), "/embedded.rs"));
}

/// Why a kernel's text does not come together: mistakes of Matcha's.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LinkError {
    /// Something is declared twice.
    #[error("{file} declares \"{name}\", which is declared already")]
    Twice {
        /// The second file.
        file: String,
        /// The name.
        name: String,
    },
    /// A line that should declare a section.
    #[error("{file}, {message}")]
    Declaration {
        /// The file.
        file: String,
        /// What is wrong.
        message: String,
    },
    /// Nothing is called that.
    #[error("there is no kernel \"{0}\"")]
    NoKernel(String),
    /// No shader declares that section.
    #[error("no shader declares the section \"{0}\"")]
    NoSection(String),
    /// No shader declares that constant.
    #[error("no shader declares the constant \"{0}\"")]
    NoConstant(String),
    /// What a test wants to corrupt.
    #[error("the item \"{item}\" has no text \"{text}\"")]
    NotThere {
        /// The item.
        item: String,
        /// The text.
        text: String,
    },
    /// A section is in none of the memories that a kernel is bound to.
    #[error(
        "the kernel \"{kernel}\" reaches into section \"{section}\", which is in none of its memories"
    )]
    Unbound {
        /// The kernel.
        kernel: String,
        /// The section.
        section: String,
    },
}

/// All WGSL that kernels are made of.
#[derive(Clone, Debug, Default)]
pub struct Library {
    items: BTreeMap<String, Item>,
    sections: BTreeMap<String, Declaration>,
    /// What the accessors of each section may be called.
    accessors: BTreeMap<String, String>,
}

/// A kernel's text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Linked {
    /// The whole module.
    pub text: String,
    /// Invocations of a workgroup.
    pub workgroup: u32,
}

impl Library {
    /// The crate's own for devices that have 64-bit atomic operations or for the others, with
    /// our own walk of rays.
    ///
    /// # Errors
    /// None that the build script would not have found.
    pub fn embedded(atomics_64: bool) -> Result<Library, LinkError> {
        Library::in_dialect(Dialect {
            atomics_64,
            ray_queries: false,
        })
    }

    /// The crate's own: translated device code and the host layers of `src/wgsl` that belong to
    /// a dialect.
    ///
    /// # Errors
    /// None that the build script would not have found.
    pub fn in_dialect(dialect: Dialect) -> Result<Library, LinkError> {
        let mut library = Library::default();
        library.add("prelude", &prelude::text())?;
        library.add(
            "accessors",
            &crate::memory::accessors::shared_types(dialect.atomics_64),
        )?;
        library.add("device code", embedded::DEVICE_CODE)?;
        for (file, text) in embedded::HOST_LAYERS {
            if prelude::belongs(file, dialect) {
                library.add(file, text)?;
            }
        }
        Ok(library)
    }

    /// Adds a file.
    ///
    /// # Errors
    /// If it declares what is declared already.
    pub fn add(&mut self, file: &str, source: &str) -> Result<(), LinkError> {
        let twice = |name: String| LinkError::Twice {
            file: file.to_owned(),
            name,
        };
        let constants = constants_text(&constants(source));
        for item in items(source)
            .into_iter()
            .chain(items(&constants))
            .filter(|item| !item.name.is_empty())
        {
            if let Some(first) = self.items.insert(item.name.clone(), item) {
                return Err(twice(first.name));
            }
        }
        let sections = declarations(source).map_err(|error| LinkError::Declaration {
            file: file.to_owned(),
            message: error.to_string(),
        })?;
        for name in structures(source) {
            self.accessors.insert(name.clone(), name);
        }
        for section in sections {
            for prefix in prelude::ACCESSORS {
                let accessor = format!("{prefix}_{}", section.name);
                self.accessors.insert(accessor, section.name.clone());
            }
            if let Some(first) = self.sections.insert(section.name.clone(), section) {
                return Err(twice(first.name));
            }
        }
        Ok(())
    }

    /// Gives a constant that a file leaves to the host (`//@ constant NAME VALUE`) its value.
    ///
    /// # Errors
    /// If no file declares it.
    pub fn set_constant(&mut self, name: &str, value: u32) -> Result<(), LinkError> {
        let found = self.items.get_mut(name);
        let item = found.ok_or_else(|| LinkError::NoConstant(name.to_owned()))?;
        item.text = constants_text(&[(name.to_owned(), value)]);
        Ok(())
    }

    /// Puts `new` in the place of `old` in an item: for tests that must fail.
    ///
    /// # Errors
    /// If there is no such item, or `old` is not in it.
    #[doc(hidden)]
    pub fn corrupt(&mut self, name: &str, old: &str, new: &str) -> Result<(), LinkError> {
        let found = self.items.get_mut(name);
        let item = found.filter(|item| item.text.contains(old));
        let item = item.ok_or_else(|| LinkError::NotThere {
            item: name.to_owned(),
            text: old.to_owned(),
        })?;
        let text = item.text.replace(old, new);
        *item = items(&text).swap_remove(0);
        Ok(())
    }

    /// The declaration of a section.
    ///
    /// # Errors
    /// If no file has one.
    pub fn section(&self, name: &str) -> Result<&Declaration, LinkError> {
        let found = self.sections.get(name);
        found.ok_or_else(|| LinkError::NoSection(name.to_owned()))
    }

    /// The declarations of all sections, by their names.
    pub fn sections(&self) -> impl Iterator<Item = &Declaration> {
        self.sections.values()
    }

    /// A kernel with everything that it needs.
    ///
    /// # Errors
    /// If there is no such kernel, or a section of it is in none of the memories.
    pub fn link(&self, kernel: &str, memories: &[&Memory]) -> Result<Linked, LinkError> {
        let no_kernel = || LinkError::NoKernel(kernel.to_owned());
        let entry = self.items.get(kernel).ok_or_else(no_kernel)?;
        let mut text = String::new();
        let mut queries = false;
        let mut taken = BTreeSet::from([kernel]);
        let mut open = vec![entry];
        while let Some(item) = open.pop() {
            text.push_str(&item.text);
            text.push('\n');
            queries |= item.uses.iter().any(|name| name == "ray_query");
            for name in &item.uses {
                let bound = || memories.iter().find_map(|memory| memory.item(name));
                let Some(found) = self.items.get(name).or_else(bound) else {
                    match self.accessors.get(name) {
                        None => continue,
                        Some(section) => {
                            return Err(LinkError::Unbound {
                                kernel: kernel.to_owned(),
                                section: section.clone(),
                            });
                        }
                    }
                };
                if taken.insert(&found.name) {
                    open.push(found);
                }
            }
        }
        if queries {
            text.insert_str(0, prelude::RAY_QUERIES);
        }
        Ok(Linked {
            text,
            workgroup: workgroup_size(entry),
        })
    }
}
