//! A device for tests, or one line that says that there is none.

use crate::adapter::{self, Wanted};
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

fn open() -> Option<Device> {
    match adapter::choose(adapter::adapters(), &Wanted::Best) {
        Ok(adapter) => Some(Device::open(&adapter).unwrap_or_else(|error| panic!("{error}"))),
        Err(error) => {
            let required = std::env::var_os("MATCHA_REQUIRE_GPU").is_some_and(|v| v == "1");
            assert!(!required, "MATCHA_REQUIRE_GPU is set, but {error}");
            // Past the test harness, which keeps what passing tests print to itself.
            let mut out = std::io::stderr().lock();
            let _ = writeln!(out, "SKIPPED: tests on a graphics device ({error})");
            None
        }
    }
}
