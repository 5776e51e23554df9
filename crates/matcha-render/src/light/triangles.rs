//! Emissive triangles of all instances, in world space.

use super::groups::Group;
use super::tree_build;
use super::world::luminance;
use crate::device::light_importance::LightBounds;
use crate::device::light_sample::light_triangle_normal;
use crate::device::light_triangle::LightTriangle;
use crate::device::light_view::{
    EmissiveTriangle, LIGHT_BACK, LIGHT_FRONT, LIGHT_GROUP_IS_TREE, LIGHT_MIRRORED, LIGHT_NONE,
    LIGHT_UNIFORM, LightMaterial, LightView,
};
use crate::scene::{Instance, Mesh, Scene};
use bytemuck::Zeroable;
use glam::{Affine3A, Vec3};
use rayon::prelude::*;
use std::ops::Range;

/// Which sides of a surface shine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Sides {
    /// Both.
    #[default]
    Both,
    /// The side that the corners run around counter-clockwise.
    Front,
    /// The other.
    Back,
}

impl Sides {
    /// The sides that are among both.
    pub fn common(self, other: Self) -> Option<Self> {
        match (self, other) {
            (Self::Both, side) | (side, Self::Both) => Some(side),
            (a, b) => (a == b).then_some(a),
        }
    }
}

/// What the renderer knows of a material's emission before it renders.
#[derive(Clone, Copy, Debug)]
pub struct MaterialEmission {
    /// Mean radiance over the surface, W·sr⁻¹·m⁻².
    pub radiance: Vec3,
    /// The radiance is the same everywhere and in every direction.
    pub constant: bool,
    /// Where it leaves and is sampled.
    pub sides: Sides,
}

impl MaterialEmission {
    /// As the devices read it.
    pub fn stored(emission: &Option<Self>) -> LightMaterial {
        let Some(emission) = emission else {
            return LightMaterial::zeroed();
        };
        let uniform = if emission.constant { LIGHT_UNIFORM } else { 0 };
        let sides = match emission.sides {
            Sides::Both => LIGHT_FRONT | LIGHT_BACK,
            Sides::Front => LIGHT_FRONT,
            Sides::Back => LIGHT_BACK,
        };
        LightMaterial {
            radiance: emission.radiance,
            flags: uniform | sides,
        }
    }
}

impl EmissiveTriangle {
    /// Unit normal of the front side.
    pub fn normal(&self) -> Vec3 {
        light_triangle_normal(self.corners, self.surface)
    }

    /// Index into `Scene::materials`.
    pub fn material(&self) -> u32 {
        self.surface & !LIGHT_MIRRORED
    }
}

/// All emissive triangles with a way to find each; fields as in [`LightView`].
#[derive(Clone, Debug, Default)]
pub struct Triangles {
    /// The triangles; their index is their emitter in the light tree.
    pub list: Vec<EmissiveTriangle>,
    first: Vec<u32>,
    of_primitive: Vec<u32>,
}

impl Triangles {
    /// Collects the triangles of a scene; `emission` has an entry for each material.
    /// Triangles without area and materials that are not to be sampled are left out, and
    /// everything beyond `limit` triangles.
    pub fn collect(scene: &Scene, emission: &[Option<MaterialEmission>], limit: usize) -> Self {
        let mut triangles = Self::default();
        for (instance, index) in scene.instances.iter().zip(0..) {
            triangles.first.push(LIGHT_NONE);
            let Some(mesh) = scene.meshes.get(instance.mesh as usize) else {
                continue;
            };
            let shines = |slot| sampled(scene, emission, mesh.material_of_slot(instance, slot));
            let slots = mesh
                .material_slots
                .len()
                .max(instance.materials.len())
                .max(1);
            if (0..slots).any(shines) {
                triangles.add_instance(mesh, instance, index, &shines, limit);
            }
        }
        triangles
    }

