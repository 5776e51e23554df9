//! The scene in acceleration structures of the device's own, for its ray queries
//! (`wgsl/traverse_query.wgsl`): one for each mesh, and one over the instances.

use super::bodies::{Geometry, Plan, StructureLimits, is_sound};
use crate::device::Device;
use crate::error::GpuError;
use crate::memory::{buffer, transfer};
use glam::Affine3A;
use matcha_render::accel::Accel;
use matcha_render::scene::Scene;

/// Triangles that are built together: memory for building is bounded.
const TOGETHER: usize = 1 << 21;

/// Bytes of a vertex, and of a triangle's indices.
const ELEMENT: u64 = 12;

impl StructureLimits {
    fn of(device: &Device) -> StructureLimits {
        let limits = device.raw().limits();
        let buffer = (limits.max_buffer_size / ELEMENT).min(u64::from(u32::MAX / 3)) as u32;
        StructureLimits {
            triangles: limits.max_blas_primitive_count.min(buffer),
            instances: limits.max_tlas_instance_count,
        }
    }
}

/// Builds the structure of a scene with the visibility that the processor's has now.
///
/// # Errors
/// If the scene is more than the device's structures hold, or the device has no memory.
pub fn structure(device: &Device, scene: &Scene, accel: &Accel) -> Result<wgpu::Tlas, GpuError> {
    let plan = Plan::new(scene, accel.tree().masks, &StructureLimits::of(device));
    let plan = plan.map_err(|error| GpuError::Scene(error.to_string()))?;
    let mut builder = Builder::new(device);
    let mut built = Vec::with_capacity(plan.bodies.len());
    for body in &plan.bodies {
        built.push(match Geometry::of(body, scene) {
            Some(geometry) => Some((builder.add(&geometry)?, geometry.bounds)),
            None => None,
        });
    }
    builder.flush()?;
    let instances: Vec<wgpu::TlasInstance> = plan
        .stands
        .iter()
        .filter_map(|stand| {
            let (blas, bounds) = built[stand.body].as_ref()?;
            let place = rows(&stand.transform);
            is_sound(bounds, &stand.transform)
                .then(|| wgpu::TlasInstance::new(blas, place, stand.instance, stand.mask))
        })
        .collect();
    over(device, instances)
}

/// The rows of a transform.
fn rows(transform: &Affine3A) -> [f32; 12] {
    let matrix = transform.matrix3;
    let columns = [
        matrix.x_axis,
        matrix.y_axis,
        matrix.z_axis,
        transform.translation,
    ];
    std::array::from_fn(|k| columns[k % 4][k / 4])
}

/// The structure over instances.
fn over(device: &Device, instances: Vec<wgpu::TlasInstance>) -> Result<wgpu::Tlas, GpuError> {
    let count = instances.len();
    let mut structure = device.create("the instances' structure", 0, |raw| {
        raw.create_tlas(&wgpu::CreateTlasDescriptor {
            label: Some("instances"),
            max_instances: count.max(1) as u32,
            flags: wgpu::AccelerationStructureFlags::PREFER_FAST_TRACE,
            update_mode: wgpu::AccelerationStructureUpdateMode::Build,
        })
    })?;
    for (k, instance) in instances.into_iter().enumerate() {
        structure[k] = Some(instance);
    }
    let mut commands = device.raw().create_command_encoder(&Default::default());
    commands.build_acceleration_structures([], [&structure]);
    let submission = device.submit(commands);
    device.wait(&submission)?;
    device.trouble()?;
    Ok(structure)
}

/// A mesh's structure that is to be built.
struct Pending {
    blas: wgpu::Blas,
    size: wgpu::BlasTriangleGeometrySizeDescriptor,
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
}

/// Builds structures of meshes, some at a time.
struct Builder<'d> {
    device: &'d Device,
    pending: Vec<Pending>,
    triangles: usize,
}

impl<'d> Builder<'d> {
    fn new(device: &'d Device) -> Self {
        Builder {
            device,
            pending: Vec::new(),
            triangles: 0,
        }
    }

    fn add(&mut self, geometry: &Geometry) -> Result<wgpu::Blas, GpuError> {
        if self.triangles + geometry.indices.len() > TOGETHER {
            self.flush()?;
        }
        self.triangles += geometry.indices.len();
        let size = wgpu::BlasTriangleGeometrySizeDescriptor {
            vertex_format: wgpu::VertexFormat::Float32x3,
            vertex_count: geometry.positions.len() as u32,
            index_format: Some(wgpu::IndexFormat::Uint32),
            index_count: Some(3 * geometry.indices.len() as u32),
            flags: wgpu::AccelerationStructureGeometryFlags::OPAQUE,
        };
        let blas = self.device.create("a mesh's structure", 0, |raw| {
            raw.create_blas(
                &wgpu::CreateBlasDescriptor {
                    label: Some("mesh"),
                    flags: wgpu::AccelerationStructureFlags::PREFER_FAST_TRACE,
                    update_mode: wgpu::AccelerationStructureUpdateMode::Build,
                },
                wgpu::BlasGeometrySizeDescriptors::Triangles {
                    descriptors: vec![size.clone()],
                },
            )
        })?;
        self.pending.push(Pending {
            blas: blas.clone(),
            size,
            vertices: self.input(bytemuck::cast_slice(&geometry.positions))?,
            indices: self.input(bytemuck::cast_slice(&geometry.indices))?,
        });
        Ok(blas)
    }

    /// Words that a structure is built from.
    fn input(&self, words: &[u32]) -> Result<wgpu::Buffer, GpuError> {
        let usage = wgpu::BufferUsages::BLAS_INPUT | wgpu::BufferUsages::COPY_DST;
        let input = buffer(self.device, "a mesh", 4 * words.len() as u64, usage)?;
        transfer::upload(self.device, &input, 0, words)?;
        Ok(input)
    }

    /// Builds what is pending, and lets go of what it is built from.
    fn flush(&mut self) -> Result<(), GpuError> {
        let pending = std::mem::take(&mut self.pending);
        self.triangles = 0;
        let entries: Vec<wgpu::BlasBuildEntry> = pending
            .iter()
            .map(|pending| wgpu::BlasBuildEntry {
                blas: &pending.blas,
                geometry: wgpu::BlasGeometries::TriangleGeometries(vec![
                    wgpu::BlasTriangleGeometry {
                        size: &pending.size,
                        vertex_buffer: &pending.vertices,
                        first_vertex: 0,
                        vertex_stride: ELEMENT,
                        index_buffer: Some(&pending.indices),
                        first_index: Some(0),
                        transform_buffer: None,
                        transform_buffer_offset: None,
                    },
                ]),
            })
            .collect();
        if entries.is_empty() {
            return Ok(());
        }
        let mut commands = self
            .device
            .raw()
            .create_command_encoder(&Default::default());
        commands.build_acceleration_structures(&entries, []);
        let submission = self.device.submit(commands);
        self.device.wait(&submission)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Mat3, Vec3};

    #[test]
    fn transforms_are_told_in_rows() {
        let matrix = Mat3::from_cols(Vec3::X, Vec3::Y * 2.0, Vec3::new(7.0, 0.0, 3.0));
        let transform = Affine3A::from_mat3_translation(matrix, Vec3::new(4.0, 5.0, 6.0));
        let expected = [1.0, 0.0, 7.0, 4.0, 0.0, 2.0, 0.0, 5.0, 0.0, 0.0, 3.0, 6.0];
        assert_eq!(rows(&transform), expected);
    }
}
