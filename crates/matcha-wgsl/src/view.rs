//! Views on buffers, as hosts see them, and the functions that hosts have for them.

use crate::diagnostic::Place;
use crate::types::Ty;

/// A struct with a lifetime: buffers and numbers that device code reads. WGSL has no
/// parameters for it; it calls these functions of the host layer:
///
/// * `word_View_field(i: u32) -> u32`, word `i` of a buffer or of a plain field;
/// * `count_View_field() -> u32`, elements of a buffer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct View {
    /// Its name.
    pub name: String,
    /// Its fields in order.
    pub fields: Vec<ViewField>,
    /// Words of all plain fields together.
    pub header_words: u32,
    /// Where it is defined.
    pub place: Place,
}

/// A field of a view.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ViewField {
    /// Its name.
    pub name: String,
    /// An element's type, or the plain field's.
    pub ty: Ty,
    /// Words from an element to the next, or of the plain field.
    pub words: u32,
    /// Where its words are.
    pub place: FieldPlace,
    /// Its line.
    pub line: usize,
}

/// Where a view's field is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FieldPlace {
    /// In a buffer of its own: `&[T]`.
    Buffer,
    /// Among the view's plain fields.
    Header {
        /// Its first word, if they follow each other in order and without gaps.
        offset: u32,
    },
}

impl View {
    /// A field.
    pub fn field(&self, name: &str) -> Option<&ViewField> {
        self.fields.iter().find(|field| field.name == name)
    }
}

/// What some device functions need of a view's field.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Access {
    /// The view.
    pub view: String,
    /// The field.
    pub field: String,
    /// They call [`Access::word_function`].
    pub words: bool,
    /// They call [`Access::count_function`].
    pub count: bool,
}

impl Access {
    /// The function that gives a word: `fn …(i: u32) -> u32`.
    pub fn word_function(&self) -> String {
        word_function(&self.view, &self.field)
    }

    /// The function that counts elements: `fn …() -> u32`.
    pub fn count_function(&self) -> String {
        count_function(&self.view, &self.field)
    }
}

pub(crate) fn word_function(view: &str, field: &str) -> String {
    format!("word_{view}_{}", plain(field))
}

pub(crate) fn count_function(view: &str, field: &str) -> String {
    format!("count_{view}_{}", plain(field))
}

/// The translator's function that reads a value of several words.
pub(crate) fn read_function(view: &str, field: &str, ty: &Ty) -> String {
    format!("read_{view}_{}_{}", plain(field), type_name(ty))
}

/// A type's name as a part of names.
pub(crate) fn type_name(ty: &Ty) -> String {
    match ty {
        Ty::Array(of, length) => format!("{}x{length}", type_name(of)),
        _ => ty.rust(),
    }
}

fn plain(field: &str) -> &str {
    field.strip_prefix("r#").unwrap_or(field)
}
