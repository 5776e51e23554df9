//! A cache that forgets nothing, images that are formulas, and inputs at random.
#![allow(dead_code)]

use matcha_shade::graph::TextureRef;
use matcha_shade::input::{InputKind, Part};
use matcha_shade::program::{Program, Region};
use matcha_shade::vm::{Machine, NodeCache, Rows, RunCounts, Texel, Texels, Textures};
use std::collections::HashMap;

/// An exact cache of one material.
#[derive(Default)]
pub struct ExactCache {
    pub values: HashMap<(u32, Texel), Vec<f32>>,
    pub calls: usize,
}

impl ExactCache {
    fn value(&self, region: &Region, texel: Texel) -> Option<Vec<f32>> {
        let values = region.values.iter();
        let all: Option<Vec<&Vec<f32>>> = values
            .map(|value| self.values.get(&(value.node, texel)))
            .collect();
        Some(all?.into_iter().flatten().copied().collect())
    }
}

impl NodeCache for ExactCache {
    fn look_up(&mut self, region: &Region, texels: &Texels, out: &mut Rows, found: &mut [bool]) {
        self.calls += 1;
        for (k, found) in found.iter_mut().enumerate().take(texels.len()) {
            let value = self.value(region, texels.get(k));
            *found = value.is_some();
            for i in 0..region.width() {
                // What is not found must not be read.
                out.set(i, k, value.as_ref().map_or(f32::NAN, |v| v[i]));
            }
        }
    }

    fn store(&mut self, region: &Region, texels: &Texels, which: &[u32], values: &mut Rows) {
        for (column, &k) in which.iter().enumerate() {
            let mut rows = 0..region.width();
            for value in &region.values {
                let own = rows.by_ref().take(value.ty.width());
                let number = own.map(|row| values.get(row, column)).collect();
                self.values
                    .entry((value.node, texels.get(k as usize)))
                    .or_insert(number);
            }
        }
    }
}

/// Runs a program over `n` hits with a level offset.
pub fn run_at(
    machine: &mut Machine,
    program: &Program,
    n: usize,
    inputs: &Rows,
    cache: Option<&mut dyn NodeCache>,
    level_offset: f32,
) -> (Rows, RunCounts) {
    let (mut texels, mut out) = (Vec::new(), Rows::default());
    Texels::of_regions(&mut texels, program, n, inputs, level_offset);
    let counts = machine.run(program, n, inputs, &texels, &Formulas, cache, &mut out);
    (out, counts)
}

/// Smooth images.
pub struct Formulas;

impl Formulas {
    /// The image's value at a point.
    pub fn at(texture: TextureRef, uv: [f32; 2], da: [f32; 2], db: [f32; 2]) -> [f32; 4] {
        let k = 1.0 + texture.image as f32;
        let [u, v] = uv.map(|x| x * k);
        let spread = (da[0] * db[1] - da[1] * db[0]).abs();
        [
            u * v,
            (u - v) * 0.5,
            1.0 / (1.0 + u * u),
            1.0 / (1.0 + spread),
        ]
    }
}

impl Textures for Formulas {
    fn sample(
        &self,
        texture: TextureRef,
        n: usize,
        uv: [&[f32]; 2],
        da: [&[f32]; 2],
        db: [&[f32]; 2],
        out: [&mut [f32]; 4],
    ) {
        for rows in [uv, da, db] {
            assert!(rows.iter().all(|r| r.len() == n), "n numbers in each");
        }
        let pair = |rows: [&[f32]; 2], k: usize| [rows[0][k], rows[1][k]];
        let [r, g, b, a] = out;
        for k in 0..n {
            [r[k], g[k], b[k], a[k]] = Self::at(texture, pair(uv, k), pair(da, k), pair(db, k));
        }
    }
}

/// A small generator (Steele, Lea and Flood 2014, SplitMix64).
pub struct Random(pub u64);

impl Random {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// In [low, high).
    pub fn number(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * ((self.bits() >> 40) as f32 / (1 << 24) as f32)
    }

    /// Below `n`.
    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() % n.max(1) as u64) as usize
    }
}

/// Inputs of `n` hits: coordinates within a few units, footprints of about 1/50.
pub fn inputs(program: &Program, n: usize, random: &mut Random) -> Rows {
    let mut rows = Rows::new(program.input_rows(), n);
    for &(input, first) in &program.inputs {
        for row in first..first + input.kind.width() {
            for k in 0..n {
                let x = match (input.part, input.kind) {
                    (Part::Value, InputKind::Uv(_)) => random.number(-1.0, 2.0),
                    (Part::Value, _) => random.number(-1.0, 1.0),
                    _ => random.number(-0.03, 0.03),
                };
                rows.set(row, k, x);
            }
        }
    }
    rows
}

/// The same inputs with every coordinate of the set moved to its virtual texel's centre
/// and the footprint to the one that it stands for: where a region evaluates.
pub fn at_texel_centres(program: &Program, n: usize, inputs: &Rows, set: u16) -> Rows {
    let mut moved = inputs.clone();
    let row = |part| {
        let input = matcha_shade::input::Input {
            kind: InputKind::Uv(set),
            part,
        };
        program.input_row(input).expect("the program reads the set")
    };
    let (uv, a, b) = (row(Part::Value), row(Part::AxisA), row(Part::AxisB));
    for k in 0..n {
        let length = |r: usize| inputs.get(r, k).hypot(inputs.get(r + 1, k)) as f64;
        let level = (-length(a).min(length(b)).log2()).floor();
        let size = (-level).exp2();
        for i in 0..2 {
            let texel = (inputs.get(uv + i, k) as f64 / size).floor();
            moved.set(uv + i, k, ((texel + 0.5) * size) as f32);
            let axis = (size * std::f64::consts::FRAC_1_SQRT_2) as f32;
            moved.set(a + i, k, if i == 0 { axis } else { 0.0 });
            moved.set(b + i, k, if i == 1 { axis } else { 0.0 });
        }
    }
    moved
}
