//! The world as a light: its importance map.
//!
//! The map is equirectangular with rows that are uniform in latitude; row 0 is around +Z.
//! Inside of a texel directions are uniform in SOLID ANGLE, so that the density is constant
//! there.
//!
//! [`LightView::world`] holds, for w × h texels: h + 1 cumulative probabilities of the rows,
//! h + 1 cosines of the rows' edges, h solid angles of a row's texel (steradians), and for
//! each row w + 1 cumulative probabilities of its texels.

use crate::device::light_importance::light_world_irradiance;
use crate::device::light_tree::LIGHT_ONE_BELOW;
use crate::device::light_view::LightView;
use glam::{Vec2, Vec3};
use matcha_shade::device::math::{
    PI, TAU, acos, atan2, clamp, cos, max, select, select_u32, sin, sqrt, to_int, vec3,
};

/// Start of the cosines of the rows' edges in the tables of a map with `height` rows.
#[inline(always)]
pub fn light_world_cosines(height: u32) -> u32 {
    height + 1
}

/// Start of the solid angles of the rows' texels.
#[inline(always)]
pub fn light_world_angles(height: u32) -> u32 {
    2 * (height + 1)
}

/// Start of the cumulative probabilities of a row's texels.
#[inline(always)]
pub fn light_world_row(width: u32, height: u32, y: u32) -> u32 {
    3 * height + 2 + y * (width + 1)
}

/// A direction to the world.
#[derive(Clone, Copy, Debug)]
pub struct LightWorldDirection {
    /// Unit direction.
    pub direction: Vec3,
    /// Density over solid angle.
    pub pdf: f32,
}

/// True for the zero normal of a point where light from both sides counts.
#[inline(always)]
pub fn light_from_both_sides(n: Vec3) -> bool {
    n.x == 0.0 && n.y == 0.0 && n.z == 0.0
}

/// Estimate of the irradiance that the world brings to a surface with unit normal `n`, over
/// that of its mean radiance; zero `n`: mean of both sides.
#[inline(always)]
pub fn light_world_factor(view: LightView, n: Vec3) -> f32 {
    if light_from_both_sides(n) {
        return 1.0;
    }
    // Nine harmonics ring around sharp suns: never below a tenth of the mean.
    let estimate = light_world_irradiance(view.world_harmonics, n) / view.world_irradiance;
    max(estimate, 0.1)
}

/// An interval of a cumulative distribution.
#[derive(Clone, Copy, Debug)]
pub struct LightInterval {
    /// Which.
    pub index: u32,
    /// Place inside, in [0, 1).
    pub place: f32,
}

/// Interval that holds `u` in the cumulative distribution of `count` intervals that begins
/// at `start` of the world's tables.
#[inline(always)]
pub fn light_world_find(view: LightView, start: u32, count: u32, u: f32) -> LightInterval {
    // The last edge is 1, above every u.
    let mut low = 0;
    let mut high = count;
    while high - low > 1 {
        let middle = (low + high) / 2;
        let above = view.world[(start + middle) as usize] <= u;
        low = select_u32(low, middle, above);
        high = select_u32(middle, high, above);
    }
    let from = view.world[(start + low) as usize];
    let width = view.world[(start + low + 1) as usize] - from;
    let place = select(
        0.5,
        (u - from) / select(1.0, width, width > 0.0),
        width > 0.0,
    );
    LightInterval {
        index: low,
        place: clamp(place, 0.0, LIGHT_ONE_BELOW),
    }
}

/// Density over solid angle in a texel of the map.
#[inline(always)]
pub fn light_world_texel_pdf(view: LightView, x: u32, y: u32) -> f32 {
    let row = light_world_row(view.world_width, view.world_height, y) + x;
    let of_row = view.world[(y + 1) as usize] - view.world[y as usize];
    let of_texel = view.world[(row + 1) as usize] - view.world[row as usize];
    let angle = view.world[(light_world_angles(view.world_height) + y) as usize];
    of_row * of_texel / angle
}

/// A direction of the map for `u` in [0, 1)².
#[inline(always)]
pub fn light_world_sample(view: LightView, u: Vec2) -> LightWorldDirection {
    let row = light_world_find(view, 0, view.world_height, u.y);
    let start = light_world_row(view.world_width, view.world_height, row.index);
    let column = light_world_find(view, start, view.world_width, u.x);
    let edge = light_world_cosines(view.world_height) + row.index;
    let top = view.world[edge as usize];
    let bottom = view.world[(edge + 1) as usize];
    let z = top + (bottom - top) * row.place;
    let azimuth = PI - TAU * (column.index as f32 + column.place) / view.world_width as f32;
    let level = sqrt(max(1.0 - z * z, 0.0));
    LightWorldDirection {
        direction: vec3(level * cos(azimuth), level * sin(azimuth), z),
        pdf: light_world_texel_pdf(view, column.index, row.index),
    }
}

/// `x` · `count` as an index below `count`, for `x` from 0 to 1.
#[inline(always)]
pub fn light_world_index(x: f32, count: u32) -> u32 {
    to_int(clamp(x * count as f32, 0.0, (count - 1) as f32)) as u32
}

/// Density with which [`light_world_sample`] finds a unit direction.
#[inline(always)]
pub fn light_world_pdf(view: LightView, direction: Vec3) -> f32 {
    let s = 0.5 - atan2(direction.y, direction.x) / TAU;
    let t = acos(clamp(direction.z, -1.0, 1.0)) / PI;
    let x = light_world_index(s, view.world_width);
    let y = light_world_index(t, view.world_height);
    light_world_texel_pdf(view, x, y)
}
