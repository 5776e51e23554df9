//! The light tree with many lights.

use super::*;
use crate::device::light_importance::LightBounds;
use crate::device::light_sample::light_sample_triangle;
use std::time::Instant;

/// Pseudo-random number in [0, 1) of a counter.
fn random(i: u32, salt: u32) -> f32 {
    sample_1d(salt, i, salt)
}

/// Small triangles scattered in a room.
fn confetti(n: u32) -> Vec<[Vec3; 3]> {
    let v = |i, s| Vec3::new(random(i, s), random(i, s + 1), random(i, s + 2));
    (0..n)
        .map(|i| {
            let at = v(i, 1) * Vec3::new(10.0, 6.0, 3.0);
            let size = 0.02 + 0.2 * random(i, 9);
            [
                at,
                at + (v(i, 20) - 0.5) * size,
                at + (v(i, 30) - 0.5) * size,
            ]
        })
        .collect()
}

fn places(n: u32) -> impl Iterator<Item = (Vec3, Vec3)> {
    (0..n).map(|i| {
        let p = Vec3::new(random(i, 41), random(i, 42), random(i, 43)) * Vec3::new(14.0, 8.0, 5.0)
            - Vec3::splat(1.0);
        let n = crate::device::mapping::mapping_cone(Vec2::new(random(i, 44), random(i, 45)), 2.0);
        (p, if i % 5 == 0 { Vec3::ZERO } else { n })
    })
}

#[test]
fn probabilities_of_all_emitters_sum_to_one() {
    for sides in [Sides::Both, Sides::Front] {
        let lights = LightSet::build(&scene(&confetti(500), vec![]), emission(1.0, sides), None);
        for (p, n) in places(40) {
            let sum: f32 = (0..500).map(|e| lights.tree.probability(e, p, n)).sum();
            // A descent may end where nothing can reach the point, never more than once.
            assert!(sum < 1.0 + 1e-4, "{sum}");
            let found = (0..2000).filter(|&i| {
                lights
                    .tree
                    .sample(p, n, (i as f32 + 0.5) / 2000.0)
                    .is_some()
            });
            let share = found.count() as f32 / 2000.0;
            assert!((sum - share).abs() < 5e-3, "{sum} {share}");
        }
    }
}

#[test]
fn sampled_probabilities_are_those_of_the_trail() {
    let lights = LightSet::build(
        &scene(&confetti(3000), vec![]),
        emission(1.0, Sides::Both),
        None,
    );
    let mut counts = vec![0u32; 3000];
    let (p, n) = (Vec3::new(3.0, 2.0, 1.0), Vec3::Z);
    let draws = 1 << 20;
    for i in 0..draws {
        let u = (i as f32 + 0.5) / draws as f32;
        if let Some((emitter, probability)) = lights.tree.sample(p, n, u) {
            counts[emitter as usize] += 1;
            if i % 64 == 0 {
                let again = lights.tree.probability(emitter, p, n);
                assert!((again / probability - 1.0).abs() < 1e-5);
            }
        }
    }
    for (emitter, &count) in counts.iter().enumerate() {
        let expected = f64::from(lights.tree.probability(emitter as u32, p, n)) * f64::from(draws);
        assert!(
            (f64::from(count) - expected).abs() < 4.0 + 0.02 * expected,
            "{emitter}: {count} {expected}"
        );
    }
}

/// No light that reaches a point may have probability zero there.
#[test]
fn every_light_that_reaches_a_point_can_be_sampled() {
    for sides in [Sides::Both, Sides::Front, Sides::Back] {
        let lights = LightSet::build(&scene(&confetti(800), vec![]), emission(1.0, sides), None);
        for (p, n) in places(60) {
            for (emitter, t) in lights.triangles().iter().enumerate() {
                for corner in [t.corners.a, t.corners.b, t.corners.c] {
                    let wi = (corner - p).normalize();
                    let margin = 1e-3;
                    let facing = match sides {
                        Sides::Both => true,
                        Sides::Front => t.normal().dot(wi) < -margin,
                        Sides::Back => t.normal().dot(wi) > margin,
                    };
                    if facing && (n == Vec3::ZERO || n.dot(wi) > margin) {
                        let probability = lights.tree.probability(emitter as u32, p, n);
                        assert!(probability > 0.0, "emitter {emitter} from {p}");
                    }
                }
            }
        }
    }
}

