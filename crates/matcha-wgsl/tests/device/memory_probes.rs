//! Device code for tests: views, references and values in columns.
// `swap` is a method, which device code does without.
#![allow(clippy::manual_swap)]

use bytemuck::{Pod, Zeroable};
use matcha_shade::device::math::*;

/// An element of [`ProbeView`].
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct ProbeNode {
    pub at: Vec3,
    pub child: u32,
    pub weights: [u32; 9],
    pub kind: i32,
    pub pair: Vec2,
}

/// Buffers and numbers.
#[derive(Clone, Copy, Debug)]
pub struct ProbeView<'a> {
    pub nodes: &'a [ProbeNode],
    pub order: &'a [u32],
    pub bias: i32,
    pub corners: [Vec3; 2],
    pub root: ProbeNode,
}

/// The nodes of an order, followed from one to the next.
pub fn probe_walk(view: ProbeView, start: u32, steps: u32) -> u32 {
    let mut at = start % view.order.len() as u32;
    let mut sum = 0;
    let mut k = 0;
    while k < steps {
        let node = view.nodes[view.order[at as usize] as usize];
        sum = wrapping_add(
            wrapping_mul(sum, 31),
            node.weights[(k % 9) as usize] ^ node.child,
        );
        at = node.child % view.order.len() as u32;
        k += 1;
    }
    sum
}

/// Every form of access to a view.
pub fn probe_view(w: [u32; 13], view: ProbeView<'_>) -> [u32; 4] {
    let i = w[0] % view.nodes.len() as u32;
    let k = w[1] % 9;
    let whole = view.nodes[i as usize];
    let leaf = view.nodes[i as usize].weights[k as usize];
    let part = view.nodes[(view.order[3] ^ 1) as usize].pair.y;
    let at = view.nodes[2].at;
    let corner = view.corners[(w[2] & 1) as usize];
    let kinds = (view.nodes[i as usize].kind + view.bias) as u32;
    let root = view.root;
    [
        probe_walk(view, w[3], w[4] % 20) ^ leaf,
        wrapping_add(bits_of(whole.pair.x), bits_of(part)) ^ kinds,
        bits_of(at.y) ^ bits_of(corner.z) ^ bits_of(whole.at.x),
        wrapping_mul(root.weights[k as usize], 31) ^ bits_of(view.root.at.z),
    ]
}

/// Some state that functions write through references.
#[derive(Clone, Copy, Debug)]
pub struct ProbeSet {
    pub items: [ProbeItem; 11],
    pub count: u32,
    pub frozen: bool,
    pub at: Vec3,
    pub history: [u32; 3],
}

/// An item of it.
#[derive(Clone, Copy, Debug)]
pub struct ProbeItem {
    pub key: u32,
    pub level: i32,
    pub on: bool,
    pub color: Vec3,
}

pub fn probe_next(state: &mut u32) -> u32 {
    *state = wrapping_add(wrapping_mul(*state, 747_796_405), 2_891_336_453);
    (*state >> 9) ^ *state
}

pub fn probe_add(set: &mut ProbeSet, item: &ProbeItem) {
    if set.count >= 11 || set.frozen {
        return;
    }
    set.items[set.count as usize] = *item;
    set.count += 1;
}

pub fn probe_grow(set: &mut ProbeSet, by: u32) -> u32 {
    set.history[(by % 3) as usize] ^= by;
    set.at = set.at * 2.0 + splat3(1.0);
    set.count = (set.count + by) % 11;
    set.count
}

pub fn probe_rotate(history: &mut [u32; 3], k: u32) -> bool {
    let first = history[0];
    history[0] = history[(k % 3) as usize];
    history[(k % 3) as usize] = first;
    history[0] > first
}

pub fn probe_hash(set: &ProbeSet) -> u32 {
    let mut hash = set.count ^ bits_of(set.at.x) ^ rotate_left(bits_of(set.at.z), 3);
    let mut k = 0;
    while k < 11 {
        let item = set.items[k as usize];
        let color = bits_of(item.color.x) ^ bits_of(item.color.y) ^ bits_of(item.color.z);
        hash = wrapping_mul(hash ^ item.key ^ item.level as u32 ^ color, 0x9e37_79b1);
        hash ^= item.on as u32;
        k += 1;
    }
    hash ^ set.history[0] ^ wrapping_mul(set.history[1], 3) ^ wrapping_mul(set.history[2], 5)
}

/// A set made of a point's words.
pub fn probe_make(w: [u32; 13]) -> ProbeSet {
    let mut state = w[0];
    let color = vec3(1.0, 2.0, (w[1] & 0xff) as f32);
    let none = ProbeItem {
        key: 7,
        level: -1,
        on: false,
        color,
    };
    let mut set = ProbeSet {
        items: [none; 11],
        count: 0,
        frozen: false,
        at: color,
        history: [w[2], w[3], w[4]],
    };
    let mut k = 0;
    while k < w[5] % 14 {
        let mut item = none;
        item.key = probe_next(&mut state);
        item.level = (probe_next(&mut state) % 100) as i32 - 50;
        item.on = probe_next(&mut state) & 1 == 1;
        item.color.y = (probe_next(&mut state) & 0xffff) as f32;
        probe_add(&mut set, &item);
        k += 1;
    }
    set.frozen = w[6] & 1 == 1;
    set
}

/// Writes in every order.
pub fn probe_references(w: [u32; 13]) -> [u32; 4] {
    let mut set = probe_make(w);
    let before = set;
    // The sum takes the count before the call, the product that behind it.
    let sum = set.count + probe_grow(&mut set, 3) * 16 + set.count * 256;
    // The place is found after the value.
    set.items[set.count as usize].key = probe_grow(&mut set, w[7] % 5);
    set.history[(set.count % 3) as usize] ^= probe_grow(&mut set, 1);
    let mut history = set.history;
    let rotated = if w[8] & 1 == 0 {
        probe_rotate(&mut history, w[9])
    } else {
        false
    };
    let mut state = w[10];
    let mut rounds = 0;
    while probe_next(&mut state) & 7 > 0 && rounds < 30 {
        rounds += 1;
    }
    let mut copy = before;
    copy.count ^= 1;
    [
        sum ^ rounds,
        probe_hash(&set),
        wrapping_add(probe_hash(&before), probe_hash(&copy)),
        rotated as u32 ^ state ^ history[1],
    ]
}
