//! Cellular noise: the nearest and the second nearest point, their colour and position,
//! for each number of dimensions.
#![allow(clippy::too_many_arguments)]

use super::math::*;
use super::voronoi::*;

/// Before the search for the nearest point.
#[inline(always)]
pub fn voronoi_f1_init(_c: Vec3, _cw: f32, _f: Vec3, _fw: f32, _randomness: f32) -> [f32; 4] {
    voronoi_search_start()
}

/// The nearest: distance and cell.
#[inline(always)]
pub fn voronoi_f1_finish(
    _c: Vec3,
    _cw: f32,
    _f: Vec3,
    _fw: f32,
    _randomness: f32,
    s: [f32; 4],
) -> Vec2 {
    vec2(sqrt(s[0]), s[1])
}

/// As [`voronoi_f1_init`], for other metrics.
#[inline(always)]
pub fn voronoi_metric_init(
    _c: Vec3,
    _cw: f32,
    _f: Vec3,
    _fw: f32,
    _randomness: f32,
    _exponent: f32,
    _metric: u32,
) -> [f32; 4] {
    voronoi_search_start()
}

/// The nearest: distance and cell.
#[inline(always)]
pub fn voronoi_nearest_finish(
    _c: Vec3,
    _cw: f32,
    _f: Vec3,
    _fw: f32,
    _randomness: f32,
    _exponent: f32,
    _metric: u32,
    s: [f32; 4],
) -> Vec2 {
    vec2(s[0], s[1])
}

/// The second nearest: distance and cell.
#[inline(always)]
pub fn voronoi_second_finish(
    _c: Vec3,
    _cw: f32,
    _f: Vec3,
    _fw: f32,
    _randomness: f32,
    _exponent: f32,
    _metric: u32,
    s: [f32; 4],
) -> Vec2 {
    vec2(s[2], s[3])
}

/// Cells around a place in 1 dimension.
#[inline(always)]
pub fn voronoi_f1_count_1d(_c: Vec3, _cw: f32, _f: Vec3, _fw: f32, _randomness: f32) -> u32 {
    3
}

/// One cell of the search in 1 dimension, Euclidean; distances are squared.
#[inline(always)]
pub fn voronoi_f1_step_1d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    s: [f32; 4],
) -> [f32; 4] {
    let v = voronoi_to_point(i, 1, quad(c, cw), quad(f, fw), randomness, 1);
    let squared = quad_dot(v, v, 1);
    let nearer = squared < s[0];
    [
        select(s[0], squared, nearer),
        select(s[1], i as i32 as f32, nearer),
        s[2],
        s[3],
    ]
}

/// Cells around a place in 1 dimension.
#[inline(always)]
pub fn voronoi_metric_count_1d(
    _c: Vec3,
    _cw: f32,
    _f: Vec3,
    _fw: f32,
    _randomness: f32,
    _exponent: f32,
    _metric: u32,
) -> u32 {
    3
}

/// One cell of the search for the two nearest in 1 dimension, any metric.
#[inline(always)]
pub fn voronoi_metric_step_1d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    exponent: f32,
    metric: u32,
    s: [f32; 4],
) -> [f32; 4] {
    let v = voronoi_to_point(i, 1, quad(c, cw), quad(f, fw), randomness, 1);
    voronoi_nearer(i, voronoi_length(v, exponent, metric, 1), s)
}

/// A cell's colour in 1 dimension.
#[inline(always)]
pub fn voronoi_color_1d(c: Vec3, cw: f32, cell: f32) -> Vec3 {
    let offset = voronoi_offset(voronoi_cell_number(cell), 1, 1);
    voronoi_cell_color(quad_add(quad(c, cw), offset), 1)
}

/// A cell's point in 1 dimension.
#[inline(always)]
pub fn voronoi_position_1d(c: Vec3, cw: f32, randomness: f32, cell: f32) -> [f32; 4] {
    let origin = quad(vec3(0.0, 0.0, 0.0), 0.0);
    let corner = quad(c, cw);
    let point = voronoi_to_point(voronoi_cell_number(cell), 1, corner, origin, randomness, 1);
    let at = quad_add(corner, point);
    [at.x, at.y, at.z, at.w]
}

/// Cells around a place in 2 dimensions.
#[inline(always)]
pub fn voronoi_f1_count_2d(_c: Vec3, _cw: f32, _f: Vec3, _fw: f32, _randomness: f32) -> u32 {
    9
}

