//! Batches of dispatches: handed over together, waited for together, timed one by one.

use crate::device::Device;
use crate::error::GpuError;
use crate::memory::transfer::mapped_words;
use crate::memory::{Memory, buffer};
use crate::pipeline::Kernel;
use crate::shader::prelude::{ARGUMENTS, COLUMNS};
use std::collections::BTreeMap;
use std::time::{Duration, Instant};

/// Most dispatches of a batch: twice as many timestamps fit into one set of queries.
pub const MOST_DISPATCHES: usize = 1024;

/// How many invocations a dispatch has.
#[derive(Clone, Copy)]
pub enum Extent<'a> {
    /// So many, rounded up to whole workgroups.
    Items(u32),
    /// Numbers of workgroups (three words, see [`workgroups`]) at a byte of a buffer.
    Indirect(&'a wgpu::Buffer, u64),
}

/// Numbers of workgroups in both dimensions: a row has at most [`COLUMNS`].
pub fn workgroups(count: u32) -> [u32; 3] {
    [count.min(COLUMNS), count.div_ceil(COLUMNS), 1]
}

/// Runs batches on a device and sums times.
pub struct Runner {
    device: Device,
    arguments: wgpu::Buffer,
    /// Bytes from one dispatch's arguments to the next one's.
    stride: usize,
    bind_group: wgpu::BindGroup,
    timer: Option<Timer>,
    seconds: BTreeMap<&'static str, f64>,
}

/// Timestamps and the way back.
struct Timer {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    staging: wgpu::Buffer,
    /// Nanoseconds of a tick.
    period: f64,
}

impl Runner {
    /// A runner of a device.
    ///
    /// # Errors
    /// If the device has no memory.
    pub fn new(device: &Device) -> Result<Runner, GpuError> {
        let alignment = device.raw().limits().min_uniform_buffer_offset_alignment as usize;
        let stride = (4 * ARGUMENTS).next_multiple_of(alignment);
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let bytes = (stride * MOST_DISPATCHES) as u64;
        let arguments = buffer(device, "arguments", bytes, usage)?;
        let bind_group = device.create("arguments", 0, |raw| {
            raw.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("arguments"),
                layout: device.arguments_layout(),
                entries: &[wgpu::BindGroupEntry {
                    binding: 0,
                    resource: wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                        buffer: &arguments,
                        offset: 0,
                        size: std::num::NonZeroU64::new(4 * ARGUMENTS as u64),
                    }),
                }],
            })
        })?;
        let timestamps = device
            .raw()
            .features()
            .contains(wgpu::Features::TIMESTAMP_QUERY);
        Ok(Runner {
            timer: timestamps.then(|| Timer::new(device)).transpose()?,
            device: device.clone(),
            arguments,
            stride,
            bind_group,
            seconds: BTreeMap::new(),
        })
    }

    /// An empty batch.
    pub fn batch(&mut self) -> Batch<'_> {
        let commands = self
            .device
            .raw()
            .create_command_encoder(&Default::default());
        Batch {
            runner: self,
            commands,
            stages: Vec::new(),
            arguments: Vec::new(),
        }
    }

    /// Device time of each stage so far, seconds; empty where the device has no timestamps.
    pub fn stage_seconds(&self) -> &BTreeMap<&'static str, f64> {
        &self.seconds
    }
}

/// Dispatches in order; each sees what those before it wrote.
pub struct Batch<'r> {
    runner: &'r mut Runner,
    commands: wgpu::CommandEncoder,
    stages: Vec<&'static str>,
    arguments: Vec<u8>,
}

/// What a batch took.
#[derive(Clone, Debug, PartialEq)]
pub struct BatchTime {
    /// From handing over to the end, wall-clock.
    pub wall: Duration,
    /// Device time of each dispatch, with its stage; empty where there are no timestamps.
    pub dispatches: Vec<(&'static str, Duration)>,
}

impl Batch<'_> {
    /// Dispatches that still have a place in the batch.
    pub fn room(&self) -> usize {
        MOST_DISPATCHES - self.stages.len()
    }

    /// Other commands between dispatches: copies, zeros.
    pub fn commands(&mut self) -> &mut wgpu::CommandEncoder {
        &mut self.commands
    }

