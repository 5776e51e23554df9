//! Small glTF files, built in code.

#![allow(dead_code, missing_docs)] // each test file uses its own part

use matcha_import::{ImportError, Imported, LoadOptions, load_bytes};
use serde_json::{Value, json};

/// A file in the making: JSON and the binary chunk.
pub struct Gltf {
    pub json: Value,
    pub bin: Vec<u8>,
}

pub const FLOAT: u32 = 5126;
pub const BYTE: u32 = 5120;
pub const UBYTE: u32 = 5121;
pub const USHORT: u32 = 5123;
pub const UINT: u32 = 5125;

impl Gltf {
    pub fn empty() -> Self {
        let json = json!({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}]});
        Self {
            json,
            bin: Vec::new(),
        }
    }

    /// One triangle in glTF's XY plane, with a node.
    pub fn triangle() -> Self {
        let mut file = Self::empty();
        let positions = file.floats("VEC3", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
        file.json["meshes"] =
            json!([{"name": "Tri", "primitives": [{"attributes": {"POSITION": positions}}]}]);
        file.json["nodes"] = json!([{"mesh": 0, "name": "Node"}]);
        file
    }

    pub fn push(&mut self, list: &str, value: Value) -> usize {
        if self.json[list].is_null() {
            self.json[list] = json!([]);
        }
        let list = self.json[list].as_array_mut().unwrap();
        list.push(value);
        list.len() - 1
    }

    pub fn view(&mut self, bytes: &[u8]) -> usize {
        self.bin.resize(self.bin.len().next_multiple_of(4), 0);
        let offset = self.bin.len();
        self.bin.extend_from_slice(bytes);
        self.push(
            "bufferViews",
            json!({"buffer": 0, "byteOffset": offset, "byteLength": bytes.len()}),
        )
    }

    pub fn accessor(&mut self, component: u32, kind: &str, count: usize, bytes: &[u8]) -> usize {
        let view = self.view(bytes);
        self.push(
            "accessors",
            json!({"bufferView": view, "componentType": component, "type": kind, "count": count}),
        )
    }

    pub fn floats(&mut self, kind: &str, values: &[f32]) -> usize {
        let width = match kind {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            _ => 4,
        };
        let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
        self.accessor(FLOAT, kind, values.len() / width, &bytes)
    }

    pub fn attribute(&mut self, name: &str, accessor: usize) {
        self.json["meshes"][0]["primitives"][0]["attributes"][name] = json!(accessor);
    }

    pub fn primitive(&mut self) -> &mut Value {
        &mut self.json["meshes"][0]["primitives"][0]
    }

    pub fn glb(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        if !self.bin.is_empty() && json["buffers"].is_null() {
            json["buffers"] = json!([{"byteLength": self.bin.len()}]);
        }
        pack(json.to_string().as_bytes(), &self.bin)
    }

    pub fn load(&self) -> Result<Imported, ImportError> {
        load(&self.glb())
    }

    /// The sentence with which the file is refused.
    pub fn refused(&self) -> String {
        self.load()
            .err()
            .map(|error| error.to_string())
            .unwrap_or_else(|| "it was not refused".into())
    }
}

pub fn pack(json: &[u8], bin: &[u8]) -> Vec<u8> {
    let mut chunks = Vec::new();
    for (kind, data, fill) in [(b"JSON", json, b' '), (b"BIN\0", bin, 0)] {
        if data.is_empty() {
            continue;
        }
        let length = data.len().next_multiple_of(4);
        chunks.extend_from_slice(&(length as u32).to_le_bytes());
        chunks.extend_from_slice(kind);
        chunks.extend_from_slice(data);
        chunks.resize(chunks.len() + length - data.len(), fill);
    }
    let mut out = b"glTF".to_vec();
    out.extend_from_slice(&2_u32.to_le_bytes());
    out.extend_from_slice(&(12 + chunks.len() as u32).to_le_bytes());
    out.extend(chunks);
    out
}

pub fn options() -> LoadOptions {
    LoadOptions {
        memory_limit: Some(64 << 20),
        ..LoadOptions::default()
    }
}

pub fn load(bytes: &[u8]) -> Result<Imported, ImportError> {
    load_bytes("test.glb", bytes, &options(), &mut |_| {})
}

/// A PNG of one colour.
pub fn png(color: [u8; 4]) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let picture = image::RgbaImage::from_pixel(2, 2, image::Rgba(color));
    picture
        .write_to(&mut bytes, image::ImageFormat::Png)
        .unwrap();
    bytes.into_inner()
}

