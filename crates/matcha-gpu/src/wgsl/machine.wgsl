// The stack machine: instructions of a program over one point, registers in private memory.
// `machine_execute`, the switch over the operations that a scene uses, is written for each
// scene (`crate::machine`).

//@ constant MACHINE_REGISTERS 256

var<private> machine_registers: array<f32, MACHINE_REGISTERS>;
// First constant of the program that runs.
var<private> machine_constants: u32;

fn machine_value(operand: u32) -> f32 {
    if (operand & PROGRAM_CONSTANT) != 0u {
        return bitcast<f32>(word_ProgramView_constants(machine_constants + (operand & (PROGRAM_CONSTANT - 1u))));
    }
    return machine_registers[operand];
}

// Operand `i` of the instruction that begins at `word`.
fn machine_operand(word: u32, i: u32) -> f32 {
    let pair = word_ProgramView_words(word + 1u + (i >> 1u));
    return machine_value((pair >> (16u * (i & 1u))) & 0xffffu);
}

fn machine_immediate(word: u32) -> u32 {
    return word_ProgramView_words(word + PROGRAM_WORD - 1u);
}

fn machine_texture(word: u32) -> vec4f {
    let sampled = texture_sample(
        machine_immediate(word),
        vec2f(machine_operand(word, 0u), machine_operand(word, 1u)),
        vec2f(machine_operand(word, 2u), machine_operand(word, 3u)),
        vec2f(machine_operand(word, 4u), machine_operand(word, 5u)),
    );
    return vec4f(sampled.rgb, sampled.alpha);
}

fn machine_ramp(word: u32) -> vec4f {
    let r = program_ramp(machine_immediate(word), machine_operand(word, 0u));
    return vec4f(r[0], r[1], r[2], r[3]);
}

// Runs instructions from `first` up to before `end`.
fn machine_run(first: u32, end: u32) {
    for (var at = first; at < end; at += 1u) {
        let word = at * PROGRAM_WORD;
        let head = word_ProgramView_words(word);
        let op = head & 0xfffu;
        var value = vec4f();
        if op == PROGRAM_TEXTURE {
            value = machine_texture(word);
        } else if op == PROGRAM_TABLE {
            value = machine_ramp(word);
        } else {
            value = machine_execute(op, word);
        }
        let width = (head >> 12u) & 15u;
        let first_register = head >> 16u;
        for (var i = 0u; i < width; i += 1u) {
            machine_registers[first_register + i] = value[i];
        }
    }
}

// Sets registers to the inputs of a program at a point of a surface.
fn machine_load_surface(program: u32, point: ptr<function, SurfacePoint>) {
    let end = word_GeometryView_first_inputs(program + 1u);
    for (var i = word_GeometryView_first_inputs(program); i < end; i += 1u) {
        let packed = word_GeometryView_inputs(2u * i);
        let row = word_GeometryView_inputs(2u * i + 1u);
        machine_set(row, geometry_input(point, packed), input_width(input_code(packed)));
    }
}

// Likewise of a ray that leaves the scene, or meets a light.
fn machine_load_background(program: u32, ray: PathInfo) {
    let end = word_GeometryView_first_inputs(program + 1u);
    for (var i = word_GeometryView_first_inputs(program); i < end; i += 1u) {
        let packed = word_GeometryView_inputs(2u * i);
        let row = word_GeometryView_inputs(2u * i + 1u);
        machine_set(row, geometry_background(ray, packed), input_width(input_code(packed)));
    }
}

fn machine_set(first: u32, value: array<f32, 4>, width: u32) {
    var components = value;
    for (var i = 0u; i < width; i += 1u) {
        machine_registers[first + i] = components[i];
    }
}
