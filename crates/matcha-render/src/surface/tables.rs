//! What is looked up for every hit, prepared once for a scene.

use super::island::random_per_island;
use super::pointiness::pointiness;
use crate::device::mapping::MappingFrame;
use crate::device::surface_point::SurfacePlacement;
use crate::device::surface_view::CameraView;
use crate::scene::{Mesh, Scene, UvSet};
use glam::Mat3A;
use matcha_shade::input::InputKind;

/// No such layer on a mesh.
const MISSING: u16 = u16::MAX;

/// A scene's tables for surfaces.
#[derive(Clone, Debug)]
pub struct SurfaceTables {
    pub(super) view: CameraView,
    pub(crate) placed: Vec<SurfacePlacement>,
    /// Layers by mesh and UV name.
    uv_sets: Vec<u16>,
    uv_names: usize,
    /// Layers by mesh and attribute name.
    attributes: Vec<u16>,
    attribute_names: usize,
    /// By mesh; empty where no program asks.
    pub(crate) islands: Vec<Vec<f32>>,
    pub(crate) pointiness: Vec<Vec<f32>>,
}

impl SurfaceTables {
    /// Prepares a scene; `read` are the quantities that its programs read. The scene's indices
    /// must be valid, as [`crate::accel::Accel::build`] checks.
    pub fn new(scene: &Scene, view: CameraView, read: impl IntoIterator<Item = InputKind>) -> Self {
        let (mut islands, mut points) = (false, false);
        for kind in read {
            islands |= kind == InputKind::RandomPerIsland;
            points |= kind == InputKind::Pointiness;
        }
        let per_mesh = |wanted: bool, measure: fn(&Mesh) -> Vec<f32>| {
            if wanted {
                scene.meshes.iter().map(measure).collect()
            } else {
                Vec::new()
            }
        };
        let uv_names = scene.uv_names.len().max(1);
        let attribute_names = scene.attribute_names.len();
        Self {
            view,
            placed: scene
                .instances
                .iter()
                .map(|i| placed(&i.transform))
                .collect(),
            uv_sets: scene
                .meshes
                .iter()
                .flat_map(|m| layers_of_uv(m, uv_names))
                .collect(),
            uv_names,
            attributes: scene
                .meshes
                .iter()
                .flat_map(|m| layers_of_attributes(m, attribute_names))
                .collect(),
            attribute_names,
            islands: per_mesh(islands, random_per_island),
            pointiness: per_mesh(points, pointiness),
        }
    }

    /// Number of UV names.
    pub(crate) fn uv_names(&self) -> usize {
        self.uv_names
    }

    /// Number of attribute names.
    pub(crate) fn attribute_names(&self) -> usize {
        self.attribute_names
    }

    /// Index of the layer of a mesh that a UV name means; beyond its layers if it has none.
    #[inline]
    pub(crate) fn uv_layer(&self, mesh: u32, name: u16) -> usize {
        let known = (name as usize) < self.uv_names;
        let entry = mesh as usize * self.uv_names + name as usize;
        let layer = if known { self.uv_sets.get(entry) } else { None };
        usize::from(layer.copied().unwrap_or(MISSING))
    }

    /// Index of the layer of a mesh that an attribute name means; likewise.
    #[inline]
    pub(crate) fn attribute_layer(&self, mesh: u32, name: u16) -> usize {
        let known = (name as usize) < self.attribute_names;
        let entry = mesh as usize * self.attribute_names + name as usize;
        let layer = if known {
            self.attributes.get(entry)
        } else {
            None
        };
        usize::from(layer.copied().unwrap_or(MISSING))
    }

    /// The layer of a mesh that a UV name means.
    #[inline]
    pub(super) fn uv_set<'s>(&self, scene: &'s Scene, mesh: u32, name: u16) -> Option<&'s UvSet> {
        let sets = &scene.meshes[mesh as usize].uv_sets;
        sets.get(self.uv_layer(mesh, name))
    }

    /// Values of a mesh's attribute at the corners of a triangle.
    #[inline]
    pub(super) fn attribute<'s>(
        &self,
        scene: &'s Scene,
        mesh: u32,
        name: u16,
        triangle: u32,
    ) -> Option<&'s [glam::Vec4; 3]> {
        let layers = &scene.meshes[mesh as usize].attributes;
        let layer = layers.get(self.attribute_layer(mesh, name))?;
        layer.corners.get(triangle as usize)
    }

    /// Memory, bytes.
    pub fn bytes(&self) -> usize {
        let floats: usize = self
            .islands
            .iter()
            .chain(&self.pointiness)
            .map(Vec::len)
            .sum();
        size_of_val(&self.placed[..])
            + size_of_val(&self.uv_sets[..])
            + size_of_val(&self.attributes[..])
            + floats * size_of::<f32>()
    }
}

fn placed(transform: &glam::Affine3A) -> SurfacePlacement {
    let matrix = transform.matrix3;
    let determinant = matrix.determinant();
    // The cofactors are the inverse transpose times the determinant, and exist where it is zero.
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
    let handedness = if determinant < 0.0 { -1.0 } else { 1.0 };
    let normals = Mat3A::from_cols(y.cross(z), z.cross(x), x.cross(y)) * handedness;
    // Scaled to unit size, so that tiny and huge objects keep their normals' squares finite.
    let scale = [normals.x_axis, normals.y_axis, normals.z_axis]
        .iter()
        .map(|column| column.abs().max_element())
        .fold(0.0, f32::max);
    let normals = if scale > 0.0 {
        normals * (1.0 / scale)
    } else {
        Mat3A::IDENTITY
    };
    SurfacePlacement {
        axes: frame(&matrix),
        origin: transform.translation.into(),
        normals: frame(&normals),
        handedness,
    }
}

/// A matrix by its columns.
fn frame(matrix: &Mat3A) -> MappingFrame {
    MappingFrame {
        x: matrix.x_axis.into(),
        y: matrix.y_axis.into(),
        z: matrix.z_axis.into(),
    }
}

fn layers_of_uv(mesh: &Mesh, names: usize) -> Vec<u16> {
    let mut layers = vec![MISSING; names];
    for (i, set) in mesh.uv_sets.iter().enumerate().rev() {
        if let Some(layer) = layers.get_mut(set.name as usize) {
            *layer = i as u16;
        }
    }
    layers[0] = if mesh.active_uv < mesh.uv_sets.len() {
        mesh.active_uv as u16
    } else {
        MISSING
    };
    layers
}

fn layers_of_attributes(mesh: &Mesh, names: usize) -> Vec<u16> {
    let mut layers = vec![MISSING; names];
    for (i, attribute) in mesh.attributes.iter().enumerate().rev() {
        if let Some(layer) = layers.get_mut(attribute.name as usize) {
            *layer = i as u16;
        }
    }
    layers
}

/// Material of a triangle, an index into `Scene::materials`: that of its slot, of the instance
/// where it replaces the mesh's. None if the slot has none.
pub fn material_of(scene: &Scene, instance: u32, triangle: u32) -> Option<u32> {
    let instance = scene.instances.get(instance as usize)?;
    let mesh = scene.meshes.get(instance.mesh as usize)?;
    mesh.material_of(instance, triangle)
}
