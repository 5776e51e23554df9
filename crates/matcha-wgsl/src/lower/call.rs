//! Calls.

use super::Lowering;
use crate::collect::Signature;
use crate::diagnostic::{Fault, Problem, outside};
use crate::ir::{Expr, ExprKind};
use crate::prelude::{Intrinsic, intrinsic};
use crate::types::Ty;
use syn::punctuated::Punctuated;

type Arguments = Punctuated<syn::Expr, syn::Token![,]>;

impl Lowering<'_> {
    pub(super) fn call(&mut self, line: usize, it: &syn::ExprCall) -> Result<Expr, Fault> {
        let syn::Expr::Path(path) = &*it.func else {
            return Err(outside(
                line,
                "a call of a value",
                "call a function by name",
            ));
        };
        let names: Vec<String> = path
            .path
            .segments
            .iter()
            .map(|s| s.ident.to_string())
            .collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        match names.as_slice() {
            [.., "Vec2", constructor] => self.glam(line, Ty::Vec2, constructor, &it.args),
            [.., "Vec3", constructor] => self.glam(line, Ty::Vec3, constructor, &it.args),
            [.., "select"] => self.select(line, &it.args),
            [.., name] => self.device_call(line, name, &it.args),
            [] => Err((line, Problem::UnknownFunction(String::new()))),
        }
    }

    /// `Vec3::new` and `Vec3::splat`.
    fn glam(
        &mut self,
        line: usize,
        ty: Ty,
        constructor: &str,
        arguments: &Arguments,
    ) -> Result<Expr, Fault> {
        let parts = if ty == Ty::Vec2 { 2 } else { 3 };
        let count = match constructor {
            "new" => parts,
            "splat" => 1,
            _ => {
                let name = format!("{}::{constructor}", ty.rust());
                return Err((line, Problem::UnknownFunction(name)));
            }
        };
        let arguments = self.arguments(line, constructor, &vec![Ty::F32; count], arguments)?;
        let kind = ExprKind::Construct(arguments);
        Ok(Expr { line, ty, kind })
    }

    /// `select` is of every type, in WGSL as in the cache's prelude.
    fn select(&mut self, line: usize, arguments: &Arguments) -> Result<Expr, Fault> {
        let name = "select";
        let any = self.inference.any();
        let types = [any.clone(), any.clone(), Ty::Bool];
        let arguments = self.arguments(line, name, &types, arguments)?;
        let kind = ExprKind::Call {
            function: name.to_owned(),
            arguments,
            writes: false,
        };
        let ty = self.inference.known(&any);
        Ok(Expr { line, ty, kind })
    }

    fn device_call(
        &mut self,
        line: usize,
        name: &str,
        arguments: &Arguments,
    ) -> Result<Expr, Fault> {
        let Some(Signature { parameters, result }) = self.scope.functions.get(name).cloned() else {
            return Err((line, Problem::UnknownFunction(name.to_owned())));
        };
        let writes = |ty: &Ty| matches!(ty, Ty::Reference { mutable: true, .. });
        let writes = parameters.iter().any(writes);
        let arguments = self.arguments(line, name, &parameters, arguments)?;
        let is_global = match intrinsic(name) {
            None => true,
            Some(known) => matches!(known, Intrinsic::Helper(_)),
        };
        if is_global {
            self.uses.insert(name.to_owned());
        }
        let kind = ExprKind::Call {
            function: name.to_owned(),
            arguments,
            writes,
        };
        Ok(Expr {
            line,
            ty: result,
            kind,
        })
    }

    fn arguments(
        &mut self,
        line: usize,
        name: &str,
        types: &[Ty],
        given: &Arguments,
    ) -> Result<Vec<Expr>, Fault> {
        if types.len() != given.len() {
            let problem = Problem::Arguments {
                name: name.to_owned(),
                expected: types.len(),
                found: given.len(),
            };
            return Err((line, problem));
        }
        let mut arguments = Vec::new();
        for (ty, argument) in types.iter().zip(given) {
            match ty {
                // It is known by its type alone.
                Ty::View(name) => self.same_view(argument, name)?,
                Ty::Reference { of, .. } => arguments.push(self.reference(argument, of)?),
                _ => {
                    let value = self.operand(argument)?;
                    self.inference.unify(value.line, ty, &value.ty)?;
                    arguments.push(value);
                }
            }
        }
        Ok(arguments)
    }

    /// The methods of buffers, and the one that the prelude needs; all others have free
    /// functions.
    pub(super) fn method(&mut self, line: usize, it: &syn::ExprMethodCall) -> Result<Expr, Fault> {
        if let Some(of_buffer) = self.buffer_method(line, it)? {
            return Ok(of_buffer);
        }
        if it.method != "to_int_unchecked" {
            let what = format!("the method `{}`", it.method);
            return Err(outside(line, what, "call a free function of `math`"));
        }
        let value = self.operand(&it.receiver)?;
        self.inference.unify(line, &Ty::F32, &value.ty)?;
        let kind = ExprKind::Cast(Box::new(value));
        Ok(Expr {
            line,
            ty: Ty::I32,
            kind,
        })
    }
}
