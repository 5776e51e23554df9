//! The world's importance map.

use super::*;
use crate::device::mapping::mapping_cone;
use std::f32::consts::PI;

/// A sky with a small sun, a bright horizon and a black nadir.
fn sky(d: Vec3) -> Vec3 {
    let sun = if d.dot(Vec3::new(0.6, 0.48, 0.64)) > 0.995 {
        300.0
    } else {
        0.0
    };
    let horizon = (1.0 - d.z.abs()).powi(3);
    let above = if d.z > -0.6 { 1.0 } else { 0.0 };
    Vec3::new(1.0, 0.8, 0.6) * (above * (0.2 + horizon) + sun)
}

fn grid(width: u32, height: u32, radiance: impl Fn(Vec3) -> Vec3) -> WorldGrid {
    let at = |i: u32| {
        grid_direction(
            (i % width) as f32 + 0.5,
            (i / width) as f32 + 0.5,
            width,
            height,
        )
    };
    WorldGrid {
        width,
        height,
        radiance: (0..width * height).map(|i| radiance(at(i))).collect(),
    }
}

fn map() -> WorldMap {
    WorldMap::new(&grid(64, 32, sky)).unwrap()
}

#[test]
fn directions_follow_blenders_environment() {
    assert!((grid_direction(32.0, 16.0, 64, 32) - Vec3::X).length() < 1e-6);
    assert!((grid_direction(16.0, 16.0, 64, 32) - Vec3::Y).length() < 1e-6);
    assert!((grid_direction(5.0, 0.0, 64, 32) - Vec3::Z).length() < 1e-6);
}

#[test]
fn density_integrates_to_one() {
    let map = map();
    let n = 1 << 18;
    let mean: f64 = (0..n)
        .map(|i| f64::from(map.pdf(mapping_cone(sample_2d(1, i, 0), 2.0))))
        .sum::<f64>()
        / f64::from(n);
    assert!((mean * 4.0 * std::f64::consts::PI - 1.0).abs() < 5e-3);
}

#[test]
fn samples_have_their_density() {
    let map = map();
    let mut different = 0;
    for i in 0..20_000 {
        let (d, pdf) = map.sample(sample_2d(3, i, 0));
        assert!((d.length() - 1.0).abs() < 1e-5);
        different += u32::from((map.pdf(d) / pdf - 1.0).abs() > 1e-3);
    }
    // Directions on a texel's edge may be rounded into its neighbour.
    assert!(different < 20, "{different}");
}

/// Counts of samples per texel against the density.
#[test]
fn samples_fall_where_the_density_is() {
    let map = map();
    let n = 1 << 18;
    let mut counts = vec![0.0f64; 64 * 32];
    for i in 0..n {
        let (d, _) = map.sample(sample_2d(3, i, 0));
        let x = ((0.5 - d.y.atan2(d.x) / (2.0 * PI)) * 64.0) as usize;
        let y = (d.z.clamp(-1.0, 1.0).acos() / PI * 32.0) as usize;
        counts[y.min(31) * 64 + x.min(63)] += 1.0;
    }
    let mut chi = 0.0;
    for (i, count) in counts.iter().enumerate() {
        let (x, y) = ((i % 64) as f32 + 0.5, (i / 64) as f32 + 0.5);
        let (top, bottom) = ((PI * (y - 0.5) / 32.0).cos(), (PI * (y + 0.5) / 32.0).cos());
        let solid_angle = (top - bottom) * 2.0 * PI / 64.0;
        let expected =
            f64::from(map.pdf(grid_direction(x, y, 64, 32)) * solid_angle) * f64::from(n);
        chi += (count - expected).powi(2) / expected.max(1.0);
    }
    // 2047 degrees of freedom: mean 2047, deviation 64; stratified samples do better.
    assert!(chi < 2047.0 + 5.0 * 64.0, "chi² {chi}");
}

