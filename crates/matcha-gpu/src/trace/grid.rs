//! Boxes in steps of a coarse grid.

use matcha_render::accel::Bounds;

/// Steps of a grid on each axis.
const STEPS: f64 = 255.0;

/// Boxes are grown by at least this part of a step. The walk computes a side's distance as
/// `q · step + start`, where `start` belongs to the grid's corner: it is off by up to two units
/// in the last place of 255 steps, 6·10⁻⁵ steps, beyond what the slack of distances covers.
const MARGIN: f64 = 1.0 / 256.0;

/// The finest grid: its steps times the largest inverse of a direction are normal numbers.
const LEAST_EXPONENT: i32 = -100;

/// Steps are at least this power of two of the coordinates themselves, whose last place is 2⁻²³.
const LEAST_RELATIVE: i32 = -30;

/// A grid over the children of a node: steps are powers of two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Its lower corner.
    pub origin: [f32; 3],
    /// Steps as powers of two, one an axis.
    pub exponents: [i32; 3],
}

impl Grid {
    /// The finest grid that holds a box with its margin.
    pub fn over(bounds: &Bounds) -> Grid {
        let mut grid = Grid {
            origin: [0.0; 3],
            exponents: [0; 3],
        };
        for axis in 0..3 {
            let side = (f64::from(bounds.min[axis]), f64::from(bounds.max[axis]));
            (grid.origin[axis], grid.exponents[axis]) = finest(side.0, side.1);
        }
        grid
    }

    /// A step of an axis.
    pub fn step(&self, axis: usize) -> f64 {
        f64::from(self.exponents[axis]).exp2()
    }

    /// Where a side is, in steps from the origin.
    fn place(&self, axis: usize, at: f32) -> f64 {
        (f64::from(at) - f64::from(self.origin[axis])) / self.step(axis)
    }

    /// A box in steps, lower and upper side of each axis; it holds `bounds` with the margin.
    pub fn quantise(&self, bounds: &Bounds) -> [[u8; 2]; 3] {
        std::array::from_fn(|axis| {
            let low = (self.place(axis, bounds.min[axis]) - MARGIN).floor();
            let high = (self.place(axis, bounds.max[axis]) + MARGIN).ceil();
            debug_assert!(low >= 0.0 && high <= STEPS);
            [low as u8, high as u8]
        })
    }

    /// The box of steps, exactly.
    pub fn bounds(&self, steps: [[u8; 2]; 3]) -> [[f64; 2]; 3] {
        std::array::from_fn(|axis| {
            let origin = f64::from(self.origin[axis]);
            steps[axis].map(|q| origin + f64::from(q) * self.step(axis))
        })
    }

    /// The steps' exponents as the bits of numbers have them, a byte an axis.
    pub fn packed_exponents(&self) -> u32 {
        let byte = |axis: usize| ((self.exponents[axis] + 127) as u32) << (8 * axis);
        byte(0) | byte(1) | byte(2)
    }
}

/// Origin and exponent of an axis.
fn finest(low: f64, high: f64) -> (f32, i32) {
    let extent = (high - low).max(f64::MIN_POSITIVE);
    let size = low.abs().max(high.abs()).max(f64::MIN_POSITIVE);
    let least = (size.log2().floor() as i32 + LEAST_RELATIVE).max(LEAST_EXPONENT);
    let mut exponent = ((extent / STEPS).log2().ceil() as i32).max(least);
    loop {
        let step = f64::from(exponent).exp2();
        // Twice the margin: what rounding takes of it must leave one.
        let origin = below(low - 2.0 * MARGIN * step);
        let steps = (high - f64::from(origin)) / step;
        if steps + MARGIN <= STEPS {
            return (origin, exponent);
        }
        exponent += 1;
    }
}

/// The largest single-precision number that is not above `x`.
fn below(x: f64) -> f32 {
    let near = x as f32;
    if f64::from(near) > x {
        near.next_down()
    } else {
        near
    }
}
