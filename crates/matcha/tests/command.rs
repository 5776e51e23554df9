//! The command from outside: exit codes, sentences, files.

mod scene;

use std::path::Path;
use std::process::{Command, Output};

fn matcha(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_matcha"))
        .args(arguments)
        .output()
        .unwrap()
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// Exit code 2 and one sentence that begins with the program's name and says `part`.
fn assert_refused(arguments: &[&str], part: &str) {
    let output = matcha(arguments);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
    let last: Vec<&str> = said
        .lines()
        .filter(|line| line.starts_with("matcha: "))
        .collect();
    assert_eq!(last.len(), 1, "{said}");
    assert!(last[0].contains(part), "{said}");
    assert!(!said.contains("panicked"), "{said}");
}

#[test]
fn arguments_that_make_no_sense_are_refused_in_a_sentence() {
    let cases: [(&[&str], &str); 17] = [
        (&[], "no command was given"),
        (&["render", "a.glb"], "--output"),
        (&["render", "a.glb", "-o", "a.jpg"], ".exr or .png"),
        (
            &["render", "a.glb", "-o", "a.png", "--samples", "0"],
            "at least one sample",
        ),
        (
            &["render", "a.glb", "-o", "a.png", "--samples", "-3"],
            "'-3'",
        ),
        (
            &["render", "a.glb", "-o", "a.png", "--resolution", "1920"],
            "WIDTHxHEIGHT",
        ),
        (
            &["render", "a.glb", "-o", "a.png", "--resolution", "0x10"],
            "WIDTHxHEIGHT",
        ),
        (
            &["render", "a.glb", "-o", "a.png", "--resolution", "99999x10"],
            "WIDTHxHEIGHT",
        ),
        (
            &["render", "a.glb", "-o", "a.png", "--level-offset", "nan"],
            "level offset",
        ),
        (
            &["render", "a.glb", "-o", "a.png", "--threads", "0"],
            "threads",
        ),
        (
            &["render", "a.glb", "-o", "a.png", "--cache", "maybe"],
            "maybe",
        ),
        (
            &["render", "a.glb", "-o", "a.png", "--device", "gpu:first"],
            "auto, cpu, gpu",
        ),
        (
            &["render", "a.glb", "-o", "a.png", "--gpu-from", "teapot"],
            "teapot",
        ),
        (
            &["render", "a.glb", "-o", "a.png", "--batch-paths", "0"],
            "from 1",
        ),
        (
            &["render", "a.glb", "-o", "a.png", "--lanes", "mmx"],
            "scalar, sse2",
        ),
        (&["inspect", "a.glb", "--dot"], "--material"),
        (&["bake", "a.glb"], "bake"),
    ];
    for (arguments, part) in cases {
        assert_refused(arguments, part);
    }
}

#[test]
fn scenes_that_are_none_are_refused_in_a_sentence() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("a.png");
    let refuse = |scene: &Path, part: &str| {
        assert_refused(&["render", text(scene), "-o", text(&output)], part);
        assert_refused(&["inspect", text(scene)], part);
    };
    refuse(&folder.path().join("none.glb"), "none.glb");
    let junk = folder.path().join("junk.glb");
    std::fs::write(&junk, b"glTF\x02\0\0\0\xff\xff\xff\xff").unwrap();
    refuse(&junk, "junk.glb");
    let other = folder.path().join("scene.obj");
    std::fs::write(&other, b"v 0 0 0").unwrap();
    refuse(&other, "neither glTF");
    refuse(folder.path(), text(folder.path()));
    assert!(!output.exists());
}

