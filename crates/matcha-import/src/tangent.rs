//! Tangents by MikkTSpace (Mikkelsen, "Simulation of Wrinkled Surfaces Revisited",
//! 2008), the definition that both glTF 2.0 and Blender's normal maps use.

use crate::budget::Budget;
use crate::error::Checked;
use bevy_mikktspace::{Geometry, TangentSpace, generate_tangents};
use glam::{Vec2, Vec3, Vec4};
use matcha_render::scene::{Material, Mesh, Scene, Shader};
use matcha_shade::source::{NodeTree, Property};
use rayon::prelude::*;
use std::collections::BTreeSet;

struct Faces<'a> {
    mesh: &'a Mesh,
    uv: &'a [[Vec2; 3]],
    tangents: Vec<[Vec4; 3]>,
}

impl Geometry for Faces<'_> {
    fn num_faces(&self) -> usize {
        self.mesh.indices.len()
    }

    fn num_vertices_of_face(&self, _face: usize) -> usize {
        3
    }

    fn position(&self, face: usize, vert: usize) -> [f32; 3] {
        self.mesh.positions[self.mesh.indices[face][vert] as usize].to_array()
    }

    fn normal(&self, face: usize, vert: usize) -> [f32; 3] {
        match self.mesh.corner_normals.get(face) {
            Some(normals) => normals[vert].to_array(),
            None => flat_normal(self.mesh, face).to_array(),
        }
    }

    fn tex_coord(&self, face: usize, vert: usize) -> [f32; 2] {
        self.uv[face][vert].to_array()
    }

    fn set_tangent(&mut self, tangent: Option<TangentSpace>, face: usize, vert: usize) {
        if let Some(tangent) = tangent {
            let value = Vec4::from_array(tangent.tangent_encoded());
            if value.is_finite() && value.truncate().length_squared() > 0.25 {
                self.tangents[face][vert] = value;
            }
        }
    }
}

/// The geometric normal of a triangle, unit; +Z where it has none.
pub(crate) fn flat_normal(mesh: &Mesh, face: usize) -> Vec3 {
    let [a, b, c] = mesh.indices[face].map(|i| mesh.positions[i as usize].as_dvec3());
    (b - a)
        .cross(c - a)
        .try_normalize()
        .map_or(Vec3::Z, |n| n.as_vec3())
}

/// Fills the tangents of a mesh's UV set. Where the coordinates are degenerate and
/// no neighbour helps, the tangent is any unit vector across the normal.
pub(crate) fn generate(mesh: &mut Mesh, set: usize) {
    let uv = &mesh.uv_sets[set].corners;
    let mut faces = Faces {
        mesh,
        uv,
        tangents: Vec::new(),
    };
    faces.tangents = (0..mesh.indices.len())
        .map(|face| {
            std::array::from_fn(|vert| {
                Vec3::from_array(faces.normal(face, vert))
                    .any_orthonormal_vector()
                    .extend(1.0)
            })
        })
        .collect();
    let Ok(()) = generate_tangents(&mut faces) else {
        return;
    };
    mesh.uv_sets[set].tangents = faces.tangents;
}

/// Computes the tangents that the materials in use ask for, and no others.
pub(crate) fn generate_needed(scene: &mut Scene, budget: &Budget) -> Checked<()> {
    let wanted: Vec<BTreeSet<u16>> = scene
        .materials
        .iter()
        .map(|m| wanted_by_material(scene, m))
        .collect();
    let mut jobs: Vec<BTreeSet<u16>> = vec![BTreeSet::new(); scene.meshes.len()];
    for (mesh, job) in scene.meshes.iter().zip(&mut jobs) {
        job.extend(
            mesh.material_slots
                .iter()
                .flat_map(|&m| &wanted[m as usize]),
        );
    }
    for instance in &scene.instances {
        jobs[instance.mesh as usize]
            .extend(instance.materials.iter().flat_map(|&m| &wanted[m as usize]));
    }
    let corners: u64 = scene
        .meshes
        .iter()
        .zip(&jobs)
        .map(|(m, job)| (m.indices.len() * job.len()) as u64)
        .sum();
    budget.charge(corners * 48, "tangents")?;
    scene
        .meshes
        .par_iter_mut()
        .zip(jobs)
        .for_each(|(mesh, job)| {
            let of_name = |name: u16| match name {
                0 => Some(mesh.active_uv).filter(|&active| active < mesh.uv_sets.len()),
                name => mesh.uv_sets.iter().position(|set| set.name == name),
            };
            let sets: BTreeSet<usize> = job.into_iter().filter_map(of_name).collect();
            for set in sets {
                generate(mesh, set);
            }
        });
    Ok(())
}

/// Names of the UV sets (0: the active one) whose tangents a material reads.
fn wanted_by_material(scene: &Scene, material: &Material) -> BTreeSet<u16> {
    let mut wanted = BTreeSet::new();
    match &material.shader {
        Shader::Gltf(gltf) => wanted.extend(gltf.normal_texture.map(|(texture, _)| texture.uv)),
        Shader::Cycles(tree) => {
            let (mut open, mut seen) = (vec![*tree], BTreeSet::new());
            while let Some(index) = open.pop() {
                let Some(tree) = scene.trees.get(index as usize) else {
                    continue;
                };
                if seen.insert(index) {
                    open.extend(tree.nodes.iter().filter_map(|node| node.tree));
                    wanted.extend(
                        (0..tree.nodes.len()).filter_map(|n| wanted_by_node(scene, tree, n)),
                    );
                }
            }
        }
    }
    wanted
}

fn wanted_by_node(scene: &Scene, tree: &NodeTree, number: usize) -> Option<u16> {
    let node = &tree.nodes[number];
    let text = |name: &str| match node.props.get(name) {
        Some(Property::Text(text)) => Some(text.as_str()),
        _ => None,
    };
    let wants = match node.kind.as_str() {
        "ShaderNodeNormalMap" | "ShaderNodeVectorDisplacement" => {
            text("space").is_none_or(|space| space == "TANGENT")
        }
        "ShaderNodeTangent" => text("direction_type") == Some("UV_MAP"),
        "ShaderNodeBsdfPrincipled"
        | "ShaderNodeBsdfAnisotropic"
        | "ShaderNodeBsdfGlossy"
        | "ShaderNodeBsdfMetallic" => anisotropic(tree, number),
        _ => false,
    };
    let named = text("uv_map").and_then(|map| scene.uv_names.iter().position(|name| name == map));
    wants.then(|| named.map_or(0, |index| index as u16))
}

/// True where a closure's anisotropy is linked or not zero.
fn anisotropic(tree: &NodeTree, number: usize) -> bool {
    let sockets = tree.nodes[number].inputs.iter().enumerate();
    let mut anisotropy = sockets.filter(|(_, socket)| socket.identifier.starts_with("Anisotrop"));
    anisotropy.any(|(s, socket)| {
        let linked = tree
            .links
            .iter()
            .any(|link| link.to == [number as u32, s as u32]);
        linked || socket.value.first().is_some_and(|value| *value != 0.0)
    })
}
