//! Images for node networks: pyramids and filtering.
//!
//! Bytes stay bytes (the finest level is the scene's own memory); filtering happens on the encoded
//! numbers and the result is made linear, as Cycles does, so that a magnified picture looks the
//! same. Coarser levels are averaged in linear light and encoded again.

pub(crate) mod look;
mod pyramid;
mod sample;
mod srgb;
#[cfg(test)]
mod tests;

use crate::device::texture_color::texture_unassociated;
use crate::device::texture_view::*;
use crate::scene::{AlphaMode, ColorSpace, Image};
use matcha_shade::graph::{AlphaHandling, TextureRef};
use matcha_shade::vm::Textures;
use pyramid::build_pyramid;
pub(crate) use pyramid::{Level, Texels};
use rayon::prelude::*;
use sample::Points;
use srgb::Decoder;

/// An image, ready to be sampled.
#[derive(Clone, Debug)]
struct Texture {
    /// From the finest to a single pixel; never empty.
    levels: Vec<Level>,
    /// Numbers are sRGB-encoded.
    encoded: bool,
    /// Colour is multiplied by alpha and may be divided again.
    associated: bool,
    /// Alpha reads 1.
    opaque: bool,
}

/// The images that a scene's programs use.
#[derive(Clone, Debug)]
pub struct TextureSet {
    textures: Vec<Option<Texture>>,
    decoder: Decoder,
}

impl TextureSet {
    /// Prepares those images of a scene that look-ups refer to; images of impossible size are
    /// treated as missing.
    pub fn build<'a>(images: &[Image], used: impl IntoIterator<Item = &'a TextureRef>) -> Self {
        let mut wanted = vec![false; images.len()];
        for texture in used {
            if let Some(wanted) = wanted.get_mut(texture.image as usize) {
                *wanted = true;
            }
        }
        let decoder = Decoder::new();
        let textures = images
            .par_iter()
            .zip(&wanted)
            .map(|(image, &wanted)| if wanted { texture(image) } else { None })
            .collect();
        Self { textures, decoder }
    }

    /// The pyramid of an image that is used, with its `TEXTURE_` flags: for devices that need
    /// all texels in one array.
    pub(crate) fn pyramid(&self, image: u32) -> Option<(u32, &[Level])> {
        let texture = self.textures.get(image as usize)?.as_ref()?;
        let bit = |holds: bool, bit: u32| if holds { bit } else { 0 };
        let flags = bit(texture.encoded, TEXTURE_ENCODED)
            | bit(texture.associated, TEXTURE_PREMULTIPLIED)
            | bit(texture.opaque, TEXTURE_OPAQUE);
        Some((flags, &texture.levels))
    }

    /// Memory of the pyramids without the finest levels that the scene shares, bytes.
    pub fn bytes(&self) -> usize {
        let levels = self.textures.iter().flatten().flat_map(|t| &t.levels);
        levels.map(Level::own_bytes).sum()
    }
}

fn texture(image: &Image) -> Option<Texture> {
    let data = image.color_space == ColorSpace::NonColor;
    let associates = image.alpha == AlphaMode::Straight && !data;
    let levels = build_pyramid(image, associates)?;
    Some(Texture {
        encoded: image.color_space == ColorSpace::Srgb,
        associated: !data && matches!(image.alpha, AlphaMode::Straight | AlphaMode::Premultiplied),
        opaque: image.alpha == AlphaMode::None,
        levels,
    })
}

impl Textures for TextureSet {
    fn sample(
        &self,
        texture: TextureRef,
        n: usize,
        uv: [&[f32]; 2],
        da: [&[f32]; 2],
        db: [&[f32]; 2],
        out: [&mut [f32]; 4],
    ) {
        let [u, v] = uv.map(|row| &row[..n]);
        let [au, av] = da.map(|row| &row[..n]);
        let [bu, bv] = db.map(|row| &row[..n]);
        let [r, g, b, a] = out.map(|row| &mut row[..n]);
        let Some(Some(image)) = self.textures.get(texture.image as usize) else {
            for (row, value) in [r, g, b, a].into_iter().zip(TEXTURE_MISSING) {
                row.fill(value);
            }
            return;
        };
        let points = Points {
            uv: [u, v],
            axes: [[au, av], [bu, bv]],
        };
        image.filter_all(&texture, &points, [&mut *r, &mut *g, &mut *b, &mut *a]);
        let handling = if image.opaque {
            AlphaHandling::Ignored
        } else {
            texture.alpha
        };
        finish(image, handling, &self.decoder, [r, g, b], a);
    }
}

/// Alpha's effect on colour, then from encoded to linear, in this order as Cycles does
/// (Image Texture node).
fn finish(
    image: &Texture,
    handling: AlphaHandling,
    decoder: &Decoder,
    colors: [&mut [f32]; 3],
    alpha: &mut [f32],
) {
    let divides = image.associated && handling == AlphaHandling::Unassociated;
    for row in colors {
        if divides {
            for (value, &alpha) in row.iter_mut().zip(alpha.iter()) {
                *value = texture_unassociated(*value, alpha);
            }
        }
        if image.encoded {
            row.iter_mut()
                .for_each(|value| *value = decoder.linear(*value));
        }
    }
    if handling == AlphaHandling::Ignored {
        alpha.fill(1.0);
    }
}
