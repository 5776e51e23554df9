//! Device code on a device against the same code on the processor: every operation of the
//! table, and functions of every module, at thousands of random points.

mod adapter;
mod closure_probes;
mod closures;
mod memory;
mod memory_probes;
mod points;
mod probes;
#[path = "../support/mod.rs"]
mod support;

use adapter::{Device, Point};
use matcha_shade::ops;
use matcha_shade::vm::scalar;
use matcha_wgsl::{DispatchForm, Operations, Translation};
use support::{device, module, table};

const COUNT: usize = 4096;

type Probe = fn([u32; 13]) -> [u32; 4];

/// Probes whose results are the same bits on every device.
const EXACT: &[(&str, Probe)] = &[
    ("probe_rounding", probes::probe_rounding),
    ("probe_hashes", probes::probe_hashes),
    ("probe_keys", probes::probe_keys),
    ("probe_sobol", probes::probe_sobol),
    ("probe_constructs", probes::probe_constructs),
];

/// Probes with numbers, and how far from the processor's, relative to max(1, |x|), a
/// device's may be: twice the error that the functions state, 10⁻⁴ for closures and lights,
/// which state none.
const NUMBERS: &[(&str, Probe, f32)] = &[
    ("probe_waves", probes::probe_waves, 2e-6),
    ("probe_powers", probes::probe_powers, 2e-6),
    ("probe_power", probes::probe_power, 2e-5),
    ("probe_arcs", probes::probe_arcs, 2e-6),
    ("probe_texels", probes::probe_texels, 0.0),
    ("probe_encodings", probes::probe_encodings, 0.0),
    ("probe_decodings", probes::probe_decodings, 2e-6),
    ("probe_noises", probes::probe_noises, 2e-4),
    ("probe_octaves", probes::probe_octaves, 2e-3),
    ("probe_mappings", probes::probe_mappings, 2e-6),
    ("probe_diffuse", probes::probe_diffuse, 1e-5),
    ("probe_ggx", probes::probe_ggx, 1e-4),
    ("probe_beckmann", probes::probe_beckmann, 1e-4),
    ("probe_ashikhmin", probes::probe_ashikhmin, 1e-4),
    ("probe_slope", probes::probe_slope, 1e-4),
    ("probe_triangle", probes::probe_triangle, 1e-4),
];

/// WGSL whose `run` calls a probe.
fn probe_wgsl(code: &Translation, probe: &str) -> String {
    let words: Vec<String> = (0..13).map(|i| format!("inputs[p + {i}u]")).collect();
    format!(
        "{}\nfn run(point: Point, immediate: u32) -> vec4u {{\n    let p = point.first;\n    \
         let r = {probe}(array<u32, 13>({}));\n    return vec4u(r[0], r[1], r[2], r[3]);\n}}\n",
        code.needed([probe]).source.text(),
        words.join(", ")
    )
}

/// WGSL whose `run` executes one operation.
fn operation_wgsl(code: &Translation, all: &Operations, index: usize) -> String {
    let one = Operations {
        entries: vec![all.entries[index].clone()],
    };
    let dispatch = one.dispatch(&DispatchForm {
        name: "execute",
        parameters: "point: Point, immediate: u32",
        arguments: "point, immediate",
        operand: "row(point, {}u)",
        immediate: "immediate",
    });
    format!(
        "{}{}{}\nfn run(point: Point, immediate: u32) -> vec4u {{\n    \
         return bitcast<vec4u>(execute({}u, point, immediate));\n}}\n",
        code.needed(one.functions()).source.text(),
        one.source().text(),
        dispatch.text(),
        one.entries[0].code
    )
}

/// How far two results are apart at most: |a − b| / max(1, |b|). Same bits, and two
/// not-a-numbers, are not apart.
fn apart(a: &[[u32; 4]], b: &[[u32; 4]]) -> f32 {
    let pairs = a.as_flattened().iter().zip(b.as_flattened());
    let distance = |(&a, &b): (&u32, &u32)| {
        let (x, y) = (f32::from_bits(a), f32::from_bits(b));
        if a == b || (x.is_nan() && y.is_nan()) {
            0.0
        } else if x.is_nan() || y.is_nan() {
            f32::INFINITY
        } else {
            (x - y).abs() / y.abs().max(1.0)
        }
    };
    pairs.map(distance).fold(0.0, f32::max)
}

fn probes_code() -> Translation {
    device(vec![module("matcha-wgsl/tests/device/probes.rs")])
}

#[test]
fn whole_numbers_are_the_same_bits() {
    let Some(device) = Device::find() else { return };
    let code = probes_code();
    let mut points = points::words(COUNT, 1);
    points.extend(points::numbers(COUNT, [-300.0, 300.0], 8, 2));
    for (name, probe) in EXACT {
        let there = device.run(&probe_wgsl(&code, name), &points);
        for (point, there) in points.iter().zip(there) {
            assert_eq!(
                there,
                probe(*point),
                "{name} at {point:?} on {}",
                device.name
            );
        }
    }
}

#[test]
fn functions_agree() {
    let Some(device) = Device::find() else { return };
    let code = probes_code();
    let points = points::numbers(COUNT, [-4.0, 4.0], 256, 3);
    println!("{}", device.name);
    let mut failures = Vec::new();
    for (name, probe, bound) in NUMBERS {
        let there = device.run(&probe_wgsl(&code, name), &points);
        let here: Vec<[u32; 4]> = points.iter().map(|p| probe(*p)).collect();
        let distance = apart(&there, &here);
        println!("{name:20} {distance:e} of {bound:e}");
        if distance > *bound {
            failures.push(*name);
        }
    }
    assert!(
        failures.is_empty(),
        "{failures:?} differ on {}",
        device.name
    );
}

