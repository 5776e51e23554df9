//! Paths in flight in the device's memory: group 2.

use super::layout;
use super::slot_copy::SlotCopy;
use crate::batch::{Batch, Runner};
use crate::device::Device;
use crate::error::GpuError;
use crate::memory::{Memory, Sections, buffer};
use crate::shader::Library;
use crate::sort;
use matcha_render::backend::Control;
use matcha_render::film::{Film, PixelSums};
use matcha_render::flat::{FlatScene, NO_PROGRAM};
use std::ops::Range;

/// Number of the bind group.
const GROUP: u32 = 2;
const QUEUES: u64 = layout::QUEUES as u64;
/// Counters of the section `wave_totals`: see `wave_state.wgsl`.
const TOTALS: u64 = 16;
const MISS_ROWS: u64 = layout::MISS_ROWS as u64;

/// A part of the picture whose pixels are rendered together.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    /// Its first pixel, counted in rows from the top.
    pub first: u32,
    /// Pixels.
    pub pixels: u32,
    /// Samples of a pixel that are in flight together.
    pub streams: u32,
    /// Width of the picture.
    pub width: u32,
    /// First sample.
    pub first_sample: u32,
    /// One past the last.
    pub end: u32,
}

impl Part {
    /// The pixels from `first` on that `slots` slots can take.
    pub(super) fn new(first: u32, all: u32, slots: u32, width: u32, samples: &Range<u32>) -> Part {
        let pixels = slots.min(all - first);
        let streams = (slots / pixels).clamp(1, samples.end - samples.start);
        Part {
            first,
            pixels,
            streams,
            width,
            first_sample: samples.start,
            end: samples.end,
        }
    }

    /// Slots in use.
    pub(crate) fn slots(&self) -> u32 {
        self.pixels * self.streams
    }

    /// Arguments of `wave_regenerate`.
    pub(super) fn arguments(&self) -> [u32; 6] {
        [
            self.slots(),
            self.pixels,
            self.first,
            self.width,
            self.first_sample,
            self.end,
        ]
    }
}

/// What is the same for a rendering.
pub(super) struct Setting {
    /// Seed of the picture.
    pub seed: u32,
    /// Added to the level of the virtual texture.
    pub offset: f32,
    /// Pixels of the picture.
    pub pixels: u32,
    /// Queues are sorted.
    pub sorted: bool,
}

/// What stages counted since the last time.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Counts {
    /// Paths in flight at the last regeneration.
    pub active: u32,
    pub rays: u64,
    pub shaded: u64,
    pub look_ups: u64,
    pub found: u64,
}

/// Slots and queues.
pub(super) struct SlotMemory {
    memory: Memory,
    /// Numbers of workgroups by queue: an indirect buffer must not be bound.
    sizes: wgpu::Buffer,
    capacity: u32,
}

impl SlotMemory {
    /// Slots that are used at least.
    pub(super) const FEWEST: u32 = 1024;
    /// Slots that are used at most, if bindings are large enough.
    const MOST: u32 = 1 << 19;

    /// Places slots and queues.
    pub(super) fn place(
        device: &Device,
        library: &Library,
        flat: &FlatScene,
        setting: &Setting,
        others: &[&Memory],
    ) -> Result<SlotMemory, GpuError> {
        // As many as one binding holds, and not more than are of use.
        let words: u64 = sections(library, flat, setting, 1)?
            .iter()
            .map(|(_, length)| length)
            .sum();
        let binding = device.raw().limits().max_storage_buffer_binding_size;
        let fitting = (binding / (8 * words)).max(u64::from(Self::FEWEST));
        let useful = setting.pixels.max(1).saturating_mul(8);
        let mut capacity = (fitting.min(u64::from(Self::MOST)) as u32)
            .min(useful)
            .max(Self::FEWEST);
        let memory = loop {
            match Self::place_slots(device, library, flat, setting, others, capacity) {
                Err(GpuError::OutOfMemory { .. }) if capacity > Self::FEWEST => capacity /= 2,
                other => break other?,
            }
        };
        let usage = wgpu::BufferUsages::INDIRECT | wgpu::BufferUsages::COPY_DST;
        Ok(SlotMemory {
            sizes: buffer(device, "sizes of dispatches", QUEUES * 12, usage)?,
            memory,
            capacity,
        })
    }

    fn place_slots(
        device: &Device,
        library: &Library,
        flat: &FlatScene,
        setting: &Setting,
        others: &[&Memory],
        capacity: u32,
    ) -> Result<Memory, GpuError> {
        let mut placed = Sections::new();
        for (name, length) in sections(library, flat, setting, capacity.into())? {
            placed.zeroed(library, name, length)?;
        }
        if setting.sorted {
            sort::add_keys(&mut placed, library, sort_keys(flat).into())?;
        }
        placed.zeroed(library, "wave_counts", QUEUES)?;
        placed.zeroed(library, "wave_sizes", 3 * QUEUES)?;
        placed.zeroed(library, "wave_totals", TOTALS)?;
        let camera = flat.camera();
        placed.filled(library, "wave_camera", words_of(&camera))?;
        placed.filled(library, "wave_settings", words_of(&flat.rules()))?;
        let radiance = flat.world_radiance().to_array().map(f32::to_bits);
        let scale = (-2.0 * setting.offset).exp2();
        placed.filled(
            library,
            "wave_scene",
            vec![
                flat.world_program().unwrap_or(NO_PROGRAM),
                flat.world_visibility(),
                radiance[0],
                radiance[1],
                radiance[2],
                scale.to_bits(),
                setting.seed,
                0,
                0,
                0,
            ],
        )?;
        placed.place(device, GROUP, others)
    }

