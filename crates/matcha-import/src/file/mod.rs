//! The glTF file as data: container, JSON, buffers and typed arrays, all checked.

pub(crate) mod accessor;
pub(crate) mod check;
pub(crate) mod glb;
pub(crate) mod resource;

use crate::budget::Budget;
use crate::error::{Checked, Fault};
use gltf::json::Root;
use resource::Folder;
use std::borrow::Cow;

/// A parsed file whose indices are known to be in range, with its buffers' bytes.
pub(crate) struct Document<'a> {
    pub root: Root,
    pub buffers: Vec<Cow<'a, [u8]>>,
    pub folder: Folder<'a>,
    pub budget: &'a Budget,
}

impl<'a> Document<'a> {
    pub fn parse(bytes: &'a [u8], folder: Folder<'a>, budget: &'a Budget) -> Checked<Self> {
        let chunks = glb::split(bytes)?;
        let root: Root = gltf::json::deserialize::from_slice(chunks.json)
            .map_err(|error| Fault::new("JSON", error.to_string()))?;
        check::root(&root)?;
        let buffers = load_buffers(&root, chunks.bin, folder, budget)?;
        Ok(Self {
            root,
            buffers,
            folder,
            budget,
        })
    }

    /// The bytes of a buffer view.
    pub fn view(&self, index: usize, place: &str) -> Checked<&[u8]> {
        let view = self
            .root
            .buffer_views
            .get(index)
            .ok_or_else(|| Fault::new(place, format!("buffer view {index} does not exist")))?;
        let buffer = &self.buffers[view.buffer.value()];
        let start = view.byte_offset.map_or(0, |offset| offset.0);
        let range = start
            .checked_add(view.byte_length.0)
            .filter(|&end| end <= buffer.len() as u64);
        let Some(end) = range else {
            let (length, size, number) = (view.byte_length.0, buffer.len(), view.buffer.value());
            return Err(Fault::new(
                format!("bufferViews[{index}]"),
                format!(
                    "its {length} bytes from {start} on reach beyond the {size} bytes of buffer {number}"
                ),
            ));
        };
        Ok(&buffer[start as usize..end as usize])
    }
}

fn load_buffers<'a>(
    root: &Root,
    bin: Option<&'a [u8]>,
    folder: Folder<'_>,
    budget: &Budget,
) -> Checked<Vec<Cow<'a, [u8]>>> {
    let mut buffers = Vec::with_capacity(root.buffers.len());
    for (i, buffer) in root.buffers.iter().enumerate() {
        let place = format!("buffers[{i}]");
        let bytes = match (&buffer.uri, bin) {
            (Some(uri), _) => Cow::Owned(folder.read(uri, &place, budget)?),
            (None, Some(bin)) if i == 0 => Cow::Borrowed(bin),
            (None, _) => return Err(Fault::new(place, "has neither a uri nor a binary chunk")),
        };
        let (claimed, found) = (buffer.byte_length.0, bytes.len());
        if claimed > found as u64 {
            return Err(Fault::new(
                place,
                format!("claims {claimed} bytes and has {found}"),
            ));
        }
        buffers.push(bytes);
    }
    Ok(buffers)
}
