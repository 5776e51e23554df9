//! From a hit to a point: what is stored of its triangle, for `device::surface_point`.

use super::tables::SurfaceTables;
use crate::accel::Hit;
use crate::device::surface_path::PathInfo;
use crate::device::surface_point::{SurfacePoint, SurfaceTriangle, surface_point};
use crate::scene::Scene;
use glam::{Vec2, Vec3};

impl SurfaceTables {
    /// The point that a ray hit, and its footprint. `hit.t` is in metres: the ray's direction was
    /// of unit length.
    pub fn point(&self, scene: &Scene, hit: &Hit, path: &PathInfo) -> SurfacePoint {
        let instance = &scene.instances[hit.instance as usize];
        let mesh = &scene.meshes[instance.mesh as usize];
        let normals = mesh.corner_normals.get(hit.primitive as usize);
        let triangle = SurfaceTriangle {
            corners: mesh.indices[hit.primitive as usize].map(|v| mesh.positions[v as usize]),
            normals: normals.copied().unwrap_or([Vec3::ZERO; 3]),
            is_flat: normals.is_none(),
        };
        surface_point(
            hit.instance,
            hit.primitive,
            hit.t,
            Vec2::new(hit.u, hit.v),
            &triangle,
            &self.placed[hit.instance as usize],
            *path,
        )
    }
}
