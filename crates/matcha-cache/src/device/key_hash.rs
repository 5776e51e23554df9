//! The two hashes of a key: one names the cell, the other tells the cell's entries
//! apart (Binder, Fricke and Keller 2022; Fujieda and Harada 2022, section 3.2).
//!
//! The first leaves out the last bits of the node's number, so that up to
//! [`NODES_A_CELL`] nodes of a material have the same cell at the same texel: their values
//! are looked up together, and memory is waited for once. It hashes squares of 8 × 8 texels
//! and keeps their order inside: neighbours on a surface are in neighbouring cells, so that
//! one page of memory (64 cells of 64 bytes) serves them all.

use super::intrinsics::{multiply_high, select, wrapping_add, wrapping_mul};

/// Consecutive nodes, from a multiple of it on, that share a cell.
pub const NODES_A_CELL: u32 = 4;

/// A cacheable node of a material, mixed into three words once, for all its texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NodeSeed {
    /// First word of the nodes that share cells.
    pub a: u32,
    /// Second word of them.
    pub b: u32,
    /// What tells them apart.
    pub own: u32,
}

/// What nodes that share cells have in common at a texel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TexelHash {
    /// [`cell_of`] turns it into a cell. The last six bits are the texel's place in its square
    /// of texels, the others are uniform.
    pub cell: u32,
    /// Uniform and independent of it; [`fingerprint_at`] makes fingerprints of it.
    pub rest: u32,
}

/// Both hashes of a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KeyHash {
    /// [`cell_of`] turns it into a cell.
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
    let shared = hash_four_words(material, node / NODES_A_CELL, 0x6D617463, 0x68610000);
    let own = hash_four_words(material, node, part, 0x6D617463);
    NodeSeed {
        a: shared.x,
        b: shared.y,
        own: scatter(own.z),
    }
}

/// Hash of a virtual texel for all nodes that share cells with this one: level and indices
/// may be negative.
#[inline(always)]
pub fn hash_shared_texel(seed: NodeSeed, level: i32, i: i32, j: i32) -> TexelHash {
    // Level and nodes share a word; two groups of nodes meet there by chance only, and then
    // differ in the other word.
    let leveled = seed.b ^ wrapping_mul(level as u32, 0x9E3779B9);
    let square = hash_four_words((i >> 3) as u32, (j >> 3) as u32, seed.a, leveled);
    let place = (i as u32 & 7) | ((j as u32 & 7) << 3);
    // Inside of a square the place alone tells texels apart.
    let rest = square.w ^ wrapping_mul(place + 1, 0x9E3779B1);
    TexelHash {
        cell: (scatter(square.z) & 0xFFFFFFC0) | place,
        rest: scatter(rest),
    }
}

/// A node's fingerprint at a texel.
#[inline(always)]
pub fn fingerprint_at(rest: u32, seed: NodeSeed) -> u32 {
    let whole = scatter(rest ^ seed.own);
    select(whole, 0xFFFFFFFF, whole == 0)
}

/// Hashes of a virtual texel of a node.
#[inline(always)]
pub fn hash_texel(seed: NodeSeed, level: i32, i: i32, j: i32) -> KeyHash {
    let shared = hash_shared_texel(seed, level, i, j);
    KeyHash {
        cell: shared.cell,
        fingerprint: fingerprint_at(shared.rest, seed),
    }
}

/// Cell of a hash: the high word of a product, instead of the paper's modulo, picks 64
/// neighbours, the last six bits one of them. Where the last 64 are incomplete, the missing
/// ones' keys go to any cell. It is as uniform as a modulo, and needs no division.
#[inline(always)]
pub fn cell_of(hash: u32, cells: u32) -> u32 {
    let squares = ((cells - 1) >> 6) + 1;
    let near = (multiply_high(hash, squares) << 6) | (hash & 63);
    let any = multiply_high(scatter(hash), cells);
    select(any, near, near < cells)
}
