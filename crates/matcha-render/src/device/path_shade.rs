//! Everything that happens to a path at one hit, its closures being known.

// A list of what it needs is plainer than a struct for one call.
#![allow(clippy::too_many_arguments)]

use glam::{Vec2, Vec3};
use matcha_shade::device::math::{abs3, is_finite3, splat3, vec2};

use super::closure_lobe::ClosureContext;
use super::closure_set::{
    LobeSet, closure_mean, closure_set_albedo, closure_set_eval, closure_set_has_bsdf,
    closure_set_has_eval, closure_set_normal, closure_set_reflects_only, closure_set_sample,
};
use super::light_analytic::LIGHT_FAR;
use super::light_pdf::light_pdf_triangle;
use super::light_sample::{
    LIGHT_EMITS_CONSTANT, LIGHT_EMITS_NOTHING, LIGHT_EMITS_TREE, LIGHT_IS_NONE, LightDraw,
    light_sample,
};
use super::light_view::{LIGHT_NONE, LightView};
use super::lobe::{SCATTER_DIFFUSE, SCATTER_SINGULAR, SCATTER_TRANSMIT, SCATTER_TRANSPARENT};
use super::path_flags::{PATH_CAMERA, PATH_DIFFUSE, PATH_ENDS, PATH_FEATURES_DONE, PATH_TERMINATE};
use super::path_ray::{ShadowStart, ray_to_light};
use super::path_start::{DRAW_LIGHT, DRAW_SCATTER};
use super::path_state::{
    Path, PathSettings, ScatterKind, path_add_met, path_blur_roughness, path_max_element,
    path_power_heuristic, path_survival,
};
use super::path_step::{
    PathTurn, path_hold_out, path_keep_small, path_note_features, path_pass_through, path_scatter,
    path_survive,
};
use super::sobol::sobol_3d;
use super::surface_cone::cone_spread_after;
use super::surface_point::SurfacePoint;

/// A sampled light on its way through the scene.
#[derive(Clone, Copy, Debug)]
pub struct ShadowTask {
    /// Contribution if nothing is in between; without the radiance where that is still to be
    /// evaluated.
    pub value: Vec3,
    /// Start of the shadow ray, world space.
    pub origin: Vec3,
    /// Its unit direction.
    pub direction: Vec3,
    /// Distance from which on surfaces count, metres: behind those that let it pass.
    pub t_min: f32,
    /// Its length, metres; the largest number towards a distant light.
    pub t_max: f32,
    /// Instance and triangle that it leaves.
    pub leaves: [u32; 2],
    /// Objects block the light.
    pub casts_shadow: bool,
    /// Bounces of the path at the surface, for the clamps.
    pub bounce: u32,
    /// Transparent surfaces that the ray may still pass.
    pub transparent: u32,
    /// What must be evaluated to know the radiance: one of the `LIGHT_EMITS_` kinds;
    /// `LIGHT_EMITS_CONSTANT`: nothing, `LIGHT_EMITS_NOTHING`: there is no task.
    pub emits: u32,
    /// Of an analytic light with a node tree: index into `LightView::lights`.
    pub light: u32,
    /// Of a triangle: instance.
    pub instance: u32,
    /// Of a triangle: which of its mesh.
    pub primitive: u32,
    /// Of a triangle: weights of its second and third corner.
    pub uv: Vec2,
    /// Distance of the light's point, metres.
    pub distance: f32,
}

/// No light is tried.
#[inline(always)]
pub fn path_no_task() -> ShadowTask {
    ShadowTask {
        value: splat3(0.0),
        origin: splat3(0.0),
        direction: splat3(0.0),
        t_min: 0.0,
        t_max: 0.0,
        leaves: [LIGHT_NONE, LIGHT_NONE],
        casts_shadow: false,
        bounce: 0,
        transparent: 0,
        emits: LIGHT_EMITS_NOTHING,
        light: LIGHT_NONE,
        instance: LIGHT_NONE,
        primitive: LIGHT_NONE,
        uv: vec2(0.0, 0.0),
        distance: 0.0,
    }
}

