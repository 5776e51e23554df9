//! How a value of some type is laid into words of the table.

use crate::device::encoding::*;
use crate::device::value as device;
use glam::Vec3;

/// Meaning of a cacheable node's value, which decides its encoding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u32)]
pub enum ValueKind {
    /// A number, exact; 1 component.
    Scalar = device::VALUE_SCALAR,
    /// A gradient in UV; 2 components.
    Pair = device::VALUE_PAIR,
    /// Linear colour without negative channels; 3.
    Color = device::VALUE_COLOR,
    /// Colour with alpha; 4, in two words.
    ColorAlpha = device::VALUE_COLOR_ALPHA,
    /// Vector with signs; 3.
    Vector = device::VALUE_VECTOR,
    /// Unit normal; 3.
    Normal = device::VALUE_NORMAL,
    /// Texture coordinates, which bear no rounding: exact, one word each; 2.
    Coordinates2 = device::VALUE_COORDINATES_2,
    /// Likewise; 3.
    Coordinates3 = device::VALUE_COORDINATES_3,
}

/// Most words that a value takes.
pub const MOST_WORDS: usize = 3;

impl ValueKind {
    /// Number of components.
    pub fn width(self) -> usize {
        match self {
            ValueKind::Scalar => 1,
            ValueKind::Pair | ValueKind::Coordinates2 => 2,
            ValueKind::ColorAlpha => 4,
            ValueKind::Color | ValueKind::Vector | ValueKind::Normal | ValueKind::Coordinates3 => 3,
        }
    }

    /// Number of words, each an entry of its own (see `part` of
    /// [`node_seed`](crate::node_seed)). All must be found for the value to be.
    pub fn words(self) -> usize {
        device::value_words(self.code()) as usize
    }

    /// What device code calls it.
    pub fn code(self) -> u32 {
        self as u32
    }

    /// The value in words; `None` where the encoding cannot hold it, and then it must
    /// not be stored. Components beyond the width are ignored.
    pub fn encode(self, value: [f32; 4]) -> Option<[u32; MOST_WORDS]> {
        let encoded = device::value_encode(self.code(), value);
        encoded.fits.then_some(encoded.words)
    }

    /// The value from its words; components beyond the width are 0.
    pub fn decode(self, words: [u32; MOST_WORDS]) -> [f32; 4] {
        device::value_decode(self.code(), words)
    }

    /// One component of many values: `words[p]` holds part `p` of each, `out` takes the
    /// component.
    pub fn decode_component(self, component: usize, words: &[&[u32]], out: &mut [f32]) {
        let rows = |p: usize| &words[p][..out.len()];
        match self {
            ValueKind::Scalar => fill(out, rows(0), decode_scalar),
            ValueKind::Pair if component == 0 => fill(out, rows(0), |w| decode_pair(w).x),
            ValueKind::Pair => fill(out, rows(0), |w| decode_pair(w).y),
            ValueKind::ColorAlpha if component == 3 => fill(out, rows(1), decode_scalar),
            ValueKind::Color | ValueKind::ColorAlpha => {
                fill3(out, rows(0), component, decode_color)
            }
            ValueKind::Vector => fill3(out, rows(0), component, decode_vector),
            ValueKind::Normal => fill3(out, rows(0), component, decode_normal),
            ValueKind::Coordinates2 | ValueKind::Coordinates3 => {
                fill(out, rows(component), decode_scalar);
            }
        }
    }
}

#[inline(always)]
fn fill(out: &mut [f32], words: &[u32], decode: impl Fn(u32) -> f32) {
    for (out, &word) in out.iter_mut().zip(words) {
        *out = decode(word);
    }
}

/// A loop for each component, so that each is a plain one.
#[inline(always)]
fn fill3(out: &mut [f32], words: &[u32], component: usize, decode: impl Fn(u32) -> Vec3) {
    match component {
        0 => fill(out, words, |word| decode(word).x),
        1 => fill(out, words, |word| decode(word).y),
        _ => fill(out, words, |word| decode(word).z),
    }
}

#[cfg(all(test, not(loom)))]
mod tests {
    use super::*;
    use ValueKind::*;

    const ALL: [ValueKind; 8] = [
        Scalar,
        Pair,
        Color,
        ColorAlpha,
        Vector,
        Normal,
        Coordinates2,
        Coordinates3,
    ];

    #[test]
    fn rows_decode_as_single_values_do() {
        for kind in ALL {
            let words = kind.encode([0.6, 0.0, 0.8, 0.5]).unwrap();
            let value = kind.decode(words);
            let parts: Vec<[u32; 3]> = words.iter().map(|&word| [word; 3]).collect();
            let parts: Vec<&[u32]> = parts.iter().map(|part| &part[..]).collect();
            for (component, &single) in value[..kind.width()].iter().enumerate() {
                let mut row = [f32::NAN; 3];
                kind.decode_component(component, &parts[..kind.words()], &mut row);
                assert_eq!(row, [single; 3], "{kind:?} {component}");
            }
        }
    }

    #[test]
    fn what_is_no_number_is_not_stored() {
        for kind in ALL {
            for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
                for component in 0..kind.width() {
                    let mut value = [0.6, 0.0, 0.8, 0.5];
                    value[component] = bad;
                    assert_eq!(kind.encode(value), None, "{kind:?} {value:?}");
                }
            }
        }
    }

    #[test]
    fn a_colour_below_zero_is_not_stored() {
        assert_eq!(Color.encode([0.5, -0.001, 0.5, 1.0]), None);
        assert!(Vector.encode([0.5, -0.001, 0.5, 1.0]).is_some());
    }
}
