//! Images.

use super::{Section, blocks, sections};
use crate::backend::TextureMemory;
use crate::device::texture_view::{
    TEXTURE_BLOCKS, TEXTURE_BYTES, TEXTURE_FLOATS, TextureImage, TextureLevel, TextureLook,
    TextureView,
};
use crate::prepare::Prepared;
use crate::texture::look::{alpha_code, filter_code, wrap_code};
use crate::texture::{Level, Texels, TextureSet};
use matcha_shade::graph::TextureRef;
use std::collections::HashMap;

/// No image, whatever their number.
const MISSING: u32 = u32::MAX;

/// What [`TextureView`] reads. Bytes stay bytes, one word a texel, or are packed in blocks where
/// that is asked for; floats are four words.
#[derive(Default)]
pub struct FlatTextures {
    looks: Vec<TextureLook>,
    images: Vec<TextureImage>,
    levels: Vec<TextureLevel>,
    texels: Vec<u32>,
    /// Bytes become blocks.
    packs: bool,
    /// Words that blocks are fewer than bytes would be.
    saved_words: u64,
    /// Levels of bytes in blocks, and those that stay as they are.
    packed_levels: u32,
    kept_levels: u32,
}

impl FlatTextures {
    /// The images of a prepared scene that look-ups refer to; look-ups are numbered as they come.
    /// With `packs`, images of bytes are packed in blocks where the error is small
    /// ([`BLOCK_ERROR`](super::BLOCK_ERROR)).
    pub fn new<'t>(
        prepared: &Prepared,
        looks: impl IntoIterator<Item = &'t TextureRef>,
        packs: bool,
    ) -> Self {
        Self::of_set(&prepared.textures, looks, packs)
    }

    /// Images that have been prepared alone.
    pub fn of_set<'t>(
        set: &TextureSet,
        looks: impl IntoIterator<Item = &'t TextureRef>,
        packs: bool,
    ) -> Self {
        let mut flat = Self {
            packs,
            ..Self::default()
        };
        let mut known: HashMap<u32, u32> = HashMap::new();
        for look in looks {
            let image = *known.entry(look.image).or_insert_with(|| {
                let pyramid = set.pyramid(look.image);
                pyramid.map_or(MISSING, |(flags, levels)| flat.add_image(flags, levels))
            });
            flat.looks.push(TextureLook {
                image,
                filter: filter_code(look.interpolation),
                wrap: wrap_code(look.extension),
                alpha: alpha_code(look.alpha),
                no_footprint: u32::from(look.no_footprint),
            });
        }
        flat
    }

    fn add_image(&mut self, flags: u32, levels: &[Level]) -> u32 {
        let image = self.images.len() as u32;
        self.images.push(TextureImage {
            first_level: self.levels.len() as u32,
            last: levels.len() as u32 - 1,
            flags,
        });
        for level in levels {
            let first = self.texels.len() as u32;
            let form = self.add_texels(level);
            self.levels.push(TextureLevel {
                width: level.width,
                height: level.height,
                first,
                form,
            });
        }
        image
    }

    /// Appends a level's texels and gives their form.
    fn add_texels(&mut self, level: &Level) -> u32 {
        let texels = match &level.texels {
            Texels::Bytes(texels) => texels,
            Texels::Floats(texels) => {
                let words = texels.iter().flatten().map(|value| value.to_bits());
                self.texels.extend(words);
                return TEXTURE_FLOATS;
            }
        };
        if self.packs {
            if let Some(words) = blocks::pack(level.width, level.height, texels) {
                self.saved_words += (texels.len() - words.len()) as u64;
                self.packed_levels += 1;
                self.texels.extend(words);
                return TEXTURE_BLOCKS;
            }
            self.kept_levels += 1;
        }
        let words = texels.iter().map(|texel| u32::from_le_bytes(*texel));
        self.texels.extend(words);
        TEXTURE_BYTES
    }

    /// What blocks save; nothing where they were not asked for.
    pub fn memory(&self) -> Option<TextureMemory> {
        self.packs.then(|| TextureMemory {
            bytes: 4 * self.texels.len() as u64,
            bytes_saved: 4 * self.saved_words,
            packed_levels: self.packed_levels,
            kept_levels: self.kept_levels,
        })
    }

    /// The view that device code reads.
    pub fn view(&self) -> TextureView<'_> {
        TextureView {
            looks: &self.looks,
            images: &self.images,
            levels: &self.levels,
            texels: &self.texels,
        }
    }

    /// The words of all fields of [`TextureView`].
    pub fn sections(&self) -> Vec<Section<'_>> {
        sections!(self, TextureView: looks images levels texels;)
    }
}
