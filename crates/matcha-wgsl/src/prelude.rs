//! What WGSL offers by itself: the functions of the device prelude that are not
//! translated from their bodies but become an operator or a builtin.
//!
//! Only those are here for which WGSL gives the same value for every argument, not-a-number
//! and the sign of zero included. So `min`, `max`, `clamp` and everything transcendental
//! are NOT here: WGSL leaves open what its `min` makes of not-a-number, and its `sin` is
//! as good as the device's.
//!
//! `floor` and `trunc` are here because their bodies would not do: drivers take a float's
//! integer's float for WGSL's `trunc`, which keeps the sign of a zero (Mesa 22.3 does), and
//! −0 hashes to another cell than 0. The device's never give −0.

use crate::types::Ty;

/// How a call of a prelude function is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Intrinsic {
    /// `name(arguments)`, a builtin.
    Builtin(&'static str),
    /// `(a operator b)`.
    Operator(&'static str),
    /// The result's type, of the arguments.
    Construct,
    /// A function of the translator's own, in WGSL.
    Helper(&'static str),
}

/// The prelude's functions that WGSL has.
pub(crate) const INTRINSICS: &[(&str, Intrinsic)] = &[
    ("vec2", Intrinsic::Construct),
    ("vec3", Intrinsic::Construct),
    ("select", Intrinsic::Builtin("select")),
    ("select_u32", Intrinsic::Builtin("select")),
    ("select3", Intrinsic::Builtin("select")),
    ("bits_of", Intrinsic::Builtin("bitcast<u32>")),
    ("float_of", Intrinsic::Builtin("bitcast<f32>")),
    ("abs", Intrinsic::Builtin("abs")),
    ("sqrt", Intrinsic::Builtin("sqrt")),
    ("wrapping_mul", Intrinsic::Operator("*")),
    ("wrapping_add", Intrinsic::Operator("+")),
    ("wrapping_sub", Intrinsic::Operator("-")),
    (
        "floor",
        Intrinsic::Helper(
            "fn floor_(x: f32) -> f32 { let y = floor(x); return select(y, 0.0f, y == 0.0f); }",
        ),
    ),
    (
        "trunc",
        Intrinsic::Helper(
            "fn trunc_(x: f32) -> f32 { let y = trunc(x); return select(y, 0.0f, y == 0.0f); }",
        ),
    ),
    (
        "rotate_left",
        Intrinsic::Helper(
            "fn rotate_left(x: u32, n: u32) -> u32 { return (x << n) | (x >> (32u - n)); }",
        ),
    ),
    (
        "multiply_high",
        Intrinsic::Helper(
            "fn multiply_high(a: u32, b: u32) -> u32 { \
             let low = (a & 0xffffu) * (b & 0xffffu); \
             let left = (a >> 16u) * (b & 0xffffu) + (low >> 16u); \
             let right = (a & 0xffffu) * (b >> 16u) + (left & 0xffffu); \
             return (a >> 16u) * (b >> 16u) + (left >> 16u) + (right >> 16u); }",
        ),
    ),
];

/// How a prelude function is written, if WGSL has it.
pub(crate) fn intrinsic(name: &str) -> Option<Intrinsic> {
    let entry = INTRINSICS.iter().find(|(known, _)| *known == name)?;
    Some(entry.1)
}

/// True for a module that names what a GPU language offers, for a crate that cannot
/// import the prelude. Its bodies are never translated.
pub(crate) fn is_intrinsics_module(path: &str) -> bool {
    std::path::Path::new(path)
        .file_stem()
        .is_some_and(|stem| stem == "intrinsics")
}

/// Constants of the standard library and of glam by the last two parts of their path.
pub(crate) fn known_constant(owner: &str, name: &str) -> Option<(f32, Ty)> {
    use std::f32::consts;
    let value = match (owner, name) {
        ("f32", "MAX") => f32::MAX,
        ("f32", "MIN") => f32::MIN,
        ("f32", "MIN_POSITIVE") => f32::MIN_POSITIVE,
        ("f32", "EPSILON") => f32::EPSILON,
        ("consts", "PI") => consts::PI,
        ("consts", "TAU") => consts::TAU,
        ("consts", "FRAC_PI_2") => consts::FRAC_PI_2,
        ("consts", "FRAC_PI_4") => consts::FRAC_PI_4,
        ("consts", "FRAC_1_PI") => consts::FRAC_1_PI,
        ("consts", "FRAC_2_PI") => consts::FRAC_2_PI,
        ("consts", "E") => consts::E,
        ("consts", "LN_2") => consts::LN_2,
        ("consts", "LOG2_E") => consts::LOG2_E,
        ("consts", "SQRT_2") => consts::SQRT_2,
        ("consts", "FRAC_1_SQRT_2") => consts::FRAC_1_SQRT_2,
        ("Vec2", "ZERO") => return Some((0.0, Ty::Vec2)),
        ("Vec3", "ZERO") => return Some((0.0, Ty::Vec3)),
        ("Vec2", "ONE") => return Some((1.0, Ty::Vec2)),
        ("Vec3", "ONE") => return Some((1.0, Ty::Vec3)),
        _ => return None,
    };
    Some((value, Ty::F32))
}
