//! Bad luck with a device: each time an error that says what to do, and never a hang.

use matcha_gpu::adapter::{self, Wanted};
use matcha_gpu::batch::{Extent, Runner};
use matcha_gpu::device::Device;
use matcha_gpu::memory::Sections;
use matcha_gpu::pipeline::{KernelSource, Pipelines};
use matcha_gpu::shader::Library;
use matcha_gpu::{GpuError, testing};
use std::time::{Duration, Instant};

const KERNEL: &str = "
//@ write lost_numbers

@compute @workgroup_size(64)
fn fill_numbers(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let i = invocation_number(group, local);
    if i < count_lost_numbers() {
        put_lost_numbers(i, i);
    }
}
";

/// A device of the test's own.
fn device() -> Option<Device> {
    testing::device()?;
    let adapter = adapter::choose(adapter::adapters(), &Wanted::Best).expect("there is one");
    Some(Device::open(&adapter).unwrap_or_else(|error| panic!("{error}")))
}

fn library(device: &Device) -> Library {
    let mut library = Library::embedded(device.report().atomics_64).expect("it is validated");
    library.add("test.wgsl", KERNEL).expect("it is one item");
    library
}

/// Fills a section on a device, which something is done to before.
fn fill(device: &Device, before: impl FnOnce(&Device)) -> Result<Vec<u32>, GpuError> {
    let library = library(device);
    let mut sections = Sections::new();
    sections.zeroed(&library, "lost_numbers", 1000)?;
    let memory = sections.place(device, 1, &[])?;
    let pipelines = Pipelines::new(device, None);
    let kernel = pipelines.kernel(&KernelSource {
        name: "fill_numbers",
        library: &library,
        memories: &[&memory],
        constants: &[],
    })?;
    let mut runner = Runner::new(device)?;
    before(device);
    let mut batch = runner.batch();
    batch.dispatch("fill", &kernel, &[&memory], &[], Extent::Items(1000));
    batch.run()?;
    memory.read("lost_numbers", 0, 1000)
}

#[test]
fn a_device_that_is_taken_away_is_lost_and_nobody_waits_for_it() {
    let Some(device) = device() else {
        return;
    };
    assert_eq!(fill(&device, |_| ()).map(|n| n[999]).ok(), Some(999));
    let start = Instant::now();
    let error = fill(&device, |device| device.raw().destroy()).expect_err("it is gone");
    assert!(matches!(error, GpuError::Lost { .. }), "{error}");
    assert!(
        error
            .to_string()
            .contains("try again, or with --device cpu")
    );
    // And so it stays.
    let error = fill(&device, |_| ()).expect_err("it is gone");
    assert!(matches!(error, GpuError::Lost { .. }), "{error}");
    assert!(start.elapsed() < Duration::from_secs(20));
}

#[test]
fn more_than_there_is_is_refused_with_what_to_do() {
    let Some(device) = device() else {
        return;
    };
    let library = library(&device);
    let mut sections = Sections::new();
    let length = 1 << 44;
    sections
        .zeroed(&library, "lost_numbers", length)
        .expect("it is declared");
    let error = match sections.place(&device, 1, &[]) {
        Ok(_) => panic!("nobody has 64 TiB"),
        Err(error) => error.to_string(),
    };
    assert!(
        error.contains("--cells") && error.contains("--device"),
        "{error}"
    );
    assert_eq!(fill(&device, |_| ()).map(|n| n[999]).ok(), Some(999));
}
