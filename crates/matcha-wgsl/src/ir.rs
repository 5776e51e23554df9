//! Device code between Rust and WGSL: names resolved, types inferred.

use crate::types::Ty;

/// Index of a local in its function.
pub(crate) type LocalId = usize;

/// A parameter or `let`.
pub(crate) struct Local {
    pub name: String,
    pub ty: Ty,
    /// It is assigned to, or its address is taken.
    pub variable: bool,
}

/// A function.
pub(crate) struct FunctionBody {
    pub name: String,
    pub line: usize,
    /// The first locals.
    pub parameters: usize,
    pub locals: Vec<Local>,
    pub result: Ty,
    pub body: Block,
}

/// Statements and perhaps a value.
pub(crate) struct Block {
    pub statements: Vec<Statement>,
    pub value: Option<Box<Expr>>,
}

pub(crate) struct Statement {
    pub line: usize,
    pub kind: StatementKind,
}

pub(crate) enum StatementKind {
    Let {
        local: LocalId,
        value: Option<Expr>,
    },
    Assign {
        place: Expr,
        operator: Option<&'static str>,
        value: Expr,
    },
    /// An `if`, or a block, without value, or a call that writes.
    Run(Expr),
    /// A loop; without a condition, `loop`.
    While {
        condition: Option<Expr>,
        body: Block,
    },
    Break,
    Continue,
    Return(Option<Expr>),
}

pub(crate) struct Expr {
    pub line: usize,
    pub ty: Ty,
    pub kind: ExprKind,
}

pub(crate) enum ExprKind {
    Float(f32),
    Integer {
        value: u32,
        hexadecimal: bool,
    },
    Bool(bool),
    Local(LocalId),
    Constant(String),
    Call {
        function: String,
        arguments: Vec<Expr>,
        /// It has a parameter that it writes through.
        writes: bool,
    },
    /// What a parameter refers to.
    Deref(LocalId),
    /// A reference to a local.
    Address(LocalId),
    /// Words of a view's field.
    Stored {
        view: String,
        field: String,
        address: WordAddress,
    },
    /// Elements of a view's field.
    Count {
        view: String,
        field: String,
    },
    /// A value of the type from its parts; no parts: zeros.
    Construct(Vec<Expr>),
    /// A value of an array type whose elements are one expression's value.
    Repeat(Box<Expr>),
    Unary(&'static str, Box<Expr>),
    Binary(&'static str, Box<Expr>, Box<Expr>),
    Field(Box<Expr>, String),
    Index(Box<Expr>, Box<Expr>),
    /// To the type.
    Cast(Box<Expr>),
    If {
        condition: Box<Expr>,
        then: Block,
        otherwise: Option<Block>,
    },
    Block(Block),
}

/// A word's index in a buffer: constant words, and multiples of computed indices.
pub(crate) struct WordAddress {
    pub offset: u32,
    pub terms: Vec<(Expr, u32)>,
}

impl Expr {
    /// The expressions that it is made from, without those in blocks.
    pub fn parts(&self) -> Vec<&Expr> {
        match &self.kind {
            ExprKind::Call { arguments, .. } | ExprKind::Construct(arguments) => {
                arguments.iter().collect()
            }
            ExprKind::Repeat(of)
            | ExprKind::Unary(_, of)
            | ExprKind::Field(of, _)
            | ExprKind::Cast(of) => vec![of],
            ExprKind::Binary(_, a, b) | ExprKind::Index(a, b) => vec![a, b],
            ExprKind::Stored { address, .. } => address.terms.iter().map(|(e, _)| e).collect(),
            ExprKind::If { condition, .. } => vec![condition],
            _ => Vec::new(),
        }
    }

    /// The blocks that it holds.
    pub fn blocks(&self) -> Vec<&Block> {
        match &self.kind {
            ExprKind::If {
                then, otherwise, ..
            } => [then].into_iter().chain(otherwise).collect(),
            ExprKind::Block(block) => vec![block],
            _ => Vec::new(),
        }
    }
}
