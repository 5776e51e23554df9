//! Project chores that need more than cargo: measurements against Cycles.
//!
//! `cargo xtask reference` holds pictures against stored Cycles renders;
//! `cargo xtask cycles` times Matcha and Cycles in turn on this machine.

mod cycles;
mod picture;
mod reference;

use clap::Parser;

/// Measurements for `docs/results.md`.
#[derive(Parser)]
#[command(name = "xtask")]
enum Task {
    /// Renders a scene without the cache and compares it with a reference EXR.
    Reference(reference::Arguments),
    /// Times Matcha and Cycles on the same scene, size and samples, in turn.
    Cycles(cycles::Arguments),
}

fn main() -> anyhow::Result<()> {
    match Task::parse() {
        Task::Reference(arguments) => reference::run(&arguments),
        Task::Cycles(arguments) => cycles::run(&arguments),
    }
}
