//! Lights that rays meet: analytic lights have a shape that some rays see.
//!
//! As in Cycles, lights do not block: a ray that meets one takes its radiance and goes on,
//! so a caller asks again behind the hit. A camera ray sees each light that is visible to
//! the camera; a scattered ray sees those that take part in multiple importance sampling.

use super::analytic::bounds;
use super::{Emission, LightId, LightOf, LightSet};
use crate::device::light_analytic::{
    LIGHT_POINT, light_direction_pdf, light_distance, light_sun_contains,
};
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
    /// True where something of this visibility is seen by the ray.
    pub fn sees(self, visibility: &Visibility) -> bool {
        match self {
            Self::Camera => visibility.camera,
            Self::Diffuse => visibility.diffuse,
            Self::Glossy => visibility.glossy,
            Self::Transmission => visibility.transmission,
        }
    }
}

/// An analytic light on the way of a ray.
#[derive(Clone, Copy, Debug)]
pub struct LightHit {
    /// Which light.
    pub light: LightId,
    /// Radiance towards the ray's origin.
    pub radiance: Emission,
    /// Density with which [`LightSet::sample`] finds the direction from the point of the last
    /// scattering, with the choice of the light.
    pub pdf: f32,
    /// Bounces after which the light still counts.
    pub max_bounces: u32,
}

fn sees(light: &LightOf, kind: RayKind) -> bool {
    kind.sees(&light.visibility) && (kind == RayKind::Camera || light.mis)
}

impl LightSet {
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
        self.bvh
            .intersect(self.analytic(), origin, direction, t_min, t_max, kind)
    }

    /// True where no ray can meet an analytic light, so that `intersect` need not be asked.
    pub fn nothing_to_meet(&self) -> bool {
        self.bvh.nodes.is_empty()
    }

    /// Radiance and density of a light that `intersect` found. `p` and `n` belong to the last
    /// scattering and `distance` counts from there.
    pub fn hit(&self, index: u32, p: Vec3, n: Vec3, wi: Vec3, distance: f32) -> Option<LightHit> {
        let light = self.analytic.get(index as usize)?;
        let chosen = self.probability_analytic(index, p, n);
        Some(LightHit {
            light: LightId::Analytic(index),
            radiance: self.radiance(index, p, wi)?,
            pdf: chosen * light_direction_pdf(light.shape, p, n, wi, distance),
            max_bounces: light.max_bounces,
        })
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
        self.distant.suns().filter_map(move |index| {
            let light = &self.analytic[index as usize];
            // Unlike other lights, a sun without multiple importance is not even on camera.
            let seen = light.mis && sees(light, kind) && light_sun_contains(light.shape, wi);
            if seen {
                self.hit(index, p, n, wi, f32::INFINITY)
            } else {
                None
            }
        })
    }
}

#[derive(Clone, Copy, Debug)]
struct BvhNode {
    low: Vec3,
    high: Vec3,
    /// Range of `order` for a leaf, first child and 0 for an inner node.
    first: u32,
    count: u32,
}

/// Lights of a leaf.
const LEAF: usize = 4;

/// A small hierarchy over the analytic lights with a shape.
#[derive(Clone, Debug, Default)]
pub struct LightBvh {
    nodes: Vec<BvhNode>,
    order: Vec<u32>,
}

impl LightBvh {
    /// Builds it by halving along the longest side.
    pub fn build(lights: &[LightOf]) -> Self {
        let has_shape =
            |l: &LightOf| !super::escape::is_sun(&l.shape) && l.shape.kind != LIGHT_POINT;
        let mut order: Vec<u32> = (0..lights.len() as u32)
            .filter(|&i| has_shape(&lights[i as usize]))
            .collect();
        let mut nodes = Vec::new();
        if !order.is_empty() {
            let end = order.len();
            nodes.push(BvhNode {
                low: Vec3::ZERO,
                high: Vec3::ZERO,
                first: 0,
                count: 0,
            });
            fill(&mut nodes, 0, &mut order, 0..end, lights);
        }
        Self { nodes, order }
    }

    fn intersect(
        &self,
        lights: &[LightOf],
        origin: Vec3,
        direction: Vec3,
        t_min: f32,
        t_max: f32,
        kind: RayKind,
    ) -> Option<(u32, f32)> {
        if self.nodes.is_empty() {
            return None;
        }
        let inverse = direction.recip();
        let mut found = None;
        let mut nearest = t_max;
        // Halving keeps the depth below 32, and each level leaves one node behind.
        let mut stack = [0u32; 34];
        let mut size = 1;
        while size > 0 {
            size -= 1;
            let node = &self.nodes[stack[size] as usize];
            if !meets(node, origin, inverse, t_min, nearest) {
                continue;
            }
            if node.count == 0 {
                stack[size] = node.first;
                stack[size + 1] = node.first + 1;
                size += 2;
                continue;
            }
            for &index in &self.order[node.first as usize..(node.first + node.count) as usize] {
                let light = &lights[index as usize];
                let t = light_distance(light.shape, origin, direction);
                if t > t_min && t < nearest && sees(light, kind) {
                    nearest = t;
                    found = Some((index, t));
                }
            }
        }
        found
    }
}

fn meets(node: &BvhNode, origin: Vec3, inverse: Vec3, t_min: f32, t_max: f32) -> bool {
    let a = (node.low - origin) * inverse;
    let b = (node.high - origin) * inverse;
    // `min` and `max` take the number where the other side is none (0 · ∞).
    let near = (0..3).map(|i| a[i].min(b[i])).fold(t_min, f32::max);
    let far = (0..3).map(|i| a[i].max(b[i])).fold(t_max, f32::min);
    near <= far * 1.000_001
}

fn fill(
    nodes: &mut Vec<BvhNode>,
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
        nodes[at] = BvhNode {
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
    let blank = BvhNode {
        low,
        high,
        first: 0,
        count: 0,
    };
    nodes.extend([blank, blank]);
    nodes[at] = BvhNode {
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
