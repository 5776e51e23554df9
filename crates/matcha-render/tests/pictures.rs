//! Whole pictures of scenes whose radiance is known in closed form.

mod scenes;

use glam::{Affine3A, Vec3};
use matcha_render::backend::{Backend, CacheMode, Control, CpuSchedule, RenderOptions};
use matcha_render::cpu::CpuBackend;
use matcha_render::prepare::Prepared;
use matcha_render::scene::{Light, LightShape, Scene, Sides, Visibility};
use matcha_shade::vm::Isa;
use scenes::*;
use std::sync::Arc;

fn render(scene: Scene, options: &RenderOptions) -> Vec<[f32; 4]> {
    let samples = scene.settings.samples;
    let prepared = Arc::new(Prepared::new(scene, options.resolution).expect("prepares"));
    let mut backend = CpuBackend::new(prepared, options).expect("starts");
    backend
        .render(0..samples, &Control::default())
        .expect("renders");
    backend.film().combined()
}

fn mean(picture: &[[f32; 4]]) -> f32 {
    let sum: f32 = picture.iter().map(|p| p[0] + p[1] + p[2]).sum();
    sum / (3 * picture.len()) as f32
}

/// A surface that reflects everything in a world that is 1 everywhere is 1 everywhere.
#[test]
fn a_white_floor_in_a_white_world_cannot_be_seen() {
    let mut scene = empty(5.0);
    scene.world.color = Vec3::ONE;
    let white = add_material(&mut scene, diffuse([1.0; 3]));
    add_square(&mut scene, Vec3::ZERO, 0.5, false, white);
    let picture = render(scene, &RenderOptions::default());
    assert!((mean(&picture) - 1.0).abs() < 2e-3, "{}", mean(&picture));
}

/// An emitter that fills the view is its own radiance.
#[test]
fn a_lamp_that_is_looked_at_has_its_radiance() {
    let mut scene = empty(0.5);
    let lamp = add_material(&mut scene, emission(3.0));
    add_square(&mut scene, Vec3::ZERO, 100.0, false, lamp);
    let picture = render(scene, &RenderOptions::default());
    assert!((mean(&picture) - 3.0).abs() < 1e-3, "{}", mean(&picture));
}

/// Irradiance of a small patch under a parallel square emitter (a classical form factor,
/// Howell's catalogue, configuration B-4): the floor's radiance below its centre.
#[test]
fn a_square_lamp_lights_the_floor_by_its_form_factor() {
    let (half, height, radiance) = (0.5f32, 1.0f32, 4.0f32);
    let mut scene = empty(0.9);
    let floor = add_material(&mut scene, diffuse([0.5; 3]));
    let lamp = add_material(&mut scene, emission(radiance));
    add_square(&mut scene, Vec3::ZERO, 50.0, false, floor);
    add_square(&mut scene, Vec3::Z * height, half, true, lamp);
    // Look at a tiny part of the floor, and stop after direct light: the lamp is black
    // for reflected light anyway.
    scene.settings.resolution = [8, 8];
    scene.settings.samples = 1024;
    if let matcha_render::scene::Projection::Perspective { tan_half_width, .. } =
        &mut scene.camera.projection
    {
        *tan_half_width = 0.002;
    }
    let x = half / height;
    let corner = 2.0 / (2.0 * std::f32::consts::PI)
        * (x / (1.0 + x * x).sqrt() * (x / (1.0 + x * x).sqrt()).atan());
    let expected = 0.5 * radiance * 4.0 * corner;
    let got = mean(&render(scene, &RenderOptions::default()));
    assert!(
        (got / expected - 1.0).abs() < 5e-3,
        "{got} instead of {expected}"
    );
}

/// A sun that is looked at adds its radiance to the world's; with a node tree that gives 1 where
/// light is asked for, the same.
#[test]
fn a_suns_node_tree_is_evaluated_beside_the_world() {
    let with_tree = |tree: bool| {
        let mut scene = empty(2.0);
        scene.world.color = Vec3::new(0.2, 0.3, 0.5);
        let far = ["Is Shadow Ray", "VALUE"];
        let (shader, output) = ("ShaderNodeEmission", "ShaderNodeOutputLight");
        let emits = driven(shader, output, 1, "ShaderNodeLightPath", far);
        scene.trees.push(emits);
        let color = Vec3::new(0.9, 0.6, 0.3);
        scene.lights.push(Light {
            transform: Affine3A::from_rotation_x(std::f32::consts::PI),
            shape: LightShape::Sun { angle: 1.0 },
            power: if tree { Vec3::ONE } else { color },
            tree: tree.then_some(0),
            ..Light::default()
        });
        scene.settings.samples = 4;
        render(scene, &RenderOptions::default())
    };
    let (plain, evaluated) = (with_tree(false), with_tree(true));
    let brightest = plain.iter().fold(0.0f32, |most, p| most.max(p[0]));
    assert!(brightest > 0.5, "the sun is seen: {brightest}");
    for (a, b) in plain.iter().zip(&evaluated) {
        let apart = (0..3).map(|c| (a[c] - b[c]).abs());
        assert!(apart.fold(0.0f32, f32::max) < 1e-4, "{a:?} {b:?}");
    }
}

