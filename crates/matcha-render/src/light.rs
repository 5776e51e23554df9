//! Lights: a list of everything that shines, and next-event estimation over it.
//!
//! Analytic lights, the emissive triangles of instances, and the world are groups. One group
//! is drawn as Cycles' light tree would, and a triangle of it from a tree of its own.
//! Everything that happens while rendering is
//! device code over a [`LightView`]: `light_sample` and what it calls. This module collects
//! the lights of a scene, and calls that code for the processor.
//!
//! All densities are over solid angle and include the choice of the light. Every density
//! that a `pdf_` function gives is the one with which [`LightSet::sample`] samples, computed
//! by the same code, from the same point `p` and normal `n`: that is what multiple
//! importance sampling rests on. `n` is unit, or zero where light from both sides counts.

mod analytic;
mod escape;
mod groups;
mod tree;
mod tree_build;
mod tree_collapse;
mod triangles;
mod visible;
mod world;

pub use self::tree::{LightTree, Link};
pub use self::triangles::{MaterialEmission, Sides, Triangles};
pub use self::visible::{LightHit, RayKind};
pub use self::world::{WorldGrid, WorldMap, grid_direction, luminance};
pub use crate::device::light_view::{EmissiveTriangle, LightNode, LightOf, LightView};

use self::escape::Distant;
use self::groups::{Group, GroupTree};
use self::visible::LightBvh;
use crate::accel::visibility_mask;
use crate::device::light_analytic::LIGHT_FAR;
use crate::device::light_importance::LightBounds;
use crate::device::light_pdf::{
    LightMet, light_met, light_pdf_triangle, light_pdf_world, light_sun_met,
};
use crate::device::light_sample::{
    LIGHT_EMITS_CONSTANT, LIGHT_EMITS_NOTHING, LIGHT_EMITS_SURFACE, LIGHT_EMITS_TREE,
    LIGHT_IS_ANALYTIC, LIGHT_IS_NONE, LIGHT_IS_TRIANGLE, LightDraw, LightEmission, light_sample,
};
use crate::device::light_view::{LIGHT_NONE, LightMaterial};
use crate::device::light_visible::light_nearest;
use crate::scene::Scene;
use glam::{Vec2, Vec3};
use std::ops::Range;

/// Names a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightId {
    /// Emissive triangle: index into [`LightSet::triangles`].
    Triangle(u32),
    /// Analytic light: index into [`LightSet::analytic`].
    Analytic(u32),
    /// The world.
    World,
}

/// Radiance of a light sample, W·sr⁻¹·m⁻².
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Emission {
    /// Known.
    Constant(Vec3),
    /// The emission of a triangle's material at the barycentric coordinates (u of corner 1, v
    /// of corner 2), towards −`wi`.
    Triangle {
        /// Index into `Scene::instances`.
        instance: u32,
        /// Triangle of its mesh.
        primitive: u32,
        /// Barycentric coordinate of corner 1.
        u: f32,
        /// Barycentric coordinate of corner 2.
        v: f32,
    },
    /// The emission of a light's node tree, times a factor.
    Tree {
        /// Index into [`LightSet::analytic`].
        light: u32,
        /// Radiance that the tree's emission multiplies.
        factor: Vec3,
    },
    /// The radiance of the world from the direction `wi`.
    World,
}

/// A direction that next-event estimation should try.
#[derive(Clone, Copy, Debug)]
pub struct LightSample {
    /// Which light.
    pub light: LightId,
    /// Unit direction to it.
    pub wi: Vec3,
    /// Distance, metres; infinite for suns and the world.
    pub distance: f32,
    /// Point on the light; for distant ones the direction.
    pub point: Vec3,
    /// Unit normal there: of a triangle its front's, of a light the side that shines.
    pub normal: Vec3,
    /// Density, with the choice of the light.
    pub pdf: f32,
    /// What it radiates towards the point.
    pub radiance: Emission,
    /// Blocked by objects.
    pub cast_shadow: bool,
    /// Weigh against BSDF samples; if false the sample counts whole.
    pub mis: bool,
    /// Which closures see it: bits of [`crate::device::ray_kind`].
    pub visibility: u32,
    /// Bounces after which it still counts.
    pub max_bounces: u32,
}

