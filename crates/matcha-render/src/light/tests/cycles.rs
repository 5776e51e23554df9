//! Irradiance of every kind of light against Cycles' renderings of a floor
//! (`blender/tests/light_reference.py`).

use super::*;
use glam::Mat3;
use serde_json::Value;

const REFERENCE: &str = include_str!("cycles_lights.json");

fn numbers<const N: usize>(value: &Value) -> [f32; N] {
    std::array::from_fn(|i| value[i].as_f64().expect("a number") as f32)
}

fn shape(kind: &str, properties: &Value) -> LightShape {
    let number = |key: &str, default: f64| properties[key].as_f64().unwrap_or(default) as f32;
    let radius = number("shadow_soft_size", 0.0);
    let soft_falloff = properties["use_soft_falloff"].as_bool().unwrap_or(false);
    match kind {
        "POINT" => LightShape::Point {
            radius,
            soft_falloff,
        },
        "SPOT" => LightShape::Spot {
            radius,
            angle: number("spot_size", 0.0),
            blend: number("spot_blend", 0.0),
            soft_falloff,
        },
        "SUN" => LightShape::Sun {
            angle: number("angle", 0.0),
        },
        _ => {
            let x = number("size", 0.0);
            let name = properties["shape"].as_str().expect("areas have a shape");
            let square = name == "SQUARE" || name == "DISK";
            LightShape::Area {
                size: Vec2::new(x, if square { x } else { number("size_y", 0.0) }),
                ellipse: name == "DISK" || name == "ELLIPSE",
                spread: number("spread", std::f64::consts::PI),
            }
        }
    }
}

fn reference_light(case: &Value) -> Light {
    let column = |i: usize| Vec3::from(numbers::<3>(&case["matrix"][i]));
    let matrix = Mat3::from_cols(column(0), column(1), column(2));
    let properties = &case["properties"];
    let shape = shape(case["kind"].as_str().expect("a kind"), properties);
    Light {
        normalize: properties["normalize"].as_bool().unwrap_or(true),
        ..light(
            shape,
            Affine3A::from_mat3_translation(matrix, column(3)),
            Vec3::from(numbers::<3>(&case["power"])),
        )
    }
}

/// Largest deviation from Cycles over the points, relative to the brightest point.
fn deviation(case: &Value, points: &Value, light: Light) -> f32 {
    let lights = lamps(vec![light]);
    let expected: Vec<Vec3> = (0..4)
        .map(|i| Vec3::from(numbers::<3>(&case["irradiance"][i])))
        .collect();
    let brightest = expected.iter().map(|e| e.max_element()).fold(0.0, f32::max);
    let differences = expected.iter().enumerate().map(|(i, expected)| {
        let [x, y] = numbers::<2>(&points[i]);
        let found = irradiance(&lights, Vec3::new(x, y, 0.0), Vec3::Z, 1 << 16);
        let scale = expected.max_element().max(0.02 * brightest);
        (found - expected).abs().max_element() / scale
    });
    differences.fold(0.0, f32::max)
}

#[test]
fn every_light_is_as_bright_as_in_cycles() {
    let reference: Value = serde_json::from_str(REFERENCE).expect("valid JSON");
    let cases = reference["lights"].as_array().expect("a list");
    assert!(cases.len() > 20);
    let mut failed = Vec::new();
    for case in cases {
        let deviation = deviation(case, &reference["points"], reference_light(case));
        println!("{}: {:.3} %", case["name"], deviation * 100.0);
        if deviation.is_nan() || deviation > 0.005 {
            failed.push(format!("{}: {deviation}", case["name"]));
        }
    }
    assert!(failed.is_empty(), "{failed:?}");
}

#[test]
fn a_light_one_percent_too_bright_is_found_out() {
    let reference: Value = serde_json::from_str(REFERENCE).expect("valid JSON");
    for case in reference["lights"].as_array().expect("a list") {
        let mut light = reference_light(case);
        light.power *= 1.01;
        let deviation = deviation(case, &reference["points"], light);
        assert!(deviation > 0.005, "{}: {deviation}", case["name"]);
    }
}
