//! The surface stage: hits sorted by program, networks run over groups, closures built,
//! lights and directions sampled.

use super::Frame;
use super::path::{Path, ScatterKind, clamp_contribution, flags, power_heuristic};
use super::sample::{self, Draw};
use super::worker::{Emitter, LightTask, SurfaceTask, Worker};
use crate::accel::{Hit, Ray, offset_origin, ray_kind};
use crate::closure::{ClosureContext, LobeSet, Scattered, flags as scatter};
use crate::light::{Emission, LightSample};
use crate::surface::SurfacePoint;
use crate::surface::cone::spread_after_scattering;
use glam::{Vec3, Vec3Swizzles};

/// Hits shaded at a time: their rows stay in the second-level cache.
pub const GROUP: usize = 512;

impl Worker {
    /// Shades every hit of the batch, program by program.
    pub(super) fn shade_surfaces(&mut self, frame: &Frame) {
        let mut tasks = std::mem::take(&mut self.surface_tasks);
        tasks.sort_unstable_by_key(|task| (task.material, task.path));
        let mut groups = tasks
            .chunk_by(|a, b| a.material == b.material)
            .flat_map(|same| same.chunks(GROUP))
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
    let settings = frame.settings();
    let caustic = path.flags & flags::DIFFUSE != 0;
    ClosureContext {
        blur: path.blur_roughness(settings),
        reflective_caustics: settings.reflective_caustics || !caustic,
        refractive_caustics: settings.refractive_caustics || !caustic,
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
    let holdout = lobes.holdout.element_sum() / 3.0;
    if holdout > 0.0 || frame.is_holdout(&task.hit) {
        let cut = if frame.is_holdout(&task.hit) {
            1.0
        } else {
            holdout.min(1.0)
        };
        path.alpha -= path.throughput.element_sum() / 3.0 * cut;
        if cut >= 1.0 {
            return false;
        }
    }
    note_features(path, lobes, task.hit.t);
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
    match lobes.sample(sample::three(path, Draw::Scatter)) {
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
    let weight = path.weight_against(density);
    let light = path.throughput * lobes.emission * weight;
    path.radiance += clamp_contribution(light, path.light_bounce(), frame.settings());
}

/// Albedo, normal and depth of the first surface that is more than half opaque.
fn note_features(path: &mut Path, lobes: &LobeSet, distance: f32) {
    let transparent = lobes.transparency.element_sum() > 1.5;
    if path.flags & flags::FEATURES_DONE != 0 || transparent {
        return;
    }
    path.flags |= flags::FEATURES_DONE;
    path.albedo = lobes.albedo();
    path.normal = lobes.normal();
    path.depth = distance;
}

fn sample_light(
    frame: &Frame,
    path: &Path,
    task: &SurfaceTask,
    point: &SurfacePoint,
    lobes: &LobeSet,
    tasks: &mut Vec<LightTask>,
) {
    let draw = sample::three(path, Draw::Light);
    let normal = selection_normal(point, lobes);
    let Some(light) = frame
        .prepared
        .lights
        .sample(point.position, normal, draw.x, draw.yz())
    else {
        return;
    };
    if u32::from(path.bounce) > light.max_bounces || !is_lit_by(path, &light) {
        return;
    }
    let scattered = lobes.eval(light.wi);
    if scattered.value == Vec3::ZERO || light.pdf <= 0.0 {
        return;
    }
    let weight = if light.mis {
        power_heuristic(light.pdf, scattered.pdf)
    } else {
        1.0
    };
    let mut value = path.throughput * scattered.value * (weight / light.pdf);
    let emitter = match light.radiance {
        Emission::Constant(radiance) => {
            value *= radiance;
            let Some(factor) = keep_small(frame, path, value) else {
                return;
            };
            value *= factor;
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
            bounce: u32::from(path.bounce),
            transparent: frame.settings().transparent_bounces,
            emitter,
        });
    }
}

/// Cycles' light threshold: a contribution below it is kept with a probability in
/// proportion to it. Returns the factor that makes up for the dropped ones.
fn keep_small(frame: &Frame, path: &Path, value: Vec3) -> Option<f32> {
    let threshold = frame.settings().light_threshold;
    let size = value.abs().max_element();
    if size >= threshold {
        return Some(1.0);
    }
    let keep = size / threshold;
    (sample::one(path, Draw::LightKeep) < keep).then(|| 1.0 / keep)
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
    let start = point
        .position
        .lerp(point.shadow_origin, terminator_lift(point, light.wi));
    let origin = offset_origin(start, point.true_normal, light.wi);
    let (direction, t_max) = if light.distance.is_finite() {
        let to_light = light.point - origin;
        (
            to_light.normalize_or(light.wi),
            to_light.length() * (1.0 - 1e-4),
        )
    } else {
        (light.wi, f32::INFINITY)
    };
    let excluded = [task.hit.instance, task.hit.primitive];
    Ray {
        origin,
        direction,
        t_min: 0.0,
        t_max,
        mask: ray_kind::SHADOW,
        excluded,
    }
}

/// Share of the way to the smooth surface that a shadow ray starts at: all of it where light
/// grazes the facet, nothing where it comes from well above, since lifting everywhere would
/// carry rays through thin objects (Cycles' shadow terminator offset, 0.1 by default).
fn terminator_lift(point: &SurfacePoint, wi: Vec3) -> f32 {
    const GRAZING: f32 = 0.1;
    let above_smooth = wi.dot(point.normal) > 0.0;
    let cosine = wi.dot(point.true_normal);
    if above_smooth {
        (1.0 - cosine / GRAZING).clamp(0.0, 1.0)
    } else {
        0.0
    }
}

/// Whether the light's ray visibility includes surfaces that the path reached like this one.
fn is_lit_by(path: &Path, light: &LightSample) -> bool {
    path.flags & flags::CAMERA != 0 || path.ray_kind().sees(&light.visibility)
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
    path.throughput *= next.weight;
    let kind = ScatterKind {
        diffuse: next.flags & scatter::DIFFUSE != 0,
        singular: next.flags & scatter::SINGULAR != 0,
        transmit: next.flags & scatter::TRANSMIT != 0,
    };
    path.count_bounce(kind, frame.settings());
    path.mis_origin = point.position;
    path.mis_normal = selection_normal(point, lobes);
    path.scatter_pdf = next.pdf;
    if !kind.singular {
        path.min_pdf = path.min_pdf.min(next.pdf);
    }
    path.origin = offset_origin(point.position, point.true_normal, next.wi);
    path.direction = next.wi;
    path.t_min = 0.0;
    path.t_max = f32::INFINITY;
    path.leaves = [task.hit.instance, task.hit.primitive];
    path.cone_width = point.cone_width;
    let alpha = next.roughness * next.roughness;
    path.cone_spread = spread_after_scattering(path.cone_spread, alpha, kind.diffuse);
    survives(path)
}

/// Russian roulette; also ends paths that carry nothing.
fn survives(path: &mut Path) -> bool {
    if !path.throughput.is_finite() || path.throughput.max_element() <= 0.0 {
        return false;
    }
    let survival = path.survival();
    let lives = survival >= 1.0 || sample::one(path, Draw::Roulette) < survival;
    path.throughput /= survival;
    path.dimension += sample::PER_SURFACE;
    lives
}

/// Sends the path straight through; false where it ends.
fn pass_through(frame: &Frame, path: &mut Path, task: &SurfaceTask, weight: Vec3) -> bool {
    path.throughput *= weight;
    path.t_min = task.hit.t;
    path.leaves = [task.hit.instance, task.hit.primitive];
    path.dimension += sample::PER_SURFACE;
    path.count_transparent(frame.settings()) && path.throughput.max_element() > 0.0
}
