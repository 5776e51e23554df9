//! Types of device code, and their inference.

use crate::diagnostic::{Fault, Problem};
use crate::names::escaped;

/// A type of device code.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ty {
    /// f32.
    F32,
    /// i32.
    I32,
    /// u32.
    U32,
    /// bool.
    Bool,
    /// glam's `Vec2`.
    Vec2,
    /// glam's `Vec3`.
    Vec3,
    /// `[T; N]`.
    Array(Box<Ty>, usize),
    /// A struct of device code.
    Struct(String),
    /// A reference to a local of the caller; of parameters only.
    Reference {
        /// What it refers to.
        of: Box<Ty>,
        /// `&mut`.
        mutable: bool,
    },
    /// A view on buffers; of parameters only, and without a parameter in WGSL.
    View(String),
    /// Nothing: the type of statements.
    Unit,
    /// Of what does not go on.
    Never,
    /// Not known yet; never in a finished signature.
    Unknown(usize),
}

impl Ty {
    /// Its name in WGSL.
    pub fn wgsl(&self) -> String {
        match self {
            Ty::F32 => "f32".to_owned(),
            Ty::I32 => "i32".to_owned(),
            Ty::U32 => "u32".to_owned(),
            Ty::Bool => "bool".to_owned(),
            Ty::Vec2 => "vec2f".to_owned(),
            Ty::Vec3 => "vec3f".to_owned(),
            Ty::Array(of, length) => format!("array<{}, {length}>", of.wgsl()),
            Ty::Struct(name) => escaped(name),
            Ty::Reference { of, .. } => format!("ptr<function, {}>", of.wgsl()),
            Ty::View(_) | Ty::Unit | Ty::Never | Ty::Unknown(_) => "nothing".to_owned(),
        }
    }

    /// Its name in Rust, for messages.
    pub fn rust(&self) -> String {
        match self {
            Ty::Vec2 => "Vec2".to_owned(),
            Ty::Vec3 => "Vec3".to_owned(),
            Ty::Array(of, length) => format!("[{}; {length}]", of.rust()),
            Ty::Struct(name) | Ty::View(name) => name.clone(),
            Ty::Reference { of, mutable: true } => format!("&mut {}", of.rust()),
            Ty::Reference { of, .. } => format!("&{}", of.rust()),
            Ty::Unit | Ty::Never => "()".to_owned(),
            Ty::Unknown(_) => "an integer".to_owned(),
            _ => self.wgsl(),
        }
    }

    /// True for `Vec2` and `Vec3`.
    pub fn is_vector(&self) -> bool {
        matches!(self, Ty::Vec2 | Ty::Vec3)
    }
}

/// A type that is not known yet.
struct Slot {
    bound: Option<Ty>,
    /// It came from a literal without suffix.
    integer: bool,
}

/// Types that follow from use, as Rust infers them.
#[derive(Default)]
pub(crate) struct Inference(Vec<Slot>);

impl Inference {
    /// The type of an integer literal.
    pub fn integer(&mut self) -> Ty {
        self.slot(true)
    }

    /// The type of a `let` without value.
    pub fn any(&mut self) -> Ty {
        self.slot(false)
    }

    fn slot(&mut self, integer: bool) -> Ty {
        self.0.push(Slot {
            bound: None,
            integer,
        });
        Ty::Unknown(self.0.len() - 1)
    }

    /// What is known of a type.
    pub fn known(&self, ty: &Ty) -> Ty {
        match ty {
            Ty::Unknown(slot) => match &self.0[*slot].bound {
                Some(bound) => self.known(bound),
                None => ty.clone(),
            },
            Ty::Array(of, length) => Ty::Array(Box::new(self.known(of)), *length),
            _ => ty.clone(),
        }
    }

    /// The type at the end: integers that nothing else said are i32.
    pub fn settled(&self, ty: &Ty) -> Ty {
        match self.known(ty) {
            Ty::Unknown(_) => Ty::I32,
            Ty::Array(of, length) => Ty::Array(Box::new(self.settled(&of)), length),
            known => known,
        }
    }

    /// Makes two types one. What does not go on has every type.
    pub fn unify(&mut self, line: usize, expected: &Ty, found: &Ty) -> Result<(), Fault> {
        match (self.known(expected), self.known(found)) {
            (Ty::Never, _) | (_, Ty::Never) => Ok(()),
            (Ty::Unknown(a), Ty::Unknown(b)) if a == b => Ok(()),
            (Ty::Unknown(a), Ty::Unknown(b)) => {
                self.0[b].integer |= self.0[a].integer;
                self.0[a].bound = Some(Ty::Unknown(b));
                Ok(())
            }
            (Ty::Unknown(slot), ty) | (ty, Ty::Unknown(slot)) => {
                if self.0[slot].integer && !matches!(ty, Ty::I32 | Ty::U32) {
                    return Err(self.mismatch(line, expected, found));
                }
                self.0[slot].bound = Some(ty);
                Ok(())
            }
            (Ty::Array(a, n), Ty::Array(b, m)) if n == m => self.unify(line, &a, &b),
            (a, b) if a == b => Ok(()),
            _ => Err(self.mismatch(line, expected, found)),
        }
    }

    fn mismatch(&self, line: usize, expected: &Ty, found: &Ty) -> Fault {
        let problem = Problem::Mismatch {
            expected: self.known(expected).rust(),
            found: self.known(found).rust(),
        };
        (line, problem)
    }
}
