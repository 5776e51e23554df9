//! What a program must satisfy before a machine may run it without checks: every
//! operand exists and has been written on every way to the word that reads it.

use crate::ops;
use crate::program::{CONSTANT, Program, Region, Word, special};

/// Why a material has no program.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ProgramError {
    /// It does not fit into a word's fields.
    #[error("the material needs {count} {what}, more than the {limit} that a program can have")]
    TooLarge {
        /// Of what.
        what: &'static str,
        /// How many.
        count: usize,
        /// At most.
        limit: usize,
    },
    /// A word is wrong: a mistake in the compiler.
    #[error("word {word}: {problem}")]
    Invalid {
        /// Its position.
        word: usize,
        /// What is wrong.
        problem: String,
    },
}

/// Number of operand components and of result components of a word.
pub(crate) fn shape(program: &Program, word: &Word) -> Option<(usize, usize)> {
    match word.op {
        special::TEXTURE => (program.textures.len() > word.aux as usize).then_some((6, 4)),
        special::TABLE => Some((1, program.tables.get(word.aux as usize)?.rows.len())),
        special::LOOKUP => program.regions.get(word.aux as usize).map(|_| (0, 3)),
        special::STORE => {
            let values = &program.regions.get(word.aux as usize)?.values;
            let value = values.iter().find(|value| value.result == word.dst)?;
            Some((value.ty.width(), value.ty.width()))
        }
        op if (op as usize) < ops::all().count() => {
            let info = word.operation()?.info();
            Some((info.operand_rows(), info.result.width()))
        }
        _ => None,
    }
}

impl Program {
    /// Checks what the machine relies on.
    pub(crate) fn verify(&self) -> Result<(), ProgramError> {
        let mut defined = vec![false; self.slots];
        if self.input_rows > self.slots || self.splats.len() != self.constants.len() {
            return Err(invalid(
                0,
                "inputs without registers or constants without rows",
            ));
        }
        defined[..self.input_rows].fill(true);
        let mut at = 0;
        for region in &self.regions {
            let least = at + 1 + region.values.len();
            if region.words.start != at || region.words.end < least || region.values.is_empty() {
                return Err(invalid(at, "regions are not one after the other"));
            }
            self.verify_region(region, &mut defined)?;
            at = region.words.end;
        }
        defined[..self.input_rows].fill(false);
        for &row in &self.loads {
            match defined[..self.input_rows].get_mut(row as usize) {
                Some(slot) => *slot = true,
                None => return Err(invalid(at, "loads an input that does not exist")),
            }
        }
        for index in at..self.words.len() {
            let word = self
                .words
                .get(index)
                .ok_or_else(|| invalid(index, "missing"))?;
            if matches!(word.op, special::LOOKUP | special::STORE) {
                return Err(invalid(index, "outside of a region"));
            }
            self.verify_word(index, &mut defined)?;
        }
        for &output in &self.outputs {
            self.verify_operand(self.words.len(), output, &defined)?;
        }
        Ok(())
    }

    /// A region reads nothing but its texel, and leaves nothing but its values.
    fn verify_region(&self, region: &Region, defined: &mut [bool]) -> Result<(), ProgramError> {
        let words = region.words.clone();
        let expect = |index: usize, op| match self.words.get(index) {
            Some(word) if word.op == op && word.aux == region.number => Ok(()),
            _ => Err(invalid(
                index,
                "a region does not begin with lookup and end with store",
            )),
        };
        expect(words.start, special::LOOKUP)?;
        for (store, value) in region.stores().zip(&region.values) {
            expect(store, special::STORE)?;
            if self.words[store].dst != value.result {
                return Err(invalid(
                    store,
                    "stores elsewhere than in the region's values",
                ));
            }
        }
        let mut inside = vec![false; defined.len()];
        for index in words.clone() {
            self.verify_word(index, &mut inside)?;
        }
        // All that the region writes must not be in use outside.
        for (slot, written) in inside.iter().enumerate() {
            if *written && defined[slot] {
                return Err(invalid(
                    words.start,
                    "a region overwrites a register in use",
                ));
            }
        }
        if region.uv_rows.iter().any(|row| row + 2 > self.input_rows) {
            return Err(invalid(
                words.start,
                "the region's coordinate is not an input",
            ));
        }
        for value in &region.values {
            let first = value.result as usize;
            defined[first..first + value.ty.width()].fill(true);
        }
        Ok(())
    }

