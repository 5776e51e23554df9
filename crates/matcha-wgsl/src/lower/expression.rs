//! Expressions but calls.

use super::Lowering;
use crate::diagnostic::{Fault, Problem, outside};
use crate::ir::{Expr, ExprKind};
use crate::prelude::known_constant;
use crate::types::Ty;
use syn::spanned::Spanned;

impl Lowering<'_> {
    pub(super) fn expression(&mut self, expression: &syn::Expr) -> Result<Expr, Fault> {
        let line = expression.span().start().line;
        match expression {
            syn::Expr::Paren(it) => self.expression(&it.expr),
            syn::Expr::Group(it) => self.expression(&it.expr),
            syn::Expr::Lit(it) => self.literal(line, &it.lit),
            syn::Expr::Path(it) => self.path(line, &it.path),
            syn::Expr::Call(it) => self.call(line, it),
            syn::Expr::MethodCall(it) => self.method(line, it),
            syn::Expr::Struct(it) => self.struct_literal(line, it),
            syn::Expr::Array(it) => self.array(line, it),
            syn::Expr::Repeat(it) => self.repeat(line, it),
            syn::Expr::Unary(it) => self.unary(line, it),
            syn::Expr::Binary(it) => self.binary(line, it),
            syn::Expr::Field(it) => match self.stored(expression)? {
                Some(stored) => Ok(self.read(line, stored)),
                None => self.field(line, it),
            },
            syn::Expr::Index(it) => match self.stored(expression)? {
                Some(stored) => Ok(self.read(line, stored)),
                None => self.index(line, it),
            },
            syn::Expr::Cast(it) => self.cast(line, it),
            syn::Expr::If(it) => self.choice(it),
            syn::Expr::Block(it) if it.label.is_none() => self.block_value(line, &it.block),
            syn::Expr::Unsafe(it) => self.block_value(line, &it.block),
            other => Err(refused(line, other)),
        }
    }

    /// An expression that is part of another.
    pub(super) fn operand(&mut self, expression: &syn::Expr) -> Result<Expr, Fault> {
        let operand = self.expression(expression)?;
        self.must_be_value(&operand)?;
        self.must_not_assign(&operand)?;
        Ok(operand)
    }

    fn literal(&mut self, line: usize, literal: &syn::Lit) -> Result<Expr, Fault> {
        let (ty, kind) = match literal {
            syn::Lit::Bool(bool) => (Ty::Bool, ExprKind::Bool(bool.value)),
            syn::Lit::Float(float) => (
                Ty::F32,
                float_literal(line, float.base10_digits(), float.suffix())?,
            ),
            syn::Lit::Int(int) if int.suffix() == "f32" => {
                (Ty::F32, float_literal(line, int.base10_digits(), "f32")?)
            }
            syn::Lit::Int(int) => {
                let ty = match int.suffix() {
                    "" | "usize" => self.inference.integer(),
                    "u32" => Ty::U32,
                    "i32" => Ty::I32,
                    other => return Err((line, Problem::UnknownType(other.to_owned()))),
                };
                let value = int
                    .base10_parse()
                    .map_err(|_| (line, Problem::Number(int.to_string())))?;
                let hexadecimal = int.to_string().starts_with("0x");
                (ty, ExprKind::Integer { value, hexadecimal })
            }
            _ => return Err(outside(line, "this literal", "use numbers and booleans")),
        };
        Ok(Expr { line, ty, kind })
    }

    fn path(&mut self, line: usize, path: &syn::Path) -> Result<Expr, Fault> {
        let names: Vec<String> = path.segments.iter().map(|s| s.ident.to_string()).collect();
        let Some(name) = names.last() else {
            return Err((line, Problem::UnknownValue(String::new())));
        };
        if names.len() == 1
            && let Some(local) = self.find(name)
        {
            let ty = self.locals[local].ty.clone();
            if let Some(refused) = by_itself(line, &ty) {
                return Err(refused);
            }
            let kind = ExprKind::Local(local);
            return Ok(Expr { line, ty, kind });
        }
        if let [.., owner, name] = names.as_slice()
            && let Some((value, ty)) = known_constant(owner, name)
        {
            let kind = match ty {
                Ty::F32 => ExprKind::Float(value),
                _ => ExprKind::Construct(vec![number(line, value)]),
            };
            return Ok(Expr { line, ty, kind });
        }
        if let Some(ty) = self.scope.constants.get(name) {
            self.uses.insert(name.clone());
            let ty = ty.clone();
            let kind = ExprKind::Constant(name.clone());
            return Ok(Expr { line, ty, kind });
        }
        Err((line, Problem::UnknownValue(names.join("::"))))
    }

    fn struct_literal(&mut self, line: usize, it: &syn::ExprStruct) -> Result<Expr, Fault> {
        if it.rest.is_some() {
            return Err(outside(line, "`..rest`", "name every field"));
        }
        let name = it
            .path
            .segments
            .last()
            .map(|s| s.ident.to_string())
            .unwrap_or_default();
        if self.scope.views.contains_key(&name) {
            return Err(outside(
                line,
                "making a view",
                "views come from hosts; pass a parameter on",
            ));
        }
        let (ty, fields) = match name.as_str() {
            "Vec2" => (Ty::Vec2, vector_fields(2)),
            "Vec3" => (Ty::Vec3, vector_fields(3)),
            _ => match self.scope.structs.get(&name) {
                Some(fields) => (Ty::Struct(name.clone()), fields.clone()),
                None => return Err((line, Problem::UnknownType(name))),
            },
        };
        let mut given: Vec<Option<Expr>> = fields.iter().map(|_| None).collect();
        for field in &it.fields {
            let line = field.span().start().line;
            let member = member_name(&field.member);
            let Some(at) = fields.iter().position(|(n, _)| *n == member) else {
                let ty = ty.rust();
                return Err((line, Problem::UnknownField { ty, field: member }));
            };
            let value = self.operand(&field.expr)?;
            self.inference.unify(value.line, &fields[at].1, &value.ty)?;
            given[at] = Some(value);
        }
        let found = given.iter().flatten().count();
        let expected = fields.len();
        if found != expected {
            return Err((
                line,
                Problem::Arguments {
                    name,
                    expected,
                    found,
                },
            ));
        }
        self.use_type(&ty);
        let kind = ExprKind::Construct(given.into_iter().flatten().collect());
        Ok(Expr { line, ty, kind })
    }

    fn array(&mut self, line: usize, it: &syn::ExprArray) -> Result<Expr, Fault> {
        let mut elements = Vec::new();
        for element in &it.elems {
            elements.push(self.operand(element)?);
        }
        let Some(first) = elements.first() else {
            return Err(outside(line, "an empty array", "arrays have elements"));
        };
        let of = first.ty.clone();
        for element in &elements {
            self.inference.unify(element.line, &of, &element.ty)?;
        }
        let ty = Ty::Array(Box::new(of), elements.len());
        let kind = ExprKind::Construct(elements);
        Ok(Expr { line, ty, kind })
    }

    fn repeat(&mut self, line: usize, it: &syn::ExprRepeat) -> Result<Expr, Fault> {
        let element = self.operand(&it.expr)?;
        let length = self.scope.length(&it.len)?;
        let ty = Ty::Array(Box::new(element.ty.clone()), length);
        let kind = ExprKind::Repeat(Box::new(element));
        Ok(Expr { line, ty, kind })
    }

    fn unary(&mut self, line: usize, it: &syn::ExprUnary) -> Result<Expr, Fault> {
        if let syn::UnOp::Deref(_) = it.op {
            return self.deref(line, &it.expr);
        }
        let operand = self.operand(&it.expr)?;
        let known = self.inference.known(&operand.ty);
        let operator = match it.op {
            syn::UnOp::Neg(_) => "-",
            syn::UnOp::Not(_) if known == Ty::Bool => "!",
            syn::UnOp::Not(_) => "~",
            _ => return Err(outside(line, "this operator", "use `-` and `!`")),
        };
        let ty = operand.ty.clone();
        let kind = ExprKind::Unary(operator, Box::new(operand));
        Ok(Expr { line, ty, kind })
    }

    fn binary(&mut self, line: usize, it: &syn::ExprBinary) -> Result<Expr, Fault> {
        let left = self.operand(&it.left)?;
        let right = self.operand(&it.right)?;
        let at = right.line;
        let a = self.inference.known(&left.ty);
        let b = self.inference.known(&right.ty);
        let (operator, ty) = match it.op {
            syn::BinOp::Add(_) => ("+", self.arithmetic(at, &a, &b)?),
            syn::BinOp::Sub(_) => ("-", self.arithmetic(at, &a, &b)?),
            syn::BinOp::Mul(_) => ("*", self.arithmetic(at, &a, &b)?),
            syn::BinOp::Div(_) => ("/", self.arithmetic(at, &a, &b)?),
            syn::BinOp::Rem(_) if a == Ty::F32 || a.is_vector() => {
                return Err(outside(line, "`%` of floats", "use `math::modulo`"));
            }
            syn::BinOp::Rem(_) => ("%", self.arithmetic(at, &a, &b)?),
            syn::BinOp::Shl(_) => ("<<", a),
            syn::BinOp::Shr(_) => (">>", a),
            syn::BinOp::And(_) => ("&&", self.equal(at, &Ty::Bool, &a, &b)?),
            syn::BinOp::Or(_) => ("||", self.equal(at, &Ty::Bool, &a, &b)?),
            syn::BinOp::BitAnd(_) => ("&", self.equal(at, &a, &a, &b)?),
            syn::BinOp::BitOr(_) => ("|", self.equal(at, &a, &a, &b)?),
            // WGSL has no exclusive or of booleans; they differ.
            syn::BinOp::BitXor(_) if a == Ty::Bool => ("!=", self.equal(at, &a, &a, &b)?),
            syn::BinOp::BitXor(_) => ("^", self.equal(at, &a, &a, &b)?),
            syn::BinOp::Eq(_) => ("==", self.comparison(at, &a, &b)?),
            syn::BinOp::Ne(_) => ("!=", self.comparison(at, &a, &b)?),
            syn::BinOp::Lt(_) => ("<", self.comparison(at, &a, &b)?),
            syn::BinOp::Le(_) => ("<=", self.comparison(at, &a, &b)?),
            syn::BinOp::Gt(_) => (">", self.comparison(at, &a, &b)?),
            syn::BinOp::Ge(_) => (">=", self.comparison(at, &a, &b)?),
            _ => {
                return Err(outside(
                    line,
                    "an assignment as a value",
                    "make it a statement",
                ));
            }
        };
        let kind = ExprKind::Binary(operator, Box::new(left), Box::new(right));
        Ok(Expr { line, ty, kind })
    }

    /// Type of a sum, difference, product or quotient.
    fn arithmetic(&mut self, line: usize, a: &Ty, b: &Ty) -> Result<Ty, Fault> {
        match (a, b) {
            (vector, Ty::F32) | (Ty::F32, vector) if vector.is_vector() => Ok(vector.clone()),
            _ => self.equal(line, a, a, b),
        }
    }

    fn comparison(&mut self, line: usize, a: &Ty, b: &Ty) -> Result<Ty, Fault> {
        self.inference.unify(line, a, b)?;
        if matches!(a, Ty::Vec2 | Ty::Vec3 | Ty::Array(..) | Ty::Struct(_)) {
            return Err(outside(
                line,
                "a comparison of more than numbers",
                "compare components",
            ));
        }
        Ok(Ty::Bool)
    }

    /// `ty`, which both operands must have.
    fn equal(&mut self, line: usize, ty: &Ty, a: &Ty, b: &Ty) -> Result<Ty, Fault> {
        self.inference.unify(line, ty, a)?;
        self.inference.unify(line, ty, b)?;
        Ok(ty.clone())
    }

    fn field(&mut self, line: usize, it: &syn::ExprField) -> Result<Expr, Fault> {
        let of = self.base(&it.base)?;
        let field = member_name(&it.member);
        let ty = self.field_type(line, &of.ty, &field)?;
        let kind = ExprKind::Field(Box::new(of), field);
        Ok(Expr { line, ty, kind })
    }

    pub(super) fn field_type(&self, line: usize, of: &Ty, field: &str) -> Result<Ty, Fault> {
        let of = self.inference.known(of);
        let fields = match &of {
            Ty::Vec2 => vector_fields(2),
            Ty::Vec3 => vector_fields(3),
            Ty::Struct(name) => self.scope.structs.get(name).cloned().unwrap_or_default(),
            _ => Vec::new(),
        };
        let found = fields.into_iter().find(|(n, _)| n == field);
        found.map(|(_, ty)| ty).ok_or_else(|| {
            let (ty, field) = (of.rust(), field.to_owned());
            (line, Problem::UnknownField { ty, field })
        })
    }

    fn index(&mut self, line: usize, it: &syn::ExprIndex) -> Result<Expr, Fault> {
        let of = self.base(&it.expr)?;
        let index = self.operand(&it.index)?;
        let Ty::Array(element, _) = self.inference.known(&of.ty) else {
            return Err(outside(
                line,
                "indexing of what is no array",
                "use `.x`, `.y`, `.z`",
            ));
        };
        let kind = ExprKind::Index(Box::new(of), Box::new(index));
        Ok(Expr {
            line,
            ty: *element,
            kind,
        })
    }

    fn cast(&mut self, line: usize, it: &syn::ExprCast) -> Result<Expr, Fault> {
        let value = self.operand(&it.expr)?;
        let is_index = matches!(&*it.ty, syn::Type::Path(p) if p.path.is_ident("usize"));
        let ty = if is_index {
            Ty::U32
        } else {
            self.scope.ty(&it.ty)?
        };
        let from = self.inference.known(&value.ty);
        match (&from, &ty) {
            (Ty::U32, Ty::U32) => Ok(value),
            (Ty::F32, Ty::I32 | Ty::U32) => Err(outside(
                line,
                "a cast of a float to an integer",
                "use `math::to_int`, which is the same on every device",
            )),
            (Ty::F32 | Ty::I32 | Ty::U32 | Ty::Unknown(_), Ty::F32)
            | (Ty::Bool | Ty::I32 | Ty::U32 | Ty::Unknown(_), Ty::I32 | Ty::U32) => {
                let kind = ExprKind::Cast(Box::new(value));
                Ok(Expr { line, ty, kind })
            }
            _ => Err((
                line,
                Problem::Mismatch {
                    expected: "a number".to_owned(),
                    found: from.rust(),
                },
            )),
        }
    }
}

