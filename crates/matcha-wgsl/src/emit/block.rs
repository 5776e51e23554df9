//! Statements, and expressions that need some.

use super::Emitter;
use crate::ir::{Block, Expr, ExprKind, Statement, StatementKind};
use crate::lower::writes;
use crate::types::Ty;

/// Where a value goes.
#[derive(Clone, Copy)]
enum Target<'t> {
    Variable(&'t str),
    Return,
    /// It has none.
    Nowhere,
}

impl Emitter<'_> {
    /// A function's body.
    pub(super) fn body(&mut self, body: &Block) {
        self.block(body, Target::Return);
        if self.result != Ty::Unit && ends_in_loop(body) {
            // Only `return` leaves the loop; WGSL wants to see a result behind it.
            let line = self.lines.last().map_or(1, |(_, line)| *line);
            let zero = format!("return {}();", self.result.wgsl());
            self.push(line, &zero);
        }
    }

    /// Statements after which the variable `name` has the value.
    pub(super) fn assign_to(&mut self, name: &str, it: &Expr) {
        self.deliver(it, Target::Variable(name));
    }

    fn block(&mut self, block: &Block, target: Target) {
        for statement in &block.statements {
            self.statement(statement);
            if ends(&statement.kind) {
                // What follows is never reached; WGSL refuses it.
                return;
            }
        }
        if let Some(value) = &block.value {
            self.deliver(value, target);
        }
    }

    fn indented(&mut self, block: &Block, target: Target) {
        self.depth += 1;
        self.block(block, target);
        self.depth -= 1;
    }

    fn deliver(&mut self, it: &Expr, target: Target) {
        match &it.kind {
            ExprKind::If {
                condition,
                then,
                otherwise,
            } => self.choice(it.line, condition, then, otherwise.as_ref(), target),
            ExprKind::Block(block) if !block.statements.is_empty() => {
                self.push(it.line, "{");
                self.indented(block, target);
                self.push(it.line, "}");
            }
            _ => {
                let value = self.expression(it);
                match target {
                    Target::Variable(name) => self.push(it.line, &format!("{name} = {value};")),
                    Target::Return => self.push(it.line, &format!("return {value};")),
                    Target::Nowhere if writes(it) => self.push(it.line, &format!("{value};")),
                    Target::Nowhere => {}
                }
            }
        }
    }

    fn choice(
        &mut self,
        line: usize,
        condition: &Expr,
        then: &Block,
        otherwise: Option<&Block>,
        target: Target,
    ) {
        let condition = self.expression(condition);
        self.push(line, &format!("if {condition} {{"));
        self.indented(then, target);
        if let Some(otherwise) = otherwise {
            self.alternative(line, otherwise, target);
        } else {
            self.push(line, "}");
        }
    }

    /// `else …`, as `else if` where nothing must stand in front of the next condition.
    fn alternative(&mut self, line: usize, otherwise: &Block, target: Target) {
        if let ([], Some(value))
        | (
            [
                Statement {
                    kind: StatementKind::Run(value),
                    ..
                },
            ],
            None,
        ) = (&otherwise.statements[..], otherwise.value.as_deref())
            && let ExprKind::If {
                condition,
                then,
                otherwise: next,
            } = &value.kind
        {
            let before = self.lines.len();
            let text = self.expression(condition);
            if self.lines.len() == before {
                self.push(value.line, &format!("}} else if {text} {{"));
                self.indented(then, target);
                match next {
                    Some(next) => self.alternative(value.line, next, target),
                    None => self.push(line, "}"),
                }
                return;
            }
            self.lines.truncate(before);
        }
        self.push(line, "} else {");
        self.indented(otherwise, target);
        self.push(line, "}");
    }

    fn statement(&mut self, it: &Statement) {
        match &it.kind {
            StatementKind::Let { local, value } => {
                self.declaration(it.line, *local, value.as_ref())
            }
            StatementKind::Assign {
                place,
                operator,
                value,
            } => self.assignment(it.line, place, *operator, value),
            StatementKind::Run(run) => self.deliver(run, Target::Nowhere),
            StatementKind::While { condition, body } => {
                self.repetition(it.line, condition.as_ref(), body)
            }
            StatementKind::Break => self.push(it.line, "break;"),
            StatementKind::Continue => self.push(it.line, "continue;"),
            StatementKind::Return(Some(value)) => self.deliver(value, Target::Return),
            StatementKind::Return(None) => self.push(it.line, "return;"),
        }
    }

    fn declaration(&mut self, line: usize, local: usize, value: Option<&Expr>) {
        let (name, mutable) = self.locals[local].clone();
        match value {
            Some(value) if !needs_statements(value) => {
                let text = self.expression(value);
                let keyword = if mutable { "var" } else { "let" };
                self.push(line, &format!("{keyword} {name} = {text};"));
            }
            Some(value) => {
                let ty = self.ty(&value.ty).wgsl();
                self.push(line, &format!("var {name}: {ty};"));
                self.assign_to(&name, value);
            }
            None => {
                let ty = self.local_types[local].wgsl();
                self.push(line, &format!("var {name}: {ty};"));
            }
        }
    }

    fn assignment(&mut self, line: usize, place: &Expr, operator: Option<&str>, value: &Expr) {
        let to = self.expression(place);
        let is_whole = operator.is_none() && matches!(place.kind, ExprKind::Local(_));
        if !is_whole && writes(value) {
            // Rust finds the place after the value, WGSL before.
            let text = self.expression(value);
            let name = self.names.fresh("value");
            self.push(line, &format!("let {name} = {text};"));
            let name = match operator {
                Some("<<" | ">>") => format!("u32({name})"),
                _ => name,
            };
            let operator = operator.unwrap_or_default();
            self.push(line, &format!("{to} {operator}= {name};"));
            return;
        }
        match operator {
            None if needs_statements(value) && matches!(place.kind, ExprKind::Local(_)) => {
                self.assign_to(&to, value);
            }
            None => {
                let text = self.expression(value);
                self.push(line, &format!("{to} = {text};"));
            }
            Some(operator @ ("<<" | ">>")) => {
                let text = self.shift_amount(value);
                self.push(line, &format!("{to} {operator}= {text};"));
            }
            Some(operator) => {
                let text = self.expression(value);
                self.push(line, &format!("{to} {operator}= {text};"));
            }
        }
    }

    fn repetition(&mut self, line: usize, condition: Option<&Expr>, body: &Block) {
        let before = self.lines.len();
        let text = condition.map(|c| self.expression(c));
        let hoists = self.lines.len() > before;
        self.lines.truncate(before);
        match (condition, text) {
            (Some(_), Some(text)) if !hoists => self.push(line, &format!("while {text} {{")),
            (condition, _) => {
                self.push(line, "loop {");
                if let Some(condition) = condition {
                    self.depth += 1;
                    let text = self.operand(condition);
                    self.push(line, &format!("if !({text}) {{ break; }}"));
                    self.depth -= 1;
                }
            }
        }
        self.indented(body, Target::Nowhere);
        self.push(line, "}");
    }
}

/// True for an expression that is written as statements.
fn needs_statements(it: &Expr) -> bool {
    match &it.kind {
        ExprKind::If { .. } => true,
        ExprKind::Block(block) => match (&block.statements[..], &block.value) {
            ([], Some(value)) => needs_statements(value),
            _ => true,
        },
        _ => false,
    }
}

/// True for a block without value whose last statement is a loop, or holds such a block.
fn ends_in_loop(block: &Block) -> bool {
    let last = block.statements.last().map(|last| &last.kind);
    block.value.is_none()
        && match last {
            Some(StatementKind::While { .. }) => true,
            Some(StatementKind::Run(run)) => run.blocks().into_iter().any(ends_in_loop),
            _ => false,
        }
}

/// True for a statement after which nothing runs.
fn ends(kind: &StatementKind) -> bool {
    matches!(
        kind,
        StatementKind::Return(_) | StatementKind::Break | StatementKind::Continue
    )
}
