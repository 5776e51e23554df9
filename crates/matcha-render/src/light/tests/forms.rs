//! Scenes with a closed form.

use super::*;
use std::f32::consts::{FRAC_PI_2, PI};

fn close(found: f32, expected: f32, tolerance: f32) {
    assert!(
        (found / expected - 1.0).abs() < tolerance,
        "{found} {expected}"
    );
}

/// Disc of radius r parallel to the receiver at height h above it: E = π L r² / (r² + h²).
#[test]
fn disc_overhead() {
    for (radius, height) in [(0.5f32, 1.0f32), (3.0, 0.4), (0.01, 2.0)] {
        let shape = LightShape::Area {
            size: Vec2::splat(2.0 * radius),
            ellipse: true,
            spread: PI,
        };
        let place = Affine3A::from_translation(Vec3::Z * height);
        let lights = lamps(vec![light(shape, place, Vec3::splat(7.0))]);
        let radiance = 7.0 / (PI * PI * radius * radius);
        let expected = PI * radiance * radius * radius / (radius * radius + height * height);
        close(
            irradiance(&lights, Vec3::ZERO, Vec3::Z, 1 << 16).x,
            expected,
            2e-3,
        );
    }
}

/// Rectangle a × b whose corner is above the point, parallel at height h (Howell, C-11).
fn corner_form(a: f32, b: f32, h: f32) -> f32 {
    let (x, y) = (a / h, b / h);
    let (p, q) = ((1.0 + x * x).sqrt(), (1.0 + y * y).sqrt());
    (x / p * (y / p).atan() + y / q * (x / q).atan()) / (2.0 * PI)
}

#[test]
fn rectangle_over_its_corner() {
    for (a, b, h) in [
        (1.0f32, 0.5, 0.7),
        (4.0, 0.1, 0.2),
        (0.02, 0.03, 1.0),
        (3.0, 3.0, 0.05),
    ] {
        let shape = LightShape::Area {
            size: Vec2::new(a, b),
            ellipse: false,
            spread: PI,
        };
        let place = Affine3A::from_translation(Vec3::new(0.5 * a, 0.5 * b, h));
        let lights = lamps(vec![light(shape, place, Vec3::splat(7.0))]);
        let expected = PI * 7.0 / (PI * a * b) * corner_form(a, b, h);
        close(
            irradiance(&lights, Vec3::ZERO, Vec3::Z, 1 << 16).x,
            expected,
            2e-3,
        );
    }
}

/// The same with two emissive triangles that shine to both sides, from above and below.
#[test]
fn quad_of_triangles() {
    let (a, b, h) = (1.0, 0.5, 0.7);
    let [p, q, r, s] = [(0.0, 0.0), (a, 0.0), (a, b), (0.0, b)].map(|(x, y)| Vec3::new(x, y, h));
    for (sides, below, above) in [
        (Sides::Both, 1.0, 1.0),
        (Sides::Front, 0.0, 1.0),
        (Sides::Back, 1.0, 0.0),
    ] {
        let lights = LightSet::build(
            &scene(&[[p, q, r], [p, r, s]], vec![]),
            emission(3.0, sides),
            None,
        );
        let expected = PI * 3.0 * corner_form(a, b, h);
        let low = irradiance(&lights, Vec3::ZERO, Vec3::Z, 1 << 16).x;
        let high = irradiance(&lights, Vec3::Z * (2.0 * h), Vec3::NEG_Z, 1 << 16).x;
        assert!(
            (low - below * expected).abs() < 2e-3 * expected,
            "{sides:?}: {low} {expected}"
        );
        assert!(
            (high - above * expected).abs() < 2e-3 * expected,
            "{sides:?}: {high} {expected}"
        );
    }
}

