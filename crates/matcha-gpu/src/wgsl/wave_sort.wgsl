// Queues in the order of what is to be evaluated, so that neighbours run the same instructions: slots
// by program, misses by region. See sort.wgsl.

// Slots of the queue that is sorted, as they were.
//@ write sort_slots
// Numbers of misses in the order of their regions.
//@ write sort_misses

// Argument 0: at which queue; argument 1: number of programs. What has no program comes last.
@compute @workgroup_size(64)
fn wave_sort_slots(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let at = argument(0u);
    let k = invocation_number(group, local);
    var key = SORT_NO_KEY;
    if k < queue_count(at_queue(at)) {
        let slot = queue_slot(at_queue(at), k);
        put_sort_slots(k, slot);
        key = min(at_program(at, slot), argument(1u));
    }
    sort_count(k, local, key);
}

@compute @workgroup_size(64)
fn wave_place_slots(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let queue = at_queue(argument(0u));
    let k = invocation_number(group, local);
    if k < queue_count(queue) {
        put_wave_queues(queue * queue_capacity() + sort_position(k), word_sort_slots(k));
    }
}

@compute @workgroup_size(64)
fn wave_sort_misses(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let k = invocation_number(group, local);
    var key = SORT_NO_KEY;
    if k < queue_count(QUEUE_MISSES) {
        key = word_misses(MISS_REGION * (count_misses() / MISS_ROWS) + k);
    }
    sort_count(k, local, key);
}

@compute @workgroup_size(64)
fn wave_place_misses(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let k = invocation_number(group, local);
    if k < queue_count(QUEUE_MISSES) {
        put_sort_misses(sort_position(k), k);
    }
}
