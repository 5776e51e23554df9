//! The two tests of a walk, box and triangle, in a form that any processor runs.

use super::node::{Node, PACK, Pack, WIDTH};
use crate::device::ray_box::{BOX_FAR_SLACK, box_inverse};
use crate::device::ray_triangle::{
    triangle_distance, triangle_inside, triangle_sides, triangle_weights,
};
use glam::Vec3;

/// Which children a ray meets, and where it enters their boxes.
pub(super) struct BoxHits {
    /// A bit per child.
    pub(super) mask: u32,
    /// Entry distances.
    pub(super) entry: [f32; WIDTH],
}

/// Which triangles of a pack a ray meets.
pub(super) struct PackHits {
    /// A bit per triangle.
    pub(super) mask: u32,
    /// Distances and barycentric weights of the second and third corners.
    pub(super) t: [f32; PACK],
    pub(super) u: [f32; PACK],
    pub(super) v: [f32; PACK],
}

/// A ray made ready for the tests, and the tests.
pub(super) trait Kernel: Copy {
    /// Prepares a ray.
    fn new(origin: Vec3, direction: Vec3, t_min: f32) -> Self;
    /// Slab test against eight boxes.
    fn boxes(&self, node: &Node, t_max: f32) -> BoxHits;
    /// Test against four triangles: strictly between `t_min` and `t_max`.
    fn triangles(&self, pack: &Pack, t_max: f32) -> PackHits;
}

/// Rows of [`Node::bounds`] where the ray enters: the lower side where it goes up.
#[inline(always)]
pub(super) fn near_rows(inverse: Vec3) -> [usize; 3] {
    let axis = |a: usize, d: f32| 2 * a + usize::from(d < 0.0);
    [axis(0, inverse.x), axis(1, inverse.y), axis(2, inverse.z)]
}

/// Plain Rust: SSE2, NEON or whatever the compiler makes of it.
#[derive(Clone, Copy)]
pub(super) struct Portable {
    origin: Vec3,
    direction: Vec3,
    inverse: Vec3,
    near: [usize; 3],
    t_min: f32,
}

impl Kernel for Portable {
    #[inline(always)]
    fn new(origin: Vec3, direction: Vec3, t_min: f32) -> Self {
        let inverse = box_inverse(direction);
        Self {
            origin,
            direction,
            inverse,
            near: near_rows(inverse),
            t_min,
        }
    }

    #[inline(always)]
    fn boxes(&self, node: &Node, t_max: f32) -> BoxHits {
        let mut entry = [self.t_min; WIDTH];
        let mut exit = [t_max; WIDTH];
        for axis in 0..3 {
            let near = &node.bounds[self.near[axis]];
            let far = &node.bounds[self.near[axis] ^ 1];
            let (origin, inverse) = (self.origin[axis], self.inverse[axis]);
            for lane in 0..WIDTH {
                entry[lane] = entry[lane].max((near[lane] - origin) * inverse);
                exit[lane] = exit[lane].min((far[lane] - origin) * inverse * BOX_FAR_SLACK);
            }
        }
        let mut mask = 0;
        for lane in 0..WIDTH {
            mask |= u32::from(entry[lane] <= exit[lane]) << lane;
        }
        BoxHits { mask, entry }
    }

    #[inline(always)]
    fn triangles(&self, pack: &Pack, t_max: f32) -> PackHits {
        let mut hits = PackHits {
            mask: 0,
            t: [0.0; PACK],
            u: [0.0; PACK],
            v: [0.0; PACK],
        };
        for lane in 0..PACK {
            let [a, b, c] = pack.triangle(lane).map(|corner| corner - self.origin);
            let sides = triangle_sides(a, b, c, self.direction);
            let t = triangle_distance(a, b, c, self.direction);
            let weights = triangle_weights(sides);
            let hit = triangle_inside(sides) && t > self.t_min && t < t_max;
            hits.mask |= u32::from(hit) << lane;
            hits.t[lane] = t;
            hits.u[lane] = weights.x;
            hits.v[lane] = weights.y;
        }
        hits
    }
}
