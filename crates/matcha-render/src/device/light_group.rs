//! How much a group of lights may matter to a shading point: the most and the least that it
//! could bring.
//!
//! The most is the importance of Conty Estevez and Kulla 2018, "Importance Sampling of Many
//! Lights with Adaptive Tree Splitting", §4. One light a sample cannot split where that bound
//! is loose, so that Cycles averages the choice by the most with the choice by the least.
//! Matcha follows Cycles here, because a picture can depend on the choice (ADR 0006).

use crate::device::light_importance::light_sine;
use crate::device::light_view::LightView;
use glam::Vec3;
use matcha_shade::device::math::{abs, abs3, dot, max, min, select, select3, sqrt, vec3};

/// [`LightGroup::kind`]: everything inside of a box.
pub const LIGHT_GROUP_BOX: u32 = 0;
/// [`LightGroup::kind`]: a ball.
pub const LIGHT_GROUP_BALL: u32 = 1;
/// [`LightGroup::kind`]: a disc that turns to the point.
pub const LIGHT_GROUP_DISC: u32 = 2;
/// [`LightGroup::kind`]: a rectangle.
pub const LIGHT_GROUP_RECTANGLE: u32 = 3;
/// [`LightGroup::kind`]: lights at infinity.
pub const LIGHT_GROUP_DISTANT: u32 = 4;

/// A light, all emissive triangles of an instance, or several of those.
#[derive(Clone, Copy, Debug)]
pub struct LightGroup {
    /// One of the `LIGHT_GROUP_` kinds.
    pub kind: u32,
    /// Middle, metres.
    pub center: Vec3,
    /// Half the box's diagonal; half a side of the rectangle; in x the radius of a ball or
    /// disc, metres; in x of distant lights the cosine of the cone around the axis that
    /// holds them.
    pub half: Vec3,
    /// Half the other side of the rectangle, metres.
    pub side: Vec3,
    /// Unit axis of the cone of normals.
    pub axis: Vec3,
    /// Cosine of θo, the largest angle between the axis and a normal.
    pub cos_normals: f32,
    /// Cosine of θe, the largest angle between a normal and a direction that it shines to.
    pub cos_emission: f32,
    /// Luminous intensity along the normals, W·sr⁻¹; irradiance of distant ones, W·m⁻².
    pub power: f32,
}

/// What a group could bring.
#[derive(Clone, Copy, Debug)]
pub struct LightRange {
    /// Zero only where it brings nothing.
    pub most: f32,
    /// Zero where it may bring nothing.
    pub least: f32,
}

/// A group in lane `lane` of a block.
#[inline(always)]
pub fn light_group(view: LightView, block: u32, lane: u32) -> LightGroup {
    LightGroup {
        kind: view.groups[block as usize].kind[lane as usize],
        center: vec3(
            view.groups[block as usize].center_x[lane as usize],
            view.groups[block as usize].center_y[lane as usize],
            view.groups[block as usize].center_z[lane as usize],
        ),
        half: vec3(
            view.groups[block as usize].half_x[lane as usize],
            view.groups[block as usize].half_y[lane as usize],
            view.groups[block as usize].half_z[lane as usize],
        ),
        side: vec3(
            view.groups[block as usize].side_x[lane as usize],
            view.groups[block as usize].side_y[lane as usize],
            view.groups[block as usize].side_z[lane as usize],
        ),
        axis: vec3(
            view.groups[block as usize].axis_x[lane as usize],
            view.groups[block as usize].axis_y[lane as usize],
            view.groups[block as usize].axis_z[lane as usize],
        ),
        cos_normals: view.groups[block as usize].cos_normals[lane as usize],
        cos_emission: view.groups[block as usize].cos_emission[lane as usize],
        power: view.groups[block as usize].power[lane as usize],
    }
}

/// The cone from a point around a rectangle's middle.
#[derive(Clone, Copy, Debug)]
pub struct LightCorners {
    /// Cosine of the largest angle between the middle and a corner.
    pub cosine: f32,
    /// Largest squared distance of a corner, m².
    pub far2: f32,
}

/// Corners of a rectangle around `to`, seen from the origin.
#[inline]
pub fn light_corners(to: Vec3, half: Vec3, side: Vec3) -> LightCorners {
    let inverse = 1.0 / sqrt(max(dot(to, to), 1e-30));
    let mut cosine = 1.0;
    let mut far2 = 0.0;
    let mut k = 0;
    while k < 4 {
        let along = select(-1.0, 1.0, (k & 1) == 0);
        let across = select(-1.0, 1.0, (k & 2) == 0);
        let corner = to + half * along + side * across;
        let d2 = max(dot(corner, corner), 1e-30);
        cosine = min(cosine, dot(to, corner) * inverse / sqrt(d2));
        far2 = max(far2, d2);
        k += 1;
    }
    LightCorners { cosine, far2 }
}

/// The cone from a point that holds a group, and squared distances.
#[derive(Clone, Copy, Debug)]
pub struct LightCone {
    /// Unit axis.
    pub axis: Vec3,
    /// Cosine of the half angle.
    pub cosine: f32,
    /// Squared distance for the most that the group brings, m².
    pub near2: f32,
    /// Squared distance for the least that it brings, m².
    pub far2: f32,
}

