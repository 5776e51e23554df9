// Stages of node networks: look up, evaluate what was not found, evaluate the rest. What is to be
// evaluated at a slot, and of which queue, says argument 0.

// Values of the regions of a slot's program, row by row.
//@ write cached_rows
// Outputs of a slot's program, row by row.
//@ write output_rows
// What the cache did not have, row by row: slot, program, region, texel.
//@ write misses
// Program of each light of the scene, or SCENE_NOTHING.
//@ read light_programs

const MISS_ROWS = 6u;
const MISS_REGION = 2u;

// Where paths hit surfaces.
const AT_HITS = 0u;
// Points on emissive surfaces towards which shadow rays go.
const AT_EMITTERS = 1u;
// Transparent surfaces on the way of shadow rays.
const AT_LAYERS = 2u;
// Directions in which paths left the scene.
const AT_ESCAPED = 3u;
// Directions of shadow rays to the world.
const AT_WORLD_TASKS = 4u;
// Directions of shadow rays to lights with node trees.
const AT_LIGHT_TASKS = 5u;

fn at_queue(at: u32) -> u32 {
    switch at {
        case AT_HITS: { return QUEUE_HITS; }
        case AT_EMITTERS: { return QUEUE_EMITTERS; }
        case AT_LAYERS: { return QUEUE_LAYER_HITS; }
        case AT_ESCAPED: { return QUEUE_ESCAPED; }
        case AT_WORLD_TASKS: { return QUEUE_WORLD_TASKS; }
        default: { return QUEUE_LIGHT_TASKS; }
    }
}

fn at_hit(at: u32, slot: u32) -> PathHit {
    if at == AT_EMITTERS {
        let uv = load_tasks_uv(slot);
        return PathHit(load_tasks_distance_(slot), uv.x, uv.y, load_tasks_instance(slot), load_tasks_primitive(slot));
    }
    return load_hits(slot);
}

fn at_info(at: u32, slot: u32) -> PathInfo {
    if at == AT_HITS || at == AT_ESCAPED {
        var path = load_paths(slot);
        return path_info(&path, load_hits_t(slot));
    }
    var distance = 0.0;
    if at == AT_LIGHT_TASKS {
        distance = load_tasks_distance_(slot);
    }
    return path_shadow_info(load_tasks_direction(slot), distance);
}

fn at_point(at: u32, slot: u32) -> SurfacePoint {
    let hit = at_hit(at, slot);
    return geometry_point(hit.instance, hit.primitive, hit.t, vec2f(hit.u, hit.v), at_info(at, slot));
}

fn at_program(at: u32, slot: u32) -> u32 {
    if at <= AT_LAYERS {
        let hit = at_hit(at, slot);
        return geometry_material(hit.instance, hit.primitive);
    }
    if at == AT_LIGHT_TASKS {
        let light = load_tasks_light(slot);
        return word_light_programs(light_scene_light(light));
    }
    return word_wave_scene(SCENE_WORLD_PROGRAM);
}

fn cached_value(row: u32, slot: u32) -> f32 {
    return bitcast<f32>(word_cached_rows(row * queue_capacity() + slot));
}

fn put_cached_value(row: u32, slot: u32, value: f32) {
    put_cached_rows(row * queue_capacity() + slot, bitcast<u32>(value));
}

// The virtual texel of a region at a point.
fn region_texel(region: ProgramRegion, point: ptr<function, SurfacePoint>) -> ProgramTexel {
    let uv = geometry_quantity(point, input_pack(INPUT_UV, INPUT_PART_VALUE, region.uv));
    let a = geometry_quantity(point, input_pack(INPUT_UV, INPUT_PART_AXIS_A, region.uv));
    let b = geometry_quantity(point, input_pack(INPUT_UV, INPUT_PART_AXIS_B, region.uv));
    return program_texel(uv.xy, a.xy, b.xy, scene_float(SCENE_SCALE_SQUARED));
}

// Looks a value of a region up and puts it into the slot's rows; false if the table lacks it.
fn look_up_value(index: u32, texel: ProgramTexel, slot: u32) -> bool {
    let value = program_value(index);
    var words = array<u32, 3>();
    let parts = value_words(value.kind);
    var found = true;
    for (var part = 0u; part < parts; part += 1u) {
        let entry = table_find(program_key(index, part, texel));
        found = found && entry.found;
        words[part] = entry.word;
    }
    if found {
        var decoded = value_decode(value.kind, words);
        for (var i = 0u; i < value.width; i += 1u) {
            put_cached_value(value.first_row + i, slot, decoded[i]);
        }
    }
    return found;
}

// Looks all values of a region up at a texel; the number of those found.
fn look_up_region(region: ProgramRegion, texel: ProgramTexel, slot: u32) -> u32 {
    var found = 0u;
    for (var i = 0u; i < region.values; i += 1u) {
        if look_up_value(region.first_value + i, texel, slot) {
            found += 1u;
        }
    }
    return found;
}

// Computes the values of a region at a texel in the registers, stores them, and puts them into the
// slot's rows.
fn compute_region(program: u32, region: ProgramRegion, texel: ProgramTexel, slot: u32) {
    machine_constants = program_head(program).first_constant;
    let centre = texel_centre(texel.i, texel.j, texel.level);
    machine_registers[region.texel] = centre.x;
    machine_registers[region.texel + 1u] = centre.y;
    machine_registers[region.texel + 2u] = texel_footprint(texel.level);
    machine_run(region.first, region.end);
    for (var i = 0u; i < region.values; i += 1u) {
        store_value(region.first_value + i, texel, slot);
    }
}

