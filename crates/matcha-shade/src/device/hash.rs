//! Hashes of whole numbers and of floats' bits: Bob Jenkins, lookup3 (2006, public
//! domain), with the word counts and conversions that Cycles' noise textures use.

use super::math::*;

/// 1 / (2³² − 1): a hash as a float in [0, 1].
pub const HASH_TO_UNIT: f32 = 1.0 / 4_294_967_295.0;

/// The last mixing of lookup3; returns its third word.
#[inline(always)]
pub fn hash_final(a0: u32, b0: u32, c0: u32) -> u32 {
    let c = wrapping_sub(c0 ^ b0, rotate_left(b0, 14));
    let a = wrapping_sub(a0 ^ c, rotate_left(c, 11));
    let b = wrapping_sub(b0 ^ a, rotate_left(a, 25));
    let c = wrapping_sub(c ^ b, rotate_left(b, 16));
    let a = wrapping_sub(a ^ c, rotate_left(c, 4));
    let b = wrapping_sub(b ^ a, rotate_left(a, 14));
    wrapping_sub(c ^ b, rotate_left(b, 24))
}

/// Hash of one word.
#[inline(always)]
pub fn hash1(x: u32) -> u32 {
    let start = 0xdead_beef + (1 << 2) + 13;
    hash_final(wrapping_add(start, x), start, start)
}

/// Hash of two words.
#[inline(always)]
pub fn hash2(x: u32, y: u32) -> u32 {
    let start = 0xdead_beef + (2 << 2) + 13;
    hash_final(wrapping_add(start, x), wrapping_add(start, y), start)
}

/// Hash of three words.
#[inline(always)]
pub fn hash3(x: u32, y: u32, z: u32) -> u32 {
    let start = 0xdead_beef + (3 << 2) + 13;
    hash_final(
        wrapping_add(start, x),
        wrapping_add(start, y),
        wrapping_add(start, z),
    )
}

/// Hash of four words.
#[inline(always)]
pub fn hash4(x: u32, y: u32, z: u32, w: u32) -> u32 {
    let mixed = hash_mix3(x, y, z);
    hash_final(wrapping_add(mixed.a, w), mixed.b, mixed.c)
}

/// Three words of a hash in progress.
#[derive(Clone, Copy)]
pub struct HashState {
    /// First.
    pub a: u32,
    /// Second.
    pub b: u32,
    /// Third.
    pub c: u32,
}

/// lookup3's mixing of the first three of four words. Depends on nothing else, so that
/// a loop over the fourth needs it only once.
#[inline(always)]
pub fn hash_mix3(x: u32, y: u32, z: u32) -> HashState {
    let start = 0xdead_beef + (4 << 2) + 13;
    let a = wrapping_add(start, x);
    let b = wrapping_add(start, y);
    let c = wrapping_add(start, z);
    let a = wrapping_sub(a, c) ^ rotate_left(c, 4);
    let c = wrapping_add(c, b);
    let b = wrapping_sub(b, a) ^ rotate_left(a, 6);
    let a = wrapping_add(a, c);
    let c = wrapping_sub(c, b) ^ rotate_left(b, 8);
    let b = wrapping_add(b, a);
    let a = wrapping_sub(a, c) ^ rotate_left(c, 16);
    let c = wrapping_add(c, b);
    let b = wrapping_sub(b, a) ^ rotate_left(a, 19);
    let a = wrapping_add(a, c);
    let c = wrapping_sub(c, b) ^ rotate_left(b, 4);
    let b = wrapping_add(b, a);
    HashState { a, b, c }
}

/// A hash as a float in [0, 1].
#[inline(always)]
pub fn unit_of(hash: u32) -> f32 {
    hash as f32 * HASH_TO_UNIT
}

/// Hash of a float's bits, in [0, 1].
#[inline(always)]
pub fn unit_hash1(x: f32) -> f32 {
    unit_of(hash1(bits_of(x)))
}

/// Hash of two floats' bits, in [0, 1].
#[inline(always)]
pub fn unit_hash2(x: f32, y: f32) -> f32 {
    unit_of(hash2(bits_of(x), bits_of(y)))
}

/// Hash of three floats' bits, in [0, 1].
#[inline(always)]
pub fn unit_hash3(x: f32, y: f32, z: f32) -> f32 {
    unit_of(hash3(bits_of(x), bits_of(y), bits_of(z)))
}

/// Hash of four floats' bits, in [0, 1].
#[inline(always)]
pub fn unit_hash4(x: f32, y: f32, z: f32, w: f32) -> f32 {
    unit_of(hash4(bits_of(x), bits_of(y), bits_of(z), bits_of(w)))
}
