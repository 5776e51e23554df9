//! Next-event estimation: a light is drawn, and a direction to it.
//!
//! All densities are over solid angle and include the choice of the light.

use crate::device::light_analytic::{
    AnalyticLight, LIGHT_FAR, light_attenuation, light_direction_sample,
};
use crate::device::light_choice::light_choose_group;
use crate::device::light_tree::light_tree_sample;
use crate::device::light_triangle::{LightTriangle, light_triangle_sample};
use crate::device::light_view::{
    LIGHT_BACK, LIGHT_CASTS_SHADOW, LIGHT_FRONT, LIGHT_GROUP_IS_LIGHT, LIGHT_GROUP_IS_TREE,
    LIGHT_GROUP_WHAT, LIGHT_IS_MET, LIGHT_MIRRORED, LIGHT_NONE, LIGHT_UNIFORM, LightView,
};
use crate::device::light_world::light_world_sample;
use crate::device::ray_kind::RAY_ALL;
use glam::{Vec2, Vec3};
use matcha_shade::device::math::{cross, dot, length, normalize, vec2, vec3};

/// No light.
pub const LIGHT_IS_NONE: u32 = 0;
/// An emissive triangle.
pub const LIGHT_IS_TRIANGLE: u32 = 1;
/// An analytic light.
pub const LIGHT_IS_ANALYTIC: u32 = 2;
/// The world.
pub const LIGHT_IS_WORLD: u32 = 3;

/// Nothing is emitted.
pub const LIGHT_EMITS_NOTHING: u32 = 0;
/// The radiance is known.
pub const LIGHT_EMITS_CONSTANT: u32 = 1;
/// The radiance is the emission of a triangle's material.
pub const LIGHT_EMITS_SURFACE: u32 = 2;
/// The radiance is a factor times the emission of the analytic light's node tree.
pub const LIGHT_EMITS_TREE: u32 = 3;
/// The radiance is the world's.
pub const LIGHT_EMITS_WORLD: u32 = 4;

/// What a light radiates in a direction.
#[derive(Clone, Copy, Debug)]
pub struct LightEmission {
    /// One of the `LIGHT_EMITS_` kinds.
    pub kind: u32,
    /// Radiance, or the factor of a node tree, W·sr⁻¹·m⁻².
    pub radiance: Vec3,
}

/// A direction that next-event estimation should try.
#[derive(Clone, Copy, Debug)]
pub struct LightDraw {
    /// One of the `LIGHT_IS_` kinds; [`LIGHT_IS_NONE`]: there is nothing to try.
    pub kind: u32,
    /// Index of the triangle or the analytic light.
    pub index: u32,
    /// Unit direction to it.
    pub wi: Vec3,
    /// Distance, metres; [`LIGHT_FAR`] for suns and the world.
    pub distance: f32,
    /// Point on the light; for distant ones the direction.
    pub point: Vec3,
    /// Unit normal there: of a triangle its front's, of a light the side that shines.
    pub normal: Vec3,
    /// Density, with the choice of the light.
    pub pdf: f32,
    /// What it radiates towards the point.
    pub emission: LightEmission,
    /// Of a triangle: index into `Scene::instances`.
    pub instance: u32,
    /// Of a triangle: which of its mesh.
    pub primitive: u32,
    /// Of a triangle: barycentric coordinates, weights of corners 1 and 2.
    pub uv: Vec2,
    /// Blocked by objects.
    pub cast_shadow: bool,
    /// Weigh against BSDF samples; if false the sample counts whole.
    pub mis: bool,
    /// Which closures see it: `RAY_` bits.
    pub visibility: u32,
    /// Bounces after which it still counts.
    pub max_bounces: u32,
}

/// Nothing to try.
#[inline(always)]
pub fn light_no_draw() -> LightDraw {
    let zero = vec3(0.0, 0.0, 0.0);
    LightDraw {
        kind: LIGHT_IS_NONE,
        index: LIGHT_NONE,
        wi: zero,
        distance: 0.0,
        point: zero,
        normal: zero,
        pdf: 0.0,
        emission: LightEmission {
            kind: LIGHT_EMITS_NOTHING,
            radiance: zero,
        },
        instance: LIGHT_NONE,
        primitive: LIGHT_NONE,
        uv: vec2(0.0, 0.0),
        cast_shadow: true,
        mis: true,
        visibility: RAY_ALL,
        max_bounces: LIGHT_NONE,
    }
}

/// Unit normal of a triangle's front side; `surface` as in `EmissiveTriangle`.
#[inline(always)]
pub fn light_triangle_normal(corners: LightTriangle, surface: u32) -> Vec3 {
    let across = cross(corners.b - corners.a, corners.c - corners.a);
    let normal = normalize(across);
    if (surface & LIGHT_MIRRORED) != 0 {
        return -normal;
    }
    normal
}

/// True where a triangle with the given front normal shines against the direction `wi`;
/// `flags` as in `LightMaterial`.
#[inline(always)]
pub fn light_shines(flags: u32, normal: Vec3, wi: Vec3) -> bool {
    let sides = flags & (LIGHT_FRONT | LIGHT_BACK);
    let cosine = dot(normal, wi);
    let front = sides == LIGHT_FRONT && cosine < 0.0;
    let back = sides == LIGHT_BACK && cosine > 0.0;
    sides == (LIGHT_FRONT | LIGHT_BACK) || front || back
}

