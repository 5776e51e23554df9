//! Folders for what can be made again.

use std::path::PathBuf;
use std::{fs, io};

/// Matcha's part of the user's cache folder; it need not exist. `None` where the system
/// names no such folder.
pub fn user_cache_folder() -> Option<PathBuf> {
    let variable = |name| {
        std::env::var_os(name)
            .filter(|value| !value.is_empty())
            .map(PathBuf::from)
    };
    let user =
        variable("XDG_CACHE_HOME").or_else(|| variable("HOME").map(|home| home.join(".cache")));
    user.map(|user| user.join("matcha"))
}

/// The first of some folders that can be written to, made if it was not there; otherwise
/// the last of them and what is wrong with it.
pub(crate) fn first_writable(
    candidates: impl IntoIterator<Item = PathBuf>,
) -> Result<PathBuf, Option<(PathBuf, io::Error)>> {
    let mut last = None;
    for folder in candidates {
        match fs::create_dir_all(&folder).and_then(|()| tempfile::tempfile_in(&folder).map(drop)) {
            Ok(()) => return Ok(folder),
            Err(error) => last = Some((folder, error)),
        }
    }
    Err(last)
}
