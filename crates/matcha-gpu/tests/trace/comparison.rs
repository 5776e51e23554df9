//! Both devices' answers to the same rays.

use matcha_gpu::GpuError;
use matcha_gpu::batch::{Extent, Runner};
use matcha_gpu::device::Device;
use matcha_gpu::memory::{Memory, Sections};
use matcha_gpu::pipeline::{KernelSource, Pipelines};
use matcha_gpu::shader::Library;
use matcha_gpu::trace::{HIT_ROWS, WideTree, hits_of_rows, ray_rows};
use matcha_render::accel::{Accel, Hit, Ray};
use std::time::Duration;

/// A hierarchy and rays on the device.
pub struct Tracer {
    device: Device,
    library: Library,
    memory: Memory,
    rays: u32,
}

impl Tracer {
    pub fn new(device: &Device, tree: &WideTree, rays: &[Ray]) -> Result<Tracer, GpuError> {
        let mut library = Library::embedded(device.report().atomics_64)?;
        library.set_constant("TRACE_STACK", tree.stack())?;
        let mut sections = Sections::new();
        sections.filled(&library, "bvh_nodes", bytemuck::cast_slice(&tree.nodes))?;
        let triangles: &[u32] = bytemuck::cast_slice(&tree.triangles);
        sections.filled(&library, "bvh_triangles", triangles)?;
        Tracer::over(device, library, sections, rays)
    }

    /// A scene in whatever sections the library's kernels read, and rays on the device.
    pub fn over(
        device: &Device,
        library: Library,
        mut sections: Sections,
        rays: &[Ray],
    ) -> Result<Tracer, GpuError> {
        sections.filled(&library, "trace_rays", ray_rows(rays))?;
        sections.zeroed(&library, "trace_hits", (HIT_ROWS * rays.len()) as u64)?;
        Ok(Tracer {
            memory: sections.place(device, 1, &[])?,
            device: device.clone(),
            library,
            rays: rays.len() as u32,
        })
    }

    /// What the device finds, nearest hits or for `trace_occluded_rays` the instances alone; and
    /// how long it took.
    pub fn trace(&self, entry: &str) -> Result<(Vec<Option<Hit>>, Duration), GpuError> {
        let memories = [&self.memory];
        let kernel = Pipelines::new(&self.device, None).kernel(&KernelSource {
            name: entry,
            library: &self.library,
            memories: &memories,
            constants: &[],
        })?;
        let mut runner = Runner::new(&self.device)?;
        let mut batch = runner.batch();
        batch.dispatch(
            "trace",
            &kernel,
            &memories,
            &[self.rays],
            Extent::Items(self.rays),
        );
        let time = batch.run()?.wall;
        let rows = self
            .memory
            .read("trace_hits", 0, self.memory.length("trace_hits")?)?;
        Ok((hits_of_rows(&rows), time))
    }
}

/// How two devices' answers differ.
#[derive(Debug, Default)]
pub struct Difference {
    /// Rays that meet another triangle, or one where the other device meets none.
    pub other: usize,
    /// Of those, such that are no ties: not at the same distance up to rounding.
    pub wrong: usize,
    /// Rays whose shadow differs.
    pub shadows: usize,
    /// Largest difference of distances (relative) and weights on the same triangle.
    pub largest: f32,
    /// Rays that meet anything.
    pub hits: usize,
}

/// Answers that differ.
pub fn compare(tracer: &Tracer, accel: &Accel, rays: &[Ray]) -> Result<Difference, GpuError> {
    let (found, _) = tracer.trace("trace_closest_rays")?;
    let (shadows, _) = tracer.trace("trace_occluded_rays")?;
    let mut difference = Difference::default();
    for ((ray, found), shadow) in rays.iter().zip(found).zip(shadows) {
        let expected = accel.closest(ray);
        difference.hits += usize::from(expected.is_some());
        difference.shadows += usize::from(shadow.is_some() != accel.occluded(ray));
        match (expected, found) {
            (None, None) => {}
            (Some(a), Some(b)) if (a.instance, a.primitive) == (b.instance, b.primitive) => {
                let off = ((a.t - b.t) / a.t)
                    .abs()
                    .max((a.u - b.u).abs())
                    .max((a.v - b.v).abs());
                difference.largest = difference.largest.max(off);
            }
            (Some(a), Some(b)) => {
                difference.other += 1;
                difference.wrong += usize::from(((a.t - b.t) / a.t).abs() > 1e-5);
            }
            _ => {
                difference.other += 1;
                difference.wrong += 1;
            }
        }
    }
    Ok(difference)
}
