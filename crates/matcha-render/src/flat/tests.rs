//! What devices read from the arrays is what the processor finds in the scene.

use super::*;
use crate::camera::prepare;
use crate::device::geometry_input::{geometry_background, geometry_input};
use crate::device::geometry_view::{geometry_material, geometry_point};
use crate::device::texture_view::{TextureColor, texture_sample};
use crate::scene::{AlphaMode, Camera, ColorSpace, Scene};
use crate::surface::{SurfaceTables, View, fill_background};
use crate::texture::TextureSet;
use glam::{Vec2, vec2};
use matcha_shade::graph::{AlphaHandling, Interpolation, TextureRef};
use matcha_shade::input::InputKind;
use matcha_shade::rows::Rows;
use matcha_shade::source::Extension;
use matcha_shade::vm::Textures;

mod fixture;
use fixture::{Random, all_kinds, hit, image, images, looks, path, scene, smooth_images};

fn prepared(scene: &Scene) -> (SurfaceTables, FlatGeometry) {
    let camera = prepare(&Camera::default(), [200, 100], 1.0);
    let view = View::new(camera, [200, 100]);
    let tables = SurfaceTables::new(
        scene,
        view,
        [InputKind::Pointiness, InputKind::RandomPerIsland],
    );
    let flat = FlatGeometry::of_scene(scene, &tables, view);
    (tables, flat)
}

#[test]
fn points_and_all_their_quantities_are_the_same_numbers() {
    let scene = scene();
    let (tables, flat) = prepared(&scene);
    let mut random = Random(1);
    for _ in 0..500 {
        let (hit, path) = (hit(&mut random, &scene), path(&mut random));
        let expected = tables.point(&scene, &hit, &path);
        let weights = vec2(hit.u, hit.v);
        let point = geometry_point(
            flat.view(),
            hit.instance,
            hit.primitive,
            hit.t,
            weights,
            path,
        );
        assert_eq!(bytemuck::bytes_of(&point), bytemuck::bytes_of(&expected));
        for input in all_kinds() {
            let width = input.kind.width();
            let mut rows = Rows::new(width, 1);
            tables.fill(&scene, &[(input, 0)], &[expected], &mut rows);
            let found = geometry_input(flat.view(), &point, input.packed());
            for (c, value) in found.into_iter().enumerate() {
                let expected = if c < width { rows.get(c, 0) } else { 0.0 };
                // The sign of a zero may differ: a layer that is missing is zero at once.
                assert_eq!(value, expected, "{input:?} {hit:?}");
            }
        }
        let mesh = &scene.meshes[scene.instances[hit.instance as usize].mesh as usize];
        let material = mesh.material_of(&scene.instances[hit.instance as usize], hit.primitive);
        let found = geometry_material(flat.view(), hit.instance, hit.primitive);
        assert_eq!(Some(found), material);
    }
}

#[test]
fn directions_have_the_same_quantities() {
    let scene = scene();
    let (_, flat) = prepared(&scene);
    let view = flat.view().camera;
    let mut random = Random(2);
    for _ in 0..200 {
        let ray = path(&mut random);
        for input in all_kinds() {
            let width = input.kind.width();
            let mut rows = Rows::new(width, 1);
            fill_background(&view, &[(input, 0)], &[ray], &mut rows);
            let found = geometry_background(flat.view(), ray, input.packed());
            for (c, value) in found[..width].iter().enumerate() {
                assert_eq!(value.to_bits(), rows.get(c, 0).to_bits(), "{input:?}");
            }
        }
    }
}

#[test]
fn a_missing_layer_is_none_and_a_shared_one_is_stored_once() {
    let scene = scene();
    let (_, flat) = prepared(&scene);
    let view = flat.view();
    let triangles: usize = scene.meshes.iter().map(|m| m.indices.len()).sum();
    assert_eq!(view.indices.len(), triangles);
    let sets = scene.meshes.iter().flat_map(|m| &m.uv_sets);
    assert_eq!(view.uvs.len(), sets.map(|s| s.corners.len()).sum::<usize>());
    assert!(view.normals.len() < triangles, "one mesh is flat");
    let names: Vec<_> = flat.sections().iter().map(|s| s.name).collect();
    assert!(names.contains(&"GeometryView_positions") && names.contains(&"GeometryView_camera"));
}

fn sample(set: &TextureSet, look: TextureRef, uv: Vec2, a: Vec2, b: Vec2) -> [f32; 4] {
    let row = |x: f32| [x];
    let [u, v, au, av, bu, bv] = [uv.x, uv.y, a.x, a.y, b.x, b.y].map(row);
    let mut out = [[0.0]; 4];
    let [red, green, blue, alpha] = &mut out;
    let out_rows = [&mut red[..], &mut green[..], &mut blue[..], &mut alpha[..]];
    set.sample(look, 1, [&u, &v], [&au, &av], [&bu, &bv], out_rows);
    out.map(|c| c[0])
}

