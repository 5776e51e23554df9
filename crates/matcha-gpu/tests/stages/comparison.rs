//! What a step wrote on the device against what its twin wrote.

use matcha_gpu::wavefront::layout::{MISS_ROWS, QUEUE_MISSES, QUEUES, TOTAL_FOUND, Word};
use matcha_gpu::wavefront::slot_copy::SlotCopy;
use matcha_gpu::wavefront::{Step, StepRecord};
use std::collections::{BTreeMap, BTreeSet};

/// Stated error of floats: absolute (metres, or radiance where lights are of the order of 1), and
/// relative. Devices round quotients, square roots and sums otherwise than the processor, and a
/// surface's point is known to a few units in the last place of its coordinates.
pub const ABSOLUTE: f32 = 2e-5;
pub const RELATIVE: f32 = 2e-4;

/// Rows of a slot's outputs and of its cached values.
const FLOAT_ROWS: [&str; 2] = ["output_rows", "cached_rows"];
/// Sections that only the kernels of a sort hand to each other.
const SCRATCH: [&str; 5] = [
    "sort_bins",
    "sort_keys",
    "sort_ranks",
    "sort_slots",
    "sort_starts",
];

/// What the cache had: its table has no twin, in which nothing is found.
const NODES_FOUND: &str = "paths.nodes_found";

/// How the two differ.
#[derive(Debug, Default)]
pub struct Difference {
    /// Slots that the device changed, or the twin.
    pub changed: BTreeSet<u32>,
    /// Slots of which a word is beyond the stated error, or that are in other queues.
    pub others: BTreeSet<u32>,
    /// Things that belong to no slot and are not the same.
    pub wrong: Vec<String>,
    /// One of each field in which slots differ: what the device has, and the twin.
    pub fields: BTreeMap<String, [f32; 2]>,
}

impl Difference {
    fn note(&mut self, slot: u32, field: impl Into<String>, values: [f32; 2]) {
        self.others.insert(slot);
        self.fields.entry(field.into()).or_insert(values);
    }
}

/// Compares every word that a step may have written.
pub fn compare(record: &StepRecord) -> Difference {
    let mut difference = Difference::default();
    for (name, _) in record.before.sections() {
        if SCRATCH.contains(&name) {
            continue;
        }
        let sections = [record.before, record.device, record.twin].map(|slots| slots.words(name));
        let looked_up = looks_up(record);
        let capacity = record.before.capacity() as usize;
        match (name, SlotCopy::columns(name)) {
            ("wave_queues" | "wave_counts", _) => {}
            ("wave_totals", _) => compare_totals(record, &mut difference),
            ("wave_sizes", _) => compare_sizes(record, &mut difference),
            ("wave_camera" | "wave_settings", _) => {
                if sections[1] != sections[2] {
                    difference.wrong.push(name.to_owned());
                }
            }
            ("misses", _) => compare_misses(record, &mut difference),
            ("sort_misses", _) => compare_order(record, &mut difference),
            (_, Some(words)) => {
                let field = |row: usize| (format!("{name}.{}", words[row].path), words[row]);
                compare_rows(sections, capacity, field, looked_up, &mut difference);
            }
            _ => {
                let float = FLOAT_ROWS.contains(&name);
                let field = |_| (name.to_owned(), Word { path: "", float });
                compare_rows(sections, capacity, field, looked_up, &mut difference);
            }
        }
    }
    compare_queues(record, &mut difference);
    difference
}

/// Sections that have rows of a word a slot.
fn compare_rows(
    [before, device, twin]: [&[u32]; 3],
    capacity: usize,
    field: impl Fn(usize) -> (String, Word),
    looked_up: bool,
    difference: &mut Difference,
) {
    for i in 0..before.len() {
        let slot = (i % capacity) as u32;
        if device[i] != before[i] || twin[i] != before[i] {
            difference.changed.insert(slot);
        }
        if device[i] == twin[i] {
            continue;
        }
        let (name, word) = field(i / capacity);
        let values = [device[i], twin[i]].map(|bits| {
            if word.float {
                f32::from_bits(bits)
            } else {
                bits as f32
            }
        });
        if name == NODES_FOUND && looked_up {
            continue;
        }
        if !word.float || !agree(values) {
            difference.note(slot, name, values);
        }
    }
}