/// The cone that holds a group around `to`, seen from the origin; `corners` of a rectangle.
#[inline(always)]
pub fn light_cone(g: LightGroup, to: Vec3, corners: LightCorners) -> LightCone {
    let is_disc = g.kind == LIGHT_GROUP_DISC;
    let is_ball = g.kind == LIGHT_GROUP_BALL;
    let is_box = g.kind == LIGHT_GROUP_BOX;
    let is_distant = g.kind == LIGHT_GROUP_DISTANT;
    let is_rectangle = g.kind == LIGHT_GROUP_RECTANGLE;
    let d2 = max(dot(to, to), 1e-30);
    let r2 = dot(g.half, g.half);
    let around = d2 <= r2;
    // A sphere: its tangents; no direction is ruled out inside.
    let outside = max(1.0 - r2 / d2, 0.0);
    let of_sphere = select(sqrt(outside), -1.0, around);
    let of_disc = sqrt(d2 / (d2 + r2));
    let cosine = select(
        select(
            select(of_sphere, of_disc, is_disc),
            corners.cosine,
            is_rectangle,
        ),
        g.half.x,
        is_distant,
    );
    // Within a box the distance says nothing: not less than half its radius. The tangents of a
    // ball end farther away than its middle is; inside, all of it shines.
    let box2 = max(d2, 0.25 * r2);
    let ball_near2 = select(d2, 0.5 * r2, around);
    let ball_far2 = select(d2 / max(outside, 1e-12), 0.5 * r2, around);
    let near2 = select(select(d2, ball_near2, is_ball), box2, is_box);
    let far2 = select(
        select(select(corners.far2, d2 + r2, is_disc), ball_far2, is_ball),
        box2,
        is_box,
    );
    LightCone {
        axis: select3(to * (1.0 / sqrt(d2)), -g.axis, is_distant),
        cosine,
        near2: max(select(near2, 1.0, is_distant), 1e-12),
        far2: max(select(far2, 1.0, is_distant), 1e-12),
    }
}

/// Whether a group reaches over the horizon of a surface with unit normal `n`, and a rectangle
/// shows the surface its front. Balls and distant lights are left to their cones.
#[inline(always)]
pub fn light_group_faces(g: LightGroup, to: Vec3, n: Vec3, opaque: bool) -> bool {
    let is_box = g.kind == LIGHT_GROUP_BOX;
    let is_rectangle = g.kind == LIGHT_GROUP_RECTANGLE;
    let box_reach = dot(abs3(n), g.half);
    let rectangle_reach = abs(dot(n, g.half)) + abs(dot(n, g.side));
    let above = dot(n, to) + select(rectangle_reach, box_reach, is_box) > 0.0;
    let front = dot(g.axis, to) < 0.0;
    (!opaque | above | !(is_box | is_rectangle)) & (front | !is_rectangle)
}

/// The most and the least irradiance that a group may bring to the point `p` with unit normal
/// `n` (zero where light from both sides counts), without what is in between.
///
/// Conditions are joined without short circuits, so that a loop over groups becomes vector
/// code.
#[inline(always)]
pub fn light_range(g: LightGroup, corners: LightCorners, p: Vec3, n: Vec3) -> LightRange {
    let to = g.center - p;
    let cone = light_cone(g, to, corners);
    let cos_u = cone.cosine;
    let sin_u = light_sine(cos_u);
    // Smallest and largest angle of incidence.
    let opaque = dot(n, n) > 0.0;
    let cos_i = dot(cone.axis, n);
    let sin_i = light_sine(cos_i);
    let high = select(cos_i * cos_u + sin_i * sin_u, 1.0, cos_i >= cos_u);
    let low = max(cos_i * cos_u - sin_i * sin_u, 0.0);
    let in_near = select(1.0, high, opaque);
    let in_far = select(1.0, low, opaque);
    // A ball turns a normal to everyone.
    let radial = (g.kind == LIGHT_GROUP_BALL) | (g.kind == LIGHT_GROUP_DISC);
    let turns = radial & (g.cos_normals < 0.0);
    let cos_o = select(g.cos_normals, 1.0, turns);
    let sin_o = light_sine(cos_o);
    let cos_e = g.cos_emission;
    let sin_e = light_sine(cos_e);
    // Smallest angle between the axis and a direction from the group to the point, and then
    // between a normal and it …
    let cos_a = select(max(-dot(g.axis, cone.axis), -1.0), 1.0, turns);
    let sin_a = light_sine(cos_a);
    let nearest = cos_a * cos_u + sin_a * sin_u;
    let head_on = (cos_a >= cos_u) | (nearest >= cos_o);
    let turned = nearest * cos_o + light_sine(nearest) * sin_o;
    let out_near = select(max(turned, 0.0), 1.0, head_on);
    let everywhere = cos_o < -cos_e;
    let shines = head_on | everywhere | (nearest > cos_o * cos_e - sin_o * sin_e);
    // … and the largest.
    let farthest = cos_a * cos_u - sin_a * sin_u;
    let out_far = max(farthest * cos_o - light_sine(farthest) * sin_o, 0.0);
    let always = (cos_e <= cos_o)
        & (cos_a >= 0.0)
        & (cos_u >= 0.0)
        & (farthest >= cos_e * cos_o + sin_e * sin_o);
    let seen = light_group_faces(g, to, n, opaque) & (in_near >= 0.0) & shines;
    let most = g.power * in_near * out_near / cone.near2;
    let least = g.power * in_far * out_far / cone.far2;
    LightRange {
        most: select(0.0, most, seen),
        least: select(0.0, least, seen & always),
    }
}
