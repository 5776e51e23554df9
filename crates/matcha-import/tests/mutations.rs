//! Damaged files, thousands of them: each loads or is refused, and nothing panics.

mod build;

use build::{Gltf, load, png};
use proptest::prelude::*;
use serde_json::{Value, json};

/// A file with a bit of everything, plain glTF and the extension.
fn rich() -> Vec<Gltf> {
    let mut plain = Gltf::triangle();
    let normals = plain.floats("VEC3", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
    plain.attribute("NORMAL", normals);
    let uv = plain.floats("VEC2", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
    plain.attribute("TEXCOORD_0", uv);
    let color = plain.accessor(build::UBYTE, "VEC4", 3, &[7; 12]);
    plain.attribute("COLOR_0", color);
    let indices = plain.accessor(build::USHORT, "SCALAR", 3, &[0, 0, 1, 0, 2, 0]);
    plain.primitive()["indices"] = json!(indices);
    plain.primitive()["material"] = json!(0);
    let sparse = plain.view(&[1, 0, 0, 0]);
    plain.json["accessors"][uv]["sparse"] = json!({"count": 1,
        "indices": {"bufferView": sparse, "componentType": build::UBYTE}, "values": {"bufferView": 0}});
    let picture = plain.view(&png([1, 2, 3, 4]));
    plain.json["images"] = json!([{"bufferView": picture, "mimeType": "image/png"}]);
    plain.json["samplers"] = json!([{"wrapS": 33071}]);
    plain.json["textures"] = json!([{"source": 0, "sampler": 0}]);
    plain.json["materials"] = json!([{"normalTexture": {"index": 0}, "alphaMode": "BLEND",
        "pbrMetallicRoughness": {"baseColorTexture": {"index": 0,
            "extensions": {"KHR_texture_transform": {"rotation": 1.0}}}},
        "extensions": {"KHR_materials_ior": {"ior": 1.2}, "KHR_materials_specular": {}}}]);
    plain.json["cameras"] =
        json!([{"type": "perspective", "perspective": {"yfov": 1.0, "znear": 0.1}}]);
    plain.json["extensions"] =
        json!({"KHR_lights_punctual": {"lights": [{"type": "spot", "spot": {}}]}});
    let shifts = plain.floats("VEC3", &[1.0; 6]);
    plain.json["nodes"] = json!([{"mesh": 0, "children": [1, 2], "extensions":
            {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": shifts}}}},
        {"camera": 0, "rotation": [0, 0, 0, 1]}, {"extensions": {"KHR_lights_punctual": {"light": 0}}}]);
    vec![plain, build::cycles()]
}

#[test]
fn the_undamaged_files_load() {
    for file in rich() {
        file.load().unwrap();
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn cut_off(which in 0_usize..2, at in any::<prop::sample::Index>()) {
        let bytes = rich()[which].glb();
        prop_assert!(load(&bytes[..at.index(bytes.len())]).is_err());
    }

    #[test]
    fn bytes_changed(which in 0_usize..2, changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..12)) {
        let mut bytes = rich()[which].glb();
        for (at, value) in changes {
            let at = at.index(bytes.len());
            bytes[at] = value;
        }
        let _ = load(&bytes);
    }

    /// Bytes rarely survive the JSON parser; here the JSON stays JSON.
    #[test]
    fn values_changed(which in 0_usize..2, changes in prop::collection::vec((any::<prop::sample::Index>(), 0_usize..12), 1..4)) {
        let mut file = rich().swap_remove(which);
        for (at, kind) in changes {
            // The root itself stays an object.
            let mut number = 1 + at.index(count(&file.json) - 1);
            if let Some(value) = nth(&mut file.json, &mut number) {
                *value = replacement(kind, value);
            }
        }
        let _ = load(&file.glb());
    }
}

fn replacement(kind: usize, old: &Value) -> Value {
    match kind {
        0 => json!(0),
        1 => json!(1),
        2 => json!(2),
        3 => json!(u32::MAX),
        4 => json!(u64::MAX),
        5 => json!(-1),
        6 => json!(1e300),
        7 => Value::Null,
        8 => json!([]),
        9 => json!({}),
        10 => json!("x"),
        _ => json!([old, old, old]),
    }
}

fn count(value: &Value) -> usize {
    1 + match value {
        Value::Array(list) => list.iter().map(count).sum(),
        Value::Object(map) => map.values().map(count).sum::<usize>(),
        _ => 0,
    }
}

fn nth<'v>(value: &'v mut Value, left: &mut usize) -> Option<&'v mut Value> {
    if *left == 0 {
        return Some(value);
    }
    *left -= 1;
    match value {
        Value::Array(list) => list.iter_mut().find_map(|inner| nth(inner, left)),
        Value::Object(map) => map.values_mut().find_map(|inner| nth(inner, left)),
        _ => None,
    }
}
