//! The film as OpenEXR: one part, 32-bit floats, ZIP; channels of a layer carry its name
//! as prefix, as viewers expect.

use exr::prelude::*;
use matcha_render::film::Film;
use std::io::Cursor;

/// The film as the bytes of an EXR file: `RGBA` (linear Rec.709, premultiplied),
/// `albedo.RGB`, `normal.XYZ` (world space), `depth.Z` (metres, infinite where nothing
/// is hit), `nodes_found.V` (cacheable nodes found in the cache, mean per sample).
pub fn encode(film: &Film) -> std::result::Result<Vec<u8>, Error> {
    let mut channels: SmallVec<[AnyChannel<FlatSamples>; 4]> = SmallVec::new();
    push(&mut channels, ["R", "G", "B", "A"], &film.combined());
    push(
        &mut channels,
        ["albedo.R", "albedo.G", "albedo.B"],
        &film.albedo(),
    );
    push(
        &mut channels,
        ["normal.X", "normal.Y", "normal.Z"],
        &film.normal(),
    );
    let single = |values: Vec<f32>| values.into_iter().map(|x| [x]).collect::<Vec<_>>();
    push(&mut channels, ["depth.Z"], &single(film.depth()));
    push(
        &mut channels,
        ["nodes_found.V"],
        &single(film.nodes_found()),
    );
    let size = (film.width() as usize, film.height() as usize);
    let encoding = Encoding {
        compression: Compression::ZIP16,
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    let attributes = LayerAttributes {
        software_name: Some(Text::from("matcha")),
        ..LayerAttributes::default()
    };
    let layer = Layer::new(size, attributes, encoding, AnyChannels::sort(channels));
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer).write().to_buffered(&mut bytes)?;
    Ok(bytes.into_inner())
}

fn push<const N: usize>(
    channels: &mut SmallVec<[AnyChannel<FlatSamples>; 4]>,
    names: [&str; N],
    pixels: &[[f32; N]],
) {
    for (k, name) in names.into_iter().enumerate() {
        let samples = pixels.iter().map(|pixel| pixel[k]).collect();
        channels.push(AnyChannel::new(name, FlatSamples::F32(samples)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;
    use matcha_render::film::{PixelSums, Tile};

    #[test]
    fn what_is_written_is_read_again() {
        let mut film = Film::new(3, 2, 1.0);
        let sums = PixelSums {
            radiance: Vec3::new(1.0, 20.0, -0.5),
            alpha: 1.0,
            albedo: Vec3::new(0.1, 0.2, 0.3),
            normal: Vec3::Z,
            depth: 7.0,
            depth_samples: 1.0,
            nodes_found: 4.0,
            samples: 2.0,
        };
        film.add_tile(
            &Tile {
                x: 2,
                y: 1,
                width: 1,
                height: 1,
            },
            &[sums],
        );
        let bytes = encode(&film).unwrap();
        let image = read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .first_valid_layer()
            .all_attributes()
            .from_buffered(Cursor::new(bytes))
            .unwrap();
        let channels = &image.layer_data.channel_data.list;
        let value = |name: &str| {
            let channel = channels.iter().find(|c| c.name.eq(name)).unwrap();
            channel.sample_data.values_as_f32().nth(5).unwrap()
        };
        assert_eq!(channels.len(), 12);
        for (name, expected) in [
            ("R", 0.5),
            ("G", 10.0),
            ("B", -0.25),
            ("A", 0.5),
            ("albedo.G", 0.1),
            ("normal.Z", 0.5),
            ("depth.Z", 7.0),
            ("nodes_found.V", 2.0),
        ] {
            assert_eq!(value(name), expected, "{name}");
        }
        let first = channels.iter().find(|c| c.name.eq("depth.Z")).unwrap();
        assert_eq!(
            first.sample_data.values_as_f32().next(),
            Some(f32::INFINITY)
        );
    }
}
