//! `.blend` files: only Blender can read them, so Blender exports them, with the add-on
//! that is embedded here, into a `.glb` that is kept for the next time.

mod kept;
mod program;
mod run;

use crate::error::ImportError;
use crate::{LoadOptions, Progress};
use kept::Kept;
use std::path::{Path, PathBuf};

/// The add-on's files: path below `blender/`, content.
static EXPORTER: &[(&str, &[u8])] = include!(concat!(env!("OUT_DIR"), "/exporter_files.rs"));

/// An export, and what the exporter warned of.
pub(crate) struct Exported {
    pub glb: PathBuf,
    pub warnings: Vec<String>,
}

/// The `.glb` of a `.blend` file: the kept one if nothing has changed, otherwise a new one.
pub(crate) fn export(
    blend: &Path,
    options: &LoadOptions,
    progress: &mut dyn FnMut(Progress),
) -> Result<Exported, ImportError> {
    let kept = Kept::locate(blend, options.cache_dir.as_deref())?;
    if let Some(warnings) = kept.valid() {
        return Ok(Exported {
            glb: kept.glb,
            warnings,
        });
    }
    let program = program::find(blend, options.blender.as_deref())?;
    let fail = |reason: String| ImportError::Export {
        file: blend.to_owned(),
        program: program.path().to_owned(),
        reason,
    };
    let scripts = write_exporter()
        .map_err(|error| fail(format!("the exporter cannot be written: {error}")))?;
    let partial = kept.partial();
    match run::run(&program, blend, &partial, scripts.path(), progress) {
        Ok(told) => {
            kept.keep(&partial, &told)?;
            Ok(Exported {
                glb: kept.glb,
                warnings: told.warnings,
            })
        }
        Err(reason) => {
            // There may be none.
            let _ = std::fs::remove_file(&partial);
            Err(fail(reason))
        }
    }
}

fn write_exporter() -> std::io::Result<tempfile::TempDir> {
    let folder = tempfile::Builder::new()
        .prefix("matcha-exporter-")
        .tempdir()?;
    for (name, content) in EXPORTER {
        let path = folder.path().join(name);
        if let Some(parent) = path.parent() {
            std::fs::create_dir_all(parent)?;
        }
        std::fs::write(path, content)?;
    }
    Ok(folder)
}
