//! The counting sort on a device: what comes out is a permutation, and keys ascend.

use matcha_gpu::batch::{Extent, Runner};
use matcha_gpu::device::Device;
use matcha_gpu::memory::{Memory, Sections};
use matcha_gpu::pipeline::{KernelSource, Pipelines};
use matcha_gpu::shader::Library;
use matcha_gpu::sort::{self, CountingSort};
use matcha_gpu::{GpuError, testing};

/// Items are numbers; argument 0 says how many there are.
const KERNELS: &str = "
//@ read trial_keys
//@ write trial_sorted

@compute @workgroup_size(64)
fn trial_count(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let k = invocation_number(group, local);
    var key = SORT_NO_KEY;
    if k < argument(0u) {
        key = word_trial_keys(k);
    }
    sort_count(k, local, key);
}

@compute @workgroup_size(64)
fn trial_place(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let k = invocation_number(group, local);
    if k < argument(0u) {
        put_trial_sorted(sort_position(k), k);
    }
}
";

/// What is no item's number.
const NOTHING: u32 = u32::MAX;

fn library() -> Library {
    let mut library = Library::embedded(false).unwrap_or_else(|error| panic!("{error}"));
    let added = library.add("sort trial", KERNELS);
    added.unwrap_or_else(|error| panic!("{error}"));
    library
}

/// The numbers of items in the order of their keys, sorted twice with the same memory.
fn sorted(
    device: &Device,
    library: &Library,
    keys: &[u32],
    bins: u32,
) -> Result<Vec<u32>, GpuError> {
    let mut input = Sections::new();
    input.filled(library, "trial_keys", keys)?;
    let input = input.place(device, 1, &[])?;
    let items = keys.len() as u64;
    let mut work = Sections::new();
    sort::add_keys(&mut work, library, bins.into())?;
    for name in sort::ITEMS {
        work.zeroed(library, name, items)?;
    }
    work.filled(library, "trial_sorted", vec![NOTHING; keys.len()])?;
    let work: Memory = work.place(device, 2, &[&input])?;
    let memories = [&input, &work];
    let pipelines = Pipelines::new(device, None);
    let sort = CountingSort::new("trial_count", "trial_place", |name| {
        pipelines.kernel(&KernelSource {
            name,
            library,
            memories: &memories,
            constants: &[],
        })
    })?;
    let mut runner = Runner::new(device)?;
    let mut batch = runner.batch();
    for _ in 0..2 {
        let extent = Extent::Items(items as u32);
        sort.dispatch(&mut batch, &memories, &[items as u32], bins, extent);
    }
    batch.run()?;
    work.read("trial_sorted", 0, items)
}

/// Keys that look random, few of them often.
fn keys(items: u32, bins: u32) -> Vec<u32> {
    let key = |k: u32| {
        let random = matcha_cache::device::key_hash::scatter(k.wrapping_mul(0x9E37_79B9) + 1);
        // Half of the items have one of the last few keys.
        if random & 1 == 0 {
            bins - 1 - (random >> 8) % bins.min(3)
        } else {
            (random >> 8) % bins
        }
    };
    (0..items).map(key).collect()
}

/// What is wrong with an order; `None` if nothing is.
fn complaint(keys: &[u32], order: &[u32]) -> Option<String> {
    let mut all = order.to_vec();
    all.sort_unstable();
    if let Some((k, item)) = (0..).zip(&all).find(|&(k, &item)| k != item) {
        return Some(format!("no permutation: {item} in the place of {k}"));
    }
    let key = |item: u32| keys[item as usize];
    let wrong = order.windows(2).find(|pair| key(pair[0]) > key(pair[1]));
    wrong.map(|pair| format!("key {} before {}", key(pair[0]), key(pair[1])))
}

#[test]
fn all_items_come_out_in_the_order_of_their_keys() {
    let Some(device) = testing::device() else {
        return;
    };
    let library = library();
    for bins in [1, 10, 5000] {
        for items in [0, 1, 63, 65, 100_000] {
            let keys = keys(items, bins);
            let order = sorted(&device, &library, &keys, bins);
            let order = order.unwrap_or_else(|error| panic!("{error}"));
            let complaint = complaint(&keys, &order);
            assert_eq!(complaint, None, "{items} items, {bins} keys");
        }
    }
}

#[test]
fn every_mistake_is_noticed() {
    let Some(device) = testing::device() else {
        return;
    };
    let mistakes = [
        // An inclusive scan.
        ("sort_scan", "sort_sums[local] - sum", "sort_sums[local]"),
        // Bins that keep their counts.
        ("sort_scan", "put_sort_bins(bin, 0u);", ""),
        // All of a workgroup's items are the first of their key.
        ("sort_count", "sort_held_ranks[place] + rank", "rank"),
        // Keys of a workgroup that meet in the hash are taken for the same.
        (
            "sort_place_of",
            "outcome.old_value == key + 1u",
            "outcome.old_value != 0u",
        ),
        (
            "sort_position",
            "word_sort_starts(word_sort_keys(k)) + ",
            "",
        ),
    ];
    let keys = keys(2000, 700);
    for (item, old, new) in mistakes {
        let mut library = library();
        let corrupted = library.corrupt(item, old, new);
        corrupted.unwrap_or_else(|error| panic!("{error}"));
        let order = sorted(&device, &library, &keys, 700);
        let order = order.unwrap_or_else(|error| panic!("{error}"));
        assert!(complaint(&keys, &order).is_some(), "{item}: {new}");
    }
}