    fn verify_word(&self, index: usize, defined: &mut [bool]) -> Result<(), ProgramError> {
        let word = &self.words[index];
        let Some((operands, results)) = shape(self, word) else {
            return Err(invalid(index, "no such operation, image, table or region"));
        };
        for (i, &operand) in word.src.iter().enumerate() {
            if i < operands {
                self.verify_operand(index, operand, defined)?;
            } else if operand != 0 {
                return Err(invalid(index, "an unused operand is not zero"));
            }
        }
        let dst = word.dst as usize..word.dst as usize + results;
        match defined.get_mut(dst) {
            Some(slots) => slots.fill(true),
            None => return Err(invalid(index, "writes a register that does not exist")),
        }
        Ok(())
    }

    fn verify_operand(
        &self,
        index: usize,
        operand: u16,
        defined: &[bool],
    ) -> Result<(), ProgramError> {
        let number = (operand & !CONSTANT) as usize;
        if operand & CONSTANT != 0 {
            if number >= self.constants.len() {
                return Err(invalid(index, "reads a constant that does not exist"));
            }
        } else if defined.get(number) != Some(&true) {
            return Err(invalid(index, "reads a register that nothing wrote"));
        }
        Ok(())
    }
}

fn invalid(word: usize, problem: &str) -> ProgramError {
    ProgramError::Invalid {
        word,
        problem: problem.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closure::ClosureKind;
    use crate::compile::{CostModel, Options, compile};
    use crate::graph::Span;
    use crate::input::InputKind;
    use crate::material::MaterialGraph;
    use crate::ops::OpCode;

    /// A program with a region of one word and one word after it.
    fn program() -> Program {
        let mut m = MaterialGraph::default();
        let g = &mut m.graph;
        let uv = g.value(InputKind::Uv(0));
        let (u, v) = (g.component(uv, 0), g.component(uv, 1));
        let product = g.apply(OpCode::math_multiply, &[u, v]);
        let position = g.value(InputKind::Position);
        let weight = g.apply(OpCode::vector_scale, &[position, product]);
        let (kind, span) = (ClosureKind::Transparent, Span::default());
        m.closures.root = Some(m.closures.leaf(&m.graph, kind, weight, vec![], span));
        let cost = CostModel {
            lookup_ns: 0.0,
            ..CostModel::default()
        };
        let options = Options {
            cost,
            ..Options::default()
        };
        compile(&m, &options).expect("compiles").program
    }

    fn problem_after(spoil: impl FnOnce(&mut Program)) -> String {
        let mut program = program();
        assert_eq!(program.verify(), Ok(()));
        spoil(&mut program);
        match program.verify() {
            Err(ProgramError::Invalid { problem, .. }) => problem,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn lookup_words_store_then_the_rest() {
        let ops: Vec<u16> = program().words.iter().map(|w| w.op).collect();
        let (inside, after) = (OpCode::math_multiply.0, OpCode::vector_scale.0);
        assert_eq!(ops, [special::LOOKUP, inside, special::STORE, after]);
    }

    #[test]
    fn what_a_machine_could_not_bear_is_refused() {
        let many = !CONSTANT;
        assert!(problem_after(|p| p.words[3].dst = many).contains("does not exist"));
        assert!(problem_after(|p| p.words[3].src[0] = many).contains("nothing wrote"));
        let constant = many | CONSTANT;
        assert!(problem_after(|p| p.words[3].src[0] = constant).contains("constant"));
        assert!(problem_after(|p| p.words[3].op = 0xfe00).contains("no such"));
        assert!(problem_after(|p| p.words[3].src[11] = 1).contains("unused operand"));
        assert!(problem_after(|p| p.outputs[0] = many).contains("nothing wrote"));
        assert!(problem_after(|p| p.constants.push(1.0)).contains("constants"));
        assert!(problem_after(|p| p.loads.truncate(1)).contains("nothing wrote"));
        assert!(problem_after(|p| p.loads.push(many)).contains("does not exist"));
    }

    #[test]
    fn a_region_reads_and_writes_its_own_registers_only() {
        // An input of the hit, which is not the texel's.
        assert!(problem_after(|p| p.words[1].src[0] = 0).contains("nothing wrote"));
        // An input that the words after the region read.
        let clobber = |p: &mut Program| {
            p.words[1].dst = 0;
            p.words[2].src[0] = 0;
        };
        assert!(problem_after(clobber).contains("in use"));
        // A register of the region, read after it.
        let leak = |p: &mut Program| p.words[3].src[3] = p.words[1].dst;
        assert!(problem_after(leak).contains("nothing wrote"));
        assert!(problem_after(|p| p.words[2].op = 0).contains("store"));
        assert!(problem_after(|p| p.words[3] = p.words[2]).contains("outside of a region"));
    }
}
