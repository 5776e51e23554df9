//! Plain glTF comes in with every feature that the crate claims.

mod build;

use build::{BYTE, Gltf, UBYTE, UINT, USHORT, load, png};
use glam::{Vec2, Vec3, Vec4};
use matcha_import::{LoadOptions, load_bytes};
use matcha_render::scene::{
    ColorSpace, LightShape, Mesh, Pixels, Projection, Scene, SensorFit, Shader,
};
use matcha_shade::source::{Extension, GltfAlpha, GltfMaterial};
use serde_json::json;

fn scene(file: &Gltf) -> Scene {
    file.load().unwrap().scene
}

fn near(a: Vec3, b: Vec3) -> bool {
    (a - b).length() < 1e-5
}

fn gltf_material(scene: &Scene, index: usize) -> &GltfMaterial {
    match &scene.materials[index].shader {
        Shader::Gltf(material) => material,
        Shader::Cycles(_) => panic!("a plain material is expected"),
    }
}

#[test]
fn y_up_becomes_z_up() {
    let mut file = Gltf::triangle();
    file.json["nodes"] = json!([{"mesh": 0, "translation": [1, 2, 3], "scale": [2, 3, 4]}]);
    let scene = scene(&file);
    let (mesh, instance) = (&scene.meshes[0], &scene.instances[0]);
    assert_eq!(mesh.positions, [Vec3::ZERO, Vec3::X, Vec3::Z]);
    // glTF's (0, 1, 0) of the mesh is at (1, 5, 3) of glTF's world.
    assert!(near(
        instance.transform.transform_point3(Vec3::Z),
        Vec3::new(1.0, -3.0, 5.0)
    ));
    assert!(near(
        instance.transform.transform_point3(Vec3::X),
        Vec3::new(3.0, -3.0, 2.0)
    ));
    assert!(
        mesh.corner_normals.is_empty(),
        "no normals in the file: flat"
    );
}

#[test]
fn hierarchy_of_matrices_and_trs() {
    let mut file = Gltf::triangle();
    let half = 0.5_f32.sqrt();
    file.json["nodes"] = json!([
        {"children": [1], "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 10,0,0,1]},
        {"mesh": 0, "rotation": [0, 0, half, half]} // a quarter turn about glTF's z
    ]);
    let scene = scene(&file);
    let at = |p| scene.instances[0].transform.transform_point3(p);
    // The mesh's X goes to glTF's +Y, which is our +Z.
    assert!(
        near(at(Vec3::X), Vec3::new(10.0, 0.0, 1.0)),
        "{}",
        at(Vec3::X)
    );
}

#[test]
fn indices_of_all_widths_and_modes() {
    let square = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0];
    for (component, bytes) in [
        (UBYTE, vec![0_u8, 1, 2, 2, 1, 3]),
        (
            USHORT,
            [0_u16, 1, 2, 2, 1, 3]
                .iter()
                .flat_map(|i| i.to_le_bytes())
                .collect(),
        ),
        (
            UINT,
            [0_u32, 1, 2, 2, 1, 3]
                .iter()
                .flat_map(|i| i.to_le_bytes())
                .collect(),
        ),
    ] {
        let mut file = Gltf::triangle();
        let positions = file.floats("VEC3", &square);
        let indices = file.accessor(component, "SCALAR", 6, &bytes);
        file.attribute("POSITION", positions);
        file.primitive()["indices"] = json!(indices);
        assert_eq!(scene(&file).meshes[0].indices, [[0, 1, 2], [2, 1, 3]]);
    }
    for (mode, expected) in [(5, [[0, 1, 2], [1, 3, 2]]), (6, [[1, 2, 0], [2, 3, 0]])] {
        let mut file = Gltf::triangle();
        let positions = file.floats("VEC3", &square);
        file.attribute("POSITION", positions);
        file.primitive()["mode"] = json!(mode);
        assert_eq!(scene(&file).meshes[0].indices, expected, "mode {mode}");
    }
}

