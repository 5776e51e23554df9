//! The surface stage: hits sorted by program, networks run over groups, closures built,
//! lights and directions sampled.

use super::Frame;
use super::path::Path;
use super::worker::{LightTask, SurfaceTask, Worker};
use crate::closure::LobeSet;
use crate::device::light_sample::LIGHT_EMITS_NOTHING;
use crate::device::path_shade::{path_closure_context, path_no_task, path_shade};
use crate::surface::SurfacePoint;

impl Worker {
    /// Shades every hit of the batch, program by program.
    pub(super) fn shade_surfaces(&mut self, frame: &Frame) {
        let mut tasks = std::mem::take(&mut self.surface_tasks);
        tasks.sort_unstable_by_key(|task| (task.material, task.path));
        let most = self.group_hits;
        let mut groups = tasks
            .chunk_by(|a, b| a.material == b.material)
            .flat_map(|same| same.chunks(most))
            .peekable();
        if let Some(first) = groups.peek() {
            self.networks.announce_surfaces(frame, first, &self.paths);
        }
        while let Some(group) = groups.next() {
            self.networks.advance();
            // One group ahead: its cells arrive while this one is shaded.
            if let Some(next) = groups.peek() {
                self.networks.announce_surfaces(frame, next, &self.paths);
            }
            self.shade_group(frame, group);
        }
        tasks.clear();
        self.surface_tasks = tasks;
    }

    fn shade_group(&mut self, frame: &Frame, group: &[SurfaceTask]) {
        self.networks.evaluate(frame);
        self.counts.shaded += group.len() as u64;
        for (i, task) in group.iter().enumerate() {
            let path = &mut self.paths[task.path as usize];
            path.nodes_found += self.networks.nodes_found(i);
            let context = path_closure_context(path, frame.rules());
            self.networks.closures(frame, i, &context, &mut self.lobes);
            let point = self.networks.point(i);
            if !shade_hit(frame, path, task, point, &self.lobes, &mut self.light_tasks) {
                self.finished.push(task.path);
            }
        }
    }
}

/// Everything that happens at one hit; false where the path ends.
fn shade_hit(
    frame: &Frame,
    path: &mut Path,
    task: &SurfaceTask,
    point: &SurfacePoint,
    lobes: &LobeSet,
    lights: &mut Vec<LightTask>,
) -> bool {
    let mut shadow = path_no_task();
    let lives = path_shade(
        frame.prepared.lights.view(),
        frame.rules(),
        path,
        point,
        lobes,
        task.hit.t,
        frame.is_holdout(&task.hit),
        &mut shadow,
    );
    if shadow.emits != LIGHT_EMITS_NOTHING {
        lights.push(LightTask {
            path: task.path,
            shadow,
        });
    }
    lives
}
