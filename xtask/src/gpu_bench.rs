//! `cargo xtask gpu-bench`: what the cache saves on a GPU, as a table for `docs/results.md`.

use crate::program;
use anyhow::{Context, Result};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

#[derive(clap::Args)]
pub struct Arguments {
    /// Scenes, .blend or .glb.
    #[arg(default_values = ["../shared/scenes/classroom/classroom.blend", "../shared/scenes/bmw27/bmw27.blend"])]
    scenes: Vec<PathBuf>,
    /// The device, as `matcha --device` takes it.
    #[arg(long, default_value = "gpu")]
    device: String,
    /// Size of the pictures.
    #[arg(long, default_value = "1920x1080")]
    resolution: String,
    /// Samples a pixel.
    #[arg(long, default_value_t = 128)]
    samples: u32,
    /// Samples a pixel for the table's sizes, as in the paper's figure 5.
    #[arg(long, default_value_t = 32)]
    size_samples: u32,
    /// Sizes of the cache's table that the first scene is rendered with.
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "10000x10,100000x10,1000000x1,1000000x10,10000000x1,10000000x10"
    )]
    sizes: Vec<String>,
    /// No measurement begins after so many seconds.
    #[arg(long, default_value_t = 540)]
    seconds: u64,
    /// The binary is there already.
    #[arg(long)]
    keep: bool,
}

/// One comparison.
struct Row<'a> {
    scene: &'a Path,
    stage: &'a str,
    samples: u32,
    /// Cells and entries; the default where it is not given.
    size: Option<[&'a str; 2]>,
}

pub fn run(arguments: &Arguments) -> Result<()> {
    let sizes = sizes(&arguments.sizes)?;
    if !arguments.keep {
        program::build()?;
    }
    let start = Instant::now();
    let folder = std::env::temp_dir().join(format!("matcha-gpu-bench-{}", std::process::id()));
    let measured = measure(arguments, &sizes, &folder, start);
    // Pictures of no further use.
    let _ = std::fs::remove_dir_all(&folder);
    measured
}

fn measure(
    arguments: &Arguments,
    sizes: &[[&str; 2]],
    folder: &Path,
    start: Instant,
) -> Result<()> {
    let stages = arguments.scenes.iter().flat_map(|scene| {
        ["split", "inline"].map(|stage| Row {
            scene,
            stage,
            samples: arguments.samples,
            size: None,
        })
    });
    let first = arguments.scenes.first().context("no scene is given")?;
    let sizes = sizes.iter().map(|&size| Row {
        scene: first,
        stage: "split",
        samples: arguments.size_samples,
        size: Some(size),
    });
    let mut headed = false;
    let mut left = 0;
    for row in stages.chain(sizes) {
        if start.elapsed() > Duration::from_secs(arguments.seconds) {
            left += 1;
            continue;
        }
        let (report, stats) = compare(arguments, &row, folder)?;
        if !headed {
            println!("{}", heading(arguments, &report));
            headed = true;
        }
        println!("{}", line(&row, &report, &stats)?);
    }
    if left > 0 {
        println!(
            "\n{left} measurements were left out: --seconds {} were over.",
            arguments.seconds
        );
    }
    Ok(())
}

fn compare(arguments: &Arguments, row: &Row, folder: &Path) -> Result<(Value, Value)> {
    let stats = folder.join("stats.json");
    std::fs::create_dir_all(folder)?;
    let mut command = program::command();
    command
        .arg("compare")
        .arg(row.scene)
        .arg("-o")
        .arg(folder)
        .args(["--device", &arguments.device])
        .args(["--material-stage", row.stage])
        .args(["--resolution", &arguments.resolution])
        .args(["--samples", &row.samples.to_string()])
        .arg("--stats")
        .arg(&stats);
    if let Some([cells, entries]) = row.size {
        command.args(["--cells", cells, "--entries", entries]);
    }
    program::run(&mut command).with_context(|| format!("{}", row.scene.display()))?;
    Ok((
        program::json(&folder.join("report.json"))?,
        program::json(&stats)?,
    ))
}

fn heading(arguments: &Arguments, report: &Value) -> String {
    format!(
        "{}, {}\n\n\
         | scene | stage | samples | cells × entries | without, s | with, s | saved | recovered | hits | FLIP \
         | without: Mrays/s | Msamples/s | with: Mrays/s | Msamples/s |\n\
         |---|---|---|---|---|---|---|---|---|---|---|---|---|---|",
        report["device"].as_str().unwrap_or_default(),
        arguments.resolution
    )
}

fn line(row: &Row, report: &Value, stats: &Value) -> Result<String> {
    let of = |keys: &[&str]| program::number(report, keys);
    let rate =
        |side: &str, key: &str| Ok::<_, anyhow::Error>(program::number(stats, &[side, key])? / 1e6);
    let (without, with) = (of(&["seconds", "without"])?, of(&["seconds", "with"])?);
    let size = row
        .size
        .map_or_else(|| "default".to_owned(), |size| size.join(" × "));
    let hits = of(&["cache", "hits"])? / of(&["cache", "lookups"])?.max(1.0);
    Ok(format!(
        "| {} | {} | {} | {size} | {without:.2} | {with:.2} | {:.1} % | {:.2} | {:.1} % | {:.4} | {:.1} | {:.2} | {:.1} | {:.2} |",
        row.scene.file_stem().unwrap_or_default().to_string_lossy(),
        row.stage,
        row.samples,
        100.0 * (without - with) / without.max(1e-9),
        of(&["recovered"])?,
        100.0 * hits,
        of(&["error", "flip_mean"])?,
        rate("without", "rays_per_second")?,
        rate("without", "samples_per_second")?,
        rate("with", "rays_per_second")?,
        rate("with", "samples_per_second")?,
    ))
}

/// Cells and entries of every size.
fn sizes(texts: &[String]) -> Result<Vec<[&str; 2]>> {
    let parse = |text: &'_ String| -> Option<(usize, usize)> {
        let (cells, entries) = text.split_once('x')?;
        let numbers = cells.parse::<u64>().is_ok() && entries.parse::<u32>().is_ok();
        numbers.then_some((cells.len(), entries.len()))
    };
    texts
        .iter()
        .map(|text| {
            let (cells, entries) =
                parse(text).with_context(|| format!("{text}: a size is CELLSxENTRIES"))?;
            Ok([&text[..cells], &text[text.len() - entries..]])
        })
        .collect()
}
