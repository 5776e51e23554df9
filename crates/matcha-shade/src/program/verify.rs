//! What a program must satisfy before a machine may run it without checks.

/// Why a material has no program.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ProgramError {
    /// It does not fit into a word's fields.
    #[error("the material needs {count} {what}, more than the {limit} that a program can have")]
    TooLarge {
        /// Of what.
        what: &'static str,
        /// How many.
        count: usize,
        /// At most.
        limit: usize,
    },
    /// A word is wrong: a mistake in the compiler.
    #[error("word {word}: {problem}")]
    Invalid {
        /// Its position.
        word: usize,
        /// What is wrong.
        problem: String,
    },
}
