//! Blocks and statements.

use super::{Lowering, diverges, simple_pattern, type_of};
use crate::diagnostic::{Fault, outside};
use crate::ir::{Block, Expr, ExprKind, Statement, StatementKind};
use crate::types::Ty;
use std::collections::HashMap;
use syn::spanned::Spanned;

impl Lowering<'_> {
    pub(super) fn block(&mut self, block: &syn::Block) -> Result<Block, Fault> {
        self.sight.push(HashMap::new());
        let lowered = self.statements(&block.stmts);
        self.sight.pop();
        lowered
    }

    fn statements(&mut self, list: &[syn::Stmt]) -> Result<Block, Fault> {
        let mut statements = Vec::new();
        let mut value = None;
        for (i, statement) in list.iter().enumerate() {
            let is_last = i + 1 == list.len();
            match statement {
                syn::Stmt::Local(local) => statements.extend(self.local(local)?),
                syn::Stmt::Item(syn::Item::Const(item)) => {
                    statements.push(self.inner_constant(item)?)
                }
                syn::Stmt::Expr(expression, semicolon) => {
                    let is_value = is_last && semicolon.is_none();
                    match self.statement(expression, is_value)? {
                        Lowest::Statement(statement) => statements.push(statement),
                        Lowest::Value(expression) => value = Some(Box::new(expression)),
                    }
                }
                syn::Stmt::Item(item) => {
                    let line = item.span().start().line;
                    return Err(outside(
                        line,
                        "an item in a function",
                        "move it into the module",
                    ));
                }
                syn::Stmt::Macro(item) => {
                    let line = item.span().start().line;
                    return Err(outside(
                        line,
                        "a macro",
                        "device code neither panics nor prints",
                    ));
                }
            }
        }
        Ok(Block { statements, value })
    }

    /// `let`.
    fn local(&mut self, local: &syn::Local) -> Result<Option<Statement>, Fault> {
        let line = local.span().start().line;
        let declared = match &local.pat {
            syn::Pat::Type(typed) => self.scope.ty(&typed.ty)?,
            _ => self.inference.any(),
        };
        let (name, mutable) = simple_pattern(&local.pat)?;
        let value = match &local.init {
            None => None,
            Some(init) if init.diverge.is_some() => {
                return Err(outside(line, "`let … else`", "use `if`"));
            }
            Some(init) => Some(self.expression(&init.expr)?),
        };
        if let Some(value) = &value {
            self.must_be_value(value)?;
            self.inference.unify(value.line, &declared, &value.ty)?;
        }
        if name == "_" {
            return Ok(None);
        }
        self.use_type(&declared);
        // Without a value here it is assigned later, once or more.
        let mutable = mutable || value.is_none();
        let local = self.bind(name, declared, mutable);
        let kind = StatementKind::Let { local, value };
        Ok(Some(Statement { line, kind }))
    }

    /// A constant of a function is a `let` of it.
    fn inner_constant(&mut self, item: &syn::ItemConst) -> Result<Statement, Fault> {
        let line = item.span().start().line;
        let ty = self.scope.ty(&item.ty)?;
        let value = self.expression(&item.expr)?;
        self.inference.unify(value.line, &ty, &value.ty)?;
        let local = self.bind(item.ident.to_string(), ty, false);
        let value = Some(value);
        let kind = StatementKind::Let { local, value };
        Ok(Statement { line, kind })
    }

    fn statement(&mut self, expression: &syn::Expr, is_value: bool) -> Result<Lowest, Fault> {
        let line = expression.span().start().line;
        let kind = match expression {
            syn::Expr::Assign(assign) => self.assignment(&assign.left, None, &assign.right)?,
            syn::Expr::Binary(binary) if compound(&binary.op).is_some() => {
                self.assignment(&binary.left, compound(&binary.op), &binary.right)?
            }
            syn::Expr::While(_) | syn::Expr::Loop(_) => self.repetition(expression, line)?,
            syn::Expr::Return(it) => {
                let result = self.result.clone();
                match &it.expr {
                    None if result == Ty::Unit => StatementKind::Return(None),
                    None => {
                        return Err(outside(line, "`return` without value", "return the result"));
                    }
                    Some(value) => {
                        let value = self.expression(value)?;
                        self.inference.unify(value.line, &result, &value.ty)?;
                        self.must_be_value(&value)?;
                        StatementKind::Return(Some(value))
                    }
                }
            }
            syn::Expr::Break(it) if it.label.is_none() && it.expr.is_none() => StatementKind::Break,
            syn::Expr::Continue(it) if it.label.is_none() => StatementKind::Continue,
            syn::Expr::Break(_) | syn::Expr::Continue(_) => {
                return Err(outside(
                    line,
                    "a labelled jump",
                    "leave the innermost loop, without value",
                ));
            }
            _ => {
                let value = self.expression(expression)?;
                let ty = self.inference.known(&value.ty);
                if is_value && !matches!(ty, Ty::Unit | Ty::Never) {
                    return Ok(Lowest::Value(value));
                }
                let has_effect = match value.kind {
                    ExprKind::Call { writes, .. } => writes,
                    _ => matches!(value.kind, ExprKind::If { .. } | ExprKind::Block(_)),
                };
                if !has_effect {
                    return Err(outside(
                        line,
                        "a value that nothing takes",
                        "only assignments and calls with `&mut` have effects",
                    ));
                }
                StatementKind::Run(value)
            }
        };
        Ok(Lowest::Statement(Statement { line, kind }))
    }

    fn repetition(&mut self, expression: &syn::Expr, line: usize) -> Result<StatementKind, Fault> {
        let (label, condition, body) = match expression {
            syn::Expr::While(it) => {
                let condition = self.condition(&it.cond)?;
                (&it.label, Some(condition), self.block(&it.body)?)
            }
            syn::Expr::Loop(it) => (&it.label, None, self.block(&it.body)?),
            _ => return Err(outside(line, "this loop", "use `while`")),
        };
        if label.is_some() {
            return Err(outside(line, "a label", "leave the innermost loop"));
        }
        Ok(StatementKind::While { condition, body })
    }

    pub(super) fn condition(&mut self, condition: &syn::Expr) -> Result<Expr, Fault> {
        let lowered = self.expression(condition)?;
        self.inference.unify(lowered.line, &Ty::Bool, &lowered.ty)?;
        Ok(lowered)
    }

    fn assignment(
        &mut self,
        left: &syn::Expr,
        operator: Option<&'static str>,
        right: &syn::Expr,
    ) -> Result<StatementKind, Fault> {
        let line = left.span().start().line;
        if let syn::Expr::Infer(_) = left {
            return Err(outside(line, "`_ = …`", "leave the value away"));
        }
        let place = self.expression(left)?;
        if root(&place).is_none() {
            return Err(outside(
                line,
                "this assignment",
                "assign to a local, its field or its element",
            ));
        }
        let value = self.expression(right)?;
        self.must_be_value(&value)?;
        match operator {
            Some("<<" | ">>") => {}
            Some(_)
                if self.inference.known(&place.ty).is_vector()
                    && self.inference.known(&value.ty) == Ty::F32 => {}
            _ => self.inference.unify(line, &place.ty, &value.ty)?,
        }
        Ok(StatementKind::Assign {
            place,
            operator,
            value,
        })
    }

    /// An `if`, as a value or a statement.
    pub(super) fn choice(&mut self, it: &syn::ExprIf) -> Result<Expr, Fault> {
        let line = it.span().start().line;
        if let syn::Expr::Let(_) = &*it.cond {
            return Err(outside(
                line,
                "`if let`",
                "there are no enums; compare numbers",
            ));
        }
        let condition = Box::new(self.condition(&it.cond)?);
        let then = self.block(&it.then_branch)?;
        let otherwise = match &it.else_branch {
            None => None,
            Some((_, branch)) => Some(match &**branch {
                syn::Expr::Block(block) => self.block(&block.block)?,
                other => {
                    let value = self.expression(other)?;
                    match value.ty {
                        Ty::Unit | Ty::Never => Block {
                            statements: vec![Statement {
                                line: value.line,
                                kind: StatementKind::Run(value),
                            }],
                            value: None,
                        },
                        _ => Block {
                            statements: Vec::new(),
                            value: Some(Box::new(value)),
                        },
                    }
                }
            }),
        };
        let mut ty = type_of(&then);
        match &otherwise {
            None => ty = Ty::Unit,
            Some(other) => {
                self.inference.unify(line, &ty, &type_of(other))?;
                if ty == Ty::Never {
                    ty = type_of(other);
                }
            }
        }
        let kind = ExprKind::If {
            condition,
            then,
            otherwise,
        };
        Ok(Expr { line, ty, kind })
    }

    /// A block as an expression.
    pub(super) fn block_value(&mut self, line: usize, block: &syn::Block) -> Result<Expr, Fault> {
        let block = self.block(block)?;
        let ty = type_of(&block);
        let kind = ExprKind::Block(block);
        Ok(Expr { line, ty, kind })
    }

    /// Refuses what has no value where one is needed.
    pub(super) fn must_be_value(&self, expression: &Expr) -> Result<(), Fault> {
        if self.inference.known(&expression.ty) == Ty::Unit {
            return Err(outside(
                expression.line,
                "a value of no type",
                "give a value",
            ));
        }
        Ok(())
    }

    /// Refuses an operand that assigns to a local outside of itself: operands become
    /// statements in front of the expression, so that the order would change.
    pub(super) fn must_not_assign(&self, expression: &Expr) -> Result<(), Fault> {
        let mut blocks = Vec::new();
        match &expression.kind {
            ExprKind::If {
                then, otherwise, ..
            } => {
                blocks.push(then);
                blocks.extend(otherwise);
            }
            ExprKind::Block(block) => blocks.push(block),
            _ => {}
        }
        for block in blocks {
            if let Some(line) = assigns_outward(block, &mut Vec::new()) {
                return Err(outside(
                    line,
                    "an assignment inside of an operand",
                    "give the operand a name with `let` first",
                ));
            }
            debug_assert!(block.value.is_some() || diverges(block));
        }
        Ok(())
    }
}