#[test]
fn sparse_and_normalised_accessors() {
    let mut file = Gltf::triangle();
    let indices = file.view(&[2]);
    let values: Vec<u8> = [5.0_f32, 6.0, 7.0]
        .iter()
        .flat_map(|v| v.to_le_bytes())
        .collect();
    let values = file.view(&values);
    file.json["accessors"][0]["sparse"] = json!({
        "count": 1,
        "indices": {"bufferView": indices, "componentType": UBYTE},
        "values": {"bufferView": values}
    });
    let uv: Vec<u8> = [0_u16, 65_535, 32_768, 0, 65_535, 65_535]
        .iter()
        .flat_map(|v| v.to_le_bytes())
        .collect();
    let uv = file.accessor(USHORT, "VEC2", 3, &uv);
    file.json["accessors"][uv]["normalized"] = json!(true);
    file.attribute("TEXCOORD_0", uv);
    let scene = scene(&file);
    let mesh = &scene.meshes[0];
    assert_eq!(mesh.positions[2], Vec3::new(5.0, -7.0, 6.0));
    let corners = mesh.uv_sets[0].corners[0];
    assert_eq!(corners[0], Vec2::new(0.0, 0.0), "v is flipped");
    assert!((corners[1] - Vec2::new(32_768.0 / 65_535.0, 1.0)).length() < 1e-6);
}

#[test]
fn strided_attributes_and_signed_bytes() {
    let mut file = Gltf::triangle();
    // Normals as normalised bytes, four bytes apart.
    let normals = file.accessor(BYTE, "VEC3", 3, &[0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 129, 0]);
    file.json["accessors"][normals]["normalized"] = json!(true);
    let view = file.json["accessors"][normals]["bufferView"]
        .as_u64()
        .unwrap() as usize;
    file.json["bufferViews"][view]["byteStride"] = json!(4);
    file.attribute("NORMAL", normals);
    let scene = scene(&file);
    let normals = scene.meshes[0].corner_normals[0];
    assert!(
        near(normals[0], -Vec3::Y) && near(normals[2], Vec3::Y),
        "{normals:?}"
    );
}

#[test]
fn uv_sets_and_colours_are_named() {
    let mut file = Gltf::triangle();
    for set in 0..2 {
        let uv = file.floats("VEC2", &[set as f32; 6]);
        file.attribute(&format!("TEXCOORD_{set}"), uv);
    }
    let color = file.accessor(
        UBYTE,
        "VEC4",
        3,
        &[255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 51],
    );
    file.json["accessors"][color]["normalized"] = json!(true);
    file.attribute("COLOR_0", color);
    let weight = file.floats("SCALAR", &[0.25; 3]);
    file.attribute("_DIRT", weight);
    let scene = scene(&file);
    let mesh = &scene.meshes[0];
    assert_eq!(scene.uv_names, ["", "TEXCOORD_0", "TEXCOORD_1"]);
    assert_eq!(mesh.uv_sets[1].corners[0][0], Vec2::new(1.0, 0.0));
    let attribute = |name: &str| {
        let index = scene
            .attribute_names
            .iter()
            .position(|n| n == name)
            .unwrap() as u16;
        mesh.attributes
            .iter()
            .find(|a| a.name == index)
            .unwrap()
            .corners[0]
    };
    assert_eq!(attribute("COLOR_0")[2], Vec4::new(0.0, 0.0, 1.0, 0.2));
    assert_eq!(attribute("_DIRT")[1], Vec4::new(0.25, 0.25, 0.25, 1.0));
    let color = scene
        .attribute_names
        .iter()
        .position(|n| n == "COLOR_0")
        .unwrap() as u16;
    assert_eq!(gltf_material(&scene, 0).vertex_color, Some(color));
}

