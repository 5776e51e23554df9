//! Lights: a list of everything that shines, and next-event estimation over it.
//!
//! Local lights (emissive triangles, points, spots, areas) hang in one light tree. Suns and
//! the world have shares of their own beside it. A share is half the same for everyone that
//! can reach the point, half in proportion to the irradiance that is estimated to arrive:
//! the estimates of a tree's root and of a sun differ too much in kind to trust them alone.
//!
//! All densities are over solid angle and include the choice of the light. Every density
//! that a `pdf_` function gives is the one with which [`LightSet::sample`] samples, computed
//! by the same code, from the same point `p` and normal `n`: that is what multiple
//! importance sampling rests on. `n` is unit, or zero where light from both sides counts.

mod analytic;
mod escape;
mod tree;
mod tree_build;
mod tree_collapse;
mod triangles;
mod visible;
mod world;

pub use self::tree::{LightNode, LightTree, Link};
pub use self::triangles::{EmissiveTriangle, MaterialEmission, Sides, Triangles};
pub use self::visible::{LightHit, RayKind};
pub use self::world::{WorldGrid, WorldMap, WorldRadiance, grid_direction, luminance};

use self::escape::{Distant, Share};
use self::visible::LightBvh;
use crate::device::light_analytic::{
    AnalyticLight, LIGHT_FAR, light_attenuation, light_direction_sample,
};
use crate::device::light_triangle::light_triangle_pdf;
use crate::device::light_triangle::light_triangle_sample;
use crate::scene::{Scene, Visibility};
use glam::{Vec2, Vec3};

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

/// An analytic light with what the integrator must know of it.
#[derive(Clone, Copy, Debug)]
pub struct LightOf {
    /// Index into `Scene::lights`.
    pub scene_light: u32,
    /// Node tree that multiplies the radiance: index into `Scene::trees`.
    pub tree: Option<u32>,
    /// Blocked by objects.
    pub cast_shadow: bool,
    /// Combined with BSDF samples; otherwise only next-event estimation finds it.
    pub mis: bool,
    /// Who sees it.
    pub visibility: Visibility,
    /// Bounces after which it still counts.
    pub max_bounces: u32,
    /// Geometry and radiance.
    pub shape: AnalyticLight,
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
        /// Index into `Scene::trees`.
        tree: u32,
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
    /// Which closures see it.
    pub visibility: Visibility,
    /// Bounces after which it still counts.
    pub max_bounces: u32,
}

/// Everything that shines.
#[derive(Clone, Debug, Default)]
pub struct LightSet {
    triangles: Triangles,
    emission: Vec<Option<MaterialEmission>>,
    analytic: Vec<LightOf>,
    tree: LightTree,
    /// Analytic lights of the tree, by emitter less the number of triangles.
    local: Vec<u32>,
    distant: Distant,
    bvh: LightBvh,
}

impl LightSet {
    /// Collects the lights of a scene. `emission` has an entry for each material of the
    /// scene, `None` where it does not emit; `world` says what the world radiates.
    pub fn build(
        scene: &Scene,
        emission: Vec<Option<MaterialEmission>>,
        world: Option<WorldRadiance>,
    ) -> Self {
        let analytic: Vec<LightOf> = scene
            .lights
            .iter()
            .zip(0..)
            .filter_map(|(l, i)| analytic::convert(l, i))
            .collect();
        let limit = tree::MAX_EMITTERS - analytic.len().min(tree::MAX_EMITTERS);
        let triangles = Triangles::collect(scene, &emission, limit);
        let (suns, local): (Vec<u32>, Vec<u32>) =
            (0..analytic.len() as u32).partition(|&i| escape::is_sun(&analytic[i as usize].shape));
        let mut bounds: Vec<_> = triangles
            .list
            .iter()
            .filter_map(|t| {
                Some(triangles::bounds(
                    t,
                    emission[t.material as usize].as_ref()?,
                ))
            })
            .collect();
        bounds.extend(
            local
                .iter()
                .map(|&i| analytic::bounds(&analytic[i as usize].shape)),
        );
        let tree = LightTree::build(&bounds);
        let world = world.filter(|_| scene.world.importance_sample);
        let distant = Distant::new(&analytic, suns, world, scene.world.visibility);
        let bvh = LightBvh::build(&analytic);
        Self {
            triangles,
            emission,
            analytic,
            tree,
            local,
            distant,
            bvh,
        }
    }

    /// True where nothing can be sampled.
    pub fn is_empty(&self) -> bool {
        self.tree.is_empty() && self.distant.is_empty()
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
        self.triangles.bytes() + self.tree.bytes() + self.distant.bytes()
    }

    /// Samples a light and a direction to it. `u_select` and `u` are in [0, 1).
    pub fn sample(&self, p: Vec3, n: Vec3, u_select: f32, u: Vec2) -> Option<LightSample> {
        let shares = self.shares(p, n);
        let (share, rest) = shares.choose(u_select)?;
        match share {
            Share::Tree => self.sample_tree(p, n, rest, u, shares.tree),
            Share::World => self.distant.sample_world(n, u, shares.world),
            Share::Sun => {
                let (sun, probability) = self.distant.choose_sun(n, rest)?;
                self.sample_analytic(sun, p, n, u, shares.suns * probability)
            }
        }
    }

