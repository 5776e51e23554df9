//! From an operation of the table to machine code: the same body over one lane or
//! over [`LANES`], compiled for the baseline and for wider instruction sets.

use crate::program::{CONSTANT, Word};

/// Points that a word is run over at once. Measured: docs/adr/0003-lane-machine.md.
pub const LANES: usize = 16;

/// Where a word's operands are: `N` consecutive f32 a slot.
#[derive(Clone, Copy)]
pub struct Frame {
    registers: *mut f32,
    constants: *const f32,
}

impl Frame {
    /// A frame over registers and constants that outlive every use of it.
    pub(crate) fn new(registers: *mut f32, constants: *const f32) -> Self {
        Frame {
            registers,
            constants,
        }
    }

    /// Rows of one operand: `N` f32.
    ///
    /// # Safety
    /// `operand` names a register or constant inside of the frame.
    #[inline(always)]
    pub(crate) unsafe fn operand<'a, const N: usize>(self, operand: u16) -> &'a [f32; N] {
        let base = if operand & CONSTANT != 0 {
            self.constants
        } else {
            self.registers
        };
        let slot = (operand & !CONSTANT) as usize;
        // SAFETY: in bounds by the caller's promise; f32 rows have no stricter alignment.
        unsafe { &*base.add(slot * N).cast::<[f32; N]>() }
    }

    /// Every operand of a word. Those that the kernel does not use cost nothing.
    ///
    /// # Safety
    /// All twelve are inside of the frame; nothing writes to them while they are used.
    #[inline(always)]
    pub unsafe fn operands<'a, const N: usize>(self, word: &Word) -> [&'a [f32; N]; 12] {
        // SAFETY: the caller's promise.
        core::array::from_fn(|i| unsafe { self.operand::<N>(word.src[i]) })
    }

    /// Writes a result to the word's destination.
    ///
    /// # Safety
    /// The destination's `W` slots are inside of the registers, and no reference to
    /// them is alive.
    #[inline(always)]
    pub unsafe fn store<const N: usize, const W: usize>(self, word: &Word, rows: &[[f32; N]; W]) {
        // SAFETY: the caller's promise.
        unsafe {
            let to = self
                .registers
                .add(word.dst as usize * N)
                .cast::<[[f32; N]; W]>();
            *to = *rows;
        }
    }
}

/// An operation's body over `N` lanes; implemented by the table's macro.
pub trait LaneOp {
    /// Reads the word's operands, writes its destination.
    ///
    /// # Safety
    /// The word's operands and destination are inside of the frame, whose slots hold
    /// `N` f32.
    unsafe fn run<const N: usize>(frame: Frame, word: &Word);
}

/// A kernel. Safety as [`LaneOp::run`]; the processor must have its instruction set.
pub type Kernel = unsafe fn(Frame, &Word);

/// An operation's kernels.
#[derive(Clone, Copy, Debug)]
pub struct KernelSet {
    /// One lane, baseline: the constant folder and the reference machine.
    pub scalar: Kernel,
    /// [`LANES`] lanes, the target's baseline (SSE2, NEON).
    pub baseline: Kernel,
    /// [`LANES`] lanes, AVX2 where the target has it.
    pub avx2: Kernel,
    /// [`LANES`] lanes, AVX-512 where the target has it.
    pub avx512: Kernel,
}

impl KernelSet {
    /// The kernels of one operation.
    pub const fn of<O: LaneOp>() -> Self {
        KernelSet {
            scalar: baseline::<O, 1>,
            baseline: baseline::<O, LANES>,
            avx2: avx2::<O, LANES>,
            avx512: avx512::<O, LANES>,
        }
    }
}

unsafe fn baseline<O: LaneOp, const N: usize>(frame: Frame, word: &Word) {
    // SAFETY: the caller's promise.
    unsafe { O::run::<N>(frame, word) }
}

#[cfg_attr(target_arch = "x86_64", target_feature(enable = "avx2"))]
unsafe fn avx2<O: LaneOp, const N: usize>(frame: Frame, word: &Word) {
    // SAFETY: the caller's promise.
    unsafe { O::run::<N>(frame, word) }
}

#[cfg_attr(
    target_arch = "x86_64",
    target_feature(enable = "avx512f,avx512vl,avx512dq,avx512bw")
)]
unsafe fn avx512<O: LaneOp, const N: usize>(frame: Frame, word: &Word) {
    // SAFETY: the caller's promise.
    unsafe { O::run::<N>(frame, word) }
}

/// An instruction set that the kernels exist for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Isa {
    /// One point at a time: the reference.
    Scalar,
    /// Lanes in the target's baseline: SSE2 on x86-64, NEON on AArch64.
    Baseline,
    /// Lanes in AVX2.
    Avx2,
    /// Lanes in AVX-512 (F, VL, DQ, BW).
    Avx512,
}

impl Isa {
    /// The widest that this processor has.
    pub fn best() -> Isa {
        *Isa::available().last().expect("scalar is always there")
    }

    /// All that this processor has, narrow to wide.
    pub fn available() -> Vec<Isa> {
        let mut sets = vec![Isa::Scalar, Isa::Baseline];
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx2") {
                sets.push(Isa::Avx2);
            }
            if is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512vl")
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512bw")
            {
                sets.push(Isa::Avx512);
            }
        }
        sets
    }

    /// Points at once.
    pub fn lanes(self) -> usize {
        if self == Isa::Scalar { 1 } else { LANES }
    }

    /// The kernel of an operation for this instruction set.
    pub fn kernel(self, set: &KernelSet) -> Kernel {
        match self {
            Isa::Scalar => set.scalar,
            Isa::Baseline => set.baseline,
            Isa::Avx2 => set.avx2,
            Isa::Avx512 => set.avx512,
        }
    }
}
