//! Small scenes with closed-form answers.

use glam::{Affine3A, Vec2, Vec3, Vec4};
use matcha_render::scene::*;
use matcha_shade::source::{Link, NodeTree, Property, Socket, SourceNode};
use std::collections::BTreeMap;

/// A socket with a value.
pub fn socket(identifier: &str, kind: &str, value: &[f32]) -> Socket {
    Socket {
        identifier: identifier.into(),
        name: identifier.into(),
        kind: kind.into(),
        value: value.to_vec(),
        hide_value: false,
        enabled: true,
    }
}

/// A node with inputs and one output.
pub fn node(kind: &str, inputs: Vec<Socket>, output: Option<Socket>) -> SourceNode {
    SourceNode {
        name: kind.into(),
        kind: kind.into(),
        props: BTreeMap::new(),
        inputs,
        outputs: output.into_iter().collect(),
        muted: false,
        internal_links: Vec::new(),
        tree: None,
        image: None,
        ramp: None,
        curves: None,
        texture_mapping: None,
        object_from_world: None,
    }
}

/// A shader node that drives an output node.
pub fn tree(shader: SourceNode, output: &str) -> NodeTree {
    let surface = vec![socket("Surface", "SHADER", &[])];
    NodeTree {
        name: shader.kind.clone(),
        nodes: vec![shader, node(output, surface, None)],
        links: vec![Link {
            from: [0, 0],
            to: [1, 0],
        }],
    }
}

/// A Lambertian material's tree.
pub fn diffuse(albedo: [f32; 3]) -> NodeTree {
    let [r, g, b] = albedo;
    let mut normal = socket("Normal", "VECTOR", &[0.0; 3]);
    normal.hide_value = true;
    let inputs = vec![
        socket("Color", "RGBA", &[r, g, b, 1.0]),
        socket("Roughness", "VALUE", &[0.0]),
        normal,
    ];
    let shader = node(
        "ShaderNodeBsdfDiffuse",
        inputs,
        Some(socket("BSDF", "SHADER", &[])),
    );
    tree(shader, "ShaderNodeOutputMaterial")
}

/// A Lambertian material whose colour is cellular noise over the first UV set, costly enough
/// to be cached.
pub fn cells(scale: f32) -> NodeTree {
    let inputs = vec![
        socket("Vector", "VECTOR", &[0.0; 3]),
        socket("Scale", "VALUE", &[scale]),
    ];
    let color = socket("Color", "RGBA", &[0.0; 4]);
    let mut noise = node("ShaderNodeTexVoronoi", inputs, Some(color));
    let smooth = Property::Text("SMOOTH_F1".into());
    noise.props.insert("feature".into(), smooth);
    let coordinate = socket("UV", "VECTOR", &[0.0; 3]);
    let uv = node("ShaderNodeUVMap", Vec::new(), Some(coordinate));
    let mut whole = diffuse([1.0; 3]);
    whole.nodes.extend([noise, uv]);
    let link = |from, to| Link { from, to };
    whole
        .links
        .extend([link([3, 0], [2, 0]), link([2, 0], [0, 0])]);
    whole
}

/// An emitting material's tree.
pub fn emission(radiance: f32) -> NodeTree {
    let inputs = vec![
        socket("Color", "RGBA", &[1.0; 4]),
        socket("Strength", "VALUE", &[radiance]),
    ];
    let shader = node(
        "ShaderNodeEmission",
        inputs,
        Some(socket("Emission", "SHADER", &[])),
    );
    tree(shader, "ShaderNodeOutputMaterial")
}

/// A tree whose shader takes its colour (input 0) or strength (input 1) from a node's output.
pub fn driven(
    shader: &str,
    output: &str,
    input: u32,
    from: &str,
    socket_of: [&str; 2],
) -> NodeTree {
    let inputs = vec![
        socket("Color", "RGBA", &[0.9, 0.6, 0.3, 1.0]),
        socket("Strength", "VALUE", &[2.0]),
    ];
    let out = Some(socket(
        shader.trim_start_matches("ShaderNode"),
        "SHADER",
        &[],
    ));
    let mut whole = tree(node(shader, inputs, out), output);
    let [identifier, kind] = socket_of;
    let value = Some(socket(identifier, kind, &[0.0; 3]));
    whole.nodes.push(node(from, Vec::new(), value));
    whole.links.push(Link {
        from: [2, 0],
        to: [0, input],
    });
    whole
}

/// A scene with nothing in it, seen from (0, 0, `height`) straight down.
pub fn empty(height: f32) -> Scene {
    Scene {
        name: "test".into(),
        uv_names: vec![String::new()],
        camera: Camera {
            transform: Affine3A::from_translation(Vec3::Z * height),
            projection: Projection::Perspective {
                tan_half_width: 0.2,
                fit: SensorFit::Auto,
            },
            ..Camera::default()
        },
        settings: Settings {
            resolution: [40, 33],
            samples: 64,
            max_bounces: 64,
            diffuse_bounces: 64,
            clamp_indirect: 0.0,
            light_threshold: 0.0,
            ..Settings::default()
        },
        ..Scene::default()
    }
}

/// Adds a material and returns its index.
pub fn add_material(scene: &mut Scene, tree: NodeTree) -> u32 {
    scene.trees.push(tree);
    scene.materials.push(Material {
        name: format!("material {}", scene.materials.len()),
        shader: Shader::Cycles(scene.trees.len() as u32 - 1),
        pass_index: 0.0,
        sample_emission: Some(Sides::Both),
    });
    scene.materials.len() as u32 - 1
}

/// Adds an object with one material.
pub fn add_mesh(scene: &mut Scene, positions: Vec<Vec3>, indices: Vec<[u32; 3]>, material: u32) {
    let corners =
        |t: &[u32; 3]| t.map(|v| Vec2::new(positions[v as usize].x, positions[v as usize].y));
    let uv = indices.iter().map(corners).collect();
    scene.meshes.push(Mesh {
        name: format!("mesh {}", scene.meshes.len()),
        uv_sets: vec![UvSet {
            name: 0,
            corners: uv,
            tangents: Vec::new(),
        }],
        positions,
        indices,
        material_slots: vec![material],
        generated_size: Vec3::ONE,
        ..Mesh::default()
    });
    scene.instances.push(Instance {
        name: format!("object {}", scene.instances.len()),
        mesh: scene.meshes.len() as u32 - 1,
        transform: Affine3A::IDENTITY,
        materials: Vec::new(),
        pass_index: 0.0,
        random: 0.5,
        color: Vec4::ONE,
        visibility: Visibility::default(),
        holdout: false,
    });
}

/// A square of edge 2 `half` around `centre`, facing +Z, or −Z where `down`.
pub fn add_square(scene: &mut Scene, centre: Vec3, half: f32, down: bool, material: u32) {
    let corner = |x: f32, y: f32| centre + Vec3::new(x * half, y * half, 0.0);
    let positions = vec![
        corner(-1., -1.),
        corner(1., -1.),
        corner(1., 1.),
        corner(-1., 1.),
    ];
    let up = vec![[0, 1, 2], [0, 2, 3]];
    let indices = if down {
        up.iter().map(|&[a, b, c]| [a, c, b]).collect()
    } else {
        up
    };
    add_mesh(scene, positions, indices, material);
}
