//! Images.

use super::{Section, sections};
use crate::device::texture_view::{TextureImage, TextureLevel, TextureLook, TextureView};
use crate::prepare::Prepared;
use crate::texture::look::{alpha_code, filter_code, wrap_code};
use crate::texture::{Level, Texels, TextureSet};
use matcha_shade::graph::TextureRef;
use std::collections::HashMap;

/// No image, whatever their number.
const MISSING: u32 = u32::MAX;

/// What [`TextureView`] reads. Bytes stay bytes, one word a texel; floats are four words.
#[derive(Default)]
pub struct FlatTextures {
    looks: Vec<TextureLook>,
    images: Vec<TextureImage>,
    levels: Vec<TextureLevel>,
    texels: Vec<u32>,
}

impl FlatTextures {
    /// The images of a prepared scene that look-ups refer to; look-ups are numbered as they come.
    pub fn new<'t>(prepared: &Prepared, looks: impl IntoIterator<Item = &'t TextureRef>) -> Self {
        Self::of_set(&prepared.textures, looks)
    }

    /// Images that have been prepared alone.
    pub fn of_set<'t>(set: &TextureSet, looks: impl IntoIterator<Item = &'t TextureRef>) -> Self {
        let mut flat = Self::default();
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
            self.levels.push(TextureLevel {
                width: level.width,
                height: level.height,
                first: self.texels.len() as u32,
                is_float: u32::from(!level.is_bytes()),
            });
            match &level.texels {
                Texels::Bytes(texels) => {
                    let words = texels.iter().map(|texel| u32::from_le_bytes(*texel));
                    self.texels.extend(words);
                }
                Texels::Floats(texels) => {
                    let words = texels.iter().flatten().map(|value| value.to_bits());
                    self.texels.extend(words);
                }
            }
        }
        image
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
