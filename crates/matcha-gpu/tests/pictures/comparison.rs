//! Whether two pictures of the same paths are the same.

/// What is wrong with a picture that should be another one. Devices round differently here and
/// there, which sends a path elsewhere once in a while: one pixel of `path_changes` may have such a
/// path. The others agree.
pub fn difference(
    picture: &[[f32; 4]],
    expected: &[[f32; 4]],
    path_changes: usize,
) -> Option<String> {
    let mean = |pixels: &[[f32; 4]], c: usize| {
        pixels.iter().map(|p| f64::from(p[c])).sum::<f64>() / pixels.len() as f64
    };
    let other = |(a, b): &(&[f32; 4], &[f32; 4])| {
        (0..4).any(|c| (a[c] - b[c]).abs() > 0.02 * b[c].abs().max(0.05))
    };
    let others = picture.iter().zip(expected).filter(other).count();
    let ratios = [0, 1, 2].map(|c| mean(picture, c) / mean(expected, c));
    let agrees =
        others * path_changes <= picture.len() && ratios.iter().all(|r| (r - 1.0).abs() < 0.01);
    (!agrees).then(|| format!("{others} of {} pixels, means {ratios:?}", picture.len()))
}
