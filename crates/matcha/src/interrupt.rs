//! Ctrl-C: once, and what is rendered so far is saved; twice, and the program ends.

use matcha_render::backend::Control;
use std::sync::{Arc, OnceLock};

/// The control that Ctrl-C stops. The handler is set once in the life of the process.
pub(crate) fn stoppable() -> Arc<Control> {
    static CONTROL: OnceLock<Arc<Control>> = OnceLock::new();
    CONTROL
        .get_or_init(|| {
            let control = Arc::new(Control::default());
            let handled = control.clone();
            let set = ctrlc::set_handler(move || {
                if handled.stopped() {
                    std::process::exit(130);
                }
                handled.stop();
                eprintln!("matcha: stopping; once more to quit at once");
            });
            if let Err(error) = set {
                tracing::warn!("Ctrl-C cannot be handled: {error}");
            }
            control
        })
        .clone()
}
