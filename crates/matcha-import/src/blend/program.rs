//! Finding a Blender.

use crate::error::ImportError;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Something that can run the exporter.
#[derive(Debug, PartialEq)]
pub(super) enum Program {
    /// The application.
    Blender(PathBuf),
    /// A Python with the module `bpy`.
    Python(PathBuf),
}

impl Program {
    pub fn path(&self) -> &Path {
        match self {
            Self::Blender(path) | Self::Python(path) => path,
        }
    }
}

/// `chosen`, or `blender` on PATH, or a Python that can import `bpy`.
pub(super) fn find(blend: &Path, chosen: Option<&Path>) -> Result<Program, ImportError> {
    let none = |detail: String| ImportError::NoBlender {
        file: blend.to_owned(),
        detail,
    };
    if let Some(chosen) = chosen {
        let is_python = chosen
            .file_name()
            .is_some_and(|name| name.to_string_lossy().starts_with("python"));
        let program: fn(PathBuf) -> Program = if is_python {
            Program::Python
        } else {
            Program::Blender
        };
        let runs = if is_python {
            has_bpy(chosen)
        } else {
            answers(chosen, &["--version"])
        };
        return match runs {
            true => Ok(program(chosen.to_owned())),
            false => Err(none(format!(
                " ({} does not run, or has no bpy)",
                chosen.display()
            ))),
        };
    }
    if let Some(blender) = on_path("blender") {
        return Ok(Program::Blender(blender));
    }
    let named = std::env::var_os("MATCHA_PYTHON")
        .filter(|value| !value.is_empty())
        .map(PathBuf::from);
    let on_path = ["python3", "python"].into_iter().filter_map(on_path);
    let mut pythons = named.into_iter().chain(on_path);
    pythons
        .find(|python| has_bpy(python))
        .map(Program::Python)
        .ok_or_else(|| none(String::new()))
}

fn on_path(name: &str) -> Option<PathBuf> {
    let folders = std::env::var_os("PATH")?;
    let name = format!("{name}{}", std::env::consts::EXE_SUFFIX);
    std::env::split_paths(&folders)
        .map(|folder| folder.join(&name))
        .find(|path| path.is_file())
}

fn has_bpy(python: &Path) -> bool {
    answers(python, &["-c", "import bpy"])
}

fn answers(program: &Path, arguments: &[&str]) -> bool {
    let mut command = Command::new(program);
    command
        .args(arguments)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    command.status().is_ok_and(|status| status.success())
}