    fn add_instance(
        &mut self,
        mesh: &Mesh,
        instance: &Instance,
        index: u32,
        shines: &(impl Fn(usize) -> bool + Sync),
        limit: usize,
    ) {
        let mirrored = if instance.transform.matrix3.determinant() < 0.0 {
            LIGHT_MIRRORED
        } else {
            0
        };
        let found: Vec<Option<EmissiveTriangle>> = (0..mesh.indices.len())
            .into_par_iter()
            .map(|primitive| {
                let slot = mesh.slots.get(primitive).map_or(0, |&s| usize::from(s));
                if !shines(slot) {
                    return None;
                }
                let corners = corners(mesh, primitive, &instance.transform)?;
                let material = mesh.material_of_slot(instance, slot)?;
                Some(EmissiveTriangle {
                    corners,
                    instance: index,
                    primitive: primitive as u32,
                    surface: material | mirrored,
                })
            })
            .collect();
        if found.iter().all(Option::is_none) {
            return;
        }
        if let Some(first) = self.first.last_mut() {
            *first = self.of_primitive.len() as u32;
        }
        for triangle in found {
            let room = self.list.len() < limit;
            self.of_primitive.push(if triangle.is_some() && room {
                self.list.len() as u32
            } else {
                LIGHT_NONE
            });
            self.list.extend(triangle.filter(|_| room));
        }
    }

    /// The triangles without the tree that they hang in.
    #[inline(always)]
    pub fn view(&self) -> LightView<'_> {
        LightView {
            triangles: &self.list,
            first: &self.first,
            of_primitive: &self.of_primitive,
            ..LightView::default()
        }
    }

    /// Emitters of each instance that has some.
    pub fn by_instance(&self) -> Vec<Range<u32>> {
        let mut end = 0;
        self.list
            .chunk_by(|a, b| a.instance == b.instance)
            .map(|list| {
                let start = end;
                end += list.len() as u32;
                start..end
            })
            .collect()
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.list[..])
            + size_of_val(&self.first[..])
            + size_of_val(&self.of_primitive[..])
    }
}

/// Bounds of a triangle for the light tree.
pub fn bounds(triangle: &EmissiveTriangle, emission: &MaterialEmission) -> LightBounds {
    let c = &triangle.corners;
    let area = 0.5 * (c.b - c.a).cross(c.c - c.a).length();
    // Radiance that varies may be somewhere although its estimate is zero.
    let radiance =
        luminance(emission.radiance.abs()).max(if emission.constant { 1e-12 } else { 1e-3 });
    LightBounds {
        low: c.a.min(c.b).min(c.c),
        high: c.a.max(c.b).max(c.c),
        axis: if emission.sides == Sides::Back {
            -triangle.normal()
        } else {
            triangle.normal()
        },
        cos_normals: 1.0,
        cos_emission: 0.0,
        power: radiance * area,
        two_sided: emission.sides == Sides::Both,
    }
}

/// The group of triangles with the given bounds; its link is still to be completed.
pub fn group(bounds: &[LightBounds]) -> Group {
    let both = bounds.iter().any(|b| b.two_sided);
    let unite = |a: LightBounds, b: &LightBounds| tree_build::unite(&a, b);
    let mut all = bounds[1..].iter().fold(bounds[0], unite);
    if both {
        // Some normal or its opposite is near every direction.
        (all.cos_normals, all.two_sided) = (-1.0, false);
    }
    Group::boxed(all, LIGHT_GROUP_IS_TREE)
}

fn sampled(scene: &Scene, emission: &[Option<MaterialEmission>], material: Option<u32>) -> bool {
    let Some(index) = material.map(|m| m as usize) else {
        return false;
    };
    let Some(Some(emission)) = emission.get(index) else {
        return false;
    };
    let wanted = scene
        .materials
        .get(index)
        .is_some_and(|m| m.sample_emission.is_some());
    let shines = !emission.constant || emission.radiance != Vec3::ZERO;
    wanted && shines && emission.radiance.is_finite()
}

fn corners(mesh: &Mesh, primitive: usize, transform: &Affine3A) -> Option<LightTriangle> {
    let [a, b, c] = mesh.indices[primitive].map(|i| mesh.positions.get(i as usize).copied());
    let [a, b, c] = [a?, b?, c?].map(|p| transform.transform_point3(p));
    let area = (b - a).cross(c - a).length();
    // Not a number compares false.
    (area > 0.0 && area.is_finite()).then_some(LightTriangle { a, b, c })
}
