//! Registers by liveness: first fit, a value's components in a row.

use crate::program::{CONSTANT, ProgramError, Word};

/// Registers or constants that a program can have.
pub(super) const MOST_SLOTS: usize = CONSTANT as usize;

/// A component of an operand before registers are assigned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Source {
    /// A constant's operand.
    Constant(u16),
    /// A value's number; those placed beforehand have their register's number.
    Value(u32),
}

/// A word before registers are assigned.
pub(super) struct Step {
    pub op: u16,
    pub aux: u32,
    pub sources: Vec<Source>,
    /// Number of the result's first component.
    pub first: u32,
    pub width: usize,
}

/// Words with registers.
pub(super) struct Assigned {
    pub words: Vec<Word>,
    /// The operands of the results that were asked for.
    pub results: Vec<u16>,
    /// Registers in use at most.
    pub slots: usize,
}

/// When a value is read for the last time.
#[derive(Clone, Copy, PartialEq, Eq)]
enum LastUse {
    Never,
    Step(usize),
    End,
}

/// Assigns registers to `values` values, of which the first `placed` are in the
/// register of their number at the start; these are reused if `reuse`.
pub(super) fn assign(
    steps: &[Step],
    results: &[Source],
    placed: usize,
    values: usize,
    reuse: bool,
) -> Result<Assigned, ProgramError> {
    let mut last_use = last_uses(steps, results, values);
    if !reuse {
        last_use[..placed].fill(LastUse::End);
    }
    let mut register: Vec<u16> = (0..values.max(1))
        .map(|v| v.min(MOST_SLOTS) as u16)
        .collect();
    let mut taken: Vec<bool> = last_use[..placed]
        .iter()
        .map(|u| *u != LastUse::Never)
        .collect();
    let operand = |source: &Source, register: &[u16]| match *source {
        Source::Constant(operand) => operand,
        Source::Value(v) => register[v as usize],
    };
    let mut words = Vec::with_capacity(steps.len());
    for (at, step) in steps.iter().enumerate() {
        let mut src = [0u16; 12];
        for (to, source) in src.iter_mut().zip(&step.sources) {
            *to = operand(source, &register);
            // A kernel reads all operands before it writes, so that the result may
            // take the place of an operand that dies here.
            if let Source::Value(v) = *source
                && last_use[v as usize] == LastUse::Step(at)
            {
                taken[*to as usize] = false;
            }
        }
        let dst = first_fit(&mut taken, step.width);
        let first = slot(dst)?;
        for i in 0..step.width {
            let value = step.first as usize + i;
            register[value] = first + i as u16;
            taken[dst + i] = last_use[value] != LastUse::Never;
        }
        words.push(Word {
            op: step.op,
            dst: first,
            src,
            aux: step.aux,
        });
    }
    let results = results.iter().map(|r| operand(r, &register)).collect();
    Ok(Assigned {
        words,
        results,
        slots: taken.len().max(placed),
    })
}

fn last_uses(steps: &[Step], results: &[Source], values: usize) -> Vec<LastUse> {
    let mut last_use = vec![LastUse::Never; values];
    let mut note = |source: &Source, at| {
        if let Source::Value(v) = *source {
            last_use[v as usize] = at;
        }
    };
    for (at, step) in steps.iter().enumerate() {
        step.sources.iter().for_each(|s| note(s, LastUse::Step(at)));
    }
    results.iter().for_each(|r| note(r, LastUse::End));
    last_use
}

/// The first `width` free registers in a row.
fn first_fit(taken: &mut Vec<bool>, width: usize) -> usize {
    let mut run = 0;
    for (at, &is_taken) in taken.iter().enumerate() {
        run = if is_taken { 0 } else { run + 1 };
        if run == width {
            return at + 1 - width;
        }
    }
    let first = taken.len() - run;
    taken.resize(first + width, false);
    first
}

/// A register's number, if a word can hold it.
pub(super) fn slot(register: usize) -> Result<u16, ProgramError> {
    // Four above, so that a value of four components always has numbers.
    if register + 4 > MOST_SLOTS {
        return Err(too_large("registers", register));
    }
    Ok(register as u16)
}

pub(super) fn too_large(what: &'static str, count: usize) -> ProgramError {
    ProgramError::TooLarge {
        what,
        count,
        limit: MOST_SLOTS,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn step(first: u32, width: usize, sources: &[u32]) -> Step {
        let sources = sources.iter().map(|&v| Source::Value(v)).collect();
        Step {
            op: 0,
            aux: 0,
            sources,
            first,
            width,
        }
    }

    #[test]
    fn a_dead_register_is_taken_again() {
        // 0 and 1 are inputs; 2 = f(0, 1); 3 = f(2, 1); the result is 3.
        let steps = [step(2, 1, &[0, 1]), step(3, 1, &[2, 1])];
        let assigned = assign(&steps, &[Source::Value(3)], 2, 4, true).unwrap();
        assert_eq!(
            assigned.words.iter().map(|w| w.dst).collect::<Vec<_>>(),
            [0, 0]
        );
        assert_eq!(assigned.slots, 2);
    }

    #[test]
    fn placed_registers_stay_where_they_must() {
        let steps = [step(2, 1, &[0, 1])];
        let assigned = assign(&steps, &[Source::Value(2)], 2, 3, false).unwrap();
        assert_eq!(assigned.results, [2]);
    }

    #[test]
    fn unread_components_do_not_hold_registers() {
        // 1..=3 is a triple of which only the last is read.
        let steps = [step(1, 3, &[0]), step(4, 2, &[3]), step(6, 1, &[3, 4, 5])];
        let assigned = assign(&steps, &[Source::Value(6)], 1, 7, true).unwrap();
        assert_eq!(assigned.words[1].dst, 0);
        assert_eq!(assigned.slots, 3);
    }
}
