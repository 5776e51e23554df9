//! The film: sums of what the samples of each pixel brought.
//!
//! A sample adds to its own pixel only (filter importance sampling), so a tile belongs to
//! one thread and the sums do not depend on how many threads there are.

pub mod filter;

use glam::Vec3;

/// Sums over the samples of one pixel.
pub use crate::device::path_state::FilmSums as PixelSums;

impl PixelSums {
    /// No samples.
    pub const EMPTY: Self = Self {
        radiance: Vec3::ZERO,
        alpha: 0.0,
        albedo: Vec3::ZERO,
        normal: Vec3::ZERO,
        depth: 0.0,
        depth_samples: 0.0,
        nodes_found: 0.0,
        samples: 0.0,
    };

    /// Adds the sums of another set of samples.
    pub fn add(&mut self, other: &PixelSums) {
        self.radiance += other.radiance;
        self.alpha += other.alpha;
        self.albedo += other.albedo;
        self.normal += other.normal;
        self.depth += other.depth;
        self.depth_samples += other.depth_samples;
        self.nodes_found += other.nodes_found;
        self.samples += other.samples;
    }

    fn per_sample(&self) -> f32 {
        if self.samples > 0.0 {
            1.0 / self.samples
        } else {
            0.0
        }
    }
}

impl Default for PixelSums {
    fn default() -> Self {
        Self::EMPTY
    }
}

/// A picture in the making. Row 0 is the top.
#[derive(Clone, Debug)]
pub struct Film {
    width: u32,
    height: u32,
    exposure: f32,
    pixels: Vec<PixelSums>,
}

impl Film {
    /// A black film of `width` × `height` pixels; radiance is multiplied by `exposure` when read.
    pub fn new(width: u32, height: u32, exposure: f32) -> Self {
        let pixels = vec![PixelSums::default(); width as usize * height as usize];
        Self {
            width,
            height,
            exposure,
            pixels,
        }
    }

    /// Width in pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        self.pixels.len() * size_of::<PixelSums>()
    }

    /// Bytes that a film of some size would take.
    pub fn bytes_of([width, height]: [u32; 2]) -> u64 {
        u64::from(width) * u64::from(height) * size_of::<PixelSums>() as u64
    }

    /// Adds sums of the pixel with a number, rows from the top.
    pub fn add_pixel(&mut self, pixel: usize, sums: &PixelSums) {
        self.pixels[pixel].add(sums);
    }

    /// Adds a tile's sums, row by row.
    pub fn add_tile(&mut self, tile: &Tile, sums: &[PixelSums]) {
        for (row, line) in sums.chunks(tile.width as usize).enumerate() {
            let start = (tile.y as usize + row) * self.width as usize + tile.x as usize;
            for (pixel, sum) in self.pixels[start..start + line.len()].iter_mut().zip(line) {
                pixel.add(sum);
            }
        }
    }

    /// Smallest number of samples that a pixel has.
    pub fn samples(&self) -> u32 {
        self.pixels
            .iter()
            .map(|p| p.samples as u32)
            .min()
            .unwrap_or(0)
    }

    /// Number of samples of all pixels together.
    pub fn total_samples(&self) -> u64 {
        self.pixels.iter().map(|p| p.samples as u64).sum()
    }

    /// Number of nodes found in the cache, over all samples.
    pub fn total_nodes_found(&self) -> u64 {
        self.pixels
            .iter()
            .map(|p| f64::from(p.nodes_found))
            .sum::<f64>() as u64
    }

    /// The picture, linear Rec.709 with premultiplied alpha, row by row.
    pub fn combined(&self) -> Vec<[f32; 4]> {
        self.map(|p| {
            let color = p.radiance * p.per_sample() * self.exposure;
            let alpha = (p.alpha * p.per_sample()).clamp(0.0, 1.0);
            color.extend(alpha).to_array()
        })
    }

    /// Albedo layer.
    pub fn albedo(&self) -> Vec<[f32; 3]> {
        self.map(|p| (p.albedo * p.per_sample()).to_array())
    }

    /// Normal layer, world space; zero where nothing is hit.
    pub fn normal(&self) -> Vec<[f32; 3]> {
        self.map(|p| (p.normal * p.per_sample()).to_array())
    }

    /// Mean depth of the samples that hit something, metres; infinite where none did.
    pub fn depth(&self) -> Vec<f32> {
        self.map(|p| {
            if p.depth_samples > 0.0 {
                p.depth / p.depth_samples
            } else {
                f32::INFINITY
            }
        })
    }

    /// Mean number of nodes found in the cache per sample (the paper's heat map).
    pub fn nodes_found(&self) -> Vec<f32> {
        self.map(|p| p.nodes_found * p.per_sample())
    }

    fn map<T>(&self, read: impl Fn(&PixelSums) -> T) -> Vec<T> {
        self.pixels.iter().map(read).collect()
    }
}

/// A rectangle of pixels that one thread renders at a time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tile {
    /// Left edge.
    pub x: u32,
    /// Top edge.
    pub y: u32,
    /// Width, at most [`TILE_SIZE`].
    pub width: u32,
    /// Height, at most [`TILE_SIZE`].
    pub height: u32,
}

/// Edge of a tile in pixels. Neighbouring paths meet the same materials and texels; a
/// tile of this size fills several batches, so that few paths are left alone at its end.
pub const TILE_SIZE: u32 = 32;

impl Tile {
    /// All tiles of a picture, row by row.
    pub fn cover(width: u32, height: u32) -> Vec<Tile> {
        let starts = |end: u32| (0..end).step_by(TILE_SIZE as usize);
        starts(height)
            .flat_map(|y| {
                starts(width).map(move |x| Tile {
                    x,
                    y,
                    width: TILE_SIZE.min(width - x),
                    height: TILE_SIZE.min(height - y),
                })
            })
            .collect()
    }

    /// Number of pixels.
    pub fn pixels(&self) -> u32 {
        self.width * self.height
    }

    /// Column and row of a pixel of the tile in the picture.
    pub fn pixel(&self, index: u32) -> [u32; 2] {
        [self.x + index % self.width, self.y + index / self.width]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_cover_every_pixel_once() {
        let (width, height) = (100, 67);
        let mut seen = vec![0; (width * height) as usize];
        for tile in Tile::cover(width, height) {
            for i in 0..tile.pixels() {
                let [x, y] = tile.pixel(i);
                seen[(y * width + x) as usize] += 1;
            }
        }
        assert!(seen.iter().all(|&n| n == 1));
    }

    #[test]
    fn the_mean_is_over_samples_and_exposed() {
        let mut film = Film::new(2, 1, 2.0);
        let tile = Tile {
            x: 1,
            y: 0,
            width: 1,
            height: 1,
        };
        let sample = PixelSums {
            radiance: Vec3::new(1.0, 2.0, 3.0),
            alpha: 1.0,
            samples: 2.0,
            ..Default::default()
        };
        film.add_tile(&tile, &[sample]);
        film.add_tile(&tile, &[sample]);
        assert_eq!(film.combined()[1], [1.0, 2.0, 3.0, 0.5]);
        assert_eq!(film.combined()[0], [0.0; 4]);
        assert_eq!(film.samples(), 0);
    }
}
