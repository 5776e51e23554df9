use super::*;
use crate::device::sobol::*;

const SEEDS: [u32; 4] = [0, 1, 0x1234_5678, u32::MAX];

/// Direct sum over direction numbers by the recurrence of Bratley and Fox 1988.
fn third_by_recurrence(index: u32) -> u32 {
    let mut m = vec![1u32, 3];
    for k in 2..32 {
        m.push(m[k - 2] ^ (m[k - 2] << 2) ^ (m[k - 1] << 1));
    }
    let numbers = m.iter().zip(0..).map(|(m, k)| m << (31 - k));
    numbers.zip(0..).fold(
        0,
        |sum, (v, k)| if index >> k & 1 == 1 { sum ^ v } else { sum },
    )
}

#[test]
fn third_dimension_is_its_recurrence() {
    let single_bits = (0..32).map(|k| 1 << k);
    for i in (0..2000).chain(single_bits).chain([u32::MAX, 0xdead_beef]) {
        assert_eq!(sobol_third(i).reverse_bits(), third_by_recurrence(i));
    }
}

#[test]
fn second_dimension_is_its_recurrence() {
    let mut numbers = vec![0x8000_0000u32];
    for k in 1..32 {
        numbers.push(numbers[k - 1] ^ (numbers[k - 1] >> 1));
    }
    for i in (0..2000).chain([u32::MAX, 0x8000_0000, 0xdead_beef]) {
        let sum = (0..32)
            .filter(|k| i >> k & 1 == 1)
            .fold(0, |s, k| s ^ numbers[k]);
        assert_eq!(sobol_second(i).reverse_bits(), sum);
    }
}

#[test]
fn reversal_reverses() {
    for x in [0, 1, 0x8000_0000, 0x1234_5678, u32::MAX, 0x0f0f_1234] {
        assert_eq!(sobol_reverse(x), x.reverse_bits());
    }
}

/// Counts in a grid of `nx` × `ny` cells.
fn counts(points: impl Iterator<Item = (f32, f32)>, nx: usize, ny: usize) -> Vec<usize> {
    let mut cells = vec![0; nx * ny];
    for (x, y) in points {
        cells[(y * ny as f32) as usize * nx + (x * nx as f32) as usize] += 1;
    }
    cells
}

/// The first 2^m points of a (0, 2)-sequence in base 2 put one point into every elementary
/// interval; scrambling must keep that.
#[test]
fn every_elementary_interval_has_one_point() {
    let m = 8;
    for seed in SEEDS {
        for dimension in [0, 1, 17] {
            let points: Vec<_> = (0..1 << m)
                .map(|i| sample_2d(seed, i, dimension))
                .map(|p| (p.x, p.y))
                .collect();
            for a in 0..=m {
                let cells = counts(points.iter().copied(), 1 << a, 1 << (m - a));
                assert!(
                    cells.iter().all(|&n| n == 1),
                    "seed {seed} dimension {dimension} {a}"
                );
            }
        }
    }
}

#[test]
fn three_dimensions_are_stratified_in_every_pair() {
    let m = 8;
    for seed in SEEDS {
        let points: Vec<_> = (0..1u32 << m).map(|i| sample_3d(seed, i, 3)).collect();
        for a in 0..=m {
            let (nx, ny) = (1 << a, 1 << (m - a));
            let xy = counts(points.iter().map(|p| (p.x, p.y)), nx, ny);
            assert!(xy.iter().all(|&n| n == 1));
            // The pairs with the third dimension have quality parameter t ≤ 1.
            for pair in [
                counts(points.iter().map(|p| (p.x, p.z)), nx, ny),
                counts(points.iter().map(|p| (p.y, p.z)), nx, ny),
            ] {
                assert!(pair.iter().all(|&n| n <= 2), "seed {seed} {a}");
            }
        }
        let line = counts(points.iter().map(|p| (p.z, 0.0)), 1 << m, 1);
        assert!(line.iter().all(|&n| n == 1));
    }
}

