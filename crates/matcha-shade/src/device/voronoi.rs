//! Cellular noise in one to four dimensions: S. Worley, "A Cellular Texture Basis
//! Function" (1996); smooth F1 after I. Quilez ("Smooth Voronoi", 2014), distance to
//! the edge after his "Voronoi - distances" (2012); hashes, orders and ranges of Cycles
//! 4.5, node Voronoi Texture.
//!
//! All dimensions share one form: a coordinate is given as its cell's corner `(c, cw)`
//! and the place inside of it `(f, fw)`; one dimension uses the w's, two use x and y,
//! three use c and f, four use all. `dims` is a literal wherever these functions are
//! called, so that what a dimension does not use is not computed.
//!
//! The nearest-point operations return the distance and the number of the cell, 0 up to
//! 3^dims (5^dims for none), from which colour and position follow without a search.

use super::hash::*;
use super::math::*;

/// Four coordinates.
#[derive(Clone, Copy)]
pub struct Quad {
    /// First.
    pub x: f32,
    /// Second.
    pub y: f32,
    /// Third.
    pub z: f32,
    /// Fourth.
    pub w: f32,
}

/// Sum.
#[inline(always)]
pub fn quad_add(a: Quad, b: Quad) -> Quad {
    Quad {
        x: a.x + b.x,
        y: a.y + b.y,
        z: a.z + b.z,
        w: a.w + b.w,
    }
}

/// Difference.
#[inline(always)]
pub fn quad_sub(a: Quad, b: Quad) -> Quad {
    Quad {
        x: a.x - b.x,
        y: a.y - b.y,
        z: a.z - b.z,
        w: a.w - b.w,
    }
}

/// Product with a number.
#[inline(always)]
pub fn quad_scale(a: Quad, s: f32) -> Quad {
    Quad {
        x: a.x * s,
        y: a.y * s,
        z: a.z * s,
        w: a.w * s,
    }
}

/// Scalar product over the first `dims` coordinates in use.
#[inline(always)]
pub fn quad_dot(a: Quad, b: Quad, dims: u32) -> f32 {
    if dims == 1 {
        a.w * b.w
    } else if dims == 2 {
        a.x * b.x + a.y * b.y
    } else if dims == 3 {
        a.x * b.x + a.y * b.y + a.z * b.z
    } else {
        a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w
    }
}

/// Offset of neighbour `i` of (2·reach + 1)^dims, the first coordinate fastest.
#[inline(always)]
pub fn voronoi_offset(i: u32, reach: u32, dims: u32) -> Quad {
    let n = 2 * reach + 1;
    let r = reach as i32 as f32;
    let a = (i % n) as i32 as f32 - r;
    if dims == 1 {
        Quad {
            x: 0.0,
            y: 0.0,
            z: 0.0,
            w: a,
        }
    } else {
        let b = ((i / n) % n) as i32 as f32 - r;
        let c = ((i / (n * n)) % n) as i32 as f32 - r;
        let d = ((i / (n * n * n)) % n) as i32 as f32 - r;
        Quad {
            x: a,
            y: b,
            z: select(0.0, c, dims >= 3),
            w: select(0.0, d, dims == 4),
        }
    }
}

/// A cell's random point in [0, 1]^dims.
#[inline(always)]
pub fn voronoi_jitter(cell: Quad, dims: u32) -> Quad {
    if dims == 1 {
        Quad {
            x: 0.0,
            y: 0.0,
            z: 0.0,
            w: unit_hash1(cell.w),
        }
    } else if dims == 2 {
        Quad {
            x: unit_hash2(cell.x, cell.y),
            y: unit_hash3(cell.x, cell.y, 1.0),
            z: 0.0,
            w: 0.0,
        }
    } else if dims == 3 {
        let mixed = hash_mix3(bits_of(cell.x), bits_of(cell.y), bits_of(cell.z));
        Quad {
            x: unit_hash3(cell.x, cell.y, cell.z),
            y: unit_of(hash_final(
                wrapping_add(mixed.a, 0x3f80_0000),
                mixed.b,
                mixed.c,
            )),
            z: unit_of(hash_final(
                wrapping_add(mixed.a, 0x4000_0000),
                mixed.b,
                mixed.c,
            )),
            w: 0.0,
        }
    } else {
        Quad {
            x: unit_hash4(cell.x, cell.y, cell.z, cell.w),
            y: unit_hash4(cell.w, cell.x, cell.y, cell.z),
            z: unit_hash4(cell.z, cell.w, cell.x, cell.y),
            w: unit_hash4(cell.y, cell.z, cell.w, cell.x),
        }
    }
}

