//! What materials and the world emit, found out before rendering by running their programs.

use crate::accel::Hit;
use crate::film::filter::FilterTable;
use crate::integrator::{Frame, Networks};
use crate::light::{MaterialEmission, Sides, WorldGrid, grid_direction};
use crate::prepare::{Prepared, constant_radiance};
use crate::scene::PixelFilter;
use glam::{Vec3, vec3};
use matcha_shade::closure::ClosureKind;

/// Points at which the emission of one material is probed.
const PROBES: usize = 256;
/// Columns of the world's importance map where its author names none.
const MAP_WIDTH: u32 = 1024;

/// Emission of every material that emits where it is sampled.
pub fn of_materials(prepared: &Prepared) -> Vec<Option<MaterialEmission>> {
    let programs = match prepared.programs(false) {
        Ok(programs) => programs,
        Err(_) => return Vec::new(),
    };
    let filter = FilterTable::new(PixelFilter::Box);
    let frame = Frame {
        prepared,
        programs: &programs,
        filter: &filter,
        cache: None,
        seed: 0,
    };
    let mut networks = Networks::default();
    let shining: Vec<bool> = programs.iter().map(|p| p.has_emission()).collect();
    let probes = probes(prepared, &shining);
    probes
        .iter()
        .enumerate()
        .map(|(material, hits)| {
            if hits.is_empty() {
                return None;
            }
            let program = &programs[material];
            let plain = !program
                .closures
                .iter()
                .any(|c| matches!(c.kind, ClosureKind::Principled(_)));
            let emission = match constant_radiance(program) {
                Some(radiance) if plain => MaterialEmission {
                    radiance,
                    constant: true,
                    sides: Sides::Both,
                },
                _ => probe(&frame, &mut networks, material as u32, hits)?,
            };
            where_sampled(
                emission,
                prepared.scene().materials[material].sample_emission?,
            )
        })
        .collect()
}

/// The emission of the sides that are to be sampled.
fn where_sampled(emission: MaterialEmission, sampled: Sides) -> Option<MaterialEmission> {
    let sides = emission.sides.common(sampled)?;
    Some(MaterialEmission { sides, ..emission })
}

/// Points spread over the triangles of each material that shines.
fn probes(prepared: &Prepared, shining: &[bool]) -> Vec<Vec<Hit>> {
    let scene = prepared.scene();
    let mut triangles: Vec<Vec<[u32; 2]>> = vec![Vec::new(); shining.len()];
    for (i, instance) in scene.instances.iter().enumerate() {
        let mesh = &scene.meshes[instance.mesh as usize];
        let slots = mesh.material_slots.iter().chain(&instance.materials);
        if !slots.into_iter().any(|&m| shining[m as usize]) {
            continue;
        }
        for primitive in 0..mesh.indices.len() as u32 {
            if let Some(material) = mesh.material_of(instance, primitive)
                && shining[material as usize]
            {
                triangles[material as usize].push([i as u32, primitive]);
            }
        }
    }
    triangles.iter().map(|list| spread(list)).collect()
}

/// Up to [`PROBES`] points on the listed triangles, at places of a low-discrepancy sequence
/// (Roberts 2018, R2).
fn spread(triangles: &[[u32; 2]]) -> Vec<Hit> {
    let count = if triangles.is_empty() { 0 } else { PROBES };
    (0..count)
        .map(|k| {
            let [instance, primitive] = triangles[k * triangles.len() / PROBES];
            let (x, y) = (0.754_877_7 * k as f32, 0.569_840_3 * k as f32);
            let (mut u, mut v) = (x.fract(), y.fract());
            if u + v > 1.0 {
                (u, v) = (1.0 - u, 1.0 - v);
            }
            Hit {
                instance,
                primitive,
                t: 0.0,
                u,
                v,
            }
        })
        .collect()
}

/// Mean emission over the probes, seen from both sides.
fn probe(
    frame: &Frame,
    networks: &mut Networks,
    material: u32,
    hits: &[Hit],
) -> Option<MaterialEmission> {
    let mut mean = |side: f32| {
        let towards = hits
            .iter()
            .map(|hit| (*hit, -front_normal(frame, hit) * side));
        networks.emission_of_points(frame, material, towards);
        let sum: Vec3 = (0..hits.len()).map(|i| networks.emission(i)).sum();
        sum / hits.len() as f32
    };
    let (front, back) = (mean(1.0), mean(-1.0));
    let sides = match (front == Vec3::ZERO, back == Vec3::ZERO) {
        (true, true) => return None,
        (false, true) => Sides::Front,
        (true, false) => Sides::Back,
        (false, false) => Sides::Both,
    };
    let radiance = if sides == Sides::Both {
        0.5 * (front + back)
    } else {
        front + back
    };
    Some(MaterialEmission {
        radiance,
        constant: false,
        sides,
    })
}

fn front_normal(frame: &Frame, hit: &Hit) -> Vec3 {
    let scene = frame.prepared.scene();
    let instance = &scene.instances[hit.instance as usize];
    let mesh = &scene.meshes[instance.mesh as usize];
    let corners = mesh.indices[hit.primitive as usize].map(|v| {
        instance
            .transform
            .transform_point3(mesh.positions[v as usize])
    });
    let across = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    let mirrored = instance.transform.matrix3.determinant() < 0.0;
    let normal = across.normalize_or(vec3(0.0, 0.0, 1.0));
    if mirrored { -normal } else { normal }
}

/// Radiance of the world, for light sampling; none where that finds nothing that the directions of
/// closures do not find better: where it is the same everywhere (as in Cycles).
pub fn of_world(prepared: &Prepared) -> Option<WorldGrid> {
    let world = &prepared.scene().world;
    match prepared.world() {
        Err(_) => None,
        Ok(_) if !world.importance_sample => None,
        Ok(_) => Some(bake(prepared, world.map_resolution)),
    }
}

fn bake(prepared: &Prepared, asked: u32) -> WorldGrid {
    let width = if asked == 0 {
        MAP_WIDTH
    } else {
        asked.clamp(4, 8192)
    };
    let height = (width / 2).max(2);
    let filter = FilterTable::new(PixelFilter::Box);
    let frame = Frame {
        prepared,
        programs: &[],
        filter: &filter,
        cache: None,
        seed: 0,
    };
    let mut networks = Networks::default();
    let mut radiance = Vec::with_capacity(width as usize * height as usize);
    for y in 0..height {
        let directions =
            (0..width).map(|x| grid_direction(x as f32 + 0.5, y as f32 + 0.5, width, height));
        networks.world_of_directions(&frame, directions);
        radiance.extend((0..width as usize).map(|x| networks.world_radiance(x)));
    }
    WorldGrid {
        width,
        height,
        radiance,
    }
}
