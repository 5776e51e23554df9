//! Project chores that need more than cargo: measurements against Cycles.
//!
//! `cargo xtask reference` holds pictures against stored Cycles renders;
//! `cargo xtask cycles` times Matcha and Cycles in turn on this machine;
//! `cargo xtask gpu-bench` and `first-picture` make the tables of GPUs;
//! `cargo xtask many-materials` makes a scene for the latter.

mod cycles;
mod first_picture;
mod gpu_bench;
mod many_materials;
mod picture;
mod program;
mod reference;

use clap::Parser;
use std::process::ExitCode;

/// Measurements for `docs/results.md`.
#[derive(Parser)]
#[command(name = "xtask")]
enum Task {
    /// Renders a scene without the cache and compares it with a reference EXR.
    Reference(reference::Arguments),
    /// Times Matcha and Cycles on the same scene, size and samples, in turn.
    Cycles(cycles::Arguments),
    /// Measures what the cache saves on a GPU; prints a table.
    GpuBench(gpu_bench::Arguments),
    /// Times the first sample, with kernels compiled and kept; prints a table.
    FirstPicture(first_picture::Arguments),
    /// Writes a scene with many materials, no two networks alike.
    ManyMaterials(many_materials::Arguments),
}

/// Every error is one line on standard error and exit code 2, as `matcha`'s are. Returned from here it
/// would bring a backtrace where one is asked for, which says nothing about a missing file.
fn main() -> ExitCode {
    let outcome = match Task::parse() {
        Task::Reference(arguments) => reference::run(&arguments),
        Task::Cycles(arguments) => cycles::run(&arguments),
        Task::GpuBench(arguments) => gpu_bench::run(&arguments),
        Task::FirstPicture(arguments) => first_picture::run(&arguments),
        Task::ManyMaterials(arguments) => many_materials::run(&arguments),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("xtask: {}", matcha::sentence(&error));
            ExitCode::from(2)
        }
    }
}
