//! Inserts and look-ups a second of the material cache's table, under full contention and spread,
//! in both protocols, as a Markdown table.
//!
//!     cargo run --release -p matcha-gpu --example table -- [INVOCATIONS]

#[path = "../tests/table/trial.rs"]
mod trial;

use matcha_cache::TableSize;
use matcha_gpu::device::Device;
use matcha_gpu::{GpuError, testing};
use std::time::Duration;
use trial::{Protocol, Trial, Work};

/// Who inserts what into which table.
struct Case {
    name: &'static str,
    /// Different keys for so many invocations.
    keys: fn(u32) -> u32,
    size: TableSize,
}

const ROOMY: TableSize = TableSize {
    cells: 1 << 20,
    entries: 10,
};
const ONE_CELL: TableSize = TableSize {
    cells: 1,
    entries: 10,
};

const CASES: [Case; 4] = [
    Case {
        name: "one key",
        keys: |_| 1,
        size: ONE_CELL,
    },
    Case {
        name: "ten keys of one cell",
        keys: |_| 10,
        size: ONE_CELL,
    },
    Case {
        name: "all keys in one cell, which is full",
        keys: |invocations| invocations,
        size: ONE_CELL,
    },
    Case {
        name: "spread keys",
        keys: |invocations| invocations,
        size: ROOMY,
    },
];

/// Each number is the best of so many runs.
const RUNS: usize = 5;

fn main() {
    let argument = std::env::args().nth(1);
    let invocations = argument.and_then(|a| a.parse().ok()).unwrap_or(1 << 20);
    let Some(device) = testing::device() else {
        return;
    };
    println!("{}, {invocations} invocations\n", device.report().name);
    println!(
        "| protocol | case | inserts, M/s | look-ups, M/s | stored | refused | lost races | torn, changed, gone |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    for protocol in Protocol::of(&device) {
        for case in &CASES {
            if let Err(error) = report(&device, protocol, case, invocations) {
                eprintln!("{error}");
            }
        }
    }
}

fn report(
    device: &Device,
    protocol: Protocol,
    case: &Case,
    invocations: u32,
) -> Result<(), GpuError> {
    let keys = (case.keys)(invocations);
    let trial = Trial::new(device, protocol.library()?, case.size, u64::MAX, 1)?;
    let work = |kernel| Work {
        kernel,
        keys,
        invocations,
        writer: 0,
    };
    let mut times = [Duration::MAX; 2];
    for _ in 0..RUNS {
        trial.clear()?;
        for (best, kernel) in times.iter_mut().zip(["trial_insert", "trial_look_up"]) {
            let time = trial.run(&[work(kernel)])?;
            // Where the device has no clock, the host's.
            let dispatch = time.dispatches.first().map_or(time.wall, |(_, time)| *time);
            *best = (*best).min(dispatch);
        }
    }
    let counts = trial.counts()?;
    trial.run(&[work("trial_hammer")])?;
    let faults = trial.faults()?;
    let rate = |time: Duration| f64::from(invocations) / time.as_secs_f64() * 1e-6;
    println!(
        "| {} | {} | {:.1} | {:.1} | {} | {} | {} | {} |",
        match protocol {
            Protocol::Words => "2 × 32 bits",
            Protocol::Long => "64 bits",
        },
        case.name,
        rate(times[0]),
        rate(times[1]),
        counts.stored,
        counts.refused,
        counts.lost,
        faults.iter().sum::<u32>(),
    );
    Ok(())
}
