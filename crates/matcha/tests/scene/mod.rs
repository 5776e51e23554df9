//! A scene for the tests of the command: a textured-coordinate floor under an emitter.

use std::path::{Path, PathBuf};

/// Writes `scene.gltf` and its buffer into a folder.
pub fn write(folder: &Path) -> PathBuf {
    let quad = |z: f32, s: f32| [[-s, z, s], [s, z, s], [s, z, -s], [-s, z, -s]];
    let mut bytes = Vec::new();
    for position in quad(0.0, 2.0).iter().chain(&quad(3.0, 0.5)) {
        bytes.extend(position.iter().flat_map(|x| x.to_le_bytes()));
    }
    for uv in [[0.0f32, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].repeat(2) {
        bytes.extend(uv.iter().flat_map(|x| x.to_le_bytes()));
    }
    // The floor faces up, the emitter down.
    for index in [0u16, 1, 2, 0, 2, 3, 2, 1, 0, 3, 2, 0] {
        bytes.extend(index.to_le_bytes());
    }
    std::fs::write(folder.join("scene.bin"), &bytes).unwrap();
    let path = folder.join("scene.gltf");
    std::fs::write(&path, json(bytes.len())).unwrap();
    path
}

fn json(length: usize) -> String {
    let primitive = |positions: u32, uvs: u32, indices: u32, material: u32| {
        format!(
            r#"{{"primitives":[{{"attributes":{{"POSITION":{positions},"TEXCOORD_0":{uvs}}},"indices":{indices},"material":{material}}}]}}"#
        )
    };
    let accessor = |view: u32, offset: u32, kind: u32, count: u32, shape: &str, bounds: &str| {
        format!(
            r#"{{"bufferView":{view},"byteOffset":{offset},"componentType":{kind},"count":{count},"type":"{shape}"{bounds}}}"#
        )
    };
    let bounds = |s: f32, z: f32| format!(r#","min":[-{s},{z},-{s}],"max":[{s},{z},{s}]"#);
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0,1,2]}}],
"nodes":[{{"mesh":0}},{{"mesh":1}},{{"camera":0,"translation":[0,1,6]}}],
"cameras":[{{"type":"perspective","perspective":{{"yfov":0.8,"znear":0.1}}}}],
"meshes":[{},{}],
"materials":[{{"name":"Floor","pbrMetallicRoughness":{{"baseColorFactor":[0.8,0.4,0.2,1]}}}},
{{"name":"Lamp","emissiveFactor":[1,1,1]}}],
"accessors":[{},{},{},{},{},{}],
"bufferViews":[{{"buffer":0,"byteOffset":0,"byteLength":96}},{{"buffer":0,"byteOffset":96,"byteLength":64}},{{"buffer":0,"byteOffset":160,"byteLength":24}}],
"buffers":[{{"uri":"scene.bin","byteLength":{length}}}]}}"#,
        primitive(0, 2, 4, 0),
        primitive(1, 3, 5, 1),
        accessor(0, 0, 5126, 4, "VEC3", &bounds(2.0, 0.0)),
        accessor(0, 48, 5126, 4, "VEC3", &bounds(0.5, 3.0)),
        accessor(1, 0, 5126, 4, "VEC2", ""),
        accessor(1, 32, 5126, 4, "VEC2", ""),
        accessor(2, 0, 5123, 6, "SCALAR", ""),
        accessor(2, 12, 5123, 6, "SCALAR", ""),
    )
}
