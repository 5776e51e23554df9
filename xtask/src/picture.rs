//! Reading EXR pictures and comparing them.

use anyhow::{Context, Result, ensure};
use matcha::measure;
use matcha::picture::view::View;
use std::path::Path;

/// A picture, linear Rec.709 and alpha.
pub struct Picture {
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Pixels, top row first.
    pub pixels: Vec<[f32; 4]>,
}

/// How far a picture is from its reference.
pub struct Difference {
    /// Mean of each channel over the reference's.
    pub channel_ratio: [f64; 3],
    /// Mean FLIP error in the Standard view.
    pub flip_mean: f32,
    /// Relative mean squared error.
    pub rel_mse: f64,
}

impl Picture {
    /// Reads the first RGB(A) layer of an EXR file.
    pub fn read(path: &Path) -> Result<Self> {
        let image = exr::prelude::read_first_rgba_layer_from_file(
            path,
            |size, _| (size.width(), vec![[0.0f32; 4]; size.area()]),
            |(width, pixels), position, (r, g, b, a): (f32, f32, f32, f32)| {
                pixels[position.y() * *width + position.x()] = [r, g, b, a];
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

    /// Mean of each colour channel.
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
        let shown = |picture: &Picture| View::standard().bytes(&picture.pixels);
        let (w, h) = (self.width as u32, self.height as u32);
        Ok(Difference {
            channel_ratio: std::array::from_fn(|c| a[c] / b[c]),
            flip_mean: measure::flip_mean(w, h, &shown(self), &shown(reference)),
            rel_mse: measure::rel_mse(&self.pixels, &reference.pixels),
        })
    }
}
