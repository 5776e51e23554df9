//! `cargo xtask reference`: a Matcha picture against a stored Cycles picture.

use crate::picture::Picture;
use anyhow::{Context, Result, ensure};
use std::path::{Path, PathBuf};
use std::process::Command;

#[derive(clap::Args)]
pub struct Arguments {
    /// The scene.
    scene: PathBuf,
    /// The reference, an EXR.
    reference: PathBuf,
    /// Samples a pixel.
    #[arg(long, default_value_t = 1024)]
    samples: u32,
    /// Where the picture goes.
    #[arg(long, default_value = "out/reference.exr")]
    output: PathBuf,
    /// Compare a picture that is already there.
    #[arg(long)]
    keep: bool,
    /// More arguments for `matcha render`.
    #[arg(last = true)]
    more: Vec<String>,
}

/// The release binary, built by `cargo build --release`.
pub fn matcha() -> Command {
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or("target".into(), PathBuf::from);
    Command::new(target.join("release/matcha"))
}

/// Builds the release binary.
pub fn build() -> Result<()> {
    let status = Command::new("cargo")
        .args(["build", "--release", "-p", "matcha"])
        .status()?;
    ensure!(status.success(), "matcha does not build");
    Ok(())
}

fn render(arguments: &Arguments, reference: &Picture) -> Result<()> {
    build()?;
    if let Some(folder) = arguments.output.parent() {
        std::fs::create_dir_all(folder)?;
    }
    let status = matcha()
        .arg("render")
        .arg(&arguments.scene)
        .arg("-o")
        .arg(&arguments.output)
        .args(["--cache", "off"])
        .args(["--samples", &arguments.samples.to_string()])
        .args([
            "--resolution",
            &format!("{}x{}", reference.width, reference.height),
        ])
        .args(&arguments.more)
        .status()
        .context("cannot start matcha")?;
    ensure!(status.success(), "matcha failed");
    Ok(())
}

fn file_stem(path: &Path) -> String {
    path.file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned()
}

pub fn run(arguments: &Arguments) -> Result<()> {
    let reference = Picture::read(&arguments.reference)?;
    if !arguments.keep {
        render(arguments, &reference)?;
    }
    let difference = Picture::read(&arguments.output)?.difference(&reference)?;
    let [r, g, b] = difference.channel_ratio;
    println!(
        "{}: mean of the channels over the reference's: R {r:.4}, G {g:.4}, B {b:.4}; \
         FLIP mean {:.4}; relative MSE {:.5}",
        file_stem(&arguments.scene),
        difference.flip_mean,
        difference.rel_mse
    );
    Ok(())
}
