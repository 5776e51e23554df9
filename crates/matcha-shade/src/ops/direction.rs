//! Operations on vectors: Cycles, nodes Vector Math, Vector Rotate, Mapping and Normal.

use crate::device::{math, vector};

operations! {
    family direction;

    /// a / b by component, 0 where b is 0. Cycles, Vector Math.
    vector_divide(a: F3, b: F3) -> F3 {
        cost: 0.4, error: 1e-4,
        eval: vector::vector_divide,
    }

    /// a · b + c by component. Cycles, Vector Math.
    vector_multiply_add(a: F3, b: F3, c: F3) -> F3 {
        cost: 0.3, error: 1e-5,
        eval: vector::vector_multiply_add,
    }

    /// The vector product. Cycles, Vector Math.
    vector_cross(a: F3, b: F3) -> F3 {
        cost: 0.3, error: 1e-5,
        eval: math::cross,
    }

    /// a on the line along b. Cycles, Vector Math.
    vector_project(a: F3, b: F3) -> F3 {
        cost: 0.6, error: 1e-3,
        eval: vector::vector_project,
    }

    /// a mirrored at the plane with normal b. Cycles, Vector Math.
    vector_reflect(a: F3, b: F3) -> F3 {
        cost: 1.3, error: 1e-4,
        eval: vector::vector_reflect,
    }

    /// a refracted at the plane with normal b. Cycles, Vector Math.
    vector_refract(a: F3, b: F3, eta: F1) -> F3 {
        cost: 1.9, error: 1e-2,
        eval: vector::vector_refract,
    }

    /// a, turned where b and c point the same way. Cycles, Vector Math.
    vector_faceforward(a: F3, b: F3, c: F3) -> F3 {
        cost: 0.3, error: 0.0,
        eval: vector::vector_faceforward,
    }

    /// |a − b|. Cycles, Vector Math.
    vector_distance(a: F3, b: F3) -> F1 {
        cost: 0.5, error: 1e-5,
        eval: vector::vector_distance,
    }

    /// |a|. Cycles, Vector Math.
    vector_length(a: F3) -> F1 {
        cost: 0.4, error: 1e-5,
        eval: math::length,
    }

    /// a / |a|, zero where a is zero. Cycles, Vector Math.
    vector_normalize(a: F3) -> F3 {
        cost: 0.9, error: 1e-5,
        eval: math::normalize,
    }

    /// The multiple of b at or below a, by component. Cycles, Vector Math.
    vector_snap(a: F3, b: F3) -> F3 {
        cost: 1.0, error: 1e-4,
        eval: vector::vector_snap,
    }

    /// The largest whole numbers not above. Cycles, Vector Math.
    vector_floor(a: F3) -> F3 {
        cost: 0.4, error: 0.0,
        eval: math::floor3,
    }

    /// The smallest whole numbers not below. Cycles, Vector Math.
    vector_ceil(a: F3) -> F3 {
        cost: 0.5, error: 0.0,
        eval: vector::vector_ceil,
    }

    /// The remainder, sign of a, by component. Cycles, Vector Math.
    vector_modulo(a: F3, b: F3) -> F3 {
        cost: 1.1, error: 1e-4,
        eval: vector::vector_modulo,
    }

    /// a repeated between b (high) and c (low), by component. Cycles, Vector Math.
    vector_wrap(a: F3, b: F3, c: F3) -> F3 {
        cost: 1.2, error: 1e-4,
        eval: vector::vector_wrap,
    }

    /// a minus its floor, by component. Cycles, Vector Math.
    vector_fraction(a: F3) -> F3 {
        cost: 0.5, error: 1e-6,
        eval: vector::vector_fraction,
    }

    /// |a| by component. Cycles, Vector Math.
    vector_absolute(a: F3) -> F3 {
        cost: 0.1, error: 0.0,
        eval: math::abs3,
    }

    /// aᵇ by component. Cycles, Vector Math.
    vector_power(a: F3, b: F3) -> F3 {
        cost: 3.8, error: 1e-4,
        eval: vector::vector_power,
    }

    /// Signs by component. Cycles, Vector Math.
    vector_sign(a: F3) -> F3 {
        cost: 0.1, error: 0.0,
        eval: vector::vector_sign,
    }

    /// The smaller by component. Cycles, Vector Math.
    vector_minimum(a: F3, b: F3) -> F3 {
        cost: 0.2, error: 0.0,
        eval: math::min3,
    }

    /// The larger by component. Cycles, Vector Math.
    vector_maximum(a: F3, b: F3) -> F3 {
        cost: 0.2, error: 0.0,
        eval: math::max3,
    }

    /// Sine by component. Cycles, Vector Math.
    vector_sine(a: F3) -> F3 {
        cost: 1.7, error: 1e-6,
        eval: vector::vector_sine,
    }

    /// Cosine by component. Cycles, Vector Math.
    vector_cosine(a: F3) -> F3 {
        cost: 1.7, error: 1e-6,
        eval: vector::vector_cosine,
    }

    /// Tangent by component. Cycles, Vector Math.
    vector_tangent(a: F3) -> F3 {
        cost: 2.9, error: 1e-3,
        eval: vector::vector_tangent,
    }

    /// Limited to [0, 1] by component.
    vector_saturate(a: F3) -> F3 {
        cost: 0.1, error: 0.0,
        eval: math::saturate3,
    }

    /// a where t is 0, b where it is 1, one factor a component. Cycles, Mix Vector, *Non-Uniform*.
    vector_mix_each(a: F3, b: F3, t: F3) -> F3 {
        cost: 0.2, error: 1e-5,
        eval: vector::vector_mix_each,
    }

    /// Mean of the components: a vector as a number.
    vector_average(a: F3) -> F1 {
        cost: 0.1, error: 1e-6,
        eval: vector::vector_average,
    }

    /// v turned by Euler angles, X then Y then Z. Cycles, Vector Rotate and Mapping.
    vector_euler(v: F3, angles: F3) -> F3 {
        cost: 2.7, error: 1e-5,
        eval: vector::vector_euler,
    }

    /// The inverse of vector_euler.
    vector_euler_inverse(v: F3, angles: F3) -> F3 {
        cost: 3.0, error: 1e-5,
        eval: vector::vector_euler_inverse,
    }

    /// v turned about an axis; unchanged where the axis is zero. Cycles, Vector Rotate.
    vector_rotate_axis(v: F3, axis: F3, angle: F1) -> F3 {
        cost: 1.8, error: 1e-5,
        eval: vector::vector_rotate_axis,
    }

    /// One component of a matrix times a point.
    vector_affine_row(p: F3, row: F3, offset: F1) -> F1 {
        cost: 0.2, error: 1e-5,
        eval: vector::vector_affine_row,
    }

    /// Cosine between two vectors. Cycles, Normal.
    vector_normal_dot(a: F3, b: F3) -> F1 {
        cost: 1.3, error: 1e-5,
        eval: vector::vector_normal_dot,
    }
}
