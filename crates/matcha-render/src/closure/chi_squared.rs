//! Pearson's chi-squared test of directions against their density. A test of a sampler is
//! one call of [`chi_squared`]:
//!
//! ```ignore
//! let set = lobes(kind, &rows(kind, Vec3::ONE, &[("roughness", &[0.3])]), &frame(0.5));
//! let p = chi_squared(|u| set.sample(u).map(|s| s.wi), |wi| set.eval(wi).pdf, 1);
//! assert!(p > 1e-5);
//! ```

use super::fixtures::{Random, direction};
use glam::Vec3;
use std::f32::consts::TAU;

const HEIGHTS: usize = 24;
const AZIMUTHS: usize = 32;
const SAMPLES: usize = 60_000;
/// Points along each side of a bin at which the density is integrated.
const FINE: usize = 32;
/// Likewise where that finds nothing.
const COARSE: usize = 8;

/// Probability that samples of the density `pdf` (sr⁻¹) differ from it by as much as those
/// of `sample` do: small where the two do not belong together. 0 where
/// the share of draws that give a direction at all is not the density's integral.
pub fn chi_squared(
    sample: impl Fn(Vec3) -> Option<Vec3>,
    pdf: impl Fn(Vec3) -> f32,
    seed: u64,
) -> f64 {
    let mut random = Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    let mut observed = vec![0.0_f64; HEIGHTS * AZIMUTHS];
    for _ in 0..SAMPLES {
        if let Some(wi) = sample(random.f3()) {
            observed[bin(wi)] += 1.0;
        }
    }
    let mut expected: Vec<f64> = (0..HEIGHTS * AZIMUTHS)
        .map(|i| integrate(&pdf, i))
        .collect();
    let drawn = observed.iter().sum::<f64>();
    let inside: f64 = expected.iter().sum();
    // Beckmann's masking is a fit that is 0.35 % off.
    if (drawn / SAMPLES as f64 - inside).abs() > 0.006 {
        return 0.0;
    }
    expected.iter_mut().for_each(|e| *e *= drawn / inside);
    significance(&observed, &expected)
}

fn bin(wi: Vec3) -> usize {
    let height = ((wi.z * 0.5 + 0.5) * HEIGHTS as f32) as usize;
    let turn = wi.y.atan2(wi.x).rem_euclid(TAU) / TAU;
    height.min(HEIGHTS - 1) * AZIMUTHS + ((turn * AZIMUTHS as f32) as usize).min(AZIMUTHS - 1)
}

fn integrate(pdf: &impl Fn(Vec3) -> f32, bin: usize) -> f64 {
    // Densities have edges: many points, but only where there is something.
    let coarse = mean(pdf, bin, COARSE);
    let mean = if coarse > 0.0 {
        mean(pdf, bin, FINE)
    } else {
        0.0
    };
    mean * 2.0 * f64::from(TAU) / (HEIGHTS * AZIMUTHS) as f64
}

fn mean(pdf: &impl Fn(Vec3) -> f32, bin: usize, fine: usize) -> f64 {
    let (row, column) = (bin / AZIMUTHS, bin % AZIMUTHS);
    let mut sum = 0.0;
    for a in 0..fine {
        for b in 0..fine {
            let z = (row as f32 + (a as f32 + 0.5) / fine as f32) / HEIGHTS as f32 * 2.0 - 1.0;
            let turn = (column as f32 + (b as f32 + 0.5) / fine as f32) / AZIMUTHS as f32;
            sum += f64::from(pdf(direction(z, turn * TAU)));
        }
    }
    sum / (fine * fine) as f64
}

/// Bins of fewer than ten expected samples are pooled.
fn significance(observed: &[f64], expected: &[f64]) -> f64 {
    let (mut statistic, mut bins) = (0.0, 0);
    let (mut rare_observed, mut rare_expected) = (0.0, 0.0);
    for (o, e) in observed.iter().zip(expected) {
        if *e < 10.0 {
            rare_observed += o;
            rare_expected += e;
        } else {
            statistic += (o - e) * (o - e) / e;
            bins += 1;
        }
    }
    if rare_expected >= 10.0 {
        statistic += (rare_observed - rare_expected).powi(2) / rare_expected;
        bins += 1;
    } else if rare_observed > 60.0 {
        return 0.0;
    }
    upper_tail(statistic, f64::from(bins - 1).max(1.0))
}

/// Probability above `x` of a chi-squared variable (Wilson and Hilferty 1931).
fn upper_tail(x: f64, freedom: f64) -> f64 {
    let v = 2.0 / (9.0 * freedom);
    let z = ((x / freedom).cbrt() - (1.0 - v)) / v.sqrt();
    // Normal tail (Abramowitz and Stegun 1964, 7.1.26).
    let t = 1.0 / (1.0 + 0.327_591_1 * (z.abs() / 2.0_f64.sqrt()));
    let p = ((((1.061_405_429 * t - 1.453_152_027) * t + 1.421_413_741) * t - 0.284_496_736) * t
        + 0.254_829_592)
        * t;
    let tail = 0.5 * p * (-z * z / 2.0).exp();
    if z > 0.0 { tail } else { 1.0 - tail }
}