/// The scene with a Cycles material of one unknown node, and a view of its own.
fn scene_with_substitutes(folder: &Path, node: &str, view: &str) -> std::path::PathBuf {
    let path = scene::write(folder);
    let mut json: serde_json::Value =
        serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
    let socket = |name: &str| serde_json::json!([{"identifier": name, "name": name, "type": "SHADER", "value": []}]);
    json["extensionsUsed"] = serde_json::json!(["MATCHA_cycles"]);
    json["extensions"] = serde_json::json!({"MATCHA_cycles": {"version": 1, "images": [],
        "trees": [{"name": "Floor", "nodes": [
            {"name": "Odd", "type": node, "outputs": socket("BSDF"),
                "inputs": [{"identifier": "Color", "name": "Color", "type": "RGBA", "value": [1, 1, 1, 1]}]},
            {"name": "Out", "type": "ShaderNodeOutputMaterial", "inputs": socket("Surface"), "outputs": []}],
            "links": [{"from": [0, 0], "to": [1, 0]}]}],
        "settings": {"resolution": [8, 8], "pixel_aspect": 1.0, "samples": 1, "max_bounces": 2, "diffuse_bounces": 1,
            "glossy_bounces": 1, "transmission_bounces": 1, "transparent_bounces": 1, "clamp_direct": 0.0,
            "clamp_indirect": 0.0, "blur_glossy": 0.0, "reflective_caustics": true, "refractive_caustics": true,
            "light_threshold": 0.0, "filter": {"type": "BOX", "width": 1.0}, "exposure": 1.0, "transparent_film": false,
            "view": {"transform": view, "look": "None", "exposure": 0.0, "gamma": 1.0}, "seed": 0}}});
    json["materials"][0]["extensions"] = serde_json::json!({"MATCHA_cycles": {"tree": 0}});
    std::fs::write(&path, json.to_string()).unwrap();
    path
}

#[test]
fn substitutes_are_said_and_refused_in_strict_mode() {
    let cases = [
        (
            "ShaderNodeNotThereYet",
            "Standard",
            "ShaderNodeNotThereYet (material \"Floor\", node \"Odd\"): a grey diffuse closure",
        ),
        (
            "ShaderNodeBsdfTransparent",
            "Posters",
            "view transform \"Posters\" is not supported: Standard is used",
        ),
    ];
    for (node, view, sentence) in cases {
        let folder = tempfile::tempdir().unwrap();
        let path = scene_with_substitutes(folder.path(), node, view);
        let output = folder.path().join("a.png");
        let render = ["render", text(&path), "-o", text(&output), "--cells", "100"];
        let lenient = matcha(&render);
        let said = String::from_utf8_lossy(&lenient.stderr).into_owned();
        assert!(
            lenient.status.success() && said.contains(sentence),
            "{said}"
        );
        std::fs::remove_file(&output).unwrap();
        let strict: Vec<&str> = render.iter().copied().chain(["--strict"]).collect();
        assert_refused(&strict, sentence);
        assert!(!output.exists());
    }
}

#[test]
fn outputs_are_checked_before_anything_else() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("no/such/a.png");
    assert_refused(
        &["render", "none.glb", "-o", text(&missing)],
        "no such folder",
    );
    let file = folder.path().join("file");
    std::fs::write(&file, "").unwrap();
    assert_refused(
        &["compare", "none.glb", "-o", text(&file)],
        "is a file, not a folder",
    );
    let stats = folder.path().join("no/stats.json");
    let output = folder.path().join("a.png");
    let arguments = [
        "render",
        "none.glb",
        "-o",
        text(&output),
        "--stats",
        text(&stats),
    ];
    assert_refused(&arguments, "no such folder");
}

#[test]
fn a_cache_beyond_memory_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene::write(folder.path());
    let output = folder.path().join("a.png");
    let start = [
        "render",
        text(&scene),
        "-o",
        text(&output),
        "--samples",
        "1",
    ];
    let with = |more: &[&'static str]| [&start[..], more].concat();
    assert_refused(
        &with(&["--cells", "4000000000", "--entries", "1000"]),
        "MiB",
    );
    assert_refused(&with(&["--cells", "0"]), "at least 1");
    assert_refused(&with(&["--cells", "5000000000", "--entries", "1"]), "limit");
    assert!(!output.exists());
}

