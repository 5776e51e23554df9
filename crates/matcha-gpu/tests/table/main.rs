//! The table on a device, in both protocols: nothing is lost or torn, the first value stays, and
//! it finds what `matcha-cache` finds.

mod corrupted;
mod trial;

use matcha_cache::{CacheCounts, Table, TableSize};
use matcha_gpu::device::Device;
use matcha_gpu::{GpuError, testing};
use trial::{Protocol, Trial, Work, node, texel};

/// Runs a check in both protocols, where there is a device.
fn in_both(check: impl Fn(&Device, Protocol) -> Result<(), GpuError>) {
    let Some(device) = testing::device() else {
        return;
    };
    for protocol in Protocol::of(&device) {
        check(&device, protocol).unwrap_or_else(|error| panic!("{protocol:?}: {error}"));
    }
}

fn trial(
    device: &Device,
    protocol: Protocol,
    size: [u32; 2],
    keys: u32,
) -> Result<Trial, GpuError> {
    let [cells, entries] = size;
    let cells = u64::from(cells);
    Trial::new(
        device,
        protocol.library()?,
        TableSize { cells, entries },
        u64::MAX,
        keys,
    )
}

fn insert(kernel: &'static str, keys: u32, invocations: u32, writer: u32) -> Work {
    Work {
        kernel,
        keys,
        invocations,
        writer,
    }
}

/// `scatter` of `matcha-cache`, as `trial_word` uses it.
fn word(key: u32, writer: u32) -> u32 {
    matcha_cache::device::key_hash::scatter(key + 1) & 0xffff_0000 | writer & 0xffff
}

fn is_of_key(key: usize, found: u32) -> bool {
    found & 0xffff_0000 == word(key as u32, 0)
}

/// A table of the processor, filled with keys in order.
fn twin(size: [u32; 2], keys: u32) -> (Vec<Option<u32>>, CacheCounts) {
    let [cells, entries] = size;
    let table = Table::new(TableSize {
        cells: cells.into(),
        entries,
    })
    .expect("a table");
    let mut counts = CacheCounts::default();
    for key in 0..keys {
        table.insert(node(), texel(key), word(key, 9), &mut counts);
    }
    let find = |key| table.look_up(node(), texel(key), &mut CacheCounts::default());
    ((0..keys).map(find).collect(), counts)
}

#[test]
fn it_finds_the_same_keys_as_the_processors_table() {
    in_both(|device, protocol| {
        // Cells that fill up, and one incomplete square of cells.
        for size in [[1, 7], [100, 3], [1000, 10], [4096, 8]] {
            let keys = 6000;
            let trial = trial(device, protocol, size, keys)?;
            trial.run(&[insert("trial_in_order", keys, 1, 9)])?;
            let (expected, expected_counts) = twin(size, keys);
            assert_eq!(trial.look_up(keys)?, expected, "{protocol:?} {size:?}");
            let counts = trial.counts()?;
            assert_eq!(counts.stored, expected_counts.inserts);
            assert_eq!(counts.refused, expected_counts.refused);
            assert_eq!(counts.lost, 0);
            assert_eq!(trial.occupied()?, counts.stored);
        }
        Ok(())
    });
}

#[test]
fn spread_keys_are_all_there_after_one_round() {
    in_both(|device, protocol| {
        let keys = 100_000;
        let trial = trial(device, protocol, [40_000, 10], keys)?;
        trial.run(&[insert("trial_insert", keys, keys, 0)])?;
        let counts = trial.counts()?;
        assert_eq!(counts.stored + counts.refused + counts.lost, keys.into());
        assert_eq!(trial.occupied()?, counts.stored);
        let found = trial.look_up(keys)?;
        let there = found.iter().flatten().count() as u64;
        assert_eq!(there, counts.stored, "{protocol:?}: one was lost");
        for (key, found) in (0..).zip(found) {
            // Each key was inserted once, by the invocation of its number.
            assert!(
                found.is_none_or(|found| found == word(key, key)),
                "{protocol:?} {key}"
            );
        }
        Ok(())
    });
}

