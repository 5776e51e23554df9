//! Pictures: gathered, read, decoded in parallel, each content once.

mod decode;
mod exr_file;

pub(crate) use decode::{EXR_MAGIC, PNG_MAGIC};

use crate::Progress;
use crate::budget::Budget;
use crate::error::{Checked, Fault};
use crate::report::{Report, ReportKind};
use matcha_render::scene::{AlphaMode, ColorSpace, Image, Pixels};
use rayon::prelude::*;
use std::borrow::Cow;
use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::{Arc, mpsc};

/// Where a picture's bytes are; an error sentence where they are known to be lost.
pub(crate) enum Source<'a> {
    Bytes(Cow<'a, [u8]>),
    File(PathBuf),
    Lost(String),
}

/// A picture to be decoded.
pub(crate) struct Request<'a> {
    pub name: String,
    pub source: Source<'a>,
    pub color_space: ColorSpace,
    pub alpha: AlphaMode,
}

/// Decoded pixels, four channels, top row first.
#[derive(Clone)]
pub(crate) struct Picture {
    pub width: u32,
    pub height: u32,
    pub pixels: Pixels,
}

/// Why a picture did not come out: replaced (and reported), or the end.
pub(crate) enum Failure {
    Unreadable(String),
    Fatal(Fault),
}

/// Decodes all requests, in their order. Unreadable ones are replaced by the pink
/// (1, 0, 1) that Cycles shows for them.
pub(crate) fn decode_all(
    requests: &[Request<'_>],
    budget: &Budget,
    report: &mut Report,
    progress: &mut dyn FnMut(Progress),
) -> Checked<Vec<Image>> {
    let bytes: Vec<Result<Cow<'_, [u8]>, Failure>> =
        requests.par_iter().map(|r| read(r, budget)).collect();
    let hashes: Vec<Option<blake3::Hash>> = bytes
        .par_iter()
        .map(|b| b.as_ref().ok().map(|b| blake3::hash(b)))
        .collect();
    let mut first = HashMap::new();
    for (i, hash) in hashes.iter().enumerate() {
        if let Some(hash) = hash {
            first.entry(*hash).or_insert(i);
        }
    }
    let mut unique: Vec<usize> = first.values().copied().collect();
    unique.sort_unstable();
    let mut pictures = decode_unique(requests, bytes, &unique, budget, progress);
    let mut images = Vec::with_capacity(requests.len());
    for (i, request) in requests.iter().enumerate() {
        let leader = hashes[i].map_or(i, |hash| first[&hash]);
        let picture = match &mut pictures[leader] {
            Ok(picture) => picture.clone(),
            Err(Failure::Unreadable(why)) => {
                let kind = ReportKind::Image(request.name.clone());
                report.add(
                    kind,
                    why,
                    "replaced by the pink (1, 0, 1) that Cycles shows",
                );
                pink()
            }
            Err(Failure::Fatal(fault)) => return Err(fault.clone()),
        };
        images.push(Image {
            name: request.name.clone(),
            width: picture.width,
            height: picture.height,
            pixels: picture.pixels,
            color_space: request.color_space,
            alpha: request.alpha,
        });
    }
    Ok(images)
}

/// Decodes the pictures numbered `unique` on all threads, and tells the caller's
/// thread how far it is. Entries that are not in `unique` keep their failure or are left pink.
fn decode_unique<'a>(
    requests: &[Request<'_>],
    bytes: Vec<Result<Cow<'a, [u8]>, Failure>>,
    unique: &[usize],
    budget: &Budget,
    progress: &mut dyn FnMut(Progress),
) -> Vec<Result<Picture, Failure>> {
    let (send, receive) = mpsc::channel();
    let total = unique.len();
    let decoded: Vec<Result<Picture, Failure>> = std::thread::scope(|scope| {
        let bytes = &bytes;
        let work = scope.spawn(move || {
            unique
                .par_iter()
                .map_with(send, |send, &i| {
                    let result = match &bytes[i] {
                        Ok(bytes) => decode::decode(bytes, &requests[i].name, budget),
                        Err(_) => Ok(pink()),
                    };
                    // The receiver lives until all senders are gone.
                    let _ = send.send(());
                    result
                })
                .collect()
        });
        for done in 1.. {
            if receive.recv().is_err() {
                break;
            }
            progress(Progress::Images { done, total });
        }
        work.join()
            .unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    });
    let mut all: Vec<Result<Picture, Failure>> =
        bytes.into_iter().map(|b| b.map(|_| pink())).collect();
    for (&i, picture) in unique.iter().zip(decoded) {
        all[i] = picture;
    }
    all
}

fn read<'a>(request: &'a Request<'_>, budget: &Budget) -> Result<Cow<'a, [u8]>, Failure> {
    match &request.source {
        Source::Bytes(bytes) => Ok(Cow::Borrowed(bytes)),
        Source::Lost(why) => Err(Failure::Unreadable(why.clone())),
        Source::File(path) => {
            let unreadable = |error| Failure::Unreadable(format!("{}: {error}", path.display()));
            let size = std::fs::metadata(path).map_err(unreadable)?.len();
            budget
                .charge(size, &format!("image \"{}\"", request.name))
                .map_err(Failure::Fatal)?;
            std::fs::read(path).map(Cow::Owned).map_err(unreadable)
        }
    }
}

/// One pixel of Cycles' colour for missing images.
fn pink() -> Picture {
    Picture {
        width: 1,
        height: 1,
        pixels: Pixels::RgbaF32(Arc::new(vec![[1.0, 0.0, 1.0, 1.0]])),
    }
}

#[cfg(test)]
mod tests;
