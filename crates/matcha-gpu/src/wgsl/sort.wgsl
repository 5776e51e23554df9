// A counting sort: items are put in the order of their keys, which are less than the number of
// bins. Three dispatches: count (each item learns its rank among those of its key), scan (each key
// learns where its items begin), place. The first and the last are the caller's kernels, because it
// knows what its items are; they call `sort_count` and `sort_position`.
//
// Workgroups do not wait for each other, and nothing depends on the size of subgroups. Items of
// the same key come in any order.

// Items by key; zero between sorts.
//@ atomic sort_bins
// Where each key's items begin.
//@ write sort_starts
// By item: its key, and how many of the same key are before it.
//@ write sort_keys
//@ write sort_ranks

const SORT_NO_KEY = 0xffffffffu;

// Keys of a workgroup, hashed: at most half of the places are taken.
const SORT_PLACES = 128u;
// Key + 1; zero is a free place.
var<workgroup> sort_held: array<atomic<u32>, SORT_PLACES>;
var<workgroup> sort_held_counts: array<atomic<u32>, SORT_PLACES>;
var<workgroup> sort_held_ranks: array<u32, SORT_PLACES>;

// The workgroup's place of a key. Nobody waits for anybody: an exchange fails only because
// another one succeeded, or for no reason.
fn sort_place_of(key: u32) -> u32 {
    var place = ((key + 1u) * 0x9e3779b9u) >> 25u;
    loop {
        let outcome = atomicCompareExchangeWeak(&sort_held[place], 0u, key + 1u);
        if outcome.exchanged || outcome.old_value == key + 1u {
            return place;
        }
        if outcome.old_value != 0u {
            place = (place + 1u) % SORT_PLACES;
        }
    }
    return 0u;
}

// Counts item k. All WORKGROUP invocations of a workgroup call it once, those without an item with
// SORT_NO_KEY. A workgroup's items of one key are counted among themselves first, so that memory
// sees one addition for them, however few keys there are.
fn sort_count(k: u32, local: u32, key: u32) {
    var place = 0u;
    var rank = 0u;
    if key != SORT_NO_KEY {
        place = sort_place_of(key);
        rank = atomicAdd(&sort_held_counts[place], 1u);
    }
    workgroupBarrier();
    for (var p = local; p < SORT_PLACES; p += WORKGROUP) {
        let count = atomicLoad(&sort_held_counts[p]);
        if count > 0u {
            sort_held_ranks[p] = add_sort_bins(atomicLoad(&sort_held[p]) - 1u, count);
        }
    }
    workgroupBarrier();
    if key != SORT_NO_KEY {
        put_sort_keys(k, key);
        put_sort_ranks(k, sort_held_ranks[place] + rank);
    }
}

// Where item k belongs.
fn sort_position(k: u32) -> u32 {
    return word_sort_starts(word_sort_keys(k)) + word_sort_ranks(k);
}

const SORT_SCANNERS = 256u;
var<workgroup> sort_sums: array<u32, SORT_SCANNERS>;

// Makes starts of the counts of argument 0 bins, and empties them. One workgroup: there are as many
// bins as materials, thousands at most, of which each invocation takes a run.
@compute @workgroup_size(256)
fn sort_scan(@builtin(local_invocation_index) local: u32) {
    let each = (argument(0u) + SORT_SCANNERS - 1u) / SORT_SCANNERS;
    let first = min(local * each, argument(0u));
    let end = min(first + each, argument(0u));
    var sum = 0u;
    for (var bin = first; bin < end; bin += 1u) {
        sum += word_sort_bins(bin);
    }
    // Sums of the runs before.
    sort_sums[local] = sum;
    workgroupBarrier();
    for (var step = 1u; step < SORT_SCANNERS; step *= 2u) {
        var before = 0u;
        if local >= step {
            before = sort_sums[local - step];
        }
        workgroupBarrier();
        sort_sums[local] += before;
        workgroupBarrier();
    }
    var start = sort_sums[local] - sum;
    for (var bin = first; bin < end; bin += 1u) {
        put_sort_starts(bin, start);
        start += word_sort_bins(bin);
        put_sort_bins(bin, 0u);
    }
}
