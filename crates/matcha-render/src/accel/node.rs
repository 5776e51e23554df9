//! The structure that rays walk through: nodes of eight boxes and packs of four triangles.
//! Public for devices that walk it in a form of their own.

use glam::Vec3;

/// Children of a node.
pub const WIDTH: usize = 8;
/// Triangles of a pack.
pub const PACK: usize = 4;
/// Largest number of packs in a leaf.
pub const LEAF_PACKS: usize = 4;

/// What a child slot or a stack entry points to: two bits of kind, then an index.
///
/// * inner node: its index;
/// * leaf: two bits of `packs - 1`, then the first pack;
/// * instance: index into the table of placed instances;
/// * `RESTORE`: on the stack only, "back to world space".
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(transparent)]
pub struct Link(pub u32);

impl Link {
    const KIND: u32 = 3 << 30;
    const LEAF: u32 = 1 << 30;
    const INSTANCE: u32 = 2 << 30;
    const COUNT_SHIFT: u32 = 28;
    const INDEX: u32 = (1 << 28) - 1;
    /// Nothing is there.
    pub const EMPTY: Self = Self(u32::MAX);
    /// The walk leaves an instance.
    pub const RESTORE: Self = Self(3 << 30);
    /// Number of nodes and of packs that can be addressed.
    pub const LIMIT: usize = 1 << 28;

    /// Link to an inner node.
    pub fn node(index: usize) -> Self {
        debug_assert!(index < Self::LIMIT);
        Self(index as u32)
    }

    /// Link to a leaf of 1 to [`LEAF_PACKS`] packs.
    pub fn leaf(first: usize, packs: usize) -> Self {
        debug_assert!(first < Self::LIMIT && (1..=LEAF_PACKS).contains(&packs));
        Self(Self::LEAF | ((packs as u32 - 1) << Self::COUNT_SHIFT) | first as u32)
    }

    /// Link to a placed instance.
    pub fn instance(index: usize) -> Self {
        debug_assert!(index < Self::LIMIT);
        Self(Self::INSTANCE | index as u32)
    }

    /// True for an inner node.
    #[inline(always)]
    pub fn is_node(self) -> bool {
        self.0 & Self::KIND == 0
    }

    /// True for a leaf.
    #[inline(always)]
    pub fn is_leaf(self) -> bool {
        self.0 & Self::KIND == Self::LEAF
    }

    /// True for a placed instance.
    #[inline(always)]
    pub fn is_instance(self) -> bool {
        self.0 & Self::KIND == Self::INSTANCE
    }

    /// Index of the node, of the first pack, or of the placement.
    #[inline(always)]
    pub fn index(self) -> usize {
        (self.0 & Self::INDEX) as usize
    }

    /// Number of packs of a leaf.
    #[inline(always)]
    pub fn packs(self) -> usize {
        ((self.0 >> Self::COUNT_SHIFT) & 3) as usize + 1
    }
}

/// Boxes of eight children: rows min x, max x, min y, max y, min z, max z, a lane per child.
/// An empty slot's box is inside out, so that no ray meets it.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct Node {
    /// The rows.
    pub bounds: [[f32; WIDTH]; 6],
    /// What the children are.
    pub children: [Link; WIDTH],
}

impl Node {
    /// A node without children.
    pub const EMPTY: Self = Self {
        bounds: [
            [f32::INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
            [f32::INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
            [f32::INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
        ],
        children: [Link::EMPTY; WIDTH],
    };

    /// Sets a child.
    pub fn set(&mut self, slot: usize, bounds: &Bounds, link: Link) {
        for axis in 0..3 {
            self.bounds[2 * axis][slot] = bounds.min[axis];
            self.bounds[2 * axis + 1][slot] = bounds.max[axis];
        }
        self.children[slot] = link;
    }

    /// Box of a child.
    pub fn child_bounds(&self, slot: usize) -> Bounds {
        let row = |r: usize| self.bounds[r][slot];
        Bounds {
            min: Vec3::new(row(0), row(2), row(4)),
            max: Vec3::new(row(1), row(3), row(5)),
        }
    }
}

/// An axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Lower corner.
    pub min: Vec3,
    /// Upper corner.
    pub max: Vec3,
}

impl Bounds {
    /// Inside out: holds nothing.
    pub const EMPTY: Self = Self {
        min: Vec3::INFINITY,
        max: Vec3::NEG_INFINITY,
    };

    /// Extends it to hold a point.
    pub fn grow(&mut self, point: Vec3) {
        self.min = self.min.min(point);
        self.max = self.max.max(point);
    }
}

/// Four triangles: rows x, y, z of the first corners, then of the second and the third.
/// Unused lanes hold triangles without area, which nothing hits.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(16))]
pub struct Pack {
    /// The rows.
    pub corners: [[[f32; PACK]; 3]; 3],
    /// Triangles in their meshes; `u32::MAX` in unused lanes.
    pub primitive: [u32; PACK],
    /// Only meant for triangles in world space; inside an instance it is the instance's.
    pub instance: [u32; PACK],
}

impl Pack {
    /// A pack of unused lanes.
    pub const EMPTY: Self = Self {
        corners: [[[0.0; PACK]; 3]; 3],
        primitive: [u32::MAX; PACK],
        instance: [u32::MAX; PACK],
    };

    /// Sets a triangle.
    pub fn set(&mut self, lane: usize, corners: [Vec3; 3], primitive: u32, instance: u32) {
        for (rows, corner) in self.corners.iter_mut().zip(corners) {
            for (axis, row) in rows.iter_mut().enumerate() {
                row[lane] = corner[axis];
            }
        }
        self.primitive[lane] = primitive;
        self.instance[lane] = instance;
    }

    /// Corners of a triangle.
    pub fn triangle(&self, lane: usize) -> [Vec3; 3] {
        std::array::from_fn(|c| {
            let rows = &self.corners[c];
            Vec3::new(rows[0][lane], rows[1][lane], rows[2][lane])
        })
    }
}
