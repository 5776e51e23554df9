//! The two hashes of a key: one names the cell, the other tells the cell's entries
//! apart (Binder, Fricke and Keller 2022; Fujieda and Harada 2022, section 3.2).

use super::intrinsics::{multiply_high, select, wrapping_add, wrapping_mul};

/// A cacheable node of a material, mixed into two words once, for all its texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NodeSeed {
    /// First word.
    pub a: u32,
    /// Second word.
    pub b: u32,
}

/// Both hashes of a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KeyHash {
    /// Uniform; [`cell_of`] turns it into a cell.
    pub cell: u32,
    /// Never zero, so that no entry is the word zero, which means an empty one.
    pub fingerprint: u32,
}

/// Four words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FourWords {
    /// First word.
    pub x: u32,
    /// Second word.
    pub y: u32,
    /// Third word.
    pub z: u32,
    /// Fourth word.
    pub w: u32,
}

/// The hash `pcg4d` of Jarzynski and Olano 2020 (Hash Functions for GPU Rendering,
/// listing of section 4): a bijection of 128 bits, so two of its output words are
/// uniform together and no input is preferred.
#[inline(always)]
pub fn hash_four_words(x: u32, y: u32, z: u32, w: u32) -> FourWords {
    let mut a = wrapping_add(wrapping_mul(x, 1664525), 1013904223);
    let mut b = wrapping_add(wrapping_mul(y, 1664525), 1013904223);
    let mut c = wrapping_add(wrapping_mul(z, 1664525), 1013904223);
    let mut d = wrapping_add(wrapping_mul(w, 1664525), 1013904223);
    a = wrapping_add(a, wrapping_mul(b, d));
    b = wrapping_add(b, wrapping_mul(c, a));
    c = wrapping_add(c, wrapping_mul(a, b));
    d = wrapping_add(d, wrapping_mul(b, c));
    a = a ^ (a >> 16);
    b = b ^ (b >> 16);
    c = c ^ (c >> 16);
    d = d ^ (d >> 16);
    a = wrapping_add(a, wrapping_mul(b, d));
    b = wrapping_add(b, wrapping_mul(c, a));
    c = wrapping_add(c, wrapping_mul(a, b));
    d = wrapping_add(d, wrapping_mul(b, c));
    FourWords {
        x: a,
        y: b,
        z: c,
        w: d,
    }
}

/// Spreads a word's high bits over its low ones, which `pcg4d` leaves weak: the first half
/// of Wellons' 2018 `lowbias32`, a bijection.
#[inline(always)]
pub fn scatter(x: u32) -> u32 {
    let y = wrapping_mul(x ^ (x >> 16), 0x7FEB352D);
    y ^ (y >> 15)
}

/// Seed of a node of a material. `part` numbers the words of a value that takes several.
#[inline]
pub fn seed_of_node(material: u32, node: u32, part: u32) -> NodeSeed {
    let h = hash_four_words(material, node, part, 0x6D617463);
    NodeSeed { a: h.x, b: h.y }
}

/// Hashes of a virtual texel of a node: level and indices may be negative.
#[inline(always)]
pub fn hash_texel(seed: NodeSeed, level: i32, i: i32, j: i32) -> KeyHash {
    // Level and node share a word; two nodes meet there by chance only, and then
    // differ in the other word.
    let leveled = seed.b ^ wrapping_mul(level as u32, 0x9E3779B9);
    let h = hash_four_words(i as u32, j as u32, seed.a, leveled);
    let whole = scatter(h.w);
    let fingerprint = select(whole, 0xFFFFFFFF, whole == 0);
    KeyHash {
        cell: scatter(h.z),
        fingerprint,
    }
}

/// Cell of a hash: the high word of a product instead of the paper's modulo. It is as
/// uniform, and needs no division.
#[inline(always)]
pub fn cell_of(hash: u32, cells: u32) -> u32 {
    multiply_high(hash, cells)
}