/// The integral of the true radiance by samples of the map and by even directions.
#[test]
fn integrals_agree_with_uniform_sampling() {
    let map = map();
    let n = 1 << 18;
    let (mut by_map, mut even) = (0.0f64, 0.0f64);
    for i in 0..n {
        let (d, pdf) = map.sample(sample_2d(3, i, 0));
        by_map += f64::from(sky(d).x / pdf) / f64::from(n);
        let d = mapping_cone(sample_2d(4, i, 0), 2.0);
        even += f64::from(sky(d).x) * 4.0 * std::f64::consts::PI / f64::from(n);
    }
    assert!((by_map / even - 1.0).abs() < 0.01, "{by_map} {even}");
}

#[test]
fn harmonics_give_the_irradiance() {
    // A sky that order 2 represents: L = 1 + z, E(n) = π + 2π/3 n·z.
    let map = WorldMap::new(&grid(128, 64, |d| Vec3::splat(1.0 + d.z))).unwrap();
    for n in [Vec3::Z, Vec3::X, Vec3::NEG_Z, Vec3::new(0.6, 0.0, 0.8)] {
        let expected = (PI + 2.0 * PI / 3.0 * n.z).max(0.1 * PI);
        assert!((map.irradiance(n) / expected - 1.0).abs() < 5e-3, "{n}");
    }
}

#[test]
fn black_and_broken_grids_are_no_lights() {
    assert!(WorldMap::new(&grid(8, 4, |_| Vec3::ZERO)).is_none());
    assert!(WorldMap::new(&grid(8, 4, |_| Vec3::NAN)).is_none());
    assert!(
        WorldMap::new(&WorldGrid {
            width: 8,
            height: 4,
            radiance: vec![Vec3::ONE]
        })
        .is_none()
    );
    assert!(
        WorldMap::new(&WorldGrid {
            width: 0,
            height: 0,
            radiance: vec![]
        })
        .is_none()
    );
    let world = |radiance| LightSet::build(&scene(&[], vec![]), vec![], Some(even_world(radiance)));
    assert!(world(0.0).is_empty());
    assert!(!world(1.0).is_empty());
}

/// A point below many bright triangles and under a sun: every kind gets its share.
#[test]
fn shares_leave_room_for_everyone() {
    let sun = light(
        LightShape::Sun { angle: 0.01 },
        Affine3A::IDENTITY,
        Vec3::splat(5.0),
    );
    let triangles = vec![[
        Vec3::new(0.0, 0.0, 5.0),
        Vec3::new(0.1, 0.0, 5.0),
        Vec3::new(0.0, 0.1, 5.0),
    ]];
    let world = Some(grid(64, 32, sky));
    let lights = LightSet::build(
        &scene(&triangles, vec![sun]),
        emission(2.0, Sides::Both),
        world,
    );
    let (p, n) = (Vec3::ZERO, Vec3::Z);
    let (mut counts, mut different) = ([0u32; 3], 0);
    for i in 0..10_000 {
        let Some(s) = lights.sample(p, n, sample_1d(0, i, 0), sample_2d(0, i, 1)) else {
            continue;
        };
        counts[match s.light {
            LightId::Triangle(_) => 0,
            LightId::Analytic(_) => 1,
            LightId::World => 2,
        }] += 1;
        if s.light == LightId::World {
            different += u32::from((lights.pdf_world(p, n, s.wi) / s.pdf - 1.0).abs() > 1e-3);
        }
    }
    assert!(counts.iter().all(|&c| c > 1500), "{counts:?}");
    // Directions on a texel's edge may be rounded into its neighbour.
    assert!(different < 10, "{different}");
    // Nothing is spent on a sun below the horizon.
    let below = (0..1000)
        .filter_map(|i| lights.sample(p, Vec3::NEG_Z, sample_1d(0, i, 0), sample_2d(0, i, 1)));
    assert!(below.into_iter().all(|s| s.light == LightId::World));
}
