//! From [`crate::ir`] to WGSL.
//!
//! WGSL has no expressions that contain statements: an `if` or a block that is a value
//! becomes statements in front of the expression, which device code, being free of
//! effects, does not notice.

mod block;
mod stored;

use crate::ir::{Expr, ExprKind, FunctionBody};
use crate::names::{LocalNames, escaped};
use crate::prelude::{Intrinsic, intrinsic};
use crate::types::{Inference, Ty};
use crate::view::count_function;

/// A line of WGSL and the line of Rust that it is made from.
pub(crate) type Line = (String, usize);

/// A struct.
pub(crate) fn structure(line: usize, name: &str, fields: &[(String, Ty)]) -> Vec<Line> {
    let mut lines = vec![(format!("struct {} {{", escaped(name)), line)];
    for (field, ty) in fields {
        lines.push((format!("    {}: {},", escaped(field), ty.wgsl()), line));
    }
    lines.push(("}".to_owned(), line));
    lines
}

/// A constant.
pub(crate) fn constant(
    line: usize,
    name: &str,
    ty: &Ty,
    value: &Expr,
    inference: &Inference,
) -> Vec<Line> {
    let mut emitter = Emitter::new(inference);
    let value = emitter.expression(value);
    let text = format!("const {}: {} = {value};", escaped(name), ty.wgsl());
    emitter.push(line, &text);
    emitter.lines
}

/// A function.
pub(crate) fn function(function: &FunctionBody, inference: &Inference) -> Vec<Line> {
    let mut emitter = Emitter::new(inference);
    emitter.result = function.result.clone();
    let locals = function.locals.iter();
    for local in locals {
        let name = match local.ty {
            Ty::View(_) => String::new(),
            _ => emitter.names.fresh(&local.name),
        };
        emitter.locals.push((name, local.variable));
        emitter.local_types.push(inference.settled(&local.ty));
    }
    let mut copies = Vec::new();
    let mut parameters = Vec::new();
    for (id, local) in function.locals[..function.parameters].iter().enumerate() {
        if let Ty::View(_) = local.ty {
            continue;
        }
        let mut name = emitter.locals[id].0.clone();
        if local.variable {
            // Parameters of WGSL are not to be assigned to.
            let copy = name;
            name = emitter.names.fresh(&local.name);
            copies.push(format!("var {copy} = {name};"));
        }
        parameters.push(format!("{name}: {}", local.ty.wgsl()));
    }
    let name = escaped(&function.name);
    let result = match &function.result {
        Ty::Unit => String::new(),
        result => format!(" -> {}", result.wgsl()),
    };
    let head = format!("fn {name}({}){result} {{", parameters.join(", "));
    emitter.push(function.line, &head);
    emitter.depth += 1;
    for copy in copies {
        emitter.push(function.line, &copy);
    }
    emitter.body(&function.body);
    emitter.depth -= 1;
    emitter.push(function.line, "}");
    emitter.lines
}

/// One item being written.
struct Emitter<'a> {
    inference: &'a Inference,
    names: LocalNames,
    /// Name and mutability by local.
    locals: Vec<(String, bool)>,
    /// Settled type by local.
    local_types: Vec<Ty>,
    /// The function's result.
    result: Ty,
    lines: Vec<Line>,
    depth: usize,
}

impl<'a> Emitter<'a> {
    fn new(inference: &'a Inference) -> Self {
        Emitter {
            inference,
            names: LocalNames::default(),
            locals: Vec::new(),
            local_types: Vec::new(),
            result: Ty::Unit,
            lines: Vec::new(),
            depth: 0,
        }
    }

    fn push(&mut self, line: usize, text: &str) {
        self.lines
            .push((format!("{:1$}{text}", "", 4 * self.depth), line));
    }

    fn ty(&self, ty: &Ty) -> Ty {
        self.inference.settled(ty)
    }

    /// An expression that stands alone: between commas, after `=`.
    fn expression(&mut self, it: &Expr) -> String {
        match &it.kind {
            ExprKind::Float(value) => format!("{value:?}f"),
            ExprKind::Integer { value, hexadecimal } => self.integer(&it.ty, *value, *hexadecimal),
            ExprKind::Bool(value) => value.to_string(),
            ExprKind::Local(id) => self.locals[*id].0.clone(),
            ExprKind::Constant(name) => escaped(name),
            ExprKind::Deref(id) => format!("(*{})", self.locals[*id].0),
            ExprKind::Address(id) => format!("&{}", self.locals[*id].0),
            ExprKind::Stored {
                view,
                field,
                address,
            } => self.stored(view, field, address, &it.ty),
            ExprKind::Count { view, field } => format!("{}()", count_function(view, field)),
            ExprKind::Call {
                function,
                arguments,
                ..
            } => self.call(function, &it.ty, arguments),
            ExprKind::Construct(parts) => self.construct(&it.ty, parts),
            ExprKind::Repeat(element) => self.repeat(&it.ty, element),
            ExprKind::Unary("-", operand) if is_two_to_31(operand) => "i32(-2147483648)".to_owned(),
            ExprKind::Unary(operator, operand) => format!("{operator}{}", self.operand(operand)),
            ExprKind::Binary(operator @ ("<<" | ">>"), left, right) => {
                format!(
                    "{} {operator} {}",
                    self.operand(left),
                    self.shift_amount(right)
                )
            }
            ExprKind::Binary(operator, left, right) => {
                format!("{} {operator} {}", self.operand(left), self.operand(right))
            }
            ExprKind::Field(of, field) => format!("{}.{}", self.operand(of), escaped(field)),
            ExprKind::Index(of, index) => self.index(of, index),
            ExprKind::Cast(value) => {
                format!("{}({})", self.ty(&it.ty).wgsl(), self.expression(value))
            }
            ExprKind::If { .. } => self.hoisted(it),
            ExprKind::Block(block) => match (&block.statements[..], &block.value) {
                ([], Some(value)) => self.expression(value),
                _ => self.hoisted(it),
            },
        }
    }

