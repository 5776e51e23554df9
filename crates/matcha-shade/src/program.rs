//! A compiled material: fixed-width words in execution order.
//!
//! First come the regions, one for each UV set that cacheable nodes depend on: `lookup`,
//! the words of all these nodes, a `store` for each. A region reads only its virtual texel
//! and constants and leaves only its nodes' values, so a hit that skips it leaves nothing
//! undefined. Then come the other words.

mod disassemble;
mod verify;

pub use verify::ProgramError;

use crate::closure::{ClosureKind, Ty};
use crate::graph::{Encoding, Table, TextureRef};
use crate::input::Input;
use crate::material::MaterialKind;
use crate::ops::OpCode;
use crate::vm::kernel::LANES;
use std::ops::Range;

/// Bit of an operand that names a constant row instead of a register.
pub const CONSTANT: u16 = 0x8000;

/// Word codes that are not operations of the table.
pub mod special {
    /// Image `aux` at (uv, da, db); four results.
    pub const TEXTURE: u16 = 0xff00;
    /// Table `aux` at one operand; as many results as the table has rows.
    pub const TABLE: u16 = 0xff01;
    /// Region `aux` begins. Where the cache has all of its values, their registers are set
    /// and the words up to and with the region's last `store` are skipped. Otherwise `dst`
    /// and the two registers after it become the texel's centre (u, v) and its size.
    pub const LOOKUP: u16 = 0xff02;
    /// Last words of region `aux`, one for each of its values in their order: the operands
    /// are stored and copied to `dst`, the first of the value's registers.
    pub const STORE: u16 = 0xff03;
}

/// One instruction, 32 bytes.
#[repr(C, align(32))]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Word {
    /// An operation's index in the table, or one of [`special`].
    pub op: u16,
    /// First register of the result.
    pub dst: u16,
    /// A register or, with [`CONSTANT`], a constant, for each component of the operands.
    pub src: [u16; 12],
    /// Immediate.
    pub aux: u32,
}

/// The cacheable nodes of a program that depend on the same UV set. They have the same
/// virtual texel, so that one key is made for all, and what they share is computed once.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// Number in the program.
    pub number: u32,
    /// The UV set that it depends on.
    pub uv_set: u16,
    /// The cacheable nodes, at least one.
    pub values: Vec<CachedValue>,
    /// Its words, from `lookup` to after the last `store`.
    pub words: Range<usize>,
    /// First input rows of its UV set: value, change along axis A, along axis B.
    pub uv_rows: [usize; 3],
    /// Estimated cost of evaluating all values, ns a point.
    pub cost: f32,
}

/// A cacheable node.
#[derive(Clone, Debug, PartialEq)]
pub struct CachedValue {
    /// The `node` of a cache key. Unique in the program; a region's are consecutive and
    /// begin at a multiple of [`NODES_ALIGNED`].
    pub node: u32,
    /// Type of its value.
    pub ty: Ty,
    /// How its value is packed.
    pub encoding: Encoding,
    /// First register of the value.
    pub result: u16,
    /// Estimated cost of evaluating it alone, ns a point.
    pub cost: f32,
}

/// Numbers of a region's nodes begin at a multiple of this, so that a cache may keep
/// consecutive ones together without mixing regions.
pub const NODES_ALIGNED: u32 = 16;

impl Region {
    /// Components of all values.
    pub fn width(&self) -> usize {
        self.values.iter().map(|value| value.ty.width()).sum()
    }

    /// The words between `lookup` and the first `store`.
    pub fn body(&self) -> Range<usize> {
        self.words.start + 1..self.stores().start
    }

    /// The `store` words.
    pub fn stores(&self) -> Range<usize> {
        self.words.end - self.values.len()..self.words.end
    }
}

/// Where a closure's rows are in the output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClosureOutput {
    /// Which closure: its parameters follow its weight.
    pub kind: ClosureKind,
    /// Row of the weight's first component.
    pub first_row: usize,
}

/// One splatted constant.
#[repr(C, align(64))]
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
pub(crate) struct Splat(pub(crate) [f32; LANES]);

/// A program, verified.
#[derive(Clone, Debug)]
pub struct Program {
    /// The material's name.
    pub name: String,
    /// What it belongs to.
    pub kind: MaterialKind,
    /// What it reads, with the first row of each in the input matrix.
    pub inputs: Vec<(Input, usize)>,
    /// Rows of the input matrix.
    pub(crate) input_rows: usize,
    /// Those that the words after the regions read; they are loaded into the registers of
    /// the same number. The others are for texels only.
    pub(crate) loads: Vec<u16>,
    /// The words: regions first.
    pub(crate) words: Vec<Word>,
    /// Registers that the machine needs.
    pub(crate) slots: usize,
    /// Regions, in the order of their words.
    pub(crate) regions: Vec<Region>,
    /// Constants by index.
    pub(crate) constants: Vec<f32>,
    /// Images by index.
    pub(crate) textures: Vec<TextureRef>,
    /// Ramps and curves by index.
    pub(crate) tables: Vec<Table>,
    /// Closures in order.
    pub closures: Vec<ClosureOutput>,
    /// The operand (register or constant) that each output row is read from.
    pub(crate) outputs: Vec<u16>,
    /// Estimated cost without the cache, ns a point.
    pub cost: f32,
    pub(crate) splats: Vec<Splat>,
}