/// What a statement's expression came to.
enum Lowest {
    Statement(Statement),
    Value(Expr),
}

/// The local that a place lies in.
pub(crate) fn root(place: &Expr) -> Option<usize> {
    match &place.kind {
        ExprKind::Local(id) | ExprKind::Deref(id) => Some(*id),
        ExprKind::Field(of, _) | ExprKind::Index(of, _) => root(of),
        _ => None,
    }
}

/// The line of an assignment to a local that is declared outside of the block.
fn assigns_outward(block: &Block, own: &mut Vec<usize>) -> Option<usize> {
    for statement in &block.statements {
        let found = match &statement.kind {
            StatementKind::Let { local, .. } => {
                own.push(*local);
                None
            }
            StatementKind::Assign { place, .. } => {
                let outward = root(place).is_none_or(|id| !own.contains(&id));
                outward.then_some(statement.line)
            }
            StatementKind::While { body, .. } => assigns_outward(body, own),
            StatementKind::Run(run) => match &run.kind {
                ExprKind::If {
                    then, otherwise, ..
                } => assigns_outward(then, own)
                    .or_else(|| otherwise.as_ref().and_then(|o| assigns_outward(o, own))),
                ExprKind::Block(inner) => assigns_outward(inner, own),
                _ => None,
            },
            _ => None,
        };
        if found.is_some() {
            return found;
        }
    }
    None
}

fn compound(operator: &syn::BinOp) -> Option<&'static str> {
    Some(match operator {
        syn::BinOp::AddAssign(_) => "+",
        syn::BinOp::SubAssign(_) => "-",
        syn::BinOp::MulAssign(_) => "*",
        syn::BinOp::DivAssign(_) => "/",
        syn::BinOp::RemAssign(_) => "%",
        syn::BinOp::BitXorAssign(_) => "^",
        syn::BinOp::BitAndAssign(_) => "&",
        syn::BinOp::BitOrAssign(_) => "|",
        syn::BinOp::ShlAssign(_) => "<<",
        syn::BinOp::ShrAssign(_) => ">>",
        _ => return None,
    })
}
