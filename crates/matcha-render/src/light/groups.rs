//! The tree of groups: analytic lights, instances with emission and the world, local ones
//! parted from those at infinity at the root; the descent is in
//! [`crate::device::light_choice`].
//!
//! Where there are only instances below, their triangles hang in one light tree: it is eight
//! wide and made for many, and a picture does not depend on which triangle is tried, because
//! scattered rays meet what next-event estimation finds.

use super::tree_build::{self, BinaryLink, BinaryNode};
use crate::device::light_group::{LIGHT_GROUP_BOX, LIGHT_GROUP_DISTANT, LIGHT_GROUP_RECTANGLE};
use crate::device::light_importance::LightBounds;
use crate::device::light_view::{
    LIGHT_GROUP_IS_BLOCK, LIGHT_GROUP_IS_TREE, LIGHT_GROUP_IS_WORLD, LIGHT_GROUP_WHAT, LIGHT_NONE,
    LIGHT_OPENS, LIGHT_RECTANGLES, LIGHT_UNSURE, LightGroups, LightView,
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

    fn is_tree(&self) -> bool {
        self.link & LIGHT_GROUP_WHAT == LIGHT_GROUP_IS_TREE
    }

    fn is_world(&self) -> bool {
        self.link & LIGHT_GROUP_WHAT == LIGHT_GROUP_IS_WORLD
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
    /// Slot of each leaf that is not a tree: the local ones first, then those at infinity.
    pub slots: Vec<u32>,
}

/// Makes one tree of the leaves with the given numbers, all of them trees, that hangs in the
/// given slot; returns its root.
pub type JoinTrees<'a> = dyn FnMut(&[u32], u32) -> u32 + 'a;

/// One of two binary trees: leaves and what is above them.
struct Half<'a> {
    leaves: &'a [Group],
    nodes: Vec<BinaryNode>,
    /// By node: there are only emissive triangles below.
    surfaces: Vec<bool>,
    distant: bool,
    /// Number of the first leaf.
    first: usize,
}

impl<'a> Half<'a> {
    fn new(leaves: &'a [Group], distant: bool, first: usize) -> Self {
        let bounds: Vec<LightBounds> = leaves.iter().map(|g| g.bounds).collect();
        let nodes = tree_build::build(&bounds);
        let mut surfaces = vec![false; nodes.len()];
        // Children come after their parents.
        for (index, node) in nodes.iter().enumerate().rev() {
            surfaces[index] = match node.link {
                BinaryLink::Emitter(leaf) => leaves[leaf as usize].is_tree(),
                BinaryLink::Children(first) => {
                    surfaces[first as usize] && surfaces[first as usize + 1]
                }
            };
        }
        Self {
            leaves,
            nodes,
            surfaces,
            distant,
            first,
        }
    }

    fn leaves_below(&self, node: u32) -> Vec<u32> {
        let (mut open, mut found) = (vec![node], Vec::new());
        while let Some(node) = open.pop() {
            match self.nodes[node as usize].link {
                BinaryLink::Emitter(leaf) => found.push(leaf),
                BinaryLink::Children(first) => open.extend([first, first + 1]),
            }
        }
        found
    }
}

/// What is still to be put into blocks: a block and the first of its two binary nodes.
type Open = Vec<(usize, u32)>;

impl GroupTree {
    /// Builds the tree over local groups and those at infinity.
    pub fn build(local: &[Group], distant: &[Group], join: &mut JoinTrees) -> Self {
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
        let mut open = Open::new();
        for (lane, half) in halves.iter().enumerate() {
            let before = tree.blocks.len();
            if !half.leaves.is_empty() {
                tree.fill(half, 0, lane, 0, &mut open, join);
            }
            while let Some((block, node)) = open.pop() {
                for lane in 0..2 {
                    tree.fill(half, block, lane, node + lane as u32, &mut open, join);
                }
            }
            if half.leaves.iter().any(Group::is_world) {
                tree.blocks[0].flags |= LIGHT_UNSURE;
                for block in &mut tree.blocks[before..] {
                    block.flags |= LIGHT_UNSURE;
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
    /// it.
    fn fill(
        &mut self,
        half: &Half,
        block: usize,
        lane: usize,
        node: u32,
        open: &mut Open,
        join: &mut JoinTrees,
    ) {
        let BinaryNode { bounds, link } = half.nodes[node as usize];
        match link {
            BinaryLink::Children(first) if !half.surfaces[node as usize] => {
                self.blocks[block].set(lane, &Group::inner(bounds, half.distant));
                self.blocks[block].flags |= LIGHT_OPENS << lane;
                for side in 0..2 {
                    let below = 2 * lane + 2 + side;
                    self.set(half, block, below, first + side as u32, open, join);
                }
            }
            _ => self.set(half, block, lane, node, open, join),
        }
    }

    /// Puts a binary node into a lane.
    fn set(
        &mut self,
        half: &Half,
        block: usize,
        lane: usize,
        node: u32,
        open: &mut Open,
        join: &mut JoinTrees,
    ) {
        let slot = (block * LANES + lane) as u32;
        let BinaryNode { bounds, link } = half.nodes[node as usize];
        let group = match link {
            _ if half.surfaces[node as usize] => {
                let root = join(&half.leaves_below(node), slot);
                Group::boxed(bounds, LIGHT_GROUP_IS_TREE | root)
            }
            BinaryLink::Emitter(leaf) => {
                self.slots[half.first + leaf as usize] = slot;
                half.leaves[leaf as usize]
            }
            BinaryLink::Children(first) => {
                let next = self.add_block(slot);
                open.push((next, first));
                let mut group = Group::inner(bounds, half.distant);
                group.link |= next as u32;
                group
            }
        };
        self.blocks[block].set(lane, &group);
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
        if group.is_world() {
            self.world = lane as u32;
        }
    }
}
