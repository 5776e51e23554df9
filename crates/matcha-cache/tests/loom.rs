//! Every interleaving that loom's memory model allows, of two or three threads on one
//! cell. Run with `RUSTFLAGS="--cfg loom" cargo test -p matcha-cache --release --test loom`.
#![cfg(loom)]

use loom::sync::Arc;
use loom::thread;
use matcha_cache::{CacheCounts, Found, Insertion, Keys, NodeSeed, Table, TableSize, node_seed};

fn table(entries: u32) -> Arc<Table> {
    Arc::new(Table::new(TableSize { cells: 1, entries }).unwrap())
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

#[test]
fn of_two_values_for_one_key_one_is_stored_and_stays() {
    loom::model(|| {
        let table = table(2);
        let other = {
            let table = table.clone();
            thread::spawn(move || insert(&table, 1, 10))
        };
        let mine = insert(&table, 1, 20);
        let theirs = other.join().unwrap();
        let stored = [mine, theirs]
            .iter()
            .filter(|&&o| o == Insertion::Stored)
            .count();
        assert_eq!(stored, 1, "{mine:?} {theirs:?}");
        let winner = if mine == Insertion::Stored { 20 } else { 10 };
        assert_eq!(look_up(&table, 1), Some(winner));
        assert_eq!(look_up_in_batch(&table, 1), Some(winner));
        assert_eq!(table.count_occupied(), 1);
    });
}

#[test]
fn two_keys_of_one_cell_never_mix() {
    loom::model(|| {
        let table = table(2);
        let other = {
            let table = table.clone();
            thread::spawn(move || insert(&table, 1, 10))
        };
        let mine = insert(&table, 2, 20);
        let theirs = other.join().unwrap();
        assert!(mine == Insertion::Stored || theirs == Insertion::Stored);
        for (outcome, key, value) in [(mine, 2, 20), (theirs, 1, 10)] {
            assert!(matches!(outcome, Insertion::Stored | Insertion::Lost));
            let expected = (outcome == Insertion::Stored).then_some(value);
            assert_eq!(look_up(&table, key), expected);
        }
    });
}

#[test]
fn the_last_entry_goes_to_one() {
    loom::model(|| {
        let table = table(1);
        let other = {
            let table = table.clone();
            thread::spawn(move || insert(&table, 1, 10))
        };
        let mine = insert(&table, 2, 20);
        let theirs = other.join().unwrap();
        assert!((mine == Insertion::Stored) != (theirs == Insertion::Stored));
        assert_eq!(table.count_occupied(), 1);
    });
}

#[test]
fn a_reader_sees_a_whole_entry_or_a_miss() {
    loom::model(|| {
        let table = table(2);
        let writers: Vec<_> = [(1, 10), (2, 20)]
            .into_iter()
            .map(|(key, value)| {
                let table = table.clone();
                thread::spawn(move || insert(&table, key, value))
            })
            .collect();
        for (key, value) in [(1, 10), (2, 20)] {
            let seen = look_up(&table, key);
            assert!(seen.is_none() || seen == Some(value), "{seen:?}");
            let again = look_up_in_batch(&table, key);
            assert!(again == Some(value) || (again.is_none() && seen.is_none()));
        }
        for writer in writers {
            writer.join().unwrap();
        }
    });
}

#[test]
fn value_zero_is_seen_whole_too() {
    loom::model(|| {
        let table = table(1);
        let other = {
            let table = table.clone();
            thread::spawn(move || insert(&table, 1, 0))
        };
        let seen = look_up(&table, 1);
        assert!(seen.is_none() || seen == Some(0));
        assert_eq!(look_up(&table, 2), None);
        other.join().unwrap();
        assert_eq!(look_up(&table, 1), Some(0));
    });
}
