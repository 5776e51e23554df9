//! Lights at infinity.

use super::analytic::sun_irradiance;
use super::world::{WorldMap, WorldRadiance, luminance};
use crate::device::light_analytic::LIGHT_SHARP_SUN;
use crate::device::light_view::{LIGHT_WORLD_CONSTANT, LightOf, LightSun, LightView};
use glam::Vec3;
use std::f32::consts::PI;

#[derive(Clone, Debug)]
enum World {
    Constant {
        radiance: Vec3,
        /// Luminous, on one side.
        irradiance: f32,
    },
    Map(WorldMap),
}

/// The suns and the world.
#[derive(Clone, Debug, Default)]
pub struct Distant {
    suns: Vec<LightSun>,
    world: Option<World>,
    /// Which rays see the world: `RAY_` bits.
    visibility: u32,
}

impl Distant {
    /// Prepares the suns (indices into `lights`) and the world.
    pub fn new(
        lights: &[LightOf],
        suns: &[u32],
        world: Option<WorldRadiance>,
        visibility: u32,
    ) -> Self {
        let sun = |&index: &u32| {
            let shape = &lights[index as usize].shape;
            let sharp = shape.kind == LIGHT_SHARP_SUN;
            let cos_half = if sharp {
                1.0
            } else {
                1.0 - shape.one_minus_cos
            };
            LightSun {
                index,
                towards: -shape.axes.z,
                cos_half,
                irradiance: sun_irradiance(shape),
            }
        };
        let world = match world {
            Some(WorldRadiance::Constant(c)) => {
                (c != Vec3::ZERO && c.is_finite()).then(|| World::Constant {
                    radiance: c,
                    irradiance: (PI * luminance(c.abs())).max(1e-12),
                })
            }
            Some(WorldRadiance::Grid(grid)) => WorldMap::new(&grid).map(World::Map),
            None => None,
        };
        Self {
            suns: suns.iter().map(sun).collect(),
            world,
            visibility,
        }
    }

    /// Without suns and without a world that is sampled.
    pub fn is_empty(&self) -> bool {
        self.suns.is_empty() && self.world.is_none()
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.suns[..])
            + match &self.world {
                Some(World::Map(map)) => map.bytes(),
                _ => 0,
            }
    }

    /// Number of suns.
    pub fn suns(&self) -> u32 {
        self.suns.len() as u32
    }

    /// The suns and the world without other lights.
    #[inline(always)]
    pub fn view(&self) -> LightView<'_> {
        let world = match &self.world {
            Some(World::Constant {
                radiance,
                irradiance,
            }) => LightView {
                world_kind: LIGHT_WORLD_CONSTANT,
                world_radiance: *radiance,
                world_irradiance: *irradiance,
                ..LightView::default()
            },
            Some(World::Map(map)) => map.view(),
            None => LightView::default(),
        };
        LightView {
            suns: &self.suns,
            world_visibility: self.visibility,
            ..world
        }
    }
}