#[test]
fn primitives_merge_into_one_mesh_with_slots() {
    let mut file = Gltf::triangle();
    file.json["materials"] = json!([{"name": "A"}, {"name": "B"}]);
    let uv = file.floats("VEC2", &[0.5; 6]);
    let second = file.floats("VEC3", &[0.0, 0.0, 1.0, 1.0, 0.0, 1.0, 0.0, 1.0, 1.0]);
    let normals = file.floats("VEC3", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
    file.json["meshes"][0]["primitives"] = json!([
        {"attributes": {"POSITION": 0}, "material": 1},
        {"attributes": {"POSITION": second, "TEXCOORD_0": uv, "NORMAL": normals}, "material": 0},
        {"attributes": {"POSITION": 0}, "material": 1}
    ]);
    let scene = scene(&file);
    let mesh: &Mesh = &scene.meshes[0];
    assert_eq!(mesh.slots, [0, 1, 0]);
    let names: Vec<_> = mesh
        .material_slots
        .iter()
        .map(|&m| scene.materials[m as usize].name.as_str())
        .collect();
    assert_eq!(names, ["B", "A"]);
    assert_eq!(
        mesh.indices,
        [[0, 1, 2], [3, 4, 5], [0, 1, 2]],
        "shared positions are there once"
    );
    assert_eq!(mesh.uv_sets[0].corners.len(), 3);
    assert_eq!(mesh.uv_sets[0].corners[2][0], Vec2::ZERO);
    assert_eq!(mesh.corner_normals.len(), 3);
    assert!(
        near(mesh.corner_normals[0][0], -Vec3::Y),
        "flat normal where the file has none"
    );
}

#[test]
fn a_material_with_and_without_vertex_colours_is_two() {
    let mut file = Gltf::triangle();
    file.json["materials"] = json!([{"name": "A"}]);
    let color = file.floats("VEC3", &[0.5; 9]);
    file.json["meshes"] = json!([
        {"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]},
        {"primitives": [{"attributes": {"POSITION": 0, "COLOR_0": color}, "material": 0}]}
    ]);
    file.json["nodes"] = json!([{"mesh": 0, "children": [1]}, {"mesh": 1}]);
    let scene = scene(&file);
    assert_eq!(scene.materials.len(), 2);
    assert_eq!(gltf_material(&scene, 0).vertex_color, None);
    assert_eq!(gltf_material(&scene, 1).vertex_color, Some(0));
}

#[test]
fn instancing() {
    let mut file = Gltf::triangle();
    let translations = file.floats("VEC3", &[1.0, 0.0, 0.0, 2.0, 0.0, 0.0]);
    let scales = file.floats("VEC3", &[1.0, 1.0, 1.0, 3.0, 3.0, 3.0]);
    file.json["extensionsRequired"] = json!(["EXT_mesh_gpu_instancing"]);
    file.json["nodes"][0]["translation"] = json!([10, 0, 0]);
    file.json["nodes"][0]["extensions"] = json!({"EXT_mesh_gpu_instancing": {
        "attributes": {"TRANSLATION": translations, "SCALE": scales}
    }});
    let scene = scene(&file);
    assert_eq!((scene.meshes.len(), scene.instances.len()), (1, 2));
    assert!(near(
        scene.instances[1].transform.transform_point3(Vec3::X),
        Vec3::new(15.0, 0.0, 0.0)
    ));
}

#[test]
fn cameras() {
    let mut file = Gltf::triangle();
    file.json["cameras"] = json!([{"type": "perspective", "perspective":
        {"yfov": 1.0, "znear": 0.1, "zfar": 50.0, "aspectRatio": 2.0}}]);
    file.json["nodes"] = json!([{"mesh": 0, "children": [1]}, {"camera": 0, "translation": [0, 0, 5], "scale": [2, 2, 2]}]);
    let perspective = scene(&file);
    let camera = &perspective.camera;
    let Projection::Perspective {
        tan_half_width,
        fit,
    } = camera.projection
    else {
        panic!()
    };
    assert!((tan_half_width - 0.5_f32.tan()).abs() < 1e-6 && fit == SensorFit::Vertical);
    assert_eq!(camera.clip, [0.1, 50.0]);
    assert_eq!(perspective.settings.resolution, [1080, 540]);
    assert!(near(
        camera.transform.transform_point3(Vec3::ZERO),
        Vec3::new(0.0, -5.0, 0.0)
    ));
    assert!(
        near(camera.transform.transform_vector3(-Vec3::Z), Vec3::Y),
        "it looks along glTF's -z"
    );
    assert!(
        near(camera.transform.transform_vector3(Vec3::Y), Vec3::Z),
        "up is up"
    );
    file.json["cameras"] = json!([{"type": "orthographic", "orthographic":
        {"xmag": 2.0, "ymag": 1.5, "znear": 0.1, "zfar": 50.0}}]);
    let Projection::Orthographic { scale, fit } = scene(&file).camera.projection else {
        panic!()
    };
    assert_eq!((scale, fit), (3.0, SensorFit::Vertical));
}

#[test]
fn a_camera_is_made_that_sees_everything() {
    let mut file = Gltf::triangle();
    file.json["nodes"][0]["translation"] = json!([100, -7, 30]);
    let imported = file.load().unwrap();
    let (scene, report) = (&imported.scene, imported.report.to_string());
    assert!(
        report.contains("no camera in the file: one that sees all of the scene was made"),
        "{report}"
    );
    assert!(
        report.contains("no light in the file: lit by a constant world"),
        "{report}"
    );
    assert!(scene.world.color.min_element() > 0.0);
    let Projection::Perspective { tan_half_width, .. } = scene.camera.projection else {
        panic!()
    };
    let to_camera = scene.camera.transform.inverse();
    for &p in &scene.meshes[0].positions {
        let p = to_camera.transform_point3(scene.instances[0].transform.transform_point3(p));
        assert!(p.z < -scene.camera.clip[0] && -p.z < scene.camera.clip[1]);
        assert!(
            p.x.abs() <= -p.z * tan_half_width
                && p.y.abs() <= -p.z * tan_half_width * 540.0 / 960.0
        );
    }
}

#[test]
fn punctual_lights_in_blenders_units() {
    let mut file = Gltf::triangle();
    file.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [
        {"type": "point", "intensity": 683.0, "color": [1.0, 0.5, 0.0]},
        {"type": "directional", "intensity": 1366.0},
        {"type": "spot", "intensity": 683.0, "spot": {"innerConeAngle": 0.0, "outerConeAngle": 0.5}}
    ]}});
    file.json["nodes"] = json!([{"mesh": 0, "children": [1, 2, 3]},
        {"extensions": {"KHR_lights_punctual": {"light": 0}}},
        {"extensions": {"KHR_lights_punctual": {"light": 1}}},
        {"extensions": {"KHR_lights_punctual": {"light": 2}}}]);
    let scene = scene(&file);
    let four_pi = 4.0 * std::f32::consts::PI;
    assert!(
        near(
            scene.lights[0].power,
            Vec3::new(four_pi, 0.5 * four_pi, 0.0)
        ),
        "1 W/sr is 4π W"
    );
    assert!(matches!(
        scene.lights[0].shape,
        LightShape::Point { radius: 0.0, .. }
    ));
    assert!(near(scene.lights[1].power, Vec3::splat(2.0)));
    assert!(near(
        scene.lights[1].transform.transform_vector3(-Vec3::Z),
        Vec3::Y
    ));
    let LightShape::Spot { angle, blend, .. } = scene.lights[2].shape else {
        panic!()
    };
    assert_eq!((angle, blend), (1.0, 1.0));
    assert_eq!(
        scene.world.color,
        Vec3::ZERO,
        "there is light, so none is added"
    );
}

