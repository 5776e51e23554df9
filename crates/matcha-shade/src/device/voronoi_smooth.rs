//! Cellular noise: smooth F1 for each number of dimensions.
#![allow(clippy::too_many_arguments)]

use super::math::*;
use super::voronoi::*;

/// Before the blend: distance, and 1 until the first point.
#[inline(always)]
pub fn voronoi_smooth_init(
    _c: Vec3,
    _cw: f32,
    _f: Vec3,
    _fw: f32,
    _randomness: f32,
    _smoothness: f32,
    _exponent: f32,
    _metric: u32,
) -> [f32; 8] {
    [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
}

/// The smooth colour.
#[inline(always)]
pub fn voronoi_smooth_color(
    _c: Vec3,
    _cw: f32,
    _f: Vec3,
    _fw: f32,
    _randomness: f32,
    _smoothness: f32,
    _exponent: f32,
    _metric: u32,
    s: [f32; 8],
) -> Vec3 {
    vec3(s[1], s[2], s[3])
}

/// The smooth position, seen from the cell's corner.
#[inline(always)]
pub fn voronoi_smooth_position(
    _c: Vec3,
    _cw: f32,
    _f: Vec3,
    _fw: f32,
    _randomness: f32,
    _smoothness: f32,
    _exponent: f32,
    _metric: u32,
    s: [f32; 8],
) -> [f32; 4] {
    [s[4], s[5], s[6], s[7]]
}

/// One cell of the smooth blend. `metric` is a literal where speed matters.
#[inline(always)]
pub fn voronoi_smooth_cell(
    i: u32,
    corner: Quad,
    inside: Quad,
    randomness: f32,
    smoothness: f32,
    exponent: f32,
    metric: u32,
    dims: u32,
    s: [f32; 8],
) -> [f32; 8] {
    let to_point = voronoi_to_point(i, 2, corner, inside, randomness, dims);
    let width = voronoi_smooth_width(smoothness);
    let distance = voronoi_length(to_point, exponent, metric, dims);
    let h = voronoi_smooth_blend(s[0], distance, max(width, 1.0e-6), i == 0);
    let correction = width * h * (1.0 - h);
    let small = correction / (1.0 + 3.0 * width);
    let color = voronoi_cell_color(quad_add(corner, voronoi_offset(i, 2, dims)), dims);
    let point = quad_add(to_point, inside);
    [
        mix(s[0], distance, h) - correction,
        mix(s[1], color.x, h) - small,
        mix(s[2], color.y, h) - small,
        mix(s[3], color.z, h) - small,
        mix(s[4], point.x, h) - small,
        mix(s[5], point.y, h) - small,
        mix(s[6], point.z, h) - small,
        mix(s[7], point.w, h) - small,
    ]
}

/// Cells that the smooth blend reaches in 1 dimension.
#[inline(always)]
pub fn voronoi_smooth_count_1d(
    _c: Vec3,
    _cw: f32,
    _f: Vec3,
    _fw: f32,
    _randomness: f32,
    _smoothness: f32,
    _exponent: f32,
    _metric: u32,
) -> u32 {
    5
}

/// One cell of the smooth blend in 1 dimension, Euclidean.
#[inline(always)]
pub fn voronoi_smooth_step_1d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    smoothness: f32,
    exponent: f32,
    _metric: u32,
    s: [f32; 8],
) -> [f32; 8] {
    voronoi_smooth_cell(
        i,
        quad(c, cw),
        quad(f, fw),
        randomness,
        smoothness,
        exponent,
        METRIC_EUCLIDEAN,
        1,
        s,
    )
}

/// One cell of the smooth blend in 1 dimension, any metric.
#[inline(always)]
pub fn voronoi_smooth_metric_step_1d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    smoothness: f32,
    exponent: f32,
    metric: u32,
    s: [f32; 8],
) -> [f32; 8] {
    voronoi_smooth_cell(
        i,
        quad(c, cw),
        quad(f, fw),
        randomness,
        smoothness,
        exponent,
        metric,
        1,
        s,
    )
}

/// Cells that the smooth blend reaches in 2 dimensions.
#[inline(always)]
pub fn voronoi_smooth_count_2d(
    _c: Vec3,
    _cw: f32,
    _f: Vec3,
    _fw: f32,
    _randomness: f32,
    _smoothness: f32,
    _exponent: f32,
    _metric: u32,
) -> u32 {
    25
}

