//! Whether two pictures of the same paths are the same.

/// Relative difference of a channel above which a pixel is another one; of what is darker than
/// [`DARK`], a part of that.
const RELATIVE: f32 = 0.02;
const DARK: f32 = 0.05;

/// What is wrong with a picture that should be another one. Devices round differently here and
/// there, which sends a path elsewhere once in a while: so many pixels may have such a path, and are
/// no brighter than ten times the brightest. The others agree.
pub fn difference(
    picture: &[[f32; 4]],
    expected: &[[f32; 4]],
    with_other_paths: usize,
) -> Option<String> {
    let mean = |pixels: &[[f32; 4]], c: usize| {
        pixels.iter().map(|p| f64::from(p[c])).sum::<f64>() / pixels.len() as f64
    };
    let other = |(a, b): &(&[f32; 4], &[f32; 4])| {
        (0..4).any(|c| (a[c] - b[c]).abs() > RELATIVE * b[c].abs().max(DARK))
    };
    let brightest = expected.as_flattened().iter().copied().fold(0.0, f32::max);
    let possible = |value: &f32| (0.0..=10.0 * brightest).contains(value);
    let impossible = picture.as_flattened().iter().filter(|v| !possible(v));
    let impossible = impossible.count();
    let others = picture.iter().zip(expected).filter(other).count();
    let ratios = [0, 1, 2].map(|c| mean(picture, c) / mean(expected, c));
    let means_agree = ratios.iter().all(|r| (r - 1.0).abs() < 0.01);
    let agrees = impossible == 0 && others <= with_other_paths && means_agree;
    (!agrees).then(|| {
        format!(
            "{others} of {} pixels, {impossible} impossible numbers, means {ratios:?}",
            picture.len()
        )
    })
}
