//! URIs of buffers and images: data URIs and files beside the scene.

use crate::budget::Budget;
use crate::error::{Checked, Fault};
use base64::Engine;
use std::path::{Component, Path, PathBuf};

/// The folder that relative URIs start from; none for scenes that are bytes in memory.
#[derive(Clone, Copy)]
pub(crate) struct Folder<'a>(pub Option<&'a Path>);

impl Folder<'_> {
    /// The bytes behind a URI.
    pub fn read(self, uri: &str, place: &str, budget: &Budget) -> Checked<Vec<u8>> {
        if let Some(data) = uri.strip_prefix("data:") {
            budget.charge(data.len() as u64, place)?;
            return decode_data(data).map_err(|problem| Fault::new(place, problem));
        }
        let path = self.locate(uri, place)?;
        let refuse = |error: std::io::Error| {
            Fault::new(
                place,
                format!("the file \"{}\" cannot be read: {error}", path.display()),
            )
        };
        let size = std::fs::metadata(&path).map_err(refuse)?.len();
        budget.charge(size, place)?;
        std::fs::read(&path).map_err(refuse)
    }

    /// The file that a URI names.
    pub fn locate(self, uri: &str, place: &str) -> Checked<PathBuf> {
        let folder = self.0.ok_or_else(|| {
            Fault::new(
                place,
                format!("the file \"{uri}\" is outside of these bytes"),
            )
        })?;
        if uri.contains("://") {
            return Err(Fault::new(
                place,
                format!("\"{uri}\" is not a file, and nothing is fetched from networks"),
            ));
        }
        let path = PathBuf::from(percent_decode(uri));
        if path
            .components()
            .any(|part| matches!(part, Component::RootDir | Component::Prefix(_)))
        {
            return Err(Fault::new(
                place,
                format!("\"{uri}\" is not a relative path"),
            ));
        }
        Ok(folder.join(path))
    }
}

/// The part of a data URI after `data:` (RFC 2397).
pub(crate) fn decode_data(data: &str) -> Result<Vec<u8>, String> {
    let (head, body) = data.split_once(',').ok_or("its data URI has no comma")?;
    if !head.ends_with(";base64") {
        return Ok(percent_bytes(body));
    }
    base64::engine::general_purpose::STANDARD
        .decode(body.trim())
        .map_err(|error| format!("its data URI is not base64: {error}"))
}

fn percent_decode(text: &str) -> String {
    String::from_utf8_lossy(&percent_bytes(text)).into_owned()
}

fn percent_bytes(text: &str) -> Vec<u8> {
    let bytes = text.as_bytes();
    let mut out = Vec::with_capacity(bytes.len());
    let mut i = 0;
    while i < bytes.len() {
        let escaped = (bytes[i] == b'%')
            .then(|| bytes.get(i + 1..i + 3))
            .flatten()
            .and_then(|hex| std::str::from_utf8(hex).ok())
            .and_then(|hex| u8::from_str_radix(hex, 16).ok());
        out.push(escaped.unwrap_or(bytes[i]));
        i += if escaped.is_some() { 3 } else { 1 };
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uris() {
        assert_eq!(
            decode_data("application/octet-stream;base64,AQID").unwrap(),
            [1, 2, 3]
        );
        assert_eq!(decode_data("text/plain,a%20b%").unwrap(), b"a b%");
        assert!(decode_data("nothing").is_err());
        let folder = Folder(Some(Path::new("/scenes")));
        assert_eq!(
            folder.locate("a%20b.png", "x").unwrap(),
            Path::new("/scenes/a b.png")
        );
        assert!(folder.locate("https://example.org/a.png", "x").is_err());
        assert!(folder.locate("/etc/passwd", "x").is_err());
        assert!(Folder(None).locate("a.png", "x").is_err());
    }
}