impl LightSample {
    /// From what device code drew; `None` where there is nothing to try.
    fn new(draw: &LightDraw) -> Option<Self> {
        let light = match draw.kind {
            LIGHT_IS_NONE => return None,
            LIGHT_IS_TRIANGLE => LightId::Triangle(draw.index),
            LIGHT_IS_ANALYTIC => LightId::Analytic(draw.index),
            _ => LightId::World,
        };
        let radiance = match draw.emission.kind {
            LIGHT_EMITS_SURFACE => Emission::Triangle {
                instance: draw.instance,
                primitive: draw.primitive,
                u: draw.uv.x,
                v: draw.uv.y,
            },
            _ => Emission::new(&draw.emission, draw.index),
        };
        let far = draw.distance >= LIGHT_FAR;
        Some(Self {
            light,
            wi: draw.wi,
            distance: if far { f32::INFINITY } else { draw.distance },
            point: draw.point,
            normal: draw.normal,
            pdf: draw.pdf,
            radiance,
            cast_shadow: draw.cast_shadow,
            mis: draw.mis,
            visibility: draw.visibility,
            max_bounces: draw.max_bounces,
        })
    }
}

impl Emission {
    /// Of an analytic light or the world.
    fn new(emission: &LightEmission, light: u32) -> Self {
        match emission.kind {
            LIGHT_EMITS_CONSTANT => Self::Constant(emission.radiance),
            LIGHT_EMITS_TREE => Self::Tree {
                light,
                factor: emission.radiance,
            },
            _ => Self::World,
        }
    }
}

impl LightHit {
    fn new(met: &LightMet) -> Option<Self> {
        (met.emission.kind != LIGHT_EMITS_NOTHING).then(|| Self {
            light: LightId::Analytic(met.index),
            radiance: Emission::new(&met.emission, met.index),
            pdf: met.pdf,
            max_bounces: met.max_bounces,
        })
    }
}

/// Everything that shines.
#[derive(Clone, Debug, Default)]
pub struct LightSet {
    triangles: Triangles,
    materials: Vec<LightMaterial>,
    analytic: Vec<LightOf>,
    groups: GroupTree,
    world_slot: u32,
    tree: LightTree,
    distant: Distant,
    bvh: LightBvh,
}

impl LightSet {
    /// Collects the lights of a scene. `emission` has an entry for each material of the
    /// scene, `None` where it does not emit; `world` says what the world
    /// radiates, where light sampling is to look for it.
    pub fn build(
        scene: &Scene,
        emission: Vec<Option<MaterialEmission>>,
        world: Option<WorldGrid>,
    ) -> Self {
        let analytic: Vec<LightOf> = scene
            .lights
            .iter()
            .zip(0..)
            .filter_map(|(l, i)| analytic::convert(l, i))
            .collect();
        let triangles = Triangles::collect(scene, &emission, tree::MAX_EMITTERS);
        let is_sun = |&i: &u32| analytic::is_sun(&analytic[i as usize].shape);
        let (suns, local): (Vec<u32>, Vec<u32>) = (0..analytic.len() as u32).partition(is_sun);
        let world = world.filter(|_| scene.world.importance_sample);
        let sees_world = u32::from(visibility_mask(&scene.world.visibility));
        let distant = Distant::new(suns, world, sees_world);
        let mut set = Self {
            bvh: LightBvh::build(&analytic),
            materials: emission.iter().map(MaterialEmission::stored).collect(),
            tree: LightTree::new(triangles.list.len()),
            triangles,
            analytic,
            distant,
            ..Self::default()
        };
        set.build_groups(&local, &emission);
        set
    }

    /// Builds the tree of groups and the trees below, and tells everything its slot.
    fn build_groups(&mut self, local: &[u32], emission: &[Option<MaterialEmission>]) {
        let bounds: Vec<LightBounds> = self
            .triangles
            .list
            .iter()
            .filter_map(|t| {
                Some(triangles::bounds(
                    t,
                    emission[t.material() as usize].as_ref()?,
                ))
            })
            .collect();
        let meshes = self.triangles.by_instance();
        let light = |&i: &u32| analytic::group(&self.analytic[i as usize].shape, i);
        let mesh = |range: &Range<u32>| triangles::group(&bounds[as_usize(range)]);
        let near: Vec<Group> = local
            .iter()
            .map(light)
            .chain(meshes.iter().map(mesh))
            .collect();
        let suns = self.distant.suns();
        let world = self.distant.world_irradiance().map(Group::world);
        let far: Vec<Group> = suns.iter().map(light).chain(world).collect();
        let tree = &mut self.tree;
        self.groups = GroupTree::build(&near, &far, &mut |leaves, slot| {
            let ranges = leaves
                .iter()
                .map(|&leaf| &meshes[leaf as usize - local.len()]);
            let emitters: Vec<u32> = ranges.cloned().flatten().collect();
            let bounds: Vec<_> = emitters.iter().map(|&e| bounds[e as usize]).collect();
            tree.add(&emitters, &bounds, slot)
        });
        let (of_near, of_far) = self.groups.slots.split_at(near.len());
        for (&light, &slot) in local.iter().zip(of_near).chain(suns.iter().zip(of_far)) {
            self.analytic[light as usize].slot = slot;
        }
        self.world_slot = of_far.get(suns.len()).copied().unwrap_or(LIGHT_NONE);
    }

