//! The operations of cellular noise: the functions of [`super::voronoi`] for each
//! number of dimensions.
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

/// Cells around a place in 1 dimension.
#[inline(always)]
pub fn voronoi_edge_count_1d(
    _c: Vec3,
    _cw: f32,
    _f: Vec3,
    _fw: f32,
    _randomness: f32,
    _cell: f32,
) -> u32 {
    3
}

/// Before the search for the edge: its distance, and where the nearest point is.
#[inline(always)]
pub fn voronoi_edge_init_1d(
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    cell: f32,
) -> [f32; 6] {
    let near = voronoi_to_point(
        voronoi_cell_number(cell),
        1,
        quad(c, cw),
        quad(f, fw),
        randomness,
        1,
    );
    [MAX, near.x, near.y, near.z, near.w, 0.0]
}

/// One neighbour's border in 1 dimension: half way to the points left and right of the
/// own cell's, whichever of the three is nearest.
#[inline(always)]
pub fn voronoi_edge_step_1d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    _cell: f32,
    s: [f32; 6],
) -> [f32; 6] {
    let own = voronoi_to_point(1, 1, quad(c, cw), quad(f, fw), randomness, 1);
    let other = voronoi_to_point(i, 1, quad(c, cw), quad(f, fw), randomness, 1);
    let distance = abs(0.5 * (own.w + other.w));
    [
        select(min(s[0], distance), s[0], i == 1),
        s[1],
        s[2],
        s[3],
        s[4],
        s[5],
    ]
}

/// One neighbour of the nearest point's cell in 1 dimension: the squared distance between
/// both points.
#[inline(always)]
pub fn voronoi_radius_step_1d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    cell: f32,
    s: [f32; 6],
) -> [f32; 6] {
    let near = Quad {
        x: s[1],
        y: s[2],
        z: s[3],
        w: s[4],
    };
    let offset = voronoi_offset(voronoi_cell_number(cell), 1, 1);
    let corner = quad_add(quad(c, cw), offset);
    let inside = quad_sub(quad(f, fw), offset);
    let v = quad_sub(voronoi_to_point(i, 1, corner, inside, randomness, 1), near);
    let itself = i == 1;
    [
        select(min(s[0], quad_dot(v, v, 1)), s[0], itself),
        s[1],
        s[2],
        s[3],
        s[4],
        s[5],
    ]
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

/// Cells around a place in 2 dimensions.
#[inline(always)]
pub fn voronoi_edge_count_2d(
    _c: Vec3,
    _cw: f32,
    _f: Vec3,
    _fw: f32,
    _randomness: f32,
    _cell: f32,
) -> u32 {
    9
}

/// Before the search for the edge: its distance, and where the nearest point is.
#[inline(always)]
pub fn voronoi_edge_init_2d(
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    cell: f32,
) -> [f32; 6] {
    let near = voronoi_to_point(
        voronoi_cell_number(cell),
        1,
        quad(c, cw),
        quad(f, fw),
        randomness,
        2,
    );
    [MAX, near.x, near.y, near.z, near.w, 0.0]
}

/// One neighbour's bisector in 2 dimensions.
#[inline(always)]
pub fn voronoi_edge_step_2d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    _cell: f32,
    s: [f32; 6],
) -> [f32; 6] {
    let near = Quad {
        x: s[1],
        y: s[2],
        z: s[3],
        w: s[4],
    };
    let other = voronoi_to_point(i, 1, quad(c, cw), quad(f, fw), randomness, 2);
    let distance = voronoi_bisector(near, other, 2);
    let closer = distance < s[0];
    let beyond = select(s[5], i as i32 as f32, closer);
    [
        select(s[0], distance, closer),
        s[1],
        s[2],
        s[3],
        s[4],
        beyond,
    ]
}

