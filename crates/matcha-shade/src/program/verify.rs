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
            let width = program.regions.get(word.aux as usize)?.ty.width();
            Some((width, width))
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
            if region.words.start != at || region.words.end <= at + 1 {
                return Err(invalid(at, "regions are not one after the other"));
            }
            self.verify_region(region, &mut defined)?;
            at = region.words.end;
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

    /// A region reads nothing but its texel, and leaves nothing but its result.
    fn verify_region(&self, region: &Region, defined: &mut [bool]) -> Result<(), ProgramError> {
        let words = region.words.clone();
        let expect = |index: usize, op| match self.words.get(index) {
            Some(word) if word.op == op && word.aux == region.node => Ok(()),
            _ => Err(invalid(
                index,
                "a region does not begin with lookup and end with store",
            )),
        };
        expect(words.start, special::LOOKUP)?;
        expect(words.end - 1, special::STORE)?;
        let mut inside = vec![false; defined.len()];
        for index in words.clone() {
            self.verify_word(index, &mut inside)?;
        }
        let result = region.result as usize..region.result as usize + region.ty.width();
        if self.words[words.end - 1].dst != region.result {
            return Err(invalid(
                words.end - 1,
                "stores elsewhere than in the region's result",
            ));
        }
        // All that the region writes besides its result must not be in use outside.
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
        defined[result].fill(true);
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
