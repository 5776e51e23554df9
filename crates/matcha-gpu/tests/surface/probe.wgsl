// Points, their quantities, and look-ups of images, one an invocation.

// Rows: instance, primitive, distance, two weights, then the path's words.
//@ read probe_hits
// Packed inputs.
//@ read probe_inputs
// Rows: of the point position, normals, the origin of shadow rays, the cone's width and the
// back side, and then four rows for each input.
//@ write probe_points
//@ plain probe_count
// Rows: look-up, coordinates, two half axes.
//@ read probe_places
//@ write probe_colors

fn probe_word(row: u32, i: u32) -> u32 {
    return word_probe_hits(row * word_probe_count(0u) + i);
}

fn probe_float(row: u32, i: u32) -> f32 {
    return bitcast<f32>(probe_word(row, i));
}

fn probe_path(i: u32) -> PathInfo {
    return PathInfo(
        vec3f(probe_float(5u, i), probe_float(6u, i), probe_float(7u, i)),
        probe_word(8u, i),
        probe_float(9u, i),
        probe_float(10u, i),
        probe_float(11u, i),
        probe_word(12u, i),
        probe_word(13u, i),
        probe_word(14u, i),
        probe_word(15u, i),
        probe_word(16u, i),
    );
}

fn probe_put(row: u32, i: u32, value: f32) {
    put_probe_points(row * word_probe_count(0u) + i, bitcast<u32>(value));
}

fn probe_put3(row: u32, i: u32, value: vec3f) {
    probe_put(row, i, value.x);
    probe_put(row + 1u, i, value.y);
    probe_put(row + 2u, i, value.z);
}

@compute @workgroup_size(64)
fn probe_surfaces(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let i = invocation_number(group, local);
    if i >= word_probe_count(0u) {
        return;
    }
    let weights = vec2f(probe_float(3u, i), probe_float(4u, i));
    var point = geometry_point(probe_word(0u, i), probe_word(1u, i), probe_float(2u, i), weights, probe_path(i));
    probe_put3(0u, i, point.position);
    probe_put3(3u, i, point.normal);
    probe_put3(6u, i, point.true_normal);
    probe_put3(9u, i, point.shadow_origin);
    probe_put(12u, i, point.cone_width);
    probe_put(13u, i, f32(point.backfacing));
    for (var k = 0u; k < count_probe_inputs(); k += 1u) {
        let value = geometry_input(&point, word_probe_inputs(k));
        for (var c = 0u; c < 4u; c += 1u) {
            probe_put(14u + 4u * k + c, i, value[c]);
        }
    }
}

@compute @workgroup_size(64)
fn probe_background(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let i = invocation_number(group, local);
    if i >= word_probe_count(0u) {
        return;
    }
    for (var k = 0u; k < count_probe_inputs(); k += 1u) {
        let value = geometry_background(probe_path(i), word_probe_inputs(k));
        for (var c = 0u; c < 4u; c += 1u) {
            probe_put(4u * k + c, i, value[c]);
        }
    }
}

fn probe_place(row: u32, i: u32) -> f32 {
    return bitcast<f32>(word_probe_places(row * word_probe_count(0u) + i));
}

@compute @workgroup_size(64)
fn probe_textures(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let i = invocation_number(group, local);
    if i >= word_probe_count(0u) {
        return;
    }
    let uv = vec2f(probe_place(1u, i), probe_place(2u, i));
    let a = vec2f(probe_place(3u, i), probe_place(4u, i));
    let b = vec2f(probe_place(5u, i), probe_place(6u, i));
    let color = texture_sample(word_probe_places(i), uv, a, b);
    let all = vec4f(color.rgb, color.alpha);
    for (var c = 0u; c < 4u; c += 1u) {
        put_probe_colors(c * word_probe_count(0u) + i, bitcast<u32>(all[c]));
    }
}
