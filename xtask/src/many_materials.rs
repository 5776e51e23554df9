//! `cargo xtask many-materials`: a scene with as many materials as one likes, no two of
//! which have the same network, to measure what a material costs before the first sample.

use anyhow::{Context, Result};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

#[derive(clap::Args)]
pub struct Arguments {
    /// Number of materials; networks repeat with other numbers from 3125 on.
    #[arg(value_parser = clap::value_parser!(u32).range(1..=100_000))]
    count: u32,
    /// The file, .glb.
    output: PathBuf,
}

pub fn run(arguments: &Arguments) -> Result<()> {
    write(arguments.count, &arguments.output)
}

/// Writes the scene with `count` materials.
pub fn write(count: u32, path: &Path) -> Result<()> {
    std::fs::write(path, glb(count))
        .with_context(|| format!("{} cannot be written", path.display()))
}

/// Textures of a network.
const DEPTH: u32 = 5;

/// How two colours are mixed, by the digit of the texture.
const BLENDS: [&str; 5] = ["MIX", "MULTIPLY", "OVERLAY", "SCREEN", "DIFFERENCE"];

fn socket(name: &str, kind: &str, value: &[f32]) -> Value {
    json!({"identifier": name, "name": name, "type": kind, "value": value})
}

fn shader(name: &str) -> Value {
    json!({"identifier": name, "name": name, "type": "SHADER"})
}

fn number(name: &str, value: f32) -> Value {
    socket(name, "VALUE", &[value])
}

fn vector(name: &str) -> Value {
    socket(name, "VECTOR", &[0.0; 3])
}

fn color(name: &str, value: [f32; 3]) -> Value {
    socket(name, "RGBA", &[value[0], value[1], value[2], 1.0])
}

/// A texture node: which one says `digit`; its output 0 is a colour.
fn texture(digit: u32, scale: f32) -> Value {
    let (kind, props, more) = match digit {
        0 => (
            "ShaderNodeTexNoise",
            json!({"noise_dimensions": "3D", "noise_type": "FBM", "normalize": true}),
            vec![
                number("W", 0.0),
                number("Detail", 2.0),
                number("Roughness", 0.5),
                number("Lacunarity", 2.0),
                number("Offset", 0.0),
                number("Gain", 1.0),
                number("Distortion", 0.0),
            ],
        ),
        1 => (
            "ShaderNodeTexVoronoi",
            json!({"voronoi_dimensions": "2D", "distance": "EUCLIDEAN", "feature": "F1", "normalize": false}),
            vec![
                number("W", 0.0),
                number("Detail", 0.0),
                number("Roughness", 0.5),
                number("Lacunarity", 2.0),
                number("Smoothness", 1.0),
                number("Exponent", 0.5),
                number("Randomness", 1.0),
            ],
        ),
        2 => (
            "ShaderNodeTexWave",
            json!({"wave_type": "BANDS", "bands_direction": "DIAGONAL", "rings_direction": "X", "wave_profile": "SIN"}),
            vec![
                number("Distortion", 2.0),
                number("Detail", 2.0),
                number("Detail Scale", 1.0),
                number("Detail Roughness", 0.5),
                number("Phase Offset", 0.0),
            ],
        ),
        3 => (
            "ShaderNodeTexMagic",
            json!({"turbulence_depth": 3}),
            vec![number("Distortion", 1.0)],
        ),
        _ => (
            "ShaderNodeTexChecker",
            json!({}),
            vec![
                color("Color1", [0.8, 0.5, 0.2]),
                color("Color2", [0.2, 0.3, 0.7]),
            ],
        ),
    };
    let mut inputs = vec![vector("Vector"), number("Scale", scale)];
    inputs.extend(more);
    json!({"name": kind, "type": kind, "props": props, "inputs": inputs, "outputs": [color("Color", [0.0; 3])]})
}

fn mix(digit: u32) -> Value {
    json!({"name": "Mix", "type": "ShaderNodeMix",
        "props": {"data_type": "RGBA", "factor_mode": "UNIFORM", "blend_type": BLENDS[digit as usize],
            "clamp_factor": true, "clamp_result": true},
        "inputs": [number("Factor_Float", 0.5), color("A_Color", [0.6, 0.5, 0.4]), color("B_Color", [0.5; 3])],
        "outputs": [color("Result_Color", [0.0; 3])]})
}

