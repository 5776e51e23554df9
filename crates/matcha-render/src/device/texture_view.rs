//! All images of a scene in a few arrays, as graphics devices read them; `flat` makes them.

use crate::device::texture_block::*;
use crate::device::texture_color::{srgb_to_linear, texture_unassociated};
use crate::device::texture_filter::*;
use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3};
use matcha_shade::device::math::{float_of, vec2, vec3};

/// Bit of [`TextureImage::flags`]: numbers are sRGB-encoded.
pub const TEXTURE_ENCODED: u32 = 1;
/// Bit of [`TextureImage::flags`]: colour is multiplied by alpha and may be divided again.
pub const TEXTURE_PREMULTIPLIED: u32 = 2;
/// Bit of [`TextureImage::flags`]: alpha reads 1.
pub const TEXTURE_OPAQUE: u32 = 4;

/// [`TextureLevel::form`]: the bytes of a word are a texel.
pub const TEXTURE_BYTES: u32 = 0;
/// [`TextureLevel::form`]: four floats are a texel.
pub const TEXTURE_FLOATS: u32 = 1;
/// [`TextureLevel::form`]: four words are a block of sixteen texels.
pub const TEXTURE_BLOCKS: u32 = 2;

/// Hosts that have no blocks set it to 0, so that their kernels are not made for them.
pub const TEXTURE_HAS_BLOCKS: u32 = 1;

/// Colour as stored: premultiplied by alpha.
pub const TEXTURE_ALPHA_ASSOCIATED: u32 = 0;
/// Colour divided by alpha.
pub const TEXTURE_ALPHA_UNASSOCIATED: u32 = 1;
/// Alpha is one everywhere.
pub const TEXTURE_ALPHA_IGNORED: u32 = 2;

/// What a look-up gives where there is no image: Cycles' pink, opaque.
pub const TEXTURE_MISSING: [f32; 4] = [1.0, 0.0, 1.0, 1.0];

/// A look-up's fixed settings.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct TextureLook {
    /// Into `images`; beyond its end where there is no image.
    pub image: u32,
    /// One of `TEXTURE_CLOSEST` and its siblings.
    pub filter: u32,
    /// One of `TEXTURE_REPEAT` and its siblings.
    pub wrap: u32,
    /// One of the `TEXTURE_ALPHA_` codes.
    pub alpha: u32,
    /// 1: the finest level, whatever the footprint.
    pub no_footprint: u32,
}

/// An image.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct TextureImage {
    /// Into `levels`: the finest.
    pub first_level: u32,
    /// Number of the coarsest level, the finest being 0.
    pub last: u32,
    /// `TEXTURE_` bits.
    pub flags: u32,
}

/// One resolution of an image; rows from the top.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct TextureLevel {
    /// Texels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Into `texels`, in words.
    pub first: u32,
    /// One of `TEXTURE_BYTES` and its siblings.
    pub form: u32,
}

/// A colour with alpha.
#[derive(Clone, Copy, Debug)]
pub struct TextureColor {
    /// Red, green, blue.
    pub rgb: Vec3,
    /// Alpha.
    pub alpha: f32,
}

/// All images.
#[derive(Clone, Copy, Debug)]
pub struct TextureView<'a> {
    /// Look-ups of all programs.
    pub looks: &'a [TextureLook],
    /// Images that are used.
    pub images: &'a [TextureImage],
    /// Levels, those of an image from the finest on.
    pub levels: &'a [TextureLevel],
    /// Texels.
    pub texels: &'a [u32],
}

/// Texel `x` of a row, counted from the top, of a level in blocks, 0 to 255.
#[inline]
pub fn texture_read_block(
    view: TextureView,
    level: TextureLevel,
    x: u32,
    row: u32,
) -> TextureColor {
    let at = level.first + block_word(x, row, level.width);
    let first = view.texels[at as usize];
    let second = view.texels[(at + 1) as usize];
    let texel = block_texel(x, row);
    let bits = view.texels[(at + 2 + (texel >> 3)) as usize];
    let weights = block_weights(first, second, bits, texel);
    TextureColor {
        rgb: block_color(first, second, weights.x),
        alpha: block_between(block_alpha(first), block_alpha(second), weights.y),
    }
}

/// Texel `x` of a row, counted from the top, bytes as 0 to 255.
#[inline]
pub fn texture_read(view: TextureView, level: TextureLevel, x: u32, row: u32) -> TextureColor {
    if TEXTURE_HAS_BLOCKS != 0 && level.form == TEXTURE_BLOCKS {
        return texture_read_block(view, level, x, row);
    }
    let index = row * level.width + x;
    if level.form == TEXTURE_FLOATS {
        let at = level.first + 4 * index;
        return TextureColor {
            rgb: vec3(
                float_of(view.texels[at as usize]),
                float_of(view.texels[(at + 1) as usize]),
                float_of(view.texels[(at + 2) as usize]),
            ),
            alpha: float_of(view.texels[(at + 3) as usize]),
        };
    }
    let word = view.texels[(level.first + index) as usize];
    TextureColor {
        rgb: vec3(
            (word & 255) as f32,
            ((word >> 8) & 255) as f32,
            ((word >> 16) & 255) as f32,
        ),
        alpha: (word >> 24) as f32,
    }
}

/// Adds texel (i, j) of the unbounded plane, times a weight, to a sum.
#[inline]
pub fn texture_add(
    view: TextureView,
    level: TextureLevel,
    wrap: u32,
    i: i32,
    j: i32,
    weight: f32,
    sum: TextureColor,
) -> TextureColor {
    let x = texture_texel(i, level.width as i32, wrap);
    let y = texture_texel(j, level.height as i32, wrap);
    if x == TEXTURE_OUTSIDE || y == TEXTURE_OUTSIDE {
        return sum;
    }
    // Rows are stored from the top.
    let row = level.height - 1 - y as u32;
    let texel = texture_read(view, level, x as u32, row);
    TextureColor {
        rgb: sum.rgb + texel.rgb * weight,
        alpha: sum.alpha + texel.alpha * weight,
    }
}

