//! OpenEXR: the largest layer that has colours, as floats.

use super::{Failure, Picture, decode::charge};
use crate::budget::Budget;
use exr::prelude::{FlatImage, FlatSamples, ReadChannels, ReadLayers, read};
use matcha_render::scene::Pixels;
use std::io::Cursor;
use std::sync::Arc;

pub(super) fn decode(bytes: &[u8], name: &str, budget: &Budget) -> Result<Picture, Failure> {
    let unreadable = |error: exr::error::Error| Failure::Unreadable(error.to_string());
    let meta =
        exr::meta::MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(unreadable)?;
    for header in &meta.headers {
        let size = header.layer_size;
        let (width, height) = (u32::try_from(size.0), u32::try_from(size.1));
        let (Ok(width), Ok(height)) = (width, height) else {
            return Err(Failure::Unreadable("its size is not possible".into()));
        };
        charge(budget, name, width, height, true)?;
    }
    let image: FlatImage = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))
        .map_err(unreadable)?;
    let colours = |layer: &exr::prelude::Layer<exr::prelude::AnyChannels<FlatSamples>>| {
        layer
            .channel_data
            .list
            .iter()
            .filter(|channel| slot(&channel.name.to_string()).is_some())
            .count()
    };
    let layer = image.layer_data.iter().max_by_key(|layer| colours(layer));
    let layer = layer.ok_or_else(|| Failure::Unreadable("it has no layers".into()))?;
    if colours(layer) == 0 {
        return Err(Failure::Unreadable(
            "none of its channels is a colour".into(),
        ));
    }
    let (width, height) = (layer.size.0, layer.size.1);
    let mut pixels = vec![[0.0, 0.0, 0.0, 1.0_f32]; width * height];
    for channel in &layer.channel_data.list {
        let Some(slots) = slot(&channel.name.to_string()) else {
            continue;
        };
        for (pixel, value) in pixels.iter_mut().zip(channel.sample_data.values_as_f32()) {
            for &slot in slots {
                pixel[slot] = value;
            }
        }
    }
    Ok(Picture {
        width: width as u32,
        height: height as u32,
        pixels: Pixels::RgbaF32(Arc::new(pixels)),
    })
}

/// The colour channels that an EXR channel fills, by the last part of its name; luminance fills three.
fn slot(name: &str) -> Option<&'static [usize]> {
    match name.rsplit('.').next() {
        Some("R" | "r") => Some(&[0]),
        Some("G" | "g") => Some(&[1]),
        Some("B" | "b") => Some(&[2]),
        Some("A" | "a") => Some(&[3]),
        Some("Y" | "y") => Some(&[0, 1, 2]),
        _ => None,
    }
}
