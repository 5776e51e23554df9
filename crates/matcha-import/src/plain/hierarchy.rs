//! The node hierarchy, flattened.

use super::z_up;
use crate::error::{Checked, Fault};
use crate::file::Document;
use glam::{Affine3A, DMat4, DQuat, DVec3, Mat3, Vec3};
use gltf::json::Node;

/// A node of the scene with its transform to the world, glTF's y-up.
pub(crate) struct Placed {
    pub node: usize,
    pub name: String,
    pub world: DMat4,
}

/// All nodes of the file's scene, parents before children. The hierarchy is known to be
/// a forest, so this ends.
pub(crate) fn place(document: &Document<'_>) -> Checked<Vec<Placed>> {
    let nodes = &document.root.nodes;
    let mut placed = Vec::new();
    let mut open: Vec<(usize, DMat4)> = roots(document)
        .into_iter()
        .rev()
        .map(|node| (node, DMat4::IDENTITY))
        .collect();
    while let Some((index, parent)) = open.pop() {
        let node = &nodes[index];
        let world = parent * local(node);
        if !world.is_finite() {
            return Err(Fault::new(
                format!("nodes[{index}]"),
                "its transform is not finite",
            ));
        }
        open.extend(
            node.children
                .iter()
                .flatten()
                .rev()
                .map(|child| (child.value(), world)),
        );
        placed.push(Placed {
            node: index,
            name: node.name.clone().unwrap_or_default(),
            world,
        });
    }
    Ok(placed)
}

fn roots(document: &Document<'_>) -> Vec<usize> {
    let root = &document.root;
    let chosen = root.scene.map_or(0, |scene| scene.value());
    if let Some(scene) = root.scenes.get(chosen) {
        let mut list = Vec::new();
        let mut seen = vec![false; root.nodes.len()];
        for node in &scene.nodes {
            if !std::mem::replace(&mut seen[node.value()], true) {
                list.push(node.value());
            }
        }
        return list;
    }
    let mut is_child = vec![false; root.nodes.len()];
    for child in root
        .nodes
        .iter()
        .flat_map(|node| node.children.iter().flatten())
    {
        is_child[child.value()] = true;
    }
    (0..root.nodes.len())
        .filter(|&node| !is_child[node])
        .collect()
}

fn local(node: &Node) -> DMat4 {
    if let Some(matrix) = node.matrix {
        return DMat4::from_cols_array(&matrix.map(f64::from));
    }
    let translation = node.translation.unwrap_or([0.0; 3]);
    let rotation = node.rotation.map_or([0.0, 0.0, 0.0, 1.0], |q| q.0);
    let scale = node.scale.unwrap_or([1.0; 3]);
    trs(translation, rotation, scale)
}

/// Translation × rotation × scale; a rotation of length zero is none.
pub(crate) fn trs(translation: [f32; 3], rotation: [f32; 4], scale: [f32; 3]) -> DMat4 {
    let quaternion = DQuat::from_array(rotation.map(f64::from));
    let length = quaternion.length();
    let quaternion = if length > 0.0 {
        quaternion * (1.0 / length)
    } else {
        DQuat::IDENTITY
    };
    let vector = |v: [f32; 3]| DVec3::from_array(v.map(f64::from));
    DMat4::from_scale_rotation_translation(vector(scale), quaternion, vector(translation))
}

/// The same placement between z-up spaces: C M C⁻¹.
pub(crate) fn to_z_up(world: DMat4) -> Affine3A {
    let column = |i: usize| z_up(world.col(i).truncate().as_vec3());
    // C⁻¹ maps our x, y, z axes to glTF's x, -z, y.
    let matrix = Mat3::from_cols(column(0), -column(2), column(1));
    Affine3A::from_mat3_translation(matrix, column(3))
}

/// Placement of something that looks along its own -Z with +Y up, as cameras and lights
/// do on both sides: C M.
pub(crate) fn to_z_up_aimed_scaled(world: DMat4) -> Affine3A {
    let column = |i: usize| z_up(world.col(i).truncate().as_vec3());
    Affine3A::from_mat3_translation(Mat3::from_cols(column(0), column(1), column(2)), column(3))
}

/// The same without scale and shear.
pub(crate) fn to_z_up_aimed(world: DMat4) -> Affine3A {
    let placed = to_z_up_aimed_scaled(world);
    let [up, back] = [placed.matrix3.y_axis, placed.matrix3.z_axis].map(Vec3::from);
    let z = back.try_normalize().unwrap_or(Vec3::Z);
    let x = up
        .cross(z)
        .try_normalize()
        .unwrap_or_else(|| z.any_orthonormal_vector());
    Affine3A::from_mat3_translation(Mat3::from_cols(x, z.cross(x), z), placed.translation.into())
}