#[test]
fn materials_with_their_extensions() {
    let mut file = Gltf::triangle();
    let view = file.view(&png([255, 0, 0, 255]));
    file.json["images"] = json!([{"bufferView": view, "mimeType": "image/png", "name": "red"}]);
    file.json["samplers"] = json!([{"wrapS": 33071, "wrapT": 33071}]);
    file.json["textures"] = json!([{"source": 0, "sampler": 0}]);
    let uv = file.floats("VEC2", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
    file.attribute("TEXCOORD_0", uv);
    file.primitive()["material"] = json!(0);
    file.json["materials"] = json!([{
        "name": "Paint", "alphaMode": "MASK", "alphaCutoff": 0.25, "emissiveFactor": [1, 0, 0],
        "normalTexture": {"index": 0, "scale": 0.5,
            "extensions": {"KHR_texture_transform": {"offset": [0.25, 0.5], "rotation": 0.5, "scale": [2, 3]}}},
        "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.5, 0.5, 1], "metallicFactor": 0.1, "roughnessFactor": 0.2,
            "baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 0, "texCoord": 1}},
        "extensions": {
            "KHR_materials_emissive_strength": {"emissiveStrength": 5.0},
            "KHR_materials_ior": {"ior": 1.33},
            "KHR_materials_transmission": {"transmissionFactor": 0.75},
            "KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [1, 0.5, 0]}
        }
    }]);
    let scene = scene(&file);
    let material = gltf_material(&scene, 0);
    assert_eq!(material.alpha, GltfAlpha::Mask(0.25));
    assert_eq!(material.emission, Vec3::new(5.0, 0.0, 0.0));
    assert!(scene.materials[0].sample_emission.is_some());
    assert_eq!((material.ior, material.transmission), (1.33, 0.75));
    assert_eq!(material.specular, (0.5, Vec3::new(1.0, 0.5, 0.0)));
    assert_eq!((material.metallic, material.roughness), (0.1, 0.2));
    let base = material.base_color_texture.unwrap();
    let rough = material.metallic_roughness_texture.unwrap();
    let (normal, strength) = material.normal_texture.unwrap();
    assert_eq!(base.extension, Extension::Extend);
    assert_eq!(
        (strength, normal.transform),
        (0.5, (Vec2::new(0.25, 0.5), 0.5, Vec2::new(2.0, 3.0)))
    );
    assert_eq!(scene.uv_names[base.uv as usize], "TEXCOORD_0");
    assert_eq!(scene.uv_names[rough.uv as usize], "TEXCOORD_1");
    let (color, data) = (
        &scene.images[base.image as usize],
        &scene.images[rough.image as usize],
    );
    assert_eq!(
        (color.color_space, data.color_space),
        (ColorSpace::Srgb, ColorSpace::NonColor)
    );
    let (Pixels::Rgba8(a), Pixels::Rgba8(b)) = (&color.pixels, &data.pixels) else {
        panic!("8 bits stay 8 bits")
    };
    assert!(
        std::sync::Arc::ptr_eq(a, b),
        "the same picture is decoded and held once"
    );
    assert_eq!(a[0], [255, 0, 0, 255]);
    let tangents = &scene.meshes[0].uv_sets[0].tangents;
    assert_eq!(tangents.len(), 1, "a normal map needs tangents");
    // In the file v runs down, so along +Y of glTF v falls: tangent +X, sign for v up is negative.
    assert!(
        (tangents[0][0] - Vec4::new(1.0, 0.0, 0.0, -1.0)).length() < 1e-5,
        "{:?}",
        tangents[0]
    );
}

#[test]
fn unlit_materials_only_emit() {
    let mut file = Gltf::triangle();
    file.primitive()["material"] = json!(0);
    file.json["materials"] = json!([{
        "pbrMetallicRoughness": {"baseColorFactor": [0.2, 0.4, 0.6, 0.5]},
        "extensions": {"KHR_materials_unlit": {}}
    }]);
    let scene = scene(&file);
    let material = gltf_material(&scene, 0);
    assert_eq!(material.emission, Vec3::new(0.2, 0.4, 0.6));
    assert_eq!(material.base_color, Vec4::new(0.0, 0.0, 0.0, 0.5));
    assert_eq!(scene.world.color, Vec3::ZERO, "what glows is light");
}

#[test]
fn images_as_data_uris_and_files() {
    use base64::Engine;
    let text = base64::engine::general_purpose::STANDARD.encode(png([0, 255, 0, 255]));
    let mut file = Gltf::triangle();
    file.json["images"] = json!([{"uri": format!("data:image/png;base64,{text}")}, {"uri": "blue%20sky.png"}, {"uri": "none.png"}]);
    file.json["textures"] = json!([{"source": 0}, {"source": 1}, {"source": 2}]);
    file.json["materials"] = json!([{
        "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
        "emissiveTexture": {"index": 1}, "normalTexture": {"index": 2}}]);
    file.primitive()["material"] = json!(0);
    let bin = file.bin.clone();
    file.json["buffers"] = json!([{"byteLength": bin.len(), "uri": "data.bin"}]);
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("blue sky.png"), png([0, 0, 255, 255])).unwrap();
    std::fs::write(folder.path().join("data.bin"), bin).unwrap();
    let path = folder.path().join("test.gltf");
    std::fs::write(&path, file.json.to_string()).unwrap();
    let imported = matcha_import::load(&path, &build::options(), &mut |_| {}).unwrap();
    let scene = &imported.scene;
    assert_eq!(scene.name, "test");
    let pixel = |i: usize| match &scene.images[i].pixels {
        Pixels::Rgba8(pixels) => pixels[0].map(f32::from),
        Pixels::RgbaF32(pixels) => pixels[0].map(|x| x * 255.0),
    };
    let colors: Vec<_> = (0..3).map(pixel).collect();
    assert!(
        colors.contains(&[0.0, 255.0, 0.0, 255.0]) && colors.contains(&[0.0, 0.0, 255.0, 255.0])
    );
    assert!(
        colors.contains(&[255.0, 0.0, 255.0, 255.0]),
        "the missing one is pink"
    );
    let report = imported.report.to_string();
    assert!(
        report.contains("image \"none.png\" cannot be read"),
        "{report}"
    );
    let strict = LoadOptions {
        strict: true,
        ..build::options()
    };
    let error = matcha_import::load(&path, &strict, &mut |_| {})
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("strict") && error.contains("none.png"),
        "{error}"
    );
    assert!(!error.contains("no camera"), "notes are no errors: {error}");
}

