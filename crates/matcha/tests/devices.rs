//! Devices from outside: which there are, what is refused, what becomes of a picture.
#![cfg(feature = "gpu")]

mod scene;

use std::path::Path;
use std::process::{Command, Output};

fn matcha() -> Command {
    Command::new(env!("CARGO_BIN_EXE_matcha"))
}

/// On a machine without any adapter, whatever this one has.
fn without_adapters() -> Command {
    let mut command = matcha();
    for variable in ["VK_ICD_FILENAMES", "VK_DRIVER_FILES"] {
        command.env(variable, "/nonexistent");
    }
    command
}

fn run(command: &mut Command, arguments: &[&str]) -> Output {
    command.args(arguments).output().unwrap()
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// Exit code 2 and one sentence, which is given back.
fn refused(output: &Output) -> String {
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{said}");
    let sentences: Vec<&str> = said
        .lines()
        .filter(|line| line.starts_with("matcha: "))
        .collect();
    assert_eq!(sentences.len(), 1, "{said}");
    assert!(!said.contains("panicked"), "{said}");
    sentences[0].to_owned()
}

/// What `matcha devices --json` says, or nothing where there is no adapter: then one line
/// says that a test is skipped.
fn adapters() -> Option<Vec<serde_json::Value>> {
    let output = run(&mut matcha(), &["devices", "--json"]);
    assert_eq!(output.status.code(), Some(0));
    let listed: Vec<serde_json::Value> = serde_json::from_slice(&output.stdout).unwrap();
    if listed.is_empty() {
        let required = std::env::var_os("MATCHA_REQUIRE_GPU").is_some_and(|v| v == "1");
        assert!(
            !required,
            "MATCHA_REQUIRE_GPU is set, but there is no adapter"
        );
        eprintln!("SKIPPED: there is no graphics adapter");
        return None;
    }
    Some(listed)
}

#[test]
fn adapters_are_listed_with_what_they_have_and_lack() {
    let Some(listed) = adapters() else {
        return;
    };
    let keys: Vec<&str> = listed[0]
        .as_object()
        .unwrap()
        .keys()
        .map(String::as_str)
        .collect();
    let expected = [
        "atomics_64",
        "backend",
        "binding_bytes",
        "buffer_bytes",
        "driver",
        "invocations",
        "kind",
        "lacks",
        "misses",
        "name",
        "number",
        "pipeline_cache",
        "ray_queries",
        "storage_buffers",
        "subgroup",
        "timestamps",
    ];
    assert_eq!(keys, expected);
    let output = run(&mut matcha(), &["devices"]);
    let said = String::from_utf8(output.stdout).unwrap();
    let name = listed[0]["name"].as_str().unwrap();
    assert!(said.contains(name) && said.contains("gpu:0") && said.contains("--device auto takes"));
}

#[cfg(target_os = "linux")]
#[test]
fn a_machine_without_adapters_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene::write(folder.path());
    let output = folder.path().join("a.png");
    let render = |device: &str| {
        let arguments = [
            "render",
            text(&scene),
            "-o",
            text(&output),
            "--device",
            device,
        ];
        let small = ["--samples", "1", "--resolution", "16x16", "--cells", "100"];
        run(&mut without_adapters(), &[&arguments[..], &small].concat())
    };
    for device in ["gpu", "gpu:0", "abacus"] {
        let sentence = refused(&render(device));
        assert!(sentence.contains("no graphics adapter"), "{sentence}");
        assert!(sentence.contains("--device cpu"), "{sentence}");
    }
    assert!(!output.exists());
    let automatic = render("auto");
    let said = String::from_utf8_lossy(&automatic.stderr);
    assert_eq!(automatic.status.code(), Some(0), "{said}");
    assert!(said.contains("rendering on the CPU"), "{said}");
    assert!(output.exists());
    let listed = run(&mut without_adapters(), &["devices", "--json"]);
    assert_eq!(listed.stdout, b"[]\n");
    let listed = run(&mut without_adapters(), &["devices"]);
    assert!(listed.stdout.starts_with(b"there is no graphics adapter"));
}

#[test]
fn what_no_adapter_is_called_is_refused_by_name() {
    let Some(_) = adapters() else {
        return;
    };
    let arguments = ["render", "none.glb", "-o", "a.png", "--device"];
    for device in ["abacus", "gpu:99"] {
        let sentence = refused(&run(&mut matcha(), &[&arguments[..], &[device]].concat()));
        assert!(
            sentence.contains(&format!("called \"{device}\"")),
            "{sentence}"
        );
    }
    let stage = ["gpu", "--material-stage", "twice"];
    let sentence = refused(&run(&mut matcha(), &[&arguments[..], &stage].concat()));
    assert!(sentence.contains("twice"), "{sentence}");
}

