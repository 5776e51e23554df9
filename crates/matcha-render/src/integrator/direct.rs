//! The shadow stage: radiance of sampled lights, and what stands in between.

use super::Frame;
use super::path::path_clamped;
use super::worker::{LightTask, SurfaceTask, Worker};
use crate::accel::{Hit, Ray, ray_kind};
use crate::device::light_sample::{LIGHT_EMITS_SURFACE, LIGHT_EMITS_TREE, LIGHT_EMITS_WORLD};
use crate::device::path_shade::{ShadowTask, path_task_through};
use glam::Vec3;

impl Worker {
    /// Traces all shadow rays of the batch and adds what arrives.
    pub(super) fn trace_lights(&mut self, frame: &Frame) {
        let mut tasks = std::mem::take(&mut self.light_tasks);
        self.evaluate_emitters(frame, &mut tasks);
        self.counts.rays += tasks.len() as u64;
        tasks.retain(|LightTask { shadow, .. }| {
            let ray = shadow_ray(shadow, ray_kind::SHADOW);
            let blocked = shadow.casts_shadow && frame.prepared.accel.occluded(&ray);
            shadow.value != Vec3::ZERO && !blocked
        });
        if frame.has_transparent_shadows() {
            self.attenuate(frame, &mut tasks);
        }
        for LightTask { path, shadow } in tasks.drain(..) {
            let path = &mut self.paths[path as usize];
            path.radiance += path_clamped(shadow.value, shadow.bounce, frame.rules());
        }
        self.light_tasks = tasks;
    }

    /// Multiplies the radiance of emitters into the tasks that wait for it.
    fn evaluate_emitters(&mut self, frame: &Frame, tasks: &mut [LightTask]) {
        let mut waiting: Vec<(u32, Hit, usize)> = Vec::new();
        let mut world = Vec::new();
        for (i, LightTask { shadow, .. }) in tasks.iter_mut().enumerate() {
            match shadow.emits {
                LIGHT_EMITS_SURFACE => {
                    let hit = emitter_hit(shadow);
                    waiting.push((frame.material_of(&hit), hit, i));
                }
                LIGHT_EMITS_WORLD => world.push(i),
                LIGHT_EMITS_TREE => {
                    let (direction, distance) = (shadow.direction, shadow.distance);
                    let networks = &mut self.networks;
                    shadow.value *=
                        networks.light_radiance(frame, shadow.light, direction, distance);
                }
                _ => {}
            }
        }
        if !world.is_empty() {
            let directions = world.iter().map(|&i| tasks[i].shadow.direction);
            self.networks.world_of_directions(frame, directions);
            for (k, &i) in world.iter().enumerate() {
                tasks[i].shadow.value *= self.networks.world_radiance(k);
            }
        }
        waiting.sort_unstable_by_key(|&(material, _, i)| (material, i));
        for same in waiting.chunk_by(|a, b| a.0 == b.0) {
            for group in same.chunks(self.group_hits) {
                let points = group
                    .iter()
                    .map(|&(_, hit, i)| (hit, tasks[i].shadow.direction));
                self.networks.emission_of_points(frame, same[0].0, points);
                for (k, &(_, _, i)) in group.iter().enumerate() {
                    tasks[i].shadow.value *= self.networks.emission(k);
                }
            }
        }
    }

    /// Weakens light by the transparent surfaces on its way, one layer after the other for
    /// all rays together; drops rays that meet too many or an opaque one. Lights that cast no
    /// shadows pass everything.
    fn attenuate(&mut self, frame: &Frame, tasks: &mut Vec<LightTask>) {
        let mut waiting: Vec<usize> = (0..tasks.len())
            .filter(|&i| tasks[i].shadow.casts_shadow)
            .collect();
        while !waiting.is_empty() {
            let mut layer: Vec<SurfaceTask> = Vec::new();
            self.counts.rays += waiting.len() as u64;
            waiting.retain(|&i| {
                let ray = shadow_ray(&tasks[i].shadow, ray_kind::TRANSPARENT_SHADOW);
                let hit = frame.prepared.accel.closest(&ray);
                layer.extend(hit.map(|hit| SurfaceTask {
                    path: i as u32,
                    material: frame.material_of(&hit),
                    hit,
                }));
                hit.is_some()
            });
            self.apply_layer(frame, tasks, &mut layer);
            waiting.retain(|&i| tasks[i].shadow.value != Vec3::ZERO);
        }
        tasks.retain(|task| task.shadow.value != Vec3::ZERO);
    }

    /// Evaluates the transparency of one layer of hits; `layer` keeps its order.
    fn apply_layer(&mut self, frame: &Frame, tasks: &mut [LightTask], layer: &mut [SurfaceTask]) {
        let mut order: Vec<usize> = (0..layer.len()).collect();
        order.sort_unstable_by_key(|&k| (layer[k].material, k));
        for same in order.chunk_by(|&a, &b| layer[a].material == layer[b].material) {
            for group in same.chunks(self.group_hits) {
                let material = layer[group[0]].material;
                let points = group
                    .iter()
                    .map(|&k| (layer[k].hit, tasks[layer[k].path as usize].shadow.direction));
                self.networks
                    .transparency_of_points(frame, material, points);
                for (n, &k) in group.iter().enumerate() {
                    let through = self.networks.transparency(n);
                    let SurfaceTask { path, hit, .. } = layer[k];
                    let leaves = [hit.instance, hit.primitive];
                    path_task_through(&mut tasks[path as usize].shadow, through, hit.t, leaves);
                }
            }
        }
    }
}

/// The ray of a task, seen by what a kind of rays meets.
pub fn shadow_ray(shadow: &ShadowTask, mask: u8) -> Ray {
    Ray {
        origin: shadow.origin,
        direction: shadow.direction,
        t_min: shadow.t_min,
        t_max: shadow.t_max,
        mask,
        excluded: shadow.leaves,
    }
}

/// The point of an emissive triangle that a task asks for.
fn emitter_hit(shadow: &ShadowTask) -> Hit {
    Hit {
        instance: shadow.instance,
        primitive: shadow.primitive,
        t: shadow.distance,
        u: shadow.uv.x,
        v: shadow.uv.y,
    }
}
