//! The stated errors of the encodings, over random values and at the corners.
#![cfg(not(loom))]

use glam::{Vec2, Vec3, vec2, vec3};
use matcha_cache::device::encoding::*;
use proptest::prelude::*;

/// Numbers of all magnitudes between `2^low` and `2^high`, and zero.
fn magnitude(low: f32, high: f32) -> impl Strategy<Value = f32> {
    prop_oneof![9 => (low..high).prop_map(f32::exp2), 1 => Just(0.0f32)]
}

fn signed(low: f32, high: f32) -> impl Strategy<Value = f32> {
    (magnitude(low, high), any::<bool>()).prop_map(|(x, negative)| if negative { -x } else { x })
}

fn color() -> impl Strategy<Value = Vec3> {
    (
        magnitude(-20.0, 16.0),
        0.0f32..=1.0,
        0.0f32..=1.0,
        0..3usize,
    )
        .prop_map(|(m, a, b, lead)| {
            let mut c = [m * a, m * b, m];
            c.swap(2, lead);
            Vec3::from_array(c)
        })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn color_error(c in color()) {
        prop_assert!(color_fits(c));
        let decoded = decode_color(encode_color(c));
        let m = c.max_element().max(0.5f32.powi(15));
        for k in 0..3 {
            let allowed = 0.00277 * (c[k] * m).sqrt() + 2e-6 * m;
            prop_assert!((decoded[k] - c[k]).abs() <= allowed, "{c} {decoded}");
        }
    }

    #[test]
    fn vector_error(x in signed(-20.0, 16.0), y in signed(-20.0, 16.0), z in signed(-20.0, 16.0)) {
        let v = vec3(x, y, z);
        prop_assert!(vector_fits(v));
        let decoded = decode_vector(encode_vector(v));
        let m = v.abs().max_element();
        let allowed = if m >= 0.5f32.powi(15) { 0.004 * m } else { 6e-8 };
        prop_assert!((decoded - v).abs().max_element() <= allowed, "{v} {decoded}");
    }

    #[test]
    fn pair_error(x in signed(-40.0, 31.0), y in signed(-40.0, 31.0)) {
        let v = vec2(x, y);
        prop_assert!(pair_fits(v));
        let decoded = decode_pair(encode_pair(v));
        let m = v.abs().max_element();
        let allowed = if m >= 0.5f32.powi(32) { 0.00025 * m } else { 3e-14 };
        prop_assert!((decoded - v).abs().max_element() <= allowed, "{v} {decoded}");
    }

    #[test]
    fn normal_error(x in -1.0f32..1.0, y in -1.0f32..1.0, z in -1.0f32..1.0) {
        prop_assume!(vec3(x, y, z).length() > 0.01);
        let n = vec3(x, y, z).normalize();
        prop_assert!(normal_fits(n));
        let decoded = decode_normal(encode_normal(n));
        prop_assert!((decoded.length() - 1.0).abs() < 1e-6);
        let angle = n.as_dvec3().cross(decoded.as_dvec3()).length().asin();
        prop_assert!(angle <= 0.00007 && n.dot(decoded) > 0.0, "{n} {decoded} {angle}");
    }

    #[test]
    fn scalar_is_exact(bits in any::<u32>()) {
        let x = f32::from_bits(bits);
        prop_assert_eq!(scalar_fits(x), x.is_finite());
        prop_assert_eq!(encode_scalar(decode_scalar(bits)), bits);
    }

    #[test]
    fn every_word_decodes_to_something_finite(word in any::<u32>()) {
        prop_assert!(decode_color(word).is_finite());
        prop_assert!(decode_vector(word).is_finite());
        prop_assert!(decode_pair(word).is_finite());
        prop_assert!(decode_normal(word).is_normalized());
    }
}

#[test]
fn black_white_and_axes_are_exact() {
    for c in [
        Vec3::ZERO,
        Vec3::ONE,
        vec3(1.0, 0.0, 0.0),
        Vec3::splat(0.25),
        Vec3::splat(65536.0),
    ] {
        assert_eq!(decode_color(encode_color(c)), c);
        assert_eq!(decode_vector(encode_vector(-c)), -c);
        assert_eq!(decode_pair(encode_pair(-c.truncate())), -c.truncate());
    }
    for n in [Vec3::X, Vec3::Y, Vec3::Z, -Vec3::X, -Vec3::Y, -Vec3::Z] {
        assert_eq!(decode_normal(encode_normal(n)), n);
    }
}

#[test]
fn limits_are_limits() {
    let above = LARGEST_ENCODED.next_up();
    assert!(color_fits(Vec3::splat(LARGEST_ENCODED)) && !color_fits(Vec3::splat(above)));
    assert!(vector_fits(Vec3::splat(-LARGEST_ENCODED)) && !vector_fits(Vec3::splat(-above)));
    let above = LARGEST_ENCODED_PAIR.next_up();
    assert!(pair_fits(Vec2::splat(-LARGEST_ENCODED_PAIR)) && !pair_fits(Vec2::splat(above)));
    assert!(!normal_fits(Vec3::ZERO) && !normal_fits(Vec3::splat(0.6)));
}
