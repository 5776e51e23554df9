//! Samples and densities agree: every density integrates to one over the directions that
//! meet the light, and samples fall where the density says.

use super::*;
use crate::device::light_analytic::light_direction_pdf;
use crate::device::light_triangle::{LightTriangle, light_triangle_pdf, light_triangle_sample};
use glam::{EulerRot, Quat};

fn tilted(height: f32) -> Affine3A {
    Affine3A::from_rotation_translation(
        Quat::from_euler(EulerRot::XYZ, 0.5, -0.3, 0.4),
        Vec3::new(0.4, -0.3, height),
    )
}

fn shapes() -> Vec<(&'static str, LightShape)> {
    let area = |ellipse, spread| LightShape::Area {
        size: Vec2::new(1.4, 0.6),
        ellipse,
        spread,
    };
    let pi = std::f32::consts::PI;
    let spot = |radius, angle, soft_falloff| LightShape::Spot {
        radius,
        angle,
        blend: 0.5,
        soft_falloff,
    };
    vec![
        (
            "sphere",
            LightShape::Point {
                radius: 0.5,
                soft_falloff: false,
            },
        ),
        (
            "disc",
            LightShape::Point {
                radius: 0.5,
                soft_falloff: true,
            },
        ),
        ("spot", spot(0.4, 1.2, false)),
        ("spot beam", spot(0.9, 0.5, false)),
        ("spot disc", spot(0.4, 1.2, true)),
        ("sun", LightShape::Sun { angle: 0.7 }),
        ("rectangle", area(false, pi)),
        ("ellipse", area(true, pi)),
        ("rectangle spread", area(false, 1.5)),
        ("ellipse spread", area(true, 1.2)),
    ]
}

const POINTS: [Vec3; 3] = [
    Vec3::ZERO,
    Vec3::new(0.9, -0.4, 0.2),
    Vec3::new(0.4, -0.3, 0.95),
];

/// Direction number `i` of a sequence over the sphere, density 1 / 4π.
fn even_direction(i: u32) -> Vec3 {
    crate::device::mapping::mapping_cone(sample_2d(11, i, 3), 2.0)
}

/// Radiance over the sphere by even directions, and by samples of the light: equal, if the
/// density is right.
#[test]
fn sampling_the_light_and_the_sphere_give_the_same_light() {
    for (name, shape) in shapes() {
        let lights = lamps(vec![light(shape, tilted(1.6), Vec3::splat(10.0))]);
        for p in POINTS {
            let n = 1 << 17;
            let (mut by_light, mut by_sphere) = (0.0f64, 0.0f64);
            for i in 0..n {
                if let Some(s) = lights.sample(p, Vec3::ZERO, 0.5, sample_2d(5, i, 0)) {
                    by_light += f64::from(constant(&s).x / s.pdf);
                }
                by_sphere +=
                    f64::from(seen(&lights, p, even_direction(i))) * 4.0 * std::f64::consts::PI;
            }
            let (a, b) = (by_light / f64::from(n), by_sphere / f64::from(n));
            assert!((a - b).abs() < 0.015 * b.max(0.1), "{name} at {p}: {a} {b}");
        }
    }
}

/// Radiance that a ray sees, by intersection.
fn seen(lights: &LightSet, p: Vec3, wi: Vec3) -> f32 {
    let sun: f32 = lights
        .escaped(p, Vec3::ZERO, wi, RayKind::Diffuse)
        .map(|h| radiance(&h))
        .sum();
    let met = lights.intersect(p, wi, 0.0, 1e9, RayKind::Diffuse);
    let met = met.and_then(|(index, t)| lights.hit(index, p, Vec3::ZERO, wi, t));
    sun + met.map_or(0.0, |h| radiance(&h))
}

fn radiance(hit: &LightHit) -> f32 {
    match hit.radiance {
        Emission::Constant(c) => c.x,
        other => panic!("{other:?}"),
    }
}

/// The density of a sampled direction, asked for again as a BSDF sample would.
#[test]
fn hits_have_the_density_of_samples() {
    for (name, shape) in shapes() {
        let lights = lamps(vec![light(shape, tilted(1.6), Vec3::splat(10.0))]);
        let (mut same, mut all) = (0, 0);
        for p in POINTS {
            for i in 0..2000 {
                let Some(s) = lights.sample(p, Vec3::Z, 0.3, sample_2d(2, i, 0)) else {
                    continue;
                };
                all += 1;
                let hit = if s.distance.is_finite() {
                    let Some((index, t)) = lights.intersect(p, s.wi, 0.0, 1e9, RayKind::Glossy)
                    else {
                        continue;
                    };
                    assert!(
                        (t / s.distance - 1.0).abs() < 1e-3,
                        "{name}: {t} {}",
                        s.distance
                    );
                    lights.hit(index, p, Vec3::Z, s.wi, t)
                } else {
                    lights.escaped(p, Vec3::Z, s.wi, RayKind::Glossy).next()
                };
                let Some(hit) = hit else { continue };
                assert!(
                    (hit.pdf / s.pdf - 1.0).abs() < 2e-3,
                    "{name}: {} {}",
                    hit.pdf,
                    s.pdf
                );
                same += 1;
            }
        }
        // Samples on the very rim may miss by rounding.
        assert!(
            all > 1000 && same as f32 > 0.99 * all as f32,
            "{name}: {same} of {all}"
        );
    }
}

