//! Running the exporter and listening to it.

use super::program::Program;
use crate::Progress;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::mpsc::{self, Sender};

/// The file of the add-on that is run; its first lines document the command line.
const ENTRY: &str = "export_cli.py";
/// `MATCHA progress 0.35 meshes`
const PROGRESS: &str = "MATCHA progress ";
/// `MATCHA warning one sentence`
const WARNING: &str = "MATCHA warning ";
/// `MATCHA source /path/of/a/texture.png`
const SOURCE: &str = "MATCHA source ";
/// `MATCHA error one sentence`
const ERROR: &str = "MATCHA error ";

/// What an exporter told on its way.
#[derive(Debug, Default)]
pub(super) struct Told {
    pub warnings: Vec<String>,
    /// Files besides the scene that the export depends on.
    pub sources: Vec<PathBuf>,
}

/// Exports `blend` to `glb`; otherwise the reason why not, one line.
pub(super) fn run(
    program: &Program,
    blend: &Path,
    glb: &Path,
    scripts: &Path,
    progress: &mut dyn FnMut(Progress),
) -> Result<Told, String> {
    let mut command = command(program, blend, glb, &scripts.join(ENTRY));
    command
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .env("PYTHONUNBUFFERED", "1");
    command
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let mut child = command.spawn().map_err(|error| error.to_string())?;
    let (send, lines) = mpsc::channel();
    let readers = [
        child.stdout.take().map(|pipe| listen(pipe, send.clone())),
        child.stderr.take().map(|pipe| listen(pipe, send)),
    ];
    let (mut reason, mut last, mut told) = (None, String::new(), Told::default());
    for line in lines {
        if let Some(rest) = line.strip_prefix(PROGRESS) {
            let (fraction, what) = rest.split_once(' ').unwrap_or((rest, ""));
            let fraction = fraction.parse::<f32>().unwrap_or(0.0).clamp(0.0, 1.0);
            progress(Progress::Export {
                fraction,
                what: what.to_owned(),
            });
        } else if let Some(rest) = line.strip_prefix(WARNING) {
            told.warnings.push(rest.to_owned());
        } else if let Some(rest) = line.strip_prefix(SOURCE) {
            told.sources.push(PathBuf::from(rest));
        } else if let Some(rest) = line.strip_prefix(ERROR) {
            reason = Some(rest.to_owned());
        } else if !line.trim().is_empty() {
            last = line;
        }
    }
    for reader in readers.into_iter().flatten() {
        // A reader that died has nothing more to say.
        let _ = reader.join();
    }
    let status = child.wait().map_err(|error| error.to_string())?;
    match (status.success(), reason) {
        (true, None) if glb.is_file() => Ok(told),
        (_, Some(reason)) => Err(reason),
        (true, None) => Err(format!("it wrote no file (its last words: {last})")),
        (false, None) => Err(format!("{status}; its last words: {last}")),
    }
}

fn command(program: &Program, blend: &Path, glb: &Path, entry: &Path) -> Command {
    match program {
        Program::Blender(path) => {
            let mut command = Command::new(path);
            // Settings and add-ons of the user must not change the export, and scripts
            // inside of the scene are not run.
            command
                .args(["--background", "--factory-startup", "--disable-autoexec"])
                .arg(blend);
            command
                .args(["--python-exit-code", "1", "--python"])
                .arg(entry);
            command.arg("--").arg(glb).arg("--progress");
            command
        }
        Program::Python(path) => {
            let mut command = Command::new(path);
            command.arg(entry).arg(blend).arg(glb).arg("--progress");
            command
        }
    }
}

/// Sends a pipe's lines; bytes that are no text are replaced.
fn listen(pipe: impl Read + Send + 'static, send: Sender<String>) -> std::thread::JoinHandle<()> {
    std::thread::spawn(move || {
        let mut reader = BufReader::new(pipe);
        let mut line = Vec::new();
        while reader
            .read_until(b'\n', &mut line)
            .is_ok_and(|read| read > 0)
        {
            let text = String::from_utf8_lossy(&line).trim_end().to_owned();
            if send.send(text).is_err() {
                return;
            }
            line.clear();
        }
    })
}
