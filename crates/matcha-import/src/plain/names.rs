//! Interned names of UV maps and attributes.

use crate::error::{Checked, Fault};
use std::collections::HashMap;

#[derive(Default)]
pub(crate) struct Names {
    list: Vec<String>,
    index: HashMap<String, u16>,
}

impl Names {
    /// With the empty name as entry 0, which for UV maps means the active one.
    pub fn with_empty() -> Self {
        Self {
            list: vec![String::new()],
            index: HashMap::from([(String::new(), 0)]),
        }
    }

    pub fn intern(&mut self, name: &str) -> Checked<u16> {
        if let Some(&index) = self.index.get(name) {
            return Ok(index);
        }
        let index = u16::try_from(self.list.len()).map_err(|_| {
            Fault::new(
                "meshes",
                "more than 65,536 different names of UV maps or attributes",
            )
        })?;
        self.list.push(name.to_owned());
        self.index.insert(name.to_owned(), index);
        Ok(index)
    }

    pub fn into_list(self) -> Vec<String> {
        self.list
    }
}
