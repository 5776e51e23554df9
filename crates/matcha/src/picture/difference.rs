//! Differences made visible.

use image::{Rgb, RgbImage};

/// The paper shows differences multiplied by this.
pub const MAGNIFICATION: u8 = 5;

/// Magnitude of the difference of two displayed pictures, three bytes a pixel, times
/// [`MAGNIFICATION`].
///
/// # Panics
/// If the sizes do not fit the data.
pub fn magnified(width: u32, height: u32, a: &[u8], b: &[u8]) -> RgbImage {
    RgbImage::from_fn(width, height, |x, y| {
        let at = (y * width + x) as usize * 3;
        Rgb([0, 1, 2].map(|c| a[at + c].abs_diff(b[at + c]).saturating_mul(MAGNIFICATION)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_grow_and_saturate() {
        let picture = magnified(2, 1, &[10, 20, 200, 0, 0, 0], &[12, 20, 100, 0, 0, 0]);
        assert_eq!(picture.as_raw()[..], [10, 0, 255, 0, 0, 0]);
    }
}
