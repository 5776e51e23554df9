//! Files that lie: each is refused with one sentence that names the file and the place.

mod build;

use build::{Gltf, UBYTE, USHORT, load, pack, png};
use matcha_import::{LoadOptions, load_bytes};
use serde_json::json;

/// Breaks a good file, and the sentence that this must give.
type Case = (fn(&mut Gltf), &'static str);

#[rustfmt::skip]
const CASES: &[Case] = &[
    (|f| f.json["accessors"][0]["count"] = json!(1000),
        "test.glb: accessors[0]: 1000 elements of 12 bytes reach beyond the 36 bytes of buffer view 0"),
    (|f| f.json["accessors"][0]["count"] = json!(u64::MAX),
        "test.glb: accessors[0]: the scene needs 18446744073710 MB from here on, more than the 68 MB allowed"),
    (|f| f.json["accessors"][0] = json!({"componentType": 5126, "type": "VEC3", "count": 4_000_000_000_u64}),
        "test.glb: accessors[0]: the scene needs 48000 MB from here on, more than the 68 MB allowed"),
    (|f| f.json["accessors"][0]["byteOffset"] = json!(8),
        "test.glb: accessors[0]: 3 elements of 12 bytes reach beyond the 36 bytes of buffer view 0"),
    (|f| f.json["accessors"][0]["byteOffset"] = json!(u64::MAX),
        "test.glb: accessors[0]: 3 elements of 12 bytes reach beyond the 36 bytes of buffer view 0"),
    (|f| f.json["accessors"][0]["type"] = json!("VEC2"),
        "test.glb: accessors[0]: is VEC2 and cannot be positions, which has 3 components"),
    (|f| f.json["accessors"][0]["componentType"] = json!(1234),
        "test.glb: accessors[0].componentType: the value is not valid"),
    (|f| f.json["bufferViews"][0]["byteLength"] = json!(999_999),
        "test.glb: bufferViews[0]: its 999999 bytes from 0 on reach beyond the 36 bytes of buffer 0"),
    (|f| f.json["bufferViews"][0]["byteOffset"] = json!(u64::MAX),
        "test.glb: bufferViews[0]: its 36 bytes from 18446744073709551615 on reach beyond the 36 bytes of buffer 0"),
    (|f| f.json["bufferViews"][0]["buffer"] = json!(3),
        "test.glb: bufferViews[0].buffer: the index is out of range"),
    (|f| f.json["buffers"] = json!([{"byteLength": 1_000_000}]),
        "test.glb: buffers[0]: claims 1000000 bytes and has 36"),
    (|f| f.json["buffers"] = json!([{"byteLength": 36, "uri": "gone.bin"}]),
        "test.glb: buffers[0]: the file \"gone.bin\" is outside of these bytes"),
    (|f| f.json["buffers"] = json!([{"byteLength": 36, "uri": "data:x;base64,!!"}]),
        "test.glb: buffers[0]: its data URI is not base64: Invalid symbol 33, offset 0."),
    (|f| f.json["buffers"] = json!([{"byteLength": 36}, {"byteLength": 36}]),
        "test.glb: buffers[1]: has neither a uri nor a binary chunk"),
    (|f| f.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = json!(9),
        "test.glb: meshes[0].primitives[0]: accessor 9 does not exist"),
    (|f| f.json["meshes"][0]["primitives"][0]["attributes"] = json!({}),
        "test.glb: meshes[0].primitives[0].attributes[\"POSITION\"]: the value is missing"),
    (|f| f.json["meshes"][0]["primitives"][0]["indices"] = json!(7),
        "test.glb: meshes[0].primitives[0]: accessor 7 does not exist"),
    (|f| f.json["meshes"][0]["primitives"][0]["indices"] = json!(0),
        "test.glb: accessors[0]: holds VEC3 of F32 and cannot be vertex indices"),
    (|f| { let i = f.accessor(UBYTE, "SCALAR", 3, &[0, 1, 200]); f.primitive()["indices"] = json!(i); },
        "test.glb: accessors[1]: index 2 is 200, and there are 3 vertices"),
    (|f| f.primitive()["material"] = json!(0),
        "test.glb: meshes[0].primitives[0].material: the index is out of range"),
    (|f| f.primitive()["mode"] = json!(77),
        "test.glb: meshes[0].primitives[0].mode: the value is not valid"),
    (|f| { let a = f.floats("VEC2", &[0.0; 2]); f.attribute("TEXCOORD_0", a); },
        "test.glb: meshes[0].primitives[0]: has 1 texture coordinates for 3 vertices"),
    (|f| { let v = f.view(&[9, 0, 0, 0]); f.json["accessors"][0]["sparse"] = json!({"count": 1,
            "indices": {"bufferView": v, "componentType": UBYTE}, "values": {"bufferView": 0}}); },
        "test.glb: accessors[0]: its sparse part replaces element 9 of 3"),
    (|f| { let v = f.view(&[0]); f.json["accessors"][0]["sparse"] = json!({"count": 90,
            "indices": {"bufferView": v, "componentType": USHORT}, "values": {"bufferView": 0}}); },
        "test.glb: accessors[0].sparse: 90 elements of 2 bytes reach beyond the 1 bytes of buffer view 1"),
    (|f| f.bin[..4].copy_from_slice(&f32::NAN.to_le_bytes()),
        "test.glb: meshes[0].primitives[0]: the position of vertex 0 is (NaN, 0, 0), not finite or beyond 1e12 m"),
    (|f| f.bin[16..20].copy_from_slice(&f32::INFINITY.to_le_bytes()),
        "test.glb: meshes[0].primitives[0]: the position of vertex 1 is (1, inf, 0), not finite or beyond 1e12 m"),
    (|f| f.json["nodes"] = json!([{"mesh": 0, "children": [1]}, {"children": [0]}]),
        "test.glb: nodes[0]: is its own ancestor"),
    (|f| f.json["nodes"] = json!([{"mesh": 0, "children": [0]}]),
        "test.glb: nodes[0]: is its own ancestor"),
    (|f| f.json["nodes"] = json!([{"children": [2]}, {"children": [2]}, {"mesh": 0}]),
        "test.glb: nodes[2]: is a child of node 0 and of node 1"),
    (|f| f.json["nodes"][0]["children"] = json!([44]),
        "test.glb: nodes[0].children[0]: the index is out of range"),
    (|f| f.json["nodes"][0]["mesh"] = json!(5),
        "test.glb: nodes[0].mesh: the index is out of range"),
    (|f| f.json["nodes"][0]["scale"] = json!([1e300, 1, 1]),
        "test.glb: nodes[0]: its transform is not finite"),
    (|f| f.json["scene"] = json!(8),
        "test.glb: scene: the index is out of range"),
    (|f| { f.json["cameras"] = json!([{"type": "perspective", "perspective": {"yfov": 9.0, "znear": 0.1}}]);
           f.json["nodes"][0]["camera"] = json!(0); },
        "test.glb: cameras[0]: its field of view of 9 radians is not possible"),
    (|f| f.json["nodes"][0]["extensions"] = json!({"KHR_lights_punctual": {"light": 0}}),
        "test.glb: nodes[0].extensions.KHR_lights_punctual.light: the index is out of range"),
    (|f| { f.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [{"type": "spot", "spot": {"outerConeAngle": 3}}]}});
           f.json["nodes"][0]["extensions"] = json!({"KHR_lights_punctual": {"light": 0}}); },
        "test.glb: extensions.KHR_lights_punctual.lights[0]: its cone angles 0 and 3 are not possible"),
    (|f| f.json["nodes"][0]["extensions"] = json!({"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 77}}}),
        "test.glb: accessors[77]: does not exist"),
    (|f| f.json["nodes"][0]["extensions"] = json!({"EXT_mesh_gpu_instancing": {}}),
        "test.glb: nodes[0].extensions.EXT_mesh_gpu_instancing: has none of TRANSLATION, ROTATION, SCALE"),
    (|f| f.json["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]),
        "test.glb: extensionsRequired: KHR_draco_mesh_compression is not supported"),
    (|f| { f.json["materials"] = json!([{"pbrMetallicRoughness": {"roughnessFactor": 1e300}}]); f.primitive()["material"] = json!(0); },
        "test.glb: materials[0]: has a factor that is not finite"),
    (|f| { f.json["materials"] = json!([{"emissiveTexture": {"index": 3}}]); f.primitive()["material"] = json!(0); },
        "test.glb: materials[0].emissiveTexture.index: the index is out of range"),
];

#[test]
fn every_lie_has_its_sentence() {
    let mut wrong = Vec::new();
    for (break_it, sentence) in CASES {
        let mut file = Gltf::triangle();
        break_it(&mut file);
        let found = file.refused();
        if &found != sentence {
            wrong.push(format!("expected {sentence}\n   found {found}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(
        CASES.iter().all(|(_, sentence)| !sentence.contains('\n')),
        "one sentence is one line"
    );
}

#[test]
fn broken_containers() {
    let sentence = load(b"{\"asset\": null}").unwrap_err().to_string();
    assert!(
        sentence.starts_with("test.glb: JSON: invalid type: null, expected struct Asset"),
        "{sentence}"
    );
    let good = Gltf::triangle().glb();
    let refused = |bytes: &[u8]| load(bytes).unwrap_err().to_string();
    assert_eq!(
        refused(&good[..good.len() - 5]),
        format!(
            "test.glb: GLB header: the file is truncated: {} bytes expected, {} found",
            good.len(),
            good.len() - 5
        )
    );
    assert_eq!(
        refused(b"glTF"),
        "test.glb: GLB header: the file is truncated: 12 bytes expected, 4 found"
    );
    let mut version = good.clone();
    version[4] = 1;
    assert_eq!(
        refused(&version),
        "test.glb: GLB header: version 1 is not supported, only 2 is"
    );
    let mut chunk = good.clone();
    chunk[12..16].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(
        refused(&chunk).starts_with("test.glb: GLB chunk at byte 12: claims 4294967295 bytes, and")
    );
    assert!(refused(&pack(b"", b"abc")).ends_with("GLB: has no JSON chunk"));
    assert!(refused(b"").starts_with("test.glb: JSON: EOF"));
    assert!(refused(&pack(b"{\"asset\":", b"")).starts_with("test.glb: JSON: EOF"));
    let deep = format!("{}{}", "[".repeat(100_000), "]".repeat(100_000));
    assert!(refused(deep.as_bytes()).starts_with("test.glb: JSON: "));
}

#[test]
fn a_small_file_cannot_claim_much_memory() {
    // The same kilobyte read by sixty thousand primitives.
    let mut file = Gltf::triangle();
    let positions = file.floats("VEC3", &[0.25; 300]);
    let primitives: Vec<_> = (0..60_000)
        .map(|_| json!({"attributes": {"POSITION": 0, "COLOR_0": positions}}))
        .collect();
    file.json["meshes"][0]["primitives"] = json!(primitives);
    let sentence = file.refused();
    assert!(
        sentence.contains("MB from here on, more than the 68 MB allowed"),
        "{sentence}"
    );
    // A picture of a few hundred bytes that claims 30,000 pixels squared.
    let mut picture = png([1, 2, 3, 4]);
    picture[16..24].copy_from_slice(&[0, 0, 0x75, 0x30, 0, 0, 0x75, 0x30]);
    let crc = crc32(&picture[12..29]);
    picture[29..33].copy_from_slice(&crc.to_be_bytes());
    let mut file = Gltf::triangle();
    let view = file.view(&picture);
    file.json["images"] = json!([{"bufferView": view, "mimeType": "image/png", "name": "big"}]);
    file.json["textures"] = json!([{"source": 0}]);
    file.json["materials"] = json!([{"emissiveTexture": {"index": 0}}]);
    file.primitive()["material"] = json!(0);
    let sentence = file.refused();
    assert!(
        sentence.starts_with("test.glb: image \"big\" of 30000 x 30000 pixels: the scene needs"),
        "{sentence}"
    );
}

/// The check sum of PNG chunks (ISO 3309).
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| {
            if crc & 1 == 1 {
                (crc >> 1) ^ 0xEDB8_8320
            } else {
                crc >> 1
            }
        })
    })
}

#[test]
fn broken_pictures_are_pink_and_reported() {
    let good = png([9, 9, 9, 255]);
    for bytes in [
        &good[..20],
        b"\x76\x2f\x31\x01garbage",
        b"no picture",
        b"",
        b"#?RADIANCE\n\n",
    ] {
        let mut file = Gltf::triangle();
        let view = file.view(bytes);
        file.json["images"] = json!([{"bufferView": view, "mimeType": "image/png", "name": "bad"}]);
        file.json["textures"] = json!([{"source": 0}]);
        file.json["materials"] = json!([{"emissiveTexture": {"index": 0}}]);
        file.primitive()["material"] = json!(0);
        let imported = file.load().unwrap();
        let report = imported.report.to_string();
        assert!(report.contains("image \"bad\" cannot be read"), "{report}");
        assert_eq!(
            (imported.scene.images[0].width, imported.scene.images.len()),
            (1, 1)
        );
    }
}

#[test]
fn files_that_are_not_there() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |name: &str, content: Option<&[u8]>| {
        let path = folder.path().join(name);
        if let Some(content) = content {
            std::fs::write(&path, content).unwrap();
        }
        let error = matcha_import::load(&path, &LoadOptions::default(), &mut |_| {}).unwrap_err();
        error
            .to_string()
            .replace(&folder.path().display().to_string(), "DIR")
    };
    assert_eq!(
        refused("none.glb", None),
        "DIR/none.glb: cannot be read: No such file or directory (os error 2)"
    );
    assert_eq!(
        refused("a.obj", Some(b"v 0 0 0")),
        "DIR/a.obj: is neither glTF (.glb, .gltf) nor a Blender file (.blend)"
    );
    let json =
        br#"{"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4, "uri": "gone.bin"}]}"#;
    assert_eq!(
        refused("b.gltf", Some(json)),
        "DIR/b.gltf: buffers[0]: the file \"DIR/gone.bin\" cannot be read: No such file or directory (os error 2)"
    );
}

#[test]
fn an_empty_file_is_an_empty_scene() {
    let json = br#"{"asset": {"version": "2.0"}}"#;
    let imported = load_bytes("x", json, &build::options(), &mut |_| {}).unwrap();
    assert!(imported.scene.meshes.is_empty() && imported.scene.instances.is_empty());
}