/// Chi² of sampled directions against the density, over a grid of the sphere.
#[test]
fn samples_fall_where_the_density_is() {
    for (name, shape) in shapes() {
        let lights = lamps(vec![light(shape, tilted(1.6), Vec3::splat(10.0))]);
        let shape = lights.analytic()[0].shape;
        for p in POINTS {
            let bins = 32;
            let cell = |d: Vec3| {
                let x = (d.y.atan2(d.x) / std::f32::consts::TAU + 0.5) * bins as f32;
                let y = (0.5 - 0.5 * d.z) * bins as f32;
                (y as usize).min(bins - 1) * bins + (x as usize).min(bins - 1)
            };
            let (n, fine) = (1 << 17, 1 << 19);
            let (mut counts, mut expected) = (vec![0.0; bins * bins], vec![0.0; bins * bins]);
            let mut found = 0.0;
            for i in 0..n {
                if let Some(s) = lights.sample(p, Vec3::ZERO, 0.3, sample_2d(2, i, 0)) {
                    counts[cell(s.wi)] += 1.0;
                    found += 1.0;
                }
            }
            for i in 0..fine {
                let d = even_direction(i);
                if seen(&lights, p, d) > 0.0 {
                    let t = crate::device::light_analytic::light_distance(&shape, p, d);
                    let pdf = light_direction_pdf(&shape, p, Vec3::ZERO, d, t);
                    expected[cell(d)] +=
                        f64::from(pdf) * 4.0 * std::f64::consts::PI / f64::from(fine);
                }
            }
            for (i, (&count, &share)) in counts.iter().zip(&expected).enumerate() {
                // Both are stratified, so differences stay far below the binomial's deviation.
                let difference: f64 = count / f64::from(n) - share;
                let limit = 0.004 + 0.03 * share;
                assert!(
                    difference.abs() < limit,
                    "{name} at {p}, cell {i}: {count} {share}"
                );
            }
            let total: f64 = expected.iter().sum();
            assert!(
                (total - found / f64::from(n)).abs() < 0.015,
                "{name}: {total} {found}"
            );
        }
    }
}

/// Inside of a sphere every direction meets it.
#[test]
fn spheres_shine_inside() {
    let ball = LightShape::Point {
        radius: 2.0,
        soft_falloff: false,
    };
    let lights = lamps(vec![light(ball, tilted(0.5), Vec3::splat(10.0))]);
    let expected = std::f32::consts::PI * lights.analytic()[0].shape.radiance.x;
    let found = irradiance(&lights, Vec3::ZERO, Vec3::Z, 1 << 14).x;
    assert!((found / expected - 1.0).abs() < 1e-3, "{found} {expected}");
    let hit = lights.intersect(Vec3::ZERO, Vec3::Z, 0.0, 1e9, RayKind::Camera);
    assert!(hit.is_some_and(|(_, t)| t > 2.0));
}

fn triangle() -> LightTriangle {
    LightTriangle {
        a: Vec3::new(-0.5, -0.4, 1.0),
        b: Vec3::new(0.9, -0.1, 1.3),
        c: Vec3::new(0.1, 0.8, 0.7),
    }
}

/// Mean of a function over the triangle's samples and over its area must agree.
#[test]
fn triangle_samples_have_their_density() {
    let triangle = triangle();
    let normal = (triangle.b - triangle.a).cross(triangle.c - triangle.a);
    let area = 0.5 * normal.length();
    for p in [
        Vec3::ZERO,
        Vec3::new(0.2, 0.1, 0.9),
        Vec3::new(5.0, -3.0, 0.0),
        Vec3::new(60.0, 2.0, 40.0),
    ] {
        let n = 1 << 16;
        let (mut by_sample, mut by_area) = (0.0f64, 0.0f64);
        // Something that is not symmetric.
        let value = |uv: Vec2| 1.0 + 3.0 * uv.x * uv.x + uv.y;
        let at = |uv: Vec2| {
            triangle.a + (triangle.b - triangle.a) * uv.x + (triangle.c - triangle.a) * uv.y
        };
        for i in 0..n {
            let u = sample_2d(1, i, 0);
            let s = light_triangle_sample(triangle, p, u);
            assert!(s.uv.min_element() >= 0.0 && s.uv.x + s.uv.y <= 1.0 + 1e-5);
            let to = at(s.uv) - p;
            let again = light_triangle_pdf(triangle, p, to.normalize(), to.length());
            assert!((again / s.pdf - 1.0).abs() < 1e-3);
            by_sample += f64::from(value(s.uv) / s.pdf);
            let r = u.x.sqrt();
            let uv = Vec2::new(1.0 - r, u.y * r);
            let to = at(uv) - p;
            let d2 = to.length_squared();
            let cosine = normal.normalize().dot(to).abs() / d2.sqrt();
            by_area += f64::from(value(uv) * area * cosine / d2);
        }
        let ratio = by_sample / by_area;
        assert!((ratio - 1.0).abs() < 5e-3, "{p}: {ratio}");
    }
}

#[test]
fn a_wrong_density_is_found_out() {
    let lights = lamps(vec![light(
        LightShape::Point {
            radius: 0.5,
            soft_falloff: false,
        },
        tilted(1.6),
        Vec3::splat(10.0),
    )]);
    let n = 1 << 14;
    let (mut right, mut wrong) = (0.0, 0.0);
    for i in 0..n {
        let s = lights
            .sample(Vec3::ZERO, Vec3::ZERO, 0.5, sample_2d(5, i, 0))
            .unwrap();
        right += constant(&s).x / s.pdf / n as f32;
        wrong += constant(&s).x / (s.pdf * 1.03) / n as f32;
    }
    let shape = lights.analytic()[0].shape;
    let d2 = shape.center.length_squared();
    let cap = std::f32::consts::TAU * (1.0 - (1.0 - 0.25 / d2).sqrt());
    let expected = shape.radiance.x * cap;
    assert!((right / expected - 1.0).abs() < 2e-3);
    assert!((wrong / expected - 1.0).abs() > 2e-2);
}