/// Network `index`: its digits, in base 5, are its textures.
fn tree(index: u32) -> Value {
    let mut nodes = vec![
        json!({"name": "Coordinates", "type": "ShaderNodeTexCoord", "props": {}, "inputs": [],
        "outputs": [vector("UV")]}),
    ];
    let mut links = Vec::new();
    let mut link = |from: usize, to: usize, input: usize| {
        links.push(json!({"from": [from, 0], "to": [to, input]}));
    };
    let mut last = None;
    for place in 0..DEPTH {
        let digit = index / 5_u32.pow(place) % 5;
        let scale = 2.0 + place as f32 + 0.01 * (index % 97) as f32;
        nodes.push(texture(digit, scale));
        link(0, nodes.len() - 1, 0);
        nodes.push(mix(digit));
        link(nodes.len() - 2, nodes.len() - 1, 2);
        if let Some(last) = last {
            link(last, nodes.len() - 1, 1);
        }
        last = Some(nodes.len() - 1);
    }
    nodes.push(json!({"name": "Diffuse", "type": "ShaderNodeBsdfDiffuse", "props": {},
        "inputs": [color("Color", [0.8; 3]), number("Roughness", 0.0), vector("Normal")], "outputs": [shader("BSDF")]}));
    link(nodes.len() - 2, nodes.len() - 1, 0);
    nodes.push(
        json!({"name": "Output", "type": "ShaderNodeOutputMaterial", "props": {},
        "inputs": [shader("Surface")], "outputs": []}),
    );
    link(nodes.len() - 2, nodes.len() - 1, 0);
    json!({"name": format!("Material {index}"), "nodes": nodes, "links": links})
}

fn settings() -> Value {
    json!({"resolution": [640, 360], "pixel_aspect": 1.0, "samples": 16, "max_bounces": 4, "diffuse_bounces": 4,
        "glossy_bounces": 4, "transmission_bounces": 4, "transparent_bounces": 4, "clamp_direct": 0.0,
        "clamp_indirect": 0.0, "blur_glossy": 0.0, "reflective_caustics": true, "refractive_caustics": true,
        "light_threshold": 0.0, "filter": {"type": "BLACKMAN_HARRIS", "width": 1.5}, "exposure": 1.0,
        "transparent_film": false, "seed": 0,
        "view": {"transform": "Standard", "look": "None", "exposure": 0.0, "gamma": 1.0}})
}

/// The camera looks down on a square of tiles.
fn camera_node(columns: u32) -> Value {
    let height = columns as f32;
    let turn = std::f32::consts::FRAC_1_SQRT_2;
    json!({"name": "Camera", "camera": 0, "translation": [0.0, height, 0.0], "rotation": [-turn, 0.0, 0.0, turn],
        "extensions": {"MATCHA_cycles": {"camera": {"name": "Camera", "type": "PERSP", "lens": 35.0,
            "sensor_fit": "AUTO", "sensor_width": 36.0, "sensor_height": 24.0, "shift": [0.0, 0.0],
            "clip": [0.1, 10000.0], "ortho_scale": 6.0,
            "dof": {"enabled": false, "fstop": 2.8, "focus_distance": 1.0, "blades": 0, "rotation": 0.0, "ratio": 1.0}}}}})
}

fn tile(index: u32, columns: u32) -> Value {
    let middle = (columns - 1) as f32 / 2.0;
    let x = (index % columns) as f32 - middle;
    let z = (index / columns) as f32 - middle;
    json!({"name": format!("Tile {index}"), "mesh": index, "translation": [x, 0.0, z]})
}

fn mesh(material: u32) -> Value {
    json!({"name": format!("Tile {material}"),
        "primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3,
            "material": material, "extensions": {"MATCHA_cycles": {"slot": 0}}}],
        "extensions": {"MATCHA_cycles": {"uv": [{"name": "UVMap", "semantic": "TEXCOORD_0"}], "attributes": [],
            "generated_origin": [-0.5, -0.5, 0.0], "generated_size": [1.0, 1.0, 1.0], "active_uv": 0,
            "active_color": "", "material_slots": [material]}}})
}

