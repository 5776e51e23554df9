use super::*;
use image::{DynamicImage, ImageFormat};
use std::io::Cursor;

fn encoded(picture: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

fn decoded(bytes: &[u8], name: &str) -> Picture {
    match decode::decode(bytes, name, &Budget::new(1 << 24)) {
        Ok(picture) => picture,
        Err(Failure::Unreadable(why)) => panic!("{name}: {why}"),
        Err(Failure::Fatal(fault)) => panic!("{name}: {}", fault.problem),
    }
}

fn first(picture: &Picture) -> [f32; 4] {
    match &picture.pixels {
        Pixels::Rgba8(pixels) => pixels[0].map(|x| f32::from(x) / 255.0),
        Pixels::RgbaF32(pixels) => pixels[0],
    }
}

#[test]
fn eight_bit_formats_stay_eight_bit() {
    let rgb = DynamicImage::ImageRgb8(image::RgbImage::from_fn(8, 6, |_, y| {
        image::Rgb(if y < 3 { [255, 0, 0] } else { [0, 0, 255] })
    }));
    let formats = [
        ("a.png", ImageFormat::Png),
        ("a.bmp", ImageFormat::Bmp),
        ("a.tga", ImageFormat::Tga),
        ("a.tif", ImageFormat::Tiff),
        ("a.webp", ImageFormat::WebP),
        ("a.jpg", ImageFormat::Jpeg),
    ];
    for (name, format) in formats {
        let picture = decoded(&encoded(&rgb, format), name);
        assert_eq!((picture.width, picture.height), (8, 6), "{name}");
        let Pixels::Rgba8(pixels) = &picture.pixels else {
            panic!("{name} is not 8 bits")
        };
        let close = |a: [u8; 4], b: [u8; 4]| a.iter().zip(b).all(|(a, b)| a.abs_diff(b) < 8);
        assert!(
            close(pixels[0], [255, 0, 0, 255]),
            "{name}: the first row is the top one, {:?}",
            pixels[0]
        );
        assert!(close(pixels[47], [0, 0, 255, 255]), "{name}");
    }
}

#[test]
fn deep_formats_become_floats() {
    let deep = image::ImageBuffer::from_pixel(2, 2, image::Rgb([65_535_u16, 32_768, 0]));
    let picture = decoded(
        &encoded(&DynamicImage::ImageRgb16(deep), ImageFormat::Png),
        "deep.png",
    );
    assert!(matches!(picture.pixels, Pixels::RgbaF32(_)));
    assert_eq!(first(&picture), [1.0, 32_768.0 / 65_535.0, 0.0, 1.0]);
    let bright = image::Rgb32FImage::from_pixel(2, 2, image::Rgb([8.0, 0.5, 0.25]));
    let picture = decoded(
        &encoded(&DynamicImage::ImageRgb32F(bright), ImageFormat::Hdr),
        "sky.hdr",
    );
    assert_eq!(first(&picture), [8.0, 0.5, 0.25, 1.0]);
}

#[test]
fn openexr_by_channel_names() {
    use exr::prelude::*;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    write_rgba_file(&path, 3, 2, |x, y| (x as f32, y as f32, 100.0_f32, 0.5_f32)).unwrap();
    let picture = decoded(&std::fs::read(&path).unwrap(), "a.exr");
    assert_eq!((picture.width, picture.height), (3, 2));
    let Pixels::RgbaF32(pixels) = &picture.pixels else {
        panic!()
    };
    assert_eq!(pixels[5], [2.0, 1.0, 100.0, 0.5]);
    let channels = SpecificChannels::build()
        .with_channel("Y")
        .with_pixel_fn(|_| (0.75_f32,));
    Image::from_channels((2, 2), channels)
        .write()
        .to_file(&path)
        .unwrap();
    assert_eq!(
        first(&decoded(&std::fs::read(&path).unwrap(), "y.exr")),
        [0.75, 0.75, 0.75, 1.0]
    );
}

#[test]
fn a_picture_too_large_ends_the_import() {
    let large = DynamicImage::new_rgb8(600, 600);
    let result = decode::decode(
        &encoded(&large, ImageFormat::Png),
        "large",
        &Budget::new(1_000_000),
    );
    assert!(matches!(result, Err(Failure::Fatal(_))));
}
