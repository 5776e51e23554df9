//! The order of effects. Blocks and choices that are values become statements in front of
//! their expression, so that an expression with such a one must not also hold a call that
//! writes: it would come too late or too early.

use super::{Lowering, root};
use crate::diagnostic::{Fault, outside};
use crate::ir::{Block, Expr, ExprKind, Statement, StatementKind};

/// True for an expression with a call that writes, outside of its blocks.
pub(crate) fn writes(it: &Expr) -> bool {
    write_in(it, false).is_some()
}

impl Lowering<'_> {
    /// Refuses expressions whose effects would change their order.
    pub(super) fn must_keep_order(&self, block: &Block) -> Result<(), Fault> {
        for statement in &block.statements {
            self.statement_order(statement)?;
        }
        block.value.iter().try_for_each(|v| self.value_order(v))
    }

    fn statement_order(&self, statement: &Statement) -> Result<(), Fault> {
        match &statement.kind {
            StatementKind::Let { value, .. } => value.iter().try_for_each(|v| self.value_order(v)),
            StatementKind::Assign { place, value, .. } => {
                if let Some(line) = write_in(place, true) {
                    return Err(in_between(line));
                }
                if self.moves(place)
                    && let Some(line) = write_in(value, true)
                {
                    return Err(in_between(line));
                }
                self.value_order(value)
            }
            StatementKind::Run(run) => self.value_order(run),
            StatementKind::While { condition, body } => {
                condition.iter().try_for_each(|c| self.part_order(c))?;
                self.must_keep_order(body)
            }
            StatementKind::Return(value) => value.iter().try_for_each(|v| self.value_order(v)),
            StatementKind::Break | StatementKind::Continue => Ok(()),
        }
    }

    /// A whole value: its own blocks stay where they are.
    fn value_order(&self, it: &Expr) -> Result<(), Fault> {
        match &it.kind {
            ExprKind::If { condition, .. } => {
                self.part_order(condition)?;
                it.blocks()
                    .into_iter()
                    .try_for_each(|b| self.must_keep_order(b))
            }
            ExprKind::Block(block) => self.must_keep_order(block),
            _ => self.part_order(it),
        }
    }

    fn part_order(&self, it: &Expr) -> Result<(), Fault> {
        match write_in(it, true) {
            Some(line) if self.moves(it) => Err(in_between(line)),
            _ => Ok(()),
        }
    }

    /// True if some part is written in front of the expression.
    fn moves(&self, it: &Expr) -> bool {
        let itself = match &it.kind {
            ExprKind::If { .. } => true,
            ExprKind::Block(block) => {
                !block.statements.is_empty()
                    || block.value.as_ref().is_some_and(|value| self.moves(value))
            }
            ExprKind::Repeat(element) => !element.parts().is_empty(),
            ExprKind::Index(of, index) => {
                !matches!(index.kind, ExprKind::Integer { .. })
                    && !root(of).is_some_and(|id| self.locals[id].variable)
                    && !matches!(of.kind, ExprKind::Deref(_) | ExprKind::Constant(_))
            }
            _ => false,
        };
        itself || it.parts().into_iter().any(|part| self.moves(part))
    }
}

fn in_between(line: usize) -> Fault {
    outside(
        line,
        "a call that writes, in an expression with blocks or chosen elements",
        "give its value a name with `let` first",
    )
}

/// The line of a call that writes.
fn write_in(it: &Expr, in_blocks: bool) -> Option<usize> {
    if let ExprKind::Call { writes: true, .. } = it.kind {
        return Some(it.line);
    }
    let part = it.parts().into_iter().find_map(|p| write_in(p, in_blocks));
    if part.is_some() || !in_blocks {
        return part;
    }
    it.blocks().into_iter().find_map(write_in_block)
}

fn write_in_block(block: &Block) -> Option<usize> {
    let in_statement = |statement: &Statement| match &statement.kind {
        StatementKind::Let { value, .. } | StatementKind::Return(value) => {
            value.as_ref().and_then(|v| write_in(v, true))
        }
        StatementKind::Assign { place, value, .. } => {
            write_in(place, true).or_else(|| write_in(value, true))
        }
        StatementKind::Run(run) => write_in(run, true),
        StatementKind::While { condition, body } => condition
            .as_ref()
            .and_then(|c| write_in(c, true))
            .or_else(|| write_in_block(body)),
        StatementKind::Break | StatementKind::Continue => None,
    };
    let found = block.statements.iter().find_map(in_statement);
    found.or_else(|| block.value.as_ref().and_then(|v| write_in(v, true)))
}
