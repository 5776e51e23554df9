//! What the world radiates, and its importance map; sampling is in
//! [`crate::device::light_world`].

use crate::device::light_view::LightView;
use crate::device::light_world::{light_world_factor, light_world_pdf, light_world_sample};
use glam::{Vec2, Vec3};
use std::f32::consts::{PI, TAU};

/// Luminance of linear Rec.709 (ITU-R BT.709).
pub fn luminance(rgb: Vec3) -> f32 {
    rgb.dot(Vec3::new(0.2126, 0.7152, 0.0722))
}

/// Radiance samples of the world on an equirectangular grid. They guide light sampling only: radiance
/// is evaluated where it is needed.
#[derive(Clone, Debug)]
pub struct WorldGrid {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Radiance at [`grid_direction`] of each texel, row by row from the top (+Z).
    pub radiance: Vec<Vec3>,
}

/// Direction of a position on the grid, in texels from the top left; texel centres are at
/// halves. The column's azimuth is Blender's: the middle looks along +X and the azimuth
/// falls from left to right.
pub fn grid_direction(x: f32, y: f32, width: u32, height: u32) -> Vec3 {
    let azimuth = PI - TAU * x / width as f32;
    let (sine, cosine) = (PI * y / height as f32).sin_cos();
    Vec3::new(sine * azimuth.cos(), sine * azimuth.sin(), cosine)
}

/// A sampling density over directions made from a grid.
#[derive(Clone, Debug)]
pub struct WorldMap {
    width: u32,
    height: u32,
    /// As [`crate::device::light_world`] lays it out.
    tables: Vec<f32>,
    /// Spherical harmonics of the luminance.
    harmonics: [f32; 9],
    /// Irradiance of the mean luminance on one side.
    mean_irradiance: f32,
}

/// Share of the samples that the map spreads evenly: radiance between the grid's samples
/// may be larger than at them.
const EVEN: f32 = 0.02;

impl WorldMap {
    /// Makes the density; `None` for a grid without any light or without the texels that
    /// its size asks for.
    pub fn new(grid: &WorldGrid) -> Option<Self> {
        let (width, height) = (grid.width as usize, grid.height as usize);
        if width == 0 || height == 0 || grid.radiance.len() != width * height {
            return None;
        }
        let value = |x: usize, y: usize| {
            let l = luminance(grid.radiance[y * width + x]);
            if l.is_finite() { l.max(0.0) } else { 0.0 }
        };
        let row_angle = |y: usize| row_solid_angle(y, height) / width as f64;
        let total: f64 = (0..height)
            .map(|y| (0..width).map(|x| f64::from(value(x, y))).sum::<f64>() * row_angle(y))
            .sum();
        if total <= 0.0 {
            return None;
        }
        let even = f64::from(EVEN) * total / (4.0 * std::f64::consts::PI);
        let mut texels = Vec::with_capacity((width + 1) * height);
        let mut row_sums = Vec::with_capacity(height);
        for y in 0..height {
            let weights = (0..width).map(|x| f64::from(spread(&value, x, y, width, height)) + even);
            row_sums.push(push_cumulative(&mut texels, weights) * row_angle(y));
        }
        let mut tables = Vec::with_capacity(3 * height + 2 + texels.len());
        push_cumulative(&mut tables, row_sums.into_iter());
        tables.extend((0..=height).map(|y| edge_cosine(y, height)));
        tables.extend((0..height).map(|y| row_solid_angle(y, height) as f32 / width as f32));
        tables.extend(texels);
        Some(Self {
            width: grid.width,
            height: grid.height,
            tables,
            harmonics: harmonics(&value, width, height),
            mean_irradiance: (total * 0.25) as f32,
        })
    }

    /// The map without other lights.
    #[inline(always)]
    pub fn view(&self) -> LightView<'_> {
        LightView {
            world: &self.tables,
            world_width: self.width,
            world_height: self.height,
            world_irradiance: self.mean_irradiance,
            world_harmonics: self.harmonics,
            ..LightView::default()
        }
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.tables[..])
    }

    /// Estimate of the irradiance at a surface with unit normal `n`; zero `n`: mean of both sides.
    pub fn irradiance(&self, n: Vec3) -> f32 {
        self.mean_irradiance * light_world_factor(self.view(), n)
    }

    /// A direction for `u` in [0, 1)², with its density over solid angle.
    pub fn sample(&self, u: Vec2) -> (Vec3, f32) {
        let sampled = light_world_sample(self.view(), u);
        (sampled.direction, sampled.pdf)
    }

    /// Density over solid angle with which `sample` finds a unit direction.
    pub fn pdf(&self, direction: Vec3) -> f32 {
        light_world_pdf(self.view(), direction)
    }
}

/// Cosine of the polar angle at the upper edge of a row.
fn edge_cosine(y: usize, height: usize) -> f32 {
    (std::f64::consts::PI * y as f64 / height as f64).cos() as f32
}

/// Solid angle of a row of an equirectangular grid, steradians.
fn row_solid_angle(y: usize, height: usize) -> f64 {
    let step = std::f64::consts::PI / height as f64;
    // Difference of cosines without cancellation at the poles.
    2.0 * std::f64::consts::TAU * ((y as f64 + 0.5) * step).sin() * (0.5 * step).sin()
}

/// A texel's weight: half its own value, half the mean of its neighbourhood, since radiance
/// between samples is unknown.
fn spread(
    value: &impl Fn(usize, usize) -> f32,
    x: usize,
    y: usize,
    width: usize,
    height: usize,
) -> f32 {
    let mut sum = 0.0;
    for row in [y.saturating_sub(1), y, (y + 1).min(height - 1)] {
        for column in [(x + width - 1) % width, x, (x + 1) % width] {
            sum += value(column, row);
        }
    }
    0.5 * value(x, y) + sum / 18.0
}

/// Appends the normalised cumulative sums of the weights (one more than there are weights);
/// returns their sum.
fn push_cumulative(to: &mut Vec<f32>, weights: impl Iterator<Item = f64>) -> f64 {
    let start = to.len();
    let mut sums = vec![0.0];
    for weight in weights {
        sums.push(sums[sums.len() - 1] + weight);
    }
    let total = sums[sums.len() - 1];
    to.extend(sums.iter().map(|s| (s / total) as f32));
    debug_assert!(to.len() > start);
    total
}

/// Real spherical harmonics of a luminance on the grid, bands 0 to 2.
fn harmonics(value: &impl Fn(usize, usize) -> f32, width: usize, height: usize) -> [f32; 9] {
    let mut sums = [0.0f64; 9];
    for y in 0..height {
        let angle = row_solid_angle(y, height) / width as f64;
        for x in 0..width {
            let d = grid_direction(x as f32 + 0.5, y as f32 + 0.5, width as u32, height as u32);
            let weight = f64::from(value(x, y)) * angle;
            for (sum, basis) in sums.iter_mut().zip(basis(d)) {
                *sum += f64::from(basis) * weight;
            }
        }
    }
    sums.map(|s| s as f32)
}

fn basis(d: Vec3) -> [f32; 9] {
    [
        0.282_095,
        0.488_603 * d.y,
        0.488_603 * d.z,
        0.488_603 * d.x,
        1.092_548 * d.x * d.y,
        1.092_548 * d.y * d.z,
        0.315_392 * (3.0 * d.z * d.z - 1.0),
        1.092_548 * d.x * d.z,
        0.546_274 * (d.x * d.x - d.y * d.y),
    ]
}
