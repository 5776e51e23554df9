//! Scenes from files that nobody vouches for.
//!
//! [`load`] reads glTF 2.0 (`.glb`, `.gltf`), with or without the `MATCHA_cycles`
//! extension that carries Cycles' node trees, and `.blend` files, which Blender itself
//! exports with the add-on that is part of this crate.
//!
//! Two promises. Whatever a file holds, the answer is a scene or one sentence that names
//! the file and the place: no panic, no endless loop, no memory beyond the stated limit.
//! And nothing is dropped in silence: what is not supported is in the [`Report`], once per
//! kind, with what is rendered in its place.

mod blend;
mod budget;
mod cache_folder;
mod cycles;
mod error;
mod file;
mod picture;
mod plain;
mod report;
mod tangent;

pub use cache_folder::user_cache_folder;
pub use error::ImportError;
pub use report::{Report, ReportItem, ReportKind};

use budget::Budget;
use error::Checked;
use file::Document;
use file::resource::Folder;
use matcha_render::scene::Scene;
use plain::texture::Textures;
use std::io::Read;
use std::path::{Path, PathBuf};

/// How to load.
#[derive(Clone, Debug, Default)]
pub struct LoadOptions {
    /// Anything that had to be substituted is an error.
    pub strict: bool,
    /// The Blender to export with; otherwise it is searched.
    pub blender: Option<PathBuf>,
    /// Where exports of `.blend` files are kept; otherwise the user's cache folder.
    pub cache_dir: Option<PathBuf>,
    /// Most bytes that meshes and pictures may take; otherwise four fifths of what is available.
    pub memory_limit: Option<u64>,
}

/// How far loading is.
#[derive(Clone, Debug, PartialEq)]
pub enum Progress {
    /// Blender exports: share done, 0 to 1, and what it is at.
    Export {
        /// 0 to 1.
        fraction: f32,
        /// In Blender's words.
        what: String,
    },
    /// Meshes and materials are read.
    Scene,
    /// Pictures are decoded.
    Images {
        /// Pictures done.
        done: usize,
        /// Pictures in all.
        total: usize,
    },
    /// Tangents are computed.
    Tangents,
}

/// A loaded scene.
#[derive(Debug)]
pub struct Imported {
    /// The scene.
    pub scene: Scene,
    /// What could not be taken as it is.
    pub report: Report,
}

/// Loads a scene file: glTF directly, a `.blend` through Blender.
pub fn load(
    path: &Path,
    options: &LoadOptions,
    progress: &mut dyn FnMut(Progress),
) -> Result<Imported, ImportError> {
    let (glb, warnings) = match format(path)? {
        Format::Gltf => (path.to_owned(), Vec::new()),
        Format::Blend => {
            let exported = blend::export(path, options, progress)?;
            (exported.glb, exported.warnings)
        }
    };
    let bytes = std::fs::read(&glb).map_err(|source| ImportError::Read {
        file: glb.clone(),
        source,
    })?;
    let folder = Folder(Some(glb.parent().unwrap_or(Path::new("."))));
    let mut imported =
        load_from(&bytes, folder, options, progress).map_err(|fault| fault.in_file(path))?;
    imported.scene.name = path
        .file_stem()
        .map(|stem| stem.to_string_lossy().into_owned())
        .unwrap_or_default();
    for warning in warnings {
        let what = ReportKind::Feature(format!("the exporter says: {warning}"));
        imported.report.add(what, "", "");
    }
    imported.report.check(options.strict, path)?;
    Ok(imported)
}

enum Format {
    Gltf,
    Blend,
}

/// By the first bytes, then by the name: compressed `.blend` files and JSON have no telling first bytes.
fn format(path: &Path) -> Result<Format, ImportError> {
    let refuse = |source| ImportError::Read {
        file: path.to_owned(),
        source,
    };
    let mut start = Vec::new();
    std::fs::File::open(path)
        .map_err(refuse)?
        .take(7)
        .read_to_end(&mut start)
        .map_err(refuse)?;
    let extension = path
        .extension()
        .map(|e| e.to_string_lossy().to_ascii_lowercase())
        .unwrap_or_default();
    match extension.as_str() {
        _ if file::glb::is_glb(&start) => Ok(Format::Gltf),
        _ if start == b"BLENDER" => Ok(Format::Blend),
        "glb" | "gltf" => Ok(Format::Gltf),
        "blend" => Ok(Format::Blend),
        _ => Err(ImportError::UnknownFormat {
            file: path.to_owned(),
        }),
    }
}

/// Loads a glTF scene from memory: a `.glb`, or the JSON of a `.gltf` that refers to no other file.
/// `name` stands for the file in messages.
pub fn load_bytes(
    name: &str,
    bytes: &[u8],
    options: &LoadOptions,
    progress: &mut dyn FnMut(Progress),
) -> Result<Imported, ImportError> {
    let mut imported = load_from(bytes, Folder(None), options, progress)
        .map_err(|fault| fault.in_file(Path::new(name)))?;
    imported.scene.name = name.to_owned();
    imported.report.check(options.strict, Path::new(name))?;
    Ok(imported)
}

fn load_from(
    bytes: &[u8],
    folder: Folder<'_>,
    options: &LoadOptions,
    progress: &mut dyn FnMut(Progress),
) -> Checked<Imported> {
    let budget = Budget::new(
        options
            .memory_limit
            .unwrap_or_else(budget::available_memory),
    );
    let mut report = Report::default();
    progress(Progress::Scene);
    let document = Document::parse(bytes, folder, &budget)?;
    let mut textures = Textures::default();
    let mut scene = if cycles::is_present(&document) {
        cycles::import(&document, &mut textures, &mut report)?
    } else {
        plain::import(&document, &mut textures, &mut report)?
    };
    scene.images = picture::decode_all(&textures.requests, &budget, &mut report, progress)?;
    progress(Progress::Tangents);
    tangent::generate_needed(&mut scene, &budget)?;
    Ok(Imported { scene, report })
}
