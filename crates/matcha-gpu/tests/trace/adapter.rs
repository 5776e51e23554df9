//! A device and what it takes to run kernels on buffers.

use std::fmt::Write as _;
use std::io::Write as _;
use wgpu::util::DeviceExt;

/// A device with compute.
pub struct Device {
    device: wgpu::Device,
    queue: wgpu::Queue,
}

static SKIPPED: std::sync::Once = std::sync::Once::new();

fn skipped(error: &wgpu::RequestAdapterError) {
    let mut out = std::io::stderr().lock();
    let line =
        "SKIPPED: no graphics adapter; the device's walk was not compared with the processor's";
    writeln!(out, "{line} ({error})").expect("standard error is open");
}

/// A buffer of a kernel.
pub struct Section<'a> {
    pub name: &'a str,
    pub class: &'a str,
    pub stride: usize,
    pub words: &'a [u32],
}

fn accessors(sections: &[Section]) -> String {
    let mut text = String::new();
    for (i, section) in sections.iter().enumerate() {
        let Section {
            name,
            class,
            stride,
            ..
        } = section;
        let (access, ty) = match *class {
            "read" => ("read", "u32"),
            "read4" => ("read", "vec4u"),
            "write" => ("read_write", "u32"),
            other => panic!("{other}"),
        };
        let load = if ty == "u32" { "word" } else { "quad" };
        let _ = writeln!(
            text,
            "@group(0) @binding({i}) var<storage, {access}> s_{name}: array<{ty}>;
            fn {load}_{name}(i: u32) -> {ty} {{ return s_{name}[i]; }}
            fn count_{name}() -> u32 {{ return arrayLength(&s_{name}) / {stride}u; }}"
        );
        if access == "read_write" {
            let _ = writeln!(
                text,
                "fn put_{name}(i: u32, word: {ty}) {{ s_{name}[i] = word; }}"
            );
        }
    }
    text
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
        let limits = adapter.limits();
        let wanted = wgpu::DeviceDescriptor {
            required_limits: limits,
            ..Default::default()
        };
        let (device, queue) =
            pollster::block_on(adapter.request_device(&wanted)).expect("a device");
        Some(Device { device, queue })
    }

    /// Makes a kernel; `wgsl` reaches its buffers by accessors.
    pub fn kernel(&self, wgsl: &str, sections: &[Section], entry: &str) -> wgpu::ComputePipeline {
        let source = format!("{}{wgsl}", accessors(sections));
        let shader = self
            .device
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: None,
                source: wgpu::ShaderSource::Wgsl(source.into()),
            });
        self.device
            .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: None,
                layout: None,
                module: &shader,
                entry_point: Some(entry),
                compilation_options: Default::default(),
                cache: None,
            })
    }

    /// Runs a kernel and returns what is in the last buffer then.
    pub fn run(
        &self,
        kernel: &wgpu::ComputePipeline,
        sections: &[Section],
        invocations: usize,
    ) -> Vec<u32> {
        let buffers: Vec<wgpu::Buffer> = sections
            .iter()
            .map(|section| {
                self.device
                    .create_buffer_init(&wgpu::util::BufferInitDescriptor {
                        label: Some(section.name),
                        contents: bytemuck::cast_slice(section.words),
                        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
                    })
            })
            .collect();
        let entries: Vec<wgpu::BindGroupEntry> = buffers
            .iter()
            .zip(0..)
            .map(|(buffer, binding)| wgpu::BindGroupEntry {
                binding,
                resource: buffer.as_entire_binding(),
            })
            .collect();
        let group = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &kernel.get_bind_group_layout(0),
            entries: &entries,
        });
        let mut commands = self.device.create_command_encoder(&Default::default());
        {
            let mut pass = commands.begin_compute_pass(&Default::default());
            pass.set_pipeline(kernel);
            pass.set_bind_group(0, &group, &[]);
            let groups = invocations.div_ceil(64) as u32;
            pass.dispatch_workgroups(groups.min(4096), groups.div_ceil(4096), 1);
        }
        let last = buffers.last().expect("a buffer");
        let read = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: last.size(),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        commands.copy_buffer_to_buffer(last, 0, &read, 0, last.size());
        self.queue.submit([commands.finish()]);
        read.map_async(wgpu::MapMode::Read, .., |mapped| {
            mapped.expect("the results map")
        });
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .expect("the device finishes");
        let bytes = read.get_mapped_range(..).expect("the results are mapped");
        bytemuck::pod_collect_to_vec(&bytes)
    }
}