#[test]
fn the_estimate_with_a_tree_is_the_sum_over_triangles() {
    let triangles = confetti(300);
    let lights = LightSet::build(&scene(&triangles, vec![]), emission(2.0, Sides::Both), None);
    let (p, n) = (Vec3::new(4.0, 3.0, -0.5), Vec3::Z);
    let found = irradiance(&lights, p, n, 1 << 19).x;
    let expected: f32 = triangles
        .iter()
        .map(|t| LightSet::build(&scene(&[*t], vec![]), emission(2.0, Sides::Both), None))
        .map(|one| irradiance(&one, p, n, 1 << 10).x)
        .sum();
    assert!((found / expected - 1.0).abs() < 5e-3, "{found} {expected}");
}

/// Standard deviation of the estimate must be far below that of a uniform choice.
#[test]
fn the_tree_prefers_lights_that_matter() {
    let triangles = confetti(2000);
    let lights = LightSet::build(&scene(&triangles, vec![]), emission(2.0, Sides::Both), None);
    let (p, n) = (Vec3::new(2.0, 3.0, 0.1), Vec3::Z);
    let (mut tree, mut even) = ((0.0, 0.0), (0.0, 0.0));
    let draws = 1 << 14;
    for i in 0..draws {
        let u = sample_2d(4, i, 1);
        let select = sample_1d(4, i, 0);
        let value = |s: Option<LightSample>| {
            s.map_or(0.0, |s| {
                f64::from(constant(&s).x * s.wi.dot(n).max(0.0) / s.pdf)
            })
        };
        let a = value(lights.sample(p, n, select, u));
        let emitter = (select * 2000.0) as u32;
        let one = light_sample_triangle(lights.view(), emitter, p, u, 1.0 / 2000.0);
        let b = value(LightSample::new(&one));
        tree = (tree.0 + a, tree.1 + a * a);
        even = (even.0 + b, even.1 + b * b);
    }
    let variance =
        |(sum, squares): (f64, f64)| squares / f64::from(draws) - (sum / f64::from(draws)).powi(2);
    println!("variance: tree {}, even {}", variance(tree), variance(even));
    assert!(
        variance(tree) < 0.2 * variance(even),
        "{} {}",
        variance(tree),
        variance(even)
    );
}

/// Parents hold their children, cones included, and every emitter is in the tree once.
#[test]
fn bounds_hold_what_is_below() {
    let lights = LightSet::build(
        &scene(&confetti(700), vec![]),
        emission(1.0, Sides::Front),
        None,
    );
    let nodes = lights.tree.nodes();
    assert_eq!(size_of::<LightNode>(), 8 * 48);
    let holds = |a: &LightBounds, b: &LightBounds| {
        let angle = a.axis.dot(b.axis).clamp(-1.0, 1.0).acos() + b.cos_normals.acos();
        let inside = a.low.cmple(b.low).all() && a.high.cmpge(b.high).all();
        let cone = angle <= a.cos_normals.acos() + 2e-2 || a.cos_normals <= -0.999;
        inside && cone && a.power >= b.power * 0.999
    };
    let mut seen = vec![0; 700];
    for node in nodes {
        for slot in 0..8 {
            match node.link(slot) {
                Some(Link::Node(child)) => {
                    let child = &nodes[child as usize];
                    for below in (0..8).filter(|&s| child.link(s).is_some()) {
                        assert!(holds(&node.bounds(slot), &child.bounds(below)));
                    }
                }
                Some(Link::Emitter(emitter)) => seen[emitter as usize] += 1,
                None => {}
            }
        }
    }
    assert!(seen.iter().all(|&n| n == 1));
}

