//! `cargo xtask reference`: a Matcha picture against a stored Cycles picture.

use crate::picture::Picture;
use crate::program;
use anyhow::{Context, Result, ensure};
use std::path::{Path, PathBuf};

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

fn render(arguments: &Arguments, reference: &Picture) -> Result<()> {
    program::build()?;
    if let Some(folder) = arguments.output.parent() {
        std::fs::create_dir_all(folder)?;
    }
    let status = program::command()
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