/// All insert a few keys, then others try again with other values.
fn few_keys(device: &Device, protocol: Protocol, kernel: &'static str) -> Result<(), GpuError> {
    for (keys, size) in [(1, [1, 4]), (8, [1, 10]), (50, [7, 64])] {
        let trial = trial(device, protocol, size, keys)?;
        trial.run(&[insert(kernel, keys, 20_000, 0)])?;
        let first = trial.look_up(keys)?;
        let stored = trial.counts()?.stored;
        assert_eq!(
            stored,
            first.iter().flatten().count() as u64,
            "{protocol:?} {kernel}"
        );
        assert_eq!(trial.occupied()?, stored);
        // Losers do not try again by themselves, but as long as there are any, entries fill.
        let mut lost = u64::MAX;
        for round in 1..=keys + 1 {
            trial.run(&[insert(kernel, keys, 20_000, 7 * round)])?;
            let now = trial.counts()?.lost;
            if now == lost {
                break;
            }
            lost = now;
        }
        let second = trial.look_up(keys)?;
        for (key, (first, second)) in first.iter().zip(&second).enumerate() {
            let found = second.unwrap_or_else(|| panic!("{protocol:?} {kernel}: {key} is lost"));
            assert!(
                is_of_key(key, found),
                "{protocol:?} {kernel}: {key} is torn"
            );
            assert!(
                first.is_none_or(|first| first == found),
                "{protocol:?} {kernel}: {key} changed"
            );
        }
        assert_eq!(
            trial.counts()?.stored,
            keys.into(),
            "each key has one entry only"
        );
    }
    Ok(())
}

#[test]
fn neighbours_that_insert_different_keys_of_few() {
    in_both(|device, protocol| few_keys(device, protocol, "trial_insert"));
}

#[test]
fn neighbours_that_insert_the_same_key() {
    in_both(|device, protocol| few_keys(device, protocol, "trial_insert_blocks"));
}

#[test]
fn a_full_cell_refuses_and_keeps_what_it_has() {
    in_both(|device, protocol| {
        let keys = 64;
        let trial = trial(device, protocol, [1, 5], keys)?;
        trial.run(&[insert("trial_insert", keys, 6400, 0)])?;
        let first = trial.look_up(keys)?;
        assert_eq!(first.iter().flatten().count(), 5);
        let before = trial.counts()?;
        assert_eq!(before.stored, 5);
        trial.run(&[insert("trial_insert", keys, keys, 5)])?;
        assert_eq!(trial.look_up(keys)?, first);
        let after = trial.counts()?;
        // Now that the cell is full, every key that is not there is refused, once.
        assert_eq!(
            (after.stored, after.refused, after.lost),
            (5, before.refused + 59, before.lost)
        );
        Ok(())
    });
}

#[test]
fn readers_among_writers_see_whole_entries_that_stay() {
    in_both(|device, protocol| {
        for (keys, size) in [(1, [1, 1]), (16, [1, 10]), (3000, [500, 10])] {
            let trial = trial(device, protocol, size, keys)?;
            trial.run(&[insert("trial_hammer", keys, 20_000, 1)])?;
            assert_eq!(
                trial.faults()?,
                [0; 3],
                "{protocol:?}: torn, changed, gone of {keys} keys"
            );
            assert_eq!(trial.occupied()?, trial.counts()?.stored);
        }
        Ok(())
    });
}

#[test]
fn a_table_in_several_bindings_is_the_same_table() {
    in_both(|device, protocol| {
        let (size, keys) = ([300, 10], 6000);
        // 3,000 entries in three bindings, or twice two.
        let limit = 8192;
        let cells = u64::from(size[0]);
        let entries = size[1];
        let trial = Trial::new(
            device,
            protocol.library()?,
            TableSize { cells, entries },
            limit,
            keys,
        )?;
        trial.run(&[insert("trial_in_order", keys, 1, 9)])?;
        assert_eq!(trial.look_up(keys)?, twin(size, keys).0, "{protocol:?}");
        trial.run(&[insert("trial_hammer", keys, 2000, 1)])?;
        assert_eq!(trial.faults()?, [0; 3], "{protocol:?}");
        Ok(())
    });
}
