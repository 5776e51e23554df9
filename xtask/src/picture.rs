//! Reading EXR pictures and comparing them.

use anyhow::{Context, Result, ensure};
use std::path::Path;

/// A picture, linear Rec.709.
pub struct Picture {
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Pixels, top row first.
    pub pixels: Vec<[f32; 3]>,
}

/// How far a picture is from its reference.
pub struct Difference {
    /// Mean of each channel over the reference's.
    pub channel_ratio: [f64; 3],
    /// Mean FLIP error (Andersson et al. 2020), 67 pixels per degree.
    pub flip_mean: f32,
    /// Mean of (a − b)² / (b² + 0.01).
    pub rel_mse: f64,
}

impl Picture {
    /// Reads the first RGB(A) layer of an EXR file.
    pub fn read(path: &Path) -> Result<Self> {
        let image = exr::prelude::read_first_rgba_layer_from_file(
            path,
            |size, _| (size.width(), vec![[0.0f32; 3]; size.area()]),
            |(width, pixels), position, (r, g, b, _): (f32, f32, f32, f32)| {
                pixels[position.y() * *width + position.x()] = [r, g, b];
            },
        )
        .with_context(|| format!("cannot read {}", path.display()))?;
        let size = image.layer_data.size;
        let (_, pixels) = image.layer_data.channel_data.pixels;
        Ok(Self {
            width: size.width(),
            height: size.height(),
            pixels,
        })
    }

    /// Mean of each channel.
    pub fn mean(&self) -> [f64; 3] {
        let sum = self.pixels.iter().fold([0.0; 3], |sum: [f64; 3], p| {
            [
                sum[0] + f64::from(p[0]),
                sum[1] + f64::from(p[1]),
                sum[2] + f64::from(p[2]),
            ]
        });
        sum.map(|s| s / self.pixels.len() as f64)
    }

    /// Compares with a reference of the same size.
    pub fn difference(&self, reference: &Picture) -> Result<Difference> {
        ensure!(
            (self.width, self.height) == (reference.width, reference.height),
            "the pictures have different sizes: {}×{} and {}×{}",
            self.width,
            self.height,
            reference.width,
            reference.height
        );
        let (a, b) = (self.mean(), reference.mean());
        let squares = self
            .pixels
            .iter()
            .flatten()
            .zip(reference.pixels.iter().flatten());
        let rel_mse = squares
            .map(|(a, b)| f64::from((a - b) * (a - b)) / (f64::from(b * b) + 0.01))
            .sum::<f64>()
            / (3 * self.pixels.len()) as f64;
        Ok(Difference {
            channel_ratio: std::array::from_fn(|c| a[c] / b[c]),
            flip_mean: self.flip(reference),
            rel_mse,
        })
    }

    /// The picture as a Standard view transform shows it: clipped sRGB, 8 bits.
    fn display(&self) -> Vec<u8> {
        let encode = |x: f32| {
            let x = x.clamp(0.0, 1.0);
            let y = if x <= 0.003_130_8 {
                12.92 * x
            } else {
                1.055 * x.powf(1.0 / 2.4) - 0.055
            };
            (y * 255.0 + 0.5) as u8
        };
        self.pixels.iter().flatten().map(|&x| encode(x)).collect()
    }

    fn flip(&self, reference: &Picture) -> f32 {
        let (w, h) = (self.width as u32, self.height as u32);
        let image = |p: &Picture| nv_flip::FlipImageRgb8::with_data(w, h, &p.display());
        let error = nv_flip::flip(
            image(reference),
            image(self),
            nv_flip::DEFAULT_PIXELS_PER_DEGREE,
        );
        nv_flip::FlipPool::from_image(&error).mean()
    }
}
