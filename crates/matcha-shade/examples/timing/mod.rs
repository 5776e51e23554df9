//! The clock of the measuring programs.

use matcha_shade::graph::TextureRef;
use matcha_shade::program::Program;
use matcha_shade::vm::{Isa, Machine, Rows, Textures};
use std::time::Instant;

/// Images that cost nothing: only the machine is timed.
struct NoTextures;

impl Textures for NoTextures {
    fn sample(
        &self,
        _: TextureRef,
        _: usize,
        _: [&[f32]; 2],
        _: [&[f32]; 2],
        _: [&[f32]; 2],
        out: [&mut [f32]; 4],
    ) {
        out.into_iter().for_each(|row| row.fill(0.5));
    }
}

/// Nanoseconds a point, the best of several runs over `points` hits.
pub fn time(program: &Program, isa: Isa, inputs: &Rows, points: usize) -> f64 {
    let mut machine = Machine::new(Some(isa));
    let mut out = Rows::default();
    let mut best = f64::INFINITY;
    let begin = Instant::now();
    let mut tries = 0;
    // The clock is read once for 64 points or more.
    let runs = (64 / points).max(1);
    while tries < 12 || (tries < 60 && begin.elapsed().as_secs_f64() < 0.01) {
        let start = Instant::now();
        for _ in 0..runs {
            machine.run(program, points, inputs, &[], &NoTextures, None, &mut out);
        }
        best = best.min(start.elapsed().as_nanos() as f64 / (points * runs) as f64);
        tries += 1;
    }
    best
}
