//! Layers of meshes, one after the other.

use crate::device::geometry_view::{GEOMETRY_NONE, GeometryTangents};
use crate::scene::Mesh;
use crate::surface::SurfaceTables;
use glam::{Vec2, Vec4};

/// UV sets, tangents and attributes of all meshes.
#[derive(Default)]
pub(super) struct Layers {
    pub(super) uvs: Vec<[Vec2; 3]>,
    pub(super) tangents: Vec<GeometryTangents>,
    pub(super) attributes: Vec<[[f32; 4]; 3]>,
    /// See `GeometryMesh::first_layer`.
    pub(super) firsts: Vec<u32>,
}

impl Layers {
    /// Adds a mesh's layers; each is stored once, however many names mean it.
    pub(super) fn add(&mut self, mesh: &Mesh, index: u32, tables: &SurfaceTables) {
        let triangles = mesh.indices.len();
        let sets: Vec<[u32; 2]> = mesh
            .uv_sets
            .iter()
            .map(|set| {
                let tangents = set.tangents.iter().map(tangents_of);
                [
                    append(&mut self.uvs, triangles, set.corners.iter().copied()),
                    append(&mut self.tangents, triangles, tangents),
                ]
            })
            .collect();
        let attributes: Vec<u32> = mesh
            .attributes
            .iter()
            .map(|layer| {
                let corners = layer
                    .corners
                    .iter()
                    .map(|c| c.map(|value| value.to_array()));
                append(&mut self.attributes, triangles, corners)
            })
            .collect();
        for name in 0..tables.uv_names() {
            let set = sets.get(tables.uv_layer(index, name as u16));
            self.firsts
                .extend(set.copied().unwrap_or([GEOMETRY_NONE; 2]));
        }
        for name in 0..tables.attribute_names() {
            let layer = attributes.get(tables.attribute_layer(index, name as u16));
            self.firsts.push(layer.copied().unwrap_or(GEOMETRY_NONE));
        }
    }
}

fn tangents_of(corners: &[Vec4; 3]) -> GeometryTangents {
    GeometryTangents {
        corners: corners.map(Vec4::truncate),
        sign: corners[0].w,
    }
}

/// Appends a layer and gives its first entry; none, if it does not have one for each triangle.
pub(super) fn append<T>(
    all: &mut Vec<T>,
    triangles: usize,
    layer: impl ExactSizeIterator<Item = T>,
) -> u32 {
    if layer.len() != triangles || triangles == 0 {
        return GEOMETRY_NONE;
    }
    let first = all.len() as u32;
    all.extend(layer);
    first
}
