//! `cargo xtask cycles`: Matcha and Cycles in turn on the same machine.

use crate::matcha;
use anyhow::{Context, Result, ensure};
use std::path::PathBuf;
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
    /// A Python that has `bpy`.
    #[arg(long, env = "MATCHA_PYTHON", default_value = "python3")]
    python: PathBuf,
}

fn seconds_of_cycles(arguments: &Arguments) -> Result<f64> {
    let output = Command::new(&arguments.python)
        .args(["-c", CYCLES])
        .arg(&arguments.scene)
        .arg(arguments.samples.to_string())
        .arg(&arguments.resolution)
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

fn seconds_of_matcha(arguments: &Arguments) -> Result<f64> {
    let folder = std::env::temp_dir().join(format!("matcha-cycles-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    let stats = folder.join("stats.json");
    let status = matcha::command()
        .arg("render")
        .arg(&arguments.scene)
        .arg("-o")
        .arg(folder.join("picture.exr"))
        .args([
            "--cache",
            "off",
            "--samples",
            &arguments.samples.to_string(),
        ])
        .args(["--resolution", &arguments.resolution])
        .arg("--stats")
        .arg(&stats)
        .status()
        .context("cannot start matcha")?;
    ensure!(status.success(), "matcha failed");
    let stats: serde_json::Value = serde_json::from_slice(&std::fs::read(stats)?)?;
    std::fs::remove_dir_all(folder)?;
    stats["seconds"]
        .as_f64()
        .context("the statistics have no `seconds`")
}

pub fn run(arguments: &Arguments) -> Result<()> {
    matcha::build()?;
    let mut ratios = Vec::new();
    for run in 0..arguments.runs {
        let (matcha, cycles) = if run % 2 == 0 {
            let matcha = seconds_of_matcha(arguments)?;
            (matcha, seconds_of_cycles(arguments)?)
        } else {
            let cycles = seconds_of_cycles(arguments)?;
            (seconds_of_matcha(arguments)?, cycles)
        };
        ratios.push(matcha / cycles);
        println!(
            "Matcha {matcha:.1} s, Cycles {cycles:.1} s, ratio {:.3}",
            matcha / cycles
        );
    }
    ratios.sort_by(f64::total_cmp);
    println!(
        "ratio: median {:.3}, from {:.3} to {:.3}",
        ratios[ratios.len() / 2],
        ratios[0],
        ratios[ratios.len() - 1]
    );
    Ok(())
}