/// One neighbour of the nearest point's cell in 2 dimensions: the squared distance between
/// both points.
#[inline(always)]
pub fn voronoi_radius_step_2d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    cell: f32,
    s: [f32; 6],
) -> [f32; 6] {
    let near = Quad {
        x: s[1],
        y: s[2],
        z: s[3],
        w: s[4],
    };
    let offset = voronoi_offset(voronoi_cell_number(cell), 1, 2);
    let corner = quad_add(quad(c, cw), offset);
    let inside = quad_sub(quad(f, fw), offset);
    let v = quad_sub(voronoi_to_point(i, 1, corner, inside, randomness, 2), near);
    let itself = i == 4;
    [
        select(min(s[0], quad_dot(v, v, 2)), s[0], itself),
        s[1],
        s[2],
        s[3],
        s[4],
        s[5],
    ]
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

/// Cells around a place in 3 dimensions.
#[inline(always)]
pub fn voronoi_edge_count_3d(
    _c: Vec3,
    _cw: f32,
    _f: Vec3,
    _fw: f32,
    _randomness: f32,
    _cell: f32,
) -> u32 {
    27
}

/// Before the search for the edge: its distance, and where the nearest point is.
#[inline(always)]
pub fn voronoi_edge_init_3d(
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    cell: f32,
) -> [f32; 6] {
    let near = voronoi_to_point(
        voronoi_cell_number(cell),
        1,
        quad(c, cw),
        quad(f, fw),
        randomness,
        3,
    );
    [MAX, near.x, near.y, near.z, near.w, 0.0]
}

/// One neighbour's bisector in 3 dimensions.
#[inline(always)]
pub fn voronoi_edge_step_3d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    _cell: f32,
    s: [f32; 6],
) -> [f32; 6] {
    let near = Quad {
        x: s[1],
        y: s[2],
        z: s[3],
        w: s[4],
    };
    let other = voronoi_to_point(i, 1, quad(c, cw), quad(f, fw), randomness, 3);
    let distance = voronoi_bisector(near, other, 3);
    let closer = distance < s[0];
    let beyond = select(s[5], i as i32 as f32, closer);
    [
        select(s[0], distance, closer),
        s[1],
        s[2],
        s[3],
        s[4],
        beyond,
    ]
}

/// One neighbour of the nearest point's cell in 3 dimensions: the squared distance between
/// both points.
#[inline(always)]
pub fn voronoi_radius_step_3d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    cell: f32,
    s: [f32; 6],
) -> [f32; 6] {
    let near = Quad {
        x: s[1],
        y: s[2],
        z: s[3],
        w: s[4],
    };
    let offset = voronoi_offset(voronoi_cell_number(cell), 1, 3);
    let corner = quad_add(quad(c, cw), offset);
    let inside = quad_sub(quad(f, fw), offset);
    let v = quad_sub(voronoi_to_point(i, 1, corner, inside, randomness, 3), near);
    let itself = i == 13;
    [
        select(min(s[0], quad_dot(v, v, 3)), s[0], itself),
        s[1],
        s[2],
        s[3],
        s[4],
        s[5],
    ]
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

/// Cells around a place in 4 dimensions.
#[inline(always)]
pub fn voronoi_edge_count_4d(
    _c: Vec3,
    _cw: f32,
    _f: Vec3,
    _fw: f32,
    _randomness: f32,
    _cell: f32,
) -> u32 {
    81
}

/// Before the search for the edge: its distance, and where the nearest point is.
#[inline(always)]
pub fn voronoi_edge_init_4d(
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    cell: f32,
) -> [f32; 6] {
    let near = voronoi_to_point(
        voronoi_cell_number(cell),
        1,
        quad(c, cw),
        quad(f, fw),
        randomness,
        4,
    );
    [MAX, near.x, near.y, near.z, near.w, 0.0]
}

/// One neighbour's bisector in 4 dimensions.
#[inline(always)]
pub fn voronoi_edge_step_4d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    _cell: f32,
    s: [f32; 6],
) -> [f32; 6] {
    let near = Quad {
        x: s[1],
        y: s[2],
        z: s[3],
        w: s[4],
    };
    let other = voronoi_to_point(i, 1, quad(c, cw), quad(f, fw), randomness, 4);
    let distance = voronoi_bisector(near, other, 4);
    let closer = distance < s[0];
    let beyond = select(s[5], i as i32 as f32, closer);
    [
        select(s[0], distance, closer),
        s[1],
        s[2],
        s[3],
        s[4],
        beyond,
    ]
}

