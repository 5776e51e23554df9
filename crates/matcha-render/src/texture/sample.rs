//! Filtering: which level, which texels, which weights.
//!
//! Texel (i, j) of a level covers [i, i+1) × [j, j+1) in units of texels with v up, so its centre
//! is at i + 1/2, as in Cycles and OpenImageIO.

use super::Texture;
use super::pyramid::{Level, Texels};
use matcha_shade::graph::{Interpolation, TextureRef};
use matcha_shade::source::Extension;

/// Where a group of points looks an image up; every row has as many numbers as there are points.
pub(super) struct Points<'a> {
    /// Texture coordinates.
    pub(super) uv: [&'a [f32]; 2],
    /// Their change along both axes of the footprint.
    pub(super) axes: [[&'a [f32]; 2]; 2],
}

impl Texture {
    /// Filters at every point, with the best instructions of this processor; they round alike.
    pub(super) fn filter_all(&self, texture: &TextureRef, points: &Points, out: [&mut [f32]; 4]) {
        #[cfg(target_arch = "x86_64")]
        if std::is_x86_feature_detected!("avx2") {
            // SAFETY: the processor has AVX2.
            return unsafe { self.filter_all_avx2(texture, points, out) };
        }
        self.filter_each(texture, points, out);
    }

    /// With AVX2 rounding down is an instruction and not a call, and bytes widen in one step.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    fn filter_all_avx2(&self, texture: &TextureRef, points: &Points, out: [&mut [f32]; 4]) {
        self.filter_each(texture, points, out);
    }

    #[inline(always)]
    fn filter_each(&self, texture: &TextureRef, points: &Points, out: [&mut [f32]; 4]) {
        let n = out[0].len();
        let [u, v] = points.uv.map(|row| &row[..n]);
        let [[au, av], [bu, bv]] = points.axes.map(|axis| axis.map(|row| &row[..n]));
        let [r, g, b, a] = out.map(|row| &mut row[..n]);
        for i in 0..n {
            let level = if texture.no_footprint {
                0.0
            } else {
                self.level([au[i], av[i]], [bu[i], bv[i]])
            };
            [r[i], g[i], b[i], a[i]] = self.filter(texture, [u[i], v[i]], level);
        }
    }

    /// Level for a footprint with these half axes in texture coordinates: that of which a texel is
    /// as large as the SHORTER one, so that nothing is blurred beyond the footprint; what the long
    /// one would need more is left to the samples of a pixel. 0 where an axis is zero or no number.
    #[inline(always)]
    pub(super) fn level(&self, a: [f32; 2], b: [f32; 2]) -> f32 {
        let (width, height) = (self.levels[0].width as f32, self.levels[0].height as f32);
        let squared = |axis: [f32; 2]| {
            let (x, y) = (axis[0] * width, axis[1] * height);
            x * x + y * y
        };
        let (a, b) = (squared(a), squared(b));
        let least = if a < b { a } else { b };
        // False where one of them is no number.
        if a + b >= least && least > 1.0 {
            (0.5 * log2(least)).min((self.levels.len() - 1) as f32)
        } else {
            0.0
        }
    }

    /// The filtered texel at a fractional level, encoded as it is stored.
    #[inline(always)]
    pub(super) fn filter(&self, texture: &TextureRef, uv: [f32; 2], level: f32) -> [f32; 4] {
        if !(uv[0].is_finite() && uv[1].is_finite()) {
            return [0.0; 4];
        }
        let finer = (level as usize).min(self.levels.len() - 1);
        let fraction = level - finer as f32;
        let first = self.levels[finer].filter(texture, uv, finer);
        if fraction <= 0.0 || finer + 1 >= self.levels.len() {
            return first;
        }
        let second = self.levels[finer + 1].filter(texture, uv, finer + 1);
        std::array::from_fn(|c| first[c] + (second[c] - first[c]) * fraction)
    }
}

/// log₂ with an error below 0.01 of a level: exponent and a parabola through the mantissa.
#[inline(always)]
fn log2(x: f32) -> f32 {
    let bits = x.to_bits();
    let exponent = ((bits >> 23) as i32 - 127) as f32;
    let m = f32::from_bits((bits & 0x007f_ffff) | 0x3f80_0000) - 1.0;
    exponent + m + m * (1.0 - m) * (0.346_6 - 0.031 * (2.0 * m - 1.0))
}

/// A texel's colour as floats.
trait Read {
    fn read(&self, index: usize) -> [f32; 4];
}

impl Read for [[u8; 4]] {
    #[inline(always)]
    fn read(&self, index: usize) -> [f32; 4] {
        // Scaled to 1 once a sample, after the sum.
        self.get(index).map_or([0.0; 4], |t| t.map(f32::from))
    }
}

impl Read for [[f32; 4]] {
    #[inline(always)]
    fn read(&self, index: usize) -> [f32; 4] {
        self.get(index).copied().unwrap_or_default()
    }
}

impl Level {
    /// Filters one level; `index` is its number, for filters that only magnify.
    #[inline(always)]
    fn filter(&self, texture: &TextureRef, uv: [f32; 2], index: usize) -> [f32; 4] {
        match &self.texels {
            Texels::Bytes(texels) => {
                let sum = self.filter_texels(texels.as_slice(), texture, uv, index);
                sum.map(|value| value * (1.0 / 255.0))
            }
            Texels::Floats(texels) => self.filter_texels(texels.as_slice(), texture, uv, index),
        }
    }

    #[inline(always)]
    fn filter_texels<T: Read + ?Sized>(
        &self,
        texels: &T,
        texture: &TextureRef,
        uv: [f32; 2],
        index: usize,
    ) -> [f32; 4] {
        let mode = texture.extension;
        match texture.interpolation {
            Interpolation::Closest => {
                let x = axis::<1>(uv[0], self.width, mode, 0.0, |_| [1.0]);
                let y = axis::<1>(uv[1], self.height, mode, 0.0, |_| [1.0]);
                self.sum(texels, &x, &y)
            }
            Interpolation::Cubic | Interpolation::Smart if index == 0 => {
                let x = axis::<4>(uv[0], self.width, mode, 1.5, b_spline);
                let y = axis::<4>(uv[1], self.height, mode, 1.5, b_spline);
                self.sum(texels, &x, &y)
            }
            _ => {
                let x = axis::<2>(uv[0], self.width, mode, 0.5, |t| [1.0 - t, t]);
                let y = axis::<2>(uv[1], self.height, mode, 0.5, |t| [1.0 - t, t]);
                self.sum(texels, &x, &y)
            }
        }
    }

    #[inline(always)]
    fn sum<T: Read + ?Sized, const N: usize>(
        &self,
        texels: &T,
        x: &Axis<N>,
        y: &Axis<N>,
    ) -> [f32; 4] {
        let mut sum = [0.0; 4];
        for j in 0..N {
            // Rows are stored from the top.
            let row = (self.height - 1 - y.texel[j]) as usize * self.width as usize;
            for i in 0..N {
                let texel = texels.read(row + x.texel[i] as usize);
                let weight = x.weight[i] * y.weight[j];
                for c in 0..4 {
                    sum[c] += texel[c] * weight;
                }
            }
        }
        sum
    }
}

/// Weights of the cubic B-spline at a fraction between the two middle texels of four.
#[inline(always)]
fn b_spline(t: f32) -> [f32; 4] {
    let s = 1.0 - t;
    let sixth = 1.0 / 6.0;
    [
        sixth * s * s * s,
        sixth * (4.0 + t * t * (3.0 * t - 6.0)),
        sixth * (4.0 + s * s * (3.0 * s - 6.0)),
        sixth * t * t * t,
    ]
}

/// Texels along one axis and their weights; those outside weigh nothing where an image is clipped.
struct Axis<const N: usize> {
    texel: [u32; N],
    weight: [f32; N],
}

#[inline(always)]
fn axis<const N: usize>(
    coordinate: f32,
    size: u32,
    mode: Extension,
    back: f32,
    weights: impl Fn(f32) -> [f32; N],
) -> Axis<N> {
    // Repetition is taken off first: it keeps the product small and exact.
    let whole = match mode {
        Extension::Repeat => coordinate.floor(),
        Extension::Mirror => 2.0 * (0.5 * coordinate).floor(),
        Extension::Extend | Extension::Clip => 0.0,
    };
    let at = ((coordinate - whole) * size as f32 - back).clamp(-1e8, 1e8);
    let floor = at.floor();
    let mut weight = weights(at - floor);
    let first = floor as i32;
    let size = size as i32;
    let mut texel = [0; N];
    for (k, texel) in texel.iter_mut().enumerate() {
        let i = first + k as i32;
        *texel = match mode {
            Extension::Repeat => wrap(i, size),
            Extension::Mirror => {
                let i = wrap(i, 2 * size);
                if i < size { i } else { 2 * size - 1 - i }
            }
            Extension::Extend => i.clamp(0, size - 1),
            Extension::Clip => {
                if !(0..size).contains(&i) {
                    weight[k] = 0.0;
                }
                i.clamp(0, size - 1)
            }
        } as u32;
    }
    Axis { texel, weight }
}

/// Into 0..size; without a division where at most one period is off.
#[inline(always)]
fn wrap(i: i32, size: i32) -> i32 {
    let i = if i < 0 { i + size } else { i };
    let i = if i >= size { i - size } else { i };
    if (0..size).contains(&i) {
        i
    } else {
        i.rem_euclid(size)
    }
}
