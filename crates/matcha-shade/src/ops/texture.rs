//! Cycles' small textures, and the projections of images.

use crate::device::{pattern, shading};

operations! {
    family texture;

    /// Phase of a place among bands. Cycles, Wave Texture.
    wave_bands(p: F3, direction: U32) -> F1 {
        cost: 0.1, error: 1e-3,
        eval: pattern::wave_bands,
    }

    /// Phase of a place among rings. Cycles, Wave Texture.
    wave_rings(p: F3, direction: U32) -> F1 {
        cost: 0.7, error: 1e-3,
        eval: pattern::wave_rings,
    }

    /// Value of a phase. Cycles, Wave Texture.
    wave_profile(phase: F1, profile: U32) -> F1 {
        cost: 1.5, error: 1e-4,
        eval: pattern::wave_profile,
    }

    /// Where a wave's distortion is read. Cycles, Wave Texture.
    wave_noise_place(p: F3, scale: F1) -> F3 {
        cost: 0.4, error: 1e-5,
        eval: pattern::wave_noise_place,
    }

    /// Cycles, Gradient Texture.
    gradient_value(p: F3, kind: U32) -> F1 {
        cost: 1.8, error: 1e-5,
        eval: pattern::gradient_value,
    }

    /// 1 in every other cell. Cycles, Checker Texture.
    checker_value(p: F3) -> F1 {
        cost: 0.9, error: 0.0,
        eval: pattern::checker_value,
    }

    /// Place in a brick, its width and random number. Cycles, Brick Texture.
    brick_place(p: F3, width: F1, height: F1, offset: F1, squash: F1, frequency: U32) -> F4 {
        cost: 2.4, error: 1e-3,
        eval: pattern::brick_place,
    }

    /// Mortar at a place of a brick. Cycles, Brick Texture.
    brick_mortar(place: F4, height: F1, mortar: F1, smooth: F1) -> F1 {
        cost: 1.3, error: 1e-2,
        eval: pattern::brick_mortar,
    }

    /// Cycles, Magic Texture.
    magic_color(p: F3, scale: F1, distortion: F1, depth: U32) -> Color {
        cost: 3.1, error: 1e-2,
        eval: pattern::magic_color,
    }

    /// Place of a direction in an equirectangular map. Cycles, Environment Texture.
    equirectangular_uv(d: F3) -> F2 {
        cost: 2.4, error: 1e-5,
        eval: shading::equirectangular_uv,
    }

    /// Place of a direction in a mirror ball. Cycles, Environment Texture.
    mirror_ball_uv(d: F3) -> F2 {
        cost: 1.9, error: 1e-4,
        eval: shading::mirror_ball_uv,
    }

    /// Place on a sphere. Cycles, Image Texture, *Sphere*.
    sphere_uv(p: F3) -> F2 {
        cost: 2.5, error: 1e-5,
        eval: shading::sphere_uv,
    }

    /// Place on a cylinder. Cycles, Image Texture, *Tube*.
    tube_uv(p: F3) -> F2 {
        cost: 2.7, error: 1e-5,
        eval: shading::tube_uv,
    }

    /// Weights of an image's three projections. Cycles, Image Texture, *Box*.
    box_weights(n: F3, blend: F1) -> F3 {
        cost: 2.5, error: 1e-4,
        eval: shading::box_weights,
    }
}
