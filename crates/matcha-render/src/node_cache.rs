//! The machine's cache of node values, on top of the shared table.

use matcha_cache::{CacheCounts, MOST_WORDS, NodeSeed, Table, ValueKind, node_seed};
use matcha_shade::graph::Encoding;
use matcha_shade::program::Region;
use matcha_shade::vm::{NodeCache, Rows, Texel};

/// One thread's view of the table while it runs the program of one material.
pub struct MaterialCache<'a> {
    table: &'a Table,
    material: u32,
    /// Found nodes of each hit of the group, for the heat map.
    found_nodes: &'a mut [f32],
    counts: &'a mut CacheCounts,
    scratch: &'a mut Scratch,
}

/// Buffers that outlive a group.
#[derive(Debug, Default)]
pub struct Scratch {
    words: [Vec<u32>; MOST_WORDS],
    part_found: Vec<bool>,
}

impl<'a> MaterialCache<'a> {
    /// Prepares for a group of `found_nodes.len()` hits on `material`.
    pub fn new(
        table: &'a Table,
        material: u32,
        found_nodes: &'a mut [f32],
        counts: &'a mut CacheCounts,
        scratch: &'a mut Scratch,
    ) -> Self {
        Self {
            table,
            material,
            found_nodes,
            counts,
            scratch,
        }
    }

    fn seed(&self, region: &Region, part: usize) -> NodeSeed {
        node_seed(self.material, region.node, part as u32)
    }
}

fn coordinates(texel: &Texel) -> [i32; 3] {
    [texel.level, texel.i, texel.j]
}

fn kind(region: &Region) -> ValueKind {
    match (region.encoding, region.ty.width()) {
        (Encoding::Scalar, _) => ValueKind::Scalar,
        (Encoding::Gradient, _) => ValueKind::Pair,
        (Encoding::Vector, 2) => ValueKind::Coordinates2,
        (Encoding::Vector, _) => ValueKind::Vector,
        (Encoding::Normal, _) => ValueKind::Normal,
        (Encoding::Color, 4) => ValueKind::ColorAlpha,
        (Encoding::Color, _) => ValueKind::Color,
    }
}

impl NodeCache for MaterialCache<'_> {
    fn look_up(&mut self, region: &Region, texels: &[Texel], out: &mut Rows, found: &mut [bool]) {
        let kind = kind(region);
        let n = texels.len();
        for part in 0..kind.words() {
            let seed = self.seed(region, part);
            let words = &mut self.scratch.words[part];
            words.resize(n, 0);
            self.scratch.part_found.resize(n, false);
            let here = if part == 0 {
                &mut *found
            } else {
                &mut self.scratch.part_found[..]
            };
            self.table
                .look_up_batch(seed, |k| coordinates(&texels[k]), words, here, self.counts);
            if part > 0 {
                for (all, &one) in found.iter_mut().zip(&self.scratch.part_found) {
                    *all &= one;
                }
            }
        }
        let words: [&[u32]; MOST_WORDS] = std::array::from_fn(|p| &self.scratch.words[p][..]);
        for component in 0..kind.width() {
            kind.decode_component(component, &words, &mut out.row_mut(component)[..n]);
        }
        for (count, &found) in self.found_nodes.iter_mut().zip(&*found) {
            *count += f32::from(u8::from(found));
        }
    }

    fn store(&mut self, region: &Region, texels: &[Texel], which: &[u32], values: &Rows) {
        let kind = kind(region);
        for (k, &at) in which.iter().enumerate() {
            let texel = &texels[at as usize];
            let mut value = [0.0; 4];
            for (component, value) in value.iter_mut().enumerate().take(kind.width()) {
                *value = values.row(component)[k];
            }
            let Some(words) = kind.encode(value) else {
                self.counts.unencodable += 1;
                continue;
            };
            for (part, &word) in words.iter().enumerate().take(kind.words()) {
                let seed = self.seed(region, part);
                self.table
                    .insert(seed, coordinates(texel), word, self.counts);
            }
        }
    }
}
