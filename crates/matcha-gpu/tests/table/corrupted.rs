//! Protocols with one mistake each: every one must be noticed.

use super::trial::{Protocol, Trial, Work};
use super::{insert, is_of_key};
use matcha_cache::TableSize;
use matcha_gpu::device::Device;
use matcha_gpu::{GpuError, testing};

/// A mistake in one item: texts of it and what stands in their places, one after the other. What
/// only a reader between two instructions of a writer would see, `matcha-cache` tests with `loom`.
struct Mistake {
    protocol: Protocol,
    item: &'static str,
    edits: &'static [(&'static str, &'static str)],
}

const MISTAKES: [Mistake; 6] = [
    Mistake {
        // The value is published before the entry is claimed.
        protocol: Protocol::Words,
        item: "table_put",
        edits: &[
            ("put_table_values(first + e, ~word);", ""),
            (
                "let outcome =",
                "put_table_values(first + e, ~word); let outcome =",
            ),
        ],
    },
    Mistake {
        // Claimed without asking whether another was faster.
        protocol: Protocol::Words,
        item: "table_put",
        edits: &[(
            "if outcome.exchanged",
            "put_table_fingerprints(first + e, key.fingerprint); if true",
        )],
    },
    Mistake {
        // Claimed only.
        protocol: Protocol::Words,
        item: "table_put",
        edits: &[("put_table_values(first + e, ~word);", "")],
    },
    Mistake {
        // The fingerprint is not compared.
        protocol: Protocol::Words,
        item: "table_find",
        edits: &[("fingerprint == key.fingerprint", "fingerprint != 0u")],
    },
    Mistake {
        // Nor here.
        protocol: Protocol::Long,
        item: "table_find",
        edits: &[(
            "table_fingerprint(entry) == key.fingerprint",
            "entry != 0lu",
        )],
    },
    Mistake {
        // Written without a compare-and-swap.
        protocol: Protocol::Long,
        item: "table_put",
        edits: &[(
            "if outcome.exchanged",
            "put_table_entries(first + e, filled); if true",
        )],
    },
];

/// What is wrong with a table that keys were inserted into by all kernels; empty if nothing is.
fn complaints(device: &Device, mistake: &Mistake) -> Result<Vec<&'static str>, GpuError> {
    let mut library = mistake.protocol.library()?;
    for (old, new) in mistake.edits {
        library.corrupt(mistake.item, old, new)?;
    }
    let (cells, entries, keys) = (1, 10, 10);
    let size = TableSize { cells, entries };
    let trial = Trial::new(device, library, size, u64::MAX, keys)?;
    let work: Vec<Work> = (0..4)
        .map(|_| insert("trial_hammer", keys, 20_000, 1))
        .collect();
    trial.run(&work)?;
    let names = [
        "a value of another key",
        "a value that changed",
        "a key that went",
    ];
    let faults = trial.faults()?;
    let mut all: Vec<_> = (0..3)
        .filter(|&k| faults[k] > 0)
        .map(|k| names[k])
        .collect();
    let found = trial.look_up(keys)?;
    for (key, found) in found.iter().enumerate() {
        match found {
            None => all.push("a lost key"),
            Some(found) if !is_of_key(key, *found) => all.push("a torn value"),
            Some(_) => {}
        }
    }
    if trial.counts()?.stored != trial.occupied()? {
        all.push("counts that do not add up");
    }
    Ok(all)
}

#[test]
fn every_mistake_is_noticed() {
    let Some(device) = testing::device() else {
        return;
    };
    for protocol in Protocol::of(&device) {
        let none = Mistake {
            protocol,
            item: "",
            edits: &[],
        };
        let found = complaints(&device, &none).unwrap_or_else(|error| panic!("{error}"));
        assert!(found.is_empty(), "{protocol:?}: {found:?}");
    }
    let possible = Protocol::of(&device);
    for mistake in MISTAKES.iter().filter(|m| possible.contains(&m.protocol)) {
        let found = complaints(&device, mistake).unwrap_or_else(|error| panic!("{error}"));
        assert!(!found.is_empty(), "{:?} in {}", mistake.edits, mistake.item);
    }
}
