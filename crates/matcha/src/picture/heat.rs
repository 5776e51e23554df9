//! Heat maps in the colours of viridis.

use image::{Rgb, RgbImage};

/// The number of nodes at the yellow end, as in the paper's figures.
pub const NODES_AT_TOP: f32 = 20.0;

/// Viridis at `t`, 0 (dark) to 1 (yellow).
pub fn viridis(t: f32) -> [u8; 3] {
    let t = if t.is_nan() {
        0.0
    } else {
        f64::from(t.clamp(0.0, 1.0))
    };
    colorous::VIRIDIS.eval_continuous(t).as_array()
}

/// Nodes found per sample, 0 to [`NODES_AT_TOP`].
///
/// # Panics
/// If there are fewer values than pixels.
pub fn map(width: u32, height: u32, nodes_found: &[f32]) -> RgbImage {
    RgbImage::from_fn(width, height, |x, y| {
        Rgb(viridis(
            nodes_found[(y * width + x) as usize] / NODES_AT_TOP,
        ))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_are_viridis_ends() {
        assert_eq!(viridis(-1.0), [68, 1, 84]);
        assert_eq!(viridis(1.0), viridis(3.0));
        let [r, g, b] = viridis(1.0);
        assert!(r > 240 && g > 220 && b < 60, "{r} {g} {b}");
        assert_eq!(map(2, 1, &[0.0, 20.0]).as_raw()[..3], [68, 1, 84]);
    }
}