/// An operation over points on the processor.
fn operation_here(op: ops::OpCode, points: &[Point]) -> Vec<[u32; 4]> {
    let width = op.info().result.width();
    let value = |point: &Point| {
        let operands: Vec<f32> = point[..12].iter().map(|&w| f32::from_bits(w)).collect();
        let mut value = scalar::apply(op, point[12], &operands);
        value[width..].fill(0.0);
        value.map(f32::to_bits)
    };
    points.iter().map(value).collect()
}

#[test]
fn operations_agree() {
    let Some(device) = Device::find() else { return };
    let code = support::device(Vec::new());
    let all = table(&code);
    println!("{}", device.name);
    let mut failures = Vec::new();
    for op in ops::all() {
        let info = op.info();
        let seed = u64::from(op.0) + 100;
        let points = points::numbers(COUNT, info.domain, 8, seed);
        let there = device.run(&operation_wgsl(&code, &all, op.0 as usize), &points);
        let distance = apart(&there, &operation_here(op, &points));
        // Each of the two may be off by the stated error.
        if distance > 0.0 {
            println!("{:32} {distance:e} of {:e}", info.name, 2.0 * info.error);
        }
        if distance > 2.0 * info.error {
            failures.push(info.name);
        }
    }
    assert!(
        failures.is_empty(),
        "{failures:?} differ on {}",
        device.name
    );
}

/// Operations that cancel near a special value, so that a rounding more or less shows:
/// `box_weights` divides by 2·limit − 1, which for a blend of 10⁻⁶ keeps 3 of 24 bits.
const CANCELLING: &[&str] = &["box_weights"];

/// Zeros, whole numbers and halves, where selections and roundings turn.
#[test]
fn operations_agree_about_special_values() {
    let Some(device) = Device::find() else { return };
    let code = support::device(Vec::new());
    let all = table(&code);
    let mut failures = Vec::new();
    for op in ops::all() {
        let info = op.info();
        let points = points::special(COUNT, 8, u64::from(op.0));
        let there = device.run(&operation_wgsl(&code, &all, op.0 as usize), &points);
        let distance = apart(&there, &operation_here(op, &points));
        if distance > 2.0 * info.error && !CANCELLING.contains(&info.name) {
            failures.push((info.name, distance));
        }
    }
    assert!(
        failures.is_empty(),
        "{failures:?} differ on {}",
        device.name
    );
}

/// All operations in one shader, chosen at run time, as a machine does it.
#[test]
fn the_switch_runs_the_operation_of_its_code() {
    let Some(device) = Device::find() else { return };
    let code = support::device(Vec::new());
    let all = table(&code);
    let dispatch = all.dispatch(&DispatchForm {
        name: "execute",
        parameters: "point: Point, immediate: u32",
        arguments: "point, immediate",
        operand: "row(point, {}u)",
        immediate: "immediate",
    });
    let wgsl = format!(
        "{}{}{}\nfn run(point: Point, word: u32) -> vec4u {{\n    \
         return bitcast<vec4u>(execute(word & 0xffffu, point, word >> 16u));\n}}\n",
        code.needed(all.functions()).source.text(),
        all.source().text(),
        dispatch.text()
    );
    let each = 64;
    let mut points = Vec::new();
    for op in ops::all() {
        let mut some = points::numbers(each, op.info().domain, 8, 1000 + u64::from(op.0));
        for point in &mut some {
            point[12] = point[12] << 16 | u32::from(op.0);
        }
        points.extend(some);
    }
    let mut failures = Vec::new();
    let begin = std::time::Instant::now();
    let there = device.run(&wgsl, &points);
    println!(
        "{} operations in one pipeline: {:?}",
        ops::all().count(),
        begin.elapsed()
    );
    for (op, (points, there)) in ops::all().zip(points.chunks_mut(each).zip(there.chunks(each))) {
        for point in points.iter_mut() {
            point[12] >>= 16;
        }
        let distance = apart(there, &operation_here(op, points));
        let info = op.info();
        if distance > 2.0 * info.error {
            failures.push((info.name, distance));
        }
    }
    assert!(
        failures.is_empty(),
        "{failures:?} differ on {}",
        device.name
    );
}

/// The comparison itself: a corrupted operation, whatever it is, must turn it red.
#[test]
fn a_corrupted_operation_is_noticed() {
    let Some(device) = Device::find() else { return };
    let mut modules = support::device_modules();
    let perlin = modules.iter_mut().find(|m| m.path.ends_with("/hash.rs"));
    let perlin = perlin.expect("there are hashes");
    let sound = "rotate_left(b0, 14)";
    assert!(perlin.source.contains(sound));
    perlin.source = perlin.source.replacen(sound, "rotate_left(b0, 13)", 1);
    let code = matcha_wgsl::translate(&modules).unwrap_or_else(|e| panic!("{e}"));
    let op = ops::OpCode::by_name("noise_signed_3d").expect("the operation");
    let points = points::numbers(COUNT, op.info().domain, 8, 7);
    let there = device.run(
        &operation_wgsl(&code, &table(&code), op.0 as usize),
        &points,
    );
    let distance = apart(&there, &operation_here(op, &points));
    assert!(
        distance > 2.0 * op.info().error,
        "{distance} went unnoticed"
    );
}