/// A mesh with a Cycles material, a light and a camera, as the exporter writes them.
pub fn cycles() -> Gltf {
    let mut file = Gltf::triangle();
    let uv = file.floats("VEC2", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
    file.attribute("TEXCOORD_0", uv);
    let dirt = file.floats("VEC4", &[0.5; 12]);
    file.attribute("_ATTRIBUTE_0", dirt);
    let generated = file.floats("VEC3", &[0.25; 9]);
    file.attribute("_GENERATED", generated);
    let picture = file.view(&png([10, 20, 30, 255]));
    file.json["images"] = json!([{"bufferView": picture, "mimeType": "image/png", "name": "wood"}]);
    file.json["materials"] = json!([
        {"name": "Oak", "extensions": {"MATCHA_cycles": {"tree": 0, "pass_index": 3, "emission_sampling": "NONE"}}},
        {"name": "Elm", "extensions": {"MATCHA_cycles": {"tree": 0, "emission_sampling": "BACK"}}}
    ]);
    file.primitive()["material"] = json!(1);
    file.primitive()["extensions"] = json!({"MATCHA_cycles": {"slot": 1}});
    file.json["meshes"][0]["extensions"] = json!({"MATCHA_cycles": {
        "material_slots": [0, 1], "active_uv": 0, "active_color": "Col",
        "uv": [{"name": "UVMap", "semantic": "TEXCOORD_0"}],
        "attributes": [{"name": "Col", "semantic": "_ATTRIBUTE_0", "kind": "COLOR"}],
        "generated": "_GENERATED", "generated_origin": [0, 0, 0], "generated_size": [1, 1, 1]
    }});
    let socket = |name: &str, kind: &str| json!({"identifier": name, "name": name, "type": kind, "value": [0.5]});
    let node = |name: &str, kind: &str, ins: Value, outs: Value| json!({"name": name, "type": kind, "inputs": ins, "outputs": outs});
    let mut normal = node(
        "Normal Map",
        "ShaderNodeNormalMap",
        json!([socket("Color", "RGBA")]),
        json!([socket("Normal", "VECTOR")]),
    );
    normal["props"] = json!({"space": "TANGENT", "uv_map": "UVMap"});
    let mut image = node(
        "Image",
        "ShaderNodeTexImage",
        json!([socket("Vector", "VECTOR")]),
        json!([socket("Color", "RGBA")]),
    );
    image["image"] = json!(0);
    let mut group = node(
        "Group",
        "ShaderNodeGroup",
        json!([socket("In", "RGBA")]),
        json!([socket("Out", "RGBA")]),
    );
    group["tree"] = json!(1);
    let mut color = node(
        "Color",
        "ShaderNodeVertexColor",
        json!([]),
        json!([socket("Color", "RGBA")]),
    );
    color["props"] = json!({"layer_name": ""});
    let output = node(
        "Out",
        "ShaderNodeOutputMaterial",
        json!([socket("Surface", "SHADER")]),
        json!([]),
    );
    file.json["extensions"] = json!({"MATCHA_cycles": {
        "version": 1,
        "trees": [
            {"name": "Oak", "nodes": [image, group, normal, color, output], "links": [
                {"from": [0, 0], "to": [1, 0]}, {"from": [1, 0], "to": [2, 0]}, {"from": [2, 0], "to": [4, 0]}]},
            {"name": "Tint", "nodes": [node("In", "NodeGroupInput", json!([]), json!([socket("In", "RGBA")])),
                node("Out", "NodeGroupOutput", json!([socket("Out", "RGBA")]), json!([]))],
                "links": [{"from": [0, 0], "to": [1, 0]}]}
        ],
        "images": [{"name": "wood.png", "colorspace": "Non-Color", "alpha_mode": "CHANNEL_PACKED", "source": 0}],
        "world": {"name": "World", "color": [0.1, 0.2, 0.3], "importance_sample": false},
        "settings": {"resolution": [320, 200], "pixel_aspect": 1.0, "samples": 7, "max_bounces": 8, "diffuse_bounces": 1,
            "glossy_bounces": 2, "transmission_bounces": 3, "transparent_bounces": 4, "clamp_direct": 0.0,
            "clamp_indirect": 5.0, "blur_glossy": 1.0, "reflective_caustics": true, "refractive_caustics": false,
            "light_threshold": 0.01, "filter": {"type": "GAUSSIAN", "width": 2.0}, "exposure": 1.5,
            "transparent_film": true, "view": {"transform": "Standard", "look": "None", "exposure": 0.0, "gamma": 1.0},
            "seed": -1}
    }});
    let dof = json!({"enabled": true, "fstop": 2.0, "focus_distance": 3.0, "blades": 6, "rotation": 0.5, "ratio": 1.0});
    file.json["nodes"] = json!([
        {"mesh": 0, "children": [1, 2], "extensions": {"MATCHA_cycles": {"object": {"name": "Board", "pass_index": 4,
            "random": 0.25, "color": [1, 0, 0, 1], "materials": [1], "holdout": true,
            "visibility": {"camera": false, "diffuse": true, "glossy": true, "transmission": true, "shadow": true}}}}},
        {"scale": [2, 3, 1], "extensions": {"MATCHA_cycles": {"light": {"name": "Area", "type": "AREA", "energy": 10.0,
            "color": [1, 0.5, 0], "exposure": 1.0, "shape": "RECTANGLE", "size": [1, 1], "spread": 2.0}}}},
        {"extensions": {"MATCHA_cycles": {"camera": {"type": "PERSP", "lens": 50.0, "sensor_fit": "VERTICAL",
            "sensor_width": 36.0, "sensor_height": 24.0, "shift": [0.1, 0.0], "clip": [0.1, 100.0], "ortho_scale": 6.0,
            "dof": dof}}}}
    ]);
    file
}
