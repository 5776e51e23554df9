//! Ctrl-C: once, and what is rendered so far is saved; twice, and the program ends.

use matcha_render::backend::Control;
use std::io::Write;
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

/// Signals that come closer together are one wish to stop: `timeout` and other programs
/// that pass signals on send to the process and to its group.
const ONE_WISH: Duration = Duration::from_millis(500);

/// The control that Ctrl-C stops. The handler is set once in the life of the process.
pub(crate) fn stoppable() -> Arc<Control> {
    static CONTROL: OnceLock<Arc<Control>> = OnceLock::new();
    CONTROL
        .get_or_init(|| {
            let control = Arc::new(Control::default());
            let handled = control.clone();
            let mut asked: Option<Instant> = None;
            let set = ctrlc::set_handler(move || match asked {
                Some(at) if at.elapsed() < ONE_WISH => {}
                Some(_) => std::process::exit(130),
                None => {
                    asked = Some(Instant::now());
                    handled.stop();
                    let text = "matcha: stopping; once more to quit at once";
                    let _ = writeln!(std::io::stderr(), "{text}");
                }
            });
            if let Err(error) = set {
                tracing::warn!("Ctrl-C cannot be handled: {error}");
            }
            control
        })
        .clone()
}
