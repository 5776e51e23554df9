//! Nanoseconds to prepare, evaluate and sample closures: the fastest of several passes, so
//! that a busy machine counts little.

use glam::Vec3;
use matcha_render::closure::{ClosureContext, Frame, LobeSet, prepare_closure};
use matcha_shade::closure::{ClosureKind, Distribution, SheenModel};
use std::hint::black_box;
use std::time::Instant;

const HITS: usize = 10_000;
const PASSES: usize = 30;

/// Numbers of a closure in the order of its parameters; those not named are plain.
fn rows(kind: ClosureKind, named: &[(&str, f32)]) -> Vec<f32> {
    let mut out = vec![0.8; 3];
    for parameter in kind.parameters() {
        let plain = match parameter.name {
            "normal" | "coat_normal" => [0.0, 0.0, 1.0],
            "tangent" => [1.0, 0.0, 0.0],
            "ior" | "coat_ior" => [1.5; 3],
            "roughness" | "specular_ior_level" | "sheen_roughness" => [0.4; 3],
            "base_color" | "alpha" | "specular_tint" | "coat_tint" | "sheen_tint" => [1.0; 3],
            _ => [0.0; 3],
        };
        let value = named
            .iter()
            .find(|n| n.0 == parameter.name)
            .map_or(plain, |n| [n.1; 3]);
        out.extend_from_slice(&value[..parameter.ty.width()]);
    }
    out
}

/// Frames and numbers that vary from hit to hit.
fn hit(i: usize) -> (Frame, Vec3) {
    let u = |k: f32| (i as f32 * k).fract();
    let z = 0.1 + 0.85 * u(0.618_034);
    let phi = std::f32::consts::TAU * u(0.754_878);
    let r = (1.0 - z * z).sqrt();
    let wo = Vec3::new(r * phi.cos(), r * phi.sin(), z);
    let frame = Frame {
        n: Vec3::Z,
        ng: Vec3::Z,
        wo,
        backfacing: false,
        bump_correction: true,
    };
    (frame, Vec3::new(u(0.819_173), u(0.671_044), u(0.549_7)))
}

fn measure(name: &str, kind: ClosureKind, named: &[(&str, f32)]) {
    let rows = rows(kind, named);
    let hits: Vec<_> = (0..HITS).map(hit).collect();
    let context = ClosureContext::default();
    let mut set = LobeSet::new();
    let mut lobes = 0;
    let mut pass = |what: u32| {
        let start = Instant::now();
        for (frame, u) in &hits {
            set.begin(frame);
            prepare_closure(kind, &rows, &context, &mut set);
            if what == 1 {
                black_box(set.eval(Vec3::new(u.x * 0.5, u.y * 0.5, 0.7).normalize()));
            } else if what == 2 {
                black_box(set.sample(*u));
            }
            lobes = black_box(set.lobes().len());
        }
        start.elapsed().as_secs_f64() * 1e9 / HITS as f64
    };
    let mut fastest = |what| {
        (0..PASSES)
            .map(|_| pass(what))
            .fold(f64::INFINITY, f64::min)
    };
    let [prepare, eval, sample] = [fastest(0), fastest(1), fastest(2)];
    println!(
        "{name:32} {lobes} lobes  prepare {prepare:6.1}  eval {:6.1}  sample {:6.1} ns",
        eval - prepare,
        sample - prepare
    );
}

fn main() {
    use ClosureKind::{Diffuse, Glass, Glossy, Principled, Sheen};
    let multi = Distribution::MultiGgx;
    measure("diffuse", Diffuse, &[("roughness", 0.0)]);
    measure("diffuse, Oren-Nayar", Diffuse, &[("roughness", 0.5)]);
    measure("glossy GGX", Glossy(Distribution::Ggx), &[]);
    measure("glossy GGX, multiple", Glossy(multi), &[]);
    measure("glossy Beckmann", Glossy(Distribution::Beckmann), &[]);
    measure(
        "glossy Ashikhmin-Shirley",
        Glossy(Distribution::AshikhminShirley),
        &[],
    );
    measure("glass GGX, multiple", Glass(multi), &[]);
    measure("glass Beckmann", Glass(Distribution::Beckmann), &[]);
    measure("sheen, microfibre", Sheen(SheenModel::Microfiber), &[]);
    measure("principled", Principled(multi), &[]);
    measure("principled, metal", Principled(multi), &[("metallic", 1.0)]);
    measure(
        "principled, coat and sheen",
        Principled(multi),
        &[("coat_weight", 1.0), ("sheen_weight", 0.2)],
    );
}
