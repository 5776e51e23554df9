//! The GPU's protocol for devices without 64-bit atomic operations, in interleavings that loom's
//! memory model allows: it can do exactly what the 64-bit table can. Run with
//! `RUSTFLAGS="--cfg loom" cargo test -p matcha-cache --release --test loom_claimed`.
#![cfg(loom)]

mod model;
#[path = "../orders/mod.rs"]
mod orders;

use matcha_cache::{CacheCounts, Insertion, Table, TableSize, node_seed};
use model::{Cell, Mistake};
use orders::{in_every_order, job};
use std::collections::BTreeSet;
use std::sync::Mutex;

/// One cell, by either protocol.
trait OneCell: Send + Sync + 'static {
    fn insert(&self, key: u32, value: u32) -> Insertion;
    fn look_up(&self, key: u32) -> Option<u32>;
}

impl OneCell for Cell {
    fn insert(&self, key: u32, value: u32) -> Insertion {
        self.put(key, value)
    }

    fn look_up(&self, key: u32) -> Option<u32> {
        self.find(key)
    }
}

impl OneCell for Table {
    fn insert(&self, key: u32, value: u32) -> Insertion {
        let texel = [0, key as i32, 0];
        Table::insert(
            self,
            node_seed(3, 5, 0),
            texel,
            value,
            &mut CacheCounts::default(),
        )
    }

    fn look_up(&self, key: u32) -> Option<u32> {
        let texel = [0, key as i32, 0];
        Table::look_up(self, node_seed(3, 5, 0), texel, &mut CacheCounts::default())
    }
}

/// Two writers with a key and a value each, a reader of both keys (unless that is too much to go
/// through), and what is there when all are done.
#[derive(Clone, Copy)]
struct Scene {
    entries: u32,
    writers: [(u32, u32); 2],
    reader: bool,
}

/// What can be seen of a scene.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Outcome {
    insertions: [String; 2],
    read: [Option<u32>; 2],
    left: [Option<u32>; 2],
}

/// What a thread of a scene has seen.
#[derive(Clone, Copy)]
enum Seen {
    Writer(Insertion),
    Reader([Option<u32>; 2]),
}

/// Everything that can come out. The loser of one key, whose value is its own affair, is the same
/// as one that came too late.
fn outcomes<C: OneCell>(
    scene: Scene,
    cell: impl Fn() -> C + Send + Sync + 'static,
) -> BTreeSet<Outcome> {
    let all = std::sync::Arc::new(Mutex::new(BTreeSet::new()));
    let seen = all.clone();
    let keys = scene.writers.map(|(key, _)| key);
    let writers = scene.writers.iter();
    let mut jobs: Vec<_> = writers
        .map(|&(key, value)| job(move |cell: &C| Seen::Writer(cell.insert(key, value))))
        .collect();
    if scene.reader {
        jobs.push(job(move |cell: &C| {
            Seen::Reader(keys.map(|key| cell.look_up(key)))
        }));
    }
    in_every_order(cell, jobs, move |cell, threads| {
        let [Seen::Writer(a), Seen::Writer(b), ..] = threads[..] else {
            panic!("two writers are first")
        };
        let insertions = [a, b];
        let read = match threads.get(2) {
            Some(&Seen::Reader(read)) => read,
            _ => [None; 2],
        };
        let left = keys.map(|key| cell.look_up(key));
        judge(scene, insertions, read, left);
        seen.lock().expect("no panic").insert(Outcome {
            insertions: insertions.map(|insertion| format!("{insertion:?}")),
            read,
            left,
        });
    });
    let all = all.lock().expect("no panic");
    all.clone()
}

/// What must hold in every interleaving.
fn judge(scene: Scene, insertions: [Insertion; 2], read: [Option<u32>; 2], left: [Option<u32>; 2]) {
    let same = scene.writers[0].0 == scene.writers[1].0;
    let stored = insertions.map(|insertion| insertion == Insertion::Stored);
    assert!(stored[0] || stored[1], "{insertions:?}");
    assert!(
        !(same || scene.entries == 1) || stored[0] != stored[1],
        "{insertions:?}"
    );
    for k in 0..2 {
        // A same key may have been stored by the other.
        let by = if same && !stored[k] { 1 - k } else { k };
        let expected = stored[by].then_some(scene.writers[by].1);
        assert_eq!(left[k], expected, "{insertions:?}");
        assert!(
            read[k].is_none() || read[k] == expected,
            "{read:?} of {expected:?}"
        );
    }
    // Both look-ups of one key: what was there stays.
    assert!(!same || read[0].is_none() || read[1] == read[0], "{read:?}");
}

const SAME_KEY: [(u32, u32); 2] = [(1, 10), (1, 20)];
const TWO_KEYS: [(u32, u32); 2] = [(1, 10), (2, 0)];

fn scenes() -> Vec<Scene> {
    let mut scenes = Vec::new();
    for writers in [SAME_KEY, TWO_KEYS] {
        for entries in [1, 2] {
            for reader in [false, true] {
                scenes.push(Scene {
                    entries,
                    writers,
                    reader,
                });
            }
        }
    }
    scenes
}

#[test]
fn it_can_do_exactly_what_the_64_bit_table_can() {
    for scene in scenes() {
        let Scene {
            entries,
            writers,
            reader,
        } = scene;
        let claimed = outcomes(scene, move || Cell::new(entries, None));
        let whole = outcomes(scene, move || {
            Table::new(TableSize { cells: 1, entries }).expect("a table")
        });
        assert_eq!(
            claimed, whole,
            "{entries} entries, {writers:?}, reader {reader}"
        );
        println!(
            "{entries} entries, {writers:?}, reader {reader}: {} outcomes",
            whole.len()
        );
    }
}

/// The value whose complement means "not yet" is never seen, but takes its entry.
#[test]
fn the_value_that_cannot_be_published_is_a_miss() {
    let jobs = [(1, u32::MAX), (2, 20)]
        .map(|(key, value)| job(move |cell: &Cell| (cell.put(key, value), cell.find(1))));
    in_every_order(
        || Cell::new(2, None),
        jobs.to_vec(),
        |cell, results| {
            let (theirs, mine) = (results[0].0, results[1].0);
            assert!(results.iter().all(|(_, found)| found.is_none()));
            assert_eq!(cell.find(1), None);
            assert_eq!(cell.find(2), (mine == Insertion::Stored).then_some(20));
            assert!(mine == Insertion::Stored || theirs == Insertion::Stored);
        },
    );
}

fn must_fail(mistake: Mistake, writers: [(u32, u32); 2]) {
    let scene = Scene {
        entries: 2,
        writers,
        reader: true,
    };
    outcomes(scene, move || Cell::new(2, Some(mistake)));
}

#[test]
#[should_panic]
fn publishing_before_claiming_is_noticed() {
    must_fail(Mistake::PublishedEarly, TWO_KEYS);
}

#[test]
#[should_panic]
fn claiming_without_an_exchange_is_noticed() {
    must_fail(Mistake::NoExchange, SAME_KEY);
}

#[test]
#[should_panic]
fn reading_what_is_only_claimed_is_noticed() {
    must_fail(Mistake::ReadEarly, TWO_KEYS);
}
