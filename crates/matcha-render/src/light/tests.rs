//! Shared parts of the lights' tests: scenes of one kind of light, and integrals.

mod consistency;
mod cycles;
mod forms;
mod groups;
mod many;
mod world;

use super::*;
use crate::sampler::{sample_1d, sample_2d};
use crate::scene::{Instance, Light, LightShape, Material, Mesh, Shader, Visibility};
use glam::{Affine3A, Vec4};

/// A light of `power` at a place, shining down by default.
pub fn light(shape: LightShape, transform: Affine3A, power: Vec3) -> Light {
    Light {
        transform,
        shape,
        power,
        ..Light::default()
    }
}

/// A scene of triangles (material 0) and lights.
pub fn scene(triangles: &[[Vec3; 3]], lights: Vec<Light>) -> Scene {
    let mut scene = Scene {
        lights,
        ..Scene::default()
    };
    if triangles.is_empty() {
        return scene;
    }
    scene.materials.push(Material {
        name: "lamp".into(),
        shader: Shader::Cycles(0),
        pass_index: 0.0,
        sample_emission: Some(Sides::Both),
    });
    scene.meshes.push(Mesh {
        positions: triangles.iter().flatten().copied().collect(),
        indices: (0..triangles.len() as u32)
            .map(|i| [3 * i, 3 * i + 1, 3 * i + 2])
            .collect(),
        material_slots: vec![0],
        ..Mesh::default()
    });
    scene.instances.push(Instance {
        name: String::new(),
        mesh: 0,
        transform: Affine3A::IDENTITY,
        materials: Vec::new(),
        pass_index: 0.0,
        random: 0.0,
        color: Vec4::ONE,
        visibility: Visibility::default(),
        holdout: false,
    });
    scene
}

/// Constant emission of the scene's one material.
pub fn emission(radiance: f32, sides: Sides) -> Vec<Option<MaterialEmission>> {
    vec![Some(MaterialEmission {
        radiance: Vec3::splat(radiance),
        constant: true,
        sides,
    })]
}

/// Only analytic lights.
pub fn lamps(lights: Vec<Light>) -> LightSet {
    LightSet::build(&scene(&[], lights), Vec::new(), None)
}

/// Radiance of a sample whose emission is constant.
pub fn constant(sample: &LightSample) -> Vec3 {
    match sample.radiance {
        Emission::Constant(radiance) => radiance,
        other => panic!("{other:?} is not constant"),
    }
}

/// The grid of a world with the same radiance everywhere.
pub fn even_world(radiance: f32) -> WorldGrid {
    let (width, height) = (16, 8);
    WorldGrid {
        width,
        height,
        radiance: vec![Vec3::splat(radiance); (width * height) as usize],
    }
}

/// Irradiance at a point by next-event estimation without occlusion.
pub fn irradiance(lights: &LightSet, p: Vec3, n: Vec3, samples: u32) -> Vec3 {
    irradiance_under(0.0, lights, p, n, samples)
}

/// The same, under a world with the same radiance everywhere.
pub fn irradiance_under(world: f32, lights: &LightSet, p: Vec3, n: Vec3, samples: u32) -> Vec3 {
    let mut sum = [0.0f64; 3];
    for i in 0..samples {
        let select = sample_1d(7, i, 0);
        if let Some(s) = lights.sample(p, n, select, sample_2d(7, i, 1)) {
            let radiance = match s.light {
                LightId::World => Vec3::splat(world),
                _ => constant(&s),
            };
            let value = radiance * (s.wi.dot(n).max(0.0) / s.pdf);
            for (sum, v) in sum.iter_mut().zip(value.to_array()) {
                *sum += f64::from(v);
            }
        }
    }
    Vec3::from_array(sum.map(|s| (s / f64::from(samples)) as f32))
}
