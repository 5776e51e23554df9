// The table alone: keys by number, inserted and looked up. Arguments 0 to 2 are the seed of the
// keys' node, 3 the number of keys, 4 that of invocations, 5 what is added to an invocation's number.

// Rows: was a key found, and its value.
//@ write trial_found 2
// What must not happen: a value of another key; one that changed; a key that was there and is gone.
//@ atomic trial_faults

// `trial.rs` makes the same texels.
fn trial_key(k: u32) -> KeyHash {
    let seed = NodeSeed(argument(0u), argument(1u), argument(2u));
    return hash_texel(seed, i32(k % 5u) - 2, i32((k / 5u) % 1000u) - 500, i32(k / 5000u) - 3);
}

// The upper half tells the key, the lower one who wrote it.
fn trial_word(k: u32, writer: u32) -> u32 {
    return (scatter(k + 1u) & 0xffff0000u) | (writer & 0xffffu);
}

fn trial_put(k: u32, writer: u32) {
    table_put(trial_key(k), trial_word(k, writer));
}

// One invocation inserts all keys in order.
@compute @workgroup_size(1)
fn trial_in_order() {
    for (var k = 0u; k < argument(3u); k += 1u) {
        trial_put(k, argument(5u));
    }
}

// Neighbours insert different keys.
@compute @workgroup_size(64)
fn trial_insert(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let i = invocation_number(group, local);
    if i < argument(4u) {
        trial_put(i % argument(3u), i + argument(5u));
    }
}

// Neighbours insert the same key, as many as there are for each.
@compute @workgroup_size(64)
fn trial_insert_blocks(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let i = invocation_number(group, local);
    if i < argument(4u) {
        let each = (argument(4u) + argument(3u) - 1u) / argument(3u);
        trial_put(i / each, i + argument(5u));
    }
}

// Looks keys up, and keeps what it finds of the first `count_trial_found()`.
@compute @workgroup_size(64)
fn trial_look_up(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let i = invocation_number(group, local);
    if i >= argument(4u) {
        return;
    }
    let k = i % argument(3u);
    let entry = table_find(trial_key(k));
    if i < count_trial_found() {
        put_trial_found(i, u32(entry.found));
        put_trial_found(count_trial_found() + i, entry.word);
    } else if entry.found && (entry.word & 0xffff0000u) != trial_word(k, 0u) {
        add_trial_faults(0u, 1u);
    }
}

fn trial_judge(k: u32, before: TableEntry, after: TableEntry) {
    if after.found && (after.word & 0xffff0000u) != trial_word(k, 0u) {
        add_trial_faults(0u, 1u);
    }
    if before.found && after.found && before.word != after.word {
        add_trial_faults(1u, 1u);
    }
    if before.found && !after.found {
        add_trial_faults(2u, 1u);
    }
}

// Readers and writers of the same keys at the same time: each invocation goes through keys in an
// order of its own, looks up, inserts and looks up twice.
@compute @workgroup_size(64)
fn trial_hammer(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let i = invocation_number(group, local);
    if i >= argument(4u) {
        return;
    }
    let nothing = TableEntry(false, 0u);
    for (var round = 0u; round < 16u; round += 1u) {
        let k = hash_four_words(i / 3u, round, 0u, argument(5u)).x % argument(3u);
        let first = table_find(trial_key(k));
        trial_judge(k, nothing, first);
        trial_put(k, i);
        let second = table_find(trial_key(k));
        trial_judge(k, first, second);
        trial_judge(k, second, table_find(trial_key(k)));
    }
}
