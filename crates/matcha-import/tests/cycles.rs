//! The extension comes in whole, and its lies are refused.

mod build;

use build::{Gltf, cycles};
use glam::{Vec2, Vec3, Vec4};
use matcha_render::scene::{
    AlphaMode, ColorSpace, LightShape, PixelFilter, Projection, SensorFit, Shader,
};
use serde_json::{Value, json};

#[test]
fn the_files_format_says_whether_colour_is_multiplied_by_alpha() {
    let alpha = |mode: &str| {
        let mut file = cycles();
        extension(&mut file)["images"][0]["alpha_mode"] = json!(mode);
        file.load().unwrap().scene.images[0].alpha
    };
    assert_eq!(alpha("STRAIGHT"), AlphaMode::Straight);
    assert_eq!(
        alpha("PREMUL"),
        AlphaMode::Straight,
        "as Cycles reads a PNG"
    );
    assert_eq!(alpha("NONE"), AlphaMode::None);
    assert_eq!(alpha("CHANNEL_PACKED"), AlphaMode::ChannelPacked);
}

#[test]
fn everything_arrives() {
    let imported = cycles().load().unwrap();
    assert_eq!(imported.report.items(), [], "nothing is substituted");
    let scene = imported.scene;
    assert!(matches!(scene.materials[0].shader, Shader::Cycles(0)));
    assert_eq!(
        (
            scene.materials[0].pass_index,
            scene.materials[0].sample_emission
        ),
        (3.0, None)
    );
    assert_eq!(
        scene.materials[1].sample_emission,
        Some(matcha_render::scene::Sides::Back)
    );
    assert_eq!(
        (
            scene.trees.len(),
            scene.trees[0].nodes.len(),
            scene.trees[0].nodes[1].tree
        ),
        (2, 5, Some(1))
    );
    let image = &scene.images[0];
    assert_eq!(
        (image.name.as_str(), image.color_space, image.alpha),
        ("wood.png", ColorSpace::NonColor, AlphaMode::ChannelPacked)
    );

    let mesh = &scene.meshes[0];
    assert_eq!(
        (mesh.slots.as_slice(), mesh.material_slots.as_slice()),
        ([1].as_slice(), [0, 1].as_slice())
    );
    assert_eq!(scene.uv_names, ["", "UVMap"]);
    assert_eq!(mesh.generated, [[Vec3::splat(0.25); 3]]);
    assert_eq!(
        mesh.uv_sets[0].tangents.len(),
        1,
        "a normal map in tangent space asks for them"
    );
    let color = scene
        .attribute_names
        .iter()
        .position(|n| n == "Col")
        .unwrap() as u16;
    let active = scene
        .attribute_names
        .iter()
        .position(String::is_empty)
        .unwrap() as u16;
    for name in [color, active] {
        let attribute = mesh.attributes.iter().find(|a| a.name == name).unwrap();
        assert_eq!(attribute.corners, [[Vec4::splat(0.5); 3]]);
    }

    let instance = &scene.instances[0];
    assert_eq!(
        (instance.name.as_str(), instance.pass_index, instance.random),
        ("Board", 4.0, 0.25)
    );
    assert_eq!(
        instance.materials,
        [1, 1],
        "slots that the object lacks are the mesh's"
    );
    assert!(!instance.visibility.camera && instance.visibility.shadow && instance.holdout);

    let light = &scene.lights[0];
    let LightShape::Area {
        size,
        ellipse,
        spread,
    } = light.shape
    else {
        panic!()
    };
    assert_eq!((size, ellipse, spread), (Vec2::new(2.0, 3.0), false, 2.0));
    assert_eq!(light.power, Vec3::new(20.0, 10.0, 0.0));
    assert!(
        (light.transform.matrix3.determinant() - 1.0).abs() < 1e-6,
        "the scale is in the size"
    );

    assert_eq!(
        (scene.world.color, scene.world.importance_sample),
        (Vec3::new(0.1, 0.2, 0.3), false)
    );
    let camera = &scene.camera;
    assert!(
        matches!(camera.projection, Projection::Perspective { tan_half_width, fit: SensorFit::Vertical } if (tan_half_width - 0.24).abs() < 1e-6)
    );
    assert!((camera.aperture_radius - 0.0125).abs() < 1e-7);
    assert_eq!(
        (camera.focus_distance, camera.blades, camera.shift),
        (3.0, (6, 0.5), Vec2::new(0.1, 0.0))
    );
    let settings = &scene.settings;
    assert_eq!(
        (settings.resolution, settings.samples, settings.filter),
        ([320, 200], 7, PixelFilter::Gaussian(2.0))
    );
    assert_eq!(
        (settings.seed, settings.view.transform.as_str()),
        (u32::MAX, "Standard")
    );
}

/// Its cone is as wide as its object's scale makes it.
#[test]
fn a_spot_keeps_its_scale() {
    let mut file = cycles();
    file.json["nodes"][1]["extensions"]["MATCHA_cycles"]["light"]["type"] = json!("SPOT");
    let scene = file.load().unwrap().scene;
    let matrix = scene.lights[0].transform.matrix3;
    let lengths = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|axis| axis.length());
    assert_eq!(lengths, [2.0, 3.0, 1.0]);
}

