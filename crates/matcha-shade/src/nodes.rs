//! Lowering: from a tree as its author drew it to a typed graph and a closure tree.
//!
//! One table, [`nodes`], gives every node type's lowering function; a family of
//! nodes is a file. Groups are inlined, muted nodes and reroutes are followed, sockets
//! are converted as Blender converts them. A node that cannot be honoured is reported
//! and replaced by a stated substitute.

mod bump;
mod cellular;
mod color;
mod coordinates;
mod error;
mod gltf;
mod image;
mod mapping;
mod noise;
mod number;
mod output;
mod pattern;
mod ramp;
mod shader;
mod socket;
mod spectrum;
mod surface;
mod table;
mod vector;
mod walk;

pub use error::{LowerError, Place};
pub use gltf::lower_gltf;
pub use table::{NodeEntry, nodes};

use crate::graph::{Graph, NodeId};
use crate::input::InputKind;
use crate::material::{ClosureTree, LowerReport, MaterialGraph, MaterialKind, Substitution};
use crate::source::{NodeTree, SourceNode};
use std::collections::{BTreeSet, HashMap};
use walk::{Frame, FrameId, Task, Wires};

/// The scene's names that inputs refer to by index.
#[derive(Clone, Copy, Debug)]
pub struct Names<'a> {
    /// UV maps; 0 is the active one.
    pub uv: &'a [String],
    /// Mesh attributes.
    pub attributes: &'a [String],
}

/// What an output socket holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Value {
    /// F1.
    Float(NodeId),
    /// F3.
    Vector(NodeId),
    /// F3.
    Color(NodeId),
    /// A closure.
    Shader(crate::material::ClosureId),
}

/// A node in a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct At {
    pub frame: FrameId,
    pub node: u32,
}

/// A tree being lowered.
pub(crate) struct Lowering<'a> {
    pub trees: &'a [NodeTree],
    pub names: Names<'a>,
    pub material: &'a str,
    pub kind: MaterialKind,
    pub graph: Graph,
    pub closures: ClosureTree,
    /// Normal of whatever names none: the surface's, bent by its displacement.
    pub normal: Option<NodeId>,
    /// While the output's displacement is lowered.
    pub in_displacement: bool,
    /// Whether a Displacement node was met then.
    pub has_displacement_node: bool,
    /// Whether its heights are in the object's unit.
    pub displacement_in_object_space: bool,
    frames: Vec<Frame>,
    children: HashMap<At, FrameId>,
    wires: HashMap<u32, Wires>,
    values: HashMap<Task, Value>,
    reported: BTreeSet<Substitution>,
}

type Lowered<T> = Result<T, LowerError>;

/// Lowers the tree with index `tree`, its groups taken from `trees`.
pub fn lower(
    trees: &[NodeTree],
    tree: u32,
    names: Names,
    material: &str,
    kind: MaterialKind,
) -> Result<(MaterialGraph, LowerReport), LowerError> {
    let mut lowering = Lowering {
        trees,
        names,
        material,
        kind,
        graph: Graph::new(),
        closures: ClosureTree::default(),
        normal: None,
        in_displacement: false,
        has_displacement_node: false,
        displacement_in_object_space: false,
        frames: Vec::new(),
        children: HashMap::new(),
        wires: HashMap::new(),
        values: HashMap::new(),
        reported: BTreeSet::new(),
    };
    lowering.run(tree)?;
    lowering.graph.release_held();
    let report = LowerReport {
        items: lowering.reported.into_iter().collect(),
    };
    let material = MaterialGraph {
        name: material.to_owned(),
        kind,
        graph: lowering.graph,
        closures: lowering.closures,
    };
    Ok((material, report))
}

impl<'a> Lowering<'a> {
    /// The source node.
    pub fn source(&self, at: At) -> &'a SourceNode {
        let tree = self.frames[at.frame.0 as usize].tree;
        &self.trees[tree as usize].nodes[at.node as usize]
    }

    /// Where a node is, for errors.
    pub fn place(&self, at: At) -> Place {
        Place {
            material: self.material.to_owned(),
            node: self.source(at).name.clone(),
        }
    }

    /// Notes that something of a node was not honoured, once for each kind and node.
    pub fn substitute(&mut self, at: At, kind: &str, substitute: &str) {
        let node = self.source(at).name.clone();
        self.reported.insert(Substitution {
            kind: kind.to_owned(),
            node,
            substitute: substitute.to_owned(),
        });
    }

    /// The normal of whatever names none.
    pub fn default_normal(&mut self) -> NodeId {
        match self.normal {
            Some(normal) => normal,
            None => self.graph.value(InputKind::Normal),
        }
    }
}

#[cfg(test)]
mod tests;
