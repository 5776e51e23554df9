//! `cargo xtask first-picture`: seconds from start to the first sample, with kernels that
//! must be compiled and with kernels that are kept, for a scene and for many materials.

use crate::{many_materials, program};
use anyhow::Result;
use std::path::{Path, PathBuf};

#[derive(clap::Args)]
pub struct Arguments {
    /// A scene, .blend or .glb.
    #[arg(default_value = "../shared/scenes/classroom/classroom.blend")]
    scene: PathBuf,
    /// The device, as `matcha --device` takes it.
    #[arg(long, default_value = "gpu")]
    device: String,
    /// Size of the pictures.
    #[arg(long, default_value = "480x270")]
    resolution: String,
    /// Numbers of materials of the scenes that are made for this.
    #[arg(long, value_delimiter = ',', default_value = "10,100,1000")]
    materials: Vec<u32>,
    /// The binary is there already.
    #[arg(long)]
    keep: bool,
}

pub fn run(arguments: &Arguments) -> Result<()> {
    if !arguments.keep {
        program::build()?;
    }
    let folder = std::env::temp_dir().join(format!("matcha-first-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    let measured = measure(arguments, &folder);
    // Pictures and kernels of no further use.
    let _ = std::fs::remove_dir_all(&folder);
    measured
}

fn measure(arguments: &Arguments, folder: &Path) -> Result<()> {
    println!("| scene | kernels | to the first sample, s | of it kernels, s |\n|---|---|---|---|");
    let name = arguments.scene.file_stem().unwrap_or_default();
    rows(arguments, folder, &arguments.scene, &name.to_string_lossy())?;
    for &count in &arguments.materials {
        let scene = folder.join("materials.glb");
        many_materials::write(count, &scene)?;
        rows(arguments, folder, &scene, &format!("{count} materials"))?;
    }
    Ok(())
}

/// Both rows of a scene. Its export, if it is one of Blender's, is made before.
fn rows(arguments: &Arguments, folder: &Path, scene: &Path, name: &str) -> Result<()> {
    let cache = folder.join("cache");
    render(folder, scene, "cpu", "16x9")?;
    for kernels in ["matcha/kernels", "driver"] {
        let kept = cache.join(kernels);
        if kept.exists() {
            std::fs::remove_dir_all(kept)?;
        }
    }
    for state in ["cold", "warm"] {
        let stats = render(folder, scene, &arguments.device, &arguments.resolution)?;
        println!(
            "| {name} | {state} | {:.2} | {:.2} |",
            program::number(&stats, &["first_sample_seconds"])?,
            program::number(&stats, &["pipeline_seconds"])?
        );
    }
    Ok(())
}

/// Renders one sample a pixel with caches of our own, ours and the drivers'.
fn render(
    folder: &Path,
    scene: &Path,
    device: &str,
    resolution: &str,
) -> Result<serde_json::Value> {
    let stats = folder.join("stats.json");
    let driver = folder.join("cache/driver");
    std::fs::create_dir_all(&driver)?;
    let mut command = program::command();
    command
        .arg("render")
        .arg(scene)
        .arg("-o")
        .arg(folder.join("picture.png"))
        .args(["--samples", "1", "--device", device])
        .args(["--resolution", resolution])
        .arg("--stats")
        .arg(&stats)
        .env("XDG_CACHE_HOME", folder.join("cache"))
        .env("MESA_SHADER_CACHE_DIR", &driver)
        .env("__GL_SHADER_DISK_CACHE_PATH", &driver);
    program::run(&mut command)?;
    program::json(&stats)
}
