//! Kernels compiled, once for each text and set of bindings.

mod cache_file;

use crate::device::Device;
use crate::error::GpuError;
use crate::memory::Memory;
use crate::shader::{Library, Linked};
use cache_file::CacheFile;
use std::collections::HashMap;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// A kernel that can run.
pub struct Kernel {
    name: String,
    pipeline: wgpu::ComputePipeline,
    workgroup: u32,
}

impl Kernel {
    /// The name of its entry point.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Invocations of a workgroup.
    pub fn workgroup(&self) -> u32 {
        self.workgroup
    }

    pub(crate) fn pipeline(&self) -> &wgpu::ComputePipeline {
        &self.pipeline
    }
}

/// A kernel to be.
#[derive(Clone, Copy)]
pub struct KernelSource<'a> {
    /// The entry point.
    pub name: &'a str,
    /// Where it comes from.
    pub library: &'a Library,
    /// What it is bound to: the memories of group 1, 2 and so on.
    pub memories: &'a [&'a Memory],
    /// Values of its `override` constants.
    pub constants: &'a [(&'a str, f64)],
}

/// All kernels of a device so far.
pub struct Pipelines {
    device: Device,
    cache: Option<CacheFile>,
    made: Mutex<HashMap<blake3::Hash, Arc<Kernel>>>,
    time: Mutex<Duration>,
}

impl Pipelines {
    /// None yet. With a folder, compiled kernels are kept in it, where the driver can.
    pub fn new(device: &Device, folder: Option<&Path>) -> Pipelines {
        Pipelines {
            cache: folder.and_then(|folder| CacheFile::open(device, folder)),
            device: device.clone(),
            made: Mutex::default(),
            time: Mutex::default(),
        }
    }

    /// Time spent in putting kernels together, compiling them and running them for the first
    /// time, seconds.
    pub fn seconds(&self) -> f64 {
        self.time
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .as_secs_f64()
    }

    /// Compiles a kernel, unless it was before.
    ///
    /// # Errors
    /// If its text does not come together, or the driver refuses it.
    pub fn kernel(&self, source: &KernelSource) -> Result<Arc<Kernel>, GpuError> {
        self.timed(|| self.find_or_compile(source))
    }

    /// Does something whose time is the kernels'.
    pub(crate) fn timed<T>(&self, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let done = work();
        *self.time.lock().unwrap_or_else(PoisonError::into_inner) += start.elapsed();
        done
    }

    fn find_or_compile(&self, source: &KernelSource) -> Result<Arc<Kernel>, GpuError> {
        let linked = source.library.link(source.name, source.memories)?;
        let key = key(source, &linked);
        let made = || self.made.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(kernel) = made().get(&key) {
            return Ok(kernel.clone());
        }
        let kernel = Arc::new(self.compile(source, &linked)?);
        made().insert(key, kernel.clone());
        Ok(kernel)
    }

    /// Writes compiled kernels to the folder, if anything is new. What goes wrong costs
    /// the next start some time, and is said in the log only.
    pub fn save(&self) {
        if let Some(cache) = &self.cache {
            cache.save();
        }
    }

    fn compile(&self, source: &KernelSource, linked: &Linked) -> Result<Kernel, GpuError> {
        let layouts = [self.device.arguments_layout()].into_iter();
        let layouts: Vec<_> = layouts
            .chain(source.memories.iter().map(|memory| memory.layout()))
            .map(Some)
            .collect();
        let compiled = self.device.create(source.name, 0, |device| {
            let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(source.name),
                source: wgpu::ShaderSource::Wgsl(linked.text.as_str().into()),
            });
            let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: None,
                bind_group_layouts: &layouts,
                immediate_size: 0,
            });
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(source.name),
                layout: Some(&layout),
                module: &module,
                entry_point: Some(source.name),
                compilation_options: wgpu::PipelineCompilationOptions {
                    constants: source.constants,
                    ..Default::default()
                },
                cache: self.cache.as_ref().map(CacheFile::handle),
            })
        });
        let pipeline = compiled.map_err(|error| match error {
            GpuError::Invalid { message, .. } => GpuError::Pipeline {
                kernel: source.name.to_owned(),
                message,
            },
            other => other,
        })?;
        Ok(Kernel {
            name: source.name.to_owned(),
            pipeline,
            workgroup: linked.workgroup,
        })
    }
}

/// What makes a compiled kernel another one.
fn key(source: &KernelSource, linked: &Linked) -> blake3::Hash {
    let mut hasher = blake3::Hasher::new();
    hasher.update(source.name.as_bytes());
    hasher.update(linked.text.as_bytes());
    for (name, value) in source.constants {
        hasher.update(name.as_bytes());
        hasher.update(&value.to_le_bytes());
    }
    for memory in source.memories {
        hasher.update(memory.shape().as_bytes());
    }
    hasher.finalize()
}
