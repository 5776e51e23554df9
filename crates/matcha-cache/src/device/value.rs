//! How a value of some kind lies in the words of the table.

use glam::{Vec2, Vec3};

use super::encoding::{
    color_fits, decode_color, decode_normal, decode_pair, decode_scalar, decode_vector,
    encode_color, encode_normal, encode_pair, encode_scalar, encode_vector, normal_fits, pair_fits,
    scalar_fits, vector_fits,
};

/// A number, exact; 1 component.
pub const VALUE_SCALAR: u32 = 0;
/// A gradient in UV; 2 components.
pub const VALUE_PAIR: u32 = 1;
/// Linear colour without negative channels; 3.
pub const VALUE_COLOR: u32 = 2;
/// Colour with alpha; 4, in two words.
pub const VALUE_COLOR_ALPHA: u32 = 3;
/// Vector with signs; 3.
pub const VALUE_VECTOR: u32 = 4;
/// Unit normal; 3.
pub const VALUE_NORMAL: u32 = 5;
/// Texture coordinates, which bear no rounding: exact, one word each; 2.
pub const VALUE_COORDINATES_2: u32 = 6;
/// Likewise; 3.
pub const VALUE_COORDINATES_3: u32 = 7;

/// A value in words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EncodedValue {
    /// The encoding can hold the value; if not, it must not be stored.
    pub fits: bool,
    /// The words; those past [`value_words`] are 0.
    pub words: [u32; 3],
}

/// Words that a value of a kind takes, each an entry of its own.
#[inline(always)]
pub fn value_words(kind: u32) -> u32 {
    if kind == VALUE_COLOR_ALPHA || kind == VALUE_COORDINATES_2 {
        2
    } else if kind == VALUE_COORDINATES_3 {
        3
    } else {
        1
    }
}

/// Packs a value; components beyond the kind's width are ignored.
#[inline(always)]
pub fn value_encode(kind: u32, value: [f32; 4]) -> EncodedValue {
    let v = Vec3::new(value[0], value[1], value[2]);
    let pair = Vec2::new(value[0], value[1]);
    let mut fits = scalar_fits(value[0]);
    let mut words = [0, 0, 0];
    if kind == VALUE_SCALAR {
        words[0] = encode_scalar(value[0]);
    } else if kind == VALUE_PAIR {
        fits = pair_fits(pair);
        words[0] = encode_pair(pair);
    } else if kind == VALUE_COLOR {
        fits = color_fits(v);
        words[0] = encode_color(v);
    } else if kind == VALUE_COLOR_ALPHA {
        fits = color_fits(v) && scalar_fits(value[3]);
        words[0] = encode_color(v);
        words[1] = encode_scalar(value[3]);
    } else if kind == VALUE_VECTOR {
        fits = vector_fits(v);
        words[0] = encode_vector(v);
    } else if kind == VALUE_NORMAL {
        fits = normal_fits(v);
        words[0] = encode_normal(v);
    } else {
        fits = fits && scalar_fits(value[1]);
        words[0] = encode_scalar(value[0]);
        words[1] = encode_scalar(value[1]);
        if kind == VALUE_COORDINATES_3 {
            fits = fits && scalar_fits(value[2]);
            words[2] = encode_scalar(value[2]);
        }
    }
    EncodedValue { fits, words }
}

/// The value from its words; components beyond the kind's width are 0.
#[inline(always)]
pub fn value_decode(kind: u32, words: [u32; 3]) -> [f32; 4] {
    let mut v = Vec3::new(decode_scalar(words[0]), 0.0, 0.0);
    let mut alpha = 0.0;
    if kind == VALUE_PAIR {
        let pair = decode_pair(words[0]);
        v = Vec3::new(pair.x, pair.y, 0.0);
    } else if kind == VALUE_COLOR {
        v = decode_color(words[0]);
    } else if kind == VALUE_COLOR_ALPHA {
        v = decode_color(words[0]);
        alpha = decode_scalar(words[1]);
    } else if kind == VALUE_VECTOR {
        v = decode_vector(words[0]);
    } else if kind == VALUE_NORMAL {
        v = decode_normal(words[0]);
    } else if kind >= VALUE_COORDINATES_2 {
        v.y = decode_scalar(words[1]);
        if kind == VALUE_COORDINATES_3 {
            v.z = decode_scalar(words[2]);
        }
    }
    [v.x, v.y, v.z, alpha]
}
