//! From a binary hierarchy to nodes of eight children.
//!
//! Which binary nodes survive, and which sub-trees become leaves, is chosen by the dynamic
//! program of Ylitie, Karras and Laine 2017 ("Efficient incoherent ray traversal on GPUs through
//! compressed wide BVHs", section 3): `cost(n, i)` is the least expected cost of the sub-tree at
//! `n` if it may appear as up to `i` children of the wide node above.

use super::node::{Bounds, LEAF_PACKS, Link, Node, PACK, WIDTH};
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;

/// Expected cost of a visit to a node, where one pack of triangles costs [`PACK_COST`].
const NODE_COST: f32 = 1.0;
const PACK_COST: f32 = 0.7;

/// How a sub-tree of the binary hierarchy is represented.
#[derive(Clone, Copy)]
enum Choice {
    /// A leaf with all its primitives.
    Leaf,
    /// A wide node of its own, whose children come from a split into so many for the left.
    Node(u8),
    /// As siblings: so many for the left sub-tree, the rest for the right.
    Split(u8),
    /// As with one sibling fewer.
    Fewer,
}

/// Costs and choices of a binary node for 1 to 7 siblings.
#[derive(Clone, Copy)]
struct Entry {
    cost: [f32; WIDTH - 1],
    choice: [Choice; WIDTH - 1],
    /// Primitives in the sub-tree, saturated.
    primitives: u8,
}

/// What the leaves of a hierarchy are made of.
pub(super) trait Leaves {
    /// True if the primitive can share a leaf with others.
    fn can_share(&self, primitive: u32) -> bool;
    /// Writes a leaf for the primitives and returns the link to it.
    fn write(&mut self, primitives: &[u32]) -> Link;
}

fn bounds_of(aabb: &Aabb) -> Bounds {
    Bounds {
        min: aabb.min.into(),
        max: aabb.max.into(),
    }
}

/// Appends the wide form of `tree` to `nodes` and returns the link to its root and the number of
/// stack entries that a walk through it can need.
pub(super) fn collapse(
    tree: &Bvh2,
    nodes: &mut Vec<Node>,
    leaves: &mut dyn Leaves,
) -> (Link, usize) {
    let table = solve(tree, leaves);
    let mut writer = Writer {
        tree,
        table: &table,
        nodes,
        leaves,
        members: Vec::new(),
    };
    writer.write()
}

/// Binary nodes, children before parents.
fn children_first(tree: &Bvh2) -> Vec<u32> {
    let mut order = Vec::with_capacity(tree.nodes.len());
    let mut stack = vec![0u32];
    while let Some(index) = stack.pop() {
        order.push(index);
        let node = &tree.nodes[index as usize];
        if !node.is_leaf() {
            stack.extend([node.first_index, node.first_index + 1]);
        }
    }
    order.reverse();
    order
}

fn solve(tree: &Bvh2, leaves: &dyn Leaves) -> Vec<Entry> {
    let empty = Entry {
        cost: [0.0; WIDTH - 1],
        choice: [Choice::Leaf; WIDTH - 1],
        primitives: 0,
    };
    let mut table = vec![empty; tree.nodes.len()];
    for index in children_first(tree) {
        let node = &tree.nodes[index as usize];
        let area = node.aabb().half_area();
        table[index as usize] = if node.is_leaf() {
            let members =
                &tree.primitive_indices[node.first_index as usize..][..node.prim_count as usize];
            let shared = members.iter().all(|&p| leaves.can_share(p));
            Entry {
                cost: [area * PACK_COST; WIDTH - 1],
                choice: [Choice::Leaf; WIDTH - 1],
                primitives: if shared {
                    node.prim_count.min(255) as u8
                } else {
                    u8::MAX
                },
            }
        } else {
            let first = node.first_index as usize;
            inner(area, &table[first], &table[first + 1])
        };
    }
    table
}

