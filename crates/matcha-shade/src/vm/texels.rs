//! The virtual texels of a group's points.

use crate::device::texel::{texel_centre, texel_footprint, texel_index, texel_level};
use crate::program::{Program, Region};
use crate::rows::Rows;
use glam::Vec2;

/// A square of size 2^-level on the unbounded plane of a UV set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Texel {
    /// λ; larger is finer.
    pub level: i32,
    /// Position along u, in texels.
    pub i: i32,
    /// Position along v, in texels.
    pub j: i32,
}

/// The texels of a group's points in one UV set.
#[derive(Clone, Debug, Default)]
pub struct Texels {
    level: Vec<i32>,
    i: Vec<i32>,
    j: Vec<i32>,
}

impl FromIterator<Texel> for Texels {
    fn from_iter<I: IntoIterator<Item = Texel>>(texels: I) -> Self {
        let mut all = Texels::default();
        for Texel { level, i, j } in texels {
            all.level.push(level);
            all.i.push(i);
            all.j.push(j);
        }
        all
    }
}

impl Texels {
    /// The texels of a program's regions at `n` points, whose input rows are given: the
    /// first elements of `all`, which grows as needed and never shrinks, so that memory is
    /// kept. `level_offset` is added to λ.
    pub fn of_regions(
        all: &mut Vec<Texels>,
        program: &Program,
        n: usize,
        inputs: &Rows,
        level_offset: f32,
    ) {
        if all.len() < program.regions().len() {
            all.resize_with(program.regions().len(), Texels::default);
        }
        for (texels, region) in all.iter_mut().zip(program.regions()) {
            texels.find(region, n, inputs, level_offset);
        }
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.level.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.level.is_empty()
    }

    /// Levels, positions along u and along v of all points.
    pub fn rows(&self) -> [&[i32]; 3] {
        [&self.level, &self.i, &self.j]
    }

    /// One point's.
    pub fn get(&self, point: usize) -> Texel {
        Texel {
            level: self.level[point],
            i: self.i[point],
            j: self.j[point],
        }
    }

    /// Centre (u, v) of a point's texel, and the axes' length of the footprint that it stands for.
    pub(super) fn centre(&self, point: usize) -> [f32; 3] {
        let Texel { level, i, j } = self.get(point);
        let centre = texel_centre(i, j, level);
        [centre.x, centre.y, texel_footprint(level)]
    }

    fn find(&mut self, region: &Region, n: usize, inputs: &Rows, level_offset: f32) {
        for row in [&mut self.level, &mut self.i, &mut self.j] {
            row.resize(n, 0);
        }
        let from = region.uv_rows.map(|row| {
            let pair = [inputs.row(row), inputs.row(row + 1)];
            pair.map(|r| &r[..n])
        });
        let scale_squared = (-2.0 * level_offset).exp2();
        #[cfg(target_arch = "x86_64")]
        if is_x86_feature_detected!("avx2") {
            // SAFETY: the processor has AVX2.
            return unsafe { self.find_avx2(from, scale_squared) };
        }
        self.find_each(from, scale_squared);
    }

    /// With AVX2 rounding down is an instruction.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    fn find_avx2(&mut self, from: [[&[f32]; 2]; 3], scale_squared: f32) {
        self.find_each(from, scale_squared);
    }

    #[inline(always)]
    fn find_each(&mut self, [uv, a, b]: [[&[f32]; 2]; 3], scale_squared: f32) {
        let n = self.level.len();
        let [uv, a, b] = [uv, a, b].map(|pair| pair.map(|row| &row[..n]));
        let (i, j) = (&mut self.i[..n], &mut self.j[..n]);
        for (k, to) in self.level.iter_mut().enumerate() {
            let at = |rows: [&[f32]; 2]| Vec2::new(rows[0][k], rows[1][k]);
            let level = texel_level(at(a), at(b), scale_squared);
            *to = level;
            i[k] = texel_index(uv[0][k], level);
            j[k] = texel_index(uv[1][k], level);
        }
    }
}
