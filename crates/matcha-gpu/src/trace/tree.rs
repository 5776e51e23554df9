//! From the processor's hierarchy to the device's.

use super::grid::Grid;
use super::node::{NODE_QUADS, PlacedNode, TRIANGLE_QUADS, WideNode, WideTriangle};
use super::slots::slots;
use matcha_render::accel::{Accel, Bounds, Link, PACK, Tree, WIDTH};
use std::collections::HashMap;

/// Entries of the stack of a walk, for which kernels are compiled; one of these is enough for
/// nearly every scene, so that kernels are the same for all of them.
const STACKS: [u32; 4] = [32, 64, 128, 512];

/// Why a hierarchy cannot be walked on the device.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TraceError {
    /// More levels than the longest stack holds.
    #[error(
        "the scene's hierarchy has {levels} levels, but the device walks at most {most}: render with --device cpu"
    )]
    TooDeep {
        /// Levels.
        levels: u32,
        /// Most levels.
        most: u32,
    },
    /// More instances than hits can tell apart.
    #[error(
        "the scene has {instances} instances, but the device's acceleration structures hold {most}: render without \
         --ray-queries"
    )]
    TooManyInstances {
        /// Instances.
        instances: usize,
        /// Most instances.
        most: u32,
    },
    /// A mesh of more than a structure holds.
    #[error(
        "mesh {mesh:?} has {elements} triangles or vertices, but an acceleration structure of the device holds \
         {most}: render without --ray-queries"
    )]
    MeshTooLarge {
        /// The mesh.
        mesh: String,
        /// Triangles or vertices, whichever are more.
        elements: usize,
        /// Most of them.
        most: u32,
    },
    /// More than can be addressed.
    #[error(
        "the scene has too many triangles for the device ({bytes} bytes of hierarchy): render with --device cpu"
    )]
    TooLarge {
        /// Size of the hierarchy, bytes.
        bytes: u64,
    },
}

/// A hierarchy for the device.
#[derive(Clone, Debug)]
pub struct WideTree {
    /// Nodes; a walk begins with the first.
    pub nodes: Vec<WideNode>,
    /// Triangles.
    pub triangles: Vec<WideTriangle>,
    /// Most levels that a walk is in at once, both hierarchies together.
    pub levels: u32,
}

impl WideTree {
    /// The device's form of a structure, with the visibility that its instances have now.
    pub fn new(accel: &Accel) -> Result<WideTree, TraceError> {
        let tree = accel.tree();
        let mut builder = Builder {
            tree,
            nodes: vec![WideNode::EMPTY],
            triangles: Vec::new(),
            roots: HashMap::new(),
        };
        let mut levels = 0;
        for placement in tree.placements {
            if !builder.roots.contains_key(&placement.root.0) {
                let at = builder.reserve(1);
                builder.roots.insert(placement.root.0, at);
                levels = levels.max(builder.convert(placement.root, at));
            }
        }
        if !tree.nodes.is_empty() {
            levels += builder.convert(tree.root, 0);
        }
        let wide = WideTree {
            nodes: builder.nodes,
            triangles: builder.triangles,
            levels,
        };
        wide.fits()
    }

    pub(super) fn fits(self) -> Result<WideTree, TraceError> {
        let most = STACKS[STACKS.len() - 1];
        if self.levels > most {
            let levels = self.levels;
            return Err(TraceError::TooDeep { levels, most });
        }
        let quads = (self.nodes.len() * NODE_QUADS).max(self.triangles.len() * TRIANGLE_QUADS);
        if quads > u32::MAX as usize {
            let bytes = self.bytes();
            return Err(TraceError::TooLarge { bytes });
        }
        Ok(self)
    }

    /// Entries of the stack that kernels are to be compiled for (`TRACE_STACK` in
    /// `traverse_walk.wgsl`): a walk leaves at most one entry a level.
    pub fn stack(&self) -> u32 {
        let enough = STACKS.into_iter().find(|&stack| stack >= self.levels);
        enough.unwrap_or(self.levels)
    }

    /// Memory of the structure, bytes.
    pub fn bytes(&self) -> u64 {
        (size_of_val(&self.nodes[..]) + size_of_val(&self.triangles[..])) as u64
    }
}

/// The structure while it grows.
struct Builder<'a> {
    tree: Tree<'a>,
    nodes: Vec<WideNode>,
    triangles: Vec<WideTriangle>,
    /// The device's node for the root of a placed mesh.
    roots: HashMap<u32, u32>,
}

impl Builder<'_> {
    /// Room for so many nodes; returns the first's index.
    fn reserve(&mut self, count: usize) -> u32 {
        let first = self.nodes.len() as u32;
        self.nodes.resize(self.nodes.len() + count, WideNode::EMPTY);
        first
    }

    /// Converts what is below a node of the processor's to the node `at`; returns the number of
    /// levels.
    fn convert(&mut self, root: Link, at: u32) -> u32 {
        let mut deepest = 0;
        let mut work = vec![(root, at, 1)];
        while let Some((link, at, level)) = work.pop() {
            deepest = deepest.max(level);
            if link.is_instance() {
                self.nodes[at as usize] = self.placed(link.index());
                continue;
            }
            let (node, below) = self.node(link.index());
            self.nodes[at as usize] = node;
            let places = (node.children..).zip(below);
            work.extend(places.map(|(at, link)| (link, at, level + 1)));
        }
        deepest
    }

    fn placed(&self, index: usize) -> WideNode {
        let placement = &self.tree.placements[index];
        let mask = self.tree.masks[placement.instance as usize];
        let root = self.roots[&placement.root.0];
        bytemuck::cast(PlacedNode::new(placement, root, mask))
    }

    /// A node with its leaves, and what shall be the nodes below it.
    fn node(&mut self, index: usize) -> (WideNode, Vec<Link>) {
        let source = &self.tree.nodes[index];
        let used: Vec<usize> = (0..WIDTH)
            .filter(|&child| source.children[child] != Link::EMPTY)
            .collect();
        let boxes: Vec<Bounds> = used.iter().map(|&c| source.child_bounds(c)).collect();
        let mut whole = Bounds::EMPTY;
        for bounds in &boxes {
            whole.grow(bounds.min);
            whole.grow(bounds.max);
        }
        let grid = Grid::over(&whole);
        let mut node = WideNode::over(&grid);
        node.triangles = self.triangles.len() as u32;
        let mut order: Vec<(usize, usize)> = slots(&boxes).into_iter().zip(0..).collect();
        order.sort_unstable();
        let mut below = Vec::with_capacity(used.len());
        for (slot, child) in order {
            let link = source.children[used[child]];
            node.set_box(slot, &grid, &boxes[child]);
            if link.is_leaf() {
                node.set_leaf(slot, self.leaf(link));
            } else {
                node.set_node(slot);
                below.push(link);
            }
        }
        node.children = self.reserve(below.len());
        (node, below)
    }

    /// Appends a leaf's triangles; returns how many there are.
    fn leaf(&mut self, link: Link) -> usize {
        let packs = &self.tree.packs[link.index()..][..link.packs()];
        let before = self.triangles.len();
        for pack in packs {
            let used = (0..PACK).filter(|&lane| pack.primitive[lane] != u32::MAX);
            let masks = self.tree.masks;
            let triangles = used.map(|lane| WideTriangle::new(pack, lane, masks));
            self.triangles.extend(triangles);
        }
        self.triangles.len() - before
    }
}
