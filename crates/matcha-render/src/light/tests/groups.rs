//! The choice among analytic lights, instances and the world.

use super::*;
use crate::device::light_choice::{light_choose_group, light_group_probability, light_side};
use crate::device::light_view::{LIGHT_GROUP_IS_LIGHT, LIGHT_GROUP_WHAT, LIGHT_NONE};
use std::collections::HashMap;

fn at(x: f32, y: f32, z: f32, turn: f32) -> Affine3A {
    Affine3A::from_translation(Vec3::new(x, y, z)) * Affine3A::from_rotation_y(turn)
}

fn all_lights() -> Vec<Light> {
    let point = |radius| LightShape::Point {
        radius,
        soft_falloff: false,
    };
    let area = |x, y, spread| LightShape::Area {
        size: Vec2::new(x, y),
        ellipse: false,
        spread,
    };
    let spot = LightShape::Spot {
        radius: 0.1,
        angle: 1.2,
        blend: 0.3,
        soft_falloff: true,
    };
    let shapes = [
        (point(0.0), at(1.0, 0.0, 3.0, 0.0)),
        (point(0.4), at(-1.0, 2.0, 1.0, 0.0)),
        (area(0.7, 8.0, 3.2), at(4.0, -0.6, 2.6, 0.8)),
        (area(1.0, 1.0, 0.9), at(0.0, -3.0, 2.0, -0.4)),
        (spot, at(-3.0, 1.0, 3.0, 0.3)),
        (LightShape::Sun { angle: 0.01 }, at(0.0, 0.0, 0.0, 0.9)),
        (LightShape::Sun { angle: 0.4 }, at(0.0, 0.0, 0.0, -0.5)),
    ];
    shapes
        .into_iter()
        .map(|(shape, transform)| light(shape, transform, Vec3::new(30.0, 20.0, 10.0)))
        .collect()
}

/// All kinds of lights, and three instances of a mesh of two triangles.
fn everything() -> LightSet {
    let corners = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(1.0, 1.0, 0.0)];
    let square = [
        [corners[0], corners[1], corners[2]],
        [corners[1], corners[3], corners[2]],
    ];
    let mut scene = scene(&square, all_lights());
    for place in [at(5.0, 0.0, 1.0, 1.5), at(-4.0, 0.0, 2.0, 0.1)] {
        let mut next = scene.instances[0].clone();
        next.transform = place;
        scene.instances.push(next);
    }
    let world = Some(even_world(1.0));
    LightSet::build(&scene, emission(3.0, Sides::Both), world)
}

const PLACES: [(Vec3, Vec3); 5] = [
    (Vec3::new(0.3, 0.2, 0.0), Vec3::Z),
    (Vec3::new(3.5, -0.5, 2.0), Vec3::X),
    (Vec3::new(-1.0, 2.1, 1.1), Vec3::NEG_Y),
    (Vec3::new(-3.0, 1.0, 0.5), Vec3::new(0.6, 0.0, 0.8)),
    (Vec3::new(2.0, 2.0, 1.0), Vec3::ZERO),
];

#[test]
fn groups_are_drawn_with_their_probability() {
    let lights = everything();
    let view = lights.view();
    let mut slots: HashMap<u32, u32> = (0..view.lights.len())
        .map(|i| (LIGHT_GROUP_IS_LIGHT | i as u32, view.lights[i].slot))
        .collect();
    for (p, n) in PLACES {
        let mut counts: HashMap<u32, u32> = HashMap::new();
        let draws = 1 << 16;
        for i in 0..draws {
            let u = (i as f32 + 0.5) / draws as f32;
            let choice = light_choose_group(view, p, n, u);
            assert_ne!(choice.link, LIGHT_NONE);
            *counts.entry(choice.link).or_default() += 1;
            if let Some(&slot) = slots.get(&choice.link) {
                let again = light_group_probability(view, slot, p, n);
                assert!((again / choice.probability - 1.0).abs() < 1e-5);
            }
        }
        slots.insert(LIGHT_GROUP_WHAT, view.world_slot);
        for (&link, &slot) in &slots {
            let expected = light_group_probability(view, slot, p, n) * draws as f32;
            let count = counts.get(&link).copied().unwrap_or(0) as f32;
            assert!(
                (count - expected).abs() < 4.0 + 0.01 * expected,
                "{link:x} at {p}: {count} {expected}"
            );
        }
    }
}

/// No light that reaches a point may have probability zero there.
#[test]
fn every_analytic_light_that_reaches_a_point_can_be_chosen() {
    let lights = everything();
    let view = lights.view();
    for (i, alone) in all_lights().into_iter().enumerate() {
        let alone = lamps(vec![alone]);
        for k in 0..400 {
            let turn = |d| sample_1d(3, k, d) - 0.5;
            let p = Vec3::new(turn(0), turn(1), turn(2)) * Vec3::new(12.0, 12.0, 6.0);
            let n = Vec3::new(turn(3), turn(4), turn(5)).normalize();
            let reached = (0..16)
                .filter_map(|s| alone.sample(p, Vec3::ZERO, 0.5, sample_2d(5, s, 0)))
                .any(|s| s.wi.dot(n) > 1e-3);
            if reached {
                let slot = view.lights[i].slot;
                assert!(
                    light_group_probability(view, slot, p, n) > 0.0,
                    "{i} {p} {n}"
                );
            }
        }
    }
}

#[test]
fn a_side_is_chosen_by_the_most_and_the_least_it_brings() {
    let sides = |a: (f32, f32), b: (f32, f32)| {
        let p = light_side(a.0, a.1, b.0, b.1);
        let q = light_side(b.0, b.1, a.0, a.1);
        assert!((p + q - 1.0).abs() < 1e-6 || p + q == 0.0);
        p
    };
    assert_eq!(sides((3.0, 1.0), (1.0, 1.0)), 0.5 * (0.75 + 0.5));
    // What is sure to bring something has half the samples at least.
    assert_eq!(sides((1.0, 0.1), (1.0, 0.0)), 0.75);
    // Nobody is sure: half by the most, half alike.
    assert_eq!(sides((3.0, 0.0), (1.0, 0.0)), 0.5 * (0.75 + 0.5));
    assert_eq!(sides((3.0, 0.0), (0.0, 0.0)), 1.0);
    assert_eq!(sides((0.0, 0.0), (0.0, 0.0)), 0.0);
    assert_eq!(sides((f32::NAN, 0.0), (1.0, 0.0)), 0.0);
}
