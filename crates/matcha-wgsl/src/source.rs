//! WGSL that knows where its lines come from.

use crate::diagnostic::Place;

/// WGSL, and for each of its lines the place that it was made from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Source {
    text: String,
    origins: Vec<Place>,
}

impl Source {
    /// WGSL written by hand, in the file `path`: its lines are their own origin.
    pub fn written(path: &str, text: &str) -> Source {
        let mut source = Source::default();
        for (i, line) in text.lines().enumerate() {
            let path = path.to_owned();
            source.push(line, Place { path, line: i + 1 });
        }
        source
    }

    /// The text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Adds another source at the end.
    pub fn append(&mut self, other: &Source) {
        self.text.push_str(&other.text);
        self.origins.extend_from_slice(&other.origins);
    }

    /// Where a line, counted from 1, was made from.
    pub fn origin(&self, line: usize) -> Option<&Place> {
        self.origins.get(line.checked_sub(1)?)
    }

    /// Adds a line without line breaks.
    pub(crate) fn push(&mut self, line: &str, origin: Place) {
        debug_assert!(!line.contains('\n'));
        self.text.push_str(line);
        self.text.push('\n');
        self.origins.push(origin);
    }
}
