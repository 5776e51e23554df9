//! Interleavings that loom's memory model allows, of two or three threads on one
//! cell. Run with `RUSTFLAGS="--cfg loom" cargo test -p matcha-cache --release --test loom`.
#![cfg(loom)]

mod orders;

use matcha_cache::{CacheCounts, Found, Insertion, Keys, NodeSeed, Table, TableSize, node_seed};
use orders::{Job, in_every_order, job};

fn table(entries: u32) -> Table {
    Table::new(TableSize { cells: 1, entries }).unwrap()
}

fn node() -> NodeSeed {
    node_seed(3, 5, 0)
}

fn insert(table: &Table, i: i32, value: u32) -> Insertion {
    table.insert(node(), [0, i, 0], value, &mut CacheCounts::default())
}

fn look_up(table: &Table, i: i32) -> Option<u32> {
    table.look_up(node(), [0, i, 0], &mut CacheCounts::default())
}

fn look_up_in_batch(table: &Table, i: i32) -> Option<u32> {
    let (mut keys, mut found) = (Keys::default(), Found::default());
    table.prepare(node(), [&[0], &[i], &[0]], &mut keys);
    table.look_up_prepared(&keys, &[node()], &mut found);
    (found.masks()[0] == 1).then(|| found.words(0)[0])
}

fn inserting(key: i32, value: u32) -> Job<Table, Insertion> {
    job(move |table: &Table| insert(table, key, value))
}

#[test]
fn of_two_values_for_one_key_one_is_stored_and_stays() {
    in_every_order(
        || table(2),
        vec![inserting(1, 10), inserting(1, 20)],
        |table, outcomes| {
            let stored = outcomes.iter().filter(|&&o| o == Insertion::Stored).count();
            assert_eq!(stored, 1, "{outcomes:?}");
            let winner = if outcomes[0] == Insertion::Stored {
                10
            } else {
                20
            };
            assert_eq!(look_up(table, 1), Some(winner));
            assert_eq!(look_up_in_batch(table, 1), Some(winner));
            assert_eq!(table.count_occupied(), 1);
        },
    );
}

#[test]
fn two_keys_of_one_cell_never_mix() {
    in_every_order(
        || table(2),
        vec![inserting(1, 10), inserting(2, 20)],
        |table, outcomes| {
            assert!(outcomes.contains(&Insertion::Stored));
            for (outcome, key, value) in [(outcomes[0], 1, 10), (outcomes[1], 2, 20)] {
                assert!(matches!(outcome, Insertion::Stored | Insertion::Lost));
                let expected = (outcome == Insertion::Stored).then_some(value);
                assert_eq!(look_up(table, key), expected);
            }
        },
    );
}

#[test]
fn the_last_entry_goes_to_one() {
    in_every_order(
        || table(1),
        vec![inserting(1, 10), inserting(2, 20)],
        |table, outcomes| {
            assert!((outcomes[0] == Insertion::Stored) != (outcomes[1] == Insertion::Stored));
            assert_eq!(table.count_occupied(), 1);
        },
    );
}

/// Two writers of a value each, and a reader of both, that must see a whole entry or none; some
/// interleaving shows it each.
fn read_while_written(entries: u32, written: [(i32, u32); 2]) {
    let seen = std::sync::Arc::new(std::sync::Mutex::new(std::collections::BTreeSet::new()));
    let all = seen.clone();
    let writer = |(key, value)| {
        job(move |table: &Table| {
            insert(table, key, value);
        })
    };
    let reader = job(move |table: &Table| {
        for (key, value) in written {
            let first = look_up(table, key);
            assert!(first.is_none() || first == Some(value), "{first:?}");
            let again = look_up_in_batch(table, key);
            assert!(again == Some(value) || (again.is_none() && first.is_none()));
            seen.lock().expect("no panic").insert((key, again));
        }
    });
    let jobs = vec![writer(written[0]), writer(written[1]), reader];
    in_every_order(move || table(entries), jobs, |_, _| {});
    let all = all.lock().expect("no panic").clone();
    let expected = written
        .iter()
        .flat_map(|&(key, value)| [(key, None), (key, Some(value))]);
    assert_eq!(all, expected.collect());
}

#[test]
fn a_reader_sees_a_whole_entry_or_a_miss() {
    read_while_written(2, [(1, 10), (2, 20)]);
}

#[test]
fn value_zero_is_seen_whole_too() {
    read_while_written(2, [(1, 0), (2, 20)]);
    let writer = job(|table: &Table| {
        insert(table, 1, 0);
    });
    let reader = job(|table: &Table| {
        let seen = look_up(table, 1);
        assert!(seen.is_none() || seen == Some(0));
        assert_eq!(look_up(table, 2), None);
    });
    in_every_order(
        || table(1),
        vec![writer, reader],
        |table, _| assert_eq!(look_up(table, 1), Some(0)),
    );
}