fn store_value(index: u32, texel: ProgramTexel, slot: u32) {
    let value = program_value(index);
    var computed = array<f32, 4>();
    for (var i = 0u; i < value.width; i += 1u) {
        computed[i] = machine_operand(value.store * PROGRAM_WORD, i);
    }
    let encoded = value_encode(value.kind, computed);
    if encoded.fits {
        var words = encoded.words;
        for (var part = 0u; part < value_words(value.kind); part += 1u) {
            table_put(program_key(index, part, texel), words[part]);
        }
        // As a later look-up would give it.
        computed = value_decode(value.kind, words);
    }
    for (var i = 0u; i < value.width; i += 1u) {
        put_cached_value(value.first_row + i, slot, computed[i]);
    }
}

fn count_look_ups(at: u32, slot: u32, values: u32, found: u32) {
    if values > 0u {
        add_wave_totals(TOTAL_LOOK_UPS, values);
        add_wave_totals(TOTAL_FOUND, found);
    }
    if at == AT_HITS && found > 0u {
        store_paths_nodes_found(slot, load_paths_nodes_found(slot) + f32(found));
    }
}

fn push_miss(slot: u32, program: u32, region: u32, texel: ProgramTexel) {
    let rows = count_misses() / MISS_ROWS;
    let k = add_wave_counts(QUEUE_MISSES, 1u);
    put_misses(k, slot);
    put_misses(rows + k, program);
    put_misses(MISS_REGION * rows + k, region);
    put_misses(3u * rows + k, bitcast<u32>(texel.level));
    put_misses(4u * rows + k, bitcast<u32>(texel.i));
    put_misses(5u * rows + k, bitcast<u32>(texel.j));
}

// Looks the cacheable nodes of every hit up; those of which a value is not found are put together.
@compute @workgroup_size(64)
fn wave_look_up(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let at = argument(0u);
    let k = invocation_number(group, local);
    if k >= queue_count(at_queue(at)) {
        return;
    }
    let slot = queue_slot(at_queue(at), k);
    let program = at_program(at, slot);
    let head = program_head(program);
    var point = at_point(at, slot);
    var values = 0u;
    var found = 0u;
    for (var i = 0u; i < head.regions; i += 1u) {
        let region = program_region(head.first_region + i);
        let texel = region_texel(region, &point);
        let here = look_up_region(region, texel, slot);
        values += region.values;
        found += here;
        if here < region.values {
            push_miss(slot, program, head.first_region + i, texel);
        }
    }
    count_look_ups(at, slot, values, found);
}

// Evaluates what was not found, and stores it. Argument 0 is 1 where misses are sorted.
@compute @workgroup_size(64)
fn wave_misses(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    var k = invocation_number(group, local);
    if k >= queue_count(QUEUE_MISSES) {
        return;
    }
    if argument(0u) != 0u {
        k = word_sort_misses(k);
    }
    let rows = count_misses() / MISS_ROWS;
    let texel = ProgramTexel(
        bitcast<i32>(word_misses(3u * rows + k)),
        bitcast<i32>(word_misses(4u * rows + k)),
        bitcast<i32>(word_misses(5u * rows + k)),
    );
    compute_region(word_misses(rows + k), program_region(word_misses(MISS_REGION * rows + k)), texel, word_misses(k));
}

// Puts the values of a program's regions, as they are in the slot's rows, into registers.
fn load_cached(head: ProgramHead, slot: u32) {
    for (var i = 0u; i < head.regions; i += 1u) {
        let region = program_region(head.first_region + i);
        for (var v = 0u; v < region.values; v += 1u) {
            let value = program_value(region.first_value + v);
            for (var c = 0u; c < value.width; c += 1u) {
                machine_registers[value.result + c] = cached_value(value.first_row + c, slot);
            }
        }
    }
}

// Runs a program's instructions behind its regions, and writes the slot's outputs.
fn finish_program(head: ProgramHead, slot: u32) {
    machine_constants = head.first_constant;
    machine_run(head.rest, head.end);
    for (var row = 0u; row < head.outputs; row += 1u) {
        let value = machine_value(program_output(head.first_output + row));
        put_output_rows(row * queue_capacity() + slot, bitcast<u32>(value));
    }
}

// Evaluates programs, but for their regions, whose values are in the slots' rows.
@compute @workgroup_size(64)
fn wave_evaluate(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let at = argument(0u);
    let k = invocation_number(group, local);
    if k >= queue_count(at_queue(at)) {
        return;
    }
    let slot = queue_slot(at_queue(at), k);
    let program = at_program(at, slot);
    if program == SCENE_NOTHING {
        return;
    }
    let head = program_head(program);
    if at <= AT_LAYERS {
        var point = at_point(at, slot);
        machine_load_surface(program, &point);
    } else {
        machine_load_background(program, at_info(at, slot));
    }
    load_cached(head, slot);
    finish_program(head, slot);
}

// The paper's form: each hit looks up, evaluates what is missing and goes on, all in one kernel.
@compute @workgroup_size(64)
fn wave_inline(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let at = argument(0u);
    let k = invocation_number(group, local);
    if k >= queue_count(at_queue(at)) {
        return;
    }
    let slot = queue_slot(at_queue(at), k);
    let program = at_program(at, slot);
    let head = program_head(program);
    var point = at_point(at, slot);
    var values = 0u;
    var found = 0u;
    for (var i = 0u; i < head.regions; i += 1u) {
        let region = program_region(head.first_region + i);
        let texel = region_texel(region, &point);
        let here = look_up_region(region, texel, slot);
        values += region.values;
        found += here;
        if here < region.values {
            compute_region(program, region, texel, slot);
        }
    }
    count_look_ups(at, slot, values, found);
    machine_load_surface(program, &point);
    load_cached(head, slot);
    finish_program(head, slot);
}
