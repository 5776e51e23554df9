//! Lights at infinity.

use super::world::{WorldMap, WorldRadiance, luminance};
use crate::device::light_view::{LIGHT_WORLD_CONSTANT, LightView};
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
    suns: Vec<u32>,
    world: Option<World>,
    /// Which rays see the world: `RAY_` bits.
    visibility: u32,
}

impl Distant {
    /// Prepares the suns (indices of analytic lights) and the world.
    pub fn new(suns: Vec<u32>, world: Option<WorldRadiance>, visibility: u32) -> Self {
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
            suns,
            world,
            visibility,
        }
    }

    /// Luminous irradiance that the world's mean radiance brings to one side, W·m⁻²; none
    /// where the world is not sampled.
    pub fn world_irradiance(&self) -> Option<f32> {
        match &self.world {
            Some(World::Constant { irradiance, .. }) => Some(*irradiance),
            Some(World::Map(map)) => Some(map.irradiance(Vec3::ZERO)),
            None => None,
        }
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.suns[..])
            + match &self.world {
                Some(World::Map(map)) => map.bytes(),
                _ => 0,
            }
    }

    /// The suns' indices.
    pub fn suns(&self) -> &[u32] {
        &self.suns
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