pub(super) fn number(line: usize, value: f32) -> Expr {
    Expr {
        line,
        ty: Ty::F32,
        kind: ExprKind::Float(value),
    }
}

fn vector_fields(count: usize) -> Vec<(String, Ty)> {
    let names = ["x", "y", "z"].iter().take(count);
    names.map(|n| ((*n).to_owned(), Ty::F32)).collect()
}

pub(super) fn member_name(member: &syn::Member) -> String {
    match member {
        syn::Member::Named(name) => name.to_string(),
        syn::Member::Unnamed(index) => index.index.to_string(),
    }
}

fn float_literal(line: usize, digits: &str, suffix: &str) -> Result<ExprKind, Fault> {
    if !matches!(suffix, "" | "f32") {
        return Err((line, Problem::UnknownType(suffix.to_owned())));
    }
    match digits.parse::<f32>() {
        Ok(value) if value.is_finite() => Ok(ExprKind::Float(value)),
        _ => Err((line, Problem::Number(digits.to_owned()))),
    }
}

/// Why a parameter cannot be used as a value; `None` if it can.
fn by_itself(line: usize, ty: &Ty) -> Option<Fault> {
    match ty {
        Ty::Reference { .. } => Some(outside(
            line,
            "a reference by itself",
            "read its fields or `*` it, or pass it on",
        )),
        Ty::View(_) => Some(outside(
            line,
            "a view by itself",
            "read its fields, or pass it on",
        )),
        _ => None,
    }
}

/// Why a construct is no device code.
fn refused(line: usize, expression: &syn::Expr) -> Fault {
    let (what, instead) = match expression {
        syn::Expr::Match(_) => ("`match`", "use `if`"),
        syn::Expr::ForLoop(_) => ("`for`", "use `while`"),
        syn::Expr::Closure(_) => ("a closure", "write a function"),
        syn::Expr::Reference(_) => ("a reference", "references are arguments, of whole locals"),
        syn::Expr::Tuple(_) => ("a tuple", "name a struct"),
        syn::Expr::Macro(_) => ("a macro", "device code neither panics nor prints"),
        syn::Expr::Try(_) => ("`?`", "return a value that says so"),
        syn::Expr::Range(_) => ("a range", "count with `while`"),
        syn::Expr::Assign(_) => ("an assignment as a value", "make it a statement"),
        syn::Expr::Return(_) | syn::Expr::Break(_) | syn::Expr::Continue(_) => {
            ("a jump as a value", "make it a statement")
        }
        syn::Expr::While(_) | syn::Expr::Loop(_) => ("a loop as a value", "make it a statement"),
        _ => ("this expression", "see the rules of device code"),
    };
    outside(line, what, instead)
}
