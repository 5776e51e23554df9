//! The typed graph: pure values of one shading point, in an arena.
//!
//! A node refers only to nodes made before it, so the order of the arena is an order
//! of evaluation and a cycle cannot be written down.

use crate::closure::Ty;
use crate::input::{Input, InputKind, Part};
use crate::ops::OpCode;
use crate::source::Extension;

/// Handle of a node in its [`Graph`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NodeId(pub u32);

impl NodeId {
    /// Position in the arena.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// The node of a source tree that a value comes from, for messages and drawings.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Span {
    /// Index of the tree (the material's own or a group's).
    pub tree: u32,
    /// Position of the node in that tree.
    pub node: u32,
}

/// What a value means, which decides how the cache packs it into 32 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Encoding {
    /// Non-negative linear colour, any brightness (3 components).
    Color,
    /// One number of any sign (1).
    Scalar,
    /// Numbers of any sign and size (2 or 3).
    Vector,
    /// A unit vector (3).
    Normal,
    /// Change of a height with u and with v (2).
    Gradient,
}

/// How an image is filtered.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Interpolation {
    /// The nearest pixel.
    Closest,
    /// Bilinear.
    Linear,
    /// Bicubic.
    Cubic,
    /// Bicubic when magnified, bilinear otherwise.
    Smart,
}

/// What an image's alpha does to the colour that a look-up returns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum AlphaHandling {
    /// Colour as stored: premultiplied by alpha.
    Associated,
    /// Colour divided by alpha, as Cycles' Image Texture does when its alpha is used.
    Unassociated,
    /// Alpha is one everywhere.
    Ignored,
}

/// An image look-up's fixed settings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TextureRef {
    /// Index into the scene's images.
    pub image: u32,
    /// Filter.
    pub interpolation: Interpolation,
    /// Outside of the image.
    pub extension: Extension,
    /// Treatment of alpha.
    pub alpha: AlphaHandling,
    /// True for an environment map in mirror-ball projection and the like, where a
    /// look-up is a direction's and has no footprint.
    pub no_footprint: bool,
}

/// A table of 2 or more samples over [0, 1], for ramps and curves.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// One row of samples a component (1 to 4 rows, all of one length).
    pub rows: Vec<Vec<f32>>,
    /// Linear between samples; otherwise the sample at or below.
    pub interpolate: bool,
    /// Outside of [0, 1]: the slope at the border goes on; otherwise the border's value.
    pub extrapolate: bool,
}

/// Index of a [`Table`] in its graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TableId(pub u32);

/// What a node computes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NodeKind {
    /// A constant; components past the type's width are zero.
    Const([f32; 4]),
    /// A quantity of the shading point.
    Input(Input),
    /// An operation of the table, with its immediate (0 where it takes none).
    Apply(OpCode, u32),
    /// Components of the input, from this one on, as many as the node's type has.
    Extract(u8),
    /// The inputs' components one after the other.
    Combine,
    /// An image: inputs are uv (F2), its change along both footprint axes (F2, F2); F4.
    Texture(TextureRef),
    /// A table look-up: input F1, result as many components as the table has rows.
    Table(TableId),
}

/// A value.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// What it computes.
    pub kind: NodeKind,
    /// From what, all made before it.
    pub inputs: Vec<NodeId>,
    /// Its type.
    pub ty: Ty,
    /// Where it comes from.
    pub span: Span,
    /// What the author means by it, where that is known.
    pub encoding: Option<Encoding>,
}

/// Arena of values.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    nodes: Vec<Node>,
    tables: Vec<Table>,
    span: Span,
}

/// The type of `width` components.
///
/// # Panics
/// If `width` is not 1 to 4.
pub fn type_of_width(width: usize) -> Ty {
    match width {
        1 => Ty::F1,
        2 => Ty::F2,
        3 => Ty::F3,
        4 => Ty::F4,
        _ => panic!("a value has 1 to 4 components, not {width}"),
    }
}

/// Builder. The methods panic on operands of the wrong type: that is a mistake in the
/// code that lowers, never in a file.
impl Graph {
    /// An empty graph.
    pub fn new() -> Self {
        Self::default()
    }

    /// Nodes made from now on come from `span`.
    pub fn set_span(&mut self, span: Span) {
        self.span = span;
    }

    /// The nodes in order of evaluation.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// The tables.
    pub fn tables(&self) -> &[Table] {
        &self.tables
    }

    /// One node.
    pub fn node(&self, id: NodeId) -> &Node {
        &self.nodes[id.index()]
    }

    /// A node's type.
    pub fn ty(&self, id: NodeId) -> Ty {
        self.node(id).ty
    }

    /// The value of a constant node.
    pub fn constant_value(&self, id: NodeId) -> Option<[f32; 4]> {
        match self.node(id).kind {
            NodeKind::Const(value) => Some(value),
            _ => None,
        }
    }

    /// Every handle, in order of evaluation.
    pub fn ids(&self) -> impl DoubleEndedIterator<Item = NodeId> + use<> {
        (0..self.nodes.len() as u32).map(NodeId)
    }

    /// A constant of any type.
    pub fn constant(&mut self, ty: Ty, mut value: [f32; 4]) -> NodeId {
        value[ty.width()..].fill(0.0);
        self.push(NodeKind::Const(value), &[], ty)
    }

    /// A constant number.
    pub fn f1(&mut self, x: f32) -> NodeId {
        self.constant(Ty::F1, [x, 0.0, 0.0, 0.0])
    }

    /// A constant pair.
    pub fn f2(&mut self, [x, y]: [f32; 2]) -> NodeId {
        self.constant(Ty::F2, [x, y, 0.0, 0.0])
    }

