//! Twins of the stages of closures and shadow rays: `wave_shade.wgsl`.

use super::{Twin, change_path, hit_words, queue};
use crate::wavefront::layout::*;
use crate::wavefront::slot_copy::SlotCopy;
use crate::wavefront::stages::Place;
use glam::Vec3;
use matcha_render::accel::ray_kind;
use matcha_render::closure::{ClosureContext, LobeSet};
use matcha_render::device::geometry_view::geometry_holdout;
use matcha_render::device::light_sample::{
    LIGHT_EMITS_NOTHING, LIGHT_EMITS_SURFACE, LIGHT_EMITS_TREE, LIGHT_EMITS_WORLD,
};
use matcha_render::device::path_shade::{
    ShadowTask, path_closure_context, path_no_task, path_shade, path_task_through,
};
use matcha_render::device::path_state::{Path, PathHit, path_clamped};
use matcha_render::device::surface_point::SurfacePoint;
use matcha_render::flat::NO_PROGRAM;
use matcha_render::integrator::{build_lobes, radiance, shadow_ray};
use matcha_shade::program::Program;
use matcha_shade::vm::Rows;

/// What shadow rays ask of closures.
const NOTHING_SCATTERS: ClosureContext = ClosureContext {
    blur: 0.0,
    reflective_caustics: true,
    refractive_caustics: true,
    scatter: false,
};

impl Twin {
    /// The radiance of a world's or a light's program, whose outputs are the slot's.
    pub(super) fn program_radiance(&self, program: u32, slots: &SlotCopy, slot: u32) -> Vec3 {
        let source = self.scene.program(program);
        source.map_or(Vec3::ZERO, |source| {
            radiance(source, &outputs(source, slots, slot), 0)
        })
    }

    /// The world's radiance for a path that left the scene.
    pub(super) fn world_radiance(&self, slots: &SlotCopy, slot: u32) -> Vec3 {
        match self.scene.world_program() {
            Some(program) => self.program_radiance(program, slots, slot),
            None => self.scene.world_radiance(),
        }
    }

    /// The lobes of a point from the slot's outputs.
    fn lobes(
        &self,
        place: Place,
        slots: &SlotCopy,
        slot: u32,
        context: &ClosureContext,
    ) -> (SurfacePoint, LobeSet) {
        let point = self.point(place.at(), slots, slot);
        let program = self.program_at(place.at(), slots, slot);
        let mut lobes = LobeSet::new();
        if let Some(source) = self.scene.program(program) {
            let rows = outputs(source, slots, slot);
            build_lobes(source, &rows, 0, &point, context, &mut lobes);
        }
        (point, lobes)
    }

    /// Everything that happens at paths' hits.
    pub(super) fn shade(&self, slots: &mut SlotCopy) {
        let settings = self.scene.rules();
        for slot in queue(slots, QUEUE_HITS) {
            let mut path: Path = slots.load("paths", slot);
            let hit: PathHit = slots.load("hits", slot);
            let context = path_closure_context(&path, settings);
            let (point, lobes) = self.lobes(Place::Hits, slots, slot, &context);
            let mut task = path_no_task();
            let lives = path_shade(
                self.scene.lights(),
                settings,
                &mut path,
                &point,
                &lobes,
                hit.t,
                geometry_holdout(self.scene.geometry(), point.instance),
                &mut task,
            );
            slots.store("paths", slot, &path);
            if !lives {
                slots.words_mut("slot_state")[slot as usize] = STATE_FINISHED;
            }
            if task.emits != LIGHT_EMITS_NOTHING {
                push_task(slots, slot, &task);
            }
        }
    }

    /// Multiplies emission into the shadow rays that wait for it.
    pub(super) fn emit(&self, place: Place, slots: &mut SlotCopy) {
        for slot in queue(slots, place.queue()) {
            let program = self.program_at(place.at(), slots, slot);
            let emission = if place.on_surface() {
                self.lobes(place, slots, slot, &NOTHING_SCATTERS).1.emission
            } else if program == NO_PROGRAM {
                Vec3::ONE
            } else {
                self.program_radiance(program, slots, slot)
            };
            change_task(slots, slot, |task| task.value *= emission);
        }
    }

    /// Ends the shadow rays that opaque surfaces block.
    pub(super) fn block(&self, slots: &mut SlotCopy) {
        for slot in queue(slots, QUEUE_TASKS) {
            let task: ShadowTask = slots.load("tasks", slot);
            if task.value == Vec3::ZERO || !task.casts_shadow {
                continue;
            }
            let ray = shadow_ray(&task, ray_kind::SHADOW);
            if self.scene.prepared().accel().occluded(&ray) {
                change_task(slots, slot, |task| task.value = Vec3::ZERO);
            } else if self.form.transparent {
                slots.push(QUEUE_LAYERS, slot);
            }
        }
    }

    /// Finds the next transparent surface on the way of each shadow ray.
    pub(super) fn layer(&self, from: u32, slots: &mut SlotCopy) {
        for slot in queue(slots, from) {
            let task: ShadowTask = slots.load("tasks", slot);
            let ray = shadow_ray(&task, ray_kind::TRANSPARENT_SHADOW);
            let hit = self.scene.prepared().accel().closest(&ray);
            if hit.is_some() {
                slots.store("hits", slot, &hit_words(hit, task.t_max));
                slots.push(QUEUE_LAYER_HITS, slot);
            }
        }
    }

    /// Weakens the shadow rays by the surfaces that they met, and sends them on.
    pub(super) fn pass(&self, to: u32, slots: &mut SlotCopy) {
        for slot in queue(slots, QUEUE_LAYER_HITS) {
            let (_, lobes) = self.lobes(Place::Layers, slots, slot, &NOTHING_SCATTERS);
            let hit: PathHit = slots.load("hits", slot);
            let leaves = [hit.instance, hit.primitive];
            let mut task: ShadowTask = slots.load("tasks", slot);
            path_task_through(&mut task, lobes.transparency, hit.t, leaves);
            slots.store("tasks", slot, &task);
            if task.value != Vec3::ZERO {
                slots.push(to, slot);
            }
        }
    }

    /// Adds to the paths what the shadow rays bring.
    pub(super) fn collect(&self, slots: &mut SlotCopy) {
        for slot in queue(slots, QUEUE_TASKS) {
            let task: ShadowTask = slots.load("tasks", slot);
            let light = path_clamped(task.value, task.bounce, self.scene.rules());
            change_path(slots, slot, |path| path.radiance += light);
        }
    }
}

/// The outputs of a slot's program.
fn outputs(program: &Program, slots: &SlotCopy, slot: u32) -> Rows {
    let mut rows = Rows::new(program.output_rows(), 1);
    for row in 0..program.output_rows() {
        let word = slots.row_word("output_rows", row as u32, slot);
        rows.set(row, 0, f32::from_bits(word));
    }
    rows
}

fn push_task(slots: &mut SlotCopy, slot: u32, task: &ShadowTask) {
    slots.store("tasks", slot, task);
    slots.push(QUEUE_TASKS, slot);
    match task.emits {
        LIGHT_EMITS_SURFACE => slots.push(QUEUE_EMITTERS, slot),
        LIGHT_EMITS_WORLD => slots.push(QUEUE_WORLD_TASKS, slot),
        LIGHT_EMITS_TREE => slots.push(QUEUE_LIGHT_TASKS, slot),
        _ => {}
    }
}

fn change_task(slots: &mut SlotCopy, slot: u32, change: impl FnOnce(&mut ShadowTask)) {
    let mut task: ShadowTask = slots.load("tasks", slot);
    change(&mut task);
    slots.store("tasks", slot, &task);
}
