//! Device code between Rust and WGSL: names resolved, types inferred.

use crate::types::Ty;

/// Index of a local in its function.
pub(crate) type LocalId = usize;

/// A parameter or `let`.
pub(crate) struct Local {
    pub name: String,
    pub ty: Ty,
    pub mutable: bool,
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
    /// An `if`, or a block, without value.
    Run(Expr),
    /// A loop; without a condition, `loop`.
    While {
        condition: Option<Expr>,
        body: Block,
    },
    Break,
    Continue,
    Return(Expr),
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
