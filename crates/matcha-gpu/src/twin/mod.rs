//! Twins of the stages: what each kernel of a wave does, on the processor, over a copy of the same
//! memory. They call the device functions as the Rust that they are, and where the processor has code
//! of its own (the walk of rays, the machine over rows), that. They are meant to be read and compared
//! with, not to be fast: one slot after the other.
//!
//! The cache's table has no twin. A twin of a look-up finds nothing, so that everything is
//! evaluated; a value in the table is a function of its key and the same.

mod networks;
mod paths;
mod shade;

use crate::wavefront::layout::*;
use crate::wavefront::slot_copy::SlotCopy;
use crate::wavefront::stages::{Form, Step};
use crate::wavefront::state::Part;
use matcha_render::accel::Hit;
use matcha_render::device::geometry_view::{geometry_material, geometry_point};
use matcha_render::device::path_meet::{path_info, path_shadow_info};
use matcha_render::device::path_shade::ShadowTask;
use matcha_render::device::path_state::{Path, PathHit};
use matcha_render::device::surface_path::PathInfo;
use matcha_render::device::surface_point::SurfacePoint;
use matcha_render::flat::{FlatScene, NO_PROGRAM};
use matcha_shade::vm::Machine;

/// Runs steps of waves on the processor.
pub(crate) struct Twin {
    scene: FlatScene,
    form: Form,
    /// Seed of the picture.
    seed: u32,
    /// Added to the level of the virtual texture.
    level_offset: f32,
    machine: Machine,
}

impl Twin {
    /// The twin of a wavefront over a scene.
    pub fn new(scene: FlatScene, form: Form, seed: u32, level_offset: f32) -> Twin {
        Twin {
            scene,
            form,
            seed,
            level_offset,
            machine: Machine::new(None),
        }
    }

    /// Does to a copy what the step's kernels do to the device's memory.
    pub(crate) fn run(&mut self, step: Step, part: &Part, slots: &mut SlotCopy) {
        match step {
            Step::Measure { queues, empty } => measure(slots, queues, empty),
            Step::Regenerate => self.regenerate(part, slots),
            Step::Traverse => self.traverse(slots),
            Step::Meet => self.meet(slots),
            Step::Escape => self.escape(slots),
            Step::Sort(place) => self.sort(place.at(), place.queue(), slots),
            Step::LookUp(place) => self.look_up(place, slots),
            Step::SortMisses => networks::sort_misses(slots),
            Step::Misses => self.misses(slots),
            Step::Inline(place) => {
                self.look_up(place, slots);
                self.misses(slots);
                measure(slots, 0, 1 << QUEUE_MISSES);
                self.evaluate(place, slots);
            }
            Step::Evaluate(place) => self.evaluate(place, slots),
            Step::Shade => self.shade(slots),
            Step::Emit(place) => self.emit(place, slots),
            Step::Block => self.block(slots),
            Step::Layer { from } => self.layer(from, slots),
            Step::Pass { to } => self.pass(to, slots),
            Step::Collect => self.collect(slots),
        }
    }

    /// Where a slot's ray meets a surface, at a place with surfaces.
    fn hit(&self, at: u32, slots: &SlotCopy, slot: u32) -> PathHit {
        if at != AT_EMITTERS {
            return slots.load("hits", slot);
        }
        let task: ShadowTask = slots.load("tasks", slot);
        PathHit {
            t: task.distance,
            u: task.uv.x,
            v: task.uv.y,
            instance: task.instance,
            primitive: task.primitive,
        }
    }

    /// What networks may know of a slot's ray.
    fn info(&self, at: u32, slots: &SlotCopy, slot: u32) -> PathInfo {
        if at == AT_HITS || at == AT_ESCAPED {
            let hit: PathHit = slots.load("hits", slot);
            return path_info(&slots.load("paths", slot), hit.t);
        }
        let task: ShadowTask = slots.load("tasks", slot);
        let distance = if at == AT_LIGHT_TASKS {
            task.distance
        } else {
            0.0
        };
        path_shadow_info(task.direction, distance)
    }

    /// The point of a slot's surface.
    fn point(&self, at: u32, slots: &SlotCopy, slot: u32) -> SurfacePoint {
        let hit = self.hit(at, slots, slot);
        let info = self.info(at, slots, slot);
        let weights = glam::vec2(hit.u, hit.v);
        let view = self.scene.geometry();
        geometry_point(view, hit.instance, hit.primitive, hit.t, weights, info)
    }

    /// The number of a slot's program at a place.
    fn program_at(&self, at: u32, slots: &SlotCopy, slot: u32) -> u32 {
        if at <= AT_LAYERS {
            let hit = self.hit(at, slots, slot);
            return geometry_material(self.scene.geometry(), hit.instance, hit.primitive);
        }
        if at == AT_LIGHT_TASKS {
            let task: ShadowTask = slots.load("tasks", slot);
            return self.light_program(task.light);
        }
        self.scene.world_program().unwrap_or(NO_PROGRAM)
    }

    /// The number of a light's program.
    fn light_program(&self, light: u32) -> u32 {
        let scene_light = self.scene.lights().lights[light as usize].scene_light;
        self.scene.light_programs()[scene_light as usize]
    }
}

/// Numbers of workgroups of queues, which are added to the totals; then empties others.
fn measure(slots: &mut SlotCopy, queues: u32, empty: u32) {
    for queue in SlotCopy::queues() {
        let count = slots.words("wave_counts")[queue as usize];
        let first = 3 * queue as usize;
        if queues & 1 << queue != 0 {
            let groups = count.div_ceil(crate::shader::prelude::WORKGROUP);
            let sizes = crate::batch::workgroups(groups);
            slots.words_mut("wave_sizes")[first..first + 3].copy_from_slice(&sizes);
            slots.words_mut("wave_totals")[queue as usize] += count;
        }
        if empty & 1 << queue != 0 {
            slots.words_mut("wave_counts")[queue as usize] = 0;
        }
    }
}

/// What the processor's walk finds, as kernels write it; the ray's end where it meets nothing.
fn hit_words(hit: Option<Hit>, t_max: f32) -> PathHit {
    hit.map_or(
        PathHit {
            t: t_max,
            u: 0.0,
            v: 0.0,
            instance: SCENE_NOTHING,
            primitive: SCENE_NOTHING,
        },
        |hit| PathHit {
            t: hit.t,
            u: hit.u,
            v: hit.v,
            instance: hit.instance,
            primitive: hit.primitive,
        },
    )
}

/// A copy of a queue's slots: steps change what they go through.
fn queue(slots: &SlotCopy, queue: u32) -> Vec<u32> {
    slots.queue(queue).to_vec()
}

/// Changes a slot's path.
fn change_path(slots: &mut SlotCopy, slot: u32, change: impl FnOnce(&mut Path)) {
    let mut path: Path = slots.load("paths", slot);
    change(&mut path);
    slots.store("paths", slot, &path);
}