    /// A constant vector or colour.
    pub fn f3(&mut self, [x, y, z]: [f32; 3]) -> NodeId {
        self.constant(Ty::F3, [x, y, z, 0.0])
    }

    /// A quantity of the shading point.
    pub fn input(&mut self, kind: InputKind, part: Part) -> NodeId {
        let ty = type_of_width(kind.width());
        self.push(NodeKind::Input(Input { kind, part }), &[], ty)
    }

    /// A quantity's value at the hit.
    pub fn value(&mut self, kind: InputKind) -> NodeId {
        self.input(kind, Part::Value)
    }

    /// An operation without immediate.
    pub fn apply(&mut self, op: OpCode, inputs: &[NodeId]) -> NodeId {
        self.apply_aux(op, 0, inputs)
    }

    /// An operation with its immediate.
    pub fn apply_aux(&mut self, op: OpCode, aux: u32, inputs: &[NodeId]) -> NodeId {
        let info = op.info();
        let wanted: Vec<Ty> = info.operands().map(|a| a.ty).collect();
        let given: Vec<Ty> = inputs.iter().map(|&i| self.ty(i)).collect();
        assert_eq!(wanted, given, "operands of {}", info.name);
        self.push(NodeKind::Apply(op, aux), inputs, info.result)
    }

    /// `ty`'s width of components from `first` on. Free: an alias of the same slots.
    pub fn extract(&mut self, value: NodeId, first: usize, ty: Ty) -> NodeId {
        let from = self.ty(value);
        assert!(
            first + ty.width() <= from.width(),
            "{ty:?} at {first} of {from:?}"
        );
        if first == 0 && ty == from {
            return value;
        }
        self.push(NodeKind::Extract(first as u8), &[value], ty)
    }

    /// One component as a number.
    pub fn component(&mut self, value: NodeId, index: usize) -> NodeId {
        self.extract(value, index, Ty::F1)
    }

    /// Components put together; the parts' widths add up to 1 to 4. Free where the
    /// reader is an operation.
    pub fn combine(&mut self, parts: &[NodeId]) -> NodeId {
        if let [one] = parts {
            return *one;
        }
        let width = parts.iter().map(|&p| self.ty(p).width()).sum();
        self.push(NodeKind::Combine, parts, type_of_width(width))
    }

    /// An image look-up (F4: colour, alpha). `da` and `db` are the changes of `uv`
    /// along the footprint's two axes.
    pub fn texture(&mut self, texture: TextureRef, uv: NodeId, da: NodeId, db: NodeId) -> NodeId {
        for id in [uv, da, db] {
            assert_eq!(self.ty(id), Ty::F2, "operands of a texture");
        }
        self.push(NodeKind::Texture(texture), &[uv, da, db], Ty::F4)
    }

    /// Adds a table; an equal one is found again.
    pub fn table(&mut self, table: Table) -> TableId {
        let lengths: Vec<usize> = table.rows.iter().map(Vec::len).collect();
        assert!(
            !lengths.is_empty() && lengths.len() <= 4,
            "a table has 1 to 4 rows"
        );
        assert!(
            lengths.iter().all(|&n| n == lengths[0] && n >= 2),
            "rows of one length, 2 or more"
        );
        let at = self.tables.iter().position(|t| *t == table);
        TableId(at.unwrap_or_else(|| {
            self.tables.push(table);
            self.tables.len() - 1
        }) as u32)
    }

    /// A table look-up at `x` (F1; 0 is the first sample, 1 the last).
    pub fn look_up(&mut self, table: TableId, x: NodeId) -> NodeId {
        assert_eq!(self.ty(x), Ty::F1, "operand of a table");
        let width = self.tables[table.0 as usize].rows.len();
        self.push(NodeKind::Table(table), &[x], type_of_width(width))
    }

    /// Says what a value means (a colour socket's, a normal, …), so that the cache
    /// packs it well. Returns the same node.
    pub fn means(&mut self, id: NodeId, encoding: Encoding) -> NodeId {
        self.nodes[id.index()].encoding = Some(encoding);
        id
    }

    /// A copy of `root`'s sub-graph in which every quantity that changes over the
    /// footprint is moved by `scale` times its change along `axis`
    /// ([`Part::AxisA`] or [`Part::AxisB`]). Nodes that do not change are shared.
    pub fn shifted(&mut self, root: NodeId, axis: Part, scale: f32) -> NodeId {
        crate::shifted::shifted(self, root, axis, scale)
    }

    /// A graph with the same tables and no nodes.
    pub(crate) fn without_nodes(&self) -> Graph {
        Graph {
            nodes: Vec::new(),
            tables: self.tables.clone(),
            span: self.span,
        }
    }

    /// Makes operations that were held while sub-graphs were copied plain ones, so that
    /// they are found to be equal to others.
    pub(crate) fn release_held(&mut self) {
        for node in &mut self.nodes {
            if let NodeKind::Apply(_, aux) = &mut node.kind {
                *aux &= !crate::shifted::HELD;
            }
        }
    }

    /// Appends a node as it is; used by passes that rebuild a graph.
    pub(crate) fn push_node(&mut self, node: Node) -> NodeId {
        debug_assert!(node.inputs.iter().all(|i| i.index() < self.nodes.len()));
        self.nodes.push(node);
        NodeId(self.nodes.len() as u32 - 1)
    }

    pub(crate) fn span(&self) -> Span {
        self.span
    }

    fn push(&mut self, kind: NodeKind, inputs: &[NodeId], ty: Ty) -> NodeId {
        self.push_node(Node {
            kind,
            inputs: inputs.to_vec(),
            ty,
            span: self.span,
            encoding: None,
        })
    }
}
