//! The words of nodes and triangles.

use super::grid::Grid;
use bytemuck::{Pod, Zeroable};
use matcha_render::accel::{Bounds, Pack, Placement, WIDTH};

/// Quads of words of a node.
pub const NODE_QUADS: usize = size_of::<WideNode>() / 16;
/// Quads of words of a triangle.
pub const TRIANGLE_QUADS: usize = size_of::<WideTriangle>() / 16;

/// Marks a node that is a placed mesh, in the upper byte of [`WideNode::grid`].
const PLACED: u32 = 1 << 24;

/// Eight boxes.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct WideNode {
    /// The grid's lower corner.
    pub origin: [f32; 3],
    /// The grid's exponents, a byte an axis as in the bits of a number; the upper byte is 0.
    pub grid: u32,
    /// The first node below; the others follow in the order of their slots.
    pub children: u32,
    /// The first triangle of its leaves; the others follow in the order of their slots.
    pub triangles: u32,
    /// Bits 0 to 7: slots with nodes; bits 8 to 15: slots with leaves.
    pub kinds: u32,
    /// For each slot with a leaf four bits, one less than its number of triangles.
    pub counts: u32,
    /// For each axis lower and upper sides in steps of the grid, a byte a slot.
    pub sides: [[[u8; WIDTH]; 2]; 3],
}

impl WideNode {
    /// A node without children, which nothing hits.
    pub const EMPTY: Self = Self {
        origin: [0.0; 3],
        grid: 127 | 127 << 8 | 127 << 16,
        children: 0,
        triangles: 0,
        kinds: 0,
        counts: 0,
        sides: [[[255; WIDTH], [0; WIDTH]]; 3],
    };

    /// A node without children over a grid.
    pub(super) fn over(grid: &Grid) -> Self {
        Self {
            origin: grid.origin,
            grid: grid.packed_exponents(),
            ..Self::EMPTY
        }
    }

    /// The grid of its boxes.
    pub fn grid(&self) -> Grid {
        let exponent = |axis: usize| (self.grid >> (8 * axis) & 255) as i32 - 127;
        Grid {
            origin: self.origin,
            exponents: std::array::from_fn(exponent),
        }
    }

    /// The root of the hierarchy of the mesh that is placed here, if it is none of eight boxes.
    pub fn placed_root(&self) -> Option<u32> {
        (self.grid & PLACED != 0).then(|| bytemuck::cast::<WideNode, PlacedNode>(*self).root)
    }

    /// Sets a slot's box.
    pub(super) fn set_box(&mut self, slot: usize, grid: &Grid, bounds: &Bounds) {
        for (axis, [low, high]) in grid.quantise(bounds).into_iter().enumerate() {
            self.sides[axis][0][slot] = low;
            self.sides[axis][1][slot] = high;
        }
    }

    /// Makes a slot a node.
    pub(super) fn set_node(&mut self, slot: usize) {
        self.kinds |= 1 << slot;
    }

    /// Makes a slot a leaf of 1 to 16 triangles.
    pub(super) fn set_leaf(&mut self, slot: usize, triangles: usize) {
        debug_assert!((1..=16).contains(&triangles));
        self.kinds |= 256 << slot;
        self.counts |= (triangles as u32 - 1) << (4 * slot);
    }
}

/// A mesh that is placed: of the size of a node, because it is a child as nodes are.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct PlacedNode {
    x_axis: [f32; 3],
    placed: u32,
    y_axis: [f32; 3],
    root: u32,
    z_axis: [f32; 3],
    instance: u32,
    translation: [f32; 3],
    mask: u32,
    unused: [u32; 4],
}

impl PlacedNode {
    /// `root` is the node that the mesh's hierarchy begins with, `mask` its visibility.
    pub(super) fn new(placement: &Placement, root: u32, mask: u8) -> Self {
        let matrix = placement.inverse.matrix3;
        Self {
            x_axis: matrix.x_axis.into(),
            placed: PLACED,
            y_axis: matrix.y_axis.into(),
            root,
            z_axis: matrix.z_axis.into(),
            instance: placement.instance,
            translation: placement.inverse.translation.into(),
            mask: u32::from(mask),
            unused: [0; 4],
        }
    }
}

/// A triangle in the space of its hierarchy.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct WideTriangle {
    /// Its corners.
    pub corners: [[f32; 3]; 3],
    /// Its number in the mesh.
    pub primitive: u32,
    /// Its instance; inside of a placed mesh it is the placement's.
    pub instance: u32,
    /// Which kinds of rays see it; inside of a placed mesh the placement tells.
    pub mask: u32,
}

impl WideTriangle {
    /// A lane of a pack; `masks` are the instances'.
    pub(super) fn new(pack: &Pack, lane: usize, masks: &[u8]) -> Self {
        let instance = pack.instance[lane];
        let mask = masks.get(instance as usize).copied().unwrap_or(u8::MAX);
        Self {
            corners: pack.triangle(lane).map(Into::into),
            primitive: pack.primitive[lane],
            instance,
            mask: u32::from(mask),
        }
    }
}