/// What the path so far means for the closures of its hit.
#[inline]
pub fn path_closure_context(path: &Path, settings: PathSettings) -> ClosureContext {
    let caustic = (path.flags & PATH_DIFFUSE) != 0;
    ClosureContext {
        blur: path_blur_roughness(path.min_pdf, settings.blur_glossy),
        reflective_caustics: settings.reflective_caustics != 0 || !caustic,
        refractive_caustics: settings.refractive_caustics != 0 || !caustic,
        // A path that ends here may still go on through transparent surfaces.
        scatter: (path.flags & (PATH_TERMINATE | PATH_ENDS)) == 0,
    }
}

/// The normal that light selection may rely on: none where light may also come from behind.
#[inline]
pub fn path_selection_normal(set: &LobeSet) -> Vec3 {
    if closure_set_reflects_only(set) {
        set.frame.n
    } else {
        splat3(0.0)
    }
}

/// Adds what the surface emits, weighted against next-event estimation.
#[inline]
pub fn path_meet_surface(
    lights: LightView,
    path: &mut Path,
    point: &SurfacePoint,
    emission: Vec3,
    distance: f32,
    settings: PathSettings,
) {
    if emission.x != 0.0 || emission.y != 0.0 || emission.z != 0.0 {
        let pdf = light_pdf_triangle(
            lights,
            point.instance,
            point.primitive,
            path.mis_origin,
            path.mis_normal,
            path.direction,
            distance,
        );
        path_add_met(path, emission, pdf, settings);
    }
}

/// The task of a light that was drawn, whose closures give `value` (throughput included);
/// `normal` is the shading normal, bent by displacement.
#[inline]
pub fn path_task(
    path: &Path,
    point: &SurfacePoint,
    normal: Vec3,
    draw: &LightDraw,
    value: Vec3,
    settings: PathSettings,
) -> ShadowTask {
    let start = ShadowStart {
        position: point.position,
        shadow_origin: point.shadow_origin,
        normal,
        true_normal: point.true_normal,
    };
    let segment = ray_to_light(start, draw.wi, draw.point, draw.distance >= LIGHT_FAR);
    let mut leaves = [point.instance, point.primitive];
    if segment.meets_own {
        leaves = [LIGHT_NONE, LIGHT_NONE];
    }
    ShadowTask {
        value,
        origin: segment.origin,
        direction: segment.direction,
        t_min: 0.0,
        t_max: segment.t_max,
        leaves,
        casts_shadow: draw.cast_shadow,
        bounce: path.bounce,
        transparent: settings.transparent_bounces,
        emits: draw.emission.kind,
        light: draw.index,
        instance: draw.instance,
        primitive: draw.primitive,
        uv: draw.uv,
        distance: draw.distance,
    }
}

/// Next-event estimation: the light to try at a hit.
pub fn path_try_light(
    lights: LightView,
    settings: PathSettings,
    path: &Path,
    point: &SurfacePoint,
    set: &LobeSet,
) -> ShadowTask {
    let u = sobol_3d(path.seed, path.sample, path.dimension + DRAW_LIGHT);
    let normal = path_selection_normal(set);
    let draw = light_sample(lights, point.position, normal, u.x, vec2(u.y, u.z));
    let mut task = path_no_task();
    let tried = draw.kind != LIGHT_IS_NONE && draw.pdf > 0.0;
    if tried && path.bounce <= draw.max_bounces {
        // A light that diffuse rays do not see lights no diffuse closure.
        let scattered = closure_set_eval(set, draw.wi, draw.visibility);
        let mut weight = 1.0;
        if draw.mis {
            weight = path_power_heuristic(draw.pdf, scattered.pdf);
        }
        let mut value = path.throughput * scattered.value * (weight / draw.pdf);
        if draw.emission.kind == LIGHT_EMITS_CONSTANT {
            value *= draw.emission.radiance;
            value *= path_keep_small(path, value, settings.light_threshold);
        } else {
            value *= path_light_factor(&draw);
        }
        // Lights may have negative colours.
        if is_finite3(value) && path_max_element(abs3(value)) > 0.0 {
            task = path_task(path, point, set.frame.n, &draw, value, settings);
        }
    }
    task
}

