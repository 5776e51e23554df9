//! Lights at infinity, and how often each kind of light is tried.

use super::analytic::sun_irradiance;
use super::world::{WorldMap, WorldRadiance, luminance};
use super::{Emission, LightId, LightOf, LightSample};
use crate::device::light_analytic::{AnalyticLight, LIGHT_SHARP_SUN, LIGHT_SUN};
use crate::device::light_importance::{light_cos_reduced, light_sine};
use crate::device::mapping::{mapping_cone, mapping_cosine, mapping_frame, mapping_place};
use crate::scene::Visibility;
use glam::{Vec2, Vec3};
use std::f32::consts::{FRAC_1_PI, PI};

/// True for lights at infinity.
pub fn is_sun(light: &AnalyticLight) -> bool {
    light.kind == LIGHT_SUN || light.kind == LIGHT_SHARP_SUN
}

/// Kinds of lights that share the samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Share {
    /// Local lights.
    Tree,
    /// The suns together.
    Sun,
    /// The world.
    World,
}

/// Probability of each kind at a point; they sum to one, or to zero where nothing shines.
#[derive(Clone, Copy, Debug, Default)]
pub struct Shares {
    /// Local lights.
    pub tree: f32,
    /// The suns together.
    pub suns: f32,
    /// The world.
    pub world: f32,
}

impl Shares {
    /// From estimates of irradiance.
    fn new(tree: f32, suns: f32, world: f32) -> Self {
        let finite = |x: f32| if x > 0.0 { x.min(1e30) } else { 0.0 };
        let [tree, suns, world] = [tree, suns, world].map(finite);
        let sum = tree + suns + world;
        if sum <= 0.0 {
            return Self::default();
        }
        let kinds = [tree, suns, world].map(|x| f32::from(u8::from(x > 0.0)));
        let even = 0.5 / (kinds[0] + kinds[1] + kinds[2]);
        let of = |x: f32, there: f32| there * even + 0.5 * x / sum;
        Self {
            tree: of(tree, kinds[0]),
            suns: of(suns, kinds[1]),
            world: of(world, kinds[2]),
        }
    }

    /// Kind that `u` in [0, 1) falls to, and the place of `u` inside of its share.
    pub fn choose(&self, u: f32) -> Option<(Share, f32)> {
        let mut start = 0.0;
        let mut last = None;
        for (share, kind) in [
            (self.tree, Share::Tree),
            (self.suns, Share::Sun),
            (self.world, Share::World),
        ] {
            if share > 0.0 {
                let place = ((u - start) / share).clamp(0.0, super::tree::ONE_BELOW);
                last = Some((kind, place));
                if u < start + share {
                    return last;
                }
                start += share;
            }
        }
        // Rounding may leave a last sliver.
        last
    }
}

#[derive(Clone, Debug)]
enum World {
    Constant(Vec3),
    Map(WorldMap),
}

/// The suns and the world.
#[derive(Clone, Debug, Default)]
pub struct Distant {
    suns: Vec<Sun>,
    world: Option<World>,
    /// Which closures see the world.
    visibility: Visibility,
}

#[derive(Clone, Copy, Debug)]
struct Sun {
    index: u32,
    towards: Vec3,
    cos_half: f32,
    irradiance: f32,
}

impl Sun {
    /// Largest irradiance that the sun can bring to a surface with normal `n`.
    fn irradiance_on(&self, n: Vec3) -> f32 {
        if n == Vec3::ZERO {
            return self.irradiance;
        }
        let cosine = light_cos_reduced(n.dot(self.towards), self.cos_half);
        // A disc that straddles the horizon still counts a little.
        let rim = if cosine > 0.0 {
            1e-3 * light_sine(self.cos_half)
        } else {
            0.0
        };
        self.irradiance * cosine.max(rim)
    }
}

