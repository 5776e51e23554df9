//! Views: their fields' words, read where they are needed and no more of them.

use super::reference::bare;
use super::{Lowering, Read};
use crate::diagnostic::{Fault, Problem, outside};
use crate::ir::{Expr, ExprKind, WordAddress};
use crate::layout::{field_offset, words};
use crate::types::Ty;
use crate::view::{FieldPlace, count_function, read_function, word_function};
use syn::spanned::Spanned;

/// A value in a view's field.
pub(super) struct Stored {
    view: String,
    field: String,
    ty: Ty,
    address: WordAddress,
}

impl Lowering<'_> {
    /// The value in a view that a path of fields and elements names; `None` if the path
    /// does not begin at a view.
    pub(super) fn stored(&mut self, path: &syn::Expr) -> Result<Option<Stored>, Fault> {
        let line = path.span().start().line;
        match bare(path) {
            syn::Expr::Field(it) => {
                let member = super::expression::member_name(&it.member);
                if let Some(view) = self.named_view(&it.base) {
                    return self.plain(line, view, member).map(Some);
                }
                let Some(mut of) = self.stored(&it.base)? else {
                    return Ok(None);
                };
                let ty = self.field_type(line, &of.ty, &member)?;
                of.address.offset += field_offset(&self.scope.structs, &of.ty, &member);
                Ok(Some(Stored { ty, ..of }))
            }
            syn::Expr::Index(it) => {
                let of = match self.buffer(&it.expr)? {
                    Some((view, field, ty)) => Some((buffer_start(view, field), ty)),
                    None => match self.stored(&it.expr)? {
                        Some(of) => Some(self.stored_array(line, of)?),
                        None => None,
                    },
                };
                match of {
                    Some((of, element)) => self.element(of, element, &it.index).map(Some),
                    None => Ok(None),
                }
            }
            _ => Ok(None),
        }
    }

    /// A value in a view as an expression.
    pub(super) fn read(&mut self, line: usize, it: Stored) -> Expr {
        let Stored {
            view,
            field,
            ty,
            address,
        } = it;
        if words(&self.scope.structs, &ty) == 1 && !matches!(ty, Ty::Struct(_) | Ty::Array(..)) {
            self.uses.insert(word_function(&view, &field));
        } else {
            let name = read_function(&view, &field, &ty);
            self.uses.insert(name.clone());
            let (view, field, ty) = (view.clone(), field.clone(), ty.clone());
            self.reads.insert(name, Read { view, field, ty });
        }
        let kind = ExprKind::Stored {
            view,
            field,
            address,
        };
        Expr { line, ty, kind }
    }

    /// `view.field.len()` and `view.field.is_empty()`; `None` for other methods.
    pub(super) fn buffer_method(
        &mut self,
        line: usize,
        it: &syn::ExprMethodCall,
    ) -> Result<Option<Expr>, Fault> {
        let Some((view, field, _)) = self.buffer(&it.receiver)? else {
            return Ok(None);
        };
        let count = Expr {
            line,
            ty: Ty::U32,
            kind: ExprKind::Count {
                view: view.clone(),
                field: field.clone(),
            },
        };
        let method = it.method.to_string();
        if !matches!(method.as_str(), "len" | "is_empty") {
            let what = format!("the method `{method}`");
            return Err(outside(line, what, "a buffer has elements and `len()`"));
        }
        self.uses.insert(count_function(&view, &field));
        if method == "len" {
            return Ok(Some(count));
        }
        let zero = Expr {
            line,
            ty: Ty::U32,
            kind: ExprKind::Integer {
                value: 0,
                hexadecimal: false,
            },
        };
        let kind = ExprKind::Binary("==", Box::new(count), Box::new(zero));
        let ty = Ty::Bool;
        Ok(Some(Expr { line, ty, kind }))
    }

    /// Refuses an argument that is not the caller's parameter of that view.
    pub(super) fn same_view(&mut self, argument: &syn::Expr, expected: &str) -> Result<(), Fault> {
        let line = argument.span().start().line;
        match self.named_view(argument) {
            Some(found) if found == expected => Ok(()),
            Some(found) => {
                let expected = expected.to_owned();
                Err((line, Problem::Mismatch { expected, found }))
            }
            None => Err(outside(
                line,
                "a view that is no parameter",
                "pass a parameter on, by value",
            )),
        }
    }

    /// The view that an expression names.
    fn named_view(&self, expression: &syn::Expr) -> Option<String> {
        match &self.locals[self.named_local(expression)?].ty {
            Ty::View(name) => Some(name.clone()),
            _ => None,
        }
    }

    /// `view.field` with elements: the view, the field and the elements' type.
    fn buffer(&self, expression: &syn::Expr) -> Result<Option<(String, String, Ty)>, Fault> {
        let syn::Expr::Field(it) = bare(expression) else {
            return Ok(None);
        };
        let Some(view) = self.named_view(&it.base) else {
            return Ok(None);
        };
        let member = super::expression::member_name(&it.member);
        let line = it.member.span().start().line;
        let (ty, place) = self.view_field(line, &view, &member)?;
        Ok(match place {
            FieldPlace::Buffer => Some((view, member, ty)),
            FieldPlace::Header { .. } => None,
        })
    }

    /// `view.field` without elements.
    fn plain(&self, line: usize, view: String, field: String) -> Result<Stored, Fault> {
        let (ty, place) = self.view_field(line, &view, &field)?;
        if place == FieldPlace::Buffer {
            return Err(outside(
                line,
                "a buffer by itself",
                "read its elements `[i as usize]` or its `len()`",
            ));
        }
        Ok(Stored {
            ty,
            ..buffer_start(view, field)
        })
    }

    fn view_field(&self, line: usize, view: &str, field: &str) -> Result<(Ty, FieldPlace), Fault> {
        let fields = self.scope.views.get(view).map(|v| v.fields.iter());
        let found = fields.into_iter().flatten().find(|f| f.name == field);
        found.map(|f| (f.ty.clone(), f.place)).ok_or_else(|| {
            let (ty, field) = (view.to_owned(), field.to_owned());
            (line, Problem::UnknownField { ty, field })
        })
    }

    /// An array's beginning and its elements' type.
    fn stored_array(&self, line: usize, of: Stored) -> Result<(Stored, Ty), Fault> {
        match of.ty.clone() {
            Ty::Array(element, _) => Ok((of, *element)),
            _ => Err(outside(
                line,
                "indexing of what is no array",
                "use `.x`, `.y`, `.z`",
            )),
        }
    }

    fn element(&mut self, of: Stored, ty: Ty, index: &syn::Expr) -> Result<Stored, Fault> {
        let index = self.operand(index)?;
        self.inference.unify(index.line, &Ty::U32, &index.ty)?;
        let stride = words(&self.scope.structs, &ty);
        let mut address = of.address;
        match index.kind {
            ExprKind::Integer { value, .. } => {
                let known = value.checked_mul(stride).map(|w| address.offset + w);
                let too_large = || (index.line, Problem::Number(value.to_string()));
                address.offset = known.ok_or_else(too_large)?;
            }
            _ => address.terms.push((index, stride)),
        }
        Ok(Stored { ty, address, ..of })
    }
}

fn buffer_start(view: String, field: String) -> Stored {
    Stored {
        view,
        field,
        ty: Ty::Unit,
        address: WordAddress {
            offset: 0,
            terms: Vec::new(),
        },
    }
}
