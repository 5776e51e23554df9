//! How far apart two pictures are.

use serde::Serialize;

/// Error of a picture against a reference.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Error {
    /// Mean FLIP error of the pictures as displayed (Andersson et al. 2020), at 67
    /// pixels a degree, by NVIDIA's implementation.
    pub flip_mean: f32,
    /// Mean of `(a − b)² / (b² + 0.01)` over pixels and channels, linear; `b` is the reference.
    pub rel_mse: f64,
    /// Largest difference of a channel, linear.
    pub max_abs: f32,
}

/// Mean FLIP error of two sRGB pictures of equal size, three bytes a pixel.
///
/// # Panics
/// If the sizes do not fit the data.
pub fn flip_mean(width: u32, height: u32, test: &[u8], reference: &[u8]) -> f32 {
    let image = |data| nv_flip::FlipImageRgb8::with_data(width, height, data);
    let error = nv_flip::flip(
        image(reference),
        image(test),
        nv_flip::DEFAULT_PIXELS_PER_DEGREE,
    );
    nv_flip::FlipPool::from_image(&error).mean()
}

/// Mean of `(a − b)² / (b² + 0.01)` over pixels and colour channels of linear pictures.
pub fn rel_mse(test: &[[f32; 4]], reference: &[[f32; 4]]) -> f64 {
    let pairs = channels(test, reference).map(|(a, b)| (f64::from(a), f64::from(b)));
    let sum: f64 = pairs.map(|(a, b)| (a - b).powi(2) / (b * b + 0.01)).sum();
    sum / (3 * reference.len()).max(1) as f64
}

/// Largest difference of a colour channel of linear pictures.
pub fn max_abs(test: &[[f32; 4]], reference: &[[f32; 4]]) -> f32 {
    channels(test, reference)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f32::max)
}

fn channels<'a>(
    test: &'a [[f32; 4]],
    reference: &'a [[f32; 4]],
) -> impl Iterator<Item = (f32, f32)> + 'a {
    test.iter()
        .zip(reference)
        .flat_map(|(a, b)| [(a[0], b[0]), (a[1], b[1]), (a[2], b[2])])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_pictures_have_no_error_and_a_corrupted_pixel_has_one() {
        let picture: Vec<[f32; 4]> = (0..64).map(|k| [k as f32 / 64.0, 0.5, 0.25, 1.0]).collect();
        let bytes: Vec<u8> = (0..64 * 3).collect();
        assert_eq!(rel_mse(&picture, &picture), 0.0);
        assert_eq!(max_abs(&picture, &picture), 0.0);
        assert_eq!(flip_mean(8, 8, &bytes, &bytes), 0.0);
        let mut other = picture.clone();
        other[9][1] += 0.25;
        assert_eq!(max_abs(&other, &picture), 0.25);
        let expected = 0.0625 / 0.26 / 192.0;
        assert!((rel_mse(&other, &picture) - expected).abs() < 1e-9);
        let mut other = bytes.clone();
        other[27..30].fill(255);
        assert!(flip_mean(8, 8, &other, &bytes) > 0.001);
    }
}