/// Mean of a grey floor (0.5) under a sharp sun from above, in a world of one radiance.
fn floor_under(sun: Light, world: f32) -> f32 {
    let mut scene = empty(0.9);
    scene.world.color = Vec3::splat(world);
    let floor = add_material(&mut scene, diffuse([0.5; 3]));
    add_square(&mut scene, Vec3::ZERO, 50.0, false, floor);
    scene.lights.push(Light {
        shape: LightShape::Sun { angle: 0.0 },
        ..sun
    });
    mean(&render(scene, &RenderOptions::default()))
}

/// Artists darken corners with lights of negative power.
#[test]
fn a_negative_light_takes_light_away() {
    let sun = |power: f32| Light {
        power: Vec3::splat(power * std::f32::consts::PI),
        ..Light::default()
    };
    let [more, less] = [0.2, -0.2].map(|power| floor_under(sun(power), 1.0));
    assert!((more - 0.6).abs() < 2e-3, "{more}");
    assert!((less - 0.4).abs() < 2e-3, "{less}");
}

/// What diffuse rays do not see lights no diffuse closure; other kinds of rays do not matter to it.
#[test]
fn a_light_lights_the_closures_whose_rays_see_it() {
    let sun = |hide: fn(&mut Visibility)| {
        let mut sun = Light {
            power: Vec3::splat(0.2 * std::f32::consts::PI),
            ..Light::default()
        };
        hide(&mut sun.visibility);
        sun
    };
    let hidden = floor_under(sun(|v| v.diffuse = false), 0.0);
    assert_eq!(hidden, 0.0);
    let other = sun(|v| (v.camera, v.glossy, v.transmission) = (false, false, false));
    let lit = floor_under(other, 0.0);
    assert!((lit - 0.1).abs() < 1e-3, "{lit}");
}

/// A held-out object is a hole for the camera, shining or not, and lights others like any object.
#[test]
fn a_holdout_is_one_for_the_camera_alone() {
    let mut scene = empty(0.9);
    let floor = add_material(&mut scene, diffuse([0.5; 3]));
    add_square(&mut scene, Vec3::ZERO, 1000.0, false, floor);
    let lamp = add_material(&mut scene, emission(1.0));
    add_square(&mut scene, Vec3::Z * 2.0, 1000.0, true, lamp);
    scene.instances[1].holdout = true;
    let lit = render(scene.clone(), &RenderOptions::default());
    assert!(lit.iter().all(|p| p[3] == 1.0), "the floor covers all");
    assert!((mean(&lit) - 0.5).abs() < 5e-3, "{}", mean(&lit));
    scene.instances[0].materials = vec![lamp];
    scene.instances[0].holdout = true;
    let hole = render(scene, &RenderOptions::default());
    assert!(hole.iter().all(|p| *p == [0.0; 4]), "{:?}", hole[0]);
}

/// Mean of a floor under shining squares at these heights, which face up, shine on both sides and
/// cast no shadow; only the `sides` are sampled.
fn floor_under_squares(heights: &[f32], sides: Sides) -> f32 {
    let mut scene = empty(0.9);
    let floor = add_material(&mut scene, diffuse([0.5; 3]));
    add_square(&mut scene, Vec3::ZERO, 50.0, false, floor);
    let lamp = add_material(&mut scene, emission(1.0));
    scene.materials[lamp as usize].sample_emission = Some(sides);
    for height in heights {
        add_square(&mut scene, Vec3::Z * *height, 1.0, false, lamp);
        let visibility = &mut scene.instances.last_mut().unwrap().visibility;
        (visibility.shadow, visibility.camera) = (false, false);
    }
    mean(&render(scene, &RenderOptions::default()))
}

/// What casts no shadow lets sampled light through but not what rays meet by chance: then it
/// matters which sides are sampled.
#[test]
fn only_the_sides_that_are_sampled_shine_through_what_casts_no_shadow() {
    let one = floor_under_squares(&[1.0], Sides::Both);
    let hidden = floor_under_squares(&[1.0, 1.1], Sides::Front);
    let shown = floor_under_squares(&[1.0, 1.1], Sides::Back);
    assert!((hidden / one - 1.0).abs() < 0.01, "{hidden} {one}");
    assert!(shown / one > 1.2, "{shown} {one}");
}

