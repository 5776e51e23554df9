//! Protocols with one mistake each: every one must be noticed.

use super::trial::{Protocol, Trial, Work};
use super::{insert, is_of_key};
use matcha_cache::TableSize;
use matcha_gpu::device::Device;
use matcha_gpu::{GpuError, testing};

/// A mistake in one item.
struct Mistake {
    protocol: Protocol,
    item: &'static str,
    old: &'static str,
    new: &'static str,
}

const MISTAKES: [Mistake; 6] = [
    Mistake {
        // The value is published before the entry is claimed.
        protocol: Protocol::Words,
        item: "table_put",
        old: "let outcome =",
        new: "put_table_values(first + e, ~word); let outcome =",
    },
    Mistake {
        // Claimed without asking whether another was faster.
        protocol: Protocol::Words,
        item: "table_put",
        old: "if outcome.exchanged",
        new: "put_table_fingerprints(first + e, key.fingerprint); if true",
    },
    Mistake {
        // The fingerprint is not compared.
        protocol: Protocol::Words,
        item: "table_find",
        old: "fingerprint == key.fingerprint",
        new: "fingerprint != 0u",
    },
    Mistake {
        // A claimed entry is taken for a whole one.
        protocol: Protocol::Words,
        item: "table_find",
        old: "value != 0u",
        new: "true",
    },
    Mistake {
        protocol: Protocol::Long,
        item: "table_find",
        old: "table_fingerprint(entry) == key.fingerprint",
        new: "entry != 0lu",
    },
    Mistake {
        // Written without a compare-and-swap.
        protocol: Protocol::Long,
        item: "table_put",
        old: "if outcome.exchanged",
        new: "put_table_entries(first + e, filled); if true",
    },
];

/// What is wrong with a table that keys were inserted into by all kernels; empty if nothing is.
fn complaints(device: &Device, mistake: &Mistake) -> Result<Vec<&'static str>, GpuError> {
    let mut library = mistake.protocol.library()?;
    if !mistake.item.is_empty() {
        library.corrupt(mistake.item, mistake.old, mistake.new)?;
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
        let (item, old, new) = ("", "", "");
        let none = Mistake {
            protocol,
            item,
            old,
            new,
        };
        let found = complaints(&device, &none).unwrap_or_else(|error| panic!("{error}"));
        assert!(found.is_empty(), "{protocol:?}: {found:?}");
    }
    let possible = Protocol::of(&device);
    for mistake in MISTAKES.iter().filter(|m| possible.contains(&m.protocol)) {
        let found = complaints(&device, mistake).unwrap_or_else(|error| panic!("{error}"));
        println!("{} → {}: {found:?}", mistake.old, mistake.new);
        assert!(!found.is_empty(), "{} in {}", mistake.new, mistake.item);
    }
}
