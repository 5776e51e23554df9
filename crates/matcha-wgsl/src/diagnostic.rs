//! What can be wrong, and where.

use std::fmt;

/// A place in a file.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// The file, as its [`Module`](crate::Module) names it.
    pub path: String,
    /// Line, from 1.
    pub line: usize,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}:{}", self.path, self.line)
    }
}

/// What is wrong at a place.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Problem {
    /// Not Rust.
    #[error("not Rust: {0}")]
    Syntax(String),
    /// A construct that device code does without.
    #[error("{what} is not device code: {instead}")]
    Outside {
        /// The construct.
        what: String,
        /// What to write instead.
        instead: &'static str,
    },
    /// A type that WGSL has no twin of.
    #[error(
        "type `{0}` is not device code: use f32, u32, i32, bool, Vec2, Vec3, a struct or an array of those"
    )]
    UnknownType(String),
    /// A call of something that is not a device function.
    #[error("`{0}` is no device function")]
    UnknownFunction(String),
    /// A name that is neither a local nor a device constant.
    #[error("`{0}` is no local and no device constant")]
    UnknownValue(String),
    /// A struct without that field.
    #[error("{ty} has no field `{field}`")]
    UnknownField {
        /// The type.
        ty: String,
        /// The field.
        field: String,
    },
    /// Two device items of one name.
    #[error("`{name}` is defined at {first} already: WGSL has one namespace")]
    Duplicate {
        /// The name.
        name: String,
        /// Where it is defined first.
        first: Place,
    },
    /// Types that do not go together.
    #[error("expected {expected}, found {found}")]
    Mismatch {
        /// Expected.
        expected: String,
        /// Found.
        found: String,
    },
    /// A call with too many or too few arguments.
    #[error("`{name}` takes {expected} arguments, found {found}")]
    Arguments {
        /// The function.
        name: String,
        /// How many it takes.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// A number that its type does not hold.
    #[error("`{0}` does not fit its type")]
    Number(String),
    /// A function that calls itself, or a struct or constant that contains itself.
    #[error("`{0}` needs itself, which WGSL forbids")]
    Cycle(String),
    /// A function of an `intrinsics` module that has no twin.
    #[error("`{0}` stands for an intrinsic of WGSL that the translator does not know")]
    UnknownIntrinsic(String),
    /// The table of operations does not read as one.
    #[error("table of operations: {0}")]
    Table(String),
    /// naga refuses the WGSL of this line.
    #[error("{message} (in the WGSL `{wgsl}`)")]
    Invalid {
        /// naga's words.
        message: String,
        /// The line of WGSL.
        wgsl: String,
    },
}

/// A problem and its place.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{place}: {problem}")]
pub struct Diagnostic {
    /// Where.
    pub place: Place,
    /// What.
    pub problem: Problem,
}

/// All that is wrong with some modules, in the order of their lines.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub struct TranslateError {
    /// At least one.
    pub diagnostics: Vec<Diagnostic>,
}

impl fmt::Display for TranslateError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for (i, diagnostic) in self.diagnostics.iter().enumerate() {
            let separator = if i == 0 { "" } else { "\n" };
            write!(f, "{separator}{diagnostic}")?;
        }
        Ok(())
    }
}

/// A problem at a line of the file at hand.
pub(crate) type Fault = (usize, Problem);

/// A construct outside of the subset.
pub(crate) fn outside(line: usize, what: impl Into<String>, instead: &'static str) -> Fault {
    let what = what.into();
    (line, Problem::Outside { what, instead })
}

/// Collects the faults of several items.
#[derive(Default)]
pub(crate) struct Faults(Vec<Diagnostic>);

impl Faults {
    /// Notes a fault in the file `path`.
    pub fn add(&mut self, path: &str, (line, problem): Fault) {
        let place = Place {
            path: path.to_owned(),
            line,
        };
        self.0.push(Diagnostic { place, problem });
    }

    /// The value of a result, or `None` with its fault noted.
    pub fn keep<T>(&mut self, path: &str, result: Result<T, Fault>) -> Option<T> {
        result.map_err(|fault| self.add(path, fault)).ok()
    }

    /// `value` if nothing was wrong.
    pub fn or<T>(mut self, value: T) -> Result<T, TranslateError> {
        if self.0.is_empty() {
            return Ok(value);
        }
        self.0.sort_by(|a, b| a.place.cmp(&b.place));
        Err(TranslateError {
            diagnostics: self.0,
        })
    }
}