#[test]
fn statistics_take_no_other_files_place() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene::write(folder.path());
    let before = std::fs::read(&scene).unwrap();
    let (picture, pictures) = (folder.path().join("a.png"), folder.path().join("out"));
    let report = pictures.join("report.json");
    for (command, output, stats) in [
        ("render", &picture, &picture),
        ("render", &picture, &scene),
        ("compare", &pictures, &report),
    ] {
        let arguments = [
            command,
            text(&scene),
            "-o",
            text(output),
            "--stats",
            text(stats),
        ];
        assert_refused(&arguments, "would take the place of");
    }
    assert!(!picture.exists() && !report.exists());
    assert_eq!(std::fs::read(&scene).unwrap(), before);
}

#[test]
fn a_picture_beyond_memory_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene::write(folder.path());
    let output = folder.path().join("a.png");
    let arguments = ["render", text(&scene), "-o", text(&output)];
    let huge = ["--resolution", "65536x65536", "--cells", "100"];
    assert_refused(
        &[&arguments[..], &huge].concat(),
        "choose a smaller --resolution",
    );
    assert!(!output.exists());
}

#[test]
fn help_and_version_are_no_errors() {
    for arguments in [&["--help"][..], &["--version"], &["compare", "--help"]] {
        let output = matcha(arguments);
        assert_eq!(output.status.code(), Some(0));
        assert!(!output.stdout.is_empty() && output.stderr.is_empty());
    }
}

#[test]
fn a_scene_becomes_pictures_and_statistics() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene::write(folder.path());
    let stats = folder.path().join("stats.json");
    for name in ["a.exr", "a.png"] {
        let output = folder.path().join(name);
        let run = matcha(&[
            "render",
            text(&scene),
            "-o",
            text(&output),
            "--samples",
            "4",
            "--resolution",
            "40x30",
            "--cells",
            "1000",
            "--stats",
            text(&stats),
            "--seed",
            "7",
            "--threads",
            "2",
        ]);
        assert_eq!(
            run.status.code(),
            Some(0),
            "{}",
            String::from_utf8_lossy(&run.stderr)
        );
        assert!(output.exists());
    }
    let picture = image::open(folder.path().join("a.png")).unwrap().to_rgb8();
    assert_eq!(picture.dimensions(), (40, 30));
    assert!(picture.pixels().any(|p| p.0[0] > 40) && picture.pixels().any(|p| p.0[0] < 20));
    // A map keeps the last of equal keys, so they are counted in the text.
    let keys = std::fs::read_to_string(&stats).unwrap();
    assert_eq!(keys.matches("\n  \"samples\":").count(), 1, "{keys}");
    let stats: serde_json::Value = read_json(&stats);
    assert_eq!(stats["samples"], 4);
    assert_eq!(stats["pixel_samples"], 4800);
    assert!(
        stats["rays"].as_u64().unwrap() >= 4800 && stats["peak_bytes"].as_u64() > Some(1 << 20)
    );
    // Nothing is left beside what was asked for.
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 5);
}

fn read_json(path: &Path) -> serde_json::Value {
    serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap()
}

fn keys(value: &serde_json::Value) -> Vec<&str> {
    value
        .as_object()
        .unwrap()
        .keys()
        .map(String::as_str)
        .collect()
}