#[test]
fn what_is_not_supported_is_said() {
    let mut file = Gltf::triangle();
    file.json["extensionsUsed"] = json!(["KHR_materials_clearcoat"]);
    file.json["meshes"][0]["weights"] = json!([0.5]);
    let line = json!({"attributes": {"POSITION": 0}, "mode": 1});
    file.json["meshes"][0]["primitives"]
        .as_array_mut()
        .unwrap()
        .push(line);
    let report = file.load().unwrap().report.to_string();
    for part in [
        "KHR_materials_clearcoat is not supported: ignored",
        "morph targets",
        "points and lines",
    ] {
        assert!(report.contains(part), "{part} is not in\n{report}");
    }
    let strict = LoadOptions {
        strict: true,
        ..build::options()
    };
    assert!(load_bytes("x", &file.glb(), &strict, &mut |_| {}).is_err());
    assert!(load(&file.glb()).is_ok());
}

#[test]
fn triangles_without_area_are_dropped_and_counted() {
    let mut file = Gltf::triangle();
    let indices = file.accessor(UBYTE, "SCALAR", 9, &[0, 1, 2, 0, 0, 1, 1, 1, 1]);
    file.primitive()["indices"] = json!(indices);
    let imported = file.load().unwrap();
    assert_eq!(imported.scene.meshes[0].indices.len(), 1);
    let report = imported.report.to_string();
    assert!(
        report.contains("triangles without area (first: mesh \"Tri\"; 2 times): left out"),
        "{report}"
    );
}
