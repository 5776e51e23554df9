// Stages of paths: regenerate, traverse, meet lights, leave the scene.

fn wave_ray(path: ptr<function, Path>) -> TraceRay {
    return TraceRay(
        (*path).origin,
        (*path).direction,
        (*path).t_min,
        (*path).t_max,
        path_ray_mask((*path).flags),
        (*path).leaves[0],
        (*path).leaves[1],
    );
}

// Puts finished paths on the film and starts the next ones. Arguments: slots, pixels of the part
// of the picture, its first pixel, the picture's width, the first sample, the end of samples.
@compute @workgroup_size(64)
fn wave_regenerate(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let slot = invocation_number(group, local);
    if slot >= argument(0u) {
        return;
    }
    var state = word_slot_state(slot);
    if state == STATE_FINISHED {
        var sums = load_film(slot);
        var path = load_paths(slot);
        film_add(&sums, &path);
        store_film(slot, sums);
        state = STATE_IDLE;
    }
    let pixels = argument(1u);
    let streams = argument(0u) / pixels;
    let index = argument(4u) + slot / pixels + word_slot_next(slot) * streams;
    if state == STATE_IDLE && index < argument(5u) {
        let pixel = argument(2u) + slot % pixels;
        let column = pixel % argument(3u);
        let row = pixel / argument(3u);
        store_paths(slot, path_start(load_wave_camera(0u), word_wave_scene(SCENE_SEED), column, row, pixel, index));
        put_slot_next(slot, word_slot_next(slot) + 1u);
        state = STATE_ALIVE;
    }
    put_slot_state(slot, state);
    if state == STATE_ALIVE {
        queue_push(QUEUE_ACTIVE, slot);
    }
}

// Finds what every path meets next; Russian roulette ends some at the surface.
@compute @workgroup_size(64)
fn wave_traverse(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let k = invocation_number(group, local);
    if k >= queue_count(QUEUE_ACTIVE) {
        return;
    }
    let slot = queue_slot(QUEUE_ACTIVE, k);
    var path = load_paths(slot);
    let hit = trace_closest(wave_ray(&path));
    store_hits(slot, PathHit(hit.t, hit.u, hit.v, hit.instance, hit.primitive));
    if hit.instance == TRACE_NOTHING {
        queue_push(QUEUE_ESCAPED, slot);
        return;
    }
    let emits = program_head(geometry_material(hit.instance, hit.primitive)).emits != 0u;
    if path_reaches(&path, emits, load_wave_settings(0u)) {
        store_paths_flags(slot, path.flags);
        queue_push(QUEUE_HITS, slot);
    } else {
        put_slot_state(slot, STATE_FINISHED);
    }
}

// Adds the analytic lights on the paths' ways that radiate the same everywhere.
@compute @workgroup_size(64)
fn wave_meet(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let k = invocation_number(group, local);
    if k >= queue_count(QUEUE_ACTIVE) {
        return;
    }
    let slot = queue_slot(QUEUE_ACTIVE, k);
    var path = load_paths(slot);
    let met = path_meet_lights(&path, path.t_min, load_hits(slot).t, load_wave_settings(0u));
    store_paths_radiance(slot, path.radiance);
}

// What the node tree of a light emits in a direction; white where it has none. Uses the slot's
// outputs.
fn light_tree_radiance(light: u32, direction: vec3f, distance: f32, slot: u32) -> vec3f {
    let program = word_light_programs(light_scene_light(light));
    if program == SCENE_NOTHING {
        return vec3f(1.0);
    }
    machine_load_background(program, path_shadow_info(direction, distance));
    finish_program(program_head(program), slot);
    return program_radiance(program, slot);
}

// The same as wave_meet, where lights have node trees.
@compute @workgroup_size(64)
fn wave_meet_trees(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let k = invocation_number(group, local);
    if k >= queue_count(QUEUE_ACTIVE) {
        return;
    }
    let slot = queue_slot(QUEUE_ACTIVE, k);
    let settings = load_wave_settings(0u);
    var path = load_paths(slot);
    var start = path.t_min;
    loop {
        let met = path_meet_lights(&path, start, load_hits(slot).t, settings);
        if met.light == SCENE_NOTHING {
            break;
        }
        let emission = light_tree_radiance(met.light, path.direction, met.distance_, slot);
        path_add_met(&path, met.factor * emission, met.pdf, settings);
        start = met.next;
    }
    store_paths_radiance(slot, path.radiance);
}

// The same as wave_escape, where lights have node trees.
@compute @workgroup_size(64)
fn wave_escape_trees(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let k = invocation_number(group, local);
    if k >= queue_count(QUEUE_ESCAPED) {
        return;
    }
    let slot = queue_slot(QUEUE_ESCAPED, k);
    let settings = load_wave_settings(0u);
    var path = load_paths(slot);
    if !path_leaves_film(&path, settings) {
        // Before suns take the slot's outputs.
        let world = world_radiance(slot);
        var sun = 0u;
        loop {
            let met = path_meet_suns(&path, sun, settings);
            if met.light == SCENE_NOTHING {
                break;
            }
            let emission = light_tree_radiance(met.light, path.direction, met.distance_, slot);
            path_add_met(&path, met.factor * emission, met.pdf, settings);
            sun = u32(met.next);
        }
        path_meet_world(&path, world, word_wave_scene(SCENE_WORLD_VISIBILITY), settings);
    }
    store_paths_radiance(slot, path.radiance);
    store_paths_alpha(slot, path.alpha);
    put_slot_state(slot, STATE_FINISHED);
}

// Adds the world and the suns to paths that left the scene.
@compute @workgroup_size(64)
fn wave_escape(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let k = invocation_number(group, local);
    if k >= queue_count(QUEUE_ESCAPED) {
        return;
    }
    let slot = queue_slot(QUEUE_ESCAPED, k);
    let settings = load_wave_settings(0u);
    var path = load_paths(slot);
    if !path_leaves_film(&path, settings) {
        let met = path_meet_suns(&path, 0u, settings);
        path_meet_world(&path, world_radiance(slot), word_wave_scene(SCENE_WORLD_VISIBILITY), settings);
    }
    store_paths_radiance(slot, path.radiance);
    store_paths_alpha(slot, path.alpha);
    put_slot_state(slot, STATE_FINISHED);
}
