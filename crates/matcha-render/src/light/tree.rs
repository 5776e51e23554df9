//! The light tree: a binary tree over all local lights that is descended at random, each
//! step towards the child that may matter more (Conty Estevez and Kulla 2018).

use super::tree_build;
use crate::device::light_importance::{LightBounds, light_importance};
use glam::Vec3;

/// A node of the tree, 48 bytes. Both children of an inner node lie side by side.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct LightNode {
    low: [f32; 3],
    power: f32,
    high: [f32; 3],
    /// Bit 31: leaf; bit 30: two-sided; below: emitter of a leaf, first child else.
    link: u32,
    axis: [f32; 3],
    /// Cosines of θo and θe, 16 bits each, rounded down so that the cones only grow.
    cosines: [i16; 2],
}

const LEAF: u32 = 1 << 31;
const TWO_SIDED: u32 = 1 << 30;
/// Largest number of emitters that a tree can hold.
pub const MAX_EMITTERS: usize = TWO_SIDED as usize / 2;

/// What a node leads to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Link {
    /// One emitter.
    Emitter(u32),
    /// Index of the first of two children.
    Children(u32),
}

impl LightNode {
    /// Packs bounds and link.
    pub fn new(bounds: &LightBounds, link: Link) -> Self {
        let down = |c: f32| (c.clamp(-1.0, 1.0) * 32767.0).floor() as i16;
        let link = match link {
            Link::Emitter(e) => e | LEAF,
            Link::Children(c) => c,
        };
        Self {
            low: bounds.low.to_array(),
            power: bounds.power,
            high: bounds.high.to_array(),
            link: link | if bounds.two_sided { TWO_SIDED } else { 0 },
            axis: bounds.axis.to_array(),
            cosines: [down(bounds.cos_normals), down(bounds.cos_emission)],
        }
    }

    /// The node's bounds.
    #[inline(always)]
    pub fn bounds(&self) -> LightBounds {
        LightBounds {
            low: Vec3::from_array(self.low),
            high: Vec3::from_array(self.high),
            axis: Vec3::from_array(self.axis),
            cos_normals: f32::from(self.cosines[0]) * (1.0 / 32767.0),
            cos_emission: f32::from(self.cosines[1]) * (1.0 / 32767.0),
            power: self.power,
            two_sided: self.link & TWO_SIDED != 0,
        }
    }

    /// What the node leads to.
    #[inline(always)]
    pub fn link(&self) -> Link {
        let index = self.link & !(LEAF | TWO_SIDED);
        if self.link & LEAF != 0 {
            Link::Emitter(index)
        } else {
            Link::Children(index)
        }
    }
}

/// A light tree over emitters numbered from 0.
#[derive(Clone, Debug, Default)]
pub struct LightTree {
    nodes: Vec<LightNode>,
    /// Way to each emitter's leaf: bit k tells which child is taken at depth k.
    trails: Vec<u64>,
}

impl LightTree {
    /// Builds the tree; emitter `i` has the bounds `bounds[i]`.
    pub fn build(bounds: &[LightBounds]) -> Self {
        let (nodes, trails) = tree_build::build(bounds);
        Self { nodes, trails }
    }

    /// Nodes, root first.
    pub fn nodes(&self) -> &[LightNode] {
        &self.nodes
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..]) + size_of_val(&self.trails[..])
    }

    /// True without emitters.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Importance of a node.
    #[inline(always)]
    pub fn importance(&self, node: u32, p: Vec3, n: Vec3) -> f32 {
        light_importance(self.nodes[node as usize].bounds(), p, n)
    }

    /// Draws an emitter with `u` in [0, 1); returns it and its probability, or nothing where
    /// the descent ends among lights that cannot reach the point.
    #[inline]
    pub fn sample(&self, p: Vec3, n: Vec3, mut u: f32) -> Option<(u32, f32)> {
        let mut node = self.nodes.first()?;
        let mut probability = 1.0;
        if let Link::Emitter(emitter) = node.link() {
            return (self.importance(0, p, n) > 0.0).then_some((emitter, 1.0));
        }
        loop {
            match node.link() {
                Link::Emitter(emitter) => return Some((emitter, probability)),
                Link::Children(first) => {
                    let left = self.left_share(first, p, n)?;
                    // A child without a share is never taken: u < 1 and u ≥ 0 hold strictly.
                    let right = u >= left;
                    let share = if right { 1.0 - left } else { left };
                    u = if right { u - left } else { u } / share;
                    u = u.min(ONE_BELOW);
                    probability *= share;
                    node = &self.nodes[first as usize + usize::from(right)];
                }
            }
        }
    }

    /// Probability with which `sample` draws an emitter.
    #[inline]
    pub fn probability(&self, emitter: u32, p: Vec3, n: Vec3) -> f32 {
        let Some(mut trail) = self.trails.get(emitter as usize).copied() else {
            return 0.0;
        };
        let mut node = self.nodes[0];
        let mut probability = 1.0;
        if let Link::Emitter(_) = node.link() {
            return f32::from(u8::from(self.importance(0, p, n) > 0.0));
        }
        while let Link::Children(first) = node.link() {
            let Some(left) = self.left_share(first, p, n) else {
                return 0.0;
            };
            let right = trail & 1 == 1;
            trail >>= 1;
            probability *= if right { 1.0 - left } else { left };
            if probability == 0.0 {
                return 0.0;
            }
            node = self.nodes[first as usize + usize::from(right)];
        }
        probability
    }

    /// Probability of the first of two children; nothing where neither matters.
    #[inline(always)]
    fn left_share(&self, first: u32, p: Vec3, n: Vec3) -> Option<f32> {
        let left = self.importance(first, p, n);
        let right = self.importance(first + 1, p, n);
        let sum = left + right;
        // Not a number and infinite sums end here too.
        (sum > 0.0 && sum < f32::INFINITY).then(|| left / sum)
    }
}

/// Largest number below one.
pub const ONE_BELOW: f32 = 1.0 - f32::EPSILON / 2.0;
