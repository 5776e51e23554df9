//! Meshes with Blender's names and slots, and the objects that place them.

use super::{objects, read, schema};
use crate::error::{Checked, Fault};
use crate::file::Document;
use crate::plain::hierarchy::Placed;
use crate::plain::mesh::{Known, MeshBuilder, Naming};
use crate::plain::names::Names;
use crate::plain::used_meshes;
use crate::report::Report;
use glam::Vec3;
use matcha_render::scene::{Mesh, MeshAttribute, Scene};
use matcha_shade::source::{NodeTree, Property};
use std::collections::{BTreeMap, BTreeSet};

/// Reads the meshes in use and their instances.
pub(super) fn add(
    document: &Document<'_>,
    placed: &[Placed],
    nodes: &[schema::Node],
    mut uv_names: Names,
    scene: &mut Scene,
    report: &mut Report,
) -> Checked<()> {
    let mut attribute_names = Names::default();
    let mut place_of_mesh = vec![None; document.root.meshes.len()];
    let asked = attributes_by_name(&scene.trees);
    for m in used_meshes(document, placed) {
        let naming = Naming {
            uv: &mut uv_names,
            attributes: &mut attribute_names,
            known: None,
        };
        let mesh = mesh(document, m, naming, &asked, scene.materials.len(), report)?;
        if !mesh.indices.is_empty() {
            place_of_mesh[m] = Some(scene.meshes.len() as u32);
            scene.meshes.push(mesh);
        }
    }
    scene.uv_names = uv_names.into_list();
    scene.attribute_names = attribute_names.into_list();
    objects::add(document, placed, nodes, &place_of_mesh, scene, report)
}

fn mesh(
    document: &Document<'_>,
    index: usize,
    mut naming: Naming<'_>,
    asked: &BTreeSet<&str>,
    materials: usize,
    report: &mut Report,
) -> Checked<Mesh> {
    let source = &document.root.meshes[index];
    let place = format!("meshes[{index}]");
    let others = source.extensions.as_ref().map(|e| &e.others);
    let Some(about) = read::<schema::Mesh>(others, &place)? else {
        return plain_mesh(document, index, naming, materials, report);
    };
    if about
        .material_slots
        .iter()
        .any(|&m| m as usize >= materials)
        || about.material_slots.len() > 1 << 16
    {
        return Err(Fault::new(
            place,
            "a material slot holds a material that does not exist",
        ));
    }
    let names = about.uv.iter().chain(&about.attributes);
    let names: BTreeMap<String, String> = names
        .map(|n| (n.semantic.clone(), n.name.clone()))
        .collect();
    if names.values().any(String::is_empty) {
        return Err(Fault::new(place, "a UV map or attribute has an empty name"));
    }
    let slots = slots(document, index, about.material_slots.len())?;
    let known = Known {
        names,
        slots,
        generated: about.generated.clone(),
        island: about.island.clone(),
    };
    let named = Naming {
        uv: naming.uv,
        attributes: naming.attributes,
        known: Some(&known),
    };
    let mut mesh = MeshBuilder::build(document, index, named, report)?.mesh;
    let (origin, size) = (
        Vec3::from_array(about.generated_origin),
        Vec3::from_array(about.generated_size),
    );
    if !origin.is_finite() || !size.is_finite() || size.min_element() <= 0.0 {
        return Err(Fault::new(
            place,
            "its Generated texture space is not finite or has no size",
        ));
    }
    (mesh.generated_origin, mesh.generated_size) = (origin, size);
    if let Some(active) = about.uv.get(about.active_uv) {
        let name = naming.uv.intern(&active.name)?;
        mesh.active_uv = mesh
            .uv_sets
            .iter()
            .position(|set| set.name == name)
            .unwrap_or(0);
    }
    mesh.material_slots = about.material_slots;
    aliases(
        &mut mesh,
        &about.uv,
        &about.active_color,
        &mut naming,
        asked,
    )?;
    Ok(mesh)
}

/// A mesh that somebody added without the extension.
fn plain_mesh(
    document: &Document<'_>,
    index: usize,
    naming: Naming<'_>,
    materials: usize,
    report: &mut Report,
) -> Checked<Mesh> {
    let mut built = MeshBuilder::build(document, index, naming, report)?;
    for key in &built.slot_keys {
        let Some(material) = key.filter(|&m| m < materials) else {
            return Err(Fault::new(
                format!("meshes[{index}]"),
                "has a primitive without a material",
            ));
        };
        built.mesh.material_slots.push(material as u32);
    }
    Ok(built.mesh)
}

/// The slot of each primitive.
fn slots(document: &Document<'_>, index: usize, count: usize) -> Checked<Vec<u16>> {
    let primitives = document.root.meshes[index].primitives.iter().enumerate();
    primitives
        .map(|(p, primitive)| {
            let place = format!("meshes[{index}].primitives[{p}]");
            let others = primitive.extensions.as_ref().map(|e| &e.others);
            let slot =
                read::<schema::Primitive>(others, &place)?.map_or(0, |primitive| primitive.slot);
            if usize::from(slot) < count {
                Ok(slot)
            } else {
                Err(Fault::new(
                    place,
                    format!("its slot {slot} is not one of the mesh's {count}"),
                ))
            }
        })
        .collect()
}

/// Names under which trees ask for attributes; empty is the active colour.
fn attributes_by_name(trees: &[NodeTree]) -> BTreeSet<&str> {
    let nodes = trees.iter().flat_map(|tree| &tree.nodes);
    nodes
        .filter_map(|node| {
            let property = match node.kind.as_str() {
                "ShaderNodeAttribute" => "attribute_name",
                "ShaderNodeVertexColor" => "layer_name",
                _ => return None,
            };
            match node.props.get(property) {
                Some(Property::Text(name)) => Some(name.as_str()),
                _ => None,
            }
        })
        .collect()
}

/// Attributes that are there under another name: UV maps can be read as attributes, and
/// a colour node without a name means the mesh's active colour.
fn aliases(
    mesh: &mut Mesh,
    uv: &[schema::Named],
    active_color: &str,
    naming: &mut Naming<'_>,
    asked: &BTreeSet<&str>,
) -> Checked<()> {
    for layer in uv
        .iter()
        .filter(|layer| asked.contains(layer.name.as_str()))
    {
        let uv_name = naming.uv.intern(&layer.name)?;
        let Some(set) = mesh.uv_sets.iter().find(|set| set.name == uv_name) else {
            continue;
        };
        let corners = set
            .corners
            .iter()
            .map(|c| c.map(|uv| uv.extend(0.0).extend(1.0)))
            .collect();
        mesh.attributes.push(MeshAttribute {
            name: naming.attributes.intern(&layer.name)?,
            corners,
        });
    }
    if asked.contains("") && !active_color.is_empty() {
        let name = naming.attributes.intern(active_color)?;
        if let Some(color) = mesh
            .attributes
            .iter()
            .find(|attribute| attribute.name == name)
        {
            let corners = color.corners.clone();
            mesh.attributes.push(MeshAttribute {
                name: naming.attributes.intern("")?,
                corners,
            });
        }
    }
    Ok(())
}
