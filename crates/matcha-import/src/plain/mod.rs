//! Plain glTF 2.0 and the Khronos extensions, turned into Blender's conventions.

pub(crate) mod camera;
pub(crate) mod hierarchy;
pub(crate) mod instancing;
pub(crate) mod light;
pub(crate) mod material;
pub(crate) mod mesh;
pub(crate) mod names;
pub(crate) mod texture;

use crate::error::Checked;
use crate::file::Document;
use crate::report::{Report, ReportKind};
use glam::{Affine3A, Vec3};
use hierarchy::Placed;
use matcha_render::scene::{Instance, Scene, Visibility};
use material::Materials;
use mesh::{MeshBuilder, Naming};
use names::Names;
use texture::Textures;

/// glTF's y-up into Blender's z-up.
pub(crate) fn z_up(v: Vec3) -> Vec3 {
    Vec3::new(v.x, -v.z, v.y)
}

/// The scene without its pictures, which `textures` still holds as requests.
pub(crate) fn import<'a>(
    document: &'a Document<'a>,
    textures: &mut Textures<'a>,
    report: &mut Report,
) -> Checked<Scene> {
    ignored_extensions(document, report);
    let mut scene = Scene::default();
    let mut uv_names = Names::with_empty();
    let mut attribute_names = Names::default();
    let mut materials = Materials::default();
    let placed = hierarchy::place(document)?;
    let used = used_meshes(document, &placed);
    let mut place_of_mesh = vec![None; document.root.meshes.len()];
    for m in used {
        let naming = Naming {
            uv: &mut uv_names,
            attributes: &mut attribute_names,
            known: None,
        };
        let mut built = MeshBuilder::build(document, m, naming, report)?;
        for key in &built.slot_keys {
            let colored = built.colored;
            let material =
                materials.index(document, *key, colored, textures, &mut uv_names, report)?;
            built.mesh.material_slots.push(material);
        }
        if !built.mesh.indices.is_empty() {
            place_of_mesh[m] = Some(scene.meshes.len() as u32);
            scene.meshes.push(built.mesh);
        }
    }
    scene.attribute_names = attribute_names.into_list();
    scene.uv_names = uv_names.into_list();
    scene.materials = materials.into_list(&scene.attribute_names);
    for node in &placed {
        instances(document, node, &place_of_mesh, &mut scene, report)?;
        light::push(document, node, &mut scene, report)?;
    }
    camera::choose(document, &placed, &mut scene, report)?;
    light::ensure_some(&mut scene, report);
    Ok(scene)
}

/// Meshes that some node places, ascending: others are never read.
pub(crate) fn used_meshes(document: &Document<'_>, placed: &[Placed]) -> Vec<usize> {
    let nodes = &document.root.nodes;
    let mut used: Vec<usize> = placed
        .iter()
        .filter_map(|p| nodes[p.node].mesh.map(|m| m.value()))
        .collect();
    used.sort_unstable();
    used.dedup();
    used
}

fn instances(
    document: &Document<'_>,
    placed: &Placed,
    place_of_mesh: &[Option<u32>],
    scene: &mut Scene,
    report: &mut Report,
) -> Checked<()> {
    let node = &document.root.nodes[placed.node];
    let Some(mesh) = node.mesh.and_then(|m| place_of_mesh[m.value()]) else {
        return Ok(());
    };
    if node.skin.is_some() {
        let what = ReportKind::Feature("skinned meshes are not supported".into());
        report.add(
            what,
            &placed.name,
            "rendered in the pose of the mesh's own positions",
        );
    }
    let name = if placed.name.is_empty() {
        &scene.meshes[mesh as usize].name
    } else {
        &placed.name
    }
    .clone();
    for transform in instancing::transforms(document, placed)? {
        if let Some(transform) = usable(hierarchy::to_z_up(transform), &name, report) {
            scene.instances.push(Instance {
                name: name.clone(),
                mesh,
                transform,
                materials: Vec::new(),
                pass_index: 0.0,
                random: 0.0,
                color: glam::Vec4::ONE,
                visibility: Visibility::default(),
                holdout: false,
            });
        }
    }
    Ok(())
}

/// A placement that has an inverse; what is scaled to nothing is left out.
pub(crate) fn usable(transform: Affine3A, name: &str, report: &mut Report) -> Option<Affine3A> {
    let determinant = transform.matrix3.determinant();
    if determinant != 0.0 && determinant.is_finite() && transform.inverse().is_finite() {
        return Some(transform);
    }
    report.add(
        ReportKind::Note("instances scaled to nothing".into()),
        name,
        "left out",
    );
    None
}

/// Optional extensions that change the look and are not read.
fn ignored_extensions(document: &Document<'_>, report: &mut Report) {
    for name in &document.root.extensions_used {
        if !crate::file::check::EXTENSIONS.contains(&name.as_str()) {
            report.add(ReportKind::Extension(name.clone()), "", "ignored");
        }
    }
}
