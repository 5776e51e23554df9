//! Filter importance sampling: a sample's place in its pixel is drawn with the pixel
//! filter's density (Ernst, Stamminger and Greiner 2006), so that every sample weighs one.

use crate::device::path_start::FilterView;
use crate::scene::PixelFilter;
use std::f64::consts::TAU;

/// Intervals of the inverse table.
const INTERVALS: usize = 1024;
/// Intervals of the integration that it is made from, over half of the support.
const FINE: usize = 32 * INTERVALS;

/// Inverse of a symmetric, separable filter's cumulative distribution.
///
/// The table's argument is the fourth root of the tail's share: long tails, in which the
/// inverse is steep, get most of the entries.
#[derive(Clone, Debug)]
pub struct FilterTable {
    inverse: Vec<f32>,
}

impl FilterTable {
    /// Tabulates a filter. Widths are Cycles': a Gaussian of width w is
    /// `exp(−8 x² / w²)` cut at ± 1.5 w, a Blackman–Harris window spans ± w, a box one pixel.
    pub fn new(filter: PixelFilter) -> Self {
        // Sums from the edge of the support inwards, where the small numbers are.
        let step = half_width(filter) / FINE as f64;
        let mut cumulative = Vec::with_capacity(FINE + 1);
        let mut sum = 0.0;
        cumulative.push(0.0);
        for i in 0..FINE {
            sum += weight(filter, half_width(filter) - (i as f64 + 0.5) * step).max(0.0);
            cumulative.push(sum);
        }
        let mut at = 0;
        let inverse = (0..=INTERVALS).map(|k| {
            let target = sum * (k as f64 / INTERVALS as f64).powi(4);
            while at + 1 < FINE && cumulative[at + 1] < target {
                at += 1;
            }
            let slope = cumulative[at + 1] - cumulative[at];
            let part = if slope > 0.0 {
                (target - cumulative[at]) / slope
            } else {
                0.0
            };
            (half_width(filter) - (at as f64 + part) * step).max(0.0) as f32
        });
        Self {
            inverse: inverse.collect(),
        }
    }

    /// The table, as device code reads it.
    pub fn view(&self) -> FilterView<'_> {
        FilterView {
            inverse: &self.inverse,
        }
    }
}

/// Half of the filter's support, pixels.
fn half_width(filter: PixelFilter) -> f64 {
    match filter {
        PixelFilter::Box => 0.5,
        PixelFilter::Gaussian(width) => 1.5 * f64::from(width.max(1e-3)),
        PixelFilter::BlackmanHarris(width) => f64::from(width.max(1e-3)),
    }
}

/// The filter at `x` pixels from its centre, not normalised.
fn weight(filter: PixelFilter, x: f64) -> f64 {
    match filter {
        PixelFilter::Box => 1.0,
        PixelFilter::Gaussian(width) => (-8.0 * (x / f64::from(width.max(1e-3))).powi(2)).exp(),
        PixelFilter::BlackmanHarris(_) => {
            // Harris 1978, the four-term window.
            let t = TAU * (x / (2.0 * half_width(filter)) + 0.5);
            0.35875 - 0.48829 * t.cos() + 0.14128 * (2.0 * t).cos() - 0.01168 * (3.0 * t).cos()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::device::path_start::filter_offset;

    /// Mean and variance of the sampled offsets, against the filter integrated directly.
    fn check_moments(filter: PixelFilter) {
        let table = FilterTable::new(filter);
        let n = 100_000;
        let (mut mean, mut second) = (0.0, 0.0);
        for i in 0..n {
            let x = f64::from(filter_offset(table.view(), (i as f32 + 0.5) / n as f32));
            mean += x / f64::from(n);
            second += x * x / f64::from(n);
        }
        let (mut norm, mut expected) = (0.0, 0.0);
        for i in 0..n {
            let x = ((f64::from(i) + 0.5) / f64::from(n) * 2.0 - 1.0) * half_width(filter);
            norm += weight(filter, x);
            expected += weight(filter, x) * x * x;
        }
        assert!(mean.abs() < 1e-4, "{filter:?}: mean {mean}");
        let expected = expected / norm;
        assert!(
            (second / expected - 1.0).abs() < 1e-3,
            "{filter:?}: {second} {expected}"
        );
    }

    #[test]
    fn offsets_have_the_filters_moments() {
        check_moments(PixelFilter::Box);
        check_moments(PixelFilter::Gaussian(1.5));
        check_moments(PixelFilter::BlackmanHarris(1.5));
    }

    #[test]
    fn histogram_is_the_filter() {
        let filter = PixelFilter::BlackmanHarris(1.5);
        let table = FilterTable::new(filter);
        let (bins, n) = (30, 300_000);
        let mut counts = vec![0.0; bins];
        for i in 0..n {
            let x = filter_offset(table.view(), (i as f32 + 0.5) / n as f32);
            counts[((x / 3.0 + 0.5) * bins as f32).clamp(0.0, bins as f32 - 1.0) as usize] += 1.0;
        }
        let fine = 1000;
        let density = |bin: usize| -> f64 {
            (0..fine)
                .map(|k| (bin as f64 + (f64::from(k) + 0.5) / f64::from(fine)) / bins as f64)
                .map(|t| weight(filter, (t - 0.5) * 3.0))
                .sum()
        };
        let total: f64 = (0..bins).map(density).sum();
        for (bin, count) in counts.iter().enumerate() {
            let expected = density(bin) / total * f64::from(n);
            assert!((count - expected).abs() < 0.002 * f64::from(n), "bin {bin}");
        }
    }

    #[test]
    fn offsets_stay_inside_the_support() {
        for filter in [
            PixelFilter::Box,
            PixelFilter::Gaussian(1.5),
            PixelFilter::BlackmanHarris(1.5),
        ] {
            let table = FilterTable::new(filter);
            for u in [0.0, 0.25, 0.999_999, 1.0, 2.0, -1.0] {
                assert!(
                    f64::from(filter_offset(table.view(), u).abs()) <= half_width(filter) + 1e-6
                );
            }
        }
    }
}
