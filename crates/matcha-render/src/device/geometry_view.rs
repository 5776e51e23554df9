//! A scene's surfaces in a few arrays, as graphics devices read them; `flat` makes them.

use crate::device::surface_path::PathInfo;
use crate::device::surface_point::{
    SurfacePlacement, SurfacePoint, SurfaceTriangle, surface_point,
};
use crate::device::surface_view::CameraView;
use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3};
use matcha_shade::device::math::vec3;

/// Stands for no index: a layer that a mesh lacks.
pub const GEOMETRY_NONE: u32 = 0xffff_ffff;

/// Where a mesh's data begin. Arrays of triangles hold all meshes' one after the other, each in
/// its own order; a layer's first entry belongs to the mesh's first triangle.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct GeometryMesh {
    /// Into `indices`, and `islands` where there are any.
    pub first_triangle: u32,
    /// Into `normals`, or none.
    pub first_normals: u32,
    /// Into `slots`, or none: all triangles have slot 0.
    pub first_slot: u32,
    /// Into `generated`, or none: coordinates are those of the box.
    pub first_generated: u32,
    /// Into `layers`: two words for each UV name (firsts into `uvs` and `tangents`), then one
    /// for each attribute name (first into `attributes`).
    pub first_layer: u32,
    /// Origin of the texture space.
    pub generated_origin: Vec3,
    /// Size of the texture space.
    pub generated_size: Vec3,
}

/// A placed mesh.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct GeometryInstance {
    /// Where it stands.
    pub placement: SurfacePlacement,
    /// Into `meshes`.
    pub mesh: u32,
    /// Into `materials`: one for each slot of the mesh.
    pub first_material: u32,
    /// Colour and alpha.
    pub color: [f32; 4],
    /// Pass index.
    pub pass_index: f32,
    /// Random number, 0 to 1.
    pub random: f32,
    /// 1: cuts a hole into the film.
    pub holdout: u32,
}

/// Tangents of a triangle's corners.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct GeometryTangents {
    /// Unit vectors, object space.
    pub corners: [Vec3; 3],
    /// The triangle's sign.
    pub sign: f32,
}

/// A quantity that a program reads.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct GeometryInput {
    /// As `input_pack` packs it.
    pub packed: u32,
    /// First row of the input matrix.
    pub row: u32,
}

/// All surfaces.
#[derive(Clone, Copy, Debug)]
pub struct GeometryView<'a> {
    /// Meshes.
    pub meshes: &'a [GeometryMesh],
    /// Placed meshes, in the scene's order.
    pub instances: &'a [GeometryInstance],
    /// Vertices of all triangles, into `positions`.
    pub indices: &'a [[u32; 3]],
    /// Vertices of all meshes, object space, metres.
    pub positions: &'a [Vec3],
    /// Shading normals of triangles' corners.
    pub normals: &'a [[Vec3; 3]],
    /// Material slots of triangles.
    pub slots: &'a [u32],
    /// UVs of triangles' corners.
    pub uvs: &'a [[Vec2; 3]],
    /// Tangents of triangles' corners.
    pub tangents: &'a [GeometryTangents],
    /// Attributes of triangles' corners.
    pub attributes: &'a [[[f32; 4]; 3]],
    /// Generated coordinates of triangles' corners.
    pub generated: &'a [[Vec3; 3]],
    /// See [`GeometryMesh::first_layer`].
    pub layers: &'a [u32],
    /// Random numbers of triangles' islands, where a program asks.
    pub islands: &'a [f32],
    /// Pointiness of vertices, where a program asks.
    pub pointiness: &'a [f32],
    /// Materials by instance and slot.
    pub materials: &'a [u32],
    /// Pass indices of materials.
    pub pass_indices: &'a [f32],
    /// Quantities that programs read, program after program.
    pub inputs: &'a [GeometryInput],
    /// First input of each program; one entry more than there are programs.
    pub first_inputs: &'a [u32],
    /// Number of UV names.
    pub uv_names: u32,
    /// Number of attribute names.
    pub attribute_names: u32,
    /// 1: `islands` is there.
    pub has_islands: u32,
    /// 1: `pointiness` is there.
    pub has_pointiness: u32,
    /// The camera, for the coordinates that depend on it.
    pub camera: CameraView,
}

/// Number of a triangle among all meshes'.
#[inline]
pub fn geometry_triangle(view: GeometryView, instance: u32, primitive: u32) -> u32 {
    let mesh = view.instances[instance as usize].mesh;
    view.meshes[mesh as usize].first_triangle + primitive
}

/// Positions of a triangle's corners, object space; `triangle` is its number among all meshes'.
#[inline]
pub fn geometry_corners(view: GeometryView, triangle: u32) -> [Vec3; 3] {
    let vertices = view.indices[triangle as usize];
    [
        view.positions[vertices[0] as usize],
        view.positions[vertices[1] as usize],
        view.positions[vertices[2] as usize],
    ]
}

/// Material of a triangle of an instance: index into `Scene::materials`.
#[inline]
pub fn geometry_material(view: GeometryView, instance: u32, primitive: u32) -> u32 {
    let mesh = view.instances[instance as usize].mesh;
    let first_slot = view.meshes[mesh as usize].first_slot;
    let mut slot = 0;
    if first_slot != GEOMETRY_NONE {
        slot = view.slots[(first_slot + primitive) as usize];
    }
    view.materials[(view.instances[instance as usize].first_material + slot) as usize]
}

/// The point that a ray hit, `distance` metres from where the ray began, and its footprint.
/// `weights` are those of the triangle's second and third corners.
#[inline]
pub fn geometry_point(
    view: GeometryView,
    instance: u32,
    primitive: u32,
    distance: f32,
    weights: Vec2,
    path: PathInfo,
) -> SurfacePoint {
    let mesh = view.instances[instance as usize].mesh;
    let first_normals = view.meshes[mesh as usize].first_normals;
    let zero = vec3(0.0, 0.0, 0.0);
    let mut triangle = SurfaceTriangle {
        corners: geometry_corners(view, geometry_triangle(view, instance, primitive)),
        normals: [zero, zero, zero],
        is_flat: first_normals == GEOMETRY_NONE,
    };
    if first_normals != GEOMETRY_NONE {
        triangle.normals = view.normals[(first_normals + primitive) as usize];
    }
    let placement = view.instances[instance as usize].placement;
    surface_point(
        instance, primitive, distance, weights, &triangle, &placement, path,
    )
}

/// Whether an instance cuts a hole into the film.
#[inline]
pub fn geometry_holdout(view: GeometryView, instance: u32) -> bool {
    view.instances[instance as usize].holdout != 0
}
