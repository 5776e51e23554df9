//! The light tree: all local lights in a tree of up to eight children a node, descended at
//! random, each step towards a child that may matter more (Conty Estevez and Kulla 2018).
//!
//! Eight children in lanes: the importances of one node are one pass over arrays that the
//! compiler turns into vector instructions, and a million lights are seven steps away
//! instead of more than twenty, each of which waits for memory.

use super::tree_build;
use crate::device::light_importance::{LightBounds, light_importance};
use glam::Vec3;

/// Children of a node.
pub const WIDTH: usize = 8;

/// A node: bounds and links of its children, 48 bytes each. An empty slot has no power.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub struct LightNode {
    low: [[f32; WIDTH]; 3],
    high: [[f32; WIDTH]; 3],
    axis: [[f32; WIDTH]; 3],
    power: [f32; WIDTH],
    /// Bit 31: emitter, else node; bit 30: two-sided; below: index.
    link: [u32; WIDTH],
    /// Cosines of θo and θe, rounded down so that the cones only grow.
    cos_normals: [i16; WIDTH],
    cos_emission: [i16; WIDTH],
}

const EMITTER: u32 = 1 << 31;
const TWO_SIDED: u32 = 1 << 30;
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
    pub const EMPTY: Self = Self {
        low: [[0.0; WIDTH]; 3],
        high: [[0.0; WIDTH]; 3],
        axis: [[0.0; WIDTH]; 3],
        power: [0.0; WIDTH],
        link: [0; WIDTH],
        cos_normals: [0; WIDTH],
        cos_emission: [0; WIDTH],
    };

    /// Fills a slot.
    pub fn set(&mut self, slot: usize, bounds: &LightBounds, link: Link) {
        let down = |c: f32| (c.clamp(-1.0, 1.0) * 32767.0).floor() as i16;
        for axis in 0..3 {
            self.low[axis][slot] = bounds.low[axis];
            self.high[axis][slot] = bounds.high[axis];
            self.axis[axis][slot] = bounds.axis[axis];
        }
        self.power[slot] = bounds.power;
        self.cos_normals[slot] = down(bounds.cos_normals);
        self.cos_emission[slot] = down(bounds.cos_emission);
        let side = if bounds.two_sided { TWO_SIDED } else { 0 };
        self.link[slot] = side
            | match link {
                Link::Emitter(emitter) => emitter | EMITTER,
                Link::Node(node) => node,
            };
    }

    /// Bounds of a child.
    #[inline(always)]
    pub fn bounds(&self, slot: usize) -> LightBounds {
        let vector =
            |rows: &[[f32; WIDTH]; 3]| Vec3::new(rows[0][slot], rows[1][slot], rows[2][slot]);
        LightBounds {
            low: vector(&self.low),
            high: vector(&self.high),
            axis: vector(&self.axis),
            cos_normals: f32::from(self.cos_normals[slot]) * (1.0 / 32767.0),
            cos_emission: f32::from(self.cos_emission[slot]) * (1.0 / 32767.0),
            power: self.power[slot],
            two_sided: self.link[slot] & TWO_SIDED != 0,
        }
    }

    /// What a child is; nothing for an empty slot.
    #[inline(always)]
    pub fn link(&self, slot: usize) -> Option<Link> {
        let index = self.link[slot] & !(EMITTER | TWO_SIDED);
        let emitter = self.link[slot] & EMITTER != 0;
        let link = if emitter {
            Link::Emitter(index)
        } else {
            Link::Node(index)
        };
        (self.power[slot] > 0.0).then_some(link)
    }

    /// Importances of the children.
    #[inline]
    fn importances(&self, p: Vec3, n: Vec3) -> [f32; WIDTH] {
        let mut importances = [0.0; WIDTH];
        for (slot, importance) in importances.iter_mut().enumerate() {
            *importance = light_importance(self.bounds(slot), p, n);
        }
        importances
    }
}

/// Sum of the importances, in one fixed order.
#[inline(always)]
fn total(importances: &[f32; WIDTH]) -> f32 {
    let [a, b, c, d, e, f, g, h] = *importances;
    ((a + b) + (c + d)) + ((e + f) + (g + h))
}

/// A light tree over emitters numbered from 0.
#[derive(Clone, Debug, Default)]
pub struct LightTree {
    root: Option<LightBounds>,
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
            root: Some(root.bounds),
            nodes,
            parents,
            slots,
        }
    }

    /// Nodes, root first.
    pub fn nodes(&self) -> &[LightNode] {
        &self.nodes
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..]) + size_of_val(&self.parents[..]) + size_of_val(&self.slots[..])
    }

    /// True without emitters.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Importance of all emitters together.
    #[inline]
    pub fn importance(&self, p: Vec3, n: Vec3) -> f32 {
        self.root.map_or(0.0, |root| light_importance(root, p, n))
    }

    /// Draws an emitter with `u` in [0, 1); returns it and its probability, or nothing where
    /// the descent ends among lights that cannot reach the point.
    #[inline]
    pub fn sample(&self, p: Vec3, n: Vec3, mut u: f32) -> Option<(u32, f32)> {
        let mut node = self.nodes.first()?;
        let mut probability = 1.0;
        loop {
            let importances = node.importances(p, n);
            let sum = total(&importances);
            // Not a number and infinite sums end here too.
            if !(sum > 0.0 && sum < f32::INFINITY) {
                return None;
            }
            let (slot, rest) = choose(&importances, u * sum)?;
            probability *= importances[slot] / sum;
            u = rest;
            match node.link(slot)? {
                Link::Emitter(emitter) => return Some((emitter, probability)),
                Link::Node(child) => node = &self.nodes[child as usize],
            }
        }
    }

    /// Probability with which `sample` draws an emitter: upwards from its slot.
    #[inline]
    pub fn probability(&self, emitter: u32, p: Vec3, n: Vec3) -> f32 {
        let Some(&(mut at)) = self.slots.get(emitter as usize) else {
            return 0.0;
        };
        let mut probability = 1.0;
        loop {
            let (node, slot) = (at as usize / WIDTH, at as usize % WIDTH);
            let importances = self.nodes[node].importances(p, n);
            let sum = total(&importances);
            if !(sum > 0.0 && sum < f32::INFINITY) || importances[slot] == 0.0 {
                return 0.0;
            }
            probability *= importances[slot] / sum;
            if node == 0 {
                return probability;
            }
            at = self.parents[node];
        }
    }
}

/// Child in whose part of the sum `target` lies, and its place inside, in [0, 1).
#[inline(always)]
fn choose(importances: &[f32; WIDTH], target: f32) -> Option<(usize, f32)> {
    let mut left = target;
    let mut chosen = None;
    for (slot, &importance) in importances.iter().enumerate() {
        if importance > 0.0 {
            chosen = Some((slot, (left / importance).clamp(0.0, ONE_BELOW)));
            if left < importance {
                break;
            }
            left -= importance;
        }
    }
    chosen
}

/// Largest number below one.
pub const ONE_BELOW: f32 = 1.0 - f32::EPSILON / 2.0;
