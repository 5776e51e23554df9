//! Programs of all materials in a few arrays, as graphics devices read them; `flat` makes them.

use bytemuck::{Pod, Zeroable};
use glam::Vec2;
use matcha_cache::device::key_hash::{KeyHash, NodeSeed, hash_texel};
use matcha_shade::device::ramp::{ramp_mix, ramp_place};
use matcha_shade::device::texel::{texel_index, texel_level};

/// Words of an instruction in `words`: operation, width of the result and first register of
/// it; twelve operands in six words; the immediate.
pub const PROGRAM_WORD: u32 = 8;
/// Bit of an operand that names a constant instead of a register.
pub const PROGRAM_CONSTANT: u32 = 0x8000;
/// Operation that samples image look-up `immediate` at (uv, change along both axes).
pub const PROGRAM_TEXTURE: u32 = 0xff0;
/// Operation that reads ramp or curve `immediate`.
pub const PROGRAM_TABLE: u32 = 0xff1;

/// Where a program's parts are.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct ProgramHead {
    /// First instruction after the regions, counted in all programs' instructions.
    pub rest: u32,
    /// One past the last instruction.
    pub end: u32,
    /// Into `constants`.
    pub first_constant: u32,
    /// Into `outputs`.
    pub first_output: u32,
    /// Number of output rows.
    pub outputs: u32,
    /// Into `closures`.
    pub first_closure: u32,
    /// Number of closures.
    pub closures: u32,
    /// Into `regions`.
    pub first_region: u32,
    /// Number of regions.
    pub regions: u32,
    /// Rows that all values of all regions take.
    pub cached_rows: u32,
    /// Some closure may emit: 0 or 1.
    pub emits: u32,
}

/// Where a closure's rows are among the outputs.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct ProgramClosure {
    /// Which: a closure code.
    pub kind: u32,
    /// Output row of its weight.
    pub first_row: u32,
}

/// The cacheable nodes of a program that depend on one UV set.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct ProgramRegion {
    /// First instruction that computes the values.
    pub first: u32,
    /// One past the last of them.
    pub end: u32,
    /// Register that takes the texel's centre (2) and the footprint's edge.
    pub texel: u32,
    /// Name of the UV set.
    pub uv: u32,
    /// Into `values`.
    pub first_value: u32,
    /// Number of values.
    pub values: u32,
}

/// A cacheable node.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct ProgramValue {
    /// How it is packed: a `VALUE_` kind.
    pub kind: u32,
    /// Components.
    pub width: u32,
    /// First register of it.
    pub result: u32,
    /// First row of it among the program's cached rows.
    pub first_row: u32,
    /// Its `store` instruction, whose operands are the components.
    pub store: u32,
    /// Seeds of the keys of the words that it is packed into: a, b, own of each.
    pub seeds: [u32; 9],
}

/// A ramp or curve.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct ProgramTable {
    /// Into `samples`: the first component's first sample; components follow one another.
    pub first: u32,
    /// Samples of a component.
    pub length: u32,
    /// Components.
    pub rows: u32,
    /// 1: linear between samples.
    pub interpolates: u32,
    /// 1: the slope at the border goes on outside of [0, 1].
    pub extrapolates: u32,
}

/// All programs: those of materials in the scene's order, then the world's, then lights'.
#[derive(Clone, Copy, Debug)]
pub struct ProgramView<'a> {
    /// The programs.
    pub heads: &'a [ProgramHead],
    /// Instructions, [`PROGRAM_WORD`] words each.
    pub words: &'a [u32],
    /// Constants.
    pub constants: &'a [f32],
    /// The operand that each output row is read from.
    pub outputs: &'a [u32],
    /// Closures.
    pub closures: &'a [ProgramClosure],
    /// Regions.
    pub regions: &'a [ProgramRegion],
    /// Values of regions.
    pub values: &'a [ProgramValue],
    /// Ramps and curves.
    pub tables: &'a [ProgramTable],
    /// Their samples.
    pub samples: &'a [f32],
}

/// A virtual texel.
#[derive(Clone, Copy, Debug)]
pub struct ProgramTexel {
    /// λ; larger is finer.
    pub level: i32,
    /// Position along u, in texels.
    pub i: i32,
    /// Position along v, in texels.
    pub j: i32,
}

/// The virtual texel at a place whose footprint has the half axes `a` and `b`;
/// `scale_squared` is 4^−offset.
#[inline]
pub fn program_texel(uv: Vec2, a: Vec2, b: Vec2, scale_squared: f32) -> ProgramTexel {
    let level = texel_level(a, b, scale_squared);
    ProgramTexel {
        level,
        i: texel_index(uv.x, level),
        j: texel_index(uv.y, level),
    }
}

/// Hashes of word `part` of a value at a texel.
#[inline]
pub fn program_key(view: ProgramView, value: u32, part: u32, texel: ProgramTexel) -> KeyHash {
    let seed = NodeSeed {
        a: view.values[value as usize].seeds[(3 * part) as usize],
        b: view.values[value as usize].seeds[(3 * part + 1) as usize],
        own: view.values[value as usize].seeds[(3 * part + 2) as usize],
    };
    hash_texel(seed, texel.level, texel.i, texel.j)
}

/// A ramp or curve at `x`; components that it lacks are 0.
#[inline]
pub fn program_ramp(view: ProgramView, index: u32, x: f32) -> [f32; 4] {
    let table = view.tables[index as usize];
    let interpolates = table.interpolates != 0;
    let place = ramp_place(table.length - 1, interpolates, table.extrapolates != 0, x);
    let mut value = [0.0, 0.0, 0.0, 0.0];
    let mut row = 0;
    while row < table.rows {
        let start = table.first + row * table.length;
        let a = view.samples[(start + place.first) as usize];
        let b = view.samples[(start + place.second) as usize];
        value[row as usize] = ramp_mix(a, b, place.t, interpolates);
        row += 1;
    }
    value
}

/// A program's head.
#[inline]
pub fn program_head(view: ProgramView, program: u32) -> ProgramHead {
    view.heads[program as usize]
}

/// A region by its number among all programs'.
#[inline]
pub fn program_region(view: ProgramView, region: u32) -> ProgramRegion {
    view.regions[region as usize]
}

/// A value by its number among all programs'.
#[inline]
pub fn program_value(view: ProgramView, value: u32) -> ProgramValue {
    view.values[value as usize]
}

/// A closure by its number among all programs'.
#[inline]
pub fn program_closure(view: ProgramView, closure: u32) -> ProgramClosure {
    view.closures[closure as usize]
}

/// The operand that an output row is read from, by its number among all programs'.
#[inline]
pub fn program_output(view: ProgramView, row: u32) -> u32 {
    view.outputs[row as usize]
}
