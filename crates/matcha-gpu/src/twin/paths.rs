//! Twins of the stages of paths: `wave_paths.wgsl`.

use super::{Twin, change_path, hit_words, queue};
use crate::wavefront::layout::*;
use crate::wavefront::slot_copy::SlotCopy;
use crate::wavefront::state::Part;
use glam::Vec3;
use matcha_render::device::geometry_view::geometry_material;
use matcha_render::device::light_view::LIGHT_NONE;
use matcha_render::device::path_meet::{
    PathMeeting, path_leaves_film, path_meet_lights, path_meet_suns, path_meet_world,
    path_shadow_info,
};
use matcha_render::device::path_start::path_start;
use matcha_render::device::path_state::{FilmSums, Path, PathHit, film_add, path_add_met};
use matcha_render::device::path_step::path_reaches;
use matcha_render::flat::NO_PROGRAM;

impl Twin {
    /// Puts finished paths on the film and starts the next ones.
    pub(super) fn regenerate(&self, part: &Part, slots: &mut SlotCopy) {
        for slot in 0..part.slots() {
            let mut state = slots.words("slot_state")[slot as usize];
            if state == STATE_FINISHED {
                let mut sums: FilmSums = slots.load("film", slot);
                film_add(&mut sums, &slots.load("paths", slot));
                slots.store("film", slot, &sums);
                state = STATE_IDLE;
            }
            let begun = slots.words("slot_next")[slot as usize];
            let index = part.first_sample + slot / part.pixels + begun * part.streams;
            if state == STATE_IDLE && index < part.end {
                let pixel = part.first + slot % part.pixels;
                slots.store("paths", slot, &self.start(pixel, part.width, index));
                slots.words_mut("slot_next")[slot as usize] = begun + 1;
                state = STATE_ALIVE;
            }
            slots.words_mut("slot_state")[slot as usize] = state;
            if state == STATE_ALIVE {
                slots.push(QUEUE_ACTIVE, slot);
            }
        }
    }

    fn start(&self, pixel: u32, width: u32, index: u32) -> Path {
        let (camera, filter) = (self.scene.camera(), self.scene.filter());
        let [x, y] = [pixel % width, pixel / width];
        path_start(camera, filter, self.seed, x, y, pixel, index)
    }

    /// Finds what every path meets next; Russian roulette ends some at the surface.
    pub(super) fn traverse(&self, slots: &mut SlotCopy) {
        for slot in queue(slots, QUEUE_ACTIVE) {
            let mut path: Path = slots.load("paths", slot);
            let hit = self.scene.prepared().accel().closest(&path.ray());
            slots.store("hits", slot, &hit_words(hit, path.t_max));
            let Some(hit) = hit else {
                slots.push(QUEUE_ESCAPED, slot);
                continue;
            };
            let geometry = self.scene.geometry();
            let material = geometry_material(geometry, hit.instance, hit.primitive);
            let emits = self.scene.prepared().emits(material);
            if path_reaches(&mut path, emits, self.scene.rules()) {
                change_path(slots, slot, |old| old.flags = path.flags);
                slots.push(QUEUE_HITS, slot);
            } else {
                slots.words_mut("slot_state")[slot as usize] = STATE_FINISHED;
            }
        }
    }

    /// Adds the analytic lights on the paths' ways.
    pub(super) fn meet(&mut self, slots: &mut SlotCopy) {
        let settings = self.scene.rules();
        for slot in queue(slots, QUEUE_ACTIVE) {
            let mut path: Path = slots.load("paths", slot);
            let hit: PathHit = slots.load("hits", slot);
            let mut start = path.t_min;
            loop {
                let lights = self.scene.lights();
                let met = path_meet_lights(lights, &mut path, start, hit.t, settings);
                if met.light == LIGHT_NONE {
                    break;
                }
                self.add_tree_light(&mut path, &met, slots, slot);
                start = met.next;
            }
            change_path(slots, slot, |old| old.radiance = path.radiance);
        }
    }

    /// Adds the world and the suns to paths that left the scene.
    pub(super) fn escape(&mut self, slots: &mut SlotCopy) {
        let settings = self.scene.rules();
        for slot in queue(slots, QUEUE_ESCAPED) {
            let mut path: Path = slots.load("paths", slot);
            if !path_leaves_film(&mut path, settings) {
                // Before suns take the slot's outputs.
                let world = self.world_radiance(slots, slot);
                self.add_suns(&mut path, slots, slot);
                let visibility = self.scene.world_visibility();
                path_meet_world(self.scene.lights(), &mut path, world, visibility, settings);
            }
            change_path(slots, slot, |old| {
                old.radiance = path.radiance;
                old.alpha = path.alpha;
            });
            slots.words_mut("slot_state")[slot as usize] = STATE_FINISHED;
        }
    }

    fn add_suns(&mut self, path: &mut Path, slots: &mut SlotCopy, slot: u32) {
        let mut sun = 0;
        loop {
            let met = path_meet_suns(self.scene.lights(), path, sun, self.scene.rules());
            if met.light == LIGHT_NONE {
                return;
            }
            self.add_tree_light(path, &met, slots, slot);
            sun = met.next as u32;
        }
    }

    /// Adds a light with a node tree, whose outputs become the slot's.
    fn add_tree_light(
        &mut self,
        path: &mut Path,
        met: &PathMeeting,
        slots: &mut SlotCopy,
        slot: u32,
    ) {
        let program = self.light_program(met.light);
        let mut tree = Vec3::ONE;
        if program != NO_PROGRAM {
            let info = path_shadow_info(path.direction, met.distance);
            self.run_background(program, &[(slot, info)], slots);
            tree = self.program_radiance(program, slots, slot);
        }
        path_add_met(path, met.factor * tree, met.pdf, self.scene.rules());
    }
}
