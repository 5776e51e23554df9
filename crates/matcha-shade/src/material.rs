//! A lowered material: values, the tree of closures over them, and what could not be
//! honoured.

use crate::closure::ClosureKind;
use crate::graph::{Graph, NodeId, Span};

/// Handle of a node in its [`ClosureTree`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ClosureId(pub u32);

/// A node of the closure tree. Weights and factors are values of the graph.
#[derive(Clone, Debug, PartialEq)]
pub enum ClosureNode {
    /// A closure with its own weight (F3: colour times strength) and the parameters
    /// of [`ClosureKind::parameters`], in that order.
    Leaf {
        /// Which.
        kind: ClosureKind,
        /// F3.
        weight: NodeId,
        /// Typed as the kind says.
        params: Vec<NodeId>,
        /// Where it comes from.
        span: Span,
    },
    /// `a` where `fac` (F1, clamped to [0, 1]) is 0, `b` where it is 1.
    Mix {
        /// F1.
        fac: NodeId,
        /// Weight 1 − fac.
        a: ClosureId,
        /// Weight fac.
        b: ClosureId,
    },
    /// Both.
    Add(ClosureId, ClosureId),
    /// Nothing: black, opaque.
    None,
}

/// Closures in an arena; children come before their parents and may be shared.
#[derive(Clone, Debug, Default)]
pub struct ClosureTree {
    nodes: Vec<ClosureNode>,
    /// What the material returns.
    pub root: Option<ClosureId>,
}

impl ClosureTree {
    /// The nodes, children first.
    pub fn nodes(&self) -> &[ClosureNode] {
        &self.nodes
    }

    /// A leaf; the colour that ends some kinds' parameters is added here from `weight`.
    /// Panics on parameters of the wrong type, a mistake in the lowering code.
    pub fn leaf(
        &mut self,
        graph: &Graph,
        kind: ClosureKind,
        weight: NodeId,
        mut params: Vec<NodeId>,
        span: Span,
    ) -> ClosureId {
        if kind.carries_color() {
            params.push(weight);
        }
        let wanted: Vec<_> = kind.parameters().iter().map(|p| p.ty).collect();
        let given: Vec<_> = params.iter().map(|&p| graph.ty(p)).collect();
        assert_eq!(wanted, given, "parameters of {kind:?}");
        assert_eq!(graph.ty(weight).width(), 3, "weight of {kind:?}");
        self.push(ClosureNode::Leaf {
            kind,
            weight,
            params,
            span,
        })
    }

    /// A mix; `fac` is F1 and is clamped when the tree is flattened.
    pub fn mix(&mut self, graph: &Graph, fac: NodeId, a: ClosureId, b: ClosureId) -> ClosureId {
        assert_eq!(graph.ty(fac).width(), 1, "factor of a mix");
        self.push(ClosureNode::Mix { fac, a, b })
    }

    /// A sum.
    pub fn add(&mut self, a: ClosureId, b: ClosureId) -> ClosureId {
        self.push(ClosureNode::Add(a, b))
    }

    /// Nothing.
    pub fn none(&mut self) -> ClosureId {
        self.push(ClosureNode::None)
    }

    fn push(&mut self, node: ClosureNode) -> ClosureId {
        self.nodes.push(node);
        ClosureId(self.nodes.len() as u32 - 1)
    }
}

/// What a node tree belongs to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum MaterialKind {
    /// A surface's material.
    #[default]
    Surface,
    /// The world: closures are `Background`.
    World,
    /// A light: closures are `Emission`.
    Light,
}

/// A tree of nodes, lowered.
#[derive(Clone, Debug, Default)]
pub struct MaterialGraph {
    /// The material's name.
    pub name: String,
    /// What it belongs to.
    pub kind: MaterialKind,
    /// The values.
    pub graph: Graph,
    /// What is made of them.
    pub closures: ClosureTree,
}

/// Something that was not honoured, and what was done instead.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Substitution {
    /// The node's type, Blender's `bl_idname`, or the feature's name.
    pub kind: String,
    /// The node's name as the user sees it.
    pub node: String,
    /// What is rendered instead, as a sentence's end ("a constant grey").
    pub substitute: String,
}

/// What lowering could not honour.
#[derive(Clone, Debug, Default)]
pub struct LowerReport {
    /// In order of the nodes.
    pub items: Vec<Substitution>,
}
