//! One picture file to pixels. Eight bits stay eight bits; more become floats.

use super::{Failure, Picture, exr_file};
use crate::budget::Budget;
use image::{ColorType, DynamicImage, ImageDecoder, ImageReader, Limits};
use matcha_render::scene::Pixels;
use std::io::Cursor;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

/// How OpenEXR files begin.
pub(crate) const EXR_MAGIC: &[u8] = &[0x76, 0x2f, 0x31, 0x01];
/// How PNG files begin.
pub(crate) const PNG_MAGIC: &[u8] = b"\x89PNG";

/// Decodes bytes of any supported format. The decoders are other people's and meet
/// files that nobody checked, so a panic in one of them counts as an unreadable picture.
pub(super) fn decode(bytes: &[u8], name: &str, budget: &Budget) -> Result<Picture, Failure> {
    catch_unwind(AssertUnwindSafe(|| {
        if bytes.starts_with(EXR_MAGIC) {
            exr_file::decode(bytes, name, budget)
        } else {
            ordinary(bytes, name, budget)
        }
    }))
    .unwrap_or_else(|_| Err(Failure::Unreadable("its decoder gave up".into())))
}

fn ordinary(bytes: &[u8], name: &str, budget: &Budget) -> Result<Picture, Failure> {
    let unreadable = |error: &dyn std::fmt::Display| Failure::Unreadable(error.to_string());
    let mut reader = ImageReader::new(Cursor::new(bytes))
        .with_guessed_format()
        .map_err(|e| unreadable(&e))?;
    // Targa has no magic number; whatever nothing else recognises is tried as one by its name.
    if reader.format().is_none() && name.to_ascii_lowercase().ends_with(".tga") {
        reader.set_format(image::ImageFormat::Tga);
    }
    let mut decoder = reader.into_decoder().map_err(|e| unreadable(&e))?;
    let (width, height) = decoder.dimensions();
    let deep = !matches!(
        decoder.color_type(),
        ColorType::L8 | ColorType::La8 | ColorType::Rgb8 | ColorType::Rgba8
    );
    charge(budget, name, width, height, deep)?;
    let mut limits = Limits::default();
    limits.max_alloc = Some(budget.left().max(1 << 20));
    decoder.set_limits(limits).map_err(|e| unreadable(&e))?;
    let picture = DynamicImage::from_decoder(decoder).map_err(|e| unreadable(&e))?;
    let pixels = if deep {
        floats(picture)
    } else {
        Pixels::Rgba8(Arc::new(four_bytes(picture.into_rgba8().into_raw())))
    };
    Ok(Picture {
        width,
        height,
        pixels,
    })
}

/// Claims the memory of a picture before it is decoded.
pub(super) fn charge(
    budget: &Budget,
    name: &str,
    width: u32,
    height: u32,
    deep: bool,
) -> Result<(), Failure> {
    if width == 0 || height == 0 {
        return Err(Failure::Unreadable("it has no pixels".into()));
    }
    let bytes = u64::from(width) * u64::from(height) * if deep { 16 } else { 4 };
    budget
        .charge(
            bytes,
            &format!("image \"{name}\" of {width} x {height} pixels"),
        )
        .map_err(Failure::Fatal)
}

fn floats(picture: DynamicImage) -> Pixels {
    let raw = picture.into_rgba32f().into_raw();
    let pixels = match bytemuck::try_cast_vec(raw) {
        Ok(pixels) => pixels,
        Err((_, raw)) => bytemuck::cast_slice(&raw).to_vec(),
    };
    Pixels::RgbaF32(Arc::new(pixels))
}

fn four_bytes(raw: Vec<u8>) -> Vec<[u8; 4]> {
    match bytemuck::try_cast_vec(raw) {
        Ok(pixels) => pixels,
        Err((_, raw)) => bytemuck::cast_slice(&raw).to_vec(),
    }
}
