//! What rays are to lights, and the hierarchy over the lights that rays can meet.

use super::analytic::{bounds, is_sun};
use super::{Emission, LightId};
use crate::accel::visibility_mask;
use crate::device::light_analytic::LIGHT_POINT;
use crate::device::light_view::{LightBox, LightOf, LightView};
use crate::device::ray_kind::{RAY_CAMERA, RAY_DIFFUSE, RAY_GLOSSY, RAY_TRANSMISSION};
use crate::scene::Visibility;
use glam::Vec3;

/// What a ray was scattered by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayKind {
    /// The camera, perhaps through transparent surfaces.
    Camera,
    /// A diffuse closure.
    Diffuse,
    /// A glossy closure.
    Glossy,
    /// A transmitting closure.
    Transmission,
}

impl RayKind {
    /// Its `RAY_` bit.
    pub fn bit(self) -> u32 {
        match self {
            Self::Camera => RAY_CAMERA,
            Self::Diffuse => RAY_DIFFUSE,
            Self::Glossy => RAY_GLOSSY,
            Self::Transmission => RAY_TRANSMISSION,
        }
    }

    /// True where something of this visibility is seen by the ray.
    pub fn sees(self, visibility: &Visibility) -> bool {
        u32::from(visibility_mask(visibility)) & self.bit() != 0
    }
}

/// An analytic light on the way of a ray.
#[derive(Clone, Copy, Debug)]
pub struct LightHit {
    /// Which light.
    pub light: LightId,
    /// Radiance towards the ray's origin.
    pub radiance: Emission,
    /// Density with which `LightSet::sample` finds the direction from the point of the last
    /// scattering, with the choice of the light.
    pub pdf: f32,
    /// Bounces after which the light still counts.
    pub max_bounces: u32,
}

/// Lights of a leaf.
const LEAF: usize = 4;

/// A small hierarchy over the analytic lights with a shape.
#[derive(Clone, Debug, Default)]
pub struct LightBvh {
    nodes: Vec<LightBox>,
    order: Vec<u32>,
}

impl LightBvh {
    /// Builds it by halving along the longest side.
    pub fn build(lights: &[LightOf]) -> Self {
        let has_shape = |l: &LightOf| !is_sun(&l.shape) && l.shape.kind != LIGHT_POINT;
        let mut order: Vec<u32> = (0..lights.len() as u32)
            .filter(|&i| has_shape(&lights[i as usize]))
            .collect();
        let mut nodes = Vec::new();
        if !order.is_empty() {
            let end = order.len();
            nodes.push(LightBox {
                low: Vec3::ZERO,
                high: Vec3::ZERO,
                first: 0,
                count: 0,
            });
            fill(&mut nodes, 0, &mut order, 0..end, lights);
        }
        Self { nodes, order }
    }

    /// The hierarchy without the lights.
    #[inline(always)]
    pub fn view(&self) -> LightView<'_> {
        LightView {
            boxes: &self.nodes,
            order: &self.order,
            ..LightView::default()
        }
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..]) + size_of_val(&self.order[..])
    }

    /// True without lights that a ray could meet.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }
}

fn fill(
    nodes: &mut Vec<LightBox>,
    at: usize,
    order: &mut [u32],
    range: std::ops::Range<usize>,
    lights: &[LightOf],
) {
    let boxes = |i: &u32| bounds(&lights[*i as usize].shape);
    let part = &mut order[range.clone()];
    let low = part
        .iter()
        .map(|i| boxes(i).low)
        .fold(Vec3::INFINITY, Vec3::min);
    let high = part
        .iter()
        .map(|i| boxes(i).high)
        .fold(Vec3::NEG_INFINITY, Vec3::max);
    // Flat lights need some thickness against rounding.
    let margin = Vec3::splat(1e-5) * (Vec3::ONE + low.abs().max(high.abs()));
    let (low, high) = (low - margin, high + margin);
    if part.len() <= LEAF {
        nodes[at] = LightBox {
            low,
            high,
            first: range.start as u32,
            count: part.len() as u32,
        };
        return;
    }
    let axis = (high - low).max_position();
    let middle = part.len() / 2;
    part.select_nth_unstable_by(middle, |a, b| {
        let centre = |i| (boxes(i).low + boxes(i).high)[axis];
        centre(a).total_cmp(&centre(b)).then(a.cmp(b))
    });
    let first = nodes.len();
    let blank = LightBox {
        low,
        high,
        first: 0,
        count: 0,
    };
    nodes.extend([blank, blank]);
    nodes[at] = LightBox {
        low,
        high,
        first: first as u32,
        count: 0,
    };
    fill(
        nodes,
        first,
        order,
        range.start..range.start + middle,
        lights,
    );
    fill(
        nodes,
        first + 1,
        order,
        range.start + middle..range.end,
        lights,
    );
}
