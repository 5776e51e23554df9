//! `EXT_mesh_gpu_instancing`: one node, many placements of its mesh.

use super::hierarchy::{Placed, trs};
use crate::error::{Checked, Fault};
use crate::file::Document;
use glam::DMat4;
use serde_json::Value;

/// World transforms (y-up) of the mesh that a node places: one, unless it is instanced.
pub(crate) fn transforms(document: &Document<'_>, placed: &Placed) -> Checked<Vec<DMat4>> {
    let node = &document.root.nodes[placed.node];
    let extension = node
        .extensions
        .as_ref()
        .and_then(|e| e.others.get("EXT_mesh_gpu_instancing"));
    let Some(extension) = extension else {
        return Ok(vec![placed.world]);
    };
    let place = format!("nodes[{}].extensions.EXT_mesh_gpu_instancing", placed.node);
    let accessor = |name: &str| attribute(extension, name, &place);
    let translations = accessor("TRANSLATION")?
        .map(|a| document.floats::<3>(a, "translations"))
        .transpose()?;
    let rotations = accessor("ROTATION")?
        .map(|a| document.floats::<4>(a, "rotations"))
        .transpose()?;
    let scales = accessor("SCALE")?
        .map(|a| document.floats::<3>(a, "scales"))
        .transpose()?;
    let counts = [
        translations.as_ref().map(Vec::len),
        rotations.as_ref().map(Vec::len),
        scales.as_ref().map(Vec::len),
    ];
    let Some(count) = counts.into_iter().flatten().next() else {
        return Err(Fault::new(
            place,
            "has none of TRANSLATION, ROTATION, SCALE",
        ));
    };
    if counts.into_iter().flatten().any(|other| other != count) {
        return Err(Fault::new(
            place,
            "its attributes have different numbers of elements",
        ));
    }
    document.budget.charge(count as u64 * 512, &place)?;
    let mut all = Vec::with_capacity(count);
    for i in 0..count {
        let world = placed.world
            * trs(
                translations.as_ref().map_or([0.0; 3], |t| t[i]),
                rotations.as_ref().map_or([0.0, 0.0, 0.0, 1.0], |r| r[i]),
                scales.as_ref().map_or([1.0; 3], |s| s[i]),
            );
        if !world.is_finite() {
            return Err(Fault::new(
                place,
                format!("the transform of instance {i} is not finite"),
            ));
        }
        all.push(world);
    }
    Ok(all)
}

/// Random numbers of the copies, where the exporter stored them.
pub(crate) fn randoms(document: &Document<'_>, placed: &Placed) -> Checked<Vec<f32>> {
    let node = &document.root.nodes[placed.node];
    let extension = node
        .extensions
        .as_ref()
        .and_then(|e| e.others.get("EXT_mesh_gpu_instancing"));
    let Some(extension) = extension else {
        return Ok(Vec::new());
    };
    let place = format!("nodes[{}].extensions.EXT_mesh_gpu_instancing", placed.node);
    let Some(accessor) = attribute(extension, "_RANDOM", &place)? else {
        return Ok(Vec::new());
    };
    let values = document.floats::<1>(accessor, "random numbers")?;
    Ok(values
        .into_iter()
        .map(|[x]| if x.is_finite() { x } else { 0.0 })
        .collect())
}

fn attribute(extension: &Value, name: &str, place: &str) -> Checked<Option<usize>> {
    match extension
        .get("attributes")
        .and_then(|attributes| attributes.get(name))
    {
        None => Ok(None),
        Some(value) => match value.as_u64().and_then(|index| usize::try_from(index).ok()) {
            Some(index) => Ok(Some(index)),
            None => Err(Fault::new(
                place,
                format!("{name} is not the number of an accessor"),
            )),
        },
    }
}
