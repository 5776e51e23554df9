//! The shadow stage: radiance of sampled lights, and what stands in between.

use super::Frame;
use super::path::path_clamped;
use super::worker::{Emitter, LightTask, SurfaceTask, Worker};
use crate::accel::{Hit, Ray, ray_kind};
use glam::Vec3;

impl Worker {
    /// Traces all shadow rays of the batch and adds what arrives.
    pub(super) fn trace_lights(&mut self, frame: &Frame) {
        let mut tasks = std::mem::take(&mut self.light_tasks);
        self.evaluate_emitters(frame, &mut tasks);
        self.counts.rays += tasks.len() as u64;
        tasks.retain(|task| {
            let blocked = task.casts_shadow && frame.prepared.accel.occluded(&task.ray);
            task.value != Vec3::ZERO && !blocked
        });
        if frame.has_transparent_shadows() {
            self.attenuate(frame, &mut tasks);
        }
        for task in tasks.drain(..) {
            let path = &mut self.paths[task.path as usize];
            path.radiance += path_clamped(task.value, task.bounce, frame.rules());
        }
        self.light_tasks = tasks;
    }

    /// Multiplies the radiance of emitters into the tasks that wait for it.
    fn evaluate_emitters(&mut self, frame: &Frame, tasks: &mut [LightTask]) {
        let mut waiting: Vec<(u32, Hit, usize)> = Vec::new();
        let mut world = Vec::new();
        let mut lights = Vec::new();
        for (i, task) in tasks.iter().enumerate() {
            match task.emitter {
                Emitter::Known => {}
                Emitter::Light(..) => lights.push(i),
                Emitter::Surface(hit) => waiting.push((frame.material_of(&hit), hit, i)),
                Emitter::World => world.push(i),
            }
        }
        if !world.is_empty() {
            let directions = world.iter().map(|&i| tasks[i].ray.direction);
            self.networks.world_of_directions(frame, directions);
            for (k, &i) in world.iter().enumerate() {
                tasks[i].value *= self.networks.world_radiance(k);
            }
        }
        for i in lights {
            if let Emitter::Light(emission, distance) = tasks[i].emitter {
                let direction = tasks[i].ray.direction;
                tasks[i].value *= self
                    .networks
                    .light_radiance(frame, &emission, direction, distance);
            }
        }
        waiting.sort_unstable_by_key(|&(material, _, i)| (material, i));
        for same in waiting.chunk_by(|a, b| a.0 == b.0) {
            for group in same.chunks(super::shade::GROUP) {
                let points = group
                    .iter()
                    .map(|&(_, hit, i)| (hit, tasks[i].ray.direction));
                self.networks.emission_of_points(frame, same[0].0, points);
                for (k, &(_, _, i)) in group.iter().enumerate() {
                    tasks[i].value *= self.networks.emission(k);
                }
            }
        }
    }

    /// Weakens light by the transparent surfaces on its way, one layer after the other for
    /// all rays together; drops rays that meet too many or an opaque one.
    fn attenuate(&mut self, frame: &Frame, tasks: &mut Vec<LightTask>) {
        let mut rays: Vec<(usize, Ray)> = tasks
            .iter()
            .enumerate()
            .map(|(i, task)| (i, transparent_ray(&task.ray)))
            .collect();
        while !rays.is_empty() {
            let mut layer: Vec<SurfaceTask> = Vec::new();
            self.counts.rays += rays.len() as u64;
            rays.retain(|(i, ray)| match frame.prepared.accel.closest(ray) {
                Some(hit) => {
                    let material = frame.material_of(&hit);
                    layer.push(SurfaceTask {
                        path: *i as u32,
                        material,
                        hit,
                    });
                    true
                }
                None => false,
            });
            self.apply_layer(frame, tasks, &mut layer);
            for ((i, ray), task) in rays.iter_mut().zip(&layer) {
                debug_assert_eq!(*i, task.path as usize);
                step_behind(ray, &task.hit);
            }
            rays.retain(|&(i, _)| tasks[i].value != Vec3::ZERO);
        }
        tasks.retain(|task| task.value != Vec3::ZERO);
    }

    /// Evaluates the transparency of one layer of hits; `layer` keeps its order.
    fn apply_layer(&mut self, frame: &Frame, tasks: &mut [LightTask], layer: &mut [SurfaceTask]) {
        let mut order: Vec<usize> = (0..layer.len()).collect();
        order.sort_unstable_by_key(|&k| (layer[k].material, k));
        for same in order.chunk_by(|&a, &b| layer[a].material == layer[b].material) {
            for group in same.chunks(super::shade::GROUP) {
                let material = layer[group[0]].material;
                let points = group
                    .iter()
                    .map(|&k| (layer[k].hit, tasks[layer[k].path as usize].ray.direction));
                self.networks
                    .transparency_of_points(frame, material, points);
                for (n, &k) in group.iter().enumerate() {
                    let task = &mut tasks[layer[k].path as usize];
                    let through = self.networks.transparency(n);
                    task.value = if task.transparent == 0 {
                        Vec3::ZERO
                    } else {
                        task.value * through
                    };
                    task.transparent = task.transparent.saturating_sub(1);
                }
            }
        }
    }
}

fn transparent_ray(ray: &Ray) -> Ray {
    Ray {
        mask: ray_kind::TRANSPARENT_SHADOW,
        ..*ray
    }
}

fn step_behind(ray: &mut Ray, hit: &Hit) {
    ray.t_min = hit.t;
    ray.excluded = [hit.instance, hit.primitive];
}
