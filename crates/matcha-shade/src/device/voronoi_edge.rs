//! Cellular noise: the edge of the nearest point's region and the radius of its sphere, for
//! each number of dimensions.
#![allow(clippy::too_many_arguments)]

use super::math::*;
use super::voronoi::*;

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