fn inner(area: f32, left: &Entry, right: &Entry) -> Entry {
    let split = |ways: usize| {
        let mut best = (f32::INFINITY, 1u8);
        for to_left in 1..ways {
            let to_right = ways - to_left;
            if to_left < WIDTH && to_right < WIDTH {
                let cost = left.cost[to_left - 1] + right.cost[to_right - 1];
                if cost < best.0 {
                    best = (cost, to_left as u8);
                }
            }
        }
        best
    };
    let primitives = left.primitives.saturating_add(right.primitives);
    let own = split(WIDTH);
    let mut entry = Entry {
        cost: [own.0 + area * NODE_COST; WIDTH - 1],
        choice: [Choice::Node(own.1); WIDTH - 1],
        primitives,
    };
    if primitives as usize <= PACK * LEAF_PACKS {
        let cost = area * PACK_COST * (primitives as usize).div_ceil(PACK) as f32;
        if cost <= entry.cost[0] {
            entry.cost[0] = cost;
            entry.choice[0] = Choice::Leaf;
        }
    }
    for ways in 2..WIDTH {
        let (cost, to_left) = split(ways);
        let better = cost < entry.cost[ways - 2];
        entry.cost[ways - 1] = if better { cost } else { entry.cost[ways - 2] };
        entry.choice[ways - 1] = if better {
            Choice::Split(to_left)
        } else {
            Choice::Fewer
        };
    }
    entry
}

struct Writer<'a> {
    tree: &'a Bvh2,
    table: &'a [Entry],
    nodes: &'a mut Vec<Node>,
    leaves: &'a mut dyn Leaves,
    members: Vec<u32>,
}

impl Writer<'_> {
    fn write(&mut self) -> (Link, usize) {
        let root = &self.table[0];
        let Choice::Node(to_left) = root.choice[0] else {
            return (self.root_leaf(), WIDTH);
        };
        let first = self.nodes.len();
        self.nodes.push(Node::EMPTY);
        let mut deepest = WIDTH;
        // (binary node, its left share, wide node, stack entries below it)
        let mut work = vec![(0u32, to_left, first, 0usize)];
        while let Some((binary, to_left, wide, entries)) = work.pop() {
            let children = self.children(binary, to_left);
            let entries = entries + children.len();
            deepest = deepest.max(entries);
            for (slot, (child, share)) in children.into_iter().enumerate() {
                let link = match share {
                    Some(share) => {
                        self.nodes.push(Node::EMPTY);
                        work.push((child, share, self.nodes.len() - 1, entries));
                        Link::node(self.nodes.len() - 1)
                    }
                    None => self.leaf(child),
                };
                let bounds = bounds_of(self.tree.nodes[child as usize].aabb());
                self.nodes[wide].set(slot, &bounds, link);
            }
        }
        (Link::node(first), deepest + 1)
    }

    /// A hierarchy that is one leaf still gets a node, so that a walk always starts at a node.
    fn root_leaf(&mut self) -> Link {
        let link = self.leaf(0);
        let mut node = Node::EMPTY;
        node.set(0, &bounds_of(self.tree.nodes[0].aabb()), link);
        self.nodes.push(node);
        Link::node(self.nodes.len() - 1)
    }

    /// The binary nodes that are children of a wide node; with a share if they are nodes too.
    fn children(&self, binary: u32, to_left: u8) -> Vec<(u32, Option<u8>)> {
        let mut children = Vec::with_capacity(WIDTH);
        let first = self.tree.nodes[binary as usize].first_index;
        let mut pending = vec![
            (first + 1, WIDTH - to_left as usize),
            (first, to_left as usize),
        ];
        while let Some((node, ways)) = pending.pop() {
            match self.table[node as usize].choice[ways - 1] {
                Choice::Leaf => children.push((node, None)),
                Choice::Node(share) => children.push((node, Some(share))),
                Choice::Fewer => pending.push((node, ways - 1)),
                Choice::Split(share) => {
                    let first = self.tree.nodes[node as usize].first_index;
                    pending.push((first + 1, ways - share as usize));
                    pending.push((first, share as usize));
                }
            }
        }
        // A walk that takes any hit visits the last child first and does not sort: small boxes
        // lead to triangles soonest (measured: the other way round is half as fast).
        let area = |node: u32| self.tree.nodes[node as usize].aabb().half_area();
        children.sort_by(|a, b| area(b.0).total_cmp(&area(a.0)));
        children
    }

    fn leaf(&mut self, binary: u32) -> Link {
        let mut members = std::mem::take(&mut self.members);
        members.clear();
        let mut stack = vec![binary];
        while let Some(index) = stack.pop() {
            let node = &self.tree.nodes[index as usize];
            if node.is_leaf() {
                let range =
                    node.first_index as usize..(node.first_index + node.prim_count) as usize;
                members.extend_from_slice(&self.tree.primitive_indices[range]);
            } else {
                stack.extend([node.first_index, node.first_index + 1]);
            }
        }
        let link = self.leaves.write(&members);
        self.members = members;
        link
    }
}
