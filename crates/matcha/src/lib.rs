//! The `matcha` command: scenes in, pictures and comparisons out. What other tools need
//! of it, pictures, their measures and how errors are said, is public.

mod arguments;
mod command;
mod device;
mod interrupt;
mod loading;
pub mod measure;
mod output;
pub mod picture;
mod progress;
mod session;

use arguments::{Arguments, Command};
use clap::Parser;
use clap::error::ErrorKind;
use std::io::Write;
use std::process::ExitCode;

/// Runs the command line of this process. Every error is one sentence on standard
/// error and exit code 2; a rendering that was interrupted ends with 130.
pub fn main() -> ExitCode {
    session::note_start();
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => return refuse_arguments(&error),
    };
    start_log();
    let outcome = match &arguments.command {
        Command::Render(arguments) => command::render::run(arguments),
        Command::Compare(arguments) => command::compare::run(arguments),
        Command::Inspect(arguments) => command::inspect::run(arguments),
        Command::Devices(arguments) => command::devices::run(arguments),
    };
    match outcome {
        Ok(End::Done) => ExitCode::SUCCESS,
        Ok(End::Interrupted) => ExitCode::from(130),
        Err(error) => {
            say(&sentence(&error));
            ExitCode::from(2)
        }
    }
}

/// How a command ended that did not fail.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum End {
    Done,
    Interrupted,
}

/// Help and version go to standard output; anything else is one sentence.
fn refuse_arguments(error: &clap::Error) -> ExitCode {
    if !error.use_stderr() {
        let _ = error.print();
        return ExitCode::SUCCESS;
    }
    if error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        say("no command was given; there are render, compare, inspect and devices");
        return ExitCode::from(2);
    }
    let text = error.render().to_string();
    // What clap says before its usage and tips is the sentence.
    let sentence: Vec<&str> = text
        .lines()
        .map(str::trim)
        .take_while(|line| !line.is_empty() && !line.starts_with("Usage:"))
        .collect();
    let sentence = sentence.join(" ");
    let sentence = sentence.strip_prefix("error: ").unwrap_or(&sentence);
    say(sentence);
    ExitCode::from(2)
}

/// An error with its causes on one line, each once: some errors say their cause themselves.
pub fn sentence(error: &anyhow::Error) -> String {
    let mut sentence = String::new();
    for cause in error.chain().map(ToString::to_string) {
        if sentence.is_empty() {
            sentence = cause;
        } else if !sentence.contains(&cause) {
            sentence += &format!(": {cause}");
        }
    }
    one_line(&sentence)
}

/// One line on standard error. Where nobody listens, the exit code has to do: `eprintln!`
/// would panic.
fn say(text: &str) {
    let _ = writeln!(std::io::stderr(), "matcha: {}", one_line(text));
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Warnings and what was substituted, on standard error; more with `RUST_LOG`.
fn start_log() {
    let filter = tracing_subscriber::EnvFilter::try_from_default_env().unwrap_or_else(|_| {
        tracing_subscriber::EnvFilter::new(
            "warn,matcha=info,matcha_import=info,matcha_render=info,matcha_gpu=info",
        )
    });
    tracing_subscriber::fmt()
        .with_env_filter(filter)
        .with_writer(std::io::stderr)
        // It would say by `eprintln!` that standard error is closed, and panic.
        .log_internal_errors(false)
        .without_time()
        .with_target(false)
        .compact()
        .init();
}

#[cfg(test)]
mod tests {
    use super::*;
    use anyhow::Context;

    #[test]
    fn causes_are_said_once_and_on_one_line() {
        let missing = || Err::<(), _>(std::io::Error::other("disk full"));
        let plain = missing().context("a.png: cannot be written").unwrap_err();
        assert_eq!(sentence(&plain), "a.png: cannot be written: disk full");
        let said = missing().context("a.png:\n disk full").unwrap_err();
        assert_eq!(sentence(&said), "a.png: disk full");
    }
}