    pub(super) fn memory(&self) -> &Memory {
        &self.memory
    }

    /// Slots that there are.
    pub(super) fn capacity(&self) -> u32 {
        self.capacity
    }

    /// Numbers of workgroups for indirect dispatches, three words a queue.
    pub(super) fn sizes(&self) -> &wgpu::Buffer {
        &self.sizes
    }

    /// Takes over what kernels made of the numbers of workgroups, in the order of a batch.
    pub(super) fn copy_sizes(&self, batch: &mut Batch) -> Result<(), GpuError> {
        let commands = batch.commands();
        self.memory
            .copy(commands, "wave_sizes", 0, 3 * QUEUES, &self.sizes)
    }

    /// Everything that stages write, as it is now.
    pub(super) fn copy(&self) -> Result<SlotCopy, GpuError> {
        SlotCopy::read(&self.memory, self.capacity)
    }

    /// Puts everything back that stages write.
    pub(super) fn restore(&mut self, runner: &mut Runner, copy: &SlotCopy) -> Result<(), GpuError> {
        copy.write_to(&mut self.memory)?;
        let mut batch = runner.batch();
        self.copy_sizes(&mut batch)?;
        batch.run().map(|_| ())
    }

    /// Empties all slots for a part.
    pub(super) fn reset(&self, runner: &mut Runner, _part: &Part) -> Result<(), GpuError> {
        let mut batch = runner.batch();
        for name in [
            "slot_next",
            "slot_state",
            "film",
            "wave_counts",
            "wave_totals",
        ] {
            self.memory.clear(batch.commands(), name)?;
        }
        batch.run().map(|_| ())
    }

    /// Slots in a queue.
    pub(super) fn count(&self, queue: u32) -> Result<u32, GpuError> {
        Ok(self.memory.read("wave_counts", queue.into(), 1)?[0])
    }

    /// What stages counted since the last time.
    pub(super) fn take_counts(&mut self) -> Result<Counts, GpuError> {
        let active = self.count(layout::QUEUE_ACTIVE)?;
        let totals = self.memory.read("wave_totals", 0, TOTALS)?;
        self.memory.write("wave_totals", 0, &[0; TOTALS as usize])?;
        let total = |k: usize| u64::from(totals[k]);
        Ok(Counts {
            active,
            // Active paths, shadow rays, layers in both queues.
            rays: total(0) + total(3) + total(7) + total(9),
            shaded: total(1) + total(4) + total(8),
            look_ups: total(12),
            found: total(13),
        })
    }

    /// Adds the slots' sums to the film.
    pub(super) fn add_to(
        &self,
        film: &mut Film,
        part: &Part,
        control: &Control,
    ) -> Result<(), GpuError> {
        let all = self.memory.read("film", 0, self.memory.length("film")?)?;
        let capacity = self.capacity as usize;
        let mut samples = 0;
        for slot in 0..part.slots() as usize {
            let word = |k: usize| f32::from_bits(all[k * capacity + slot]);
            let triple = |k: usize| glam::Vec3::new(word(k), word(k + 1), word(k + 2));
            let sums = PixelSums {
                radiance: triple(0),
                alpha: word(3),
                albedo: triple(4),
                normal: triple(7),
                depth: word(10),
                depth_samples: word(11),
                nodes_found: word(12),
                samples: word(13),
            };
            samples += sums.samples as u64;
            film.add_pixel(part.first as usize + slot % part.pixels as usize, &sums);
        }
        control.add_samples(samples);
        Ok(())
    }
}

/// Different keys that queues are sorted by: programs and none, or regions.
fn sort_keys(flat: &FlatScene) -> u32 {
    let programs = flat.programs();
    (programs.count() + 1).max(programs.regions()) as u32
}

/// Sections that have so many elements for each slot.
fn sections(
    library: &Library,
    flat: &FlatScene,
    setting: &Setting,
    slots: u64,
) -> Result<Vec<(&'static str, u64)>, GpuError> {
    let programs = flat.programs();
    let misses = slots * u64::from(programs.most_regions().max(1));
    let mut all = vec![
        ("slot_next", slots),
        ("slot_state", slots),
        ("wave_queues", slots * QUEUES),
        (
            "cached_rows",
            slots * u64::from(programs.cached_rows().max(1)),
        ),
        (
            "output_rows",
            slots * u64::from(programs.output_rows().max(1)),
        ),
        ("misses", misses * MISS_ROWS),
    ];
    if setting.sorted {
        all.extend([("sort_slots", slots), ("sort_misses", misses)]);
        all.extend(sort::ITEMS.map(|name| (name, misses)));
    } else {
        // A kernel reaches into it, but never will.
        all.push(("sort_misses", 1));
    }
    for columns in ["paths", "hits", "tasks", "film"] {
        all.push((columns, slots * u64::from(library.section(columns)?.stride)));
    }
    Ok(all)
}

/// A value's words.
fn words_of<T: bytemuck::NoUninit>(value: &T) -> Vec<u32> {
    bytemuck::cast_slice(std::slice::from_ref(value)).to_vec()
}