// What the machine relies on is read-only outside of the crate: a program that exists
// has passed the verifier.
impl Program {
    /// The words: regions first.
    pub fn words(&self) -> &[Word] {
        &self.words
    }

    /// Registers that the machine needs.
    pub fn slots(&self) -> usize {
        self.slots
    }

    /// Regions, in the order of their words.
    pub fn regions(&self) -> &[Region] {
        &self.regions
    }

    /// Constants by index.
    pub fn constants(&self) -> &[f32] {
        &self.constants
    }

    /// Images by index.
    pub fn textures(&self) -> &[TextureRef] {
        &self.textures
    }

    /// Ramps and curves by index.
    pub fn tables(&self) -> &[Table] {
        &self.tables
    }

    /// The operand (register or constant) that each output row is read from.
    pub fn outputs(&self) -> &[u16] {
        &self.outputs
    }

    /// Rows of the input matrix that the words after the regions read, from the registers of
    /// the same number.
    pub fn loads(&self) -> &[u16] {
        &self.loads
    }

    /// Rows of the input matrix. Each has the register of its number to itself until the
    /// words after the regions have read it.
    pub fn input_rows(&self) -> usize {
        self.input_rows
    }

    /// Rows of the output matrix.
    pub fn output_rows(&self) -> usize {
        self.outputs.len()
    }

    /// The first input row of a quantity, if the program reads it.
    pub fn input_row(&self, input: Input) -> Option<usize> {
        self.inputs
            .iter()
            .find(|(i, _)| *i == input)
            .map(|(_, row)| *row)
    }

    /// Number of cacheable nodes.
    pub fn cacheable(&self) -> usize {
        self.regions.iter().map(|region| region.values.len()).sum()
    }

    /// First word after the regions.
    pub fn rest(&self) -> usize {
        self.regions.last().map_or(0, |r| r.words.end)
    }

    /// Whether any closure emits light that is not known to be black.
    pub fn has_emission(&self) -> bool {
        self.closures.iter().any(|c| match c.kind {
            ClosureKind::Emission | ClosureKind::Background => {
                self.may_differ(c.first_row..c.first_row + 3, 0.0)
            }
            ClosureKind::Principled(_) => {
                let strength = self.parameter_rows(c, "emission_strength");
                let color = self.parameter_rows(c, "emission_color");
                self.may_differ(strength, 0.0) && self.may_differ(color, 0.0)
            }
            _ => false,
        })
    }

    /// Whether light may pass straight through, so that shadow rays must evaluate it.
    pub fn has_transparency(&self) -> bool {
        self.closures.iter().any(|c| match c.kind {
            ClosureKind::Transparent | ClosureKind::Holdout => true,
            ClosureKind::Principled(_) => self.may_differ(self.parameter_rows(c, "alpha"), 1.0),
            _ => false,
        })
    }

    /// Output rows of a closure's parameter.
    ///
    /// # Panics
    /// If the closure has no parameter of that name.
    pub fn parameter_rows(&self, closure: &ClosureOutput, name: &str) -> Range<usize> {
        let mut row = closure.first_row + 3;
        for parameter in closure.kind.parameters() {
            let rows = row..row + parameter.ty.width();
            if parameter.name == name {
                return rows;
            }
            row = rows.end;
        }
        panic!("{:?} has no parameter {name}", closure.kind)
    }

    /// The constant that an output row always has, if it is one.
    pub fn constant_output(&self, row: usize) -> Option<f32> {
        let operand = self.outputs[row];
        (operand & CONSTANT != 0).then(|| self.constants[(operand & !CONSTANT) as usize])
    }

    /// The input rows that the words after the regions, and the outputs, read.
    pub(crate) fn find_loads(&self) -> Vec<u16> {
        let mut waiting = vec![true; self.input_rows];
        let mut loads = Vec::new();
        let mut read = |waiting: &mut [bool], operand: u16| {
            // A constant's number is above all registers'.
            if waiting.get(operand as usize) == Some(&true) {
                waiting[operand as usize] = false;
                loads.push(operand);
            }
        };
        for word in &self.words[self.rest()..] {
            let (operands, results) = verify::shape(self, word).unwrap_or((0, 0));
            for &operand in &word.src[..operands] {
                read(&mut waiting, operand);
            }
            let written = word.dst as usize..word.dst as usize + results;
            let written = written.start.min(self.input_rows)..written.end.min(self.input_rows);
            waiting[written].fill(false);
        }
        for &operand in &self.outputs {
            read(&mut waiting, operand);
        }
        loads
    }

    fn may_differ(&self, mut rows: Range<usize>, from: f32) -> bool {
        rows.any(|row| self.constant_output(row) != Some(from))
    }

    /// Bytes of the program's words, constants and tables.
    pub fn bytes(&self) -> usize {
        let tables: usize = self.tables.iter().flat_map(|t| &t.rows).map(Vec::len).sum();
        size_of_val(&self.words[..]) + size_of_val(&self.splats[..]) + tables * size_of::<f32>()
    }
}

impl Word {
    /// The word's operation, unless it is special.
    pub fn operation(&self) -> Option<OpCode> {
        (self.op < special::TEXTURE).then_some(OpCode(self.op))
    }
}
