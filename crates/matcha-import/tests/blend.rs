//! `.blend` files through a real Blender, where there is one.

mod build;

use matcha_import::{ImportError, LoadOptions, Progress, load};
use std::path::{Path, PathBuf};
use std::process::Command;

/// A Python with `bpy`, or None with a loud line. Where a Blender is required, its absence fails.
fn python() -> Option<PathBuf> {
    let named = std::env::var_os("MATCHA_PYTHON").map(PathBuf::from);
    let candidates = named
        .into_iter()
        .chain(["python3", "python"].map(PathBuf::from));
    let has_bpy = |python: &PathBuf| {
        Command::new(python)
            .args(["-c", "import bpy"])
            .output()
            .is_ok_and(|out| out.status.success())
    };
    let found = candidates.into_iter().find(has_bpy);
    if found.is_none() {
        let required = std::env::var("CI").is_ok_and(|ci| ci == "true")
            && std::env::var("MATCHA_REQUIRE_BLENDER").is_ok_and(|required| required == "1");
        assert!(
            !required,
            "no Python with bpy, and MATCHA_REQUIRE_BLENDER asks for one"
        );
        eprintln!("\n*** skipped: no Blender (no Python with bpy; set MATCHA_PYTHON) ***\n");
    }
    found
}

const SCENE: &str = r#"
import bpy, sys
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.engine = "CYCLES"
image = bpy.data.images.load(sys.argv[1] + "/dots.png")
material = bpy.data.materials.new("Dotted")
material.use_nodes = True
tree = material.node_tree
node = tree.nodes.new("ShaderNodeTexImage")
node.image = image
principled = next(n for n in tree.nodes if n.bl_idname == "ShaderNodeBsdfPrincipled")
tree.links.new(node.outputs["Color"], principled.inputs["Base Color"])
bpy.ops.mesh.primitive_cube_add(size=2, location=(1, 2, 3))
cube = bpy.context.object
cube.data.materials.append(material)
copy = bpy.data.objects.new("Copy", cube.data)
scene.collection.objects.link(copy)
bpy.ops.object.light_add(type="POINT", location=(0, 0, 5))
bpy.context.object.data.energy = 50
bpy.ops.object.camera_add(location=(0, -8, 0), rotation=(1.5707964, 0, 0))
scene.camera = bpy.context.object
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[1] + "/cube.blend")
"#;

fn make(python: &Path, folder: &Path) -> PathBuf {
    std::fs::write(folder.join("dots.png"), build::png([200, 100, 50, 255])).unwrap();
    std::fs::write(folder.join("make.py"), SCENE).unwrap();
    let status = Command::new(python)
        .arg(folder.join("make.py"))
        .arg(folder)
        .output()
        .unwrap();
    let blend = folder.join("cube.blend");
    assert!(
        blend.is_file(),
        "{}",
        String::from_utf8_lossy(&status.stderr)
    );
    blend
}

#[test]
fn a_blend_file_is_exported_once_and_again_when_it_changes() {
    let Some(python) = python() else { return };
    let folder = tempfile::tempdir().unwrap();
    let blend = make(&python, folder.path());
    let cache = folder.path().join("kept");
    let options = LoadOptions {
        blender: None,
        cache_dir: Some(cache.clone()),
        ..LoadOptions::default()
    };
    // `blender` may be on PATH; the Python is what this test is about.
    let options = LoadOptions {
        blender: python.file_name().map(|_| python.clone()),
        ..options
    };
    let exports = |options: &LoadOptions| {
        let mut exported = 0;
        let imported = load(&blend, options, &mut |progress| {
            exported += usize::from(matches!(progress, Progress::Export { .. }));
        })
        .unwrap();
        (imported, exported)
    };
    let (imported, exported) = exports(&options);
    assert!(exported > 0, "progress is told");
    let scene = &imported.scene;
    assert_eq!(
        (
            scene.name.as_str(),
            scene.meshes.len(),
            scene.instances.len()
        ),
        ("cube", 1, 2)
    );
    assert_eq!((scene.lights.len(), scene.images.len()), (1, 1));
    let cube = scene.instances.iter().find(|i| i.name != "Copy").unwrap();
    assert_eq!(cube.transform.translation.to_array(), [1.0, 2.0, 3.0]);
    let low = scene.meshes[0]
        .positions
        .iter()
        .fold(glam::Vec3::MAX, |a, p| a.min(*p));
    assert!((low + 1.0).length() < 1e-6);
    let ahead = scene.camera.transform.transform_vector3(-glam::Vec3::Z);
    assert!((ahead - glam::Vec3::Y).length() < 1e-5, "{ahead}");
    assert_eq!(
        exports(&options).1,
        0,
        "nothing has changed: the kept export is used"
    );
    let glbs = || {
        std::fs::read_dir(&cache)
            .unwrap()
            .flatten()
            .filter(|e| e.path().extension().is_some_and(|x| x == "glb"))
            .count()
    };
    assert_eq!(glbs(), 1);
    // A changed texture is a changed scene.
    std::fs::write(folder.path().join("dots.png"), build::png([0, 0, 0, 255])).unwrap();
    assert!(
        exports(&options).1 > 0,
        "the texture is new: exported again"
    );
    assert_eq!(glbs(), 1, "older exports are forgotten");
}

#[test]
fn a_broken_blend_file_is_one_sentence() {
    let Some(python) = python() else { return };
    let folder = tempfile::tempdir().unwrap();
    let blend = folder.path().join("broken.blend");
    std::fs::write(&blend, b"BLENDER-v405 and then nothing").unwrap();
    let options = LoadOptions {
        blender: Some(python),
        cache_dir: Some(folder.path().to_owned()),
        ..LoadOptions::default()
    };
    let error = load(&blend, &options, &mut |_| {}).unwrap_err();
    assert!(matches!(error, ImportError::Export { .. }));
    let sentence = error.to_string();
    assert!(
        sentence.contains("broken.blend") && !sentence.contains('\n'),
        "{sentence}"
    );
    assert_eq!(
        std::fs::read_dir(folder.path()).unwrap().count(),
        1,
        "nothing half-written is left"
    );
}

#[test]
fn without_a_blender_the_error_says_what_to_install() {
    let folder = tempfile::tempdir().unwrap();
    let blend = folder.path().join("a.blend");
    std::fs::write(&blend, b"BLENDER").unwrap();
    let options = LoadOptions {
        blender: Some(folder.path().join("nothing/blender")),
        cache_dir: Some(folder.path().to_owned()),
        ..LoadOptions::default()
    };
    let sentence = load(&blend, &options, &mut |_| {}).unwrap_err().to_string();
    for part in [
        "a.blend",
        "Blender 4.2 or newer",
        "blender.org",
        "--blender",
        "pip install bpy",
    ] {
        assert!(sentence.contains(part), "{part} is not in {sentence}");
    }
}
