//! Gradient noise, its sums, and white noise.

use crate::device::{fractal, pattern, perlin};

operations! {
    family noise;

    /// Fractional Brownian motion of gradient noise in 1 dimension. Cycles, Noise Texture.
    noise_fbm_1d(p: F3, w: F1, detail: F1, roughness: F1, lacunarity: F1, normalized: U32) -> F1 {
        cost: 5.5, error: 1e-3,
        loop: {
            count: fractal::fbm_count,
            init: fractal::fbm_init,
            step: fractal::fbm_step_1d,
            finish: fractal::fbm_finish,
            state: 5,
        },
    }

    /// Musgrave's variants in 1 dimension. Cycles, Noise Texture.
    noise_fractal_1d(p: F3, w: F1, detail: F1, roughness: F1, lacunarity: F1, offset: F1, gain: F1, kind: U32) -> F1 {
        cost: 6.1, error: 1e-2,
        loop: {
            count: fractal::fractal_count,
            init: fractal::fractal_init,
            step: fractal::fractal_step_1d,
            finish: fractal::fractal_finish,
            state: 4,
        },
    }

    /// Fractional Brownian motion of gradient noise in 2 dimensions. Cycles, Noise Texture.
    noise_fbm_2d(p: F3, w: F1, detail: F1, roughness: F1, lacunarity: F1, normalized: U32) -> F1 {
        cost: 9.0, error: 1e-3,
        loop: {
            count: fractal::fbm_count,
            init: fractal::fbm_init,
            step: fractal::fbm_step_2d,
            finish: fractal::fbm_finish,
            state: 5,
        },
    }

    /// Musgrave's variants in 2 dimensions. Cycles, Noise Texture.
    noise_fractal_2d(p: F3, w: F1, detail: F1, roughness: F1, lacunarity: F1, offset: F1, gain: F1, kind: U32) -> F1 {
        cost: 9.4, error: 1e-2,
        loop: {
            count: fractal::fractal_count,
            init: fractal::fractal_init,
            step: fractal::fractal_step_2d,
            finish: fractal::fractal_finish,
            state: 4,
        },
    }

    /// Fractional Brownian motion of gradient noise in 3 dimensions. Cycles, Noise Texture.
    noise_fbm_3d(p: F3, w: F1, detail: F1, roughness: F1, lacunarity: F1, normalized: U32) -> F1 {
        cost: 13.4, error: 1e-3,
        loop: {
            count: fractal::fbm_count,
            init: fractal::fbm_init,
            step: fractal::fbm_step_3d,
            finish: fractal::fbm_finish,
            state: 5,
        },
    }

    /// Musgrave's variants in 3 dimensions. Cycles, Noise Texture.
    noise_fractal_3d(p: F3, w: F1, detail: F1, roughness: F1, lacunarity: F1, offset: F1, gain: F1, kind: U32) -> F1 {
        cost: 14.8, error: 1e-2,
        loop: {
            count: fractal::fractal_count,
            init: fractal::fractal_init,
            step: fractal::fractal_step_3d,
            finish: fractal::fractal_finish,
            state: 4,
        },
    }

    /// Fractional Brownian motion of gradient noise in 4 dimensions. Cycles, Noise Texture.
    noise_fbm_4d(p: F3, w: F1, detail: F1, roughness: F1, lacunarity: F1, normalized: U32) -> F1 {
        cost: 27.5, error: 1e-3,
        loop: {
            count: fractal::fbm_count,
            init: fractal::fbm_init,
            step: fractal::fbm_step_4d,
            finish: fractal::fbm_finish,
            state: 5,
        },
    }

    /// Musgrave's variants in 4 dimensions. Cycles, Noise Texture.
    noise_fractal_4d(p: F3, w: F1, detail: F1, roughness: F1, lacunarity: F1, offset: F1, gain: F1, kind: U32) -> F1 {
        cost: 29.8, error: 1e-2,
        loop: {
            count: fractal::fractal_count,
            init: fractal::fractal_init,
            step: fractal::fractal_step_4d,
            finish: fractal::fractal_finish,
            state: 4,
        },
    }

    /// Gradient noise in 1 dimension.
    noise_signed_1d(p: F1) -> F1 {
        cost: 2.1, error: 1e-4,
        eval: perlin::noise_1d,
    }

    /// Gradient noise in 2 dimensions.
    noise_signed_2d(p: F2) -> F1 {
        cost: 2.9, error: 1e-4,
        eval: perlin::noise_2d,
    }

    /// Gradient noise in 3 dimensions.
    noise_signed_3d(p: F3) -> F1 {
        cost: 4.5, error: 1e-4,
        eval: perlin::noise_3d,
    }

    /// Gradient noise in 4 dimensions.
    noise_signed_4d(p: F3, w: F1) -> F1 {
        cost: 9.3, error: 1e-4,
        eval: perlin::noise_4d,
    }

    /// A random number of a coordinate in 1 dimension. Cycles, White Noise.
    white_noise_1d(w: F1) -> F1 {
        cost: 0.3, error: 0.0,
        eval: pattern::white_noise_1d,
    }

    /// A random colour of a coordinate in 1 dimension. Cycles, White Noise.
    white_noise_color_1d(w: F1) -> Color {
        cost: 0.7, error: 0.0,
        eval: pattern::white_noise_color_1d,
    }

    /// A random number of a coordinate in 2 dimensions. Cycles, White Noise.
    white_noise_2d(p: F3) -> F1 {
        cost: 0.3, error: 0.0,
        eval: pattern::white_noise_2d,
    }

    /// A random colour of a coordinate in 2 dimensions. Cycles, White Noise.
    white_noise_color_2d(p: F3) -> Color {
        cost: 0.7, error: 0.0,
        eval: pattern::white_noise_color_2d,
    }

    /// A random number of a coordinate in 3 dimensions. Cycles, White Noise.
    white_noise_3d(p: F3) -> F1 {
        cost: 0.4, error: 0.0,
        eval: pattern::white_noise_3d,
    }

    /// A random colour of a coordinate in 3 dimensions. Cycles, White Noise.
    white_noise_color_3d(p: F3) -> Color {
        cost: 1.1, error: 0.0,
        eval: pattern::white_noise_color_3d,
    }

    /// A random number of a coordinate in 4 dimensions. Cycles, White Noise.
    white_noise_4d(p: F3, w: F1) -> F1 {
        cost: 0.7, error: 0.0,
        eval: pattern::white_noise_4d,
    }

    /// A random colour of a coordinate in 4 dimensions. Cycles, White Noise.
    white_noise_color_4d(p: F3, w: F1) -> Color {
        cost: 1.6, error: 0.0,
        eval: pattern::white_noise_color_4d,
    }
}
