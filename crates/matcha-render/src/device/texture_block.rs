//! Texels in blocks of 4 × 4, four words each: two colours, and for every texel four bits that say
//! where on the line between them it is.
//!
//! Words 0 and 1 are the colours, a byte a channel; words 2 and 3 have the bits of texels 0 to 7
//! and 8 to 15, in rows from the top. Where the first colour's word is the larger one, two of a
//! texel's bits are for its colour and two for its alpha, which then are free of each other;
//! otherwise all four are for both.
// Device code has no methods.
#![allow(clippy::manual_div_ceil)]

use glam::{Vec2, Vec3};
use matcha_shade::device::math::{vec2, vec3};

/// Texels along a side of a block.
pub const BLOCK_SIDE: u32 = 4;
/// Words of a block.
pub const BLOCK_WORDS: u32 = 4;

/// Blocks that cover so many texels.
#[inline(always)]
pub fn blocks_along(texels: u32) -> u32 {
    (texels + BLOCK_SIDE - 1) / BLOCK_SIDE
}

/// First word of the block with a texel, from the level's first word on.
#[inline(always)]
pub fn block_word(x: u32, row: u32, width: u32) -> u32 {
    ((row / BLOCK_SIDE) * blocks_along(width) + x / BLOCK_SIDE) * BLOCK_WORDS
}

/// Number of a texel in its block.
#[inline(always)]
pub fn block_texel(x: u32, row: u32) -> u32 {
    (row % BLOCK_SIDE) * BLOCK_SIDE + x % BLOCK_SIDE
}

/// Where between the block's colours a texel's colour (`x`) and its alpha (`y`) are; `bits` is the
/// word with the texel's bits.
#[inline(always)]
pub fn block_weights(first: u32, second: u32, bits: u32, texel: u32) -> Vec2 {
    let four = (bits >> (4 * (texel & 7))) & 15;
    if first > second {
        vec2((four & 3) as f32 / 3.0, (four >> 2) as f32 / 3.0)
    } else {
        vec2(four as f32 / 15.0, four as f32 / 15.0)
    }
}

/// Red, green and blue of a word, 0 to 255.
#[inline(always)]
pub fn block_rgb(word: u32) -> Vec3 {
    vec3(
        (word & 255) as f32,
        ((word >> 8) & 255) as f32,
        ((word >> 16) & 255) as f32,
    )
}

/// Alpha of a word, 0 to 255.
#[inline(always)]
pub fn block_alpha(word: u32) -> f32 {
    (word >> 24) as f32
}

/// A number between two.
#[inline(always)]
pub fn block_between(first: f32, second: f32, weight: f32) -> f32 {
    first + (second - first) * weight
}

/// A texel's red, green and blue, 0 to 255.
#[inline(always)]
pub fn block_color(first: u32, second: u32, weight: f32) -> Vec3 {
    let start = block_rgb(first);
    start + (block_rgb(second) - start) * weight
}
