//! Images as Blender declares them.

use super::schema;
use crate::file::Document;
use crate::picture::{self, Request, Source};
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
    let alpha = alpha(image, report);
    Request {
        name: image.name.clone(),
        alpha: alpha_of_file(&source, alpha),
        source,
        color_space: color_space(image, report),
    }
}

/// Cycles has the file's format say whether colour is multiplied by alpha already, not the
/// image's setting: OpenEXR always is, PNG never.
fn alpha_of_file(source: &Source<'_>, asked: AlphaMode) -> AlphaMode {
    match (source, asked) {
        (Source::Bytes(bytes), AlphaMode::Straight | AlphaMode::Premultiplied) => {
            if bytes.starts_with(picture::EXR_MAGIC) {
                AlphaMode::Premultiplied
            } else if bytes.starts_with(picture::PNG_MAGIC) {
                AlphaMode::Straight
            } else {
                asked
            }
        }
        _ => asked,
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
