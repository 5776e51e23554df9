//! Where a ramp or curve, a table of samples over [0, 1], is read.

use crate::device::math::{clamp, select, to_int};

/// The samples to read and how to mix them: `(1 − t)·row[first] + t·row[second]`.
#[derive(Clone, Copy, Debug)]
pub struct RampPlace {
    /// Index of the sample at or below.
    pub first: u32,
    /// Index of the one after it; the same at the end.
    pub second: u32,
    /// Share of the second, 0 where a table is not interpolated.
    pub t: f32,
}

/// Place of `x` in a table whose last sample has the index `last` (at least 1).
#[inline(always)]
pub fn ramp_place(last: u32, interpolate: bool, extrapolate: bool, x: f32) -> RampPlace {
    let limited = select(clamp(x, 0.0, 1.0), x, extrapolate);
    let f = limited * (last as f32);
    let top = last - (interpolate as u32);
    let first = to_int(clamp(f, 0.0, top as f32)) as u32;
    let t = select(0.0, f - (first as f32), interpolate);
    let second = if first < last { first + 1 } else { last };
    RampPlace { first, second, t }
}

/// Value between two samples.
#[inline(always)]
pub fn ramp_mix(a: f32, b: f32, t: f32, interpolate: bool) -> f32 {
    select(a, (1.0 - t) * a + t * b, interpolate)
}
