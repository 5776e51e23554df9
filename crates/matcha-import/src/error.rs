//! Errors: every one is one sentence that names the file and the place in it.

use crate::report::Report;
use std::path::PathBuf;

/// Why a scene could not be loaded.
#[derive(Debug, thiserror::Error)]
pub enum ImportError {
    /// The operating system refused.
    #[error("{}: cannot be read: {source}", file.display())]
    Read {
        /// The file.
        file: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// The file is not what it claims to be.
    #[error("{}: {place}: {problem}", file.display())]
    Invalid {
        /// The file.
        file: PathBuf,
        /// Where in the file, in the file's own terms.
        place: String,
        /// What is wrong there.
        problem: String,
    },
    /// Neither glTF nor Blender.
    #[error("{}: is neither glTF (.glb, .gltf) nor a Blender file (.blend)", file.display())]
    UnknownFormat {
        /// The file.
        file: PathBuf,
    },
    /// A `.blend` file, and nothing here that can open it.
    #[error(
        "{}: no Blender was found to export this file: install Blender 4.2 or newer from blender.org \
         (on PATH, or named with --blender), or run `pip install bpy`{detail}",
        file.display()
    )]
    NoBlender {
        /// The file.
        file: PathBuf,
        /// What was tried in vain, starting with a space and bracketed; may be empty.
        detail: String,
    },
    /// Blender ran, and the export failed.
    #[error("{}: the export by {} failed: {reason}", file.display(), program.display())]
    Export {
        /// The file.
        file: PathBuf,
        /// Blender, or a Python with `bpy`.
        program: PathBuf,
        /// The last thing that it said.
        reason: String,
    },
    /// The result of an export cannot be kept.
    #[error("{}: cannot be written: {source}", file.display())]
    Write {
        /// The file.
        file: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// `strict` was asked for, and something was substituted.
    #[error(
        "{}: not everything is supported, and strict was asked for: {}",
        file.display(),
        lost.in_a_sentence()
    )]
    Strict {
        /// The file.
        file: PathBuf,
        /// What was substituted.
        lost: Report,
    },
}

/// An error inside a file, before the file's name is known.
#[derive(Clone, Debug)]
pub(crate) struct Fault {
    pub place: String,
    pub problem: String,
}

impl Fault {
    pub fn new(place: impl Into<String>, problem: impl Into<String>) -> Self {
        Self {
            place: place.into(),
            problem: problem.into(),
        }
    }

    pub fn in_file(self, file: &std::path::Path) -> ImportError {
        ImportError::Invalid {
            file: file.to_owned(),
            place: self.place,
            problem: self.problem,
        }
    }
}

pub(crate) type Checked<T> = Result<T, Fault>;