/// Whether floats are the same up to the stated error. What is no number is the same as another.
fn agree([a, b]: [f32; 2]) -> bool {
    if !(a.is_finite() && b.is_finite()) {
        return a == b || (a.is_nan() && b.is_nan());
    }
    (a - b).abs() <= ABSOLUTE.max(RELATIVE * a.abs().max(b.abs()))
}

/// The misses of a queue that is not empty: slot, program, region and texel of each, in any order.
fn misses(slots: &SlotCopy) -> BTreeSet<Vec<u32>> {
    let words = slots.words("misses");
    let rows = words.len() / MISS_ROWS as usize;
    let count = slots.words("wave_counts")[QUEUE_MISSES as usize];
    (0..count as usize)
        .map(|k| words.iter().skip(k).step_by(rows).copied().collect())
        .collect()
}

fn compare_misses(record: &StepRecord, difference: &mut Difference) {
    let [device, twin] = [record.device, record.twin].map(misses);
    for miss in device.symmetric_difference(&twin) {
        difference.note(miss[0], "misses", [miss[3] as f32, miss[4] as f32]);
    }
}

/// Sorted numbers of misses: all of them, the regions ascending.
fn compare_order(record: &StepRecord, difference: &mut Difference) {
    if !record.steps.contains(&Step::SortMisses) || record.steps.len() > 1 {
        return;
    }
    let order = |slots: &SlotCopy| -> BTreeSet<u32> {
        let count = misses(slots).len();
        slots.words("sort_misses")[..count]
            .iter()
            .copied()
            .collect()
    };
    if order(record.device) != order(record.twin) {
        difference.wrong.push("sort_misses".to_owned());
    }
}

/// Queues as sets; no slot may be in one twice.
fn compare_queues(record: &StepRecord, difference: &mut Difference) {
    for queue in 0..QUEUES {
        if queue == QUEUE_MISSES {
            continue;
        }
        let [before, device, twin] = [record.before, record.device, record.twin].map(|slots| {
            slots
                .queue(queue)
                .iter()
                .copied()
                .collect::<BTreeSet<u32>>()
        });
        if device.len() != record.device.queue(queue).len() {
            difference
                .wrong
                .push(format!("a slot is in queue {queue} twice"));
        }
        difference
            .changed
            .extend(device.symmetric_difference(&before));
        for &slot in device.symmetric_difference(&twin) {
            let values = [&device, &twin].map(|set| f32::from(u8::from(set.contains(&slot))));
            difference.note(slot, format!("queue {queue}"), values);
        }
    }
}

/// Whether steps ask the cache, so that the device evaluates less than the twin.
fn looks_up(record: &StepRecord) -> bool {
    let asks = |step: &Step| matches!(step, Step::LookUp(_) | Step::Inline(_));
    record.steps.iter().any(asks)
}

/// Numbers of workgroups, but for those over what the cache lacked.
fn compare_sizes(record: &StepRecord, difference: &mut Difference) {
    let [device, twin] = [record.device, record.twin].map(|slots| slots.words("wave_sizes"));
    for (queue, (device, twin)) in (0..).zip(device.chunks(3).zip(twin.chunks(3))) {
        if device != twin && !(queue == QUEUE_MISSES && looks_up(record)) {
            difference
                .wrong
                .push(format!("workgroups of queue {queue}"));
        }
    }
}

/// Counts, but for those of what the cache had and lacked.
fn compare_totals(record: &StepRecord, difference: &mut Difference) {
    let [device, twin] = [record.device, record.twin].map(|slots| slots.words("wave_totals"));
    for (k, (device, twin)) in (0..).zip(device.iter().zip(twin)) {
        let of_cache = k == TOTAL_FOUND || k == QUEUE_MISSES;
        if device != twin && !(of_cache && looks_up(record)) {
            difference.wrong.push(format!("count {k}: {device} {twin}"));
        }
    }
}
