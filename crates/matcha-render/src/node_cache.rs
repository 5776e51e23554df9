//! The machine's cache of node values, on top of the shared table.

use matcha_cache::{
    CacheCounts, Found, Keys, MOST_WORDS, NODES_A_CELL, NodeSeed, Table, ValueKind, node_seed,
};
use matcha_shade::graph::Encoding;
use matcha_shade::program::{CachedValue, Program, Region};
use matcha_shade::vm::{NodeCache, Rows, Texels};

/// How a program's values are laid into the table.
#[derive(Debug, Default)]
pub struct CacheLayout {
    /// For each region the values that share cells.
    regions: Vec<Vec<SharedCells>>,
}

/// Values of a region that are in the same cell at the same texel.
#[derive(Debug)]
struct SharedCells {
    /// One for each word of each value.
    seeds: Vec<NodeSeed>,
    values: Vec<Place>,
}

/// Where a value is among its cell's words and its region's rows.
#[derive(Debug)]
struct Place {
    kind: ValueKind,
    first_seed: usize,
    first_row: usize,
}

impl CacheLayout {
    /// The layout of a material's program.
    pub fn new(material: u32, program: &Program) -> Self {
        let regions = program.regions().iter();
        Self {
            regions: regions
                .map(|region| shared_cells(material, region))
                .collect(),
        }
    }
}

fn shared_cells(material: u32, region: &Region) -> Vec<SharedCells> {
    let mut row = 0;
    let same_cell =
        |a: &CachedValue, b: &CachedValue| a.node / NODES_A_CELL == b.node / NODES_A_CELL;
    let mut shared = Vec::new();
    for values in region.values.chunk_by(same_cell) {
        let mut cells = SharedCells {
            seeds: Vec::new(),
            values: Vec::new(),
        };
        for value in values {
            let kind = value_kind(value);
            cells.values.push(Place {
                kind,
                first_seed: cells.seeds.len(),
                first_row: row,
            });
            let parts = 0..kind.words() as u32;
            let seed = |part| node_seed(material, value.node, part);
            cells.seeds.extend(parts.map(seed));
            row += kind.width();
        }
        shared.push(cells);
    }
    shared
}

/// How a value is packed.
pub(crate) fn value_kind(value: &CachedValue) -> ValueKind {
    match (value.encoding, value.ty.width()) {
        (Encoding::Scalar, _) => ValueKind::Scalar,
        (Encoding::Gradient, _) => ValueKind::Pair,
        (Encoding::Vector, 2) => ValueKind::Coordinates2,
        (Encoding::Vector, _) => ValueKind::Vector,
        (Encoding::Normal, _) => ValueKind::Normal,
        (Encoding::Color, 4) => ValueKind::ColorAlpha,
        (Encoding::Color, _) => ValueKind::Color,
    }
}

/// The keys of a group of hits.
#[derive(Debug, Default)]
pub struct GroupKeys {
    /// For each region those of its shared cells.
    regions: Vec<Vec<Keys>>,
}

impl GroupKeys {
    /// Hashes the texels of every region and asks memory for their cells, which are best
    /// looked at some time later.
    pub fn prepare(&mut self, table: &Table, layout: &CacheLayout, texels: &[Texels]) {
        if self.regions.len() < layout.regions.len() {
            self.regions.resize_with(layout.regions.len(), Vec::new);
        }
        for ((all, shared), texels) in self.regions.iter_mut().zip(&layout.regions).zip(texels) {
            if all.len() < shared.len() {
                all.resize_with(shared.len(), Keys::default);
            }
            for (keys, cells) in all.iter_mut().zip(shared) {
                table.prepare(cells.seeds[0], texels.rows(), keys);
            }
        }
    }
}

/// One thread's view of the table while it runs the program of one material.
pub struct MaterialCache<'a> {
    /// The table.
    pub table: &'a Table,
    /// Where the program's values are in it.
    pub layout: &'a CacheLayout,
    /// The group's keys.
    pub keys: &'a GroupKeys,
    /// Found nodes of each hit of the group, for the heat map.
    pub found_nodes: &'a mut [f32],
    /// Statistics.
    pub counts: &'a mut CacheCounts,
    /// A buffer that outlives a group.
    pub found: &'a mut Found,
}

impl NodeCache for MaterialCache<'_> {
    fn look_up(&mut self, region: &Region, texels: &Texels, out: &mut Rows, found: &mut [bool]) {
        let n = texels.len();
        let number = region.number as usize;
        found.fill(true);
        let keys = &self.keys.regions[number];
        for (keys, cells) in keys.iter().zip(&self.layout.regions[number]) {
            self.table.look_up_prepared(keys, &cells.seeds, self.found);
            for place in &cells.values {
                place.decode(self.found, out, n);
                self.counts.hits += place.note(self.found, found, self.found_nodes);
            }
        }
        self.counts.lookups += (n * region.values.len()) as u64;
    }

    fn store(&mut self, region: &Region, _: &Texels, which: &[u32], values: &mut Rows) {
        let number = region.number as usize;
        let keys = &self.keys.regions[number];
        for (keys, cells) in keys.iter().zip(&self.layout.regions[number]) {
            for (k, &at) in which.iter().enumerate() {
                for place in &cells.values {
                    let Some(words) = place.encode(values, k) else {
                        self.counts.unencodable += 1;
                        continue;
                    };
                    let seeds = &cells.seeds[place.first_seed..];
                    for (&word, &seed) in words[..place.kind.words()].iter().zip(seeds) {
                        let at = at as usize;
                        self.table
                            .insert_prepared(keys, at, seed, word, self.counts);
                    }
                }
            }
        }
    }
}

impl Place {
    /// The value's rows of a region from the words that a look-up gave.
    fn decode(&self, found: &Found, out: &mut Rows, n: usize) {
        let words: [&[u32]; MOST_WORDS] = std::array::from_fn(|part| {
            // Parts that the value does not have are not read.
            found.words(self.first_seed + part.min(self.kind.words() - 1))
        });
        for component in 0..self.kind.width() {
            let row = &mut out.row_mut(self.first_row + component)[..n];
            self.kind.decode_component(component, &words, row);
        }
    }

    /// Takes note of where the value was found; returns how often.
    fn note(&self, found: &Found, all: &mut [bool], nodes: &mut [f32]) -> u64 {
        let own = ((1 << self.kind.words()) - 1) << self.first_seed;
        let mut hits = 0;
        for ((all, nodes), bits) in all.iter_mut().zip(nodes).zip(found.masks()) {
            let hit = bits & own == own;
            *all &= hit;
            *nodes += f32::from(u8::from(hit));
            hits += u64::from(hit);
        }
        hits
    }

    /// The words of a value in column `k` of its region's rows, which is rounded as they are.
    fn encode(&self, values: &mut Rows, k: usize) -> Option<[u32; MOST_WORDS]> {
        let rows = self.first_row..self.first_row + self.kind.width();
        let mut value = [0.0; 4];
        for (number, row) in value.iter_mut().zip(rows.clone()) {
            *number = values.get(row, k);
        }
        let words = self.kind.encode(value)?;
        for (number, row) in self.kind.decode(words).into_iter().zip(rows) {
            values.set(row, k, number);
        }
        Some(words)
    }
}
