//! `cargo xtask cycles`: Matcha and Cycles in turn on the same machine.

use crate::picture::Picture;
use crate::program;
use anyhow::{Context, Result, ensure};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Renders with Cycles and prints the seconds between the first and the last sample,
/// without loading, export and BVH building.
const CYCLES: &str = include_str!("cycles_time.py");

#[derive(clap::Args)]
pub struct Arguments {
    /// A .blend file.
    scene: PathBuf,
    /// Samples a pixel.
    #[arg(long)]
    samples: u32,
    /// Size of the picture.
    #[arg(long)]
    resolution: String,
    /// How often both render, in turn.
    #[arg(long, default_value_t = 3)]
    runs: u32,
    /// An EXR of many samples, against which both pictures are compared: what a second is worth.
    #[arg(long)]
    reference: Option<PathBuf>,
    /// A Python that has `bpy`.
    #[arg(long, env = "MATCHA_PYTHON", default_value = "python3")]
    python: PathBuf,
}

fn seconds_of_cycles(arguments: &Arguments, picture: &Path) -> Result<f64> {
    let output = Command::new(&arguments.python)
        .args(["-c", CYCLES])
        .arg(&arguments.scene)
        .arg(arguments.samples.to_string())
        .arg(&arguments.resolution)
        .arg(picture)
        .output()
        .context("cannot start Python")?;
    ensure!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let text = String::from_utf8_lossy(&output.stdout);
    let line = text.lines().find_map(|line| line.strip_prefix("CYCLES "));
    Ok(line.context("Cycles printed no time")?.trim().parse()?)
}

fn seconds_of_matcha(arguments: &Arguments, picture: &Path) -> Result<f64> {
    let stats = picture.with_extension("json");
    let mut command = program::command();
    command
        .arg("render")
        .arg(&arguments.scene)
        .arg("-o")
        .arg(picture)
        .args(["--cache", "off", "--device", "cpu"])
        .args(["--samples", &arguments.samples.to_string()])
        .args(["--resolution", &arguments.resolution])
        .arg("--stats")
        .arg(&stats);
    program::run(&mut command)?;
    program::number(&program::json(&stats)?, &["seconds"])
}

/// How far both pictures are from the reference, and what of Matcha's time Cycles' noise takes:
/// variance falls with the number of samples.
fn compare(reference: &Path, pictures: [&Path; 2], ratio: f64) -> Result<()> {
    let reference = Picture::read(reference)?;
    let difference = |path| Picture::read(path)?.difference(&reference);
    let [matcha, cycles] = [difference(pictures[0])?, difference(pictures[1])?];
    println!(
        "relative MSE: Matcha {:.5}, Cycles {:.5}; FLIP mean: {:.4}, {:.4}; time for the same MSE: {:.3}",
        matcha.rel_mse,
        cycles.rel_mse,
        matcha.flip_mean,
        cycles.flip_mean,
        ratio * matcha.rel_mse / cycles.rel_mse
    );
    Ok(())
}

pub fn run(arguments: &Arguments) -> Result<()> {
    program::build()?;
    let folder = std::env::temp_dir().join(format!("matcha-cycles-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    let [picture, other] = ["matcha.exr", "cycles.exr"].map(|name| folder.join(name));
    let mut ratios = Vec::new();
    for run in 0..arguments.runs {
        let (matcha, cycles) = if run % 2 == 0 {
            let matcha = seconds_of_matcha(arguments, &picture)?;
            (matcha, seconds_of_cycles(arguments, &other)?)
        } else {
            let cycles = seconds_of_cycles(arguments, &other)?;
            (seconds_of_matcha(arguments, &picture)?, cycles)
        };
        ratios.push(matcha / cycles);
        println!(
            "Matcha {matcha:.1} s, Cycles {cycles:.1} s, ratio {:.3}",
            matcha / cycles
        );
    }
    ratios.sort_by(f64::total_cmp);
    let median = ratios[ratios.len() / 2];
    println!(
        "ratio: median {median:.3}, from {:.3} to {:.3}",
        ratios[0],
        ratios[ratios.len() - 1]
    );
    if let Some(reference) = &arguments.reference {
        compare(reference, [&picture, &other], median)?;
    }
    std::fs::remove_dir_all(folder)?;
    Ok(())
}
