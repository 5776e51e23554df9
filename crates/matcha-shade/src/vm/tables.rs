//! Ramps and curves: look-ups in tables of samples over [0, 1].

use crate::device::ramp::{ramp_mix, ramp_place};
use crate::graph::Table;

/// Looks `N` points up, one row of results for each row of the table.
#[inline(always)]
pub(crate) fn look_up<const N: usize>(table: &Table, x: &[f32; N]) -> [[f32; N]; 4] {
    let last = table.rows[0].len() as u32 - 1;
    let mut at = [[0usize; N]; 2];
    let mut t = [0.0f32; N];
    for lane in 0..N {
        let place = ramp_place(last, table.interpolate, table.extrapolate, x[lane]);
        at[0][lane] = place.first as usize;
        at[1][lane] = place.second as usize;
        t[lane] = place.t;
    }
    let mut out = [[0.0f32; N]; 4];
    for (row, out) in table.rows.iter().zip(&mut out) {
        let (mut a, mut b) = ([0.0f32; N], [0.0f32; N]);
        for lane in 0..N {
            a[lane] = row[at[0][lane]];
            b[lane] = row[at[1][lane]];
        }
        for lane in 0..N {
            out[lane] = ramp_mix(a[lane], b[lane], t[lane], table.interpolate);
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