/// One cell of the smooth blend in 2 dimensions, Euclidean.
#[inline(always)]
pub fn voronoi_smooth_step_2d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    smoothness: f32,
    exponent: f32,
    _metric: u32,
    s: [f32; 8],
) -> [f32; 8] {
    voronoi_smooth_cell(
        i,
        quad(c, cw),
        quad(f, fw),
        randomness,
        smoothness,
        exponent,
        METRIC_EUCLIDEAN,
        2,
        s,
    )
}

/// One cell of the smooth blend in 2 dimensions, any metric.
#[inline(always)]
pub fn voronoi_smooth_metric_step_2d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    smoothness: f32,
    exponent: f32,
    metric: u32,
    s: [f32; 8],
) -> [f32; 8] {
    voronoi_smooth_cell(
        i,
        quad(c, cw),
        quad(f, fw),
        randomness,
        smoothness,
        exponent,
        metric,
        2,
        s,
    )
}

/// Cells that the smooth blend reaches in 3 dimensions.
#[inline(always)]
pub fn voronoi_smooth_count_3d(
    _c: Vec3,
    _cw: f32,
    _f: Vec3,
    _fw: f32,
    _randomness: f32,
    _smoothness: f32,
    _exponent: f32,
    _metric: u32,
) -> u32 {
    125
}

/// One cell of the smooth blend in 3 dimensions, Euclidean.
#[inline(always)]
pub fn voronoi_smooth_step_3d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    smoothness: f32,
    exponent: f32,
    _metric: u32,
    s: [f32; 8],
) -> [f32; 8] {
    voronoi_smooth_cell(
        i,
        quad(c, cw),
        quad(f, fw),
        randomness,
        smoothness,
        exponent,
        METRIC_EUCLIDEAN,
        3,
        s,
    )
}

/// One cell of the smooth blend in 3 dimensions, any metric.
#[inline(always)]
pub fn voronoi_smooth_metric_step_3d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    smoothness: f32,
    exponent: f32,
    metric: u32,
    s: [f32; 8],
) -> [f32; 8] {
    voronoi_smooth_cell(
        i,
        quad(c, cw),
        quad(f, fw),
        randomness,
        smoothness,
        exponent,
        metric,
        3,
        s,
    )
}

/// Cells that the smooth blend reaches in 4 dimensions.
#[inline(always)]
pub fn voronoi_smooth_count_4d(
    _c: Vec3,
    _cw: f32,
    _f: Vec3,
    _fw: f32,
    _randomness: f32,
    _smoothness: f32,
    _exponent: f32,
    _metric: u32,
) -> u32 {
    625
}

/// One cell of the smooth blend in 4 dimensions, Euclidean.
#[inline(always)]
pub fn voronoi_smooth_step_4d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    smoothness: f32,
    exponent: f32,
    _metric: u32,
    s: [f32; 8],
) -> [f32; 8] {
    voronoi_smooth_cell(
        i,
        quad(c, cw),
        quad(f, fw),
        randomness,
        smoothness,
        exponent,
        METRIC_EUCLIDEAN,
        4,
        s,
    )
}

/// One cell of the smooth blend in 4 dimensions, any metric.
#[inline(always)]
pub fn voronoi_smooth_metric_step_4d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    smoothness: f32,
    exponent: f32,
    metric: u32,
    s: [f32; 8],
) -> [f32; 8] {
    voronoi_smooth_cell(
        i,
        quad(c, cw),
        quad(f, fw),
        randomness,
        smoothness,
        exponent,
        metric,
        4,
        s,
    )
}

/// Before the blend of distances alone.
#[inline(always)]
pub fn voronoi_smooth_distance_init(
    _c: Vec3,
    _cw: f32,
    _f: Vec3,
    _fw: f32,
    _randomness: f32,
    _smoothness: f32,
    _exponent: f32,
    _metric: u32,
) -> [f32; 1] {
    [0.0]
}

/// The blended distance.
#[inline(always)]
pub fn voronoi_smooth_distance_finish(
    _c: Vec3,
    _cw: f32,
    _f: Vec3,
    _fw: f32,
    _randomness: f32,
    _smoothness: f32,
    _exponent: f32,
    _metric: u32,
    s: [f32; 1],
) -> f32 {
    s[0]
}

