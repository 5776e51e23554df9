//! Twins of the stages of node networks: `wave_networks.wgsl` and `wave_sort.wgsl`.

use super::{Twin, queue};
use crate::wavefront::layout::*;
use crate::wavefront::slot_copy::SlotCopy;
use crate::wavefront::stages::Place;
use matcha_cache::device::value::{value_decode, value_encode};
use matcha_render::device::geometry_input::{
    geometry_background, geometry_input, geometry_quantity,
};
use matcha_render::device::program_view::{ProgramRegion, ProgramTexel, program_texel};
use matcha_render::device::surface_path::PathInfo;
use matcha_render::device::surface_point::SurfacePoint;
use matcha_render::flat::NO_PROGRAM;
use matcha_shade::device::input_code::{
    INPUT_PART_AXIS_A, INPUT_PART_AXIS_B, INPUT_PART_VALUE, INPUT_UV, input_pack,
};
use matcha_shade::program::{Program, Region};
use matcha_shade::vm::{NodeCache, Rows, Texel, Texels};
use std::collections::BTreeMap;

/// Rows of a miss, from that of its region on: level and position of its texel.
const MISS_LEVEL: u32 = MISS_REGION + 1;
const MISS_PROGRAM: u32 = MISS_REGION - 1;

impl Twin {
    /// The slots of a place by program; those without one are left out.
    fn by_program(&self, place: Place, slots: &SlotCopy) -> BTreeMap<u32, Vec<u32>> {
        let mut groups: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for &slot in slots.queue(place.queue()) {
            let program = self.program_at(place.at(), slots, slot);
            groups.entry(program).or_default().push(slot);
        }
        groups.remove(&NO_PROGRAM);
        groups
    }

    /// Puts a queue in the order of programs.
    pub(super) fn sort(&self, at: u32, number: u32, slots: &mut SlotCopy) {
        let mut sorted = queue(slots, number);
        sorted.sort_by_key(|&slot| self.program_at(at, slots, slot));
        for (k, slot) in (0..).zip(sorted) {
            slots.set_row_word("wave_queues", number, k, slot);
        }
    }

    /// Looks the cacheable nodes of every hit up, and finds none.
    pub(super) fn look_up(&self, place: Place, slots: &mut SlotCopy) {
        for (program, group) in self.by_program(place, slots) {
            for slot in group {
                let point = self.point(place.at(), slots, slot);
                for (number, region) in self.regions(program) {
                    let texel = self.texel(&region, &point);
                    push_miss(slots, [slot, program, number], texel);
                    slots.words_mut("wave_totals")[TOTAL_LOOK_UPS as usize] += region.values;
                }
            }
        }
    }

    /// The regions of a program with their numbers among all.
    fn regions(&self, program: u32) -> Vec<(u32, ProgramRegion)> {
        let view = self.scene.programs().view();
        let head = view.heads[program as usize];
        (head.first_region..head.first_region + head.regions)
            .map(|number| (number, view.regions[number as usize]))
            .collect()
    }

    /// The virtual texel of a region at a point.
    fn texel(&self, region: &ProgramRegion, point: &SurfacePoint) -> ProgramTexel {
        let part = |part| {
            let packed = input_pack(INPUT_UV, part, region.uv);
            geometry_quantity(self.scene.geometry(), point, packed).truncate()
        };
        let [uv, a, b] = [INPUT_PART_VALUE, INPUT_PART_AXIS_A, INPUT_PART_AXIS_B].map(part);
        program_texel(uv, a, b, (-2.0 * self.level_offset).exp2())
    }

    /// Evaluates what was not found, as a look-up would have given it.
    pub(super) fn misses(&mut self, slots: &mut SlotCopy) {
        let count = slots.words("wave_counts")[QUEUE_MISSES as usize];
        let mut groups: BTreeMap<(u32, u32), Vec<u32>> = BTreeMap::new();
        for k in 0..count {
            let key = (miss(slots, MISS_PROGRAM, k), miss(slots, MISS_REGION, k));
            groups.entry(key).or_default().push(k);
        }
        for ((program, region), group) in groups {
            self.compute_region(program, region, &group, slots);
        }
    }