#[test]
fn a_comparison_has_its_six_files_and_exactly_its_keys() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene::write(folder.path());
    let output = folder.path().join("out/deep");
    let run = matcha(&[
        "compare",
        text(&scene),
        "-o",
        text(&output),
        "--samples",
        "20",
        "--cells",
        "1000",
        "--resolution",
        "40x30",
    ]);
    assert_eq!(
        run.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&run.stderr)
    );
    let mut names: Vec<_> = std::fs::read_dir(&output)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    let expected = [
        "difference.png",
        "figure.png",
        "heatmap.png",
        "report.json",
        "with.exr",
        "without.exr",
    ];
    assert_eq!(names, expected);
    let report = read_json(&output.join("report.json"));
    let mut expected = vec![
        "scene",
        "device",
        "resolution",
        "samples",
        "seconds",
        "speedup",
        "material_share",
        "recovered",
        "error",
        "cache",
        "rays",
        "nodes_found_per_sample",
    ];
    expected.sort_unstable();
    assert_eq!(keys(&report), expected);
    assert_eq!(keys(&report["seconds"]), ["with", "without"]);
    assert_eq!(keys(&report["error"]), ["flip_mean", "max_abs", "rel_mse"]);
    let cache = [
        "bytes", "capacity", "hits", "inserts", "lookups", "occupied", "refused",
    ];
    assert_eq!(keys(&report["cache"]), cache);
    assert_eq!(report["samples"], 20);
    assert_eq!(report["resolution"], serde_json::json!([40, 30]));
    assert_eq!(report["scene"], "scene");
    assert!(report["seconds"]["without"].as_f64().unwrap() > 0.0);
}

#[test]
fn materials_are_inspected_as_text_json_and_drawing() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene::write(folder.path());
    let said = |arguments: &[&str]| {
        let output = matcha(&[&["inspect", text(&scene)], arguments].concat());
        assert_eq!(
            output.status.code(),
            Some(0),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
        String::from_utf8(output.stdout).unwrap()
    };
    let all = said(&[]);
    assert!(all.contains("Floor\n") && all.contains("Lamp\n") && all.contains("stack slots"));
    assert!(!said(&["--material", "Floor"]).contains("Lamp"));
    let json: serde_json::Value = serde_json::from_str(&said(&["--json"])).unwrap();
    assert_eq!(json.as_array().unwrap().len(), 2);
    assert!(json[0]["passes"].as_array().unwrap().len() > 3);
    assert!(said(&["--material", "Floor", "--dot"]).starts_with("digraph \"Floor\""));
    assert_refused(
        &["inspect", text(&scene), "--material", "Sky"],
        "no material named \"Sky\"",
    );
}

#[cfg(unix)]
#[test]
fn an_interrupted_rendering_saves_what_is_there() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene::write(folder.path());
    let output = folder.path().join("a.exr");
    let mut child = Command::new(env!("CARGO_BIN_EXE_matcha"))
        .args([
            "render",
            text(&scene),
            "-o",
            text(&output),
            "--samples",
            "1000000",
        ])
        .args(["--resolution", "64x64"])
        .spawn()
        .unwrap();
    std::thread::sleep(std::time::Duration::from_secs(3));
    // Twice at once, as from programs that pass signals on to a process and to its group.
    for _ in 0..2 {
        let killed = Command::new("kill")
            .args(["-INT", &child.id().to_string()])
            .status()
            .unwrap();
        assert!(killed.success());
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert!(output.exists());
}

#[cfg(unix)]
#[test]
fn pipes_that_nobody_reads_are_no_panic() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene::write(folder.path());
    let (picture, pictures) = (folder.path().join("a.png"), folder.path().join("out"));
    let small = ["--samples", "1", "--resolution", "8x8", "--cells", "100"];
    let render = [&["render", text(&scene), "-o", text(&picture)], &small[..]].concat();
    let compare = [
        &["compare", text(&scene), "-o", text(&pictures)],
        &small[..],
    ]
    .concat();
    let cases = [
        (render, 0),
        (compare, 0),
        (vec!["inspect", text(&scene)], 0),
        (vec!["devices"], 0),
        (vec!["inspect", "none.glb"], 2),
        (vec!["bake"], 2),
    ];
    for (arguments, code) in cases {
        // Dropping the reading ends closes the pipes before anything is said.
        let closed = || std::io::pipe().unwrap().1;
        let status = Command::new(env!("CARGO_BIN_EXE_matcha"))
            .args(&arguments)
            .stdout(closed())
            .stderr(closed())
            .status()
            .unwrap();
        assert_eq!(status.code(), Some(code), "{arguments:?}");
    }
}
