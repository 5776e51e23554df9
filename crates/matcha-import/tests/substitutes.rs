//! Everything that is replaced by something else is said, with its place, and refused in strict
//! mode.

mod build;

use build::{Gltf, cycles, png};
use matcha_import::{LoadOptions, load_bytes};
use serde_json::{Value, json};

type Case = (fn() -> Gltf, fn(&mut Gltf), &'static str);

fn extension(file: &mut Gltf) -> &mut Value {
    &mut file.json["extensions"]["MATCHA_cycles"]
}

fn of_node(file: &mut Gltf, node: usize, what: &str) -> usize {
    assert!(file.json["nodes"][node]["extensions"]["MATCHA_cycles"][what].is_object());
    node
}

fn set(file: &mut Gltf, node: usize, what: &str, key: &str, value: Value) {
    let node = of_node(file, node, what);
    file.json["nodes"][node]["extensions"]["MATCHA_cycles"][what][key] = value;
}

/// A triangle whose material has a picture, with a sampler.
fn textured() -> Gltf {
    let mut file = Gltf::triangle();
    let uv = file.floats("VEC2", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
    file.attribute("TEXCOORD_0", uv);
    let view = file.view(&png([9, 9, 9, 255]));
    file.json["images"] = json!([{"bufferView": view, "mimeType": "image/png", "name": "tile"}]);
    file.json["samplers"] = json!([{}]);
    file.json["textures"] = json!([{"source": 0, "sampler": 0}]);
    file.json["materials"] =
        json!([{"name": "Tile", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]);
    file.primitive()["material"] = json!(0);
    file
}

/// A triangle and a point light.
fn lit() -> Gltf {
    let mut file = Gltf::triangle();
    file.json["extensionsUsed"] = json!(["KHR_lights_punctual"]);
    file.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [{"type": "point"}]}});
    file.json["nodes"][0]["extensions"] = json!({"KHR_lights_punctual": {"light": 0}});
    file
}

#[rustfmt::skip]
const CASES: &[Case] = &[
    (Gltf::triangle, |f| f.json["extensionsUsed"] = json!(["KHR_materials_clearcoat"]),
        "extension KHR_materials_clearcoat is not supported: ignored"),
    (Gltf::triangle, |f| f.json["meshes"][0]["weights"] = json!([0.5]),
        "morph targets are not supported (mesh \"Tri\"): rendered without them"),
    (Gltf::triangle, |f| { let line = json!({"attributes": {"POSITION": 0}, "mode": 1}); f.json["meshes"][0]["primitives"].as_array_mut().unwrap().push(line); },
        "points and lines are not supported (meshes[0].primitives[1]): left out"),
    (Gltf::triangle, |f| { f.json["skins"] = json!([{"joints": [0]}]); f.json["nodes"][0]["skin"] = json!(0); },
        "skinned meshes are not supported (Node): rendered in the pose"),
    (textured, |f| f.json["samplers"][0] = json!({"wrapS": 33071}),
        "textures that wrap differently in u and v are not supported"),
    (textured, |f| f.json["samplers"][0] = json!({"magFilter": 9728}),
        "glTF textures without interpolation are not supported"),
    (textured, |f| f.json["materials"][0]["extensions"] = json!({"KHR_materials_transmission": {"transmissionFactor": 0.5, "transmissionTexture": {"index": 0}}}),
        "extension KHR_materials_transmission's texture is not supported (material \"Tile\"): the factor alone is used"),
    (textured, |f| f.json["materials"][0]["extensions"] = json!({"KHR_materials_specular": {"specularTexture": {"index": 0}}}),
        "extension KHR_materials_specular's textures is not supported (material \"Tile\"): the factor alone is used"),
    (textured, |f| f.json["images"][0] = json!({"uri": "data:image/png;base64,AAAA", "name": "tile"}),
        "image \"tile\" cannot be read"),
    (lit, |f| f.json["extensions"]["KHR_lights_punctual"]["lights"][0]["range"] = json!(2.0),
        "the range of lights is not supported (Node): the light falls off with the square of the distance"),
    (cycles, |f| set(f, 0, "object", "shadow_catcher", json!(true)),
        "shadow catchers are not supported (nodes[0], object \"Board\"): rendered as an ordinary object"),
    (cycles, |f| set(f, 1, "light", "portal", json!(true)),
        "light portals are not supported (light \"Area\"): left out"),
    (cycles, |f| { f.json["nodes"][0]["scale"] = json!([1, 2, 1]); f.json["nodes"][1]["rotation"] = json!([0.38268343, 0, 0, 0.92387953]); },
        "sheared area lights are not supported (light \"Area\"): its sides are perpendicular"),
    (cycles, |f| { set(f, 2, "camera", "type", json!("PANO")); set(f, 2, "camera", "panorama", json!("FISHEYE_EQUIDISTANT")); },
        "panoramas of type FISHEYE_EQUIDISTANT are not supported (camera \"\"): rendered as a full equirectangular one"),
    (cycles, |f| extension(f)["images"][0]["colorspace"] = json!("ACEScg"),
        "colour space ACEScg is not supported (image \"wood.png\"): read as sRGB"),
    (cycles, |f| extension(f)["images"][0]["alpha_mode"] = json!("SQUARE"),
        "alpha mode SQUARE is not known (image \"wood.png\"): read as straight alpha"),
    (cycles, |f| f.json["materials"][0]["extensions"]["MATCHA_cycles"]["use_transparent_shadow"] = json!(false),
        "a material without transparent shadows is not supported (material \"Oak\"): where it is transparent, its shadow is as well"),
    (cycles, |f| f.json["materials"][0]["extensions"]["MATCHA_cycles"]["use_bump_map_correction"] = json!(false),
        "a material without bump map correction is not supported (material \"Oak\"): its normals are corrected"),
];

#[test]
fn each_substitute_is_said_and_refused_in_strict_mode() {
    let strict = LoadOptions {
        strict: true,
        ..build::options()
    };
    for (make, change, sentence) in CASES {
        let mut file = make();
        let unchanged = load_bytes("a.glb", &file.glb(), &strict, &mut |_| {});
        assert!(
            unchanged.is_ok(),
            "before {sentence}: {:?}",
            unchanged.err()
        );
        change(&mut file);
        let imported = file
            .load()
            .unwrap_or_else(|error| panic!("{sentence}: {error}"));
        let lost: Vec<String> = (imported.report.items().iter())
            .filter(|item| !item.kind.is_note())
            .map(ToString::to_string)
            .collect();
        assert_eq!(lost.len(), 1, "{sentence}: {lost:?}");
        assert!(lost[0].contains(sentence), "{sentence}: {}", lost[0]);
        let refused = load_bytes("a.glb", &file.glb(), &strict, &mut |_| {});
        let said = refused.err().map(|error| error.to_string());
        let said = said.unwrap_or_else(|| panic!("not refused: {sentence}"));
        assert!(said.contains(sentence) && said.contains("a.glb"), "{said}");
    }
}
