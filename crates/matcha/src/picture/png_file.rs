//! Pictures as PNG.

use super::view::View;
use image::{ExtendedColorType, ImageEncoder, ImageError, RgbImage, codecs::png::PngEncoder};

/// An opaque picture as the bytes of a PNG file.
pub fn encode(picture: &RgbImage) -> Result<Vec<u8>, ImageError> {
    write(
        picture.as_raw(),
        picture.dimensions(),
        ExtendedColorType::Rgb8,
    )
}

/// A linear, premultiplied picture through a view transform; straight alpha is kept
/// where some pixel is not opaque.
pub fn encode_linear(
    width: u32,
    height: u32,
    pixels: &[[f32; 4]],
    view: &View,
) -> Result<Vec<u8>, ImageError> {
    if pixels.iter().all(|pixel| pixel[3] >= 1.0) {
        return write(
            &view.bytes(pixels),
            (width, height),
            ExtendedColorType::Rgb8,
        );
    }
    let straight: Vec<u8> = pixels
        .iter()
        .flat_map(|&[r, g, b, a]| {
            let scale = if a > 0.0 { 1.0 / a } else { 0.0 };
            let [r, g, b] = view.pixel([r * scale, g * scale, b * scale]);
            [r, g, b, (a.clamp(0.0, 1.0) * 255.0 + 0.5) as u8]
        })
        .collect();
    write(&straight, (width, height), ExtendedColorType::Rgba8)
}

fn write(
    bytes: &[u8],
    (width, height): (u32, u32),
    color: ExtendedColorType,
) -> Result<Vec<u8>, ImageError> {
    let mut file = Vec::new();
    PngEncoder::new(&mut file).write_image(bytes, width, height, color)?;
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;
    use matcha_render::scene::ViewSettings;

    #[test]
    fn alpha_is_straight_and_only_where_needed() {
        let settings = ViewSettings {
            transform: "Standard".into(),
            ..ViewSettings::default()
        };
        let view = View::new(&settings).0;
        let pixels = [[0.5, 0.0, 0.0, 0.5], [0.0, 0.0, 0.0, 0.0]];
        let file = encode_linear(2, 1, &pixels, &view).unwrap();
        let read = image::load_from_memory(&file).unwrap();
        assert_eq!(read.to_rgba8().as_raw()[..4], [255, 0, 0, 128]);
        let file = encode_linear(1, 1, &[[1.0, 1.0, 1.0, 1.0]], &view).unwrap();
        assert!(!image::load_from_memory(&file).unwrap().color().has_alpha());
    }
}
