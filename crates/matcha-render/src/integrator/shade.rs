//! The surface stage: hits sorted by program, networks run over groups, closures built,
//! lights and directions sampled.

use super::Frame;
use super::path::{Path, ScatterKind, flags, path_power_heuristic};
use super::sample;
use super::worker::{Emitter, LightTask, SurfaceTask, Worker};
use crate::accel::{Hit, Ray, ray_kind};
use crate::closure::{ClosureContext, LobeSet, Scattered, flags as scatter};
use crate::device::path_ray::{ShadowStart, ray_to_light};
use crate::device::path_state::{path_add_met, path_blur_roughness};
use crate::device::path_step::{
    PathTurn, path_hold_out, path_keep_small, path_note_features, path_pass_through, path_scatter,
};
use crate::device::surface_cone::cone_spread_after;
use crate::light::{Emission, LightSample};
use crate::surface::SurfacePoint;
use glam::{Vec3, Vec3Swizzles};

/// Hits shaded at a time: their rows stay in the second-level cache.
pub const GROUP: usize = 512;

impl Worker {
    /// Shades every hit of the batch, program by program.
    pub(super) fn shade_surfaces(&mut self, frame: &Frame) {
        let mut tasks = std::mem::take(&mut self.surface_tasks);
        tasks.sort_unstable_by_key(|task| (task.material, task.path));
        for same in tasks.chunk_by(|a, b| a.material == b.material) {
            for group in same.chunks(GROUP) {
                self.shade_group(frame, group);
            }
        }
        tasks.clear();
        self.surface_tasks = tasks;
    }

    fn shade_group(&mut self, frame: &Frame, group: &[SurfaceTask]) {
        let material = group[0].material;
        self.networks.surfaces(frame, material, group, &self.paths);
        self.counts.shaded += group.len() as u64;
        for (i, task) in group.iter().enumerate() {
            let path = &mut self.paths[task.path as usize];
            path.nodes_found += self.networks.nodes_found(i);
            let context = closure_context(frame, path);
            self.networks.closures(frame, i, &context, &mut self.lobes);
            let point = self.networks.point(i);
            if !shade_hit(frame, path, task, point, &self.lobes, &mut self.light_tasks) {
                self.finished.push(task.path);
            }
        }
    }
}

