//! Ramps and curves: look-ups in tables of samples over [0, 1].

use crate::device::math::{clamp, to_int};
use crate::graph::Table;

/// The samples to read and how to mix them: `(1 − t)·row[i] + t·row[i + 1]`.
#[inline(always)]
fn position(table: &Table, last: usize, x: f32) -> (usize, f32) {
    let limited = if table.extrapolate {
        x
    } else {
        clamp(x, 0.0, 1.0)
    };
    let f = limited * last as f32;
    let floor = clamp(f, 0.0, (last - table.interpolate as usize) as f32);
    let i = to_int(floor) as usize;
    let t = if table.interpolate { f - i as f32 } else { 0.0 };
    (i, t)
}

/// Looks `N` points up, one row of results for each row of the table.
#[inline(always)]
pub(crate) fn look_up<const N: usize>(table: &Table, x: &[f32; N]) -> [[f32; N]; 4] {
    let last = table.rows[0].len() - 1;
    let mut at = [0usize; N];
    let mut t = [0.0f32; N];
    for lane in 0..N {
        (at[lane], t[lane]) = position(table, last, x[lane]);
    }
    let mut out = [[0.0f32; N]; 4];
    for (row, out) in table.rows.iter().zip(&mut out) {
        let (mut a, mut b) = ([0.0f32; N], [0.0f32; N]);
        for lane in 0..N {
            a[lane] = row[at[lane]];
            b[lane] = row[(at[lane] + 1).min(last)];
        }
        for lane in 0..N {
            let mixed = (1.0 - t[lane]) * a[lane] + t[lane] * b[lane];
            out[lane] = if table.interpolate { mixed } else { a[lane] };
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(interpolate: bool, extrapolate: bool, x: f32) -> f32 {
        let table = Table {
            rows: vec![vec![1.0, 3.0, 7.0]],
            interpolate,
            extrapolate,
        };
        look_up(&table, &[x])[0][0]
    }

    #[test]
    fn between_samples() {
        for (x, linear, constant) in [
            (0.0, 1.0, 1.0),
            (0.25, 2.0, 1.0),
            (0.5, 3.0, 3.0),
            (0.75, 5.0, 3.0),
            (1.0, 7.0, 7.0),
        ] {
            assert_eq!(sample(true, false, x), linear);
            assert_eq!(sample(false, false, x), constant);
        }
    }

    #[test]
    fn outside() {
        assert_eq!(sample(true, false, -1.0), 1.0);
        assert_eq!(sample(true, false, 2.0), 7.0);
        assert_eq!(sample(true, true, -0.5), -1.0);
        assert_eq!(sample(true, true, 1.5), 11.0);
    }

    #[test]
    fn no_operand_panics() {
        for x in [
            f32::NAN,
            f32::INFINITY,
            -f32::INFINITY,
            f32::MAX,
            f32::MIN_POSITIVE,
        ] {
            for (interpolate, extrapolate) in
                [(true, true), (true, false), (false, true), (false, false)]
            {
                sample(interpolate, extrapolate, x);
            }
        }
    }
}
