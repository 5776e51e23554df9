//! A small scene in which every stage has something to do.

use crate::scenes::*;
use glam::{Affine3A, Quat, Vec2, Vec3, Vec4};
use matcha_render::scene::*;
use matcha_shade::source::{GltfAlpha, GltfMaterial, Link, NodeTree};

/// A tree whose shader takes its colour from cellular noise over what a node gives.
fn patterned(shader: &str, output: &str, from: &str, socket_of: [&str; 2]) -> NodeTree {
    let mut whole = driven(shader, output, 0, from, socket_of);
    let inputs = vec![
        socket("Vector", "VECTOR", &[0.0; 3]),
        socket("Scale", "VALUE", &[2.0]),
    ];
    let color = socket("Color", "RGBA", &[0.0; 4]);
    whole
        .nodes
        .push(node("ShaderNodeTexVoronoi", inputs, Some(color)));
    let link = |from, to| Link { from, to };
    whole.links.pop();
    whole
        .links
        .extend([link([2, 0], [3, 0]), link([3, 0], [0, 0])]);
    whole
}

fn add_tree(scene: &mut Scene, tree: NodeTree) -> Option<u32> {
    scene.trees.push(tree);
    Some(scene.trees.len() as u32 - 1)
}

fn gltf(scene: &mut Scene, base_color: Vec4, metallic: f32, transmission: f32) -> u32 {
    scene.materials.push(Material {
        name: format!("material {}", scene.materials.len()),
        shader: Shader::Gltf(Box::new(GltfMaterial {
            base_color,
            base_color_texture: None,
            metallic,
            roughness: 0.3,
            metallic_roughness_texture: None,
            normal_texture: None,
            emission: Vec3::ZERO,
            emission_texture: None,
            alpha: GltfAlpha::Blend,
            ior: 1.45,
            transmission,
            specular: (1.0, Vec3::ONE),
            vertex_color: None,
        })),
        pass_index: 0.0,
        sample_emission: Some(Sides::Both),
    });
    scene.materials.len() as u32 - 1
}

fn light(name: &str, at: Vec3, shape: LightShape, power: f32, tree: Option<u32>) -> Light {
    Light {
        name: name.into(),
        transform: Affine3A::from_rotation_translation(Quat::from_rotation_y(0.3), at),
        shape,
        power: Vec3::splat(power),
        tree,
        ..Light::default()
    }
}

/// A block that stands on a corner.
fn add_block(scene: &mut Scene, centre: Vec3, size: f32, material: u32) {
    let turn = Quat::from_axis_angle(Vec3::new(0.6, 0.7, 0.2).normalize(), 0.9);
    let corner = |i: u32| {
        let bits = [i & 1, i >> 1 & 1, i >> 2].map(|bit| bit as f32 - 0.5);
        centre + turn * (Vec3::from(bits) * size)
    };
    let sides = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let two = |[a, b, c, d]: [u32; 4]| [[a, b, c], [a, c, d]];
    let indices = sides.into_iter().flat_map(two).collect();
    add_mesh(scene, (0..8).map(corner).collect(), indices, material);
}

fn add_lights(scene: &mut Scene) {
    let towards = ["Incoming", "VECTOR"];
    let far = ["Ray Length", "VALUE"];
    let [light_output, emission] = ["ShaderNodeOutputLight", "ShaderNodeEmission"];
    let colored = patterned(emission, light_output, "ShaderNodeNewGeometry", towards);
    let fading = driven(emission, light_output, 1, "ShaderNodeLightPath", far);
    let colored = add_tree(scene, colored);
    let fading = add_tree(scene, fading);
    let ball = LightShape::Point {
        radius: 0.5,
        soft_falloff: false,
    };
    let area = LightShape::Area {
        size: Vec2::new(1.0, 0.6),
        ellipse: false,
        spread: 2.5,
    };
    let sun = LightShape::Sun { angle: 0.5 };
    scene.lights = vec![
        light("ball", Vec3::new(-1.5, 0.6, 3.0), ball, 40.0, fading),
        light("area", Vec3::new(1.0, -1.2, 3.5), area, 60.0, None),
        light("sun", Vec3::ZERO, sun, 1.0, colored),
        light(
            "plain sun",
            Vec3::ZERO,
            LightShape::Sun { angle: 0.1 },
            0.5,
            None,
        ),
    ];
}

/// A floor and a carpet with patterns below two panes and blocks of metal and glass, an emitter with a pattern,
/// lights and suns with and without node trees, and a world with one.
pub fn scene() -> Scene {
    let mut scene = empty(9.0);
    scene.settings = Settings {
        transparent_bounces: 3,
        max_bounces: 6,
        seed: 5,
        ..Settings::default()
    };
    let floor = add_material(&mut scene, cells(3.0));
    let uv = ["UV", "VECTOR"];
    let glow = driven(
        "ShaderNodeEmission",
        "ShaderNodeOutputMaterial",
        0,
        "ShaderNodeUVMap",
        uv,
    );
    let glow = add_material(&mut scene, glow);
    let pane = gltf(&mut scene, Vec4::new(0.8, 0.5, 0.4, 0.4), 0.0, 0.0);
    let metal = gltf(&mut scene, Vec4::new(0.9, 0.8, 0.6, 1.0), 1.0, 0.0);
    let glass = gltf(&mut scene, Vec4::ONE, 0.0, 1.0);
    let carpet = add_material(&mut scene, cells(5.0));
    add_square(&mut scene, Vec3::ZERO, 3.0, false, floor);
    add_square(&mut scene, Vec3::new(1.2, 0.8, 0.1), 0.7, false, carpet);
    add_square(&mut scene, Vec3::new(1.5, 1.0, 3.0), 0.4, true, glow);
    add_square(&mut scene, Vec3::new(-0.5, 0.0, 1.4), 1.0, false, pane);
    add_square(&mut scene, Vec3::new(0.2, 0.3, 1.8), 1.0, true, pane);
    add_block(&mut scene, Vec3::new(0.8, -0.8, 0.7), 0.9, metal);
    add_block(&mut scene, Vec3::new(-1.2, 0.9, 0.6), 0.8, glass);
    add_lights(&mut scene);
    let directions = ["Generated", "VECTOR"];
    let sky = patterned(
        "ShaderNodeBackground",
        "ShaderNodeOutputWorld",
        "ShaderNodeTexCoord",
        directions,
    );
    scene.world.tree = add_tree(&mut scene, sky);
    scene
}
