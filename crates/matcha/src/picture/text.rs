//! Text in pictures, set in a part of DejaVu Sans that is built in.

use ab_glyph::{Font, FontRef, Glyph, PxScale, ScaleFont};
use image::{Rgb, RgbImage};

const FONT: &[u8] = include_bytes!("../../assets/DejaVuSans-subset.ttf");

/// A size and colour to write in.
#[derive(Clone, Copy, Debug)]
pub struct Pen {
    /// Height of a line, pixels.
    pub size: f32,
    /// Colour.
    pub color: [u8; 3],
}

impl Pen {
    /// Writes one line with its left end and the top of its line at `x`, `y`; what lies
    /// outside of the picture is cut off.
    pub fn write(&self, picture: &mut RgbImage, x: f32, y: f32, text: &str) {
        let Ok(font) = FontRef::try_from_slice(FONT) else {
            return;
        };
        for glyph in self.lay_out(&font, x, y, text).0 {
            let Some(outline) = font.outline_glyph(glyph) else {
                continue;
            };
            let bounds = outline.px_bounds();
            outline.draw(|dx, dy, coverage| {
                let at = (bounds.min.x + dx as f32, bounds.min.y + dy as f32);
                self.blend(picture, at, coverage);
            });
        }
    }

    /// Width of a line, pixels.
    pub fn width(&self, text: &str) -> f32 {
        FontRef::try_from_slice(FONT).map_or(0.0, |font| self.lay_out(&font, 0.0, 0.0, text).1)
    }

    fn lay_out(&self, font: &FontRef, x: f32, y: f32, text: &str) -> (Vec<Glyph>, f32) {
        let scaled = font.as_scaled(PxScale::from(self.size));
        let mut pen = x;
        let mut last = None;
        let mut glyphs = Vec::new();
        for letter in text.chars() {
            let id = scaled.glyph_id(letter);
            pen += last.map_or(0.0, |last| scaled.kern(last, id));
            let position = ab_glyph::point(pen, y + scaled.ascent());
            glyphs.push(id.with_scale_and_position(self.size, position));
            pen += scaled.h_advance(id);
            last = Some(id);
        }
        (glyphs, pen - x)
    }

    fn blend(&self, picture: &mut RgbImage, (x, y): (f32, f32), coverage: f32) {
        let inside =
            x >= 0.0 && y >= 0.0 && x < picture.width() as f32 && y < picture.height() as f32;
        if !inside {
            return;
        }
        let Rgb(under) = picture.get_pixel_mut(x as u32, y as u32);
        for (under, over) in under.iter_mut().zip(self.color) {
            let mixed = f32::from(*under) + (f32::from(over) - f32::from(*under)) * coverage;
            *under = mixed.clamp(0.0, 255.0) as u8;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_leave_ink_and_stay_inside() {
        let pen = Pen {
            size: 20.0,
            color: [0, 0, 0],
        };
        let mut picture = RgbImage::from_pixel(60, 20, Rgb([255; 3]));
        pen.write(&mut picture, 2.0, 0.0, "(a) ×5");
        assert!(picture.pixels().any(|pixel| pixel.0[0] < 64));
        pen.write(&mut picture, -500.0, -50.0, "outside");
        pen.write(&mut picture, 55.0, 15.0, "outside");
        assert!(pen.width("wide") > pen.width("i"));
    }

    #[test]
    fn every_sign_that_figures_use_is_in_the_font() {
        let font = FontRef::try_from_slice(FONT).unwrap();
        for letter in (' '..='~').chain("×±–→".chars()) {
            assert_ne!(font.glyph_id(letter).0, 0, "{letter}");
        }
    }
}