    fn shares(&self, p: Vec3, n: Vec3) -> escape::Shares {
        if self.distant.is_empty() {
            return escape::Shares {
                tree: 1.0,
                ..Default::default()
            };
        }
        let tree = if self.tree.is_empty() {
            0.0
        } else {
            self.tree.importance(p, n)
        };
        self.distant.shares(tree, n)
    }

    fn sample_tree(
        &self,
        p: Vec3,
        n: Vec3,
        select: f32,
        u: Vec2,
        share: f32,
    ) -> Option<LightSample> {
        let (emitter, probability) = self.tree.sample(p, n, select)?;
        let chosen = share * probability;
        match self.triangles.list.get(emitter as usize) {
            Some(_) => self.sample_triangle(emitter, p, u, chosen),
            None => {
                let light = *self
                    .local
                    .get(emitter as usize - self.triangles.list.len())?;
                self.sample_analytic(light, p, n, u, chosen)
            }
        }
    }

    fn sample_triangle(&self, emitter: u32, p: Vec3, u: Vec2, chosen: f32) -> Option<LightSample> {
        let triangle = &self.triangles.list[emitter as usize];
        let emission = self.emission[triangle.material as usize].as_ref()?;
        let sampled = light_triangle_sample(triangle.corners, p, u);
        let c = &triangle.corners;
        let point = c.a + (c.b - c.a) * sampled.uv.x + (c.c - c.a) * sampled.uv.y;
        let distance = (point - p).length();
        let wi = (point - p) / distance;
        let normal = triangle.normal();
        if !(sampled.pdf > 0.0 && distance > 0.0 && shines(emission.sides, normal, wi)) {
            return None;
        }
        let radiance = if emission.constant {
            Emission::Constant(emission.radiance)
        } else {
            Emission::Triangle {
                instance: triangle.instance,
                primitive: triangle.primitive,
                u: sampled.uv.x,
                v: sampled.uv.y,
            }
        };
        Some(LightSample {
            light: LightId::Triangle(emitter),
            wi,
            distance,
            point,
            normal,
            pdf: sampled.pdf * chosen,
            radiance,
            cast_shadow: true,
            mis: true,
            visibility: Visibility::default(),
            max_bounces: u32::MAX,
        })
    }

    fn sample_analytic(
        &self,
        index: u32,
        p: Vec3,
        n: Vec3,
        u: Vec2,
        chosen: f32,
    ) -> Option<LightSample> {
        let light = &self.analytic[index as usize];
        let sampled = light_direction_sample(light.shape, p, n, u);
        if !(sampled.pdf > 0.0 && sampled.distance > 0.0) {
            return None;
        }
        Some(LightSample {
            light: LightId::Analytic(index),
            wi: sampled.direction,
            distance: if sampled.distance < LIGHT_FAR {
                sampled.distance
            } else {
                f32::INFINITY
            },
            point: sampled.point,
            normal: sampled.normal,
            pdf: sampled.pdf * chosen,
            radiance: self.radiance(index, p, sampled.direction)?,
            cast_shadow: light.cast_shadow,
            mis: light.mis,
            visibility: light.visibility,
            max_bounces: light.max_bounces,
        })
    }

    /// What an analytic light radiates towards `p` from the direction `wi`; `None`: nothing.
    fn radiance(&self, index: u32, p: Vec3, wi: Vec3) -> Option<Emission> {
        let light = &self.analytic[index as usize];
        let attenuation = light_attenuation(light.shape, p, wi);
        let factor = light.shape.radiance * attenuation;
        (attenuation > 0.0).then_some(match light.tree {
            Some(tree) => Emission::Tree {
                light: index,
                tree,
                factor,
            },
            None => Emission::Constant(factor),
        })
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
        let Some(emitter) = self.triangles.find(instance, primitive) else {
            return 0.0;
        };
        let triangle = &self.triangles.list[emitter as usize];
        let Some(emission) = &self.emission[triangle.material as usize] else {
            return 0.0;
        };
        if !shines(emission.sides, triangle.normal(), wi) {
            return 0.0;
        }
        let chosen = self.shares(p, n).tree * self.tree.probability(emitter, p, n);
        chosen * light_triangle_pdf(triangle.corners, p, wi, distance)
    }

    /// Density with which `sample` finds the world in the unit direction `wi`.
    pub fn pdf_world(&self, p: Vec3, n: Vec3, wi: Vec3) -> f32 {
        self.shares(p, n).world * self.distant.pdf_world(n, wi)
    }

    /// Probability with which `sample` chooses an analytic light.
    fn probability_analytic(&self, index: u32, p: Vec3, n: Vec3) -> f32 {
        let shares = self.shares(p, n);
        if escape::is_sun(&self.analytic[index as usize].shape) {
            return shares.suns * self.distant.probability_sun(index, n);
        }
        let Ok(local) = self.local.binary_search(&index) else {
            return 0.0;
        };
        let emitter = self.triangles.list.len() + local;
        shares.tree * self.tree.probability(emitter as u32, p, n)
    }
}

/// True where a triangle with the given front normal shines against the direction `wi`.
fn shines(sides: Sides, normal: Vec3, wi: Vec3) -> bool {
    match sides {
        Sides::Both => true,
        Sides::Front => normal.dot(wi) < 0.0,
        Sides::Back => normal.dot(wi) > 0.0,
    }
}

#[cfg(test)]
mod tests;