    /// Adds a dispatch. `stage` is what its time is counted for; `arguments` are what the
    /// kernel's `argument(k)` gives; `memories` must be those that it was compiled for.
    ///
    /// # Panics
    /// If there is no [`Batch::room`], or there are more than 16 arguments.
    pub fn dispatch(
        &mut self,
        stage: &'static str,
        kernel: &Kernel,
        memories: &[&Memory],
        arguments: &[u32],
        extent: Extent,
    ) {
        let index = self.stages.len();
        assert!(index < MOST_DISPATCHES && arguments.len() <= ARGUMENTS);
        self.stages.push(stage);
        let start = index * self.runner.stride;
        self.arguments.resize(start + self.runner.stride, 0);
        let bytes: &[u8] = bytemuck::cast_slice(arguments);
        self.arguments[start..start + bytes.len()].copy_from_slice(bytes);
        let timestamps = self
            .runner
            .timer
            .as_ref()
            .map(|timer| wgpu::ComputePassTimestampWrites {
                query_set: &timer.queries,
                beginning_of_pass_write_index: Some(2 * index as u32),
                end_of_pass_write_index: Some(2 * index as u32 + 1),
            });
        let mut pass = self
            .commands
            .begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some(kernel.name()),
                timestamp_writes: timestamps,
            });
        pass.set_pipeline(kernel.pipeline());
        pass.set_bind_group(0, &self.runner.bind_group, &[start as u32]);
        for memory in memories {
            pass.set_bind_group(memory.group(), memory.bind_group(), &[]);
        }
        match extent {
            Extent::Items(items) => {
                let [x, y, z] = workgroups(items.div_ceil(kernel.workgroup()));
                pass.dispatch_workgroups(x, y, z);
            }
            Extent::Indirect(buffer, offset) => pass.dispatch_workgroups_indirect(buffer, offset),
        }
    }

    /// Hands the batch over and waits until it is done.
    ///
    /// # Errors
    /// If the device fails.
    pub fn run(mut self) -> Result<BatchTime, GpuError> {
        let start = Instant::now();
        let runner = self.runner;
        let device = &runner.device;
        device
            .queue()
            .write_buffer(&runner.arguments, 0, &self.arguments);
        let queries = 2 * self.stages.len() as u32;
        let timer = runner.timer.as_ref().filter(|_| queries > 0);
        if let Some(timer) = timer {
            timer.resolve(&mut self.commands, queries);
        }
        let submission = device.submit(self.commands);
        let ticks = match timer {
            Some(timer) => {
                let bytes = u64::from(queries) * 8;
                mapped_words(device, &timer.staging, bytes, &submission)?
            }
            None => {
                device.wait(&submission)?;
                Vec::new()
            }
        };
        let period = timer.map_or(0.0, |timer| timer.period);
        let mut dispatches = Vec::new();
        for (stage, ticks) in self.stages.iter().zip(ticks.as_chunks::<4>().0) {
            let at = |k: usize| u64::from(ticks[k]) | u64::from(ticks[k + 1]) << 32;
            // Some drivers set the clock back when they wake up.
            let seconds = at(2).saturating_sub(at(0)) as f64 * period * 1e-9;
            *runner.seconds.entry(stage).or_default() += seconds;
            dispatches.push((*stage, Duration::from_secs_f64(seconds)));
        }
        Ok(BatchTime {
            wall: start.elapsed(),
            dispatches,
        })
    }
}

impl Timer {
    fn new(device: &Device) -> Result<Timer, GpuError> {
        let count = 2 * MOST_DISPATCHES as u32;
        let bytes = u64::from(count) * 8;
        let queries = device.create("timestamps", bytes, |device| {
            device.create_query_set(&wgpu::QuerySetDescriptor {
                label: None,
                ty: wgpu::QueryType::Timestamp,
                count,
            })
        })?;
        let resolved = wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC;
        let staging = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST;
        Ok(Timer {
            queries,
            resolved: buffer(device, "timestamps", bytes, resolved)?,
            staging: buffer(device, "timestamps", bytes, staging)?,
            period: f64::from(device.queue().get_timestamp_period()),
        })
    }

    fn resolve(&self, commands: &mut wgpu::CommandEncoder, queries: u32) {
        let bytes = u64::from(queries) * 8;
        commands.resolve_query_set(&self.queries, 0..queries, &self.resolved, 0);
        commands.copy_buffer_to_buffer(&self.resolved, 0, &self.staging, 0, bytes);
    }
}
