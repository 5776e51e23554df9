//! Views and references in the faces of items.

use super::Scope;
use crate::diagnostic::{Fault, Place, Problem, outside};
use crate::layout::{Unstorable, storable, words};
use crate::types::Ty;
use crate::view::{FieldPlace, View, ViewField};
use syn::spanned::Spanned;

/// True for a struct with a lifetime.
pub(super) fn is_view(item: &syn::ItemStruct) -> bool {
    item.generics.lifetimes().count() > 0
}

impl Scope {
    /// A view's fields; whether they can be stored is seen when all structs are known.
    pub(super) fn view(&self, item: &syn::ItemStruct, path: &str) -> Result<View, Fault> {
        let line = item.ident.span().start().line;
        if item.generics.params.len() > 1 {
            return Err(outside(
                line,
                "a view with more than a lifetime",
                "one lifetime is enough",
            ));
        }
        let syn::Fields::Named(fields) = &item.fields else {
            return Err(outside(
                line,
                "a struct without field names",
                "name its fields",
            ));
        };
        let fields: Result<Vec<ViewField>, Fault> =
            fields.named.iter().map(|f| self.view_field(f)).collect();
        Ok(View {
            name: item.ident.to_string(),
            fields: fields?,
            header_words: 0,
            place: Place {
                path: path.to_owned(),
                line,
            },
        })
    }

    fn view_field(&self, field: &syn::Field) -> Result<ViewField, Fault> {
        let line = field.ty.span().start().line;
        let (ty, place) = match &field.ty {
            syn::Type::Reference(reference) => match &*reference.elem {
                syn::Type::Slice(slice) if reference.mutability.is_none() => {
                    (self.ty(&slice.elem)?, FieldPlace::Buffer)
                }
                _ => {
                    return Err(outside(
                        line,
                        "this field of a view",
                        "use `&'a [T]`, or a plain value",
                    ));
                }
            },
            plain => (self.ty(plain)?, FieldPlace::Header { offset: 0 }),
        };
        let name = field.ident.as_ref().map(ToString::to_string);
        Ok(ViewField {
            name: name.unwrap_or_default(),
            ty,
            words: 0,
            place,
            line,
        })
    }

    /// Lays a view's fields out as words, all structs being known.
    pub(super) fn lay_out(&self, view: &View) -> Result<View, Fault> {
        let mut view = view.clone();
        for field in &mut view.fields {
            storable(&self.structs, &field.ty, &mut Vec::new()).map_err(|why| match why {
                Unstorable::Bool => {
                    outside(field.line, "a bool in a view", "a word is a u32: 0 or 1")
                }
                Unstorable::Cycle(name) => (field.line, Problem::Cycle(name)),
            })?;
            field.words = words(&self.structs, &field.ty);
            if let FieldPlace::Header { offset } = &mut field.place {
                *offset = view.header_words;
                view.header_words += field.words;
            }
        }
        Ok(view)
    }

    /// A parameter's type: a value, a view or a reference.
    pub(super) fn parameter(&self, ty: &syn::Type) -> Result<Ty, Fault> {
        let line = ty.span().start().line;
        match ty {
            syn::Type::Path(_) => match self.view_name(ty) {
                Some(name) => Ok(Ty::View(name)),
                None => self.ty(ty),
            },
            syn::Type::Reference(reference) => {
                if self.view_name(&reference.elem).is_some() {
                    return Err(outside(line, "a reference to a view", "pass it by value"));
                }
                Ok(Ty::Reference {
                    of: Box::new(self.ty(&reference.elem)?),
                    mutable: reference.mutability.is_some(),
                })
            }
            _ => self.ty(ty),
        }
    }

    /// The view that a type names, with or without its lifetime.
    pub(super) fn view_name(&self, ty: &syn::Type) -> Option<String> {
        let syn::Type::Path(path) = ty else {
            return None;
        };
        let name = path.path.segments.last()?.ident.to_string();
        self.views.contains_key(&name).then_some(name)
    }
}
