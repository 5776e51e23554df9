//! A compiled material: fixed-width words in execution order.

/// Bit of an operand that names a constant row instead of a register.
pub const CONSTANT: u16 = 0x8000;

/// One instruction, 32 bytes.
#[repr(C, align(32))]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Word {
    /// An operation's index in the table, or one of the codes below.
    pub op: u16,
    /// First register of the result.
    pub dst: u16,
    /// A register or, with [`CONSTANT`], a constant, for each component of the operands.
    pub src: [u16; 12],
    /// Immediate.
    pub aux: u32,
}
