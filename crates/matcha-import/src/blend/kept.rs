//! Exports that are kept. The name holds a hash of the `.blend`'s content and of the
//! exporter; a small JSON beside it lists the other files that went in (textures,
//! libraries) with size and time, so that a changed texture is exported again, and what
//! the exporter warned of.

use super::EXPORTER;
use super::run::Told;
use crate::cache_folder::{first_writable, user_cache_folder};
use crate::error::ImportError;
use serde::{Deserialize, Serialize};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::UNIX_EPOCH;

/// The place of a scene's export.
pub(super) struct Kept {
    pub glb: PathBuf,
    notes: PathBuf,
    /// Beginning of the names of all exports of this scene, also of its older versions.
    prefix: String,
}

/// What is kept beside an export.
#[derive(Serialize, Deserialize)]
struct Notes {
    sources: Vec<SourceFile>,
    warnings: Vec<String>,
}

/// A file that went into an export.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
struct SourceFile {
    path: PathBuf,
    /// Bytes; none where the file did not exist.
    size: Option<u64>,
    /// Nanoseconds since 1970.
    modified: u64,
}

impl SourceFile {
    fn of(path: PathBuf) -> Self {
        let meta = fs::metadata(&path).ok();
        let modified = meta
            .as_ref()
            .and_then(|m| m.modified().ok())
            .and_then(|t| t.duration_since(UNIX_EPOCH).ok());
        Self {
            path,
            size: meta.map(|m| m.len()),
            modified: modified.map_or(0, |age| age.as_nanos() as u64),
        }
    }
}

impl Kept {
    /// Hashes the scene and names its export; the folder exists afterwards.
    pub fn locate(blend: &Path, chosen: Option<&Path>) -> Result<Self, ImportError> {
        let read = |source| ImportError::Read {
            file: blend.to_owned(),
            source,
        };
        let mut hasher = blake3::Hasher::new();
        io::copy(&mut fs::File::open(blend).map_err(read)?, &mut hasher).map_err(read)?;
        for (name, content) in EXPORTER {
            hasher.update(name.as_bytes()).update(content);
        }
        let content = hasher.finalize().to_hex();
        let full = fs::canonicalize(blend).map_err(read)?;
        let path = blake3::hash(full.as_os_str().as_encoded_bytes()).to_hex();
        let stem = blend.file_stem().unwrap_or_default().to_string_lossy();
        let prefix = format!("{stem}-{}-", &path[..8]);
        let folder = folder(blend, chosen)?;
        let name = format!("{prefix}{}", &content[..24]);
        Ok(Self {
            glb: folder.join(format!("{name}.matcha.glb")),
            notes: folder.join(format!("{name}.notes.json")),
            prefix,
        })
    }

    /// The exporter's warnings, if the export is there and none of its sources has changed.
    pub fn valid(&self) -> Option<Vec<String>> {
        let notes: Notes = serde_json::from_slice(&fs::read(&self.notes).ok()?).ok()?;
        let same = notes
            .sources
            .iter()
            .all(|file| SourceFile::of(file.path.clone()) == *file);
        (same && self.glb.is_file()).then_some(notes.warnings)
    }

    /// A name beside the export that no other process uses.
    pub fn partial(&self) -> PathBuf {
        self.glb
            .with_extension(format!("partial-{}.glb", std::process::id()))
    }

    /// Moves a finished export to its place and forgets the older ones of the same scene.
    pub fn keep(&self, partial: &Path, told: &Told) -> Result<(), ImportError> {
        let write = |source| ImportError::Write {
            file: self.glb.clone(),
            source,
        };
        let sources = told.sources.iter().cloned().map(SourceFile::of).collect();
        let notes = Notes {
            sources,
            warnings: told.warnings.clone(),
        };
        let json = serde_json::to_vec_pretty(&notes).map_err(|e| write(io::Error::other(e)))?;
        // Notes that belong to another export must never stand beside this one.
        if self.notes.exists() {
            fs::remove_file(&self.notes).map_err(write)?;
        }
        fs::rename(partial, &self.glb).map_err(write)?;
        let beside = self
            .notes
            .with_extension(format!("partial-{}", std::process::id()));
        fs::write(&beside, json)
            .and_then(|()| fs::rename(&beside, &self.notes))
            .map_err(write)?;
        self.forget_older();
        Ok(())
    }

    fn forget_older(&self) {
        let Some(entries) = self
            .glb
            .parent()
            .and_then(|folder| fs::read_dir(folder).ok())
        else {
            return;
        };
        for path in entries.flatten().map(|entry| entry.path()) {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let ours = name.starts_with(&self.prefix)
                && (name.ends_with(".matcha.glb") || name.ends_with(".notes.json"));
            if ours && path != self.glb && path != self.notes {
                // Nothing depends on it being gone.
                let _ = fs::remove_file(&path);
            }
        }
    }
}

/// The first of the chosen folder, the user's cache folder and the scene's own that can be written.
fn folder(blend: &Path, chosen: Option<&Path>) -> Result<PathBuf, ImportError> {
    let beside = match blend.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    let candidates = match chosen {
        Some(chosen) => vec![chosen.to_owned()],
        None => user_cache_folder()
            .into_iter()
            .chain([beside.to_owned()])
            .collect(),
    };
    first_writable(candidates).map_err(|last| match last {
        Some((file, source)) => ImportError::Write { file, source },
        None => ImportError::UnknownFormat {
            file: blend.to_owned(),
        },
    })
}
