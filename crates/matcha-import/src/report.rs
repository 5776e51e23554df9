//! What a scene asked for and did not get, once per kind.

use crate::error::ImportError;
use std::collections::HashMap;
use std::fmt;
use std::path::Path;

/// What kind of thing was not taken as the file has it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum ReportKind {
    /// A node type, by its `bl_idname`.
    Node(String),
    /// A property or mode of a node type: type and property.
    NodeProperty(String, String),
    /// A glTF extension, or a part of one.
    Extension(String),
    /// A feature of the file, in words.
    Feature(String),
    /// An image that could not be read, by name.
    Image(String),
    /// Something worth knowing that takes nothing away from what the author asked for.
    Note(String),
}

impl ReportKind {
    /// True where nothing that the author asked for was lost: strict mode lets it pass.
    pub fn is_note(&self) -> bool {
        matches!(self, Self::Note(_))
    }
}

impl fmt::Display for ReportKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Node(kind) => write!(f, "node type {kind} is not supported"),
            Self::NodeProperty(kind, property) => {
                write!(f, "{property} of node type {kind} is not supported")
            }
            Self::Extension(name) => write!(f, "extension {name} is not supported"),
            Self::Feature(what) | Self::Note(what) => write!(f, "{what}"),
            Self::Image(name) => write!(f, "image \"{name}\" cannot be read"),
        }
    }
}

/// One kind, with the first place where it occurred.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReportItem {
    /// The kind; unique in a report.
    pub kind: ReportKind,
    /// Where it occurred first: material and node, mesh, or file part.
    pub subject: String,
    /// What is rendered in its place; empty where the kind says so itself.
    pub substitute: String,
    /// How often it occurred.
    pub count: u64,
}

impl fmt::Display for ReportItem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.kind)?;
        match (self.subject.is_empty(), self.count) {
            (true, 0 | 1) => {}
            (true, n) => write!(f, " ({n} times)")?,
            (false, 0 | 1) => write!(f, " ({})", self.subject)?,
            (false, n) => write!(f, " (first: {}; {n} times)", self.subject)?,
        }
        if self.substitute.is_empty() {
            return Ok(());
        }
        write!(f, ": {}", self.substitute)
    }
}

/// Everything that was substituted.
#[derive(Clone, Debug, Default)]
pub struct Report {
    items: Vec<ReportItem>,
    index: HashMap<ReportKind, usize>,
}

impl Report {
    /// Notes one occurrence; subject and substitute of a kind's first one are kept.
    pub fn add(&mut self, kind: ReportKind, subject: &str, substitute: &str) {
        self.add_many(kind, subject, substitute, 1);
    }

    /// Notes `count` occurrences at once; none is no item.
    pub fn add_many(&mut self, kind: ReportKind, subject: &str, substitute: &str, count: u64) {
        if count == 0 {
            return;
        }
        if let Some(&known) = self.index.get(&kind) {
            self.items[known].count += count;
            return;
        }
        self.index.insert(kind.clone(), self.items.len());
        let (subject, substitute) = (subject.to_owned(), substitute.to_owned());
        self.items.push(ReportItem {
            kind,
            subject,
            substitute,
            count,
        });
    }

    /// Items in the order in which their kinds first occurred.
    pub fn items(&self) -> &[ReportItem] {
        &self.items
    }

    /// Takes over another report's items.
    pub fn append(&mut self, other: Report) {
        for item in other.items {
            self.add_many(item.kind, &item.subject, &item.substitute, item.count);
        }
    }

    /// In strict mode, an error if anything that the author of `file` asked for was substituted.
    pub(crate) fn check(&self, strict: bool, file: &Path) -> Result<(), ImportError> {
        let mut lost = Report::default();
        for item in self.items.iter().filter(|item| !item.kind.is_note()) {
            lost.add_many(
                item.kind.clone(),
                &item.subject,
                &item.substitute,
                item.count,
            );
        }
        if strict && !lost.items.is_empty() {
            let file = file.to_owned();
            return Err(ImportError::Strict { file, lost });
        }
        Ok(())
    }

    /// All items in one line.
    pub(crate) fn in_a_sentence(&self) -> String {
        let items: Vec<String> = self.items.iter().map(ToString::to_string).collect();
        items.join("; ")
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, item) in self.items.iter().enumerate() {
            if i > 0 {
                writeln!(f)?;
            }
            write!(f, "{item}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kind_is_listed_once_with_its_first_place() {
        let mut report = Report::default();
        let kind = || ReportKind::Node("ShaderNodeBsdfHair".into());
        report.add(
            kind(),
            "material \"Fur\", node \"Hair\"",
            "rendered as diffuse",
        );
        report.add(kind(), "material \"Wig\", node \"Hair\"", "something else");
        assert_eq!(
            report.to_string(),
            "node type ShaderNodeBsdfHair is not supported (first: material \"Fur\", node \"Hair\"; 2 times): \
             rendered as diffuse"
        );
        assert!(report.check(false, Path::new("a")).is_ok());
        assert!(report.check(true, Path::new("a")).is_err());
    }

    #[test]
    fn a_kind_that_names_its_substitute_stands_alone() {
        let mut report = Report::default();
        report.add(
            ReportKind::Feature("motion blur is left out".into()),
            "",
            "",
        );
        assert_eq!(report.to_string(), "motion blur is left out");
    }

    #[test]
    fn notes_pass_in_strict_mode() {
        let mut report = Report::default();
        report.add(ReportKind::Note("no camera".into()), "", "one was made");
        assert!(report.check(true, Path::new("a")).is_ok());
        report.add(ReportKind::Image("a".into()), "", "pink");
        let Err(ImportError::Strict { lost, .. }) = report.check(true, Path::new("a")) else {
            panic!("must be refused")
        };
        assert_eq!(lost.items().len(), 1);
    }
}