#[test]
fn degenerate_lights_do_no_harm() {
    // All in one place, without area, and not finite.
    let spot = [Vec3::ZERO, Vec3::X * 0.1, Vec3::Y * 0.1];
    let mut triangles = vec![spot; 300];
    triangles.push([Vec3::ONE; 3]);
    triangles.push([Vec3::NAN, Vec3::X, Vec3::Y]);
    triangles.push([Vec3::INFINITY, Vec3::X, Vec3::Y]);
    let lights = LightSet::build(&scene(&triangles, vec![]), emission(1.0, Sides::Both), None);
    assert_eq!(lights.triangles().len(), 300);
    assert_eq!(
        lights.pdf_triangle(0, 301, Vec3::Z, Vec3::NEG_Z, Vec3::NEG_Z, 1.0),
        0.0
    );
    assert_eq!(
        lights.pdf_triangle(7, 0, Vec3::Z, Vec3::NEG_Z, Vec3::NEG_Z, 1.0),
        0.0
    );
    for p in [
        Vec3::ZERO,
        Vec3::X * 0.1,
        Vec3::new(0.03, 0.03, 1e-7),
        Vec3::splat(f32::NAN),
    ] {
        for i in 0..64 {
            if let Some(s) = lights.sample(p, Vec3::Z, random(i, 1), sample_2d(0, i, 0)) {
                assert!(s.pdf.is_finite() && s.wi.is_finite(), "{s:?}");
            }
        }
    }
    let broken = light(
        LightShape::Area {
            size: Vec2::ZERO,
            ellipse: false,
            spread: 1.0,
        },
        Affine3A::IDENTITY,
        Vec3::ONE,
    );
    assert!(lamps(vec![broken]).is_empty());
    let dark = light(
        LightShape::Sun { angle: 0.0 },
        Affine3A::IDENTITY,
        Vec3::ZERO,
    );
    assert!(lamps(vec![dark]).is_empty());
    assert!(
        lamps(vec![])
            .sample(Vec3::ZERO, Vec3::Z, 0.5, Vec2::ZERO)
            .is_none()
    );
}

/// Time that this thread spent on a processor, seconds, where Linux tells it.
fn busy() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    text.split(' ')
        .next()
        .and_then(|t| t.parse::<f64>().ok())
        .unwrap_or(0.0)
        * 1e-9
}

/// Builds a large tree and reports times; run with `--ignored --nocapture` and `--release`.
#[test]
#[ignore = "a measurement"]
fn a_million_triangles() {
    let scene = scene(&confetti(1_000_000), vec![]);
    let start = Instant::now();
    let lights = LightSet::build(&scene, emission(1.0, Sides::Both), None);
    println!(
        "build: {:.2} s, {} MB",
        start.elapsed().as_secs_f64(),
        lights.bytes() / 1_000_000
    );
    let draws = 1_000_000;
    let start = busy();
    let mut sum = 0.0;
    for i in 0..draws {
        let (p, n) = (
            Vec3::new(random(i, 41) * 10.0, random(i, 42) * 6.0, 0.0),
            Vec3::Z,
        );
        let sample = lights.sample(p, n, random(i, 44), Vec2::new(random(i, 45), 0.3));
        sum += sample.map_or(0.0, |s| s.pdf.min(1.0));
    }
    println!(
        "sample: {:.0} ns ({sum})",
        (busy() - start) * 1e9 / f64::from(draws)
    );
    let start = busy();
    let mut sum = 0.0;
    for i in 0..draws {
        let (p, n) = (
            Vec3::new(random(i, 41) * 10.0, random(i, 42) * 6.0, 0.0),
            Vec3::Z,
        );
        sum += lights
            .pdf_triangle(0, (random(i, 44) * 1e6) as u32, p, n, Vec3::Z, 1.0)
            .min(1.0);
    }
    println!(
        "pdf: {:.0} ns ({sum})",
        (busy() - start) * 1e9 / f64::from(draws)
    );
}
