//! The `MATCHA_cycles` extension (`docs/gltf-extension`): what it says wins over the
//! standard glTF that is there for other viewers.

mod camera;
mod light;
mod meshes;
mod objects;
mod pictures;
mod schema;
mod settings;
mod validate;

use crate::error::{Checked, Fault};
use crate::file::Document;
use crate::plain::hierarchy::{self, Placed};
use crate::plain::material::Materials;
use crate::plain::names::Names;
use crate::plain::texture::Textures;
use crate::report::{Report, ReportKind};
use matcha_render::scene::{Material, Scene, Shader};
use serde::Deserialize;
use serde_json::{Map, Value};

pub(crate) const EXTENSION: &str = "MATCHA_cycles";
const VERSION: u32 = 1;

/// True if the file has the extension at its root.
pub(crate) fn is_present(document: &Document<'_>) -> bool {
    document
        .root
        .extensions
        .as_ref()
        .is_some_and(|e| e.others.contains_key(EXTENSION))
}

/// The scene without its pictures, which `textures` still holds as requests.
pub(crate) fn import<'a>(
    document: &'a Document<'a>,
    textures: &mut Textures<'a>,
    report: &mut Report,
) -> Checked<Scene> {
    let others = document.root.extensions.as_ref().map(|e| &e.others);
    let root: schema::Root =
        read(others, "the file")?.ok_or_else(|| Fault::new(EXTENSION, "is missing"))?;
    if root.version != VERSION {
        let problem = format!(
            "its version {} is not known here, only {VERSION} is",
            root.version
        );
        return Err(Fault::new(EXTENSION, problem));
    }
    let placed = hierarchy::place(document)?;
    let nodes = read_nodes(document, &placed)?;
    let materials = read_materials(document)?;
    let names = tree_names(&root, &materials, document, &nodes)?;
    validate::trees(&root.trees, root.images.len(), &names)?;
    for image in &root.images {
        textures
            .requests
            .push(pictures::request(document, image, report));
    }
    let mut scene = Scene {
        trees: root.trees,
        ..Scene::default()
    };
    settings::apply(root.settings.as_ref(), root.world.as_ref(), &mut scene)?;
    let mut uv_names = Names::with_empty();
    scene.materials = build_materials(document, materials, textures, &mut uv_names, report)?;
    meshes::add(document, &placed, &nodes, uv_names, &mut scene, report)?;
    for (place, node) in placed.iter().zip(nodes) {
        match (node.light, node.camera) {
            (Some(light), _) => light::add(light, place, &mut scene, report)?,
            (None, Some(camera)) => camera::set(&camera, place, &mut scene, report)?,
            (None, None) => {}
        }
    }
    Ok(scene)
}

/// One of the extension's objects.
fn read<T: for<'de> Deserialize<'de>>(
    others: Option<&Map<String, Value>>,
    place: &str,
) -> Checked<Option<T>> {
    let Some(value) = others.and_then(|others| others.get(EXTENSION)) else {
        return Ok(None);
    };
    T::deserialize(value)
        .map(Some)
        .map_err(|error| Fault::new(format!("{EXTENSION} of {place}"), error.to_string()))
}

fn read_nodes(document: &Document<'_>, placed: &[Placed]) -> Checked<Vec<schema::Node>> {
    let read = |place: &Placed| {
        let others = document.root.nodes[place.node]
            .extensions
            .as_ref()
            .map(|e| &e.others);
        Ok(read(others, &format!("nodes[{}]", place.node))?.unwrap_or_default())
    };
    placed.iter().map(read).collect()
}

/// The extension of each glTF material that has one.
fn read_materials(document: &Document<'_>) -> Checked<Vec<Option<schema::Material>>> {
    let materials = document.root.materials.iter().enumerate();
    materials
        .map(|(m, material)| {
            read(
                material.extensions.as_ref().map(|e| &e.others),
                &format!("materials[{m}]"),
            )
        })
        .collect()
}

fn material_name(document: &Document<'_>, index: usize) -> String {
    document.root.materials[index]
        .name
        .clone()
        .unwrap_or_else(|| format!("materials[{index}]"))
}

/// Whose each tree is, for messages. All references to trees are checked on the way.
fn tree_names(
    root: &schema::Root,
    materials: &[Option<schema::Material>],
    document: &Document<'_>,
    nodes: &[schema::Node],
) -> Checked<Vec<String>> {
    let mut names: Vec<String> = root
        .trees
        .iter()
        .map(|tree| format!("group \"{}\"", tree.name))
        .collect();
    let mut own =
        |tree: Option<u32>, name: String| match tree.map(|tree| names.get_mut(tree as usize)) {
            None => Ok(()),
            Some(Some(slot)) => {
                *slot = name;
                Ok(())
            }
            Some(None) => Err(Fault::new(
                name,
                format!("its tree {} does not exist", tree.unwrap_or(0)),
            )),
        };
    for (m, material) in materials.iter().enumerate() {
        own(
            material.as_ref().map(|m| m.tree),
            format!("material \"{}\"", material_name(document, m)),
        )?;
    }
    for light in nodes.iter().filter_map(|node| node.light.as_ref()) {
        own(light.tree, format!("light \"{}\"", light.name))?;
    }
    if let Some(world) = &root.world {
        own(world.tree, format!("world \"{}\"", world.name))?;
    }
    Ok(names)
}

/// All materials, in the file's order; those without the extension are read as plain glTF.
fn build_materials<'a>(
    document: &'a Document<'a>,
    extensions: Vec<Option<schema::Material>>,
    textures: &mut Textures<'a>,
    uv_names: &mut Names,
    report: &mut Report,
) -> Checked<Vec<Material>> {
    let mut list = Vec::with_capacity(extensions.len());
    for (m, extension) in extensions.into_iter().enumerate() {
        if let Some(extension) = &extension {
            report_switches(extension, &material_name(document, m), report);
        }
        list.push(match extension {
            Some(extension) => Material {
                name: material_name(document, m),
                shader: Shader::Cycles(extension.tree),
                pass_index: extension.pass_index,
                sample_emission: extension.sampled_sides(),
            },
            None => Materials::single(document, m, textures, uv_names, report)?,
        });
    }
    Ok(list)
}

/// Switches of a material that are always on here.
fn report_switches(material: &schema::Material, name: &str, report: &mut Report) {
    let place = format!("material \"{name}\"");
    let mut add = |what: &str, substitute: &str| {
        report.add(ReportKind::Feature(what.into()), &place, substitute);
    };
    if !material.use_transparent_shadow {
        add(
            "a material without transparent shadows is not supported",
            "where it is transparent, its shadow is as well",
        );
    }
    if !material.use_bump_map_correction {
        add(
            "a material without bump map correction is not supported",
            "its normals are corrected",
        );
    }
}