fn closure_context(frame: &Frame, path: &Path) -> ClosureContext {
    let settings = frame.rules();
    let caustic = path.flags & flags::DIFFUSE != 0;
    ClosureContext {
        blur: path_blur_roughness(path.min_pdf, settings.blur_glossy),
        reflective_caustics: settings.reflective_caustics != 0 || !caustic,
        refractive_caustics: settings.refractive_caustics != 0 || !caustic,
        // A path that ends here may still go on through transparent surfaces.
        scatter: path.flags & flags::TERMINATE == 0,
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
    add_surface_emission(frame, path, task, lobes);
    let held_out = if frame.is_holdout(&task.hit) {
        1.0
    } else {
        lobes.holdout.element_sum() / 3.0
    };
    if path_hold_out(path, held_out) {
        return false;
    }
    if path.flags & flags::FEATURES_DONE == 0 {
        let (albedo, normal) = (lobes.albedo(), lobes.normal());
        path_note_features(path, albedo, normal, lobes.transparency, task.hit.t);
    }
    if !lobes.has_bsdf() {
        return false;
    }
    if path.flags & flags::TERMINATE != 0 {
        return lobes.transparency != Vec3::ZERO
            && pass_through(frame, path, task, lobes.transparency);
    }
    if lobes.has_eval() {
        sample_light(frame, path, task, point, lobes, lights);
    }
    match lobes.sample(sample::scatter(path)) {
        None => false,
        Some(next) if next.flags & scatter::TRANSPARENT != 0 => {
            pass_through(frame, path, task, next.weight)
        }
        Some(next) => scatter_on(frame, path, task, point, lobes, &next),
    }
}

/// Adds what the surface emits, weighted against next-event estimation.
fn add_surface_emission(frame: &Frame, path: &mut Path, task: &SurfaceTask, lobes: &LobeSet) {
    if lobes.emission == Vec3::ZERO {
        return;
    }
    let density = frame.prepared.lights.pdf_triangle(
        task.hit.instance,
        task.hit.primitive,
        path.mis_origin,
        path.mis_normal,
        path.direction,
        task.hit.t,
    );
    path_add_met(path, lobes.emission, density, frame.rules());
}

fn sample_light(
    frame: &Frame,
    path: &Path,
    task: &SurfaceTask,
    point: &SurfacePoint,
    lobes: &LobeSet,
    tasks: &mut Vec<LightTask>,
) {
    let draw = sample::light(path);
    let normal = selection_normal(point, lobes);
    let Some(light) = frame
        .prepared
        .lights
        .sample(point.position, normal, draw.x, draw.yz())
    else {
        return;
    };
    if path.bounce > light.max_bounces || !is_lit_by(path, &light) {
        return;
    }
    let scattered = lobes.eval(light.wi);
    if scattered.value == Vec3::ZERO || light.pdf <= 0.0 {
        return;
    }
    let weight = if light.mis {
        path_power_heuristic(light.pdf, scattered.pdf)
    } else {
        1.0
    };
    let mut value = path.throughput * scattered.value * (weight / light.pdf);
    let emitter = match light.radiance {
        Emission::Constant(radiance) => {
            value *= radiance;
            value *= path_keep_small(path, value, frame.rules().light_threshold);
            Emitter::Known
        }
        Emission::Triangle {
            instance,
            primitive,
            u,
            v,
        } => Emitter::Surface(Hit {
            instance,
            primitive,
            t: light.distance,
            u,
            v,
        }),
        Emission::World => Emitter::World,
        tree @ Emission::Tree { .. } => Emitter::Light(tree, light.distance),
    };
    if value.is_finite() && value.max_element() > 0.0 {
        tasks.push(LightTask {
            path: task.path,
            value,
            ray: shadow_ray(point, task, &light),
            casts_shadow: light.cast_shadow,
            bounce: path.bounce,
            transparent: frame.rules().transparent_bounces,
            emitter,
        });
    }
}

/// The normal that light selection may rely on: none where light may also come from behind.
fn selection_normal(point: &SurfacePoint, lobes: &LobeSet) -> Vec3 {
    if lobes.reflects_only() {
        point.normal
    } else {
        Vec3::ZERO
    }
}

/// The ray to a sampled light; it stops short of the light's own surface.
fn shadow_ray(point: &SurfacePoint, task: &SurfaceTask, light: &LightSample) -> Ray {
    let start = ShadowStart {
        position: point.position,
        shadow_origin: point.shadow_origin,
        normal: point.normal,
        true_normal: point.true_normal,
    };
    let segment = ray_to_light(start, light.wi, light.point, !light.distance.is_finite());
    Ray {
        origin: segment.origin,
        direction: segment.direction,
        t_min: 0.0,
        t_max: segment.t_max,
        mask: ray_kind::SHADOW,
        excluded: [task.hit.instance, task.hit.primitive],
    }
}

/// Whether the light's ray visibility includes surfaces that the path reached like this one.
fn is_lit_by(path: &Path, light: &LightSample) -> bool {
    path.flags & flags::CAMERA != 0 || path.ray_kind().bit() & light.visibility != 0
}

/// Sends the path in a sampled direction; false where it ends.
fn scatter_on(
    frame: &Frame,
    path: &mut Path,
    task: &SurfaceTask,
    point: &SurfacePoint,
    lobes: &LobeSet,
    next: &Scattered,
) -> bool {
    let kind = ScatterKind {
        diffuse: next.flags & scatter::DIFFUSE != 0,
        singular: next.flags & scatter::SINGULAR != 0,
        transmit: next.flags & scatter::TRANSMIT != 0,
    };
    let alpha = next.roughness * next.roughness;
    let turn = PathTurn {
        position: point.position,
        true_normal: point.true_normal,
        selection_normal: selection_normal(point, lobes),
        cone_width: point.cone_width,
        cone_spread: cone_spread_after(path.cone_spread, alpha, kind.diffuse),
        leaves: [task.hit.instance, task.hit.primitive],
        wi: next.wi,
        pdf: next.pdf,
        kind,
    };
    path_scatter(path, next.weight, turn, frame.rules())
}

/// Sends the path straight through; false where it ends.
fn pass_through(frame: &Frame, path: &mut Path, task: &SurfaceTask, weight: Vec3) -> bool {
    let leaves = [task.hit.instance, task.hit.primitive];
    path_pass_through(path, weight, leaves, task.hit.t, frame.rules())
}