impl Distant {
    /// Prepares the suns (indices into `lights`) and the world.
    pub fn new(
        lights: &[LightOf],
        suns: Vec<u32>,
        world: Option<WorldRadiance>,
        visibility: Visibility,
    ) -> Self {
        let sun = |index: u32| {
            let shape = &lights[index as usize].shape;
            let sharp = shape.kind == LIGHT_SHARP_SUN;
            let cos_half = if sharp {
                1.0
            } else {
                1.0 - shape.one_minus_cos
            };
            Sun {
                index,
                towards: -shape.axes.z,
                cos_half,
                irradiance: sun_irradiance(shape),
            }
        };
        let world = match world {
            Some(WorldRadiance::Constant(c)) => {
                (c != Vec3::ZERO && c.is_finite()).then_some(World::Constant(c))
            }
            Some(WorldRadiance::Grid(grid)) => WorldMap::new(&grid).map(World::Map),
            None => None,
        };
        Self {
            suns: suns.into_iter().map(sun).collect(),
            world,
            visibility,
        }
    }

    pub fn is_empty(&self) -> bool {
        self.suns.is_empty() && self.world.is_none()
    }

    pub fn bytes(&self) -> usize {
        size_of_val(&self.suns[..])
            + match &self.world {
                Some(World::Map(map)) => map.bytes(),
                _ => 0,
            }
    }

    /// Indices of the suns.
    pub fn suns(&self) -> impl Iterator<Item = u32> {
        self.suns.iter().map(|s| s.index)
    }

    /// Shares at a surface with normal `n`, given the irradiance estimated of the tree.
    pub fn shares(&self, tree: f32, n: Vec3) -> Shares {
        let suns = self.suns.iter().map(|s| s.irradiance_on(n)).sum();
        let world = match &self.world {
            Some(World::Constant(c)) => (PI * luminance(c.abs())).max(1e-12),
            Some(World::Map(map)) => map.irradiance(n),
            None => 0.0,
        };
        Shares::new(tree, suns, world)
    }

    /// Chooses a sun by its irradiance; its index and probability.
    pub fn choose_sun(&self, n: Vec3, u: f32) -> Option<(u32, f32)> {
        let sum: f32 = self.suns.iter().map(|s| s.irradiance_on(n)).sum();
        let mut left = u * sum;
        let mut last = None;
        for sun in &self.suns {
            let irradiance = sun.irradiance_on(n);
            if irradiance > 0.0 {
                last = Some((sun.index, irradiance / sum));
                if left < irradiance {
                    return last;
                }
                left -= irradiance;
            }
        }
        last
    }

    /// Probability with which `choose_sun` chooses a sun.
    pub fn probability_sun(&self, index: u32, n: Vec3) -> f32 {
        let sum: f32 = self.suns.iter().map(|s| s.irradiance_on(n)).sum();
        let sun = self.suns.iter().find(|s| s.index == index);
        sun.filter(|_| sum > 0.0)
            .map_or(0.0, |s| s.irradiance_on(n) / sum)
    }

    /// Samples the world: its map, or where it is constant the cosine around `n`.
    pub fn sample_world(&self, n: Vec3, u: Vec2, share: f32) -> Option<LightSample> {
        let (wi, pdf, radiance) = match self.world.as_ref()? {
            World::Constant(c) => {
                let wi = if n == Vec3::ZERO {
                    mapping_cone(u, 2.0)
                } else {
                    let local = mapping_cosine(u);
                    mapping_place(mapping_frame(n), local.x, local.y, local.z)
                };
                (wi, pdf_constant(n, wi), Emission::Constant(*c))
            }
            World::Map(map) => {
                let (wi, pdf) = map.sample(u);
                (wi, pdf, Emission::World)
            }
        };
        (pdf > 0.0).then_some(LightSample {
            light: LightId::World,
            wi,
            distance: f32::INFINITY,
            point: wi,
            normal: -wi,
            pdf: pdf * share,
            radiance,
            cast_shadow: true,
            mis: true,
            visibility: self.visibility,
            max_bounces: u32::MAX,
        })
    }

    /// Density of `sample_world` without the share.
    pub fn pdf_world(&self, n: Vec3, wi: Vec3) -> f32 {
        match &self.world {
            Some(World::Constant(_)) => pdf_constant(n, wi),
            Some(World::Map(map)) => map.pdf(wi),
            None => 0.0,
        }
    }
}

/// Density of directions to a constant world.
fn pdf_constant(n: Vec3, wi: Vec3) -> f32 {
    if n == Vec3::ZERO {
        0.25 * FRAC_1_PI
    } else {
        n.dot(wi).max(0.0) * FRAC_1_PI
    }
}
