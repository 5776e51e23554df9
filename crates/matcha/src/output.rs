//! Files: checked before anything is rendered, written beside and then renamed, so that
//! nobody ever finds half of one.

use anyhow::{Context, Result, bail};
use serde::Serialize;
use std::ffi::OsStr;
use std::io::Write;
use std::path::{Path, PathBuf};

/// A kind of picture file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    Exr,
    Png,
}

/// The kind that a file's name says.
pub(crate) fn format_of(path: &Path) -> Result<Format> {
    let extension = path
        .extension()
        .and_then(OsStr::to_str)
        .map(str::to_ascii_lowercase);
    match extension.as_deref() {
        Some("exr") => Ok(Format::Exr),
        Some("png") => Ok(Format::Png),
        _ => bail!(
            "{}: a picture's name must end in .exr or .png",
            path.display()
        ),
    }
}

/// Refuses a file that could not be written later.
pub(crate) fn check_file(path: &Path) -> Result<()> {
    if path.is_dir() {
        bail!("{}: is a folder, not a file", path.display());
    }
    if path.file_name().is_none() {
        bail!("{}: is no name of a file", path.display());
    }
    check_folder(folder_of(path))
}

/// Refuses statistics that could not be written later, or that would take the place of another
/// file of this run.
pub(crate) fn check_statistics(path: &Path, others: &[PathBuf]) -> Result<()> {
    check_file(path)?;
    match others.iter().find(|other| is_same(path, other)) {
        Some(other) => bail!(
            "{}: the statistics would take the place of {}",
            path.display(),
            other.display()
        ),
        None => Ok(()),
    }
}

/// Whether two names are of one file, which need not be there yet.
fn is_same(a: &Path, b: &Path) -> bool {
    let whole = |path: &Path| {
        let folder = folder_of(path).canonicalize().ok()?;
        Some(folder.join(path.file_name()?))
    };
    whole(a).is_some() && whole(a) == whole(b)
}

/// Makes a folder where there is none, and refuses one that nothing can be written to.
pub(crate) fn make_folder(path: &Path) -> Result<()> {
    if path.exists() && !path.is_dir() {
        bail!("{}: is a file, not a folder", path.display());
    }
    std::fs::create_dir_all(path)
        .with_context(|| format!("{}: the folder cannot be made", path.display()))?;
    check_folder(path)
}

fn check_folder(folder: &Path) -> Result<()> {
    if !folder.is_dir() {
        bail!("{}: there is no such folder", folder.display());
    }
    if let Err(error) = part_file().tempfile_in(folder) {
        // The kind alone: the rest of the message names a file that nobody asked for.
        bail!(
            "{}: nothing can be written there: {}",
            folder.display(),
            error.kind()
        );
    }
    Ok(())
}

/// Writes a whole file, or nothing.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    let write = || -> std::io::Result<()> {
        let folder = folder_of(path);
        let mut file = part_file().tempfile_in(folder)?;
        // The file itself: errors of its wrapper name the part file, which nobody asked for.
        file.as_file_mut().write_all(bytes)?;
        file.as_file().sync_all()?;
        file.persist(path).map_err(|error| error.error)?;
        Ok(())
    };
    write().with_context(|| format!("{}: cannot be written", path.display()))
}

/// Writes JSON, indented, with a newline at its end.
pub(crate) fn write_json(path: &Path, value: &impl Serialize) -> Result<()> {
    let mut text = serde_json::to_string_pretty(value)?;
    text.push('\n');
    write(path, text.as_bytes())
}

/// Writes to standard output; a closed pipe is no error.
pub(crate) fn print(text: &str) -> Result<()> {
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(error).context("standard output cannot be written")
        }
        _ => Ok(()),
    }
}

/// A file that is not finished, with the permissions that any new file has.
fn part_file() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".matcha-").suffix(".part");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // The system's mask takes away what the user does not want.
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_replaced_whole_and_leaves_nothing_beside() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        write(&path, b"one").unwrap();
        write(&path, b"two").unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"two");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn what_cannot_be_written_is_refused_before() {
        let folder = tempfile::tempdir().unwrap();
        assert!(check_file(&folder.path().join("a.png")).is_ok());
        assert!(check_file(folder.path()).is_err());
        assert!(check_file(&folder.path().join("none/a.png")).is_err());
        std::fs::write(folder.path().join("f"), "").unwrap();
        assert!(make_folder(&folder.path().join("f")).is_err());
        assert!(make_folder(&folder.path().join("f/g")).is_err());
        assert!(make_folder(&folder.path().join("new/er")).is_ok());
    }

    #[test]
    fn names_tell_the_format() {
        assert_eq!(format_of(Path::new("a/b.EXR")).unwrap(), Format::Exr);
        assert!(format_of(Path::new("a.jpg")).is_err() && format_of(Path::new("png")).is_err());
    }
}
