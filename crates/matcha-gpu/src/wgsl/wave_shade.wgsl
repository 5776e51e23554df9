// Stages of closures: what happens at hits, what lights and transparent surfaces do to shadow rays.

// Where the rows of the closure that is read begin: ClosureRows is a view without memory of its
// own, on the outputs of a slot's program.
var<private> closure_slot: u32;
var<private> closure_first: u32;

fn word_ClosureRows_row(k: u32) -> u32 {
    return word_output_rows((closure_first + k) * queue_capacity() + closure_slot);
}

fn count_ClosureRows_row() -> u32 {
    return count_output_rows() / queue_capacity();
}

// The radiance of a world's or a light's program, whose outputs are the slot's.
fn program_radiance(program: u32, slot: u32) -> vec3f {
    let head = program_head(program);
    closure_slot = slot;
    var sum = vec3f();
    for (var i = 0u; i < head.closures; i += 1u) {
        let closure = program_closure(head.first_closure + i);
        closure_first = closure.first_row;
        sum += closure_radiance(closure.kind);
    }
    return sum;
}

fn world_radiance(slot: u32) -> vec3f {
    let program = word_wave_scene(SCENE_WORLD_PROGRAM);
    if program == SCENE_NOTHING {
        return vec3f(
            scene_float(SCENE_WORLD_RADIANCE),
            scene_float(SCENE_WORLD_RADIANCE + 1u),
            scene_float(SCENE_WORLD_RADIANCE + 2u),
        );
    }
    return program_radiance(program, slot);
}

// A point as its closures see it, with the shading normal that they bend.
fn point_frame(program: u32, slot: u32, point: ptr<function, SurfacePoint>) -> ClosureFrame {
    let head = program_head(program);
    closure_slot = slot;
    var normal = (*point).normal;
    for (var i = 0u; i < head.closures; i += 1u) {
        let closure = program_closure(head.first_closure + i);
        if closure.kind == CLOSURE_SHADING_NORMAL {
            closure_first = closure.first_row;
            normal = closure_shading_normal(normal);
            break;
        }
    }
    return ClosureFrame(normal, (*point).true_normal, (*point).outgoing, (*point).backfacing != 0u, true);
}

// Makes the lobes of a point from the slot's outputs.
fn build_lobes(
    program: u32,
    slot: u32,
    point: ptr<function, SurfacePoint>,
    context: ClosureContext,
    lobes: ptr<function, LobeSet>,
) {
    closure_set_begin(lobes, point_frame(program, slot, point));
    let head = program_head(program);
    for (var i = 0u; i < head.closures; i += 1u) {
        let closure = program_closure(head.first_closure + i);
        closure_first = closure.first_row;
        closure_prepare(closure.kind, context, lobes);
    }
}

// What the surface at a point does but scattering.
fn point_glow(program: u32, slot: u32, point: ptr<function, SurfacePoint>) -> ClosureGlow {
    let frame = point_frame(program, slot, point);
    let head = program_head(program);
    var sum = ClosureGlow();
    for (var i = 0u; i < head.closures; i += 1u) {
        let closure = program_closure(head.first_closure + i);
        closure_first = closure.first_row;
        let glow = closure_glow(closure.kind, frame);
        sum.emission += glow.emission;
        sum.transparency += glow.transparency;
    }
    return sum;
}

fn push_task(slot: u32, task: ShadowTask) {
    store_tasks(slot, task);
    queue_push(QUEUE_TASKS, slot);
    switch task.emits {
        case LIGHT_EMITS_SURFACE: { queue_push(QUEUE_EMITTERS, slot); }
        case LIGHT_EMITS_WORLD: { queue_push(QUEUE_WORLD_TASKS, slot); }
        case LIGHT_EMITS_TREE: { queue_push(QUEUE_LIGHT_TASKS, slot); }
        default: {}
    }
}

