//! Words to a buffer and back, a chunk at a time.

use super::buffer;
use crate::device::Device;
use crate::error::GpuError;
use std::sync::mpsc;
use std::time::Duration;

/// Bytes on the way at once: staging memory is bounded.
const CHUNK: u64 = 32 << 20;

/// Writes words from byte `offset` on.
pub(crate) fn upload(
    device: &Device,
    to: &wgpu::Buffer,
    offset: u64,
    words: &[u32],
) -> Result<(), GpuError> {
    let mut at = offset;
    for chunk in words.chunks(CHUNK as usize / 4) {
        device
            .queue()
            .write_buffer(to, at, bytemuck::cast_slice(chunk));
        at += chunk.len() as u64 * 4;
        if words.len() as u64 * 4 > CHUNK {
            // Staging memory is given back only when it has been copied.
            let submission = device.flush();
            device.wait(&submission)?;
        }
    }
    device.trouble()
}

/// Adds `bytes` bytes from `offset` on to `words`.
pub(super) fn download(
    device: &Device,
    from: &wgpu::Buffer,
    offset: u64,
    bytes: u64,
    words: &mut Vec<u32>,
) -> Result<(), GpuError> {
    let usage = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST;
    let staging = buffer(device, "reading back", bytes.min(CHUNK), usage)?;
    words.reserve(bytes as usize / 4);
    let mut at = 0;
    while at < bytes {
        let now = (bytes - at).min(CHUNK);
        let mut commands = device.raw().create_command_encoder(&Default::default());
        commands.copy_buffer_to_buffer(from, offset + at, &staging, 0, now);
        let submission = device.submit(commands);
        words.extend(mapped_words(device, &staging, now, &submission)?);
        at += now;
    }
    Ok(())
}

/// The first `bytes` bytes of a mappable buffer, once a submission is done.
pub(crate) fn mapped_words(
    device: &Device,
    staging: &wgpu::Buffer,
    bytes: u64,
    submission: &wgpu::SubmissionIndex,
) -> Result<Vec<u32>, GpuError> {
    let (sender, mapped) = mpsc::channel();
    staging.map_async(wgpu::MapMode::Read, 0..bytes, move |result| {
        // Nobody listens any more after an error.
        let _ = sender.send(result);
    });
    device.wait(submission)?;
    let refused = |message: String| GpuError::Invalid {
        what: "to read".to_owned(),
        message,
    };
    // Another thread's waiting may be about to say so.
    match mapped.recv_timeout(Duration::from_secs(10)) {
        Ok(Ok(())) => {}
        Ok(Err(error)) => return Err(refused(error.to_string())),
        Err(error) => return Err(refused(error.to_string())),
    }
    let range = staging.get_mapped_range(0..bytes);
    let view = range.map_err(|error| refused(error.to_string()))?;
    let words = bytemuck::pod_collect_to_vec(&view);
    drop(view);
    staging.unmap();
    Ok(words)
}
