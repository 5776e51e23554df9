//! The tests of a walk with AVX2: eight boxes or four triangles an instruction.
//!
//! Methods are `inline(always)` without a `target_feature` of their own, so that they merge into
//! the walk, which is compiled with the features (`traverse::walk_avx2`).

use super::kernel::{BoxHits, Kernel, PackHits, near_rows};
use super::node::{Node, PACK, Pack, WIDTH};
use crate::device::ray_box::{BOX_FAR_SLACK, box_inverse};
use glam::Vec3;
use std::arch::x86_64::*;

/// A ray in registers.
#[derive(Clone, Copy)]
pub(super) struct Avx2 {
    origin: [__m256; 3],
    inverse: [__m256; 3],
    inverse_far: [__m256; 3],
    near: [usize; 3],
    direction: Vec3,
    position: Vec3,
    t_min: f32,
}

#[inline(always)]
unsafe fn splat(x: f32) -> __m128 {
    // SAFETY: the caller has checked for AVX.
    unsafe { _mm_set1_ps(x) }
}

type Lanes = [__m128; 3];

#[inline(always)]
unsafe fn sub(a: Lanes, b: Lanes) -> Lanes {
    // SAFETY: the caller has checked for AVX.
    unsafe {
        [
            _mm_sub_ps(a[0], b[0]),
            _mm_sub_ps(a[1], b[1]),
            _mm_sub_ps(a[2], b[2]),
        ]
    }
}

#[inline(always)]
unsafe fn add(a: Lanes, b: Lanes) -> Lanes {
    // SAFETY: the caller has checked for AVX.
    unsafe {
        [
            _mm_add_ps(a[0], b[0]),
            _mm_add_ps(a[1], b[1]),
            _mm_add_ps(a[2], b[2]),
        ]
    }
}

// Products are not fused with sums: the device functions of `ray_triangle` then give the same
// bits, here, in the portable kernel and on a GPU. A distance that is one bit off moves a point by
// as much, and the bump of a fine texture makes another direction of it.

#[inline(always)]
unsafe fn cross(a: Lanes, b: Lanes) -> Lanes {
    // SAFETY: the caller has checked for AVX.
    unsafe {
        [
            _mm_sub_ps(_mm_mul_ps(a[1], b[2]), _mm_mul_ps(a[2], b[1])),
            _mm_sub_ps(_mm_mul_ps(a[2], b[0]), _mm_mul_ps(a[0], b[2])),
            _mm_sub_ps(_mm_mul_ps(a[0], b[1]), _mm_mul_ps(a[1], b[0])),
        ]
    }
}

#[inline(always)]
unsafe fn dot(a: Lanes, b: Lanes) -> __m128 {
    // SAFETY: the caller has checked for AVX.
    unsafe {
        let xy = _mm_add_ps(_mm_mul_ps(a[0], b[0]), _mm_mul_ps(a[1], b[1]));
        _mm_add_ps(xy, _mm_mul_ps(a[2], b[2]))
    }
}

impl Kernel for Avx2 {
    #[inline(always)]
    fn new(origin: Vec3, direction: Vec3, t_min: f32) -> Self {
        let inverse = box_inverse(direction);
        // SAFETY: only walks that were chosen because the processor has AVX2 construct this.
        unsafe {
            let all = |v: Vec3| {
                [
                    _mm256_set1_ps(v.x),
                    _mm256_set1_ps(v.y),
                    _mm256_set1_ps(v.z),
                ]
            };
            Self {
                origin: all(origin),
                inverse: all(inverse),
                inverse_far: all(inverse * BOX_FAR_SLACK),
                near: near_rows(inverse),
                direction,
                position: origin,
                t_min,
            }
        }
    }

    #[inline(always)]
    fn boxes(&self, node: &Node, t_max: f32) -> BoxHits {
        let rows = node.bounds.as_ptr().cast::<f32>();
        let mut hits = BoxHits {
            mask: 0,
            entry: [0.0; WIDTH],
        };
        // SAFETY: AVX2 as in `new`; `near` is below 6 and so is `near ^ 1`, and a row of the
        // 64-byte aligned node is 32 bytes.
        unsafe {
            let near = |a: usize| {
                let row = _mm256_load_ps(rows.add(WIDTH * self.near[a]));
                _mm256_mul_ps(_mm256_sub_ps(row, self.origin[a]), self.inverse[a])
            };
            let far = |a: usize| {
                let row = _mm256_load_ps(rows.add(WIDTH * (self.near[a] ^ 1)));
                _mm256_mul_ps(_mm256_sub_ps(row, self.origin[a]), self.inverse_far[a])
            };
            let entry = _mm256_max_ps(
                _mm256_max_ps(near(0), near(1)),
                _mm256_max_ps(near(2), _mm256_set1_ps(self.t_min)),
            );
            let exit = _mm256_min_ps(
                _mm256_min_ps(far(0), far(1)),
                _mm256_min_ps(far(2), _mm256_set1_ps(t_max)),
            );
            let met = _mm256_cmp_ps::<_CMP_LE_OQ>(entry, exit);
            hits.mask = _mm256_movemask_ps(met) as u32;
            _mm256_storeu_ps(hits.entry.as_mut_ptr(), entry);
        }
        hits
    }

    #[inline(always)]
    fn triangles(&self, pack: &Pack, t_max: f32) -> PackHits {
        let mut hits = PackHits {
            mask: 0,
            t: [0.0; PACK],
            u: [0.0; PACK],
            v: [0.0; PACK],
        };
        // SAFETY: AVX2 as in `new`; rows of the 16-byte aligned pack are 16 bytes.
        unsafe {
            let origin = [
                splat(self.position.x),
                splat(self.position.y),
                splat(self.position.z),
            ];
            let ray = [
                splat(self.direction.x),
                splat(self.direction.y),
                splat(self.direction.z),
            ];
            let corner = |c: usize| {
                let rows = &pack.corners[c];
                sub([0, 1, 2].map(|a| _mm_load_ps(rows[a].as_ptr())), origin)
            };
            let (a, b, c) = (corner(0), corner(1), corner(2));
            let (edge_ca, edge_ab, edge_bc) = (sub(c, a), sub(a, b), sub(b, c));
            let u = dot(cross(edge_ca, add(c, a)), ray);
            let v = dot(cross(edge_ab, add(a, b)), ray);
            let w = dot(cross(edge_bc, add(b, c)), ray);
            let zero = _mm_setzero_ps();
            let least = _mm_min_ps(_mm_min_ps(u, v), w);
            let most = _mm_max_ps(_mm_max_ps(u, v), w);
            let inside = _mm_or_ps(_mm_cmpge_ps(least, zero), _mm_cmple_ps(most, zero));
            let sum = _mm_add_ps(_mm_add_ps(u, v), w);
            let inside = _mm_and_ps(inside, _mm_cmpneq_ps(sum, zero));
            if _mm_movemask_ps(inside) == 0 {
                return hits;
            }
            let normal = cross(edge_ab, edge_ca);
            let t = _mm_div_ps(dot(normal, a), dot(normal, ray));
            let within = _mm_and_ps(
                _mm_cmpgt_ps(t, splat(self.t_min)),
                _mm_cmplt_ps(t, splat(t_max)),
            );
            hits.mask = _mm_movemask_ps(_mm_and_ps(inside, within)) as u32;
            _mm_storeu_ps(hits.t.as_mut_ptr(), t);
            _mm_storeu_ps(hits.u.as_mut_ptr(), _mm_div_ps(u, sum));
            _mm_storeu_ps(hits.v.as_mut_ptr(), _mm_div_ps(v, sum));
        }
        hits
    }
}
