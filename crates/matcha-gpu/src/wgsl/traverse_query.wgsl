// Rays through the device's own acceleration structures (`trace/structure.rs`), which find what
// the walk of traverse_walk.wgsl finds: an instance's mask is its visibility, its custom index
// its number, and a primitive's index the triangle's number in the mesh.

//@ structure trace_scene

// The next number above one that is not negative; never one that a device may take for zero.
fn trace_above(t: f32) -> f32 {
    return max(bitcast<f32>(bitcast<u32>(t) + 1u), 1.17549435e-38);
}

// The next number below a positive one.
fn trace_below(t: f32) -> f32 {
    return bitcast<f32>(bitcast<u32>(t) - 1u);
}

fn trace_is_left(ray: TraceRay, instance: u32, primitive: u32) -> bool {
    return instance == ray.excluded_instance && primitive == ray.excluded_primitive;
}

// What the structure holds between two distances, both included.
fn trace_structure(ray: TraceRay, near: f32, far: f32, flags: u32) -> TraceHit {
    var query: ray_query;
    rayQueryInitialize(&query, trace_scene, RayDesc(flags, ray.mask, near, far, ray.origin, ray.direction));
    while rayQueryProceed(&query) {
        let candidate = rayQueryGetCandidateIntersection(&query);
        if candidate.kind == RAY_QUERY_INTERSECTION_TRIANGLE
            && !trace_is_left(ray, candidate.instance_custom_data, candidate.primitive_index) {
            rayQueryConfirmIntersection(&query);
        }
    }
    let met = rayQueryGetCommittedIntersection(&query);
    if met.kind == RAY_QUERY_INTERSECTION_NONE {
        return trace_no_hit(ray);
    }
    return TraceHit(
        met.t,
        met.barycentrics.x,
        met.barycentrics.y,
        met.instance_custom_data,
        met.primitive_index,
    );
}

// Devices are fastest where they need not ask about a triangle. So the triangle that the ray
// leaves is hidden only where it was found: where something else was, hiding it changes nothing.
fn trace_query(ray: TraceRay, flags: u32) -> TraceHit {
    // Hits at the ends are none.
    let near = trace_above(ray.t_min);
    let far = trace_below(ray.t_max);
    if !(ray.t_min < ray.t_max && near <= far) || !ray_is_sound(ray.origin, ray.direction) {
        return trace_no_hit(ray);
    }
    let hit = trace_structure(ray, near, far, flags | RAY_FLAG_FORCE_OPAQUE);
    if hit.instance != TRACE_NOTHING && trace_is_left(ray, hit.instance, hit.primitive) {
        return trace_structure(ray, near, far, flags | RAY_FLAG_FORCE_NO_OPAQUE);
    }
    return hit;
}

// The nearest hit.
fn trace_closest(ray: TraceRay) -> TraceHit {
    return trace_query(ray, RAY_FLAG_NONE);
}

// True if anything is hit.
fn trace_occluded(ray: TraceRay) -> bool {
    return trace_query(ray, RAY_FLAG_TERMINATE_ON_FIRST_HIT).instance != TRACE_NOTHING;
}
