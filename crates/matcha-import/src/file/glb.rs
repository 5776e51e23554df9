//! The binary container (glTF 2.0 specification, section 4.4).

use crate::error::{Checked, Fault};

/// The two chunks that glTF defines.
pub(crate) struct Chunks<'a> {
    pub json: &'a [u8],
    pub bin: Option<&'a [u8]>,
}

const MAGIC: &[u8; 4] = b"glTF";
const JSON: u32 = 0x4E4F_534A;
const BIN: u32 = 0x004E_4942;

pub(crate) fn is_glb(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

/// Splits a `.glb` into its chunks; anything without the magic is taken as JSON.
pub(crate) fn split(bytes: &[u8]) -> Checked<Chunks<'_>> {
    if !is_glb(bytes) {
        return Ok(Chunks {
            json: bytes,
            bin: None,
        });
    }
    let version = word(bytes, 4).ok_or_else(|| truncated(12, bytes.len()))?;
    if version != 2 {
        return Err(Fault::new(
            "GLB header",
            format!("version {version} is not supported, only 2 is"),
        ));
    }
    let length = word(bytes, 8).ok_or_else(|| truncated(12, bytes.len()))? as usize;
    if length > bytes.len() {
        return Err(truncated(length, bytes.len()));
    }
    chunks(&bytes[..length.max(12)])
}

fn chunks(bytes: &[u8]) -> Checked<Chunks<'_>> {
    let (mut json, mut bin) = (None, None);
    let mut at = 12;
    while at < bytes.len() {
        let header = word(bytes, at).zip(word(bytes, at + 4));
        let (length, kind) =
            header.ok_or_else(|| Fault::new(format!("GLB chunk at byte {at}"), "is cut off"))?;
        let start = at + 8;
        let end = start
            .checked_add(length as usize)
            .filter(|&end| end <= bytes.len())
            .ok_or_else(|| {
                Fault::new(
                    format!("GLB chunk at byte {at}"),
                    format!(
                        "claims {length} bytes, and {} are left",
                        bytes.len() - start
                    ),
                )
            })?;
        match kind {
            JSON if json.is_none() => json = Some(&bytes[start..end]),
            BIN if bin.is_none() => bin = Some(&bytes[start..end]),
            _ => {} // the specification asks readers to ignore unknown chunks
        }
        at = end.next_multiple_of(4);
    }
    let json = json.ok_or_else(|| Fault::new("GLB", "has no JSON chunk"))?;
    Ok(Chunks { json, bin })
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    let four = bytes.get(at..at.checked_add(4)?)?;
    Some(u32::from_le_bytes(four.try_into().ok()?))
}

fn truncated(expected: usize, found: usize) -> Fault {
    Fault::new(
        "GLB header",
        format!("the file is truncated: {expected} bytes expected, {found} found"),
    )
}