/// One neighbour of the nearest point's cell in 4 dimensions: the squared distance between
/// both points.
#[inline(always)]
pub fn voronoi_radius_step_4d(
    i: u32,
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    cell: f32,
    s: [f32; 6],
) -> [f32; 6] {
    let near = Quad {
        x: s[1],
        y: s[2],
        z: s[3],
        w: s[4],
    };
    let offset = voronoi_offset(voronoi_cell_number(cell), 1, 4);
    let corner = quad_add(quad(c, cw), offset);
    let inside = quad_sub(quad(f, fw), offset);
    let v = quad_sub(voronoi_to_point(i, 1, corner, inside, randomness, 4), near);
    let itself = i == 40;
    [
        select(min(s[0], quad_dot(v, v, 4)), s[0], itself),
        s[1],
        s[2],
        s[3],
        s[4],
        s[5],
    ]
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

/// Half the distance between the nearest point and its own nearest.
#[inline(always)]
pub fn voronoi_radius_finish(
    _c: Vec3,
    _cw: f32,
    _f: Vec3,
    _fw: f32,
    _randomness: f32,
    _cell: f32,
    s: [f32; 6],
) -> f32 {
    0.5 * sqrt(s[0])
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

/// The edge: its distance, and the number of the cell beyond it.
#[inline(always)]
pub fn voronoi_edge_finish(
    _c: Vec3,
    _cw: f32,
    _f: Vec3,
    _fw: f32,
    _randomness: f32,
    _cell: f32,
    s: [f32; 6],
) -> Vec2 {
    vec2(s[0], s[5])
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

/// Distance to the border between two cells' points in 2 dimensions.
#[inline(always)]
pub fn voronoi_border_2d(
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    cell: f32,
    beyond: f32,
) -> f32 {
    let near = voronoi_to_point(
        voronoi_cell_number(cell),
        1,
        quad(c, cw),
        quad(f, fw),
        randomness,
        2,
    );
    let other = voronoi_to_point(
        voronoi_cell_number(beyond),
        1,
        quad(c, cw),
        quad(f, fw),
        randomness,
        2,
    );
    voronoi_bisector(near, other, 2)
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

/// Distance to the border between two cells' points in 3 dimensions.
#[inline(always)]
pub fn voronoi_border_3d(
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    cell: f32,
    beyond: f32,
) -> f32 {
    let near = voronoi_to_point(
        voronoi_cell_number(cell),
        1,
        quad(c, cw),
        quad(f, fw),
        randomness,
        3,
    );
    let other = voronoi_to_point(
        voronoi_cell_number(beyond),
        1,
        quad(c, cw),
        quad(f, fw),
        randomness,
        3,
    );
    voronoi_bisector(near, other, 3)
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

/// Distance to the border between two cells' points in 4 dimensions.
#[inline(always)]
pub fn voronoi_border_4d(
    c: Vec3,
    cw: f32,
    f: Vec3,
    fw: f32,
    randomness: f32,
    cell: f32,
    beyond: f32,
) -> f32 {
    let near = voronoi_to_point(
        voronoi_cell_number(cell),
        1,
        quad(c, cw),
        quad(f, fw),
        randomness,
        4,
    );
    let other = voronoi_to_point(
        voronoi_cell_number(beyond),
        1,
        quad(c, cw),
        quad(f, fw),
        randomness,
        4,
    );
    voronoi_bisector(near, other, 4)
}