/// The same seed gives the same bits whatever the number of threads.
#[test]
fn threads_do_not_change_a_picture() {
    let scene = || {
        let mut scene = empty(2.0);
        scene.world.color = Vec3::new(0.2, 0.3, 0.5);
        let floor = add_material(&mut scene, diffuse([0.8, 0.5, 0.3]));
        let lamp = add_material(&mut scene, emission(10.0));
        add_square(&mut scene, Vec3::ZERO, 5.0, false, floor);
        add_square(&mut scene, Vec3::new(0.5, 0.0, 1.0), 0.2, true, lamp);
        scene.settings.samples = 8;
        scene.settings.resolution = [100, 70];
        scene
    };
    let with = |threads| RenderOptions {
        threads: Some(threads),
        ..RenderOptions::default()
    };
    let one = render(scene(), &with(1));
    assert!(
        one == render(scene(), &with(3)),
        "three threads make another picture"
    );
    let other_seed = RenderOptions {
        seed: Some(1),
        ..with(1)
    };
    assert!(
        one != render(scene(), &other_seed),
        "the seed changes nothing"
    );
}

/// Two materials whose networks are worth caching, on three squares.
fn cellular() -> Scene {
    let mut scene = empty(2.0);
    scene.world.color = Vec3::new(0.2, 0.3, 0.5);
    let floor = add_material(&mut scene, cells(9.7));
    let wall = add_material(&mut scene, cells(31.0));
    add_square(&mut scene, Vec3::ZERO, 5.0, false, floor);
    add_square(&mut scene, Vec3::new(0.2, 0.1, 0.5), 0.3, false, wall);
    add_square(&mut scene, Vec3::new(0.0, 0.0, 3.0), 1.0, true, wall);
    scene.settings.samples = 8;
    scene.settings.resolution = [100, 70];
    scene
}

/// A table of so many cells.
fn table_of(cells: u64) -> CacheMode {
    CacheMode::Paper {
        cells: Some(cells),
        entries: None,
        level_offset: 0.0,
    }
}

/// Groups and lanes change nothing. The batch changes the order in which the eight samples of
/// a pixel are added, and nothing else.
#[test]
fn the_schedule_does_not_change_a_picture() {
    let with = |cache: CacheMode, schedule| {
        let options = RenderOptions {
            cache,
            schedule,
            ..RenderOptions::default()
        };
        render(cellular(), &options)
    };
    let usual = CpuSchedule::default();
    let grouped = |group_hits| CpuSchedule {
        group_hits,
        ..usual
    };
    for cache in [CacheMode::Off, table_of(100_000)] {
        let expected = with(cache, usual);
        for hits in [1, 17, 4096] {
            assert!(with(cache, grouped(hits)) == expected, "{cache:?}, {hits}");
        }
    }
    let expected = with(CacheMode::Off, usual);
    for isa in Isa::available() {
        let got = with(CacheMode::Off, CpuSchedule { isa, ..usual });
        assert!(got == expected, "{isa:?}");
    }
    for batch_paths in [1, 100, 8192] {
        let schedule = CpuSchedule {
            batch_paths,
            ..usual
        };
        let got = with(CacheMode::Off, schedule);
        for (a, b) in got.as_flattened().iter().zip(expected.as_flattened()) {
            assert!((a - b).abs() <= 1e-6 * b.abs(), "{batch_paths}: {a} {b}");
        }
    }
}

/// What is stored is a function of the key, and what is evaluated is what would be found: it
/// does not matter which thread comes first.
#[test]
fn threads_do_not_change_a_cached_picture() {
    let with = |threads, cells| RenderOptions {
        threads: Some(threads),
        cache: table_of(cells),
        ..RenderOptions::default()
    };
    let one = render(cellular(), &with(1, 100_000));
    let off = render(cellular(), &RenderOptions::default());
    assert!(one != off, "nothing was cached");
    assert!(
        one == render(cellular(), &with(3, 100_000)),
        "threads matter"
    );
    assert!(
        one == render(cellular(), &with(2, 7)),
        "a full table matters"
    );
}

/// Constant networks have nothing to cache: the cache changes nothing at all.
#[test]
fn the_cache_leaves_constant_materials_alone() {
    let scene = || {
        let mut scene = empty(5.0);
        scene.world.color = Vec3::ONE;
        let white = add_material(&mut scene, diffuse([0.7; 3]));
        add_square(&mut scene, Vec3::ZERO, 0.5, false, white);
        scene.settings.samples = 4;
        scene
    };
    let cache = CacheMode::Paper {
        cells: Some(1000),
        entries: Some(4),
        level_offset: 0.0,
    };
    let cached = RenderOptions {
        cache,
        ..RenderOptions::default()
    };
    assert!(render(scene(), &RenderOptions::default()) == render(scene(), &cached));
}
