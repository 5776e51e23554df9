//! The `matcha` command and what it reports.

use anyhow::{Context, Result, ensure};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The release binary, built by [`build`].
pub fn command() -> Command {
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

/// Runs a command to its end; what it said is the error if it fails.
pub fn run(command: &mut Command) -> Result<()> {
    let output = command.output().context("cannot start matcha")?;
    let said = String::from_utf8_lossy(&output.stderr);
    ensure!(
        output.status.success(),
        "{}",
        said.lines().last().unwrap_or("matcha failed")
    );
    Ok(())
}

/// A JSON file.
pub fn json(path: &Path) -> Result<Value> {
    let bytes = std::fs::read(path).with_context(|| format!("{}", path.display()))?;
    serde_json::from_slice(&bytes).with_context(|| format!("{}", path.display()))
}

/// A number of a report, by the names of its keys.
pub fn number(report: &Value, keys: &[&str]) -> Result<f64> {
    let value = keys.iter().fold(report, |value, key| &value[key]);
    value
        .as_f64()
        .with_context(|| format!("the report has no {}", keys.join(".")))
}
