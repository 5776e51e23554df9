//! The paper's figure 1 for one scene: without the cache, with it, their difference,
//! the nodes found; under each what was measured.

use super::heat::{NODES_AT_TOP, viridis};
use super::text::Pen;
use image::imageops::{self, FilterType};
use image::{Rgb, RgbImage};

/// One picture with the lines under it: the first is its title.
#[derive(Clone, Debug)]
pub struct Panel {
    /// The picture.
    pub picture: RgbImage,
    /// Title, then measurements.
    pub lines: Vec<String>,
    /// A heat map: gets a bar of its colours with the ends' numbers.
    pub heat: bool,
}

/// Widths that a panel is scaled to lie between, pixels.
const WIDTHS: [u32; 2] = [400, 640];
const INK: [u8; 3] = [32, 32, 32];
const PAPER: [u8; 3] = [255, 255, 255];

/// Panels side by side, all of the first one's size, with their lines below.
pub fn compose(panels: &[Panel]) -> RgbImage {
    let Some(first) = panels.first() else {
        return RgbImage::new(1, 1);
    };
    let (width, height) = panel_size(first.picture.dimensions());
    let size = width as f32 / 24.0;
    let margin = (size * 0.75) as u32;
    let lines = panels
        .iter()
        .map(|panel| panel.lines.len())
        .max()
        .unwrap_or(0) as u32;
    let line_height = (size * 1.25) as u32;
    let count = panels.len() as u32;
    let mut figure = RgbImage::from_pixel(
        count * width + (count + 1) * margin,
        height + 2 * margin + lines * line_height + margin,
        Rgb(PAPER),
    );
    for (k, panel) in (0u32..).zip(panels) {
        let x = margin + k * (width + margin);
        let mut picture = scale(&panel.picture, width, height);
        if panel.heat {
            draw_heat_scale(&mut picture);
        }
        imageops::replace(&mut figure, &picture, x.into(), margin.into());
        for (line, text) in (0u32..).zip(&panel.lines) {
            let y = margin + height + margin / 2 + line * line_height;
            let pen = Pen {
                size: fitted(text, size, width),
                color: INK,
            };
            pen.write(&mut figure, x as f32, y as f32, text);
        }
    }
    figure
}

/// A bar of the heat map's colours with its ends' numbers, laid over the lower edge of a
/// picture.
fn draw_heat_scale(picture: &mut RgbImage) {
    let (width, height) = picture.dimensions();
    let bar = (height / 28).max(3);
    for x in 0..width {
        let color = Rgb(viridis(x as f32 / width.max(2) as f32));
        for y in height.saturating_sub(bar)..height {
            picture.put_pixel(x, y, color);
        }
    }
    let pen = Pen {
        size: bar as f32 * 1.8,
        color: PAPER,
    };
    let y = height as f32 - bar as f32 - pen.size * 1.1;
    let top = format!("{NODES_AT_TOP}");
    pen.write(picture, pen.size * 0.3, y, "0");
    pen.write(
        picture,
        width as f32 - pen.width(&top) - pen.size * 0.3,
        y,
        &top,
    );
}

fn panel_size((width, height): (u32, u32)) -> (u32, u32) {
    let panel = width.clamp(WIDTHS[0], WIDTHS[1]);
    let scaled = u64::from(height) * u64::from(panel) / u64::from(width.max(1));
    (panel, scaled.clamp(1, 4 * u64::from(panel)) as u32)
}

fn scale(picture: &RgbImage, width: u32, height: u32) -> RgbImage {
    if picture.dimensions() == (width, height) {
        return picture.clone();
    }
    let filter = if picture.width() > width {
        FilterType::Lanczos3
    } else {
        FilterType::Nearest
    };
    imageops::resize(picture, width, height, filter)
}

/// The size at which a line fits its panel.
fn fitted(text: &str, size: f32, width: u32) -> f32 {
    let needed = Pen { size, color: INK }.width(text);
    size * (width as f32 / needed.max(1.0)).min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn panel(color: [u8; 3], lines: &[&str]) -> Panel {
        Panel {
            picture: RgbImage::from_pixel(480, 270, Rgb(color)),
            lines: lines.iter().map(|&line| line.to_owned()).collect(),
            heat: false,
        }
    }

    #[test]
    fn panels_stand_in_a_row_over_their_lines() {
        let colors = [[200, 0, 0], [0, 200, 0], [0, 0, 200], [200, 200, 0]];
        let lines = ["(a) Without the cache", "12.3 s"];
        let figure = compose(&colors.map(|color| panel(color, &lines)));
        for (k, color) in (0..).zip(colors) {
            let x = 15 + k * (480 + 15) + 240;
            assert_eq!(figure.get_pixel(x, 150).0, color);
        }
        let text = imageops::crop_imm(&figure, 0, 290, figure.width(), figure.height() - 290);
        assert!(text.to_image().pixels().any(|pixel| pixel.0[0] < 100));
    }

    #[test]
    fn odd_sizes_make_figures_too() {
        for (width, height) in [(1, 1), (1, 3000), (3000, 1), (33, 7)] {
            let picture = RgbImage::new(width, height);
            let panel = Panel {
                picture,
                lines: vec!["a".repeat(300)],
                heat: true,
            };
            assert!(compose(&[panel]).width() > 400);
        }
        draw_heat_scale(&mut RgbImage::new(2, 2));
    }
}