/// One cell of the blend of distances alone.
#[inline(always)]
pub fn voronoi_smooth_distance_cell(
    i: u32,
    corner: Quad,
    inside: Quad,
    randomness: f32,
    smoothness: f32,
    exponent: f32,
    metric: u32,
    dims: u32,
    before: f32,
) -> f32 {
    let to_point = voronoi_to_point(i, 2, corner, inside, randomness, dims);
    let width = voronoi_smooth_width(smoothness);
    let distance = voronoi_length(to_point, exponent, metric, dims);
    let h = voronoi_smooth_blend(before, distance, max(width, 1.0e-6), i == 0);
    mix(before, distance, h) - width * h * (1.0 - h)
}

/// One cell of the blend of distances alone in 1 dimension, Euclidean.
#[inline(always)]
pub fn voronoi_smooth_distance_step_1d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    smoothness: f32,
    exponent: f32,
    _metric: u32,
    s: [f32; 1],
) -> [f32; 1] {
    [voronoi_smooth_distance_cell(
        i,
        quad(c, cw),
        quad(f, fw),
        randomness,
        smoothness,
        exponent,
        METRIC_EUCLIDEAN,
        1,
        s[0],
    )]
}

/// One cell of the blend of distances alone in 1 dimension, any metric.
#[inline(always)]
pub fn voronoi_smooth_distance_metric_step_1d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    smoothness: f32,
    exponent: f32,
    metric: u32,
    s: [f32; 1],
) -> [f32; 1] {
    [voronoi_smooth_distance_cell(
        i,
        quad(c, cw),
        quad(f, fw),
        randomness,
        smoothness,
        exponent,
        metric,
        1,
        s[0],
    )]
}

/// One cell of the blend of distances alone in 2 dimensions, Euclidean.
#[inline(always)]
pub fn voronoi_smooth_distance_step_2d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    smoothness: f32,
    exponent: f32,
    _metric: u32,
    s: [f32; 1],
) -> [f32; 1] {
    [voronoi_smooth_distance_cell(
        i,
        quad(c, cw),
        quad(f, fw),
        randomness,
        smoothness,
        exponent,
        METRIC_EUCLIDEAN,
        2,
        s[0],
    )]
}

/// One cell of the blend of distances alone in 2 dimensions, any metric.
#[inline(always)]
pub fn voronoi_smooth_distance_metric_step_2d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    smoothness: f32,
    exponent: f32,
    metric: u32,
    s: [f32; 1],
) -> [f32; 1] {
    [voronoi_smooth_distance_cell(
        i,
        quad(c, cw),
        quad(f, fw),
        randomness,
        smoothness,
        exponent,
        metric,
        2,
        s[0],
    )]
}

/// One cell of the blend of distances alone in 3 dimensions, Euclidean.
#[inline(always)]
pub fn voronoi_smooth_distance_step_3d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    smoothness: f32,
    exponent: f32,
    _metric: u32,
    s: [f32; 1],
) -> [f32; 1] {
    [voronoi_smooth_distance_cell(
        i,
        quad(c, cw),
        quad(f, fw),
        randomness,
        smoothness,
        exponent,
        METRIC_EUCLIDEAN,
        3,
        s[0],
    )]
}

/// One cell of the blend of distances alone in 3 dimensions, any metric.
#[inline(always)]
pub fn voronoi_smooth_distance_metric_step_3d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    smoothness: f32,
    exponent: f32,
    metric: u32,
    s: [f32; 1],
) -> [f32; 1] {
    [voronoi_smooth_distance_cell(
        i,
        quad(c, cw),
        quad(f, fw),
        randomness,
        smoothness,
        exponent,
        metric,
        3,
        s[0],
    )]
}

/// One cell of the blend of distances alone in 4 dimensions, Euclidean.
#[inline(always)]
pub fn voronoi_smooth_distance_step_4d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    smoothness: f32,
    exponent: f32,
    _metric: u32,
    s: [f32; 1],
) -> [f32; 1] {
    [voronoi_smooth_distance_cell(
        i,
        quad(c, cw),
        quad(f, fw),
        randomness,
        smoothness,
        exponent,
        METRIC_EUCLIDEAN,
        4,
        s[0],
    )]
}

/// One cell of the blend of distances alone in 4 dimensions, any metric.
#[inline(always)]
pub fn voronoi_smooth_distance_metric_step_4d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    smoothness: f32,
    exponent: f32,
    metric: u32,
    s: [f32; 1],
) -> [f32; 1] {
    [voronoi_smooth_distance_cell(
        i,
        quad(c, cw),
        quad(f, fw),
        randomness,
        smoothness,
        exponent,
        metric,
        4,
        s[0],
    )]
}
