//! A device and what it takes to run a function on it.

use std::io::Write;
use wgpu::util::DeviceExt;

/// A device with compute.
pub struct Device {
    device: wgpu::Device,
    queue: wgpu::Queue,
    /// What it is.
    pub name: String,
}

/// Words that a point gives, and takes.
pub const INPUTS: usize = 12;
/// Words of a point's result.
pub const OUTPUTS: usize = 4;

/// What every shader is wrapped into: `run` gives the result's bits of a point.
const HOST: &str = "
@group(0) @binding(0) var<storage, read> inputs: array<u32>;
@group(0) @binding(1) var<storage, read_write> results: array<u32>;

struct Point { first: u32 }

fn row(point: Point, i: u32) -> f32 {
    return bitcast<f32>(inputs[point.first + i]);
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x * 4u >= arrayLength(&results) {
        return;
    }
    let result = run(Point(id.x * 13u), inputs[id.x * 13u + 12u]);
    results[id.x * 4u] = result.x;
    results[id.x * 4u + 1u] = result.y;
    results[id.x * 4u + 2u] = result.z;
    results[id.x * 4u + 3u] = result.w;
}
";

/// A point: the operands' words, then the immediate.
pub type Point = [u32; INPUTS + 1];

static SKIPPED: std::sync::Once = std::sync::Once::new();

/// Says so past the test harness, which keeps what passing tests print to itself.
fn skipped(error: &wgpu::RequestAdapterError) {
    let mut out = std::io::stderr().lock();
    let line = "SKIPPED: no graphics adapter; device code was not compared with the processor's";
    writeln!(out, "{line} ({error})").expect("standard error is open");
}

impl Device {
    /// The first adapter with compute, or `None` with a line that says so.
    pub fn find() -> Option<Device> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let options = wgpu::RequestAdapterOptions::default();
        let adapter = match pollster::block_on(instance.request_adapter(&options)) {
            Ok(adapter) => adapter,
            Err(error) => {
                SKIPPED.call_once(|| skipped(&error));
                return None;
            }
        };
        let name = format!(
            "{} ({})",
            adapter.get_info().name,
            adapter.get_info().driver_info
        );
        let (device, queue) = pollster::block_on(adapter.request_device(&Default::default()))
            .unwrap_or_else(|e| panic!("{name} gives no device: {e}"));
        Some(Device {
            device,
            queue,
            name,
        })
    }

    /// Runs WGSL that has `fn run(point: Point, immediate: u32) -> vec4u` over points.
    pub fn run(&self, wgsl: &str, points: &[Point]) -> Vec<[u32; OUTPUTS]> {
        let shader = self
            .device
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: None,
                source: wgpu::ShaderSource::Wgsl(format!("{wgsl}{HOST}").into()),
            });
        let pipeline = self
            .device
            .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: None,
                layout: None,
                module: &shader,
                entry_point: Some("main"),
                compilation_options: Default::default(),
                cache: None,
            });
        let size = (points.len() * OUTPUTS * 4) as u64;
        let inputs = self
            .device
            .create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: None,
                contents: bytemuck::cast_slice(points.as_flattened()),
                usage: wgpu::BufferUsages::STORAGE,
            });
        let results = self.buffer(
            size,
            wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        );
        let read = self.buffer(
            size,
            wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        );
        let entry = |binding, buffer: &'_ wgpu::Buffer| (binding, buffer.clone());
        let bound = [entry(0, &inputs), entry(1, &results)];
        let entries: Vec<wgpu::BindGroupEntry> = bound
            .iter()
            .map(|(binding, buffer)| wgpu::BindGroupEntry {
                binding: *binding,
                resource: buffer.as_entire_binding(),
            })
            .collect();
        let group = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        let mut commands = self.device.create_command_encoder(&Default::default());
        {
            let mut pass = commands.begin_compute_pass(&Default::default());
            pass.set_pipeline(&pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.dispatch_workgroups(points.len().div_ceil(64) as u32, 1, 1);
        }
        commands.copy_buffer_to_buffer(&results, 0, &read, 0, size);
        self.queue.submit([commands.finish()]);
        read.map_async(wgpu::MapMode::Read, .., |mapped| {
            mapped.expect("the results map")
        });
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .expect("the device finishes");
        let bytes = read.get_mapped_range(..).expect("the results are mapped");
        let words: Vec<u32> = bytemuck::pod_collect_to_vec(&bytes);
        words.as_chunks().0.to_vec()
    }

    fn buffer(&self, size: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
        self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size,
            usage,
            mapped_at_creation: false,
        })
    }
}