/// One cell of the search in 2 dimensions, Euclidean; distances are squared.
#[inline(always)]
pub fn voronoi_f1_step_2d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    s: [f32; 4],
) -> [f32; 4] {
    let v = voronoi_to_point(i, 1, quad(c, cw), quad(f, fw), randomness, 2);
    let squared = quad_dot(v, v, 2);
    let nearer = squared < s[0];
    [
        select(s[0], squared, nearer),
        select(s[1], i as i32 as f32, nearer),
        s[2],
        s[3],
    ]
}

/// Cells around a place in 2 dimensions.
#[inline(always)]
pub fn voronoi_metric_count_2d(
    _c: Vec3,
    _cw: f32,
    _f: Vec3,
    _fw: f32,
    _randomness: f32,
    _exponent: f32,
    _metric: u32,
) -> u32 {
    9
}

/// One cell of the search for the two nearest in 2 dimensions, any metric.
#[inline(always)]
pub fn voronoi_metric_step_2d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    exponent: f32,
    metric: u32,
    s: [f32; 4],
) -> [f32; 4] {
    let v = voronoi_to_point(i, 1, quad(c, cw), quad(f, fw), randomness, 2);
    voronoi_nearer(i, voronoi_length(v, exponent, metric, 2), s)
}

/// A cell's colour in 2 dimensions.
#[inline(always)]
pub fn voronoi_color_2d(c: Vec3, cw: f32, cell: f32) -> Vec3 {
    let offset = voronoi_offset(voronoi_cell_number(cell), 1, 2);
    voronoi_cell_color(quad_add(quad(c, cw), offset), 2)
}

/// A cell's point in 2 dimensions.
#[inline(always)]
pub fn voronoi_position_2d(c: Vec3, cw: f32, randomness: f32, cell: f32) -> [f32; 4] {
    let origin = quad(vec3(0.0, 0.0, 0.0), 0.0);
    let corner = quad(c, cw);
    let point = voronoi_to_point(voronoi_cell_number(cell), 1, corner, origin, randomness, 2);
    let at = quad_add(corner, point);
    [at.x, at.y, at.z, at.w]
}

/// Cells around a place in 3 dimensions.
#[inline(always)]
pub fn voronoi_f1_count_3d(_c: Vec3, _cw: f32, _f: Vec3, _fw: f32, _randomness: f32) -> u32 {
    27
}

/// One cell of the search in 3 dimensions, Euclidean; distances are squared.
#[inline(always)]
pub fn voronoi_f1_step_3d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    s: [f32; 4],
) -> [f32; 4] {
    let v = voronoi_to_point(i, 1, quad(c, cw), quad(f, fw), randomness, 3);
    let squared = quad_dot(v, v, 3);
    let nearer = squared < s[0];
    [
        select(s[0], squared, nearer),
        select(s[1], i as i32 as f32, nearer),
        s[2],
        s[3],
    ]
}

/// Cells around a place in 3 dimensions.
#[inline(always)]
pub fn voronoi_metric_count_3d(
    _c: Vec3,
    _cw: f32,
    _f: Vec3,
    _fw: f32,
    _randomness: f32,
    _exponent: f32,
    _metric: u32,
) -> u32 {
    27
}

/// One cell of the search for the two nearest in 3 dimensions, any metric.
#[inline(always)]
pub fn voronoi_metric_step_3d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    exponent: f32,
    metric: u32,
    s: [f32; 4],
) -> [f32; 4] {
    let v = voronoi_to_point(i, 1, quad(c, cw), quad(f, fw), randomness, 3);
    voronoi_nearer(i, voronoi_length(v, exponent, metric, 3), s)
}

/// A cell's colour in 3 dimensions.
#[inline(always)]
pub fn voronoi_color_3d(c: Vec3, cw: f32, cell: f32) -> Vec3 {
    let offset = voronoi_offset(voronoi_cell_number(cell), 1, 3);
    voronoi_cell_color(quad_add(quad(c, cw), offset), 3)
}

/// A cell's point in 3 dimensions.
#[inline(always)]
pub fn voronoi_position_3d(c: Vec3, cw: f32, randomness: f32, cell: f32) -> [f32; 4] {
    let origin = quad(vec3(0.0, 0.0, 0.0), 0.0);
    let corner = quad(c, cw);
    let point = voronoi_to_point(voronoi_cell_number(cell), 1, corner, origin, randomness, 3);
    let at = quad_add(corner, point);
    [at.x, at.y, at.z, at.w]
}

