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

impl Place {
    /// Its bits in the masks of a look-up.
    fn mask(&self) -> u16 {
        ((1 << self.kind.words()) - 1) << self.first_seed
    }
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
        let shared = self.keys.regions[number]
            .iter()
            .zip(&self.layout.regions[number]);
        for (keys, cells) in shared {
            self.table.look_up_prepared(keys, &cells.seeds, self.found);
            for value in &cells.values {
                let words: [&[u32]; MOST_WORDS] = std::array::from_fn(|part| {
                    let part = part.min(value.kind.words() - 1);
                    self.found.words(value.first_seed + part)
                });
                for component in 0..value.kind.width() {
                    let row = &mut out.row_mut(value.first_row + component)[..n];
                    value.kind.decode_component(component, &words, row);
                }
                let mask = value.mask();
                let mut hits = 0;
                let masks = self.found.masks().iter();
                for ((found, nodes), bits) in
                    found.iter_mut().zip(&mut *self.found_nodes).zip(masks)
                {
                    let hit = bits & mask == mask;
                    *found &= hit;
                    *nodes += f32::from(u8::from(hit));
                    hits += u64::from(hit);
                }
                self.counts.hits += hits;
            }
        }
        self.counts.lookups += (n * region.values.len()) as u64;
    }

    fn store(&mut self, region: &Region, _: &Texels, which: &[u32], values: &mut Rows) {
        let number = region.number as usize;
        let shared = self.keys.regions[number]
            .iter()
            .zip(&self.layout.regions[number]);
        for (keys, cells) in shared {
            for (k, &at) in which.iter().enumerate() {
                for value in &cells.values {
                    let rows = value.first_row..value.first_row + value.kind.width();
                    let mut computed = [0.0; 4];
                    for (number, row) in computed.iter_mut().zip(rows.clone()) {
                        *number = values.row(row)[k];
                    }
                    let Some(words) = value.kind.encode(computed) else {
                        self.counts.unencodable += 1;
                        continue;
                    };
                    for part in 0..value.kind.words() {
                        let seed = cells.seeds[value.first_seed + part];
                        self.table.insert_prepared(
                            keys,
                            at as usize,
                            seed,
                            words[part],
                            self.counts,
                        );
                    }
                    for (number, row) in value.kind.decode(words).into_iter().zip(rows) {
                        values.row_mut(row)[k] = number;
                    }
                }
            }
        }
    }
}
