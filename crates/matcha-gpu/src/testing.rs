//! A device for tests, or one line that says that there is none.

use crate::adapter::{self, Adapter, Wanted};
use crate::device::Device;
use std::io::Write;
use std::sync::OnceLock;

/// The device that all tests of a process share; `None` where there is no adapter.
///
/// # Panics
/// If there is none and `MATCHA_REQUIRE_GPU` is 1, or the adapter does not open.
pub fn device() -> Option<Device> {
    static DEVICE: OnceLock<Option<Device>> = OnceLock::new();
    DEVICE.get_or_init(open).clone()
}

/// The same with ray queries, on whichever adapter has them; `None` where none has.
///
/// # Panics
/// If there is none and `MATCHA_REQUIRE_RAY_QUERIES` is 1, or the adapter does not open.
pub fn ray_query_device() -> Option<Device> {
    static DEVICE: OnceLock<Option<Device>> = OnceLock::new();
    DEVICE.get_or_init(open_with_ray_queries).clone()
}

fn open_with_ray_queries() -> Option<Device> {
    let mut adapters = adapter::adapters().into_iter();
    let usable =
        |adapter: &Adapter| adapter.report().ray_queries && adapter.report().lacks.is_empty();
    if let Some(adapter) = adapters.find(usable) {
        let opened = Device::open_with(&adapter, true);
        return Some(opened.unwrap_or_else(|error| panic!("{error}")));
    }
    skipped(
        "MATCHA_REQUIRE_RAY_QUERIES",
        "tests of ray queries",
        "no graphics adapter has them",
    )
}

/// Says that tests are skipped, past the test harness, which keeps what passing tests print to
/// itself; unless a variable asks for them.
fn skipped<T>(variable: &str, what: &str, reason: &str) -> Option<T> {
    let required = std::env::var_os(variable).is_some_and(|v| v == "1");
    assert!(!required, "{variable} is set, but {reason}");
    let mut out = std::io::stderr().lock();
    let _ = writeln!(out, "SKIPPED: {what} ({reason})");
    None
}

fn open() -> Option<Device> {
    match adapter::choose(adapter::adapters(), &Wanted::Best) {
        Ok(adapter) => Some(Device::open(&adapter).unwrap_or_else(|error| panic!("{error}"))),
        Err(error) => skipped(
            "MATCHA_REQUIRE_GPU",
            "tests on a graphics device",
            &error.to_string(),
        ),
    }
}