/// What an analytic light radiates towards `p` from the direction `wi`; `tree` as in `LightOf`.
#[inline]
pub fn light_emission(shape: &AnalyticLight, tree: u32, p: Vec3, wi: Vec3) -> LightEmission {
    let attenuation = light_attenuation(shape, p, wi);
    let mut kind = LIGHT_EMITS_NOTHING;
    if attenuation > 0.0 {
        kind = LIGHT_EMITS_CONSTANT;
        if tree != LIGHT_NONE {
            kind = LIGHT_EMITS_TREE;
        }
    }
    LightEmission {
        kind,
        radiance: shape.radiance * attenuation,
    }
}

/// Samples an emissive triangle that was drawn with the probability `chosen`.
#[inline(always)]
pub fn light_sample_triangle(
    view: LightView,
    emitter: u32,
    p: Vec3,
    u: Vec2,
    chosen: f32,
) -> LightDraw {
    let triangle = view.triangles[emitter as usize];
    let material = view.materials[(triangle.surface & !LIGHT_MIRRORED) as usize];
    let c = triangle.corners;
    let sampled = light_triangle_sample(c, p, u);
    let point = c.a + (c.b - c.a) * sampled.uv.x + (c.c - c.a) * sampled.uv.y;
    let distance = length(point - p);
    let wi = (point - p) / distance;
    let normal = light_triangle_normal(c, triangle.surface);
    let mut draw = light_no_draw();
    if sampled.pdf > 0.0 && distance > 0.0 && light_shines(material.flags, normal, wi) {
        draw.kind = LIGHT_IS_TRIANGLE;
        draw.index = emitter;
        draw.wi = wi;
        draw.distance = distance;
        draw.point = point;
        draw.normal = normal;
        draw.pdf = sampled.pdf * chosen;
        draw.emission = LightEmission {
            kind: LIGHT_EMITS_SURFACE,
            radiance: material.radiance,
        };
        if (material.flags & LIGHT_UNIFORM) != 0 {
            draw.emission.kind = LIGHT_EMITS_CONSTANT;
        }
        draw.instance = triangle.instance;
        draw.primitive = triangle.primitive;
        draw.uv = sampled.uv;
    }
    draw
}

/// Samples an analytic light that was drawn with the probability `chosen`.
#[inline(always)]
pub fn light_sample_analytic(
    view: LightView,
    index: u32,
    p: Vec3,
    n: Vec3,
    u: Vec2,
    chosen: f32,
) -> LightDraw {
    let shape = view.lights[index as usize].shape;
    let sampled = light_direction_sample(&shape, p, n, u);
    let mut draw = light_no_draw();
    if sampled.pdf > 0.0 && sampled.distance > 0.0 {
        let tree = view.lights[index as usize].tree;
        draw.emission = light_emission(&shape, tree, p, sampled.direction);
        if draw.emission.kind != LIGHT_EMITS_NOTHING {
            draw.kind = LIGHT_IS_ANALYTIC;
        }
        draw.index = index;
        draw.wi = sampled.direction;
        draw.distance = sampled.distance;
        draw.point = sampled.point;
        draw.normal = sampled.normal;
        draw.pdf = sampled.pdf * chosen;
        let flags = view.lights[index as usize].flags;
        draw.cast_shadow = (flags & LIGHT_CASTS_SHADOW) != 0;
        draw.mis = (flags & LIGHT_IS_MET) != 0;
        draw.visibility = view.lights[index as usize].visibility;
        draw.max_bounces = view.lights[index as usize].max_bounces;
    }
    draw
}

/// Samples the world, which was drawn with the probability `chosen`.
#[inline(always)]
pub fn light_sample_world(view: LightView, u: Vec2, chosen: f32) -> LightDraw {
    let sampled = light_world_sample(view, u);
    let mut draw = light_no_draw();
    if sampled.pdf > 0.0 {
        draw.kind = LIGHT_IS_WORLD;
        draw.wi = sampled.direction;
        draw.distance = LIGHT_FAR;
        draw.point = sampled.direction;
        draw.normal = -sampled.direction;
        draw.pdf = sampled.pdf * chosen;
        draw.emission.kind = LIGHT_EMITS_WORLD;
        draw.visibility = view.world_visibility;
    }
    draw
}

/// Draws a light and a direction to it from the point `p`, whose unit normal is `n`, or zero
/// where light from both sides counts. `select` and `u` are in [0, 1).
#[inline(always)]
pub fn light_sample(view: LightView, p: Vec3, n: Vec3, select: f32, u: Vec2) -> LightDraw {
    let group = light_choose_group(view, p, n, select);
    if group.link == LIGHT_NONE {
        return light_no_draw();
    }
    let what = group.link & LIGHT_GROUP_WHAT;
    let index = group.link & !LIGHT_GROUP_WHAT;
    if what == LIGHT_GROUP_IS_LIGHT {
        return light_sample_analytic(view, index, p, n, u, group.probability);
    }
    if what == LIGHT_GROUP_IS_TREE {
        let emitter = light_tree_sample(view, index, p, n, group.place);
        if !emitter.found {
            return light_no_draw();
        }
        let chosen = group.probability * emitter.probability;
        return light_sample_triangle(view, emitter.index, p, u, chosen);
    }
    light_sample_world(view, u, group.probability)
}
