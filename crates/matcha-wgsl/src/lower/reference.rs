//! References: parameters, and arguments for them.

use super::Lowering;
use crate::diagnostic::{Fault, Problem, outside};
use crate::ir::{Expr, ExprKind, LocalId};
use crate::types::Ty;
use syn::spanned::Spanned;

/// An expression without parentheses around it.
pub(super) fn bare(expression: &syn::Expr) -> &syn::Expr {
    match expression {
        syn::Expr::Paren(it) => bare(&it.expr),
        syn::Expr::Group(it) => bare(&it.expr),
        other => other,
    }
}

impl Lowering<'_> {
    /// The local that an expression names.
    pub(super) fn named_local(&self, expression: &syn::Expr) -> Option<LocalId> {
        match bare(expression) {
            syn::Expr::Path(it) => self.find(&it.path.get_ident()?.to_string()),
            _ => None,
        }
    }

    /// A parameter that is a reference, and what it refers to.
    fn named_reference(&self, expression: &syn::Expr) -> Option<(LocalId, Ty)> {
        let id = self.named_local(expression)?;
        match &self.locals[id].ty {
            Ty::Reference { of, .. } => Some((id, (**of).clone())),
            _ => None,
        }
    }

    /// What has a field or an element: Rust looks through references by itself.
    pub(super) fn base(&mut self, expression: &syn::Expr) -> Result<Expr, Fault> {
        let line = expression.span().start().line;
        match self.named_reference(expression) {
            Some((id, ty)) => {
                let kind = ExprKind::Deref(id);
                Ok(Expr { line, ty, kind })
            }
            None => self.operand(expression),
        }
    }

    /// `*parameter`.
    pub(super) fn deref(&mut self, line: usize, of: &syn::Expr) -> Result<Expr, Fault> {
        let Some((id, ty)) = self.named_reference(of) else {
            return Err(outside(
                line,
                "`*` of what is no reference",
                "parameters are the only references",
            ));
        };
        let kind = ExprKind::Deref(id);
        Ok(Expr { line, ty, kind })
    }

    /// An argument for a parameter `&of` or `&mut of`. The compiler has seen to `mut`.
    pub(super) fn reference(&mut self, argument: &syn::Expr, of: &Ty) -> Result<Expr, Fault> {
        let line = argument.span().start().line;
        if let Some((id, found)) = self.named_reference(argument) {
            self.inference.unify(line, of, &found)?;
            return Ok(self.passed_on(line, id));
        }
        let syn::Expr::Reference(reference) = bare(argument) else {
            let found = self.operand(argument)?;
            let expected = format!("a reference to {}", of.rust());
            let found = self.inference.known(&found.ty).rust();
            return Err((line, Problem::Mismatch { expected, found }));
        };
        if let syn::Expr::Unary(unary) = bare(&reference.expr)
            && let syn::UnOp::Deref(_) = unary.op
            && let Some((id, found)) = self.named_reference(&unary.expr)
        {
            self.inference.unify(line, of, &found)?;
            return Ok(self.passed_on(line, id));
        }
        let local = self.named_local(&reference.expr);
        let Some(id) = local.filter(|&id| is_value(&self.locals[id].ty)) else {
            return Err(outside(
                line,
                "a reference to what is no local",
                "give it a name with `let` first; of a reference, pass it itself",
            ));
        };
        let found = self.locals[id].ty.clone();
        self.inference.unify(line, of, &found)?;
        // Only variables have an address.
        self.locals[id].variable = true;
        let ty = Ty::Reference {
            of: Box::new(of.clone()),
            mutable: reference.mutability.is_some(),
        };
        let kind = ExprKind::Address(id);
        Ok(Expr { line, ty, kind })
    }

    fn passed_on(&self, line: usize, id: LocalId) -> Expr {
        Expr {
            line,
            ty: self.locals[id].ty.clone(),
            kind: ExprKind::Local(id),
        }
    }
}

fn is_value(ty: &Ty) -> bool {
    !matches!(ty, Ty::Reference { .. } | Ty::View(_))
}
