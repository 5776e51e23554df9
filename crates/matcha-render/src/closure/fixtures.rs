//! What the tests of closures share: rows by parameter names, random numbers, frames.

use super::{ClosureContext, Frame, LobeSet, prepare_closure};
use glam::Vec3;
use matcha_shade::closure::ClosureKind;

/// Numbers of a closure by parameter name; what is not named has the artists' default.
pub fn rows(kind: ClosureKind, weight: Vec3, given: &[(&str, &[f32])]) -> Vec<f32> {
    let mut out = weight.to_array().to_vec();
    let names: Vec<_> = kind.parameters().iter().map(|p| p.name).collect();
    for (name, _) in given {
        assert!(names.contains(name), "{kind:?} has no parameter {name}");
    }
    for parameter in kind.parameters() {
        let width = parameter.ty.width();
        match given.iter().find(|g| g.0 == parameter.name) {
            Some((_, values)) => {
                assert_eq!(values.len(), width, "{}", parameter.name);
                out.extend_from_slice(values);
            }
            None => out.extend_from_slice(&default(parameter.name)[..width]),
        }
    }
    out
}

fn default(name: &str) -> [f32; 3] {
    match name {
        "normal" | "coat_normal" => [0.0, 0.0, 1.0],
        "tangent" => [1.0, 0.0, 0.0],
        "roughness" | "specular_ior_level" | "sheen_roughness" => [0.5; 3],
        "ior" | "coat_ior" => [1.5; 3],
        "subsurface_ior" => [1.4; 3],
        "coat_roughness" => [0.03; 3],
        "thin_film_ior" => [1.33; 3],
        "base_color" => [0.8; 3],
        "alpha" | "color" | "specular_tint" | "coat_tint" | "sheen_tint" | "emission_color"
        | "subsurface_radius" => [1.0; 3],
        _ => [0.0; 3],
    }
}

/// A flat point whose normal is +Z, seen under a cosine from azimuth 0.3.
pub fn frame(cosine: f32) -> Frame {
    Frame {
        n: Vec3::Z,
        ng: Vec3::Z,
        wo: direction(cosine, 0.3),
        backfacing: false,
        bump_correction: true,
    }
}

/// Unit vector from its z and azimuth.
pub fn direction(z: f32, azimuth: f32) -> Vec3 {
    let radius = (1.0 - z * z).max(0.0).sqrt();
    Vec3::new(radius * azimuth.cos(), radius * azimuth.sin(), z)
}

/// The lobes of one closure.
pub fn lobes(kind: ClosureKind, rows: &[f32], frame: &Frame) -> LobeSet {
    let mut set = LobeSet::new();
    set.begin(frame);
    prepare_closure(kind, rows, &ClosureContext::default(), &mut set);
    set
}

/// Uniform numbers (PCG, O'Neill 2014).
pub struct Random(pub u64);

impl Random {
    /// In [0, 1).
    pub fn f1(&mut self) -> f32 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let word = (((self.0 >> 18) ^ self.0) >> 27) as u32;
        let word = word.rotate_right((self.0 >> 59) as u32);
        (word >> 8) as f32 / 16_777_216.0
    }

    /// Three of them.
    pub fn f3(&mut self) -> Vec3 {
        Vec3::new(self.f1(), self.f1(), self.f1())
    }
}