#[test]
fn textures_are_the_same_bits_but_for_the_exact_power() {
    let images = images();
    let looks = looks();
    let set = TextureSet::build(&images, &looks);
    let flat = FlatTextures::of_set(&set, &looks, false);
    let mut random = Random(3);
    for (index, look) in (0..).zip(&looks) {
        let encoded = images
            .get(look.image as usize)
            .is_some_and(|image| image.color_space == ColorSpace::Srgb);
        for _ in 0..100 {
            let uv = vec2(random.unit() * 6.0 - 3.0, random.unit() * 6.0 - 3.0);
            let size = (random.unit() * 10.0 - 9.0).exp2();
            let [a, b] = [0, 1].map(|_| vec2(random.unit() * size, random.unit() * size));
            let TextureColor { rgb, alpha } = texture_sample(flat.view(), index, uv, a, b);
            let found = rgb.extend(alpha).to_array();
            let expected = sample(&set, *look, uv, a, b);
            for (found, expected) in found.into_iter().zip(expected) {
                let same = if encoded {
                    (found - expected).abs() <= 1e-6 * expected.max(1.0)
                } else {
                    found.to_bits() == expected.to_bits()
                };
                assert!(same, "{look:?} {uv} {a} {b}: {found} {expected}");
            }
        }
    }
}

#[test]
fn no_place_and_no_image_are_what_they_are_on_the_processor() {
    let images = [image(5, 3, ColorSpace::NonColor, AlphaMode::Straight)];
    let look = TextureRef {
        image: 0,
        interpolation: Interpolation::Linear,
        extension: Extension::Repeat,
        alpha: AlphaHandling::Associated,
        no_footprint: false,
    };
    let looks = [look, TextureRef { image: 9, ..look }];
    let set = TextureSet::build(&images, &looks);
    let flat = FlatTextures::of_set(&set, &looks, false);
    for (index, look) in (0..).zip(looks) {
        for uv in [vec2(f32::NAN, 0.0), vec2(0.0, f32::INFINITY)] {
            let found = texture_sample(flat.view(), index, uv, Vec2::ZERO, Vec2::ZERO);
            let expected = sample(&set, look, uv, Vec2::ZERO, Vec2::ZERO);
            assert_eq!(found.rgb.extend(found.alpha).to_array(), expected);
        }
    }
}

/// Blocks are off by what is stated, seen through every filter; floats and what is too small for
/// blocks are the same bits.
#[test]
fn packed_textures_are_off_by_what_is_stated() {
    let mut images = smooth_images();
    for image in &mut images {
        image.color_space = ColorSpace::NonColor;
    }
    let looks = looks();
    let set = TextureSet::build(&images, &looks);
    let [plain, packed] = [false, true].map(|packs| FlatTextures::of_set(&set, &looks, packs));
    assert_eq!(plain.memory(), None);
    let memory = packed.memory().expect("it is packed");
    let words = |flat: &FlatTextures| flat.view().texels.len() as u64;
    assert_eq!(memory.bytes, 4 * words(&packed));
    assert_eq!(memory.bytes_saved, 4 * (words(&plain) - words(&packed)));
    assert!(
        memory.packed_levels >= 4 && memory.kept_levels >= 4,
        "{memory:?}"
    );
    let mut random = Random(8);
    let mut squares = [0.0; 4];
    for (index, look) in (0..).zip(&looks) {
        let is_packed = look.image < 5 && look.image != 2;
        for _ in 0..100 {
            let uv = vec2(random.unit() * 6.0 - 3.0, random.unit() * 6.0 - 3.0);
            let [exact, found] = [&plain, &packed].map(|flat| {
                let color = texture_sample(flat.view(), index, uv, Vec2::ZERO, Vec2::ZERO);
                color.rgb.extend(color.alpha).to_array()
            });
            if !is_packed {
                assert_eq!(exact, found, "{look:?}");
                continue;
            }
            for c in 0..4 {
                squares[c] += f64::from(exact[c] - found[c]).powi(2);
            }
        }
    }
    let samples = looks
        .iter()
        .filter(|look| look.image < 5 && look.image != 2)
        .count()
        * 100;
    let errors = squares.map(|square: f64| (square / samples as f64).sqrt() * 255.0);
    println!("{errors:?} of 255");
    assert!(
        errors.iter().all(|&error| error < BLOCK_ERROR),
        "{errors:?}"
    );
    assert!(errors[0] > 0.0, "nothing was packed");
}
