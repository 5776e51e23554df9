//! One operation on one point, for the constant folder and the oracle.

use crate::graph::Table;
use crate::ops::OpCode;
use crate::program::{CONSTANT, Word};
use crate::vm::kernel::Frame;
use crate::vm::tables;

/// Applies an operation; components past the result's type are zero.
///
/// # Panics
/// If there are fewer operands than the operation has components.
pub fn apply(op: OpCode, aux: u32, operands: &[f32]) -> [f32; 4] {
    let info = op.info();
    let count = info.operand_rows();
    assert!(
        operands.len() >= count && count <= 12,
        "operands of {}",
        info.name
    );
    let mut constants = [0.0f32; 12];
    constants[..count].copy_from_slice(&operands[..count]);
    let mut result = [0.0f32; 4];
    let word = Word {
        op: op.0,
        dst: 0,
        src: std::array::from_fn(|i| i as u16 | CONSTANT),
        aux,
    };
    let frame = Frame::new(result.as_mut_ptr(), constants.as_ptr());
    // SAFETY: all twelve operands are constants 0 to 11, which exist; the destination
    // has four registers, and no result is wider. One lane: a register is one f32.
    unsafe { (info.kernels.scalar)(frame, &word) };
    result
}

/// Looks one point up in a table.
pub fn look_up(table: &Table, x: f32) -> [f32; 4] {
    tables::look_up(table, &[x]).map(|[y]| y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plain_and_loop_forms() {
        assert_eq!(
            apply(OpCode::math_multiply_add, 0, &[2.0, 3.0, 4.0])[0],
            10.0
        );
        assert_eq!(apply(OpCode::series_of_halves, 0, &[1.0, 3.9])[0], 1.75);
        assert_eq!(apply(OpCode::series_of_halves, 0, &[1.0, f32::NAN])[0], 0.0);
    }
}
