//! The tree of groups: analytic lights, instances with emission and the world, local ones
//! parted from those at infinity at the root; the descent is in
//! [`crate::device::light_choice`].

use super::tree_build::{self, BinaryLink, BinaryNode};
use crate::device::light_group::{LIGHT_GROUP_BOX, LIGHT_GROUP_DISTANT, LIGHT_GROUP_RECTANGLE};
use crate::device::light_importance::LightBounds;
use crate::device::light_view::{
    LIGHT_GROUP_IS_BLOCK, LIGHT_GROUP_IS_WORLD, LIGHT_GROUP_WHAT, LIGHT_NONE, LIGHT_OPENS,
    LIGHT_RECTANGLES, LightGroups, LightView,
};
use bytemuck::Zeroable;
use glam::Vec3;
use std::f32::consts::PI;

/// Lanes of a block.
const LANES: usize = 8;

/// A leaf of the tree.
#[derive(Clone, Copy, Debug)]
pub struct Group {
    /// Bounds; their power counts.
    pub bounds: LightBounds,
    /// One of the `LIGHT_GROUP_` kinds.
    pub kind: u32,
    /// `half` of a `LightGroup` that is neither a box nor at infinity.
    pub half: Vec3,
    /// `side` of a `LightGroup`.
    pub side: Vec3,
    /// `LIGHT_GROUP_IS_` bits and an index.
    pub link: u32,
}

impl Group {
    /// Several lights between the corners of their box.
    pub fn boxed(bounds: LightBounds, link: u32) -> Self {
        Self {
            bounds,
            kind: LIGHT_GROUP_BOX,
            half: Vec3::ZERO,
            side: Vec3::ZERO,
            link,
        }
    }

    /// The world, which brings `irradiance` to one side in the mean.
    pub fn world(irradiance: f32) -> Self {
        let bounds = LightBounds {
            low: Vec3::ZERO,
            high: Vec3::ZERO,
            axis: Vec3::Z,
            cos_normals: -1.0,
            cos_emission: 1.0,
            power: irradiance,
            two_sided: false,
        };
        Self {
            kind: LIGHT_GROUP_DISTANT,
            ..Self::boxed(bounds, LIGHT_GROUP_IS_WORLD)
        }
    }

    fn inner(bounds: LightBounds, distant: bool) -> Self {
        let kind = if distant {
            LIGHT_GROUP_DISTANT
        } else {
            LIGHT_GROUP_BOX
        };
        Self {
            kind,
            ..Self::boxed(bounds, LIGHT_GROUP_IS_BLOCK)
        }
    }

    fn half(&self) -> Vec3 {
        let b = &self.bounds;
        match self.kind {
            LIGHT_GROUP_BOX => 0.5 * (b.high - b.low),
            LIGHT_GROUP_DISTANT => {
                let around = b.cos_normals.acos() + b.cos_emission.acos();
                Vec3::X * around.min(PI).cos()
            }
            _ => self.half,
        }
    }
}

/// The tree.
#[derive(Clone, Debug, Default)]
pub struct GroupTree {
    blocks: Vec<LightGroups>,
    /// Slot that holds each block; unused for the root.
    parents: Vec<u32>,
    /// Slot of each leaf: the local ones first, then those at infinity.
    pub slots: Vec<u32>,
}

/// One of two binary trees: leaves and what is above them.
struct Half<'a> {
    leaves: &'a [Group],
    nodes: Vec<BinaryNode>,
    distant: bool,
    /// Number of the first leaf.
    first: usize,
}

impl<'a> Half<'a> {
    fn new(leaves: &'a [Group], distant: bool, first: usize) -> Self {
        let bounds: Vec<LightBounds> = leaves.iter().map(|g| g.bounds).collect();
        Self {
            nodes: tree_build::build(&bounds),
            leaves,
            distant,
            first,
        }
    }
}

