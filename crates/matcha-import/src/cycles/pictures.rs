//! Images as Blender declares them.

use super::schema;
use crate::file::Document;
use crate::picture::{Request, Source};
use crate::plain::texture;
use crate::report::{Report, ReportKind};
use matcha_render::scene::{AlphaMode, ColorSpace};
use std::borrow::Cow;

pub(super) fn request<'a>(
    document: &'a Document<'a>,
    image: &schema::Image,
    report: &mut Report,
) -> Request<'a> {
    let source = match (image.source, image.buffer_view) {
        (Some(source), _) => texture::source(document, source).1,
        (None, Some(view)) => match document.view(view, "MATCHA_cycles image") {
            Ok(bytes) => Source::Bytes(Cow::Borrowed(bytes)),
            Err(fault) => Source::Lost(format!("{}: {}", fault.place, fault.problem)),
        },
        (None, None) => Source::Lost("Blender could not find it".into()),
    };
    Request {
        name: image.name.clone(),
        source,
        color_space: color_space(image, report),
        alpha: alpha(image, report),
    }
}

/// Blender's names of colour spaces, from 4.2 to 5.x.
fn color_space(image: &schema::Image, report: &mut Report) -> ColorSpace {
    match image.colorspace.as_str() {
        "sRGB" | "sRGB OETF" | "Utility - sRGB - Texture" => ColorSpace::Srgb,
        "Linear Rec.709" | "Linear" | "linear" => ColorSpace::LinearRec709,
        "Non-Color" | "Non-Colour Data" | "Raw" | "Utility - Raw" => ColorSpace::NonColor,
        other => {
            let what = ReportKind::Feature(format!("colour space {other} is not supported"));
            report.add(what, &format!("image \"{}\"", image.name), "read as sRGB");
            ColorSpace::Srgb
        }
    }
}

fn alpha(image: &schema::Image, report: &mut Report) -> AlphaMode {
    match image.alpha_mode.as_str() {
        "STRAIGHT" => AlphaMode::Straight,
        "PREMUL" => AlphaMode::Premultiplied,
        "CHANNEL_PACKED" => AlphaMode::ChannelPacked,
        "NONE" => AlphaMode::None,
        other => {
            let what = ReportKind::Feature(format!("alpha mode {other} is not known"));
            report.add(
                what,
                &format!("image \"{}\"", image.name),
                "read as straight alpha",
            );
            AlphaMode::Straight
        }
    }
}