/// It looks where it did, and left is right.
#[test]
fn a_mirrored_camera_turns_the_picture_over() {
    let camera = |scale: [f32; 3]| {
        let mut file = cycles();
        file.json["nodes"][2]["scale"] = json!(scale);
        file.load().unwrap().scene.camera.transform.matrix3
    };
    let (plain, mirrored) = (camera([1.0, 1.0, 1.0]), camera([-2.0, 1.0, 3.0]));
    assert!((mirrored.x_axis + plain.x_axis).length() < 1e-6);
    assert!((mirrored.y_axis - plain.y_axis).length() < 1e-6);
    assert!((mirrored.z_axis - plain.z_axis).length() < 1e-6);
}

/// Files from before the exporter wrote it have none.
#[test]
fn bounces_before_roulette_are_none_where_absent() {
    let mut file = cycles();
    assert_eq!(file.load().unwrap().scene.settings.min_bounces, 0);
    extension(&mut file)["settings"]["min_bounces"] = json!(3);
    assert_eq!(file.load().unwrap().scene.settings.min_bounces, 3);
}

fn extension(file: &mut Gltf) -> &mut Value {
    &mut file.json["extensions"]["MATCHA_cycles"]
}

fn object(file: &mut Gltf) -> &mut Value {
    &mut file.json["nodes"][0]["extensions"]["MATCHA_cycles"]["object"]
}

#[test]
fn lies_are_refused() {
    type Case = (fn(&mut Gltf), &'static str);
    #[rustfmt::skip]
    let cases: &[Case] = &[
        (|f| extension(f)["version"] = json!(2), "MATCHA_cycles: its version 2 is not known here, only 1 is"),
        (|f| extension(f)["trees"][0]["links"][0]["to"] = json!([9, 0]),
            "material \"Elm\": link 0, from socket 0 of node 0 to socket 0 of node 9, has a loose end"),
        (|f| extension(f)["trees"][0]["links"][0]["from"] = json!([2, 0]),
            "material \"Elm\", node \"Normal Map\": its input depends on its own output"),
        (|f| extension(f)["trees"][1]["nodes"][0]["tree"] = json!(1),
            "group \"Tint\", node \"In\": the group \"Tint\" contains itself"),
        (|f| extension(f)["trees"][0]["nodes"][0]["image"] = json!(4),
            "material \"Elm\", node \"Image\": its image 4 does not exist"),
        (|f| extension(f)["world"]["tree"] = json!(7), "world \"World\": its tree 7 does not exist"),
        (|f| extension(f)["settings"]["resolution"] = json!([0, 10]),
            "MATCHA_cycles settings: a picture of 0 x 10 pixels is not possible"),
        (|f| object(f)["materials"] = json!([5]), "nodes[0], object \"Board\": one of its materials does not exist"),
        (|f| object(f)["random"] = json!(1e300),
            "nodes[0], object \"Board\": its colour, index or random number is not finite"),
        (|f| f.json["materials"][0]["extensions"]["MATCHA_cycles"]["tree"] = json!(9),
            "material \"Oak\": its tree 9 does not exist"),
        (|f| f.primitive()["extensions"]["MATCHA_cycles"]["slot"] = json!(2),
            "meshes[0].primitives[0]: its slot 2 is not one of the mesh's 2"),
        (|f| f.json["meshes"][0]["extensions"]["MATCHA_cycles"]["material_slots"] = json!([0, 3]),
            "meshes[0]: a material slot holds a material that does not exist"),
        (|f| f.json["meshes"][0]["extensions"]["MATCHA_cycles"]["generated_size"] = json!([1, 0, 1]),
            "meshes[0]: its Generated texture space is not finite or has no size"),
        (|f| f.json["nodes"][1]["extensions"]["MATCHA_cycles"]["light"]["size"] = json!([-1, 0]),
            "light \"Area\": its power or one of its sizes is negative or not finite"),
        (|f| f.json["nodes"][2]["extensions"]["MATCHA_cycles"]["camera"]["lens"] = json!(0),
            "camera \"\": its lens, sensor, scale, shift or clipping is not possible"),
        (|f| extension(f)["trees"] = json!("many"),
            "MATCHA_cycles of the file: invalid type: string \"many\", expected a sequence"),
    ];
    for (break_it, sentence) in cases {
        let mut file = cycles();
        break_it(&mut file);
        assert_eq!(file.refused(), format!("test.glb: {sentence}"));
    }
}

#[test]
fn a_missing_image_is_pink_and_named() {
    let mut file = cycles();
    extension(&mut file)["images"][0] = json!({"name": "lost.png", "colorspace": "ACEScg", "alpha_mode": "STRAIGHT", "missing": true});
    let report = file.load().unwrap().report.to_string();
    assert!(
        report.contains("image \"lost.png\" cannot be read (Blender could not find it)"),
        "{report}"
    );
    assert!(
        report.contains("colour space ACEScg is not supported (image \"lost.png\"): read as sRGB"),
        "{report}"
    );
}