/// Cells around a place in 4 dimensions.
#[inline(always)]
pub fn voronoi_f1_count_4d(_c: Vec3, _cw: f32, _f: Vec3, _fw: f32, _randomness: f32) -> u32 {
    81
}

/// One cell of the search in 4 dimensions, Euclidean; distances are squared.
#[inline(always)]
pub fn voronoi_f1_step_4d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    s: [f32; 4],
) -> [f32; 4] {
    let v = voronoi_to_point(i, 1, quad(c, cw), quad(f, fw), randomness, 4);
    let squared = quad_dot(v, v, 4);
    let nearer = squared < s[0];
    [
        select(s[0], squared, nearer),
        select(s[1], i as i32 as f32, nearer),
        s[2],
        s[3],
    ]
}

/// Cells around a place in 4 dimensions.
#[inline(always)]
pub fn voronoi_metric_count_4d(
    _c: Vec3,
    _cw: f32,
    _f: Vec3,
    _fw: f32,
    _randomness: f32,
    _exponent: f32,
    _metric: u32,
) -> u32 {
    81
}

/// One cell of the search for the two nearest in 4 dimensions, any metric.
#[inline(always)]
pub fn voronoi_metric_step_4d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    exponent: f32,
    metric: u32,
    s: [f32; 4],
) -> [f32; 4] {
    let v = voronoi_to_point(i, 1, quad(c, cw), quad(f, fw), randomness, 4);
    voronoi_nearer(i, voronoi_length(v, exponent, metric, 4), s)
}

/// A cell's colour in 4 dimensions.
#[inline(always)]
pub fn voronoi_color_4d(c: Vec3, cw: f32, cell: f32) -> Vec3 {
    let offset = voronoi_offset(voronoi_cell_number(cell), 1, 4);
    voronoi_cell_color(quad_add(quad(c, cw), offset), 4)
}

/// A cell's point in 4 dimensions.
#[inline(always)]
pub fn voronoi_position_4d(c: Vec3, cw: f32, randomness: f32, cell: f32) -> [f32; 4] {
    let origin = quad(vec3(0.0, 0.0, 0.0), 0.0);
    let corner = quad(c, cw);
    let point = voronoi_to_point(voronoi_cell_number(cell), 1, corner, origin, randomness, 4);
    let at = quad_add(corner, point);
    [at.x, at.y, at.z, at.w]
}

/// Distance to a cell's point in 1 dimension, Euclidean.
#[inline(always)]
pub fn voronoi_distance_1d(c: Vec3, cw: f32, f: Vec3, fw: f32, randomness: f32, cell: f32) -> f32 {
    let v = voronoi_to_point(
        voronoi_cell_number(cell),
        1,
        quad(c, cw),
        quad(f, fw),
        randomness,
        1,
    );
    sqrt(quad_dot(v, v, 1))
}

/// Distance to a cell's point in 2 dimensions, Euclidean.
#[inline(always)]
pub fn voronoi_distance_2d(c: Vec3, cw: f32, f: Vec3, fw: f32, randomness: f32, cell: f32) -> f32 {
    let v = voronoi_to_point(
        voronoi_cell_number(cell),
        1,
        quad(c, cw),
        quad(f, fw),
        randomness,
        2,
    );
    sqrt(quad_dot(v, v, 2))
}

/// Distance to a cell's point in 3 dimensions, Euclidean.
#[inline(always)]
pub fn voronoi_distance_3d(c: Vec3, cw: f32, f: Vec3, fw: f32, randomness: f32, cell: f32) -> f32 {
    let v = voronoi_to_point(
        voronoi_cell_number(cell),
        1,
        quad(c, cw),
        quad(f, fw),
        randomness,
        3,
    );
    sqrt(quad_dot(v, v, 3))
}

/// Distance to a cell's point in 4 dimensions, Euclidean.
#[inline(always)]
pub fn voronoi_distance_4d(c: Vec3, cw: f32, f: Vec3, fw: f32, randomness: f32, cell: f32) -> f32 {
    let v = voronoi_to_point(
        voronoi_cell_number(cell),
        1,
        quad(c, cw),
        quad(f, fw),
        randomness,
        4,
    );
    sqrt(quad_dot(v, v, 4))
}