/// Cubic B-spline over sixteen texels.
#[inline]
pub fn texture_cubic(
    view: TextureView,
    level: TextureLevel,
    wrap: u32,
    x: TextureTap,
    y: TextureTap,
) -> TextureColor {
    let across = texture_b_spline(x.fraction);
    let down = texture_b_spline(y.fraction);
    let mut sum = texture_black();
    let mut k = 0;
    while k < 16 {
        let i = k & 3;
        let j = k >> 2;
        let weight = across[i as usize] * down[j as usize];
        sum = texture_add(view, level, wrap, x.first + i, y.first + j, weight, sum);
        k += 1;
    }
    sum
}

/// Bilinear over four texels.
#[inline]
pub fn texture_bilinear(
    view: TextureView,
    level: TextureLevel,
    wrap: u32,
    x: TextureTap,
    y: TextureTap,
) -> TextureColor {
    let mut sum = texture_black();
    let mut k = 0;
    while k < 4 {
        let i = k & 1;
        let j = k >> 1;
        let across = if i == 0 { 1.0 - x.fraction } else { x.fraction };
        let down = if j == 0 { 1.0 - y.fraction } else { y.fraction };
        let weight = across * down;
        sum = texture_add(view, level, wrap, x.first + i, y.first + j, weight, sum);
        k += 1;
    }
    sum
}

/// Nothing.
#[inline(always)]
pub fn texture_black() -> TextureColor {
    TextureColor {
        rgb: vec3(0.0, 0.0, 0.0),
        alpha: 0.0,
    }
}

/// Filters level `number` of an image at unrepeated coordinates; encoded as it is stored.
#[inline]
pub fn texture_filter(
    view: TextureView,
    image: TextureImage,
    number: u32,
    look: TextureLook,
    uv: Vec2,
) -> TextureColor {
    let level = view.levels[(image.first_level + number) as usize];
    let is_cubic = look.filter == TEXTURE_CUBIC && number == 0;
    let mut back = 0.5;
    if look.filter == TEXTURE_CLOSEST {
        back = 0.0;
    } else if is_cubic {
        back = 1.5;
    }
    let x = texture_tap(uv.x, level.width, back);
    let y = texture_tap(uv.y, level.height, back);
    let mut sum = texture_black();
    if look.filter == TEXTURE_CLOSEST {
        sum = texture_add(view, level, look.wrap, x.first, y.first, 1.0, sum);
    } else if is_cubic {
        sum = texture_cubic(view, level, look.wrap, x, y);
    } else {
        sum = texture_bilinear(view, level, look.wrap, x, y);
    }
    if level.form != TEXTURE_FLOATS {
        // Scaled to 1 once a sample, after the sum.
        sum.rgb *= 1.0 / 255.0;
        sum.alpha *= 1.0 / 255.0;
    }
    sum
}

/// Alpha's effect on colour, then from encoded to linear, in this order as Cycles does (Image
/// Texture node).
#[inline]
pub fn texture_finish(flags: u32, alpha: u32, filtered: TextureColor) -> TextureColor {
    let ignored = alpha == TEXTURE_ALPHA_IGNORED || (flags & TEXTURE_OPAQUE) != 0;
    let divides =
        !ignored && alpha == TEXTURE_ALPHA_UNASSOCIATED && (flags & TEXTURE_PREMULTIPLIED) != 0;
    let mut color = filtered;
    if divides {
        color.rgb = vec3(
            texture_unassociated(color.rgb.x, color.alpha),
            texture_unassociated(color.rgb.y, color.alpha),
            texture_unassociated(color.rgb.z, color.alpha),
        );
    }
    if (flags & TEXTURE_ENCODED) != 0 {
        color.rgb = vec3(
            srgb_to_linear(color.rgb.x),
            srgb_to_linear(color.rgb.y),
            srgb_to_linear(color.rgb.z),
        );
    }
    if ignored {
        color.alpha = 1.0;
    }
    color
}

/// Look-up `index` at a place whose footprint has the half axes `a` and `b`, all in texture
/// coordinates. Linear, with alpha.
#[inline]
pub fn texture_sample(view: TextureView, index: u32, uv: Vec2, a: Vec2, b: Vec2) -> TextureColor {
    let look = view.looks[index as usize];
    if look.image >= view.images.len() as u32 {
        return TextureColor {
            rgb: vec3(TEXTURE_MISSING[0], TEXTURE_MISSING[1], TEXTURE_MISSING[2]),
            alpha: TEXTURE_MISSING[3],
        };
    }
    let image = view.images[look.image as usize];
    let mut sum = texture_black();
    if texture_is_place(uv) {
        let finest = view.levels[image.first_level as usize];
        let size = vec2(finest.width as f32, finest.height as f32);
        let mut fine = 0.0;
        if look.no_footprint == 0 {
            fine = texture_level(a, b, size, image.last);
        }
        let levels = texture_levels(fine, image.last);
        let at = vec2(
            texture_unrepeated(uv.x, look.wrap),
            texture_unrepeated(uv.y, look.wrap),
        );
        sum = texture_filter(view, image, levels.finer, look, at);
        if levels.fraction > 0.0 {
            let coarser = texture_filter(view, image, levels.finer + 1, look, at);
            sum.rgb += (coarser.rgb - sum.rgb) * levels.fraction;
            sum.alpha += (coarser.alpha - sum.alpha) * levels.fraction;
        }
    }
    texture_finish(image.flags, look.alpha, sum)
}