#[test]
fn ray_queries_are_refused_where_there_are_none() {
    let arguments = [
        "render",
        "none.glb",
        "-o",
        "a.png",
        "--ray-queries",
        "--device",
    ];
    let refuse = |device: &str| refused(&run(&mut matcha(), &[&arguments[..], &[device]].concat()));
    let sentence = refuse("cpu");
    assert!(sentence.contains("--ray-queries is for GPUs"), "{sentence}");
    for adapter in adapters().unwrap_or_default() {
        let lacks = adapter["lacks"].as_array().unwrap();
        if adapter["ray_queries"] == false && lacks.is_empty() {
            let sentence = refuse(&format!("gpu:{}", adapter["number"]));
            assert!(
                sentence.contains("has no hardware ray queries"),
                "{sentence}"
            );
        }
    }
}

#[test]
fn a_table_beyond_the_device_is_refused() {
    let Some(_) = adapters() else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let scene = scene::write(folder.path());
    let output = folder.path().join("a.png");
    let start = [
        "render",
        text(&scene),
        "-o",
        text(&output),
        "--device",
        "gpu",
        "--samples",
        "1",
    ];
    let refuse = |more: &[&str]| refused(&run(&mut matcha(), &[&start[..], more].concat()));
    let sentence = refuse(&["--cells", "4000000000", "--entries", "1000"]);
    assert!(sentence.contains("--cells"), "{sentence}");
    let sentence = refuse(&["--cells", "0"]);
    assert!(sentence.contains("at least 1"), "{sentence}");
    assert!(!output.exists());
}

/// Renders a small picture on a GPU into a folder.
fn render_on_gpu(folder: &Path, output: &Path, more: &[&str]) -> Output {
    let scene = scene::write(folder);
    let mut command = matcha();
    command.env("XDG_CACHE_HOME", folder.join("cache"));
    // Mesa's own cache stays where it is: a processor takes minutes to compile for itself.
    if let Some(home) = std::env::var_os("HOME") {
        command.env("MESA_SHADER_CACHE_DIR", Path::new(&home).join(".cache"));
    }
    let arguments = ["render", text(&scene), "-o", text(output)];
    let small = ["--samples", "2", "--resolution", "32x24"];
    let device = ["--device", "gpu", "--cells", "1000"];
    run(
        &mut command,
        &[&arguments[..], &small, &device, more].concat(),
    )
}

#[test]
fn some_stages_can_be_left_to_the_processor() {
    let Some(_) = adapters() else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let pixels = |name: &str, more: &[&str]| {
        let output = folder.path().join(name);
        let run = render_on_gpu(folder.path(), &output, more);
        let said = String::from_utf8_lossy(&run.stderr);
        assert_eq!(run.status.code(), Some(0), "{said}");
        image::open(&output).unwrap().to_rgb8().into_raw()
    };
    let whole = pixels("whole.png", &[]);
    assert!(whole.iter().any(|&value| value > 40));
    for from in ["shade", "nothing"] {
        let divided = pixels("divided.png", &["--gpu-from", from]);
        let apart = whole.iter().zip(&divided).map(|(a, b)| a.abs_diff(*b));
        let others = apart.filter(|&apart| apart > 1).count();
        assert!(others * 50 < whole.len(), "{from}: {others}");
    }
}

#[test]
fn a_gpu_renders_and_its_times_are_in_the_statistics() {
    let Some(listed) = adapters() else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let (output, stats) = (
        folder.path().join("a.png"),
        folder.path().join("stats.json"),
    );
    let more = ["--compress-textures", "--stats", text(&stats)];
    let run = render_on_gpu(folder.path(), &output, &more);
    let said = String::from_utf8_lossy(&run.stderr);
    assert_eq!(run.status.code(), Some(0), "{said}");
    assert!(said.contains("compression saves"), "{said}");
    let picture = image::open(&output).unwrap().to_rgb8();
    assert!(picture.pixels().any(|p| p.0[0] > 40) && picture.pixels().any(|p| p.0[0] < 20));
    let stats: serde_json::Value = serde_json::from_slice(&std::fs::read(&stats).unwrap()).unwrap();
    assert_eq!(stats["pixel_samples"], 32 * 24 * 2);
    assert!(stats["textures"]["bytes_saved"].is_u64(), "{stats}");
    assert!(stats["pipeline_seconds"].as_f64().unwrap() > 0.0);
    let first = stats["first_sample_seconds"].as_f64().unwrap();
    assert!(first > stats["pipeline_seconds"].as_f64().unwrap());
    let stages = stats["stage_seconds"].as_object().unwrap();
    let timed = listed.iter().any(|adapter| adapter["timestamps"] == true);
    assert!(!timed || !stages.is_empty());
    let device = stats["device"].as_str().unwrap();
    assert!(
        listed
            .iter()
            .any(|adapter| device.contains(adapter["name"].as_str().unwrap()))
    );
}
