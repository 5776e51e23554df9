//! One thread's batch of paths and the loop over its stages.

use super::Frame;
use super::networks::Networks;
use super::path::Path;
use crate::accel::Hit;
use crate::backend::CpuSchedule;
use crate::closure::LobeSet;
use crate::device::light_view::LIGHT_NONE;
use crate::device::path_meet::{
    PathMeeting, path_leaves_film, path_meet_lights, path_meet_suns, path_meet_world,
};
use crate::device::path_shade::ShadowTask;
use crate::device::path_state::path_add_met;
use crate::device::path_step::path_reaches;
use crate::film::{PixelSums, Tile};

use glam::Vec3;
use matcha_cache::CacheCounts;
use std::ops::Range;
use std::time::Duration;

/// A path at a surface.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceTask {
    /// Index into the batch.
    pub path: u32,
    /// Material at the hit.
    pub material: u32,
    /// Where.
    pub hit: Hit,
}

/// A sampled light on its way through the scene.
#[derive(Clone, Copy, Debug)]
pub struct LightTask {
    /// Index into the batch.
    pub path: u32,
    /// The shadow ray, and what it brings.
    pub shadow: ShadowTask,
}

/// Counts of one thread.
#[derive(Clone, Copy, Debug, Default)]
pub struct Counts {
    /// Rays traced.
    pub rays: u64,
    /// Shading points.
    pub shaded: u64,
}

/// A thread's state, kept from tile to tile.
pub struct Worker {
    batch_paths: usize,
    pub(super) group_hits: usize,
    pub(super) paths: Vec<Path>,
    active: Vec<u32>,
    free: Vec<u32>,
    pub(super) finished: Vec<u32>,
    pub(super) surface_tasks: Vec<SurfaceTask>,
    pub(super) light_tasks: Vec<LightTask>,
    escaped: Vec<u32>,
    pub(super) networks: Networks,
    pub(super) lobes: LobeSet,
    pub(super) counts: Counts,
}

impl Worker {
    /// An empty batch.
    pub fn new(schedule: &CpuSchedule) -> Self {
        let batch_paths = schedule.batch_paths.max(1);
        Self {
            batch_paths,
            group_hits: schedule.group_hits.max(1),
            paths: Vec::with_capacity(batch_paths),
            active: Vec::with_capacity(batch_paths),
            free: Vec::with_capacity(batch_paths),
            finished: Vec::new(),
            surface_tasks: Vec::new(),
            light_tasks: Vec::new(),
            escaped: Vec::new(),
            networks: Networks::new(schedule.isa),
            lobes: LobeSet::default(),
            counts: Counts::default(),
        }
    }

    /// Rays and shading points so far.
    pub fn counts(&self) -> &Counts {
        &self.counts
    }

    /// What the cache did for this thread.
    pub fn cache_counts(&self) -> CacheCounts {
        self.networks.counts
    }

    /// Time that this thread spent in node networks.
    pub fn network_time(&self) -> Duration {
        self.networks.time
    }

    /// Renders samples `range` of a tile into `sums`, one entry a pixel.
    pub fn render_tile(
        &mut self,
        frame: &Frame,
        tile: &Tile,
        range: Range<u32>,
        sums: &mut [PixelSums],
    ) {
        let per_pixel = range.len() as u64;
        let total = per_pixel * u64::from(tile.pixels());
        let mut next = 0;
        // Places of earlier tiles are forgotten: sums are added in the order of places, and a
        // tile must not depend on what its thread did before.
        self.paths.clear();
        self.free.clear();
        loop {
            next = self.fill(frame, tile, &range, next, total);
            if self.active.is_empty() {
                return;
            }
            self.traverse(frame);
            self.shade_surfaces(frame);
            self.shade_escaped(frame);
            self.trace_lights(frame);
            self.retire(sums);
        }
    }

