//! An open device: commands go in, and nobody waits for it forever.

use crate::adapter::{Adapter, AdapterReport, Kind};
use crate::error::{GpuError, one_line};
use crate::shader::prelude::{ARGUMENTS, Dialect};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// How long a GPU may be silent. Dispatches are cut to a tenth of a second, so that a
/// whole batch of them takes a few seconds at most.
const PATIENCE: Duration = Duration::from_secs(60);
/// How long a driver on the processor may be: it shares it with everything else.
const SOFTWARE_PATIENCE: Duration = Duration::from_secs(900);
/// Between two looks whether the device was lost.
const LOOK_EVERY: Duration = Duration::from_millis(500);

/// An open device; clones are the same device.
#[derive(Clone)]
pub struct Device {
    shared: Arc<Shared>,
}

struct Shared {
    device: wgpu::Device,
    queue: wgpu::Queue,
    report: AdapterReport,
    key: Option<String>,
    trouble: Arc<Mutex<Option<GpuError>>>,
    /// Held while commands are handed over or waited for: a thread must not wait for a number
    /// that wgpu has given away, but not yet noted, in another thread.
    submitting: Mutex<()>,
    patience: Duration,
    arguments_layout: wgpu::BindGroupLayout,
    ray_queries: bool,
}

impl Device {
    /// Opens an adapter with everything of it that Matcha uses, but for ray queries.
    ///
    /// # Errors
    /// If the driver refuses.
    pub fn open(adapter: &Adapter) -> Result<Device, GpuError> {
        Device::open_with(adapter, false)
    }

    /// Opens an adapter, with its ray queries if they are asked for: then kernels trace rays
    /// through acceleration structures.
    ///
    /// # Errors
    /// If the adapter has no ray queries, or the driver refuses.
    pub fn open_with(adapter: &Adapter, ray_queries: bool) -> Result<Device, GpuError> {
        let report = adapter.report().clone();
        if ray_queries && !report.ray_queries {
            return Err(GpuError::NoRayQueries {
                adapter: report.name,
            });
        }
        let mut used = wgpu::Features::SHADER_INT64
            | wgpu::Features::SHADER_INT64_ATOMIC_ALL_OPS
            | wgpu::Features::SHADER_INT64_ATOMIC_MIN_MAX
            | wgpu::Features::TIMESTAMP_QUERY
            | wgpu::Features::PIPELINE_CACHE;
        used.set(wgpu::Features::EXPERIMENTAL_RAY_QUERY, ray_queries);
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("matcha"),
            required_features: adapter.handle.features() & used,
            required_limits: adapter.handle.limits(),
            memory_hints: wgpu::MemoryHints::MemoryUsage,
            experimental_features: experimental_features(ray_queries),
            ..Default::default()
        };
        let opened = pollster::block_on(adapter.handle.request_device(&descriptor));
        let (device, queue) = opened.map_err(|error| GpuError::Refused {
            adapter: report.name.clone(),
            message: one_line(&error),
        })?;
        let trouble = Arc::new(Mutex::new(None));
        watch(&device, &trouble);
        let patience = if report.kind == Kind::Software {
            SOFTWARE_PATIENCE
        } else {
            PATIENCE
        };
        let key = wgpu::util::pipeline_cache_key(&adapter.handle.get_info());
        Ok(Device {
            shared: Arc::new(Shared {
                arguments_layout: arguments_layout(&device),
                device,
                queue,
                report,
                key,
                trouble,
                submitting: Mutex::default(),
                patience,
                ray_queries,
            }),
        })
    }

    /// Whether kernels may use 64-bit atomic operations.
    pub fn has_atomics_64(&self) -> bool {
        self.report().atomics_64
    }

    /// Whether kernels trace rays through acceleration structures of the device's.
    pub fn has_ray_queries(&self) -> bool {
        self.shared.ray_queries
    }

    /// The dialect of its kernels.
    pub fn dialect(&self) -> Dialect {
        Dialect {
            atomics_64: self.has_atomics_64(),
            ray_queries: self.has_ray_queries(),
        }
    }

    /// What it is and offers.
    pub fn report(&self) -> &AdapterReport {
        &self.shared.report
    }

    /// wgpu's device.
    pub fn raw(&self) -> &wgpu::Device {
        &self.shared.device
    }

    /// wgpu's queue.
    pub fn queue(&self) -> &wgpu::Queue {
        &self.shared.queue
    }

    /// The layout of group 0 of every kernel.
    pub(crate) fn arguments_layout(&self) -> &wgpu::BindGroupLayout {
        &self.shared.arguments_layout
    }

    /// Names the driver and device that compiled kernels are good for.
    pub(crate) fn cache_key(&self) -> Option<&str> {
        self.shared.key.as_deref()
    }

    /// True if both are the same open device.
    pub fn is(&self, other: &Device) -> bool {
        Arc::ptr_eq(&self.shared, &other.shared)
    }

    /// Creates something of a size, with all that goes wrong as an error.
    ///
    /// # Errors
    /// If there is no memory, or the device refuses.
    pub(crate) fn create<T>(
        &self,
        what: &str,
        bytes: u64,
        create: impl FnOnce(&wgpu::Device) -> T,
    ) -> Result<T, GpuError> {
        let device = self.raw();
        let memory = device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let internal = device.push_error_scope(wgpu::ErrorFilter::Internal);
        let invalid = device.push_error_scope(wgpu::ErrorFilter::Validation);
        let created = create(device);
        let invalid = pollster::block_on(invalid.pop());
        let internal = pollster::block_on(internal.pop());
        if pollster::block_on(memory.pop()).is_some() {
            return Err(GpuError::OutOfMemory {
                what: what.to_owned(),
                bytes,
            });
        }
        self.trouble()?;
        match invalid.or(internal) {
            None => Ok(created),
            Some(error) => Err(GpuError::Invalid {
                what: what.to_owned(),
                message: one_line(&error),
            }),
        }
    }

    /// Hands commands over.
    pub fn submit(&self, commands: wgpu::CommandEncoder) -> wgpu::SubmissionIndex {
        self.hand_over([commands.finish()])
    }

    /// Hands over what was written to buffers.
    pub fn flush(&self) -> wgpu::SubmissionIndex {
        self.hand_over([])
    }

    fn hand_over<const N: usize>(
        &self,
        commands: [wgpu::CommandBuffer; N],
    ) -> wgpu::SubmissionIndex {
        let submitting = self.shared.submitting.lock();
        let _held = submitting.unwrap_or_else(PoisonError::into_inner);
        self.queue().submit(commands)
    }

    /// Waits until a submission is done.
    ///
    /// # Errors
    /// If the device is lost, refused a command, or stays silent.
    pub fn wait(&self, submission: &wgpu::SubmissionIndex) -> Result<(), GpuError> {
        let start = Instant::now();
        loop {
            let poll = wgpu::PollType::Wait {
                submission_index: Some(submission.clone()),
                timeout: Some(LOOK_EVERY),
            };
            let polled = {
                // wgpu 30 compares its numbers of submissions wrongly while another thread
                // hands work over.
                let submitting = self.shared.submitting.lock();
                let _held = submitting.unwrap_or_else(PoisonError::into_inner);
                self.raw().poll(poll)
            };
            self.trouble()?;
            match polled {
                Ok(_) => return Ok(()),
                Err(wgpu::PollError::Timeout) => {}
                // It did not take the work: it is gone, whether its driver says so or not.
                Err(error) => {
                    let lost = GpuError::Lost {
                        message: one_line(&error),
                    };
                    let mut trouble = self
                        .shared
                        .trouble
                        .lock()
                        .unwrap_or_else(PoisonError::into_inner);
                    return Err(trouble.get_or_insert(lost).clone());
                }
            }
            if start.elapsed() > self.shared.patience {
                // wgpu waits for the queue without end when the device is dropped.
                std::mem::forget(self.clone());
                return Err(GpuError::Silent {
                    waited: start.elapsed(),
                });
            }
        }
    }

    /// What went wrong since the device was opened, if anything did.
    pub fn trouble(&self) -> Result<(), GpuError> {
        let trouble = self.shared.trouble.lock();
        match &*trouble.unwrap_or_else(PoisonError::into_inner) {
            None => Ok(()),
            Some(error) => Err(error.clone()),
        }
    }
}

