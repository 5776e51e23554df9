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
mod matcha;
mod picture;
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

/// Every error is one line on standard error and exit code 2, as `matcha`'s are.
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
            eprintln!("xtask: {}", one_line(&error));
            ExitCode::from(2)
        }
    }
}

/// An error with its causes, each once: some errors say their cause themselves. Returned from
/// `main` it would bring a backtrace where one is asked for, which says nothing about a missing file.
fn one_line(error: &anyhow::Error) -> String {
    let mut text = String::new();
    for cause in error.chain().map(ToString::to_string) {
        if text.is_empty() {
            text = cause;
        } else if !text.contains(&cause) {
            text += &format!(": {cause}");
        }
    }
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use anyhow::Context;

    #[test]
    fn an_error_is_one_line_with_its_causes() {
        let missing = || Err::<(), _>(std::io::Error::other("not\nthere"));
        let plain = missing().context("a.exr: unreadable").unwrap_err();
        assert_eq!(super::one_line(&plain), "a.exr: unreadable: not there");
        let said = missing().context("a.exr: not\nthere").unwrap_err();
        assert_eq!(super::one_line(&said), "a.exr: not there");
    }
}
