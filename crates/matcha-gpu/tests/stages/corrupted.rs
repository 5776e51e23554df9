//! Tests that must fail: what is wrong in one stage is noticed there.

use crate::comparison::compare;
use crate::{PLAIN, Setting, each_step, fault, small_scene};
use matcha_gpu::testing;
use matcha_gpu::wavefront::slot_copy::SlotCopy;
use matcha_gpu::wavefront::{Stage, StepRecord};
use std::collections::BTreeSet;

/// Enough for paths to leave the scene.
const SHORT: Setting = Setting {
    bounces: 2,
    ..PLAIN
};

/// A kernel's stage, the kernel, a term of it, and what stands there instead.
type Mistake = (Stage, &'static str, &'static str, &'static str);

/// One for each stage, but for [`SHADE`].
const KERNELS: [Mistake; 7] = [
    (
        Stage::Regenerate,
        "wave_regenerate",
        "% argument(3u)",
        "% argument(1u)",
    ),
    (Stage::Traverse, "wave_traverse", "hit.t,", "hit.t * 1.001,"),
    (
        Stage::Lights,
        "wave_escape_trees",
        "&path, world,",
        "&path, world * 1.01,",
    ),
    (
        Stage::Evaluate,
        "wave_evaluate",
        "finish_program(head, slot)",
        "finish_program(head, slot ^ 1u)",
    ),
    (Stage::Shade, "wave_emit", "* emission", "* emission * 1.01"),
    (Stage::Shadow, "wave_block", "RAY_SHADOW", "RAY_CAMERA"),
    (Stage::Accumulate, "wave_collect", "+ light", "- light"),
];

/// Of the longest kernel, which older drivers on the processor take minutes to compile.
const SHADE: Mistake = (
    Stage::Shade,
    "wave_shade",
    "let held_out =",
    "path.throughput *= 1.01; let held_out =",
);

/// All steps begin with the device's own memory, so that only the corrupted stage turns red.
fn notice(mistakes: &[Mistake]) {
    let Some(device) = testing::device() else {
        return;
    };
    for &(stage, kernel, sound, corrupted) in mistakes {
        let mut red = BTreeSet::new();
        let mut look = |record: &StepRecord| {
            if fault(record).is_some() {
                red.insert(record.steps[0].stage());
            }
        };
        let done = each_step(
            &device,
            &small_scene(),
            SHORT,
            |library| library.corrupt(kernel, sound, corrupted),
            &mut look,
        );
        done.unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(red, BTreeSet::from([Some(stage)]), "{kernel}");
    }
}

#[test]
fn must_fail_a_corrupted_kernel_is_noticed_in_its_stage() {
    notice(&KERNELS);
}

#[test]
#[ignore = "compiles for minutes on older drivers on the processor"]
fn must_fail_a_corrupted_hit_is_noticed_in_its_stage() {
    notice(&[SHADE]);
}

/// Whatever a step writes: corrupted, it is not what the twin wrote.
#[test]
fn must_fail_a_corrupted_column_is_noticed() {
    let Some(device) = testing::device() else {
        return;
    };
    let mut tried = BTreeSet::new();
    let mut look = |record: &StepRecord| {
        assert_eq!(fault(record), None);
        for (place, device, slots) in corruptions(record) {
            let corrupted = StepRecord {
                device: &device,
                ..*record
            };
            let found = compare(&corrupted);
            let noticed = found.others.len() == slots || !found.wrong.is_empty();
            assert!(
                noticed,
                "{:?}, {place}: {} of {slots}",
                record.steps,
                found.others.len()
            );
            tried.insert((format!("{:?}", record.steps[0].stage()), place));
        }
    };
    let done = each_step(&device, &small_scene(), SHORT, |_| Ok(()), &mut look);
    done.unwrap_or_else(|error| panic!("{error}"));
    let stages: BTreeSet<&str> = tried.iter().map(|(stage, _)| stage.as_str()).collect();
    assert_eq!(
        stages.len(),
        8,
        "all stages, and what belongs to none: {stages:?}"
    );
    assert!(tried.len() > 60, "{tried:?}");
}

/// Sections that have a word for each queue.
const OF_QUEUES: [&str; 3] = ["wave_counts", "wave_sizes", "wave_totals"];

/// What a step wrote, one thing of it wrong: where, everything, and in how many slots.
fn corruptions(record: &StepRecord) -> Vec<(String, SlotCopy, usize)> {
    let mut all = Vec::new();
    for (name, words) in record.before.sections() {
        if name == "wave_counts" || name == "wave_queues" {
            continue;
        }
        let rows = words.len().div_ceil(record.before.capacity() as usize);
        all.extend((0..rows).filter_map(|row| corrupted_row(record, name, row)));
    }
    for queue in SlotCopy::queues() {
        let mut wrong = record.device.clone();
        let before = record.before.words("wave_counts")[queue as usize];
        let count = &mut wrong.words_mut("wave_counts")[queue as usize];
        if *count > before {
            let slots = (*count - before) as usize;
            *count = before;
            all.push((format!("queue {queue}"), wrong, slots));
        }
    }
    all
}

/// One row of a section, wrong in all words that the step changed.
fn corrupted_row(record: &StepRecord, name: &str, row: usize) -> Option<(String, SlotCopy, usize)> {
    let columns = SlotCopy::columns(name);
    let float = columns.map_or(name == "output_rows", |words| words[row].float);
    let mut wrong = record.device.clone();
    let before = record.before.words(name);
    let capacity = record.before.capacity() as usize;
    let words = wrong.words_mut(name);
    let end = words.len().min((row + 1) * capacity);
    let mut slots = 0;
    for i in row * capacity..end {
        if words[i] == before[i] {
            continue;
        }
        slots += 1;
        words[i] = if float {
            let value = f32::from_bits(words[i]);
            (2.0 * value + 1.0f32.copysign(value)).to_bits()
        } else {
            words[i] ^ 1
        };
    }
    let field = columns.map_or("", |words| words[row].path);
    let slots_of = if OF_QUEUES.contains(&name) { 0 } else { slots };
    (slots > 0).then(|| (format!("{name} {row} {field}"), wrong, slots_of))
}
