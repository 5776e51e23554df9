//! How far it is: a bar on a terminal, a plain line now and then elsewhere.

use indicatif::{HumanDuration, ProgressBar, ProgressStyle};
use matcha_render::backend::Control;
use std::io::{IsTerminal, Write};
use std::sync::Arc;
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Between two plain lines.
const LINE_EVERY: Duration = Duration::from_secs(15);
/// Between two looks at the counter.
const LOOK_EVERY: Duration = Duration::from_millis(200);

/// Watches a control's samples until it is dropped.
pub(crate) struct Watch {
    /// Closed to end the thread.
    end: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl Watch {
    /// Starts to watch; `total` pixel samples are to be done.
    pub fn start(control: Arc<Control>, total: u64) -> Self {
        let (end, ended) = mpsc::channel();
        let thread = std::thread::spawn(move || {
            let mut display = Display::new(total);
            while ended.recv_timeout(LOOK_EVERY) == Err(RecvTimeoutError::Timeout) {
                display.show(control.samples());
            }
            display.finish();
        });
        Self {
            end: Some(end),
            thread: Some(thread),
        }
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        drop(self.end.take());
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

enum Display {
    Bar(ProgressBar),
    Lines {
        total: u64,
        start: Instant,
        last: Instant,
    },
}

impl Display {
    fn new(total: u64) -> Self {
        if !std::io::stderr().is_terminal() {
            let now = Instant::now();
            return Display::Lines {
                total,
                start: now,
                last: now,
            };
        }
        let template = "{percent:>3}% {wide_bar} {per_sec} · {eta} left";
        let style = ProgressStyle::with_template(template)
            .unwrap_or_else(|_| ProgressStyle::default_bar())
            .with_key(
                "per_sec",
                |state: &indicatif::ProgressState, out: &mut dyn std::fmt::Write| {
                    let _ = write!(out, "{}", rate(state.per_sec()));
                },
            );
        Display::Bar(ProgressBar::new(total).with_style(style))
    }

    fn show(&mut self, samples: u64) {
        match self {
            Display::Bar(bar) => bar.set_position(samples),
            Display::Lines { total, start, last } => {
                if last.elapsed() >= LINE_EVERY && samples > 0 {
                    *last = Instant::now();
                    // Not `eprintln!`, which would panic where nobody listens any more.
                    let line = line(samples, *total, start.elapsed());
                    let _ = writeln!(std::io::stderr(), "{line}");
                }
            }
        }
    }

    fn finish(self) {
        if let Display::Bar(bar) = self {
            bar.finish_and_clear();
        }
    }
}

fn line(samples: u64, total: u64, elapsed: Duration) -> String {
    let share = samples as f64 / total.max(1) as f64;
    let per_second = samples as f64 / elapsed.as_secs_f64();
    let left = Duration::from_secs_f64(total.saturating_sub(samples) as f64 / per_second.max(1e-3));
    format!(
        "{:3.0} %, {}, {} left",
        share * 100.0,
        rate(per_second),
        HumanDuration(left)
    )
}

fn rate(per_second: f64) -> String {
    if per_second >= 1e6 {
        format!("{:.2} M samples/s", per_second / 1e6)
    } else {
        format!("{:.0} k samples/s", per_second / 1e3)
    }
}

/// Shows loading: a spinner with the step's name on a terminal, nothing elsewhere.
pub(crate) fn loading() -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{spinner} {msg}")
        .unwrap_or_else(|_| ProgressStyle::default_spinner());
    let spinner = ProgressBar::new_spinner().with_style(style);
    spinner.enable_steady_tick(Duration::from_millis(100));
    spinner
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_says_share_rate_and_rest() {
        let text = line(2_500_000, 10_000_000, Duration::from_secs(2));
        assert_eq!(text, " 25 %, 1.25 M samples/s, 6 seconds left");
    }
}
