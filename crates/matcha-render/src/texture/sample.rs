//! Filtering on the processor: reads and sums the texels that `device::texture_filter` names.

use super::Texture;
use super::look::{filter_code, wrap_code};
use super::pyramid::{Level, Texels};
use crate::device::texture_filter::*;
use glam::{Vec2, vec2};
use matcha_shade::graph::TextureRef;

/// How a look-up filters, as device code knows it.
#[derive(Clone, Copy)]
struct Look {
    /// One of `TEXTURE_CLOSEST`, `TEXTURE_LINEAR`, `TEXTURE_CUBIC`.
    filter: u32,
    /// One of `TEXTURE_REPEAT` and its siblings.
    wrap: u32,
}

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
        let look = Look {
            filter: filter_code(texture.interpolation),
            wrap: wrap_code(texture.extension),
        };
        let size = vec2(self.levels[0].width as f32, self.levels[0].height as f32);
        let last = self.levels.len() as u32 - 1;
        for i in 0..n {
            let level = if texture.no_footprint {
                0.0
            } else {
                texture_level(vec2(au[i], av[i]), vec2(bu[i], bv[i]), size, last)
            };
            [r[i], g[i], b[i], a[i]] = self.filter(look, vec2(u[i], v[i]), level);
        }
    }

    /// The filtered texel at a fractional level, encoded as it is stored.
    #[inline(always)]
    fn filter(&self, look: Look, uv: Vec2, level: f32) -> [f32; 4] {
        if !texture_is_place(uv) {
            return [0.0; 4];
        }
        let uv = [uv.x, uv.y].map(|c| texture_unrepeated(c, look.wrap));
        let levels = texture_levels(level, self.levels.len() as u32 - 1);
        let finer = levels.finer as usize;
        let first = self.levels[finer].filter(look, uv, finer);
        if levels.fraction <= 0.0 {
            return first;
        }
        let second = self.levels[finer + 1].filter(look, uv, finer + 1);
        std::array::from_fn(|c| first[c] + (second[c] - first[c]) * levels.fraction)
    }
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
    /// Filters one level at unrepeated coordinates; `index` is its number, for filters that only magnify.
    #[inline(always)]
    fn filter(&self, look: Look, uv: [f32; 2], index: usize) -> [f32; 4] {
        match &self.texels {
            Texels::Bytes(texels) => {
                let sum = self.filter_texels(texels.as_slice(), look, uv, index);
                sum.map(|value| value * (1.0 / 255.0))
            }
            Texels::Floats(texels) => self.filter_texels(texels.as_slice(), look, uv, index),
        }
    }

    #[inline(always)]
    fn filter_texels<T: Read + ?Sized>(
        &self,
        texels: &T,
        look: Look,
        uv: [f32; 2],
        index: usize,
    ) -> [f32; 4] {
        let wrap = look.wrap;
        match look.filter {
            TEXTURE_CLOSEST => {
                let x = axis::<1>(uv[0], self.width, wrap, 0.0, |_| [1.0]);
                let y = axis::<1>(uv[1], self.height, wrap, 0.0, |_| [1.0]);
                self.sum(texels, &x, &y)
            }
            TEXTURE_CUBIC if index == 0 => {
                let x = axis::<4>(uv[0], self.width, wrap, 1.5, texture_b_spline);
                let y = axis::<4>(uv[1], self.height, wrap, 1.5, texture_b_spline);
                self.sum(texels, &x, &y)
            }
            _ => {
                let x = axis::<2>(uv[0], self.width, wrap, 0.5, |t| [1.0 - t, t]);
                let y = axis::<2>(uv[1], self.height, wrap, 0.5, |t| [1.0 - t, t]);
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

/// Texels along one axis and their weights; those outside weigh nothing where an image is clipped.
struct Axis<const N: usize> {
    texel: [u32; N],
    weight: [f32; N],
}

#[inline(always)]
fn axis<const N: usize>(
    unrepeated: f32,
    size: u32,
    wrap: u32,
    back: f32,
    weights: impl Fn(f32) -> [f32; N],
) -> Axis<N> {
    // `texture_tap` with this processor's rounding.
    let at = texture_begin(unrepeated, size, back);
    let below = at.floor();
    let first = below as i32;
    let mut weight = weights(at - below);
    let mut texel = [0; N];
    for (k, texel) in texel.iter_mut().enumerate() {
        let (i, size) = (first + k as i32, size as i32);
        // `texture_texel` taken apart: what is outside costs only where images are clipped.
        *texel = match wrap {
            TEXTURE_REPEAT => texture_wrapped(i, size),
            TEXTURE_MIRROR => texture_mirrored(i, size),
            TEXTURE_EXTEND => texture_extended(i, size),
            _ => {
                let nearest = texture_extended(i, size);
                if nearest != i {
                    weight[k] = 0.0;
                }
                nearest
            }
        } as u32;
    }
    Axis { texel, weight }
}
