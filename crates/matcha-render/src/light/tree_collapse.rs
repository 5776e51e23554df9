//! Turns the binary light tree into the wide one that is descended.

use super::tree::{Link, WIDTH};
use super::tree_build::{BinaryLink, BinaryNode};
use crate::device::light_view::LightNode;

/// Wide nodes, root first. A wide node opens its child with the largest power times area
/// until it is full: that is the child whose bounds say least about what is below.
pub fn collapse(binary: &[BinaryNode]) -> Vec<LightNode> {
    let mut nodes = vec![LightNode::empty()];
    // Wide node to fill, and the binary node that it stands for.
    let mut open = vec![(0usize, 0u32)];
    while let Some((index, from)) = open.pop() {
        let children = gather(binary, from);
        for (slot, &child) in children.iter().enumerate() {
            let node = &binary[child as usize];
            let link = match node.link {
                BinaryLink::Emitter(emitter) => Link::Emitter(emitter),
                BinaryLink::Children(_) => {
                    let next = nodes.len();
                    nodes.push(LightNode::empty());
                    open.push((next, child));
                    Link::Node(next as u32)
                }
            };
            nodes[index].set(slot, &node.bounds, link);
        }
    }
    nodes
}

/// Up to [`WIDTH`] descendants that together hold all that is below a node.
fn gather(binary: &[BinaryNode], from: u32) -> Vec<u32> {
    let mut children = vec![from];
    while children.len() < WIDTH {
        let inner = |&&child: &&u32| matches!(binary[child as usize].link, BinaryLink::Children(_));
        let weight = |child: u32| {
            let bounds = &binary[child as usize].bounds;
            let size = bounds.high - bounds.low;
            bounds.power * (size.x * size.y + size.y * size.z + size.z * size.x).max(1e-30)
        };
        let largest = children
            .iter()
            .filter(inner)
            .copied()
            .max_by(|&a, &b| weight(a).total_cmp(&weight(b)));
        let Some(largest) = largest else { break };
        if let BinaryLink::Children(first) = binary[largest as usize].link {
            children.retain(|&c| c != largest);
            children.extend([first, first + 1]);
        }
    }
    children
}
