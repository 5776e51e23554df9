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
