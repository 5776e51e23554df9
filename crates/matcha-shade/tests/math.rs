//! The prelude of device code against f64: domains and errors as its documentation says.

use matcha_shade::device::math::*;

/// Even steps over a range.
fn over(low: f64, high: f64) -> impl Iterator<Item = f32> {
    let n = 20_011;
    (0..=n).map(move |i| (low + (high - low) * f64::from(i) / f64::from(n)) as f32)
}

/// Largest |f − exact|, divided by max(|exact|, `floor`).
fn worst(
    xs: impl Iterator<Item = f32>,
    f: fn(f32) -> f32,
    exact: fn(f64) -> f64,
    floor: f64,
) -> f64 {
    let error = |x: f32| {
        let e = exact(f64::from(x));
        let error = (f64::from(f(x)) - e).abs() / e.abs().max(floor);
        assert!(!error.is_nan(), "at {x}: {} instead of {e}", f(x));
        error
    };
    xs.map(error).fold(0.0, f64::max)
}

#[track_caller]
fn within(error: f64, limit: f64) {
    assert!(error <= limit, "{error:e} > {limit:e}");
}

#[test]
fn sines_and_cosines() {
    within(worst(over(-8.0, 8.0), sin, f64::sin, 1.0), 1.5e-7);
    within(worst(over(-8.0, 8.0), cos, f64::cos, 1.0), 1.5e-7);
    within(worst(over(-1e4, 1e4), sin, f64::sin, 1.0), 2.5e-7);
    within(worst(over(-1e4, 1e4), cos, f64::cos, 1.0), 2.5e-7);
    within(worst(over(-1.4, 1.4), tan, f64::tan, 1.0), 5e-7);
}

#[test]
fn what_is_finite() {
    for x in [0.0, -0.0, 1.0, -MAX, MAX, f32::MIN_POSITIVE, 1e-45] {
        assert!(is_finite(x), "{x}");
        assert!(is_finite3(splat3(x)), "{x}");
    }
    for x in [f32::INFINITY, f32::NEG_INFINITY, f32::NAN, -f32::NAN] {
        assert!(!is_finite(x), "{x}");
        for v in [vec3(x, 0.0, 0.0), vec3(0.0, x, 0.0), vec3(0.0, 0.0, x)] {
            assert!(!is_finite3(v), "{v}");
        }
    }
}

#[test]
fn exponentials_and_logarithms() {
    within(worst(over(-120.0, 127.0), exp2, f64::exp2, 0.0), 2.5e-7);
    within(worst(over(-80.0, 80.0), exp, f64::exp, 0.0), 5e-7);
    within(worst(over(1e-6, 4.0), log2, f64::log2, 0.1), 3e-7);
    within(worst(over(1.0, 1e9), log2, f64::log2, 0.1), 3e-7);
    within(worst(over(1e-6, 1e6), log, f64::ln, 0.1), 3e-7);
    assert_eq!(exp2(f32::NEG_INFINITY), 0.0);
    assert_eq!(log2(0.0), -127.0);
}

#[test]
fn powers() {
    for y in [-3.5f32, -1.0, 0.3, 0.5, 2.2, 7.0] {
        for x in over(1e-3, 50.0) {
            let e = f64::from(x).powf(f64::from(y));
            let scale = 1.0 + f64::from(y.abs()) * f64::from(x).log2().abs();
            within((f64::from(pow(x, y)) - e).abs() / e / scale, 4e-7);
        }
    }
    assert_eq!(pow(-2.0, 3.0), -pow(2.0, 3.0));
    assert_eq!(pow(-2.0, 2.0), pow(2.0, 2.0));
    assert_eq!(pow(-2.0, 0.5), 0.0);
    assert_eq!(pow(0.0, 0.0), 1.0);
    assert_eq!(pow(0.0, 2.0), 0.0);
}

#[test]
fn arcs() {
    within(worst(over(-1.0, 1.0), asin, f64::asin, 1.0), 3e-7);
    within(worst(over(-1.0, 1.0), acos, f64::acos, 1.0), 4e-7);
    within(worst(over(-50.0, 50.0), atan, f64::atan, 1.0), 4e-7);
    for i in 0..720 {
        let a = f64::from(i) * std::f64::consts::TAU / 720.0 - 3.1;
        let (y, x) = (a.sin() as f32, a.cos() as f32);
        let exact = f64::from(y).atan2(f64::from(x));
        within((f64::from(atan2(y, x)) - exact).abs(), 4e-7);
    }
    assert_eq!(atan2(0.0, 0.0), 0.0);
    assert_eq!(asin(3.0), asin(1.0));
}

#[test]
fn hyperbolics() {
    within(worst(over(-20.0, 20.0), sinh, f64::sinh, 1e-30), 1e-6);
    within(worst(over(-20.0, 20.0), cosh, f64::cosh, 0.0), 1e-6);
    within(worst(over(-20.0, 20.0), tanh, f64::tanh, 1e-30), 1e-6);
}

#[test]
fn whole_numbers() {
    let edges = [
        0.0,
        -0.0,
        0.5,
        -0.5,
        1.0,
        -1.0,
        0.999_999_94,
        -0.999_999_94,
        8_388_607.5,
        -8_388_607.5,
        8_388_608.0,
        1e9,
        -1e9,
        1e30,
        -1e30,
        f32::MAX,
        f32::MIN_POSITIVE,
        -f32::MIN_POSITIVE,
    ];
    for x in over(-40.0, 40.0).chain(edges) {
        assert_eq!(floor(x), x.floor(), "floor {x}");
        assert_eq!(ceil(x), x.ceil(), "ceil {x}");
        assert_eq!(trunc(x), x.trunc(), "trunc {x}");
        assert!((0.0..=1.0).contains(&fract(x)), "fract {x}");
    }
    assert_eq!(to_int(f32::NAN), -(1 << 30));
    assert_eq!(to_int(1e20), 1 << 30);
}

#[test]
fn remainders() {
    for b in [0.3f32, 1.0, 7.5, -2.0] {
        for a in over(-200.0, 200.0) {
            let exact = f64::from(a) % f64::from(b);
            let error = (f64::from(modulo(a, b)) - exact).abs();
            // A quotient next to a whole number may be taken for it.
            let wrapped = (error - f64::from(b.abs())).abs();
            within(error.min(wrapped), 2e-5);
        }
    }
    assert_eq!(modulo(5.0, 0.0), 0.0);
    assert_eq!(floored_modulo(-1.0, 3.0), 2.0);
    assert_eq!(floored_modulo(1.0, 0.0), 0.0);
}

#[test]
fn selections_and_limits() {
    assert_eq!(select(1.0, 2.0, true), 2.0);
    assert_eq!(clamp(f32::NAN, 1.0, 2.0), 1.0);
    assert_eq!(saturate(-3.0), 0.0);
    assert_eq!(min(1.0, 2.0), 1.0);
    assert_eq!(max(1.0, 2.0), 2.0);
    assert_eq!(abs(-0.5), 0.5);
    assert_eq!(negate_if(2.0, true), -2.0);
    assert_eq!(safe_divide(1.0, 0.0), 0.0);
    assert_eq!(normalize(vec3(0.0, 0.0, 0.0)), vec3(0.0, 0.0, 0.0));
    assert_eq!(smoothstep(0.0, 0.0, 1.0), 0.0);
}
