//! From Rust's syntax to [`crate::ir`]: names are resolved, types inferred, and what is
//! outside of the subset is refused.

mod call;
mod effects;
mod expression;
mod reference;
mod statement;
mod stored;

pub(crate) use effects::writes;
pub(crate) use statement::root;

use crate::collect::Scope;
use crate::diagnostic::{Fault, Problem, outside};
use crate::ir::{Block, Expr, ExprKind, FunctionBody, Local, LocalId, StatementKind};
use crate::types::{Inference, Ty};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use syn::spanned::Spanned;

/// An item in resolved form, with the global names that it needs.
pub(crate) struct Lowered<T> {
    pub item: T,
    pub inference: Inference,
    pub uses: BTreeSet<String>,
    /// What it reads of views by more than a word, by the reading function's name.
    pub reads: BTreeMap<String, Read>,
}

/// A read of a value of several words out of a view's field.
#[derive(Clone)]
pub(crate) struct Read {
    pub view: String,
    pub field: String,
    pub ty: Ty,
}

/// One item's translation.
pub(crate) struct Lowering<'a> {
    scope: &'a Scope,
    inference: Inference,
    uses: BTreeSet<String>,
    reads: BTreeMap<String, Read>,
    locals: Vec<Local>,
    /// Names in sight, innermost last.
    sight: Vec<HashMap<String, LocalId>>,
    result: Ty,
}

/// The value of an integer literal, also in parentheses.
pub(crate) fn integer_literal(expression: &syn::Expr) -> Option<u32> {
    match expression {
        syn::Expr::Lit(syn::ExprLit {
            lit: syn::Lit::Int(int),
            ..
        }) => int.base10_parse().ok(),
        syn::Expr::Paren(inner) => integer_literal(&inner.expr),
        _ => None,
    }
}

impl<'a> Lowering<'a> {
    /// For one item.
    pub fn new(scope: &'a Scope) -> Self {
        Lowering {
            scope,
            inference: Inference::default(),
            uses: BTreeSet::new(),
            reads: BTreeMap::new(),
            locals: Vec::new(),
            sight: vec![HashMap::new()],
            result: Ty::Unit,
        }
    }

    /// A constant's value.
    pub fn constant(mut self, item: &syn::ItemConst) -> Result<Lowered<Expr>, Fault> {
        let ty = self.scope.ty(&item.ty)?;
        let value = self.expression(&item.expr)?;
        self.inference.unify(value.line, &ty, &value.ty)?;
        Ok(self.finished(value))
    }

    /// A function.
    pub fn function(mut self, item: &syn::ItemFn) -> Result<Lowered<FunctionBody>, Fault> {
        let name = item.sig.ident.to_string();
        let line = item.sig.ident.span().start().line;
        let Some(signature) = self.scope.functions.get(&name) else {
            // Its face was refused, and that is reported already.
            return Err((line, Problem::UnknownFunction(name)));
        };
        self.result = signature.result.clone();
        for (input, ty) in item.sig.inputs.iter().zip(&signature.parameters) {
            let syn::FnArg::Typed(typed) = input else {
                continue;
            };
            let (name, mutable) = simple_pattern(&typed.pat)?;
            if mutable && matches!(ty, Ty::Reference { .. } | Ty::View(_)) {
                let line = typed.pat.span().start().line;
                return Err(outside(
                    line,
                    "`mut` of a reference or view",
                    "a parameter refers to one thing all the time",
                ));
            }
            self.bind(name, ty.clone(), mutable);
        }
        for parameter in signature.parameters.iter().chain([&signature.result]) {
            self.use_type(parameter);
        }
        let parameters = self.locals.len();
        let body = self.block(&item.block)?;
        self.must_give(&body, &signature.result, line)?;
        self.must_keep_order(&body)?;
        let locals = std::mem::take(&mut self.locals);
        Ok(self.finished(FunctionBody {
            name,
            line,
            parameters,
            locals,
            result: signature.result.clone(),
            body,
        }))
    }

    fn finished<T>(self, item: T) -> Lowered<T> {
        Lowered {
            item,
            inference: self.inference,
            uses: self.uses,
            reads: self.reads,
        }
    }

    /// A function's body must give its result at the end.
    fn must_give(&mut self, body: &Block, result: &Ty, line: usize) -> Result<(), Fault> {
        match &body.value {
            Some(value) => self.inference.unify(value.line, result, &value.ty),
            None if diverges(body) => Ok(()),
            None => self.inference.unify(line, result, &Ty::Unit),
        }
    }

    /// A new local, in sight from here on.
    fn bind(&mut self, name: String, ty: Ty, variable: bool) -> LocalId {
        let id = self.locals.len();
        if let Some(innermost) = self.sight.last_mut() {
            innermost.insert(name.clone(), id);
        }
        self.locals.push(Local { name, ty, variable });
        id
    }

    fn find(&self, name: &str) -> Option<LocalId> {
        self.sight.iter().rev().find_map(|s| s.get(name).copied())
    }

    /// Notes the structs that a type needs.
    fn use_type(&mut self, ty: &Ty) {
        match ty {
            Ty::Struct(name) => {
                self.uses.insert(name.clone());
            }
            Ty::Array(of, _) | Ty::Reference { of, .. } => self.use_type(of),
            _ => {}
        }
    }
}

/// The type of a block.
fn type_of(block: &Block) -> Ty {
    match &block.value {
        Some(value) => value.ty.clone(),
        None if diverges(block) => Ty::Never,
        None => Ty::Unit,
    }
}

/// True if nothing after the block is ever reached.
fn diverges(block: &Block) -> bool {
    block.statements.iter().any(|s| match &s.kind {
        StatementKind::Return(_) | StatementKind::Break | StatementKind::Continue => true,
        StatementKind::Run(run) => match &run.kind {
            ExprKind::If {
                then,
                otherwise: Some(otherwise),
                ..
            } => diverges(then) && diverges(otherwise),
            ExprKind::Block(inner) => diverges(inner),
            _ => false,
        },
        StatementKind::While {
            condition: None,
            body,
        } => !has_break(body),
        _ => false,
    })
}

/// True if the loop around the block may be left by `break`.
fn has_break(block: &Block) -> bool {
    block.statements.iter().any(|s| match &s.kind {
        StatementKind::Break => true,
        StatementKind::Run(run) => run.blocks().into_iter().any(has_break),
        _ => false,
    })
}

/// The name of a parameter or `let`, and whether it is `mut`.
fn simple_pattern(pattern: &syn::Pat) -> Result<(String, bool), Fault> {
    match pattern {
        syn::Pat::Ident(ident) if ident.by_ref.is_none() && ident.subpat.is_none() => {
            Ok((ident.ident.to_string(), ident.mutability.is_some()))
        }
        syn::Pat::Wild(_) => Ok(("_".to_owned(), false)),
        syn::Pat::Type(typed) => simple_pattern(&typed.pat),
        other => {
            let line = other.span().start().line;
            Err(outside(
                line,
                "a pattern",
                "bind one name, and take fields from it",
            ))
        }
    }
}
