//! naga's opinion, with Rust lines.

use crate::diagnostic::{Diagnostic, Place, Problem, TranslateError};
use crate::source::Source;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use std::error::Error;

/// Parses and validates a whole module of WGSL, for devices with the given capabilities.
/// An error names the line of the Rust or WGSL file that the offending line came from.
pub fn check(source: &Source, capabilities: Capabilities) -> Result<naga::Module, TranslateError> {
    let module = naga::front::wgsl::parse_str(source.text()).map_err(|error| {
        let line = error.location(source.text()).map(|l| l.line_number);
        let detail = error.labels().map(|(_, text)| text).find(|t| !t.is_empty());
        let message = match detail {
            Some(detail) => format!("{}: {detail}", error.message()),
            None => error.message().to_owned(),
        };
        refused(source, line, message)
    })?;
    Validator::new(ValidationFlags::all(), capabilities)
        .validate(&module)
        .map_err(|error| {
            // Spans of the whole function and of its parameters are among them; the
            // statement is what begins last.
            let spans = error.spans().map(|(span, _)| *span);
            let span = spans.max_by_key(|span| span.to_range().map(|range| range.start));
            let line = span.map(|s| s.location(source.text()).line_number);
            refused(source, line, chain(error.as_inner()))
        })?;
    Ok(module)
}

/// An error's text with its causes'.
fn chain(error: &dyn Error) -> String {
    let mut message = error.to_string();
    let mut cause = error.source();
    while let Some(inner) = cause {
        message = format!("{message}: {inner}");
        cause = inner.source();
    }
    message
}

fn refused(source: &Source, line: Option<u32>, message: String) -> TranslateError {
    let number = line.unwrap_or(1) as usize;
    let text = source.text().lines().nth(number.saturating_sub(1));
    let place = source.origin(number).cloned().unwrap_or(Place {
        path: "WGSL".to_owned(),
        line: number,
    });
    let problem = Problem::Invalid {
        message,
        wgsl: text.unwrap_or_default().trim().to_owned(),
    };
    TranslateError {
        diagnostics: vec![Diagnostic { place, problem }],
    }
}