/// Sphere of radius r whose centre is at distance d, above the horizon: E = π L (r/d)² cos θ.
#[test]
fn sphere_above_the_horizon() {
    for (radius, at) in [
        (0.5, Vec3::new(0.3, 0.4, 2.0)),
        (0.9, Vec3::Z),
        (0.001, Vec3::new(1.0, 0.0, 1.0)),
    ] {
        let shape = LightShape::Point {
            radius,
            soft_falloff: false,
        };
        let lights = lamps(vec![light(
            shape,
            Affine3A::from_translation(at),
            Vec3::splat(7.0),
        )]);
        let radiance = 7.0 / (4.0 * PI * PI * radius * radius);
        let d = at.length();
        let expected = PI * radiance * (radius / d).powi(2) * at.z / d;
        close(
            irradiance(&lights, Vec3::ZERO, Vec3::Z, 1 << 16).x,
            expected,
            2e-3,
        );
    }
}

#[test]
fn sun_overhead_brings_its_strength() {
    for angle in [0.0, 0.01, 1.0] {
        let lights = lamps(vec![light(
            LightShape::Sun { angle },
            Affine3A::IDENTITY,
            Vec3::splat(4.0),
        )]);
        close(
            irradiance(&lights, Vec3::ZERO, Vec3::Z, 1 << 14).x,
            4.0,
            1e-3,
        );
        let below = irradiance(&lights, Vec3::ZERO, Vec3::NEG_Z, 1 << 10).x;
        assert_eq!(below, 0.0);
    }
}

/// A world that is the same everywhere: E = π L.
#[test]
fn even_worlds() {
    let lights = LightSet::build(&scene(&[], vec![]), vec![], Some(even_world(2.0)));
    close(
        irradiance_under(2.0, &lights, Vec3::ZERO, Vec3::Z, 1 << 14).x,
        2.0 * PI,
        1e-3,
    );
}

/// Everything at once is the sum of the parts.
#[test]
fn light_adds_up() {
    let p = Vec3::new(0.1, 0.2, 0.0);
    let triangles = [[
        Vec3::new(1.0, 0.0, 1.0),
        Vec3::new(1.0, 1.0, 1.5),
        Vec3::new(1.5, 0.0, 2.0),
    ]];
    let mut lamp_list = vec![light(
        LightShape::Sun { angle: 0.1 },
        Affine3A::IDENTITY,
        Vec3::splat(1.5),
    )];
    for i in 0..10 {
        let at = Vec3::new(
            i as f32 - 4.0,
            (i * i % 7) as f32 - 3.0,
            1.0 + 0.2 * i as f32,
        );
        let radius = 0.05 * (i % 3) as f32;
        lamp_list.push(light(
            LightShape::Point {
                radius,
                soft_falloff: i % 2 == 0,
            },
            Affine3A::from_translation(at),
            Vec3::splat(20.0),
        ));
    }
    let shape = LightShape::Area {
        size: Vec2::ONE,
        ellipse: false,
        spread: FRAC_PI_2,
    };
    lamp_list.push(light(
        shape,
        Affine3A::from_translation(Vec3::new(0.0, 0.5, 2.0)),
        Vec3::splat(30.0),
    ));
    let world = || Some(even_world(0.3));
    let all = LightSet::build(
        &scene(&triangles, lamp_list.clone()),
        emission(3.0, Sides::Both),
        world(),
    );
    let mut sum = irradiance_under(
        0.3,
        &LightSet::build(&scene(&[], vec![]), vec![], world()),
        p,
        Vec3::Z,
        1 << 14,
    )
    .x;
    let only_triangles =
        LightSet::build(&scene(&triangles, vec![]), emission(3.0, Sides::Both), None);
    sum += irradiance(&only_triangles, p, Vec3::Z, 1 << 14).x;
    for lamp in lamp_list {
        sum += irradiance(&lamps(vec![lamp]), p, Vec3::Z, 1 << 14).x;
    }
    close(
        irradiance_under(0.3, &all, p, Vec3::Z, 1 << 18).x,
        sum,
        5e-3,
    );
}
