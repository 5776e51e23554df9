//! Metallic-roughness materials (glTF 2.0, section 3.9) and their Khronos extensions.

use super::names::Names;
use super::texture::{Reference, Textures};
use crate::error::{Checked, Fault};
use crate::file::Document;
use crate::report::{Report, ReportKind};
use glam::{Vec3, Vec4};
use gltf::json::extensions::material::Material as Extensions;
use gltf::json::material::{AlphaMode, Material as GltfSource, NormalTexture};
use gltf::json::validation::Checked as Valid;
use matcha_render::scene::{Material, Shader, Sides};
use matcha_shade::source::{GltfAlpha, GltfMaterial};
use std::collections::HashMap;

/// Name of the attribute that base colours are multiplied by.
pub(crate) const VERTEX_COLOR: &str = "COLOR_0";

/// The materials in use. One that is used on meshes with and without vertex colours is
/// there twice.
#[derive(Default)]
pub(crate) struct Materials {
    list: Vec<(Material, bool)>,
    index: HashMap<(Option<usize>, bool), u32>,
}

impl Materials {
    /// The place of a material in the scene's list; `None` is glTF's default material.
    pub fn index<'a>(
        &mut self,
        document: &'a Document<'a>,
        source: Option<usize>,
        colored: bool,
        textures: &mut Textures<'a>,
        uv_names: &mut Names,
        report: &mut Report,
    ) -> Checked<u32> {
        if let Some(&index) = self.index.get(&(source, colored)) {
            return Ok(index);
        }
        let material = match source {
            Some(number) => Self::single(document, number, textures, uv_names, report)?,
            None => Reader {
                document,
                textures,
                uv_names,
                report,
            }
            .material(usize::MAX, &GltfSource::default())?,
        };
        let index = self.list.len() as u32;
        self.list.push((material, colored));
        self.index.insert((source, colored), index);
        Ok(index)
    }

    /// One material of the file on its own, without vertex colours.
    pub fn single<'a>(
        document: &'a Document<'a>,
        number: usize,
        textures: &mut Textures<'a>,
        uv_names: &mut Names,
        report: &mut Report,
    ) -> Checked<Material> {
        let mut reader = Reader {
            document,
            textures,
            uv_names,
            report,
        };
        reader.material(number, &document.root.materials[number])
    }

    /// The materials, with the attribute of vertex colours filled in.
    pub fn into_list(self, attributes: &[String]) -> Vec<Material> {
        let color = attributes
            .iter()
            .position(|name| name == VERTEX_COLOR)
            .map(|index| index as u16);
        let fill = |(mut material, colored): (Material, bool)| {
            if let (Shader::Gltf(gltf), true) = (&mut material.shader, colored) {
                gltf.vertex_color = color;
            }
            material
        };
        self.list.into_iter().map(fill).collect()
    }
}

struct Reader<'r, 'a> {
    document: &'a Document<'a>,
    textures: &'r mut Textures<'a>,
    uv_names: &'r mut Names,
    report: &'r mut Report,
}

impl Reader<'_, '_> {
    fn material(&mut self, number: usize, source: &GltfSource) -> Checked<Material> {
        let name = match (&source.name, number) {
            (Some(name), _) => name.clone(),
            (None, usize::MAX) => "default".into(),
            (None, number) => format!("materials[{number}]"),
        };
        let pbr = &source.pbr_metallic_roughness;
        let extensions = source.extensions.clone().unwrap_or_default();
        let strength = extensions
            .emissive_strength
            .as_ref()
            .map_or(1.0, |e| e.emissive_strength.0);
        let mut material = GltfMaterial {
            base_color: Vec4::from_array(pbr.base_color_factor.0),
            base_color_texture: self.texture(pbr.base_color_texture.as_ref(), true)?,
            metallic: pbr.metallic_factor.0,
            roughness: pbr.roughness_factor.0,
            metallic_roughness_texture: self
                .texture(pbr.metallic_roughness_texture.as_ref(), false)?,
            normal_texture: source
                .normal_texture
                .as_ref()
                .map(|n| self.normal(n))
                .transpose()?,
            emission: Vec3::from_array(source.emissive_factor.0) * strength,
            emission_texture: self.texture(source.emissive_texture.as_ref(), true)?,
            alpha: alpha(source),
            ior: extensions.ior.as_ref().map_or(1.5, |e| e.ior.0),
            transmission: extensions
                .transmission
                .as_ref()
                .map_or(0.0, |e| e.transmission_factor.0),
            specular: extensions.specular.as_ref().map_or((1.0, Vec3::ONE), |e| {
                (
                    e.specular_factor.0,
                    Vec3::from_array(e.specular_color_factor.0),
                )
            }),
            vertex_color: None,
        };
        self.report_ignored(&extensions, &name);
        if extensions.unlit.is_some() {
            unlit(&mut material);
        }
        check_finite(&material, number)?;
        Ok(Material {
            name,
            sample_emission: (material.emission != Vec3::ZERO).then_some(Sides::Both),
            shader: Shader::Gltf(Box::new(material)),
            pass_index: 0.0,
        })
    }