/// A cell's random colour.
#[inline(always)]
pub fn voronoi_cell_color(cell: Quad, dims: u32) -> Vec3 {
    if dims == 1 {
        vec3(
            unit_hash1(cell.w),
            unit_hash2(cell.w, 1.0),
            unit_hash2(cell.w, 2.0),
        )
    } else if dims == 2 {
        vec3(
            unit_hash2(cell.x, cell.y),
            unit_hash3(cell.x, cell.y, 1.0),
            unit_hash3(cell.x, cell.y, 2.0),
        )
    } else if dims == 3 {
        let point = voronoi_jitter(cell, 3);
        vec3(point.x, point.y, point.z)
    } else {
        vec3(
            unit_hash4(cell.x, cell.y, cell.z, cell.w),
            unit_hash4(cell.z, cell.x, cell.w, cell.y),
            unit_hash4(cell.w, cell.z, cell.y, cell.x),
        )
    }
}

/// Four coordinates of a triple and a number.
#[inline(always)]
pub fn quad(p: Vec3, w: f32) -> Quad {
    Quad {
        x: p.x,
        y: p.y,
        z: p.z,
        w,
    }
}

/// From the coordinate to the point of neighbour `i`.
#[inline(always)]
pub fn voronoi_to_point(
    i: u32,
    reach: u32,
    corner: Quad,
    inside: Quad,
    randomness: f32,
    dims: u32,
) -> Quad {
    let offset = voronoi_offset(i, reach, dims);
    let jitter = voronoi_jitter(quad_add(corner, offset), dims);
    let point = quad_add(offset, quad_scale(jitter, saturate(randomness)));
    quad_sub(point, inside)
}

/// Euclidean.
pub const METRIC_EUCLIDEAN: u32 = 0;
/// Sum of absolute differences.
pub const METRIC_MANHATTAN: u32 = 1;
/// Largest absolute difference.
pub const METRIC_CHEBYCHEV: u32 = 2;
/// Power mean with an exponent.
pub const METRIC_MINKOWSKI: u32 = 3;

/// Length of `v` in a metric; `metric` is a literal where speed matters.
#[inline(always)]
pub fn voronoi_length(v: Quad, exponent: f32, metric: u32, dims: u32) -> f32 {
    let x = abs(v.x);
    let y = abs(v.y);
    let z = abs(v.z);
    let w = abs(v.w);
    if dims == 1 {
        w
    } else if metric == METRIC_EUCLIDEAN {
        sqrt(quad_dot(v, v, dims))
    } else if metric == METRIC_MANHATTAN {
        x + y + select(0.0, z, dims >= 3) + select(0.0, w, dims == 4)
    } else if metric == METRIC_CHEBYCHEV {
        max(
            max(x, y),
            max(select(0.0, z, dims >= 3), select(0.0, w, dims == 4)),
        )
    } else {
        let sum = pow_positive(x, exponent) + pow_positive(y, exponent);
        let third = select(0.0, pow_positive(z, exponent), dims >= 3);
        let fourth = select(0.0, pow_positive(w, exponent), dims == 4);
        pow_positive(sum + third + fourth, safe_divide(1.0, exponent))
    }
}

/// State before the search for the nearest: distance, cell, second distance and cell.
#[inline(always)]
pub fn voronoi_search_start() -> [f32; 4] {
    [MAX, 0.0, MAX, 0.0]
}

/// Takes point `i` at `distance` into the search.
#[inline(always)]
pub fn voronoi_nearer(i: u32, distance: f32, s: [f32; 4]) -> [f32; 4] {
    let cell = i as i32 as f32;
    let first = distance < s[0];
    let second = distance < s[2];
    [
        select(s[0], distance, first),
        select(s[1], cell, first),
        select(select(s[2], distance, second), s[0], first),
        select(select(s[3], cell, second), s[1], first),
    ]
}

/// State of smooth F1: distance, colour, position, and a flag after the first cell.
#[inline(always)]
pub fn voronoi_smooth_blend(before: f32, distance: f32, smoothness: f32, first: bool) -> f32 {
    let t = 0.5 + 0.5 * safe_divide(before - distance, smoothness);
    select(smoothstep(0.0, 1.0, t), 1.0, first)
}

/// Node's smoothness to the width of the blend.
#[inline(always)]
pub fn voronoi_smooth_width(smoothness: f32) -> f32 {
    clamp(smoothness * 0.5, 0.0, 0.5)
}

/// Distance to the bisector between the nearest point `near` and `other`, both seen
/// from the coordinate; very large where they are the same point.
#[inline(always)]
pub fn voronoi_bisector(near: Quad, other: Quad, dims: u32) -> f32 {
    let across = quad_sub(other, near);
    let squared = quad_dot(across, across, dims);
    let distinct = squared > 0.0001;
    let middle = quad_scale(quad_add(near, other), 0.5);
    let distance = quad_dot(middle, across, dims) / sqrt(select(1.0, squared, distinct));
    select(MAX, distance, distinct)
}

/// A cell's number from its float.
#[inline(always)]
pub fn voronoi_cell_number(cell: f32) -> u32 {
    to_int(clamp(cell, 0.0, 80.0)) as u32
}