impl GroupTree {
    /// Builds the tree over local groups and those at infinity.
    pub fn build(local: &[Group], distant: &[Group]) -> Self {
        let mut tree = Self {
            slots: vec![LIGHT_NONE; local.len() + distant.len()],
            ..Self::default()
        };
        if tree.slots.is_empty() {
            return tree;
        }
        tree.add_block(0);
        let halves = [
            Half::new(local, false, 0),
            Half::new(distant, true, local.len()),
        ];
        let mut open = Vec::new();
        for (lane, half) in halves.iter().enumerate() {
            if !half.leaves.is_empty() {
                tree.fill(half, 0, lane, 0, &mut open);
            }
            while let Some((block, node)) = open.pop() {
                for lane in 0..2 {
                    tree.fill(half, block, lane, node + lane as u32, &mut open);
                }
            }
        }
        tree
    }

    fn add_block(&mut self, parent: u32) -> usize {
        self.blocks.push(LightGroups {
            world: LIGHT_NONE,
            ..LightGroups::zeroed()
        });
        self.parents.push(parent);
        self.blocks.len() - 1
    }

    /// Puts a binary node into lane 0 or 1 of a block, and its children into the lanes below
    /// it. Blocks that are still to be filled go to `open` with their first node.
    fn fill(
        &mut self,
        half: &Half,
        block: usize,
        lane: usize,
        node: u32,
        open: &mut Vec<(usize, u32)>,
    ) {
        let BinaryLink::Children(first) = half.nodes[node as usize].link else {
            return self.set(half, block, lane, node, open);
        };
        let group = Group::inner(half.nodes[node as usize].bounds, half.distant);
        self.blocks[block].set(lane, &group);
        self.blocks[block].flags |= LIGHT_OPENS << lane;
        for side in 0..2 {
            self.set(half, block, 2 * lane + 2 + side, first + side as u32, open);
        }
    }

    /// Puts a binary node into a lane.
    fn set(
        &mut self,
        half: &Half,
        block: usize,
        lane: usize,
        node: u32,
        open: &mut Vec<(usize, u32)>,
    ) {
        let slot = (block * LANES + lane) as u32;
        match half.nodes[node as usize].link {
            BinaryLink::Emitter(leaf) => {
                self.slots[half.first + leaf as usize] = slot;
                self.blocks[block].set(lane, &half.leaves[leaf as usize]);
            }
            BinaryLink::Children(first) => {
                let next = self.add_block(slot);
                open.push((next, first));
                let bounds = half.nodes[node as usize].bounds;
                self.blocks[block].set(lane, &Group::inner(bounds, half.distant));
                self.blocks[block].link[lane] |= next as u32;
            }
        }
    }

    /// The tree without the lights in it.
    #[inline(always)]
    pub fn view(&self) -> LightView<'_> {
        LightView {
            groups: &self.blocks,
            group_parents: &self.parents,
            ..LightView::default()
        }
    }

    /// True without groups.
    pub fn is_empty(&self) -> bool {
        self.blocks.is_empty()
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.blocks[..])
            + size_of_val(&self.parents[..])
            + size_of_val(&self.slots[..])
    }
}

impl LightGroups {
    /// Fills a lane.
    fn set(&mut self, lane: usize, group: &Group) {
        let b = &group.bounds;
        let middle = (b.low + b.high) * 0.5;
        [
            self.center_x[lane],
            self.center_y[lane],
            self.center_z[lane],
        ] = middle.to_array();
        [self.half_x[lane], self.half_y[lane], self.half_z[lane]] = group.half().to_array();
        [self.side_x[lane], self.side_y[lane], self.side_z[lane]] = group.side.to_array();
        [self.axis_x[lane], self.axis_y[lane], self.axis_z[lane]] = b.axis.to_array();
        self.cos_normals[lane] = b.cos_normals;
        self.cos_emission[lane] = b.cos_emission;
        self.power[lane] = b.power;
        self.kind[lane] = group.kind;
        self.link[lane] = group.link;
        if group.kind == LIGHT_GROUP_RECTANGLE {
            self.flags |= LIGHT_RECTANGLES;
        }
        if group.link & LIGHT_GROUP_WHAT == LIGHT_GROUP_IS_WORLD {
            self.world = lane as u32;
        }
    }
}
