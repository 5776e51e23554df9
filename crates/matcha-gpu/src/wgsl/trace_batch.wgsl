// Rays of a queue, one an invocation: for tests and measurements.

// Rows of as many words as there is room for rays: origin, direction, t_min, t_max, mask,
// excluded instance and primitive.
//@ read trace_rays 11
// Rows: t, u, v, instance, primitive.
//@ write trace_hits 5

fn trace_ray_float(row: u32, i: u32) -> f32 {
    return bitcast<f32>(trace_ray_word(row, i));
}

fn trace_ray_word(row: u32, i: u32) -> u32 {
    return word_trace_rays(row * count_trace_rays() + i);
}

fn trace_load_ray(i: u32) -> TraceRay {
    return TraceRay(
        vec3f(trace_ray_float(0u, i), trace_ray_float(1u, i), trace_ray_float(2u, i)),
        vec3f(trace_ray_float(3u, i), trace_ray_float(4u, i), trace_ray_float(5u, i)),
        trace_ray_float(6u, i),
        trace_ray_float(7u, i),
        trace_ray_word(8u, i),
        trace_ray_word(9u, i),
        trace_ray_word(10u, i),
    );
}

fn trace_store_hit(i: u32, hit: TraceHit) {
    let row = count_trace_hits();
    put_trace_hits(i, bitcast<u32>(hit.t));
    put_trace_hits(row + i, bitcast<u32>(hit.u));
    put_trace_hits(2u * row + i, bitcast<u32>(hit.v));
    put_trace_hits(3u * row + i, hit.instance);
    put_trace_hits(4u * row + i, hit.primitive);
}

// Argument 0: number of rays.
@compute @workgroup_size(64)
fn trace_closest_rays(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let i = invocation_number(group, local);
    if i < argument(0u) {
        trace_store_hit(i, trace_closest(trace_load_ray(i)));
    }
}

// Only the instance's row is meant: TRACE_NOTHING where nothing is hit. Argument 0: number of rays.
@compute @workgroup_size(64)
fn trace_occluded_rays(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let i = invocation_number(group, local);
    if i < argument(0u) {
        let occluded = trace_occluded(trace_load_ray(i));
        put_trace_hits(3u * count_trace_hits() + i, select(TRACE_NOTHING, 0u, occluded));
    }
}