/// What the evaluated emission of a light is to be multiplied with.
#[inline]
pub fn path_light_factor(draw: &LightDraw) -> Vec3 {
    if draw.emission.kind == LIGHT_EMITS_TREE {
        draw.emission.radiance
    } else {
        splat3(1.0)
    }
}

/// Sends the path in the direction that its closures sample; false where it ends.
#[inline]
pub fn path_go_on(
    settings: PathSettings,
    path: &mut Path,
    point: &SurfacePoint,
    set: &LobeSet,
    distance: f32,
) -> bool {
    let u = sobol_3d(path.seed, path.sample, path.dimension + DRAW_SCATTER);
    let next = closure_set_sample(set, u);
    let leaves = [point.instance, point.primitive];
    if next.flags == 0 {
        return false;
    }
    if (next.flags & SCATTER_TRANSPARENT) != 0 {
        return path_pass_through(path, next.weight, leaves, distance, settings);
    }
    let diffuse = (next.flags & SCATTER_DIFFUSE) != 0;
    let alpha = next.roughness * next.roughness;
    let turn = PathTurn {
        position: point.position,
        true_normal: point.true_normal,
        selection_normal: path_selection_normal(set),
        cone_width: point.cone_width,
        cone_spread: cone_spread_after(path.cone_spread, alpha, diffuse),
        leaves,
        wi: next.wi,
        pdf: next.pdf,
        kind: ScatterKind {
            diffuse,
            singular: (next.flags & SCATTER_SINGULAR) != 0,
            transmit: (next.flags & SCATTER_TRANSMIT) != 0,
        },
    };
    path_scatter(path, next.weight, turn, settings)
}

/// Everything that happens at one hit at a distance, metres; false where the path ends. The
/// light to try comes in `task`. `held_out`: the object makes the film transparent.
pub fn path_shade(
    lights: LightView,
    settings: PathSettings,
    path: &mut Path,
    point: &SurfacePoint,
    set: &LobeSet,
    distance: f32,
    held_out: bool,
    task: &mut ShadowTask,
) -> bool {
    // Elsewhere, as in reflections, the object is one like others, as in Cycles.
    if (path.flags & PATH_CAMERA) != 0 {
        let mut cut = closure_mean(set.holdout);
        if held_out {
            cut = 1.0;
        }
        if path_hold_out(path, cut) {
            return false;
        }
    }
    path_meet_surface(lights, path, point, set.emission, distance, settings);
    if (path.flags & PATH_FEATURES_DONE) == 0 {
        let albedo = closure_set_albedo(set);
        let normal = closure_set_normal(set);
        path_note_features(path, albedo, normal, set.transparency, distance);
    }
    if (path.flags & PATH_ENDS) != 0 || !closure_set_has_bsdf(set) {
        return false;
    }
    let survival = path_survival(path, settings);
    path_survive(path, survival);
    if (path.flags & PATH_TERMINATE) != 0 {
        let through = set.transparency;
        let leaves = [point.instance, point.primitive];
        return (through.x != 0.0 || through.y != 0.0 || through.z != 0.0)
            && path_pass_through(path, through, leaves, distance, settings);
    }
    if closure_set_has_eval(set) {
        *task = path_try_light(lights, settings, path, point, set);
    }
    path_go_on(settings, path, point, set, distance)
}

/// Weakens a sampled light by a surface on its way, at the distance `t`, that lets `through` of
/// it pass, and goes on behind it; nothing is left where too many surfaces are.
#[inline]
pub fn path_task_through(task: &mut ShadowTask, through: Vec3, t: f32, leaves: [u32; 2]) {
    if task.transparent == 0 {
        task.value = splat3(0.0);
    } else {
        task.value *= through;
        task.transparent -= 1;
    }
    task.t_min = t;
    task.leaves = leaves;
}