    /// Evaluates a region at the texels of misses.
    fn compute_region(&mut self, program: u32, number: u32, misses: &[u32], slots: &mut SlotCopy) {
        let Some(source) = self.scene.program(program) else {
            return;
        };
        let texel = |&k: &u32| {
            let [level, i, j] = [0, 1, 2].map(|row| miss(slots, MISS_LEVEL + row, k) as i32);
            Texel { level, i, j }
        };
        let texels: Texels = misses.iter().map(texel).collect();
        let view = self.scene.programs().view();
        let region = view.regions[number as usize];
        let mut computed = Computed {
            region: number - view.heads[program as usize].first_region,
            values: Rows::default(),
        };
        // Of the rest, which runs too, nothing is kept.
        let inputs = Rows::new(source.input_rows(), misses.len());
        self.machine.run(
            source,
            misses.len(),
            &inputs,
            &vec![texels; source.regions().len()],
            self.scene.images(),
            Some(&mut computed),
            &mut Rows::default(),
        );
        let mut row = 0;
        for value in &view.values[region.first_value as usize..][..region.values as usize] {
            let width = value.width as usize;
            for (column, &k) in misses.iter().enumerate() {
                let number = |c| {
                    if c < width {
                        computed.values.get(row + c, column)
                    } else {
                        0.0
                    }
                };
                let rounded = rounded(value.kind, std::array::from_fn(number));
                let slot = miss(slots, 0, k);
                for (to, number) in (value.first_row..).zip(&rounded[..width]) {
                    slots.set_row_word("cached_rows", to, slot, number.to_bits());
                }
            }
            row += width;
        }
    }

    /// Evaluates programs, but for their regions, whose values are in the slots' rows.
    pub(super) fn evaluate(&mut self, place: Place, slots: &mut SlotCopy) {
        let at = place.at();
        for (program, group) in self.by_program(place, slots) {
            if place.on_surface() {
                self.run_surface(at, program, &group, slots);
            } else {
                let info = |&slot: &u32| (slot, self.info(at, slots, slot));
                let rays: Vec<_> = group.iter().map(info).collect();
                self.run_background(program, &rays, slots);
            }
        }
    }

    fn run_surface(&mut self, at: u32, program: u32, group: &[u32], slots: &mut SlotCopy) {
        let points: Vec<SurfacePoint> = group
            .iter()
            .map(|&slot| self.point(at, slots, slot))
            .collect();
        let view = self.scene.geometry();
        let input = |k: usize, packed| geometry_input(view, &points[k], packed);
        let Some(inputs) = self.inputs(program, group.len(), input) else {
            return;
        };
        self.finish(program, group, &inputs, slots);
    }

    /// Evaluates a program of the world or a light for rays, whose slots take the outputs.
    pub(super) fn run_background(
        &mut self,
        program: u32,
        rays: &[(u32, PathInfo)],
        slots: &mut SlotCopy,
    ) {
        let view = self.scene.geometry();
        let input = |k: usize, packed| geometry_background(view, rays[k].1, packed);
        let Some(inputs) = self.inputs(program, rays.len(), input) else {
            return;
        };
        let group: Vec<u32> = rays.iter().map(|(slot, _)| *slot).collect();
        self.finish(program, &group, &inputs, slots);
    }

    /// A program's input rows.
    fn inputs(
        &self,
        program: u32,
        points: usize,
        input: impl Fn(usize, u32) -> [f32; 4],
    ) -> Option<Rows> {
        let source = self.scene.program(program)?;
        let mut rows = Rows::new(source.input_rows(), points);
        for (quantity, first) in &source.inputs {
            for k in 0..points {
                let value = input(k, quantity.packed());
                for (row, number) in (*first..).zip(&value[..quantity.kind.width()]) {
                    rows.set(row, k, *number);
                }
            }
        }
        Some(rows)
    }