    fn texture(
        &mut self,
        info: Option<&gltf::json::texture::Info>,
        color: bool,
    ) -> Checked<Option<matcha_shade::source::GltfTexture>> {
        let Some(info) = info else { return Ok(None) };
        self.textures
            .resolve(
                self.document,
                Reference::new(info, color),
                self.uv_names,
                self.report,
            )
            .map(Some)
    }

    fn normal(
        &mut self,
        info: &NormalTexture,
    ) -> Checked<(matcha_shade::source::GltfTexture, f32)> {
        // `gltf-json` has no typed extensions for normal textures.
        let transform = info
            .extensions
            .as_ref()
            .and_then(|e| e.others.get("KHR_texture_transform"))
            .and_then(|value| serde_json::from_value(value.clone()).ok());
        let reference = Reference {
            texture: info.index.value(),
            uv_set: info.tex_coord,
            transform: transform.as_ref(),
            color: false,
        };
        let texture =
            self.textures
                .resolve(self.document, reference, self.uv_names, self.report)?;
        Ok((texture, info.scale))
    }

    fn report_ignored(&mut self, extensions: &Extensions, name: &str) {
        let transmission = extensions
            .transmission
            .as_ref()
            .is_some_and(|e| e.transmission_texture.is_some());
        let specular = extensions
            .specular
            .as_ref()
            .is_some_and(|e| e.specular_texture.is_some() || e.specular_color_texture.is_some());
        let parts = [
            (transmission, "KHR_materials_transmission's texture"),
            (specular, "KHR_materials_specular's textures"),
        ];
        for (_, part) in parts.into_iter().filter(|(present, _)| *present) {
            let subject = format!("material \"{name}\"");
            self.report.add(
                ReportKind::Extension(part.into()),
                &subject,
                "the factor alone is used",
            );
        }
    }
}

fn alpha(source: &GltfSource) -> GltfAlpha {
    match source.alpha_mode {
        Valid::Valid(AlphaMode::Mask) => {
            GltfAlpha::Mask(source.alpha_cutoff.map_or(0.5, |cutoff| cutoff.0))
        }
        Valid::Valid(AlphaMode::Blend) => GltfAlpha::Blend,
        _ => GltfAlpha::Opaque,
    }
}

/// `KHR_materials_unlit` shows the base colour as it is: all of it is emission, and
/// nothing is reflected. The base keeps its texture for the sake of alpha.
fn unlit(material: &mut GltfMaterial) {
    material.emission = material.base_color.truncate();
    material.emission_texture = material.base_color_texture;
    material.base_color = Vec3::ZERO.extend(material.base_color.w);
    (material.metallic, material.roughness, material.transmission) = (0.0, 1.0, 0.0);
    material.metallic_roughness_texture = None;
    material.normal_texture = None;
    material.specular = (0.0, Vec3::ZERO);
}

fn check_finite(material: &GltfMaterial, number: usize) -> Checked<()> {
    let numbers = [
        material.metallic,
        material.roughness,
        material.ior,
        material.transmission,
        material.specular.0,
    ];
    let finite = material.base_color.is_finite()
        && material.emission.is_finite()
        && material.specular.1.is_finite()
        && numbers.iter().all(|x| x.is_finite());
    if finite {
        Ok(())
    } else {
        Err(Fault::new(
            format!("materials[{number}]"),
            "has a factor that is not finite",
        ))
    }
}