/// L2 star discrepancy squared (Warnock 1972).
fn discrepancy(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let single: f64 = points
        .iter()
        .map(|p| (1.0 - p.0 * p.0) * (1.0 - p.1 * p.1))
        .sum();
    let mut double = 0.0;
    for p in points {
        for q in points {
            double += (1.0 - p.0.max(q.0)) * (1.0 - p.1.max(q.1));
        }
    }
    1.0 / 9.0 - single / (2.0 * n) + double / (n * n)
}

#[test]
fn discrepancy_is_far_below_that_of_independent_points() {
    let n = 256;
    // Expectation for independent points: (1/4 − 1/9) / n.
    let independent = (0.25 - 1.0 / 9.0) / f64::from(n);
    for seed in SEEDS {
        let points: Vec<_> = (0..n)
            .map(|i| sample_2d(seed, i, 5))
            .map(|p| (f64::from(p.x), f64::from(p.y)))
            .collect();
        assert!(discrepancy(&points) < 0.1 * independent);
        // Two draws that are not padded together are like independent points.
        let crossed: Vec<_> = (0..n)
            .map(|i| {
                (
                    f64::from(sample_1d(seed, i, 5)),
                    f64::from(sample_1d(seed, i, 6)),
                )
            })
            .collect();
        assert!(discrepancy(&crossed) < 3.0 * independent);
    }
}

/// Over many pixels each sample must be uniform: chi² over 64 cells.
#[test]
fn one_sample_over_pixels_is_uniform() {
    let n = 64 * 256;
    for (index, dimension) in [(0, 0), (1, 0), (77, 9)] {
        let points = (0..n).map(|i| {
            let p = sample_2d(pixel_seed(i % 128, i / 128, 7), index, dimension);
            (p.x, p.y)
        });
        let chi: f64 = counts(points, 8, 8)
            .iter()
            .map(|&c| (c as f64 - 256.0).powi(2) / 256.0)
            .sum();
        // 63 degrees of freedom: mean 63, standard deviation 11.2.
        assert!(chi < 63.0 + 5.0 * 11.2, "chi² {chi}");
    }
}

fn correlation(pairs: impl Iterator<Item = (f32, f32)>) -> f64 {
    let (mut n, mut sum) = (0.0, 0.0);
    for (a, b) in pairs {
        n += 1.0;
        sum += (f64::from(a) - 0.5) * (f64::from(b) - 0.5) * 12.0;
    }
    sum / n
}

#[test]
fn draws_pixels_and_seeds_are_uncorrelated() {
    let n = 4096;
    // Standard deviation of the estimate for independent numbers is n^-½ = 0.016.
    let limit = 5.0 / f64::from(n).sqrt();
    for d in 0..8 {
        let next = correlation((0..n).map(|i| (sample_1d(1, i, d), sample_1d(1, i, d + 1))));
        let within = correlation((0..n).map(|i| (sample_2d(1, i, d).x, sample_1d(1, i, d + 1))));
        let pixel = correlation((0..n).map(|i| {
            let (a, b) = (pixel_seed(i, 4, 0), pixel_seed(i + 1, 4, 0));
            (sample_1d(a, 0, d), sample_1d(b, 0, d))
        }));
        let seed = correlation((0..n).map(|i| {
            let (a, b) = (pixel_seed(i, 4, 0), pixel_seed(i, 4, 1));
            (sample_1d(a, 3, d), sample_1d(b, 3, d))
        }));
        for c in [next, within, pixel, seed] {
            assert!(c.abs() < limit, "draw {d}: {next} {within} {pixel} {seed}");
        }
    }
}

/// The comparators above must be able to fail: unscrambled draws repeat each other.
#[test]
fn equal_draws_are_found_out() {
    let n = 4096;
    let same = correlation((0..n).map(|i| (sample_1d(1, i, 4), sample_1d(1, i, 4))));
    assert!(same > 0.9);
    let line: Vec<_> = (0..256u32)
        .map(|i| (f64::from(i) / 256.0, f64::from(i) / 256.0))
        .collect();
    assert!(discrepancy(&line) > (0.25 - 1.0 / 9.0) / 256.0);
}

#[test]
fn numbers_stay_below_one() {
    assert!(sobol_unit(u32::MAX, 0, 0) < 1.0);
    let largest = (u32::MAX >> 8) as f32 * 5.960_464_5e-8;
    assert!(largest < 1.0);
}
