//! What the compiler itself needs: sums and products of numbers and vectors.

use crate::device::{arithmetic, math};

operations! {
    family arithmetic;

    /// a + b. Cycles, Math, *Add*.
    math_add(a: F1, b: F1) -> F1 {
        cost: 0.15, error: 1e-7,
        eval: arithmetic::scalar_add,
    }

    /// a − b. Cycles, Math, *Subtract*.
    math_subtract(a: F1, b: F1) -> F1 {
        cost: 0.15, error: 1e-7,
        eval: arithmetic::scalar_subtract,
    }

    /// a · b. Cycles, Math, *Multiply*.
    math_multiply(a: F1, b: F1) -> F1 {
        cost: 0.15, error: 1e-6,
        eval: arithmetic::scalar_multiply,
    }

    /// a · b + c, rounded twice. Cycles, Math, *Multiply Add*.
    math_multiply_add(a: F1, b: F1, c: F1) -> F1 {
        cost: 0.2, error: 1e-6,
        eval: arithmetic::scalar_multiply_add,
    }

    /// The smaller. Cycles, Math, *Minimum*.
    math_minimum(a: F1, b: F1) -> F1 {
        cost: 0.15, error: 0.0,
        eval: math::min,
    }

    /// The larger. Cycles, Math, *Maximum*.
    math_maximum(a: F1, b: F1) -> F1 {
        cost: 0.15, error: 0.0,
        eval: math::max,
    }

    /// x clamped to [0, 1]; not-a-number gives 0.
    math_saturate(x: F1) -> F1 {
        cost: 0.15, error: 0.0,
        eval: math::saturate,
    }

    /// a where t is 0, b where it is 1: a + (b − a)·t.
    math_mix(a: F1, b: F1, t: F1) -> F1 {
        cost: 0.2, error: 1e-6,
        eval: math::mix,
    }

    /// a + b, by component. Cycles, Vector Math, *Add*.
    vector_add(a: F3, b: F3) -> F3 {
        cost: 0.4, error: 1e-7,
        eval: arithmetic::vector_add,
    }

    /// a − b, by component. Cycles, Vector Math, *Subtract*.
    vector_subtract(a: F3, b: F3) -> F3 {
        cost: 0.4, error: 1e-7,
        eval: arithmetic::vector_subtract,
    }

    /// a · b, by component. Cycles, Vector Math, *Multiply*.
    vector_multiply(a: F3, b: F3) -> F3 {
        cost: 0.4, error: 1e-6,
        eval: arithmetic::vector_multiply,
    }

    /// a · s. Cycles, Vector Math, *Scale*.
    vector_scale(a: F3, s: F1) -> F3 {
        cost: 0.4, error: 1e-6,
        eval: arithmetic::vector_scale,
    }

    /// a where t is 0, b where it is 1, one factor for all components.
    vector_mix(a: F3, b: F3, t: F1) -> F3 {
        cost: 0.5, error: 1e-6,
        eval: math::mix3,
    }

    /// The scalar product. Cycles, Vector Math, *Dot Product*.
    vector_dot(a: F3, b: F3) -> F1 {
        cost: 0.4, error: 1e-5,
        eval: math::dot,
    }

    /// a − b, by component.
    pair_subtract(a: F2, b: F2) -> F2 {
        cost: 0.3, error: 1e-7,
        eval: arithmetic::pair_subtract,
    }

    /// The sum of `count` halvings of x: the smallest operation with a loop, for the
    /// tests of the loop form. `count` is rounded down and clamped to [0, 24].
    series_of_halves(x: F1, count: F1) -> F1 {
        cost: 3.0, error: 1e-5,
        loop: {
            count: arithmetic::halves_count,
            init: arithmetic::halves_init,
            step: arithmetic::halves_step,
            finish: arithmetic::halves_finish,
            state: 2,
        },
    }
}
