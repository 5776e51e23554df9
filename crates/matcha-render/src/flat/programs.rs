//! Programs of all materials, the world and lights.

use super::{Section, sections};
use crate::closure::code;
use crate::device::program_view::{
    PROGRAM_TABLE, PROGRAM_TEXTURE, ProgramClosure, ProgramHead, ProgramRegion, ProgramTable,
    ProgramValue, ProgramView,
};
use crate::node_cache::value_kind;
use matcha_cache::node_seed;
use matcha_shade::program::{Program, Region, Word, special};

/// What [`ProgramView`] reads.
#[derive(Default)]
pub struct FlatPrograms {
    heads: Vec<ProgramHead>,
    words: Vec<u32>,
    constants: Vec<f32>,
    outputs: Vec<u32>,
    closures: Vec<ProgramClosure>,
    regions: Vec<ProgramRegion>,
    values: Vec<ProgramValue>,
    tables: Vec<ProgramTable>,
    samples: Vec<f32>,
    /// Codes of the operations that occur.
    operations: Vec<u16>,
    registers: usize,
    looks: u32,
}

impl FlatPrograms {
    /// Programs in the order in which heads shall be numbered; the number is the `material` of
    /// a cache key.
    pub fn new<'p>(programs: impl IntoIterator<Item = &'p Program>) -> Self {
        let mut flat = Self::default();
        for program in programs {
            flat.add(program);
        }
        flat.operations.sort_unstable();
        flat.operations.dedup();
        flat
    }

    /// Codes of the operations that occur, ascending.
    pub fn operations(&self) -> &[u16] {
        &self.operations
    }

    /// Registers that the largest program needs.
    pub fn registers(&self) -> usize {
        self.registers
    }

    /// Most output rows of a program.
    pub fn output_rows(&self) -> u32 {
        self.heads
            .iter()
            .map(|head| head.outputs)
            .max()
            .unwrap_or(0)
    }

    /// Most rows of cached values of a program.
    pub fn cached_rows(&self) -> u32 {
        let rows = self.heads.iter().map(|head| head.cached_rows);
        rows.max().unwrap_or(0)
    }

    /// Most regions of a program.
    pub fn most_regions(&self) -> u32 {
        self.heads
            .iter()
            .map(|head| head.regions)
            .max()
            .unwrap_or(0)
    }

    /// Number of programs.
    pub fn count(&self) -> usize {
        self.heads.len()
    }

    /// Regions of all programs.
    pub fn regions(&self) -> usize {
        self.regions.len()
    }

    fn add(&mut self, program: &Program) {
        let first = self.words.len() as u32 / 8;
        let material = self.heads.len() as u32;
        let mut head = ProgramHead {
            rest: first + program.rest() as u32,
            end: first + program.words().len() as u32,
            first_constant: self.constants.len() as u32,
            first_output: self.outputs.len() as u32,
            outputs: program.outputs().len() as u32,
            first_closure: self.closures.len() as u32,
            closures: program.closures.len() as u32,
            first_region: self.regions.len() as u32,
            regions: program.regions().len() as u32,
            cached_rows: 0,
            emits: program.has_emission().into(),
        };
        for region in program.regions() {
            self.add_region(program, region, material, first, &mut head.cached_rows);
        }
        for word in program.words() {
            self.add_word(program, word);
        }
        self.constants.extend(program.constants());
        self.outputs
            .extend(program.outputs().iter().map(|&o| u32::from(o)));
        self.closures
            .extend(program.closures.iter().map(|c| ProgramClosure {
                kind: code(c.kind),
                first_row: c.first_row as u32,
            }));
        for table in program.tables() {
            self.tables.push(ProgramTable {
                first: self.samples.len() as u32,
                length: table.rows[0].len() as u32,
                rows: table.rows.len() as u32,
                interpolates: table.interpolate.into(),
                extrapolates: table.extrapolate.into(),
            });
            self.samples.extend(table.rows.iter().flatten());
        }
        self.looks += program.textures().len() as u32;
        self.registers = self.registers.max(program.slots());
        self.heads.push(head);
    }

    fn add_region(
        &mut self,
        program: &Program,
        region: &Region,
        material: u32,
        first: u32,
        rows: &mut u32,
    ) {
        let body = region.body();
        self.regions.push(ProgramRegion {
            first: first + body.start as u32,
            end: first + body.end as u32,
            texel: program.words()[region.words.start].dst.into(),
            uv: region.uv_set.into(),
            first_value: self.values.len() as u32,
            values: region.values.len() as u32,
        });
        for (store, value) in region.stores().zip(&region.values) {
            let seeds = [0, 1, 2].map(|part| node_seed(material, value.node, part));
            let width = value.ty.width() as u32;
            self.values.push(ProgramValue {
                kind: value_kind(value).code(),
                width,
                result: value.result.into(),
                first_row: *rows,
                store: first + store as u32,
                seeds: std::array::from_fn(|k| {
                    let seed = &seeds[k / 3];
                    [seed.a, seed.b, seed.own][k % 3]
                }),
            });
            *rows += width;
        }
    }

    fn add_word(&mut self, program: &Program, word: &Word) {
        let (op, width, immediate) = match word.op {
            special::TEXTURE => (PROGRAM_TEXTURE, 4, self.looks + word.aux),
            special::TABLE => {
                let table = self.tables.len() as u32 + word.aux;
                let rows = program.tables()[word.aux as usize].rows.len();
                (PROGRAM_TABLE, rows as u32, table)
            }
            // Regions are entered and left by the kernels.
            special::LOOKUP | special::STORE => (0xfff, 0, 0),
            op => {
                self.operations.push(op);
                let width = word.operation().map_or(0, |op| op.info().result.width());
                (u32::from(op), width as u32, word.aux)
            }
        };
        self.words
            .push(op | width << 12 | u32::from(word.dst) << 16);
        let pairs = word.src.chunks_exact(2);
        self.words
            .extend(pairs.map(|pair| u32::from(pair[0]) | u32::from(pair[1]) << 16));
        self.words.push(immediate);
    }

    /// The view that device code reads.
    pub fn view(&self) -> ProgramView<'_> {
        ProgramView {
            heads: &self.heads,
            words: &self.words,
            constants: &self.constants,
            outputs: &self.outputs,
            closures: &self.closures,
            regions: &self.regions,
            values: &self.values,
            tables: &self.tables,
            samples: &self.samples,
        }
    }

    /// The view's fields.
    pub fn sections(&self) -> Vec<Section<'_>> {
        sections!(self, ProgramView: heads words constants outputs closures regions values tables samples;)
    }
}
