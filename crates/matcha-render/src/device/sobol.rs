//! Sobol points with Owen scrambling, by hashing.
//!
//! Sobol 1967; nested uniform scrambling by Owen 1995, done with a hash as in Laine and
//! Karras 2011 and Burley 2020 ("Practical Hash-based Owen Scrambling", JCGT 9.4): numbers
//! are kept with their bits REVERSED (first digit in bit 0), where a hash whose every
//! output bit depends on lower bits only is a nested scramble. The hash is Vegdahl's 2021.
//! Dimensions are padded: each draw takes the first dimensions of the sequence, with the
//! sample index shuffled (itself a nested scramble, Burley 2020 §4) so that draws of
//! different dimensions are independent.

// Device code has no methods: a rotation is written out.
#![allow(clippy::manual_rotate)]

use glam::{Vec2, Vec3};
use matcha_shade::device::math::{rotate_left, vec2, vec3, wrapping_add, wrapping_mul};

/// Bits in the opposite order.
#[inline(always)]
pub fn sobol_reverse(x: u32) -> u32 {
    let a = ((x >> 1) & 0x5555_5555) | ((x & 0x5555_5555) << 1);
    let b = ((a >> 2) & 0x3333_3333) | ((a & 0x3333_3333) << 2);
    let c = ((b >> 4) & 0x0f0f_0f0f) | ((b & 0x0f0f_0f0f) << 4);
    let d = ((c >> 8) & 0x00ff_00ff) | ((c & 0x00ff_00ff) << 8);
    rotate_left(d, 16)
}

/// Nested uniform scramble of a number with reversed bits (Vegdahl 2021, "Building a
/// Better LK Hash").
#[inline(always)]
pub fn sobol_scramble(reversed: u32, seed: u32) -> u32 {
    let a = reversed ^ wrapping_mul(reversed, 0x3d20_adea);
    let b = wrapping_mul(wrapping_add(a, seed), (seed >> 16) | 1);
    let c = b ^ wrapping_mul(b, 0x0552_6c56);
    c ^ wrapping_mul(c, 0x53a2_2864)
}

/// Integer hash with full avalanche (Wellons 2018, `lowbias32`).
#[inline(always)]
pub fn sobol_hash(x: u32) -> u32 {
    let a = wrapping_mul(x ^ (x >> 16), 0x7feb_352d);
    let b = wrapping_mul(a ^ (a >> 15), 0x846c_a68b);
    b ^ (b >> 16)
}

/// Seed of the sequence of the pixel at column `x` and row `y`.
#[inline]
pub fn sobol_pixel_seed(x: u32, y: u32, seed: u32) -> u32 {
    sobol_hash(wrapping_add(
        sobol_hash(wrapping_add(sobol_hash(seed), x)),
        wrapping_mul(y, 0x9e37_79b9),
    ))
}

/// Seed of one draw of a sequence.
#[inline(always)]
pub fn sobol_draw_seed(seed: u32, dimension: u32) -> u32 {
    sobol_hash(wrapping_add(seed, wrapping_mul(dimension, 0x9e37_79b9)))
}

/// The sample index as draw `draw_seed` uses it, shuffled.
#[inline(always)]
pub fn sobol_shuffle(index: u32, draw_seed: u32) -> u32 {
    sobol_reverse(sobol_scramble(sobol_reverse(index), draw_seed))
}

/// Second Sobol dimension, reversed. Its direction numbers are the rows of Pascal's
/// triangle modulo 2, so by Lucas' theorem bit j is the parity of the index's bits at all
/// positions that contain j as a bit set: a superset sum, done in five steps.
#[inline(always)]
pub fn sobol_second(index: u32) -> u32 {
    let a = index ^ ((index >> 1) & 0x5555_5555);
    let b = a ^ ((a >> 2) & 0x3333_3333);
    let c = b ^ ((b >> 4) & 0x0f0f_0f0f);
    let d = c ^ ((c >> 8) & 0x00ff_00ff);
    d ^ (d >> 16)
}

/// Third Sobol dimension, reversed.
///
/// Direction numbers follow v(j) = v(j−1) ⊕ v(j−2) ⊕ v(j−2)·2², from the primitive polynomial
/// x² + x + 1 and the initial numbers 1, 3 (Joe and Kuo 2008, dimension 3). Squaring a
/// polynomial over two elements doubles its exponents, so that the same holds with all steps
/// twice, four and eight times as long: the sum over a block of the index's bits is one over
/// its lower half, and one over its upper half, moved. Four halvings leave pairs of bits.
/// (A table in code would be copied to memory at each use: drivers take minutes for that.)
#[inline(always)]
pub fn sobol_third(index: u32) -> u32 {
    let a = sobol_halve(index, 16, 0x0000_ffff, 0x0000_00ff);
    let b = sobol_halve(a, 8, 0x00ff_00ff, 0x000f_000f);
    let c = sobol_halve(b, 4, 0x0f0f_0f0f, 0x0303_0303);
    let d = sobol_halve(c, 2, 0x3333_3333, 0x1111_1111);
    d ^ ((d >> 1) & 0x5555_5555)
}

/// One halving for [`sobol_third`]: blocks of `2 · half` bits, of which `lower` are the lower
/// halves and `quarter` the lowest quarters.
#[inline(always)]
pub fn sobol_halve(x: u32, half: u32, lower: u32, quarter: u32) -> u32 {
    let upper = (x >> half) & lower;
    let moved = upper ^ ((upper >> (half / 2)) & quarter);
    (x & lower) ^ moved ^ ((moved & quarter) << (half / 2)) ^ (moved << half)
}

/// Number in [0, 1) from a reversed Sobol number, scrambled; 24 bits, exact in f32.
#[inline(always)]
pub fn sobol_unit(reversed: u32, draw_seed: u32, axis: u32) -> f32 {
    let seed = sobol_hash(wrapping_add(draw_seed, wrapping_mul(axis, 0x85eb_ca6b)));
    (sobol_reverse(sobol_scramble(reversed, seed)) >> 8) as f32 * 5.960_464_5e-8
}

/// Sample `index` of draw `dimension` of the sequence `seed`, in [0, 1).
#[inline]
pub fn sobol_1d(seed: u32, index: u32, dimension: u32) -> f32 {
    let draw = sobol_draw_seed(seed, dimension);
    sobol_unit(sobol_shuffle(index, draw), draw, 1)
}

/// Sample `index` of draw `dimension` of the sequence `seed`, in [0, 1)².
#[inline]
pub fn sobol_2d(seed: u32, index: u32, dimension: u32) -> Vec2 {
    let draw = sobol_draw_seed(seed, dimension);
    let i = sobol_shuffle(index, draw);
    vec2(sobol_unit(i, draw, 1), sobol_unit(sobol_second(i), draw, 2))
}

/// Sample `index` of draw `dimension` of the sequence `seed`, in [0, 1)³.
#[inline]
pub fn sobol_3d(seed: u32, index: u32, dimension: u32) -> Vec3 {
    let draw = sobol_draw_seed(seed, dimension);
    let i = sobol_shuffle(index, draw);
    vec3(
        sobol_unit(i, draw, 1),
        sobol_unit(sobol_second(i), draw, 2),
        sobol_unit(sobol_third(i), draw, 3),
    )
}
