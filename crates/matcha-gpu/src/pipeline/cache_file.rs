//! Compiled kernels on disk.
//!
//! A file holds the driver's data behind its checksum: what is cut off or changed is
//! ignored. It is written beside and renamed, so that two processes cannot mix theirs.

use crate::device::Device;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// What files begin with; the number counts the layout's versions.
const MAGIC: &[u8] = b"matcha kernels 1\n";

/// The driver's cache and the file that it comes from and goes to.
pub(super) struct CacheFile {
    cache: wgpu::PipelineCache,
    path: PathBuf,
    /// Checksum of what is on disk.
    saved: Mutex<Option<blake3::Hash>>,
}

impl CacheFile {
    /// The cache of a device in a folder; none where the driver has no such thing.
    pub fn open(device: &Device, folder: &Path) -> Option<CacheFile> {
        if !device
            .raw()
            .features()
            .contains(wgpu::Features::PIPELINE_CACHE)
        {
            return None;
        }
        let path = folder.join(device.cache_key()?);
        let stored = std::fs::read(&path).ok().and_then(checked);
        let saved = stored.as_deref().map(blake3::hash);
        let made = device.create("the pipeline cache", 0, |device| {
            let descriptor = wgpu::PipelineCacheDescriptor {
                label: None,
                data: stored.as_deref(),
                fallback: true,
            };
            // SAFETY: the data comes from `PipelineCache::get_data`: nothing else is written
            // behind our magic with its checksum, and the driver checks that it is its own.
            #[allow(unsafe_code)]
            unsafe {
                device.create_pipeline_cache(&descriptor)
            }
        });
        match made {
            Ok(cache) => Some(CacheFile {
                cache,
                path,
                saved: Mutex::new(saved),
            }),
            Err(error) => {
                tracing::debug!("no pipeline cache: {error}");
                None
            }
        }
    }

    pub fn handle(&self) -> &wgpu::PipelineCache {
        &self.cache
    }

    /// Writes the file if there is something new.
    pub fn save(&self) {
        let Some(data) = self.cache.get_data() else {
            return;
        };
        let hash = blake3::hash(&data);
        let mut saved = self.saved.lock().unwrap_or_else(PoisonError::into_inner);
        if *saved == Some(hash) {
            return;
        }
        match write(&self.path, &data, hash) {
            Ok(()) => *saved = Some(hash),
            Err(error) => tracing::debug!("{}: {error}", self.path.display()),
        }
    }
}

/// The driver's data out of a file's bytes, if all of it is there.
fn checked(bytes: Vec<u8>) -> Option<Vec<u8>> {
    let rest = bytes.strip_prefix(MAGIC)?;
    let (hash, data) = rest.split_at_checked(blake3::OUT_LEN)?;
    (blake3::hash(data).as_bytes() == hash).then(|| data.to_vec())
}

fn write(path: &Path, data: &[u8], hash: blake3::Hash) -> std::io::Result<()> {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder)?;
    }
    let beside = path.with_extension(format!("{}.part", std::process::id()));
    let mut file = std::fs::File::create(&beside)?;
    let written = [MAGIC, hash.as_bytes(), data]
        .iter()
        .try_for_each(|part| file.write_all(part));
    drop(file);
    let renamed = written.and_then(|()| std::fs::rename(&beside, path));
    if renamed.is_err() {
        let _ = std::fs::remove_file(&beside);
    }
    renamed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_and_what_is_damaged_is_not() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("below").join("cache");
        let data = b"compiled".to_vec();
        write(&path, &data, blake3::hash(&data)).expect("it is writable");
        let bytes = std::fs::read(&path).expect("it is there");
        assert_eq!(checked(bytes.clone()), Some(data));
        assert_eq!(checked(bytes[..bytes.len() - 1].to_vec()), None);
        assert_eq!(checked(bytes[..20].to_vec()), None);
        assert_eq!(checked(Vec::new()), None);
        let mut changed = bytes;
        *changed.last_mut().expect("it is not empty") ^= 1;
        assert_eq!(checked(changed), None);
        let names = std::fs::read_dir(path.parent().expect("a folder")).expect("it is there");
        assert_eq!(names.count(), 1, "nothing is left beside it");
    }
}
