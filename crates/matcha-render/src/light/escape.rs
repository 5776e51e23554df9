//! Lights at infinity.

use super::world::{WorldGrid, WorldMap};
use crate::device::light_view::LightView;
use glam::Vec3;

/// The suns and the world.
#[derive(Clone, Debug, Default)]
pub struct Distant {
    suns: Vec<u32>,
    world: Option<WorldMap>,
    /// Which rays see the world: `RAY_` bits.
    visibility: u32,
}

impl Distant {
    /// Prepares the suns (indices of analytic lights) and the world.
    pub fn new(suns: Vec<u32>, world: Option<WorldGrid>, visibility: u32) -> Self {
        Self {
            suns,
            world: world.as_ref().and_then(WorldMap::new),
            visibility,
        }
    }

    /// Luminous irradiance that the world's mean radiance brings to one side, W·m⁻²; none
    /// where the world is not sampled.
    pub fn world_irradiance(&self) -> Option<f32> {
        Some(self.world.as_ref()?.irradiance(Vec3::ZERO))
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.suns[..]) + self.world.as_ref().map_or(0, WorldMap::bytes)
    }

    /// The suns' indices.
    pub fn suns(&self) -> &[u32] {
        &self.suns
    }

    /// The suns and the world without other lights.
    #[inline(always)]
    pub fn view(&self) -> LightView<'_> {
        LightView {
            suns: &self.suns,
            world_visibility: self.visibility,
            ..self
                .world
                .as_ref()
                .map_or_else(LightView::default, WorldMap::view)
        }
    }
}