// Everything that happens at a path's hit.
@compute @workgroup_size(64)
fn wave_shade(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let k = invocation_number(group, local);
    if k >= queue_count(QUEUE_HITS) {
        return;
    }
    let slot = queue_slot(QUEUE_HITS, k);
    let settings = load_wave_settings(0u);
    var path = load_paths(slot);
    let hit = load_hits(slot);
    // Not at_point, which would read the path once more.
    let info = path_info(&path, hit.t);
    var point = geometry_point(hit.instance, hit.primitive, hit.t, vec2f(hit.u, hit.v), info);
    let program = geometry_material(hit.instance, hit.primitive);
    var lobes: LobeSet;
    build_lobes(program, slot, &point, path_closure_context(&path, settings), &lobes);
    var task = path_no_task();
    let held_out = geometry_holdout(point.instance);
    let lives = path_shade(settings, &path, &point, &lobes, hit.t, held_out, &task);
    store_paths(slot, path);
    if !lives {
        put_slot_state(slot, STATE_FINISHED);
    }
    if task.emits != LIGHT_EMITS_NOTHING {
        push_task(slot, task);
    }
}

// Multiplies the emission of surfaces, the world or lights (argument 0: at which) into the shadow
// rays that wait for it.
@compute @workgroup_size(64)
fn wave_emit(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let at = argument(0u);
    let k = invocation_number(group, local);
    if k >= queue_count(at_queue(at)) {
        return;
    }
    let slot = queue_slot(at_queue(at), k);
    let program = at_program(at, slot);
    var emission = vec3f(1.0);
    if at == AT_EMITTERS {
        var point = at_point(at, slot);
        emission = point_glow(program, slot, &point).emission;
    } else if program != SCENE_NOTHING {
        emission = program_radiance(program, slot);
    }
    store_tasks_value(slot, load_tasks_value(slot) * emission);
}

fn task_ray(task: ptr<function, ShadowTask>, mask: u32) -> TraceRay {
    return TraceRay(
        (*task).origin,
        (*task).direction,
        (*task).t_min,
        (*task).t_max,
        mask,
        (*task).leaves[0],
        (*task).leaves[1],
    );
}

fn is_black(color: vec3f) -> bool {
    return all(color == vec3f(0.0));
}

// Ends the shadow rays that opaque surfaces block. Argument 0 is 1 where some material is
// transparent.
@compute @workgroup_size(64)
fn wave_block(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let k = invocation_number(group, local);
    if k >= queue_count(QUEUE_TASKS) {
        return;
    }
    let slot = queue_slot(QUEUE_TASKS, k);
    var task = load_tasks(slot);
    if is_black(task.value) || !task.casts_shadow {
        return;
    }
    if trace_occluded(task_ray(&task, RAY_SHADOW)) {
        store_tasks_value(slot, vec3f());
    } else if argument(0u) != 0u {
        queue_push(QUEUE_LAYERS, slot);
    }
}

// Finds the next transparent surface on the way of each shadow ray.
@compute @workgroup_size(64)
fn wave_layer(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let k = invocation_number(group, local);
    if k >= queue_count(argument(0u)) {
        return;
    }
    let slot = queue_slot(argument(0u), k);
    var task = load_tasks(slot);
    let hit = trace_closest(task_ray(&task, RAY_TRANSPARENT_SHADOW));
    if hit.instance != TRACE_NOTHING {
        store_hits(slot, PathHit(hit.t, hit.u, hit.v, hit.instance, hit.primitive));
        queue_push(QUEUE_LAYER_HITS, slot);
    }
}

// Weakens the shadow rays by the surfaces that they met, and sends them on (into queue argument 0).
@compute @workgroup_size(64)
fn wave_pass(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let k = invocation_number(group, local);
    if k >= queue_count(QUEUE_LAYER_HITS) {
        return;
    }
    let slot = queue_slot(QUEUE_LAYER_HITS, k);
    var point = at_point(AT_LAYERS, slot);
    let through = point_glow(at_program(AT_LAYERS, slot), slot, &point).transparency;
    var task = load_tasks(slot);
    let hit = load_hits(slot);
    path_task_through(&task, through, hit.t, array<u32, 2>(hit.instance, hit.primitive));
    store_tasks(slot, task);
    if !is_black(task.value) {
        queue_push(argument(0u), slot);
    }
}

// Adds to the paths what the shadow rays bring.
@compute @workgroup_size(64)
fn wave_collect(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let k = invocation_number(group, local);
    if k >= queue_count(QUEUE_TASKS) {
        return;
    }
    let slot = queue_slot(QUEUE_TASKS, k);
    let light = path_clamped(load_tasks_value(slot), load_tasks_bounce(slot), load_wave_settings(0u));
    store_paths_radiance(slot, load_paths_radiance(slot) + light);
}