/// wgpu's token for what it calls experimental, which only ray queries need.
fn experimental_features(wanted: bool) -> wgpu::ExperimentalFeatures {
    if !wanted {
        return wgpu::ExperimentalFeatures::disabled();
    }
    // SAFETY: what is promised is to know that wgpu may have mistakes there, and to report them.
    // People ask for it by an option that says so; nothing else is opened with it.
    #[allow(unsafe_code)]
    unsafe {
        wgpu::ExperimentalFeatures::enabled()
    }
}

/// A dispatch's arguments: a piece of a buffer with those of a whole batch.
fn arguments_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("arguments"),
        entries: &[wgpu::BindGroupLayoutEntry {
            binding: 0,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: true,
                min_binding_size: std::num::NonZeroU64::new(4 * ARGUMENTS as u64),
            },
            count: None,
        }],
    })
}

/// Notes the first thing that goes wrong outside of any scope.
fn watch(device: &wgpu::Device, trouble: &Arc<Mutex<Option<GpuError>>>) {
    let note = |trouble: &Mutex<Option<GpuError>>, error: GpuError| {
        let mut first = trouble.lock().unwrap_or_else(PoisonError::into_inner);
        first.get_or_insert(error);
    };
    let lost = trouble.clone();
    device.set_device_lost_callback(move |reason, message| {
        let message = if reason == wgpu::DeviceLostReason::Destroyed {
            "it was taken away".to_owned()
        } else {
            message.split_whitespace().collect::<Vec<_>>().join(" ")
        };
        note(&lost, GpuError::Lost { message });
    });
    let refused = trouble.clone();
    device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
        let message = one_line(&error);
        let error = match error {
            wgpu::Error::OutOfMemory { .. } => GpuError::OutOfMemory {
                what: "its work".to_owned(),
                bytes: 0,
            },
            _ => GpuError::Invalid {
                what: "a command".to_owned(),
                message,
            },
        };
        note(&refused, error);
    }));
}
