//! Comparison with Cycles: `blender/tests/closure_reference.py` measured squares under suns
//! and a white world; the same closures here must give the same numbers.

use super::fixtures::{lobes, rows};
use super::tests::albedo;
use super::{Frame, LobeSet};
use glam::Vec3;
use matcha_shade::closure::{ClosureKind, Distribution, SheenModel};
use serde_json::Value;

const REFERENCE: &str = include_str!("reference.json");

fn kind(square: &Value) -> ClosureKind {
    let distribution = || match square["distribution"].as_str() {
        Some("GGX") => Distribution::Ggx,
        Some("MULTI_GGX") => Distribution::MultiGgx,
        Some("BECKMANN") => Distribution::Beckmann,
        Some("ASHIKHMIN_SHIRLEY") => Distribution::AshikhminShirley,
        other => panic!("distribution {other:?}"),
    };
    match square["kind"].as_str().unwrap() {
        "Diffuse" => ClosureKind::Diffuse,
        "Translucent" => ClosureKind::Translucent,
        "Glossy" => ClosureKind::Glossy(distribution()),
        "Glass" => ClosureKind::Glass(distribution()),
        "Refraction" => ClosureKind::Refraction(distribution()),
        "Sheen" if square["distribution"] == "ASHIKHMIN" => {
            ClosureKind::Sheen(SheenModel::Ashikhmin)
        }
        "Sheen" => ClosureKind::Sheen(SheenModel::Microfiber),
        "Principled" => ClosureKind::Principled(distribution()),
        other => panic!("kind {other}"),
    }
}

/// Numbers of an input: one, or the first three of a colour.
fn numbers(value: &Value) -> Vec<f32> {
    match value.as_array() {
        Some(list) => list
            .iter()
            .take(3)
            .map(|v| v.as_f64().unwrap() as f32)
            .collect(),
        None => vec![value.as_f64().unwrap() as f32],
    }
}

fn color(value: &Value) -> Vec3 {
    Vec3::from_slice(&numbers(value))
}

fn normal(square: &Value) -> Vec3 {
    let cosine = square["cosine"].as_f64().unwrap() as f32;
    Vec3::new((1.0 - cosine * cosine).sqrt(), 0.0, cosine)
}

/// The square's geometry and lobes.
fn square_lobes(square: &Value) -> LobeSet {
    let n = normal(square);
    let frame = Frame {
        n,
        ng: n,
        wo: Vec3::Z,
        backfacing: false,
        bump_correction: true,
    };
    let kind = kind(square);
    let principled = matches!(kind, ClosureKind::Principled(_));
    let mut named: Vec<(String, Vec<f32>)> = Vec::new();
    if square["inputs"]["Normal"].is_null() {
        named.push(("normal".into(), n.to_array().to_vec()));
    }
    if principled {
        named.push(("coat_normal".into(), n.to_array().to_vec()));
    }
    let mut weight = Vec3::ONE;
    for (input, value) in square["inputs"].as_object().unwrap() {
        let name = input.to_lowercase().replace(' ', "_");
        if name == "color" {
            weight = color(value);
            if kind.carries_color() {
                named.push((name, weight.to_array().to_vec()));
            }
        } else {
            named.push((name, numbers(value)));
        }
    }
    if kind.parameters().iter().any(|p| p.name == "tangent") {
        named.push(("tangent".into(), vec![n.z, 0.0, -n.x]));
    }
    let given: Vec<(&str, &[f32])> = named
        .iter()
        .map(|(n, v)| (n.as_str(), v.as_slice()))
        .collect();
    lobes(kind, &rows(kind, weight, &given), &frame)
}

fn describe(square: &Value) -> String {
    format!(
        "{} {} {} cosine {}",
        square["kind"], square["distribution"], square["inputs"], square["cosine"]
    )
}

fn squares() -> (Vec<Vec3>, Vec<Value>) {
    let document: Value = serde_json::from_str(REFERENCE).unwrap();
    let suns = document["suns"]
        .as_array()
        .unwrap()
        .iter()
        .map(color)
        .collect();
    (suns, document["squares"].as_array().unwrap().clone())
}

fn transmits(square: &Value) -> bool {
    let weight = square["inputs"]["Transmission Weight"]
        .as_f64()
        .unwrap_or(0.0);
    weight > 0.0 || square["kind"] == "Glass" || square["kind"] == "Refraction"
}

/// Whether no microfacet that can be seen refracts +Z to the direction `wi` behind the
/// square.
fn no_microfacet_refracts(square: &Value, wi: Vec3) -> bool {
    let n = normal(square);
    let ior = square["inputs"]["IOR"].as_f64().unwrap_or(1.5) as f32;
    let sum = wi * ior + Vec3::Z;
    let h = sum * sum.z.signum();
    wi.dot(n) < 0.0 && (h.dot(wi) >= 0.0 || h.dot(n) <= 0.0)
}

#[test]
fn light_of_suns_is_what_cycles_scatters() {
    let (suns, squares) = squares();
    let mut wrong = Vec::new();
    for square in &squares {
        let set = square_lobes(square);
        let emission = color(&square["emission"]);
        for (i, sun) in suns.iter().enumerate() {
            let theirs = color(&square["lit"][i]) - emission;
            let ours = set.eval(*sun).value;
            if transmits(square) && no_microfacet_refracts(square, *sun) {
                // Cycles evaluates its formula there all the same, but never samples it.
                assert_eq!(ours, Vec3::ZERO, "{}", describe(square));
                continue;
            }
            let error = (ours - theirs).abs().max_element();
            if error > 5.0e-3 * theirs.max_element() + 2.0e-4 {
                wrong.push(format!("{} sun {i}: {ours} not {theirs}", describe(square)));
            }
        }
    }
    assert!(
        wrong.is_empty(),
        "{} differ:\n{}",
        wrong.len(),
        wrong.join("\n")
    );
}

#[test]
fn albedos_are_those_of_cycles() {
    let mut wrong = Vec::new();
    for square in &squares().1 {
        let set = square_lobes(square);
        let theirs = color(&square["albedo"]) - color(&square["emission"]);
        let ours = albedo(&set, 40_000);
        let error = (ours - theirs).abs().max_element();
        // Cycles samples a rough Ashikhmin–Shirley lobe wrongly at grazing angles, where half
        // vectors face away: its white world is brighter than its own values integrate to.
        let missampled = square["distribution"] == "ASHIKHMIN_SHIRLEY" && normal(square).z < 0.5;
        if error > 0.01 * theirs.max_element() + 3.0e-5 && !missampled {
            wrong.push(format!("{}: {ours} not {theirs}", describe(square)));
        }
    }
    assert!(
        wrong.is_empty(),
        "{} differ:\n{}",
        wrong.len(),
        wrong.join("\n")
    );
}

#[test]
fn emission_is_that_of_cycles() {
    for square in &squares().1 {
        let difference = square_lobes(square).emission - color(&square["emission"]);
        assert!(
            difference.abs().max_element() < 2.0e-3,
            "{}: {difference}",
            describe(square)
        );
    }
}