    /// An expression next to an operator.
    fn operand(&mut self, it: &Expr) -> String {
        let text = self.expression(it);
        let mut inner = it;
        while let ExprKind::Block(block) = &inner.kind {
            match (&block.statements[..], &block.value) {
                ([], Some(value)) => inner = value,
                _ => break,
            }
        }
        let is_operator = match &inner.kind {
            ExprKind::Unary(..) | ExprKind::Binary(..) | ExprKind::Address(_) => true,
            ExprKind::Call { function, .. } => {
                matches!(intrinsic(function), Some(Intrinsic::Operator(_)))
            }
            _ => false,
        };
        if is_operator {
            format!("({text})")
        } else {
            text
        }
    }

    fn integer(&self, ty: &Ty, value: u32, hexadecimal: bool) -> String {
        let suffix = if self.ty(ty) == Ty::U32 { 'u' } else { 'i' };
        if hexadecimal {
            format!("{value:#x}{suffix}")
        } else {
            format!("{value}{suffix}")
        }
    }

    fn call(&mut self, name: &str, ty: &Ty, arguments: &[Expr]) -> String {
        match intrinsic(name) {
            Some(Intrinsic::Operator(operator)) => {
                let operands: Vec<String> = arguments.iter().map(|a| self.operand(a)).collect();
                operands.join(&format!(" {operator} "))
            }
            Some(Intrinsic::Builtin(builtin)) => format!("{builtin}({})", self.list(arguments)),
            Some(Intrinsic::Construct) => self.construct(ty, arguments),
            Some(Intrinsic::Helper(_)) | None => {
                format!("{}({})", escaped(name), self.list(arguments))
            }
        }
    }

    fn construct(&mut self, ty: &Ty, parts: &[Expr]) -> String {
        format!("{}({})", self.ty(ty).wgsl(), self.list(parts))
    }

    fn list(&mut self, expressions: &[Expr]) -> String {
        let texts: Vec<String> = expressions.iter().map(|e| self.expression(e)).collect();
        texts.join(", ")
    }

    fn repeat(&mut self, ty: &Ty, element: &Expr) -> String {
        let ty = self.ty(ty);
        let length = match &ty {
            Ty::Array(_, length) => *length,
            _ => 0,
        };
        let mut text = self.expression(element);
        let is_plain = matches!(
            element.kind,
            ExprKind::Float(_)
                | ExprKind::Integer { .. }
                | ExprKind::Local(_)
                | ExprKind::Constant(_)
        );
        if !is_plain {
            let name = self.names.fresh("element");
            self.push(element.line, &format!("let {name} = {text};"));
            text = name;
        }
        format!("{}({})", ty.wgsl(), vec![text; length].join(", "))
    }

    /// WGSL's shifts are by u32.
    fn shift_amount(&mut self, amount: &Expr) -> String {
        match &amount.kind {
            ExprKind::Integer { value, .. } => format!("{value}u"),
            _ if self.ty(&amount.ty) == Ty::U32 => self.operand(amount),
            _ => format!("u32({})", self.expression(amount)),
        }
    }

    fn index(&mut self, of: &Expr, index: &Expr) -> String {
        if let ExprKind::Integer { value, .. } = &index.kind {
            return format!("{}[{value}]", self.operand(of));
        }
        let index = {
            let index = self.without_cast(index);
            self.expression(index)
        };
        let is_variable = crate::lower::root(of).is_some_and(|id| {
            self.locals[id].1 || matches!(self.local_types[id], Ty::Reference { .. })
        });
        if is_variable || matches!(of.kind, ExprKind::Constant(_)) {
            return format!("{}[{index}]", self.operand(of));
        }
        // Only a variable's element can be chosen at run time.
        let text = self.expression(of);
        let name = self.names.fresh("indexed");
        self.push(of.line, &format!("var {name} = {text};"));
        format!("{name}[{index}]")
    }

    /// An index without its `as usize`, which Rust needs and WGSL does not.
    fn without_cast<'e>(&self, index: &'e Expr) -> &'e Expr {
        match &index.kind {
            ExprKind::Cast(inner) if self.ty(&inner.ty) == Ty::U32 => inner,
            _ => index,
        }
    }

    /// The name of a variable that statements in front have given the value.
    fn hoisted(&mut self, it: &Expr) -> String {
        let name = self.names.fresh("value");
        let ty = self.ty(&it.ty).wgsl();
        self.push(it.line, &format!("var {name}: {ty};"));
        self.assign_to(&name, it);
        name
    }
}

fn is_two_to_31(it: &Expr) -> bool {
    matches!(
        it.kind,
        ExprKind::Integer {
            value: 0x8000_0000,
            ..
        }
    )
}
