//! Light trees' data; the descent is in [`crate::device::light_tree`].

use super::tree_build;
use crate::device::light_importance::LightBounds;
use crate::device::light_view::{
    LIGHT_LINK_EMITTER, LIGHT_LINK_INDEX, LIGHT_LINK_TWO_SIDED, LIGHT_PARENT_GROUP, LightNode,
    LightView,
};
use bytemuck::Zeroable;

/// Children of a node.
pub const WIDTH: usize = 8;

/// Largest number of emitters that a tree can hold: slots are numbered in 32 bits.
pub const MAX_EMITTERS: usize = 1 << 28;

/// What a child is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Link {
    /// One emitter.
    Emitter(u32),
    /// Index of a node.
    Node(u32),
}

impl LightNode {
    /// A node without children.
    pub fn empty() -> Self {
        Self::zeroed()
    }

    /// Fills a slot.
    pub fn set(&mut self, slot: usize, bounds: &LightBounds, link: Link) {
        let down = |c: f32| (c.clamp(-1.0, 1.0) * 32767.0).floor() as i32 as u32;
        let [low, high, axis] = [bounds.low, bounds.high, bounds.axis];
        [self.low_x[slot], self.low_y[slot], self.low_z[slot]] = low.to_array();
        [self.high_x[slot], self.high_y[slot], self.high_z[slot]] = high.to_array();
        [self.axis_x[slot], self.axis_y[slot], self.axis_z[slot]] = axis.to_array();
        self.power[slot] = bounds.power;
        self.cosines[slot] =
            (down(bounds.cos_normals) & 0xffff) | (down(bounds.cos_emission) << 16);
        let side = if bounds.two_sided {
            LIGHT_LINK_TWO_SIDED
        } else {
            0
        };
        self.link[slot] = side
            | match link {
                Link::Emitter(emitter) => emitter | LIGHT_LINK_EMITTER,
                Link::Node(node) => node,
            };
    }

    /// What a child is; nothing for an empty slot.
    pub fn link(&self, slot: usize) -> Option<Link> {
        let index = self.link[slot] & LIGHT_LINK_INDEX;
        let link = if self.link[slot] & LIGHT_LINK_EMITTER != 0 {
            Link::Emitter(index)
        } else {
            Link::Node(index)
        };
        (self.power[slot] > 0.0).then_some(link)
    }
}

/// Light trees over emitters numbered from 0.
#[derive(Clone, Debug, Default)]
pub struct LightTree {
    nodes: Vec<LightNode>,
    /// Slot (`WIDTH` · node + child) that holds each node; of a root its slot in the groups.
    parents: Vec<u32>,
    /// Slot that holds each emitter.
    slots: Vec<u32>,
}

impl LightTree {
    /// Room for emitters; all are still to be added.
    pub fn new(emitters: usize) -> Self {
        Self {
            slots: vec![0; emitters],
            ..Self::default()
        }
    }

    /// Adds a tree over the listed emitters with the bounds `bounds`, that hangs in a slot of
    /// the groups; returns its root.
    pub fn add(&mut self, emitters: &[u32], bounds: &[LightBounds], slot_of_root: u32) -> u32 {
        let root = self.nodes.len() as u32;
        let mut added = super::tree_collapse::collapse(&tree_build::build(bounds));
        self.parents.resize(
            self.nodes.len() + added.len(),
            LIGHT_PARENT_GROUP | slot_of_root,
        );
        for (index, node) in (root..).zip(&mut added) {
            for slot in 0..WIDTH {
                let here = index * WIDTH as u32 + slot as u32;
                match node.link(slot) {
                    Some(Link::Node(child)) => {
                        node.link[slot] += root;
                        self.parents[(root + child) as usize] = here;
                    }
                    Some(Link::Emitter(place)) => {
                        let emitter = emitters[place as usize];
                        node.link[slot] = node.link[slot] & !LIGHT_LINK_INDEX | emitter;
                        self.slots[emitter as usize] = here;
                    }
                    None => {}
                }
            }
        }
        self.nodes.append(&mut added);
        root
    }

    /// The trees without the lights in them.
    #[inline(always)]
    pub fn view(&self) -> LightView<'_> {
        LightView {
            nodes: &self.nodes,
            parents: &self.parents,
            slots: &self.slots,
            ..LightView::default()
        }
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..]) + size_of_val(&self.parents[..]) + size_of_val(&self.slots[..])
    }
}

/// What the tests ask of a tree.
#[cfg(test)]
mod asked {
    use super::*;
    use crate::device::light_tree::{light_child_bounds, light_tree_climb, light_tree_sample};
    use glam::Vec3;

    impl LightTree {
        /// Nodes, root first.
        pub fn nodes(&self) -> &[LightNode] {
            &self.nodes
        }

        /// An emitter and its probability.
        pub fn sample(&self, p: Vec3, n: Vec3, u: f32) -> Option<(u32, f32)> {
            let choice = light_tree_sample(self.view(), 0, p, n, u);
            choice.found.then_some((choice.index, choice.probability))
        }

        /// Probability with which `sample` draws an emitter.
        pub fn probability(&self, emitter: u32, p: Vec3, n: Vec3) -> f32 {
            light_tree_climb(self.view(), emitter, p, n).probability
        }
    }

    impl LightNode {
        /// Bounds of a child.
        pub fn bounds(&self, slot: usize) -> LightBounds {
            let view = LightView {
                nodes: std::slice::from_ref(self),
                ..LightView::default()
            };
            light_child_bounds(view, 0, slot as u32)
        }
    }
}