    /// Runs a program over its inputs and writes the slots' outputs.
    fn finish(&mut self, program: u32, group: &[u32], inputs: &Rows, slots: &mut SlotCopy) {
        let Some(source) = self.scene.program(program) else {
            return;
        };
        let mut texels = Vec::new();
        Texels::of_regions(&mut texels, source, group.len(), inputs, self.level_offset);
        let mut given = Given {
            program: source,
            group,
            slots,
        };
        let cached = !source.regions().is_empty();
        let mut outputs = Rows::default();
        self.machine.run(
            source,
            group.len(),
            inputs,
            &texels,
            self.scene.images(),
            cached.then_some(&mut given as &mut dyn NodeCache),
            &mut outputs,
        );
        for row in 0..source.output_rows() {
            for (k, &slot) in group.iter().enumerate() {
                let word = outputs.get(row, k).to_bits();
                slots.set_row_word("output_rows", row as u32, slot, word);
            }
        }
    }
}

/// Word `row` of miss `k`.
fn miss(slots: &SlotCopy, row: u32, k: u32) -> u32 {
    let words = slots.words("misses");
    words[row as usize * (words.len() / MISS_ROWS as usize) + k as usize]
}

fn push_miss(slots: &mut SlotCopy, [slot, program, region]: [u32; 3], texel: ProgramTexel) {
    let count = &mut slots.words_mut("wave_counts")[QUEUE_MISSES as usize];
    let k = *count as usize;
    *count += 1;
    let words = slots.words_mut("misses");
    let rows = words.len() / MISS_ROWS as usize;
    let place = [texel.level, texel.i, texel.j].map(|number| number as u32);
    let all = [slot, program, region].into_iter().chain(place);
    for (row, word) in all.enumerate() {
        words[row * rows + k] = word;
    }
}

/// Puts numbers of misses in the order of regions.
pub(super) fn sort_misses(slots: &mut SlotCopy) {
    let count = slots.words("wave_counts")[QUEUE_MISSES as usize];
    let mut order: Vec<u32> = (0..count).collect();
    order.sort_by_key(|&k| miss(slots, MISS_REGION, k));
    slots.words_mut("sort_misses")[..order.len()].copy_from_slice(&order);
}

/// A value as a look-up gives it, if it can be packed.
fn rounded(kind: u32, value: [f32; 4]) -> [f32; 4] {
    let encoded = value_encode(kind, value);
    if encoded.fits {
        value_decode(kind, encoded.words)
    } else {
        value
    }
}

/// A cache that has the values of all regions: those in the slots' rows.
struct Given<'a> {
    program: &'a Program,
    group: &'a [u32],
    slots: &'a SlotCopy,
}

impl NodeCache for Given<'_> {
    fn look_up(&mut self, region: &Region, _: &Texels, out: &mut Rows, found: &mut [bool]) {
        let before = &self.program.regions()[..region.number as usize];
        let first: usize = before.iter().map(Region::width).sum();
        for row in 0..region.width() {
            for (k, &slot) in self.group.iter().enumerate() {
                let word = self
                    .slots
                    .row_word("cached_rows", (first + row) as u32, slot);
                out.set(row, k, f32::from_bits(word));
            }
        }
        found.fill(true);
    }

    fn store(&mut self, _: &Region, _: &Texels, _: &[u32], _: &mut Rows) {}
}

/// A cache that lacks one region, and keeps what is computed for it.
struct Computed {
    region: u32,
    values: Rows,
}

impl NodeCache for Computed {
    fn look_up(&mut self, region: &Region, _: &Texels, out: &mut Rows, found: &mut [bool]) {
        for row in 0..region.width() {
            out.row_mut(row).fill(0.0);
        }
        found.fill(region.number != self.region);
    }

    fn store(&mut self, _: &Region, _: &Texels, _: &[u32], values: &mut Rows) {
        self.values.clone_from(values);
    }
}
