//! A scene in the device's memory: group 1.

use crate::device::Device;
use crate::error::GpuError;
use crate::memory::{Memory, Sections};
use crate::shader::Library;
use crate::trace::{self, WideTree};
use matcha_render::flat::FlatScene;
use matcha_render::prepare::Prepared;

/// Number of the bind group.
const GROUP: u32 = 1;

/// Places a scene; tells the library what kernels must know of it.
pub(super) fn place(
    device: &Device,
    library: &mut Library,
    prepared: &Prepared,
    flat: &FlatScene,
    others: &[&Memory],
) -> Result<Memory, GpuError> {
    let mut sections = Sections::new();
    flat.sections(|section| sections.filled(library, section.name, section.words.to_vec()))?;
    sections.filled(library, "light_programs", flat.light_programs().to_vec())?;
    if device.has_ray_queries() {
        let structure = trace::structure(device, prepared.scene(), prepared.accel())?;
        sections.structure("trace_scene", structure);
        return sections.place(device, GROUP, others);
    }
    let tree =
        WideTree::new(prepared.accel()).map_err(|error| GpuError::Scene(error.to_string()))?;
    library.set_constant("TRACE_STACK", tree.stack())?;
    let [nodes, triangles]: [&[u32]; 2] = [
        bytemuck::cast_slice(&tree.nodes),
        bytemuck::cast_slice(&tree.triangles),
    ];
    sections.filled(library, "bvh_nodes", nodes)?;
    sections.filled(library, "bvh_triangles", triangles)?;
    sections.place(device, GROUP, others)
}
