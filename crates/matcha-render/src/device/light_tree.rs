//! Light trees: the emissive triangles of an instance in a tree of up to eight children a node, descended at
//! random, each step towards a child that may matter more (Conty Estevez and Kulla 2018).
//!
//! Eight children in lanes: the importances of one node are one pass over arrays that a
//! compiler turns into vector instructions, and a million lights are seven steps away
//! instead of more than twenty, each of which waits for memory.

use crate::device::light_analytic::LIGHT_FAR;
use crate::device::light_importance::{LightBounds, light_importance};
use crate::device::light_view::{
    LIGHT_LINK_EMITTER, LIGHT_LINK_INDEX, LIGHT_LINK_TWO_SIDED, LIGHT_PARENT_GROUP, LightView,
};
use glam::Vec3;
use matcha_shade::device::math::{clamp, vec3};

/// Largest number below one.
pub const LIGHT_ONE_BELOW: f32 = 0.999_999_94;

/// Bounds of a child of a node.
#[inline(always)]
pub fn light_child_bounds(view: LightView, node: u32, slot: u32) -> LightBounds {
    let cosines = view.nodes[node as usize].cosines[slot as usize] as i32;
    let link = view.nodes[node as usize].link[slot as usize];
    LightBounds {
        low: vec3(
            view.nodes[node as usize].low_x[slot as usize],
            view.nodes[node as usize].low_y[slot as usize],
            view.nodes[node as usize].low_z[slot as usize],
        ),
        high: vec3(
            view.nodes[node as usize].high_x[slot as usize],
            view.nodes[node as usize].high_y[slot as usize],
            view.nodes[node as usize].high_z[slot as usize],
        ),
        axis: vec3(
            view.nodes[node as usize].axis_x[slot as usize],
            view.nodes[node as usize].axis_y[slot as usize],
            view.nodes[node as usize].axis_z[slot as usize],
        ),
        cos_normals: ((cosines << 16) >> 16) as f32 * (1.0 / 32767.0),
        cos_emission: (cosines >> 16) as f32 * (1.0 / 32767.0),
        power: view.nodes[node as usize].power[slot as usize],
        two_sided: (link & LIGHT_LINK_TWO_SIDED) != 0,
    }
}

/// Importances of a node's children at the point `p` with normal `n`.
#[inline(always)]
pub fn light_importances(view: LightView, node: u32, p: Vec3, n: Vec3) -> [f32; 8] {
    let mut importances = [0.0; 8];
    let mut slot = 0;
    while slot < 8 {
        importances[slot as usize] = light_importance(light_child_bounds(view, node, slot), p, n);
        slot += 1;
    }
    importances
}

/// Sum of the importances, in one fixed order.
#[inline(always)]
pub fn light_importance_sum(i: [f32; 8]) -> f32 {
    ((i[0] + i[1]) + (i[2] + i[3])) + ((i[4] + i[5]) + (i[6] + i[7]))
}

/// A child in whose part of the sum of importances a number lies.
#[derive(Clone, Copy, Debug)]
pub struct LightChild {
    /// False where all importances are zero.
    pub found: bool,
    /// The child.
    pub slot: u32,
    /// Place of the number inside of the child's part, in [0, 1).
    pub place: f32,
}

/// Child in whose part of the sum `target` lies.
#[inline(always)]
pub fn light_choose_child(importances: [f32; 8], target: f32) -> LightChild {
    let mut child = LightChild {
        found: false,
        slot: 0,
        place: 0.0,
    };
    let mut left = target;
    let mut slot = 0;
    while slot < 8 {
        let importance = importances[slot as usize];
        if importance > 0.0 {
            child = LightChild {
                found: true,
                slot,
                place: clamp(left / importance, 0.0, LIGHT_ONE_BELOW),
            };
            if left < importance {
                return child;
            }
            left -= importance;
        }
        slot += 1;
    }
    child
}

/// An emitter that was drawn from a tree.
#[derive(Clone, Copy, Debug)]
pub struct LightChoice {
    /// False where none can reach the point.
    pub found: bool,
    /// Which.
    pub index: u32,
    /// Probability of the choice.
    pub probability: f32,
}

/// Draws an emitter below the node `root` with `select` in [0, 1); none where the descent ends
/// among lights that cannot reach the point.
#[inline(always)]
pub fn light_tree_sample(view: LightView, root: u32, p: Vec3, n: Vec3, select: f32) -> LightChoice {
    let mut choice = LightChoice {
        found: false,
        index: 0,
        probability: 1.0,
    };
    let mut node = root;
    let mut u = select;
    loop {
        let importances = light_importances(view, node, p, n);
        let sum = light_importance_sum(importances);
        // Not a number and infinite sums end here too.
        if !(sum > 0.0 && sum <= LIGHT_FAR) {
            return choice;
        }
        let child = light_choose_child(importances, u * sum);
        if !child.found {
            return choice;
        }
        choice.probability *= importances[child.slot as usize] / sum;
        u = child.place;
        let link = view.nodes[node as usize].link[child.slot as usize];
        node = link & LIGHT_LINK_INDEX;
        if (link & LIGHT_LINK_EMITTER) != 0 {
            choice.found = true;
            choice.index = node;
            return choice;
        }
    }
}

/// A way from an emitter up to the root of its tree.
#[derive(Clone, Copy, Debug)]
pub struct LightClimb {
    /// Probability with which [`light_tree_sample`] draws the emitter from the root.
    pub probability: f32,
    /// Slot of the tree in the groups.
    pub slot: u32,
}

/// Climbs from an emitter's slot; ends early where the probability is 0.
#[inline(always)]
pub fn light_tree_climb(view: LightView, emitter: u32, p: Vec3, n: Vec3) -> LightClimb {
    let mut climb = LightClimb {
        probability: 1.0,
        slot: 0,
    };
    let mut at = view.slots[emitter as usize];
    loop {
        let node = at / 8;
        let importances = light_importances(view, node, p, n);
        let sum = light_importance_sum(importances);
        let importance = importances[(at % 8) as usize];
        if !(sum > 0.0 && sum <= LIGHT_FAR) || importance == 0.0 {
            climb.probability = 0.0;
            return climb;
        }
        climb.probability *= importance / sum;
        at = view.parents[node as usize];
        if (at & LIGHT_PARENT_GROUP) != 0 {
            climb.slot = at & !LIGHT_PARENT_GROUP;
            return climb;
        }
    }
}
