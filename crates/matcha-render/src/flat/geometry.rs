//! Meshes and instances.

use super::layers::{Layers, append};
use super::{Section, sections};
use crate::device::geometry_view::{
    GeometryInput, GeometryInstance, GeometryMesh, GeometryTangents, GeometryView,
};
use crate::device::surface_view::CameraView;
use crate::prepare::Prepared;
use crate::scene::{Instance, Mesh, Scene};
use crate::surface::SurfaceTables;
use glam::{Vec2, Vec3};
use matcha_shade::program::Program;
use std::collections::HashMap;

/// What [`GeometryView`] reads.
pub struct FlatGeometry {
    meshes: Vec<GeometryMesh>,
    instances: Vec<GeometryInstance>,
    indices: Vec<[u32; 3]>,
    positions: Vec<Vec3>,
    normals: Vec<[Vec3; 3]>,
    slots: Vec<u32>,
    uvs: Vec<[Vec2; 3]>,
    tangents: Vec<GeometryTangents>,
    attributes: Vec<[[f32; 4]; 3]>,
    generated: Vec<[Vec3; 3]>,
    layers: Vec<u32>,
    islands: Vec<f32>,
    pointiness: Vec<f32>,
    materials: Vec<u32>,
    pass_indices: Vec<f32>,
    inputs: Vec<GeometryInput>,
    first_inputs: Vec<u32>,
    uv_names: u32,
    attribute_names: u32,
    has_islands: u32,
    has_pointiness: u32,
    camera: CameraView,
}

impl FlatGeometry {
    /// All surfaces of a prepared scene; `programs` in the order in which their inputs shall be
    /// found.
    pub fn new<'p>(prepared: &Prepared, programs: impl IntoIterator<Item = &'p Program>) -> Self {
        let mut flat = Self::of_scene(prepared.scene(), &prepared.surfaces, prepared.view);
        for program in programs {
            let inputs = program.inputs.iter().map(|&(input, row)| GeometryInput {
                packed: input.packed(),
                row: row as u32,
            });
            flat.inputs.extend(inputs);
            flat.first_inputs.push(flat.inputs.len() as u32);
        }
        flat
    }

    /// All surfaces of a scene that has been prepared in parts; without inputs of programs.
    pub fn of_scene(scene: &Scene, tables: &SurfaceTables, camera: CameraView) -> Self {
        let mut flat = Self {
            meshes: Vec::new(),
            instances: Vec::new(),
            indices: Vec::new(),
            positions: Vec::new(),
            normals: Vec::new(),
            slots: Vec::new(),
            uvs: Vec::new(),
            tangents: Vec::new(),
            attributes: Vec::new(),
            generated: Vec::new(),
            layers: Vec::new(),
            islands: tables.islands.concat(),
            pointiness: tables.pointiness.concat(),
            materials: Vec::new(),
            pass_indices: scene.materials.iter().map(|m| m.pass_index).collect(),
            inputs: Vec::new(),
            first_inputs: vec![0],
            uv_names: tables.uv_names() as u32,
            attribute_names: tables.attribute_names() as u32,
            has_islands: u32::from(!tables.islands.is_empty()),
            has_pointiness: u32::from(!tables.pointiness.is_empty()),
            camera,
        };
        let mut layers = Layers::default();
        for (index, mesh) in (0..).zip(&scene.meshes) {
            let first_layer = layers.firsts.len() as u32;
            flat.add_mesh(mesh, first_layer);
            layers.add(mesh, index, tables);
        }
        (flat.uvs, flat.tangents) = (layers.uvs, layers.tangents);
        (flat.attributes, flat.layers) = (layers.attributes, layers.firsts);
        flat.add_instances(scene, tables);
        flat
    }

    fn add_mesh(&mut self, mesh: &Mesh, first_layer: u32) {
        let first_vertex = self.positions.len() as u32;
        let triangles = mesh.indices.len();
        self.meshes.push(GeometryMesh {
            first_triangle: self.indices.len() as u32,
            first_normals: append(
                &mut self.normals,
                triangles,
                mesh.corner_normals.iter().copied(),
            ),
            first_slot: append(
                &mut self.slots,
                triangles,
                mesh.slots.iter().map(|&slot| u32::from(slot)),
            ),
            first_generated: append(
                &mut self.generated,
                triangles,
                mesh.generated.iter().copied(),
            ),
            first_layer,
            generated_origin: mesh.generated_origin,
            generated_size: mesh.generated_size,
        });
        let moved = |triangle: &[u32; 3]| triangle.map(|vertex| vertex + first_vertex);
        self.indices.extend(mesh.indices.iter().map(moved));
        self.positions.extend(&mesh.positions);
    }

    fn add_instances(&mut self, scene: &Scene, tables: &SurfaceTables) {
        // Instances with the same mesh and the same materials share their entries.
        let mut known: HashMap<(u32, &[u32]), u32> = HashMap::new();
        for (instance, placement) in scene.instances.iter().zip(&tables.placed) {
            let key = (instance.mesh, instance.materials.as_slice());
            let first_material = *known.entry(key).or_insert_with(|| {
                let first = self.materials.len() as u32;
                let mesh = &scene.meshes[instance.mesh as usize];
                self.materials.extend(materials(mesh, instance));
                first
            });
            self.instances.push(GeometryInstance {
                placement: *placement,
                mesh: instance.mesh,
                first_material,
                color: instance.color.to_array(),
                pass_index: instance.pass_index,
                random: instance.random,
                holdout: u32::from(instance.holdout),
            });
        }
    }

    /// The view that device code reads.
    pub fn view(&self) -> GeometryView<'_> {
        GeometryView {
            meshes: &self.meshes,
            instances: &self.instances,
            indices: &self.indices,
            positions: &self.positions,
            normals: &self.normals,
            slots: &self.slots,
            uvs: &self.uvs,
            tangents: &self.tangents,
            attributes: &self.attributes,
            generated: &self.generated,
            layers: &self.layers,
            islands: &self.islands,
            pointiness: &self.pointiness,
            materials: &self.materials,
            pass_indices: &self.pass_indices,
            inputs: &self.inputs,
            first_inputs: &self.first_inputs,
            uv_names: self.uv_names,
            attribute_names: self.attribute_names,
            has_islands: self.has_islands,
            has_pointiness: self.has_pointiness,
            camera: self.camera,
        }
    }

    /// The words of all fields of [`GeometryView`].
    pub fn sections(&self) -> Vec<Section<'_>> {
        sections!(self, GeometryView:
            meshes instances indices positions normals slots uvs tangents attributes generated
            layers islands pointiness materials pass_indices inputs first_inputs;
            uv_names attribute_names has_islands has_pointiness camera)
    }
}

/// Materials of a mesh's slots, as an instance shows them. That those which triangles have are
/// there was checked when the scene was prepared.
fn materials(mesh: &Mesh, instance: &Instance) -> impl Iterator<Item = u32> {
    let slots = mesh.slots.iter().copied().max().unwrap_or(0);
    (0..=usize::from(slots)).map(|slot| mesh.material_of_slot(instance, slot).unwrap_or(0))
}
