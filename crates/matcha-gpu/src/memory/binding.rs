//! Bindings of a group.

use super::placement::Placement;
use crate::device::Device;
use crate::error::GpuError;

/// The layout of a group: the header, arenas, acceleration structures.
pub(super) fn layout(
    device: &Device,
    placement: &Placement,
    structures: usize,
) -> Result<wgpu::BindGroupLayout, GpuError> {
    let buffer = |ty| wgpu::BindingType::Buffer {
        ty,
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    let mut types = vec![buffer(wgpu::BufferBindingType::Uniform)];
    for arena in &placement.arenas {
        let read_only = arena.class.read_only();
        types.push(buffer(wgpu::BufferBindingType::Storage { read_only }));
    }
    for _ in 0..structures {
        types.push(wgpu::BindingType::AccelerationStructure {
            vertex_return: false,
        });
    }
    let entry = |(binding, ty)| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty,
        count: None,
    };
    let entries: Vec<_> = (0..).zip(types).map(entry).collect();
    device.create("a layout", 0, |device| {
        device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: None,
            entries: &entries,
        })
    })
}

/// The group itself.
pub(super) fn bind_group(
    device: &Device,
    layout: &wgpu::BindGroupLayout,
    header: &wgpu::Buffer,
    arenas: &[wgpu::Buffer],
    structures: &[(String, wgpu::Tlas)],
) -> Result<wgpu::BindGroup, GpuError> {
    let buffers = [header].into_iter().chain(arenas);
    let resources = buffers
        .map(wgpu::Buffer::as_entire_binding)
        .chain(structures.iter().map(|(_, s)| s.as_binding()));
    let entries: Vec<wgpu::BindGroupEntry> = (0..)
        .zip(resources)
        .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource })
        .collect();
    device.create("bindings", 0, |device| {
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout,
            entries: &entries,
        })
    })
}
