// What the stages share: paths in flight and their queues.
//
// A slot carries one path at a time: it belongs to one pixel and to every STREAMS-th of its
// samples, so that its sums need no other slot's, and a picture does not depend on the order in
// which slots are worked on.

//@ columns paths Path
//@ columns hits PathHit
//@ columns tasks ShadowTask
//@ columns film FilmSums
// One each.
//@ columns wave_camera RasterCamera
//@ columns wave_settings PathSettings
// Samples that the slot has begun, and one of the STATE_ values.
//@ write slot_next
//@ write slot_state
// Slots by queue, as many as there are for each.
//@ write wave_queues
//@ atomic wave_counts
// Numbers of workgroups by queue, for indirect dispatches.
//@ write wave_sizes
// Sums of counts by queue since the host read them; then look-ups, found ones.
//@ atomic wave_totals
// What is the same for the whole picture: see SCENE_.
//@ plain wave_scene 10

const STATE_IDLE = 0u;
const STATE_ALIVE = 1u;
const STATE_FINISHED = 2u;

const QUEUES = 12u;
const QUEUE_ACTIVE = 0u;
const QUEUE_HITS = 1u;
const QUEUE_ESCAPED = 2u;
const QUEUE_TASKS = 3u;
const QUEUE_EMITTERS = 4u;
const QUEUE_WORLD_TASKS = 5u;
const QUEUE_LIGHT_TASKS = 6u;
const QUEUE_LAYERS = 7u;
const QUEUE_LAYER_HITS = 8u;
const QUEUE_LAYERS_NEXT = 9u;
const QUEUE_MISSES = 10u;

const TOTAL_LOOK_UPS = 12u;
const TOTAL_FOUND = 13u;

const SCENE_WORLD_PROGRAM = 0u;
const SCENE_WORLD_VISIBILITY = 1u;
const SCENE_WORLD_RADIANCE = 2u;
// 4^−(level offset), the bits of a float.
const SCENE_SCALE_SQUARED = 5u;
const SCENE_SEED = 6u;
const SCENE_NOTHING = 0xffffffffu;

fn queue_capacity() -> u32 {
    return count_wave_queues() / QUEUES;
}

fn queue_count(queue: u32) -> u32 {
    return word_wave_counts(queue);
}

fn queue_slot(queue: u32, k: u32) -> u32 {
    return word_wave_queues(queue * queue_capacity() + k);
}

fn queue_push(queue: u32, slot: u32) {
    put_wave_queues(queue * queue_capacity() + add_wave_counts(queue, 1u), slot);
}

fn scene_float(k: u32) -> f32 {
    return bitcast<f32>(word_wave_scene(k));
}

// Numbers of workgroups of the queues whose bits are in argument 0, which are added to the totals;
// then empties those of argument 1.
@compute @workgroup_size(1)
fn wave_measure() {
    for (var queue = 0u; queue < QUEUES; queue += 1u) {
        if (argument(0u) & (1u << queue)) != 0u {
            let count = queue_count(queue);
            let groups = workgroups_for(count);
            put_wave_sizes(3u * queue, groups.x);
            put_wave_sizes(3u * queue + 1u, groups.y);
            put_wave_sizes(3u * queue + 2u, groups.z);
            add_wave_totals(queue, count);
        }
        if (argument(1u) & (1u << queue)) != 0u {
            put_wave_counts(queue, 0u);
        }
    }
}