    /// Starts paths until the batch is full; paths of one sample of the tile's pixels are
    /// neighbours. Returns the index of the next path to start.
    fn fill(
        &mut self,
        frame: &Frame,
        tile: &Tile,
        range: &Range<u32>,
        mut next: u64,
        total: u64,
    ) -> u64 {
        let pixels = u64::from(tile.pixels());
        while self.active.len() < self.batch_paths && next < total {
            let sample = range.start + (next / pixels) as u32;
            let path = frame.start_path(tile, (next % pixels) as u32, sample);
            let slot = self.free.pop().unwrap_or_else(|| {
                self.paths.push(path);
                self.paths.len() as u32 - 1
            });
            self.paths[slot as usize] = path;
            self.active.push(slot);
            next += 1;
        }
        next
    }

    /// Finds what every path meets next.
    fn traverse(&mut self, frame: &Frame) {
        for &index in &self.active {
            let path = &mut self.paths[index as usize];
            let hit = frame.prepared.accel.closest(&path.ray());
            self.counts.rays += 1;
            let reach = hit.map_or(path.t_max, |hit| hit.t);
            add_lights_on_the_way(frame, &mut self.networks, path, reach);
            let Some(hit) = hit else {
                self.escaped.push(index);
                continue;
            };
            let material = frame.material_of(&hit);
            let emits = frame.prepared.emits(material);
            if path_reaches(path, emits, frame.rules()) {
                self.surface_tasks.push(SurfaceTask {
                    path: index,
                    material,
                    hit,
                });
            } else {
                self.finished.push(index);
            }
        }
    }

    /// Adds the world's light to the paths that left the scene.
    fn shade_escaped(&mut self, frame: &Frame) {
        let mut escaped = std::mem::take(&mut self.escaped);
        if !escaped.is_empty() {
            self.networks.world_of_paths(frame, &escaped, &self.paths);
            // Suns with node trees are evaluated in between.
            let count = escaped.len();
            let world: Vec<Vec3> = (0..count)
                .map(|i| self.networks.world_radiance(i))
                .collect();
            for (&index, radiance) in escaped.iter().zip(world) {
                let path = &mut self.paths[index as usize];
                add_world(frame, &mut self.networks, path, radiance);
            }
            self.finished.append(&mut escaped);
        }
        self.escaped = escaped;
    }

    /// Puts finished paths on the film and frees their places.
    fn retire(&mut self, sums: &mut [PixelSums]) {
        // In the order of the batch, so that sums do not depend on the order of stages.
        self.finished.sort_unstable();
        for &index in &self.finished {
            self.paths[index as usize].add_to(sums);
        }
        if !self.finished.is_empty() {
            let finished = &self.finished;
            self.active
                .retain(|index| finished.binary_search(index).is_err());
            self.free.extend_from_slice(finished);
        }
        self.finished.clear();
    }
}

/// Adds the analytic lights that a path's ray meets before `reach`; rays go through them.
fn add_lights_on_the_way(frame: &Frame, networks: &mut Networks, path: &mut Path, reach: f32) {
    let lights = frame.prepared.lights.view();
    let mut from = path.t_min;
    loop {
        let met = path_meet_lights(lights, path, from, reach, frame.rules());
        if met.light == LIGHT_NONE {
            return;
        }
        add_tree_light(frame, networks, path, &met);
        from = met.next;
    }
}

fn add_tree_light(frame: &Frame, networks: &mut Networks, path: &mut Path, met: &PathMeeting) {
    let tree = networks.light_radiance(frame, met.light, path.direction, met.distance);
    path_add_met(path, met.factor * tree, met.pdf, frame.rules());
}

fn add_world(frame: &Frame, networks: &mut Networks, path: &mut Path, radiance: Vec3) {
    if path_leaves_film(path, frame.rules()) {
        return;
    }
    let lights = frame.prepared.lights.view();
    let mut sun = 0;
    loop {
        let met = path_meet_suns(lights, path, sun, frame.rules());
        if met.light == LIGHT_NONE {
            break;
        }
        add_tree_light(frame, networks, path, &met);
        sun = met.next as u32;
    }
    let visibility = frame.world_visibility();
    path_meet_world(lights, path, radiance, visibility, frame.rules());
}
