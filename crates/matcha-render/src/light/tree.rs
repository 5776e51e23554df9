//! The light tree's data; the descent is in [`crate::device::light_tree`].

use super::tree_build;
use crate::device::light_importance::LightBounds;
use crate::device::light_view::{
    LIGHT_LINK_EMITTER, LIGHT_LINK_INDEX, LIGHT_LINK_TWO_SIDED, LightNode, LightRoot, LightView,
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

/// A light tree over emitters numbered from 0.
#[derive(Clone, Debug, Default)]
pub struct LightTree {
    root: LightRoot,
    nodes: Vec<LightNode>,
    /// Slot (`WIDTH` · node + child) that holds each node; unused for the root.
    parents: Vec<u32>,
    /// Slot that holds each emitter.
    slots: Vec<u32>,
}

impl LightTree {
    /// Builds the tree; emitter `i` has the bounds `bounds[i]`.
    pub fn build(bounds: &[LightBounds]) -> Self {
        let binary = tree_build::build(bounds);
        let Some(root) = binary.first() else {
            return Self::default();
        };
        let nodes = super::tree_collapse::collapse(&binary);
        let mut parents = vec![0; nodes.len()];
        let mut slots = vec![0; bounds.len()];
        for (index, node) in nodes.iter().enumerate() {
            for slot in 0..WIDTH {
                let here = (index * WIDTH + slot) as u32;
                match node.link(slot) {
                    Some(Link::Node(child)) => parents[child as usize] = here,
                    Some(Link::Emitter(emitter)) => slots[emitter as usize] = here,
                    None => {}
                }
            }
        }
        Self {
            root: stored(&root.bounds),
            nodes,
            parents,
            slots,
        }
    }

    /// The tree without the lights in it.
    #[inline(always)]
    pub fn view(&self) -> LightView<'_> {
        LightView {
            nodes: &self.nodes,
            parents: &self.parents,
            slots: &self.slots,
            root: self.root,
            ..LightView::default()
        }
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..]) + size_of_val(&self.parents[..]) + size_of_val(&self.slots[..])
    }

    /// True without emitters.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }
}

fn stored(bounds: &LightBounds) -> LightRoot {
    LightRoot {
        low: bounds.low,
        high: bounds.high,
        axis: bounds.axis,
        cos_normals: bounds.cos_normals,
        cos_emission: bounds.cos_emission,
        power: bounds.power,
        two_sided: u32::from(bounds.two_sided),
    }
}

/// What the tests ask of a tree.
#[cfg(test)]
mod asked {
    use super::*;
    use crate::device::light_tree::{
        light_child_bounds, light_tree_probability, light_tree_sample,
    };
    use glam::Vec3;

    impl LightTree {
        /// Nodes, root first.
        pub fn nodes(&self) -> &[LightNode] {
            &self.nodes
        }

        /// An emitter and its probability.
        pub fn sample(&self, p: Vec3, n: Vec3, u: f32) -> Option<(u32, f32)> {
            let choice = light_tree_sample(self.view(), p, n, u);
            choice.found.then_some((choice.index, choice.probability))
        }

        /// Probability with which `sample` draws an emitter.
        pub fn probability(&self, emitter: u32, p: Vec3, n: Vec3) -> f32 {
            light_tree_probability(self.view(), emitter, p, n)
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
