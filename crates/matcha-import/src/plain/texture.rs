//! Textures of glTF materials, gathered into requests for pictures.

use super::names::Names;
use crate::error::{Checked, Fault};
use crate::file::Document;
use crate::file::resource::decode_data;
use crate::picture::{Request, Source};
use crate::report::{Report, ReportKind};
use glam::Vec2;
use gltf::json::extensions::texture::{Info as InfoExtensions, TextureTransform};
use gltf::json::texture::{MagFilter, Sampler, WrappingMode};
use gltf::json::validation::Checked as Valid;
use matcha_render::scene::{AlphaMode, ColorSpace};
use matcha_shade::source::{Extension, GltfTexture};
use std::borrow::Cow;
use std::collections::HashMap;

/// Requests, one for each (image, colour space) in use.
#[derive(Default)]
pub(crate) struct Textures<'a> {
    pub requests: Vec<Request<'a>>,
    index: HashMap<(usize, bool), u32>,
}

/// A reference to a texture, as the three kinds of texture infos in glTF have it.
pub(crate) struct Reference<'r> {
    pub texture: usize,
    pub uv_set: u32,
    pub transform: Option<&'r TextureTransform>,
    pub color: bool,
}

impl<'r> Reference<'r> {
    pub fn new(info: &'r gltf::json::texture::Info, color: bool) -> Self {
        let transform = info
            .extensions
            .as_ref()
            .and_then(|e: &InfoExtensions| e.texture_transform.as_ref());
        Self {
            texture: info.index.value(),
            uv_set: info.tex_coord,
            transform,
            color,
        }
    }
}

impl<'a> Textures<'a> {
    /// The texture in the renderer's terms.
    pub fn resolve(
        &mut self,
        document: &'a Document<'a>,
        reference: Reference<'_>,
        uv_names: &mut Names,
        report: &mut Report,
    ) -> Checked<GltfTexture> {
        let place = format!("textures[{}]", reference.texture);
        let texture = document
            .root
            .textures
            .get(reference.texture)
            .ok_or_else(|| Fault::new(place.clone(), "does not exist"))?;
        let webp = texture
            .extensions
            .as_ref()
            .and_then(|e| e.others.get("EXT_texture_webp"))
            .and_then(|e| e.get("source"))
            .and_then(serde_json::Value::as_u64);
        let image = webp.map_or(texture.source.value(), |source| source as usize);
        let sampler = texture
            .sampler
            .and_then(|sampler| document.root.samplers.get(sampler.value()));
        let extension = sampler.map_or(Extension::Repeat, |sampler| wrap(sampler, &place, report));
        let set = reference
            .transform
            .and_then(|t| t.tex_coord)
            .unwrap_or(reference.uv_set);
        Ok(GltfTexture {
            image: self.image(document, image, reference.color),
            uv: uv_names.intern(&format!("TEXCOORD_{set}"))?,
            transform: transform(reference.transform, &place)?,
            extension,
        })
    }

    fn image(&mut self, document: &'a Document<'a>, image: usize, color: bool) -> u32 {
        let requests = &mut self.requests;
        *self.index.entry((image, color)).or_insert_with(|| {
            let color_space = if color {
                ColorSpace::Srgb
            } else {
                ColorSpace::NonColor
            };
            let (name, source) = source(document, image);
            requests.push(Request {
                name,
                source,
                color_space,
                alpha: AlphaMode::Straight,
            });
            requests.len() as u32 - 1
        })
    }
}

/// Name and bytes of a glTF image.
pub(crate) fn source<'a>(document: &'a Document<'a>, index: usize) -> (String, Source<'a>) {
    let Some(image) = document.root.images.get(index) else {
        return (
            format!("images[{index}]"),
            Source::Lost("no such entry in the file".into()),
        );
    };
    let place = format!("images[{index}]");
    let file_name = image.uri.as_ref().filter(|uri| !uri.starts_with("data:"));
    let name = image
        .name
        .clone()
        .or_else(|| file_name.cloned())
        .unwrap_or_else(|| place.clone());
    let lost = |fault: Fault| Source::Lost(format!("{}: {}", fault.place, fault.problem));
    let source = match (&image.buffer_view, &image.uri) {
        (Some(view), _) => document
            .view(view.value(), &place)
            .map_or_else(lost, |b| Source::Bytes(Cow::Borrowed(b))),
        (None, Some(uri)) => match uri.strip_prefix("data:") {
            Some(data) => {
                decode_data(data).map_or_else(Source::Lost, |b| Source::Bytes(Cow::Owned(b)))
            }
            None => document
                .folder
                .locate(uri, &place)
                .map_or_else(lost, Source::File),
        },
        (None, None) => Source::Lost(format!("{place} has neither a buffer view nor a uri")),
    };
    (name, source)
}

fn wrap(sampler: &Sampler, place: &str, report: &mut Report) -> Extension {
    let mode = |wrap| match wrap {
        Valid::Valid(WrappingMode::ClampToEdge) => Extension::Extend,
        Valid::Valid(WrappingMode::MirroredRepeat) => Extension::Mirror,
        _ => Extension::Repeat,
    };
    let (s, t) = (mode(sampler.wrap_s), mode(sampler.wrap_t));
    if s != t {
        let what = ReportKind::Feature(
            "textures that wrap differently in u and v are not supported".into(),
        );
        report.add(what, place, "both wrap as u does");
    }
    if sampler.mag_filter == Some(Valid::Valid(MagFilter::Nearest)) {
        let what =
            ReportKind::Feature("glTF textures without interpolation are not supported".into());
        report.add(what, place, "interpolated linearly");
    }
    s
}

/// `KHR_texture_transform` as the file has it, in glTF's coordinates with v down.
fn transform(transform: Option<&TextureTransform>, place: &str) -> Checked<(Vec2, f32, Vec2)> {
    let Some(transform) = transform else {
        return Ok((Vec2::ZERO, 0.0, Vec2::ONE));
    };
    let (offset, scale) = (
        Vec2::from_array(transform.offset.0),
        Vec2::from_array(transform.scale.0),
    );
    let angle = transform.rotation.0;
    if !(offset.is_finite() && scale.is_finite() && angle.is_finite()) {
        return Err(Fault::new(place, "its KHR_texture_transform is not finite"));
    }
    Ok((offset, angle, scale))
}
