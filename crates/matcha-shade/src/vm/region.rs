//! A region over a group: one look-up for all points, then its words over those of which
//! a value was not found.

use crate::program::Region;
use crate::rows::Rows;
use crate::vm::core::Core;
use crate::vm::texels::Texels;
use crate::vm::{NodeCache, RunCounts};

/// Scratch memory of the regions of a run.
#[derive(Default)]
pub(super) struct Cached {
    /// Values of each region, over the whole group.
    pub(super) results: Vec<Rows>,
    /// Values of the points that were not found, without gaps.
    computed: Rows,
    found: Vec<bool>,
    missed: Vec<u32>,
}

impl Cached {
    /// Has a place for each region's values; kept from run to run.
    pub(super) fn prepare(&mut self, regions: usize) {
        if self.results.len() < regions {
            self.results.resize_with(regions, Rows::default);
        }
    }

    /// Finds or computes a region's values for every point.
    pub(super) fn run<const N: usize>(
        &mut self,
        region: &Region,
        texels: &Texels,
        core: &mut Core<N>,
        cache: Option<&mut dyn NodeCache>,
        counts: &mut RunCounts,
    ) {
        let n = texels.len();
        self.results[region.number as usize].resize(region.width(), n);
        self.missed.clear();
        let Some(cache) = cache else {
            self.missed.extend(0..n as u32);
            self.evaluate(region, texels, core);
            self.scatter(region);
            return;
        };
        self.found.clear();
        self.found.resize(n, false);
        let values = &mut self.results[region.number as usize];
        cache.look_up(region, texels, values, &mut self.found);
        let found = &self.found;
        self.missed
            .extend((0..n as u32).filter(|&i| !found[i as usize]));
        counts.look_ups += n as u64;
        counts.found += (n - self.missed.len()) as u64;
        if self.missed.is_empty() {
            return;
        }
        self.evaluate(region, texels, core);
        cache.store(region, texels, &self.missed, &mut self.computed);
        self.scatter(region);
    }

    /// Runs the region's words over the missed points' texels.
    fn evaluate<const N: usize>(&mut self, region: &Region, texels: &Texels, core: &mut Core<N>) {
        let texel = core.word(region.words.start).dst as usize;
        self.computed.resize(region.width(), self.missed.len());
        for (chunk, which) in self.missed.chunks(N).enumerate() {
            let mut rows = [[0.0f32; N]; 3];
            for (lane, &k) in which.iter().enumerate() {
                [rows[0][lane], rows[1][lane], rows[2][lane]] = texels.centre(k as usize);
            }
            for (i, row) in rows.iter().enumerate() {
                core.load(texel + i, row, which.len());
            }
            core.execute(region.body(), which.len());
            let mut to = self.computed.rows_mut(0, region.width());
            for (store, value) in region.stores().zip(&region.values) {
                let operands = core.word(store).src;
                for (&operand, row) in operands[..value.ty.width()].iter().zip(&mut to) {
                    row[chunk * N..][..N].copy_from_slice(core.value(operand));
                }
            }
        }
    }

    /// From the missed points' columns to the group's.
    fn scatter(&mut self, region: &Region) {
        let results = &mut self.results[region.number as usize];
        for i in 0..region.width() {
            let from = self.computed.row(i);
            let to = results.row_mut(i);
            for (&value, &point) in from.iter().zip(&self.missed) {
                to[point as usize] = value;
            }
        }
    }
}
