// A ray through the scene and what it meets. Two host layers answer it: the walk of our own
// hierarchy (traverse_walk.wgsl) and the device's ray queries (traverse_query.wgsl); a device
// has one of them.

const TRACE_NOTHING = 0xffffffffu;

// A ray `origin + t * direction` with `t_min < t < t_max`; no number is infinite.
struct TraceRay {
    origin: vec3f,
    direction: vec3f,
    t_min: f32,
    t_max: f32,
    // An instance is seen if it shares a bit.
    mask: u32,
    // The triangle that the ray leaves.
    excluded_instance: u32,
    excluded_primitive: u32,
}

// Where a ray meets a triangle; `instance` is TRACE_NOTHING if it meets none, and then `t` is the
// ray's end. `u` and `v` weigh the second and the third corner.
struct TraceHit {
    t: f32,
    u: f32,
    v: f32,
    instance: u32,
    primitive: u32,
}

fn trace_no_hit(ray: TraceRay) -> TraceHit {
    return TraceHit(ray.t_max, 0.0, 0.0, TRACE_NOTHING, TRACE_NOTHING);
}
