//! Densities with which `light_sample` finds what a ray meets, for multiple importance
//! sampling: computed by the same code, from the same point `p` and normal `n`.

use crate::device::light_analytic::{LIGHT_FAR, light_direction_pdf, light_sun_contains};
use crate::device::light_choice::light_group_probability;
use crate::device::light_sample::{
    LIGHT_EMITS_NOTHING, LightEmission, light_emission, light_shines, light_triangle_normal,
};
use crate::device::light_tree::light_tree_climb;
use crate::device::light_triangle::light_triangle_pdf;
use crate::device::light_view::{LIGHT_IS_MET, LIGHT_MIRRORED, LIGHT_NONE, LightView};
use crate::device::light_visible::light_sees;
use crate::device::light_world::light_world_pdf;
use glam::Vec3;
use matcha_shade::device::math::vec3;

/// Emitter of a primitive of an instance, or `LIGHT_NONE`.
#[inline(always)]
pub fn light_emitter_of(view: LightView, instance: u32, primitive: u32) -> u32 {
    if instance >= view.first.len() as u32 {
        return LIGHT_NONE;
    }
    let first = view.first[instance as usize];
    if first == LIGHT_NONE || primitive >= view.of_primitive.len() as u32 - first {
        return LIGHT_NONE;
    }
    view.of_primitive[(first + primitive) as usize]
}

/// Density with which `light_sample` finds a point of a triangle that a ray from `p` in the
/// unit direction `wi` meets at `distance`; zero where the triangle is not sampled, or not on
/// this side.
#[inline(always)]
pub fn light_pdf_triangle(
    view: LightView,
    instance: u32,
    primitive: u32,
    p: Vec3,
    n: Vec3,
    wi: Vec3,
    distance: f32,
) -> f32 {
    let emitter = light_emitter_of(view, instance, primitive);
    if emitter == LIGHT_NONE {
        return 0.0;
    }
    let corners = view.triangles[emitter as usize].corners;
    let surface = view.triangles[emitter as usize].surface;
    let flags = view.materials[(surface & !LIGHT_MIRRORED) as usize].flags;
    if !light_shines(flags, light_triangle_normal(corners, surface), wi) {
        return 0.0;
    }
    let climb = light_tree_climb(view, emitter, p, n);
    if climb.probability <= 0.0 {
        return 0.0;
    }
    let chosen = climb.probability * light_group_probability(view, climb.slot, p, n);
    chosen * light_triangle_pdf(corners, p, wi, distance)
}

/// Density with which `light_sample` finds the world in the unit direction `wi`.
#[inline(always)]
pub fn light_pdf_world(view: LightView, p: Vec3, n: Vec3, wi: Vec3) -> f32 {
    if view.world_width == 0 {
        return 0.0;
    }
    light_group_probability(view, view.world_slot, p, n) * light_world_pdf(view, wi)
}

/// An analytic light on the way of a ray.
#[derive(Clone, Copy, Debug)]
pub struct LightMet {
    /// Which.
    pub index: u32,
    /// Radiance towards the ray's origin; `LIGHT_EMITS_NOTHING`: the ray does not see it.
    pub emission: LightEmission,
    /// Density with which `light_sample` finds the direction from the point of the last
    /// scattering.
    pub pdf: f32,
    /// Bounces after which it still counts.
    pub max_bounces: u32,
}

/// No light is seen.
#[inline(always)]
pub fn light_met_nothing() -> LightMet {
    LightMet {
        index: LIGHT_NONE,
        emission: LightEmission {
            kind: LIGHT_EMITS_NOTHING,
            radiance: vec3(0.0, 0.0, 0.0),
        },
        pdf: 0.0,
        max_bounces: 0,
    }
}

/// Radiance and density of an analytic light that a ray in the unit direction `wi` meets.
/// `p` and `n` belong to the last scattering and `distance` counts from there.
#[inline(always)]
pub fn light_met(
    view: LightView,
    index: u32,
    p: Vec3,
    n: Vec3,
    wi: Vec3,
    distance: f32,
) -> LightMet {
    let mut met = light_met_nothing();
    let shape = view.lights[index as usize].shape;
    met.emission = light_emission(&shape, view.lights[index as usize].tree, p, wi);
    if met.emission.kind != LIGHT_EMITS_NOTHING {
        let slot = view.lights[index as usize].slot;
        let chosen = light_group_probability(view, slot, p, n);
        met.index = index;
        met.pdf = chosen * light_direction_pdf(&shape, p, n, wi, distance);
        met.max_bounces = view.lights[index as usize].max_bounces;
    }
    met
}

/// Sun `k` as a ray sees it that left the scene in the unit direction `wi`; `kind` is the
/// ray's `RAY_` bit, `p` and `n` belong to the last scattering.
#[inline(always)]
pub fn light_sun_met(view: LightView, k: u32, p: Vec3, n: Vec3, wi: Vec3, kind: u32) -> LightMet {
    let index = view.suns[k as usize];
    // Unlike other lights, a sun without multiple importance is not even on camera.
    let is_met = (view.lights[index as usize].flags & LIGHT_IS_MET) != 0;
    if is_met && light_sees(view, index, kind) {
        let shape = view.lights[index as usize].shape;
        if light_sun_contains(&shape, wi) {
            return light_met(view, index, p, n, wi, LIGHT_FAR);
        }
    }
    light_met_nothing()
}
