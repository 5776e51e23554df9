//! The inner machine: words over one chunk of `N` points.

use crate::graph::Table;
use crate::program::{CONSTANT, Program, Word, special};
use crate::vm::Textures;
use crate::vm::kernel::{Frame, Kernel, LANES};
use crate::vm::tables;
use std::ops::Range;

/// Registers of one chunk, and what the words need besides.
pub(super) struct Core<'a, const N: usize> {
    program: &'a Program,
    kernels: &'a [Kernel],
    registers: &'a mut [f32],
    constants: &'a [f32],
    textures: &'a dyn Textures,
    pub(super) texture_samples: u64,
}

impl<'a, const N: usize> Core<'a, N> {
    /// `kernels` are those of every operation for `N` lanes; `registers` has room for
    /// the program's.
    pub(super) fn new(
        program: &'a Program,
        kernels: &'a [Kernel],
        registers: &'a mut [f32],
        textures: &'a dyn Textures,
    ) -> Self {
        assert!(
            N == 1 || N == LANES,
            "constants are splatted over {LANES} lanes"
        );
        assert!(registers.len() >= program.slots() * N, "too few registers");
        let constants = if N == 1 {
            &program.constants[..]
        } else {
            bytemuck::cast_slice(&program.splats)
        };
        Core {
            program,
            kernels,
            registers,
            constants,
            textures,
            texture_samples: 0,
        }
    }

    /// Sets a register from the first `active` numbers of `from`. The lanes after them
    /// repeat the last one, so that they ask for no more work than it.
    pub(super) fn load(&mut self, register: usize, from: &[f32], active: usize) {
        let to = &mut self.registers[register * N..][..N];
        if active == N {
            to.copy_from_slice(&from[..N]);
        } else {
            to[..active].copy_from_slice(&from[..active]);
            to[active..].fill(from[active - 1]);
        }
    }

    /// The value of a register or constant.
    pub(super) fn value(&self, operand: u16) -> &[f32; N] {
        let slot = (operand & !CONSTANT) as usize * N;
        let from = if operand & CONSTANT != 0 {
            self.constants
        } else {
            &*self.registers
        };
        from[slot..][..N].try_into().expect("N numbers")
    }

    /// Runs words over the chunk, of which the first `active` lanes are points.
    #[inline]
    pub(super) fn execute(&mut self, words: Range<usize>, active: usize) {
        let frame = Frame::new(self.registers.as_mut_ptr(), self.constants.as_ptr());
        let program = self.program;
        for word in &program.words[words] {
            match self.kernels.get(word.op as usize) {
                // SAFETY: the program is verified (it can only be made by the
                // compiler, which verifies it, and is immutable since), so operands
                // and destination are below `slots` or the number of constants, and
                // `new` checked that the frame has as many, of N f32 each. The
                // machine picked kernels that the processor can run.
                Some(kernel) => unsafe { kernel(frame, word) },
                None => self.special(word, active),
            }
        }
    }

    /// A word of the program.
    pub(super) fn word(&self, index: usize) -> Word {
        self.program.words[index]
    }

    fn special(&mut self, word: &Word, active: usize) {
        match word.op {
            special::TEXTURE => self.texture(word, active),
            special::TABLE => self.table(word),
            // Regions are entered and left by the machine.
            _ => {}
        }
    }

    fn texture(&mut self, word: &Word, active: usize) {
        let operand = |i: usize| &self.value(word.src[i])[..active];
        let mut out = [[0.0f32; N]; 4];
        let [r, g, b, a] = &mut out;
        self.textures.sample(
            self.program.textures[word.aux as usize],
            active,
            [operand(0), operand(1)],
            [operand(2), operand(3)],
            [operand(4), operand(5)],
            [
                &mut r[..active],
                &mut g[..active],
                &mut b[..active],
                &mut a[..active],
            ],
        );
        self.texture_samples += active as u64;
        self.store(word.dst, &out, 4);
    }

    fn table(&mut self, word: &Word) {
        let table: &Table = &self.program.tables[word.aux as usize];
        let out = tables::look_up(table, self.value(word.src[0]));
        self.store(word.dst, &out, table.rows.len());
    }

    fn store(&mut self, dst: u16, rows: &[[f32; N]; 4], count: usize) {
        let to = &mut self.registers[dst as usize * N..][..count * N];
        to.copy_from_slice(rows[..count].as_flattened());
    }
}