    /// The lights as device code reads them.
    #[inline(always)]
    pub fn view(&self) -> LightView<'_> {
        let [tree, triangles, bvh] = [self.tree.view(), self.triangles.view(), self.bvh.view()];
        let groups = self.groups.view();
        LightView {
            nodes: tree.nodes,
            parents: tree.parents,
            slots: tree.slots,
            groups: groups.groups,
            group_parents: groups.group_parents,
            world_slot: self.world_slot,
            triangles: triangles.triangles,
            first: triangles.first,
            of_primitive: triangles.of_primitive,
            boxes: bvh.boxes,
            order: bvh.order,
            materials: &self.materials,
            lights: &self.analytic,
            ..self.distant.view()
        }
    }

    /// True where nothing can be sampled.
    pub fn is_empty(&self) -> bool {
        self.groups.is_empty()
    }

    /// Emissive triangles.
    pub fn triangles(&self) -> &[EmissiveTriangle] {
        &self.triangles.list
    }

    /// Analytic lights.
    pub fn analytic(&self) -> &[LightOf] {
        &self.analytic
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        self.triangles.bytes()
            + self.tree.bytes()
            + self.distant.bytes()
            + self.bvh.bytes()
            + size_of_val(&self.materials[..])
            + size_of_val(&self.analytic[..])
            + self.groups.bytes()
    }

    /// Samples a light and a direction to it. `u_select` and `u` are in [0, 1).
    pub fn sample(&self, p: Vec3, n: Vec3, u_select: f32, u: Vec2) -> Option<LightSample> {
        LightSample::new(&light_sample(self.view(), p, n, u_select, u))
    }

    /// Density with which `sample` finds a point of a triangle that a ray from `p` in the unit
    /// direction `wi` meets at `distance`; zero where the triangle is not sampled, or not on
    /// this side.
    pub fn pdf_triangle(
        &self,
        instance: u32,
        primitive: u32,
        p: Vec3,
        n: Vec3,
        wi: Vec3,
        distance: f32,
    ) -> f32 {
        light_pdf_triangle(self.view(), instance, primitive, p, n, wi, distance)
    }

    /// Density with which `sample` finds the world in the unit direction `wi`.
    pub fn pdf_world(&self, p: Vec3, n: Vec3, wi: Vec3) -> f32 {
        light_pdf_world(self.view(), p, n, wi)
    }

    /// Nearest visible analytic light between `t_min` and `t_max` on a ray with a unit
    /// direction, and its distance. Suns are not among them ([`LightSet::escaped`]).
    pub fn intersect(
        &self,
        origin: Vec3,
        direction: Vec3,
        t_min: f32,
        t_max: f32,
        kind: RayKind,
    ) -> Option<(u32, f32)> {
        let nearest = light_nearest(self.view(), origin, direction, t_min, t_max, kind.bit());
        (nearest.index != LIGHT_NONE).then_some((nearest.index, nearest.distance))
    }

    /// True where no ray can meet an analytic light, so that `intersect` need not be asked.
    pub fn nothing_to_meet(&self) -> bool {
        self.bvh.is_empty()
    }

    /// Radiance and density of a light that `intersect` found. `p` and `n` belong to the last
    /// scattering and `distance` counts from there.
    pub fn hit(&self, index: u32, p: Vec3, n: Vec3, wi: Vec3, distance: f32) -> Option<LightHit> {
        LightHit::new(&light_met(self.view(), index, p, n, wi, distance))
    }

    /// Suns that a ray sees that left the scene in the unit direction `wi`. `p` and `n` belong
    /// to the last scattering. The world is the caller's: [`LightSet::pdf_world`].
    pub fn escaped(
        &self,
        p: Vec3,
        n: Vec3,
        wi: Vec3,
        kind: RayKind,
    ) -> impl Iterator<Item = LightHit> {
        (0..self.distant.suns().len() as u32).filter_map(move |k| {
            LightHit::new(&light_sun_met(self.view(), k, p, n, wi, kind.bit()))
        })
    }
}

fn as_usize(range: &Range<u32>) -> Range<usize> {
    range.start as usize..range.end as usize
}

#[cfg(test)]
mod tests;
