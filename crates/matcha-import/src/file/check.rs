//! Checks on the JSON alone: every index in range, the hierarchy a forest.

use crate::error::{Checked, Fault};
use gltf::json::validation::{Error, Validate};
use gltf::json::{Path, Root};

/// Extensions that a file may require.
pub(crate) const EXTENSIONS: &[&str] = &[
    "MATCHA_cycles",
    "EXT_mesh_gpu_instancing",
    "EXT_texture_webp",
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
];

pub(crate) fn root(root: &Root) -> Checked<()> {
    for name in &root.extensions_required {
        if !EXTENSIONS.contains(&name.as_str()) {
            return Err(Fault::new(
                "extensionsRequired",
                format!("{name} is not supported"),
            ));
        }
    }
    primitive_accessors(root)?;
    let mut first = None;
    root.validate(root, Path::new, &mut |path, error| {
        let path = path();
        if first.is_none() && !is_harmless(path.as_str(), error) {
            // The validator names this one extension by its own field.
            let place = path
                .as_str()
                .replace("khrLightsPunctual", "KHR_lights_punctual");
            first = Some(Fault::new(place, words(error)));
        }
    });
    first.map_or(Ok(()), Err)?;
    hierarchy(root)
}

/// The validator of `gltf-json` looks up the POSITION accessor of a primitive before it
/// checks its index, and would panic.
fn primitive_accessors(root: &Root) -> Checked<()> {
    for (m, mesh) in root.meshes.iter().enumerate() {
        for (p, primitive) in mesh.primitives.iter().enumerate() {
            for index in primitive.attributes.values().chain(&primitive.indices) {
                if index.value() >= root.accessors.len() {
                    let problem = format!("accessor {} does not exist", index.value());
                    return Err(Fault::new(format!("meshes[{m}].primitives[{p}]"), problem));
                }
            }
        }
    }
    Ok(())
}

/// Rules of the specification that nothing here relies on. Bounds of positions are
/// computed anew, an accessor without data is all zeros, a texture may have its source
/// in an extension, and what is animated is not read.
fn is_harmless(path: &str, error: Error) -> bool {
    let bounds = path.ends_with(".min") || path.ends_with(".max");
    let zeros =
        path.starts_with("accessors[") && path.ends_with(".bufferView") && error == Error::Missing;
    let source =
        path.starts_with("textures[") && path.ends_with(".source") && error == Error::Missing;
    let unused =
        path.starts_with("animations[") || path.starts_with("skins[") || path.contains(".targets[");
    bounds || zeros || source || unused || path.contains(".extras") || error == Error::Unsupported
}

fn words(error: Error) -> &'static str {
    match error {
        Error::IndexOutOfBounds => "the index is out of range",
        Error::Invalid => "the value is not valid",
        Error::Missing => "the value is missing",
        Error::Oversize => "the size is beyond this machine",
        Error::Unsupported => "the extension is not supported",
    }
}

/// Every node has at most one parent, and none is its own ancestor (section 3.5.2).
fn hierarchy(root: &Root) -> Checked<()> {
    let mut parent = vec![None; root.nodes.len()];
    for (i, node) in root.nodes.iter().enumerate() {
        for child in node.children.iter().flatten() {
            if let Some(other) = parent[child.value()].replace(i) {
                let problem = format!("is a child of node {other} and of node {i}");
                return Err(Fault::new(format!("nodes[{}]", child.value()), problem));
            }
        }
    }
    // With one parent each, a node is in a cycle exactly if walking up returns to it;
    // nodes known to end at a root are marked, so each is walked over once.
    let mut state = vec![0_u32; root.nodes.len()];
    for start in 0..root.nodes.len() {
        let (mut at, walk) = (Some(start), start as u32 + 1);
        while let Some(node) = at {
            if state[node] == walk {
                return Err(Fault::new(format!("nodes[{node}]"), "is its own ancestor"));
            }
            if state[node] != 0 {
                break;
            }
            state[node] = walk;
            at = parent[node];
        }
    }
    Ok(())
}