/// The corners of a tile: positions, normals, texture coordinates, indices.
fn geometry() -> Vec<u8> {
    let corners = [[-0.5_f32, 0.5], [0.5, 0.5], [0.5, -0.5], [-0.5, -0.5]];
    let positions = corners.iter().flat_map(|&[x, z]| [x, 0.0, z]);
    let normals = [0.0, 1.0, 0.0].repeat(4);
    let texture = corners.iter().flat_map(|&[x, z]| [x + 0.5, z + 0.5]);
    let numbers = positions.chain(normals).chain(texture);
    let indices = [0_u32, 1, 2, 0, 2, 3];
    numbers
        .flat_map(f32::to_le_bytes)
        .chain(indices.into_iter().flat_map(u32::to_le_bytes))
        .collect()
}

fn document(count: u32, bytes: usize) -> Value {
    let columns = f64::from(count).sqrt().ceil() as u32;
    let mut nodes: Vec<Value> = (0..count).map(|index| tile(index, columns)).collect();
    nodes.push(camera_node(columns));
    let material = |tree: u32| {
        json!({"name": format!("Material {tree}"), "extensions": {"MATCHA_cycles": {"tree": tree, "pass_index": 0,
            "emission_sampling": "NONE"}}})
    };
    let view =
        |offset: u32, length: u32| json!({"buffer": 0, "byteOffset": offset, "byteLength": length});
    let floats = |view: u32, kind: &str| json!({"bufferView": view, "componentType": 5126, "count": 4, "type": kind});
    let mut positions = floats(0, "VEC3");
    positions["min"] = json!([-0.5, 0.0, -0.5]);
    positions["max"] = json!([0.5, 0.0, 0.5]);
    json!({"asset": {"version": "2.0"}, "extensionsUsed": ["MATCHA_cycles"], "scene": 0,
        "scenes": [{"nodes": (0..=count).collect::<Vec<_>>()}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.6, "znear": 0.1}}],
        "nodes": nodes,
        "meshes": (0..count).map(mesh).collect::<Vec<_>>(),
        "materials": (0..count).map(material).collect::<Vec<_>>(),
        "buffers": [{"byteLength": bytes}],
        "bufferViews": [view(0, 48), view(48, 48), view(96, 32), view(128, 24)],
        "accessors": [positions, floats(1, "VEC3"), floats(2, "VEC2"),
            json!({"bufferView": 3, "componentType": 5125, "count": 6, "type": "SCALAR"})],
        "extensions": {"MATCHA_cycles": {"version": 1, "settings": settings(),
            "world": {"name": "World", "color": [1.0, 1.0, 1.0], "importance_sample": false},
            "trees": (0..count).map(tree).collect::<Vec<_>>(), "images": []}}})
}

fn glb(count: u32) -> Vec<u8> {
    let binary = geometry();
    let json = document(count, binary.len()).to_string().into_bytes();
    let mut chunks = Vec::new();
    for (kind, data, fill) in [(b"JSON", json, b' '), (b"BIN\0", binary, 0)] {
        let length = data.len().next_multiple_of(4);
        chunks.extend((length as u32).to_le_bytes());
        chunks.extend(kind);
        chunks.extend(&data);
        chunks.resize(chunks.len() + length - data.len(), fill);
    }
    let mut file = b"glTF".to_vec();
    file.extend(2_u32.to_le_bytes());
    file.extend((12 + chunks.len() as u32).to_le_bytes());
    file.extend(chunks);
    file
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_networks_are_alike() {
        let kinds = |index| {
            let tree = tree(index);
            let nodes = tree["nodes"].as_array().expect("nodes").clone();
            nodes
                .iter()
                .map(|n| n["type"].to_string())
                .collect::<Vec<_>>()
        };
        let all: std::collections::HashSet<_> = (0..1000).map(kinds).collect();
        assert_eq!(all.len(), 1000);
    }

    #[test]
    fn the_file_is_as_long_as_it_says() {
        let file = glb(3);
        let length = u32::from_le_bytes([file[8], file[9], file[10], file[11]]);
        assert_eq!(length as usize, file.len());
    }
}
