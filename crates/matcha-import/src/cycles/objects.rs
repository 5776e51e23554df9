//! Objects: placements with what Object Info knows of them.

use super::schema;
use crate::error::{Checked, Fault};
use crate::file::Document;
use crate::plain::hierarchy::{Placed, to_z_up};
use crate::plain::{instancing, usable};
use crate::report::{Report, ReportKind};
use glam::Vec4;
use matcha_render::scene::{Instance, Scene, Visibility};

pub(super) fn add(
    document: &Document<'_>,
    placed: &[Placed],
    nodes: &[schema::Node],
    place_of_mesh: &[Option<u32>],
    scene: &mut Scene,
    report: &mut Report,
) -> Checked<()> {
    for (place, node) in placed.iter().zip(nodes) {
        let Some(mesh) = document.root.nodes[place.node]
            .mesh
            .and_then(|m| place_of_mesh[m.value()])
        else {
            continue;
        };
        let template = instance(place, node.object.as_ref(), mesh, scene, report)?;
        let randoms = instancing::randoms(document, place)?;
        for (i, transform) in instancing::transforms(document, place)?
            .into_iter()
            .enumerate()
        {
            if let Some(transform) = usable(to_z_up(transform), &template.name, report) {
                let random = randoms.get(i).copied().unwrap_or(template.random);
                scene.instances.push(Instance {
                    transform,
                    random,
                    ..template.clone()
                });
            }
        }
    }
    Ok(())
}

fn instance(
    placed: &Placed,
    object: Option<&schema::Object>,
    mesh: u32,
    scene: &Scene,
    report: &mut Report,
) -> Checked<Instance> {
    let mut instance = Instance {
        name: placed.name.clone(),
        mesh,
        transform: Default::default(),
        materials: Vec::new(),
        pass_index: 0.0,
        random: 0.0,
        color: Vec4::ONE,
        visibility: Visibility::default(),
        holdout: false,
    };
    let Some(object) = object else {
        return Ok(instance);
    };
    let place = format!("nodes[{}], object \"{}\"", placed.node, object.name);
    if !object
        .color
        .iter()
        .chain([&object.random, &object.pass_index])
        .all(|x| x.is_finite())
    {
        return Err(Fault::new(
            place,
            "its colour, index or random number is not finite",
        ));
    }
    if object
        .materials
        .iter()
        .any(|&m| m as usize >= scene.materials.len())
    {
        return Err(Fault::new(place, "one of its materials does not exist"));
    }
    if object.shadow_catcher {
        let what = ReportKind::Feature("shadow catchers are not supported".into());
        report.add(what, &place, "rendered as an ordinary object");
    }
    instance.materials = slots(
        &object.materials,
        &scene.meshes[mesh as usize].material_slots,
    );
    instance.name = object.name.clone();
    instance.pass_index = object.pass_index;
    instance.random = object.random;
    instance.color = Vec4::from_array(object.color);
    instance.visibility = object.visibility.into();
    instance.holdout = object.holdout;
    Ok(instance)
}

/// An object may have fewer slots than its mesh; what is missing is the mesh's own.
fn slots(own: &[u32], of_mesh: &[u32]) -> Vec<u32> {
    if own.is_empty() {
        return Vec::new();
    }
    let mut list = own.to_vec();
    list.extend(of_mesh.iter().skip(own.len()));
    list
}
