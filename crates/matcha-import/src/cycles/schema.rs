//! The extension's objects, as `docs/gltf-extension` specifies them. Trees, nodes and
//! sockets are in `matcha_shade::source`.

use matcha_render::scene::{self, Sides};
use matcha_shade::source::NodeTree;
use serde::Deserialize;

/// `extensions.MATCHA_cycles` of the file.
#[derive(Debug, Deserialize)]
pub(super) struct Root {
    pub version: u32,
    #[serde(default)]
    pub settings: Option<Settings>,
    #[serde(default)]
    pub world: Option<World>,
    #[serde(default)]
    pub trees: Vec<NodeTree>,
    #[serde(default)]
    pub images: Vec<Image>,
}

/// An image: a glTF image, or a buffer view where its format is none of glTF's.
#[derive(Debug, Deserialize)]
pub(super) struct Image {
    pub name: String,
    pub colorspace: String,
    pub alpha_mode: String,
    #[serde(default)]
    pub source: Option<usize>,
    #[serde(default, rename = "bufferView")]
    pub buffer_view: Option<usize>,
}

/// Of a material.
#[derive(Debug, Deserialize)]
pub(super) struct Material {
    pub tree: u32,
    #[serde(default)]
    pub pass_index: f32,
    #[serde(default)]
    pub emission_sampling: Option<String>,
    #[serde(default = "yes")]
    pub use_transparent_shadow: bool,
    #[serde(default = "yes")]
    pub use_bump_map_correction: bool,
}

impl Material {
    pub fn sampled_sides(&self) -> Option<Sides> {
        match self.emission_sampling.as_deref() {
            Some("NONE") => None,
            Some("FRONT") => Some(Sides::Front),
            Some("BACK") => Some(Sides::Back),
            _ => Some(Sides::Both),
        }
    }
}

/// Of a mesh.
#[derive(Debug, Deserialize)]
pub(super) struct Mesh {
    pub material_slots: Vec<u32>,
    #[serde(default)]
    pub uv: Vec<Named>,
    #[serde(default)]
    pub attributes: Vec<Named>,
    #[serde(default)]
    pub active_uv: usize,
    #[serde(default)]
    pub active_color: String,
    pub generated_origin: [f32; 3],
    pub generated_size: [f32; 3],
    /// Semantic of Generated coordinates that the box does not give.
    #[serde(default)]
    pub generated: Option<String>,
    /// Semantic of Random Per Island.
    #[serde(default)]
    pub island: Option<String>,
}

/// A layer of a mesh and the semantic under which glTF has it.
#[derive(Debug, Deserialize)]
pub(super) struct Named {
    pub name: String,
    pub semantic: String,
}

/// Of a primitive.
#[derive(Debug, Deserialize)]
pub(super) struct Primitive {
    pub slot: u16,
}

/// Of a node.
#[derive(Debug, Default, Deserialize)]
pub(super) struct Node {
    #[serde(default)]
    pub object: Option<Object>,
    #[serde(default)]
    pub light: Option<Light>,
    #[serde(default)]
    pub camera: Option<Camera>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Object {
    pub name: String,
    #[serde(default)]
    pub pass_index: f32,
    #[serde(default = "white")]
    pub color: [f32; 4],
    #[serde(default)]
    pub visibility: Visibility,
    #[serde(default)]
    pub holdout: bool,
    #[serde(default)]
    pub random: f32,
    #[serde(default)]
    pub materials: Vec<u32>,
    #[serde(default)]
    pub shadow_catcher: bool,
}

fn white() -> [f32; 4] {
    [1.0; 4]
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(default)]
pub(super) struct Visibility {
    camera: bool,
    diffuse: bool,
    glossy: bool,
    transmission: bool,
    shadow: bool,
}

impl Default for Visibility {
    fn default() -> Self {
        Self {
            camera: true,
            diffuse: true,
            glossy: true,
            transmission: true,
            shadow: true,
        }
    }
}

impl From<Visibility> for scene::Visibility {
    fn from(v: Visibility) -> Self {
        Self {
            camera: v.camera,
            diffuse: v.diffuse,
            glossy: v.glossy,
            transmission: v.transmission,
            shadow: v.shadow,
        }
    }
}

/// A light; lengths before the node's scale.
#[derive(Debug, Deserialize)]
pub(super) struct Light {
    pub name: String,
    #[serde(rename = "type")]
    pub kind: String,
    pub energy: f32,
    pub color: [f32; 3],
    #[serde(default)]
    pub exposure: f32,
    #[serde(default = "yes")]
    pub normalize: bool,
    #[serde(default = "yes")]
    pub cast_shadow: bool,
    #[serde(default = "yes")]
    pub use_mis: bool,
    #[serde(default = "many")]
    pub max_bounces: u32,
    #[serde(default)]
    pub visibility: Visibility,
    #[serde(default)]
    pub random: f32,
    #[serde(default)]
    pub tree: Option<u32>,
    #[serde(default)]
    pub portal: bool,
    #[serde(default)]
    pub radius: f32,
    #[serde(default = "yes")]
    pub soft_falloff: bool,
    #[serde(default)]
    pub angle: f32,
    #[serde(default)]
    pub blend: f32,
    #[serde(default)]
    pub shape: String,
    #[serde(default)]
    pub size: [f32; 2],
    #[serde(default = "half_turn")]
    pub spread: f32,
}

fn yes() -> bool {
    true
}

fn many() -> u32 {
    1024
}

fn half_turn() -> f32 {
    std::f32::consts::PI
}

/// A camera; `lens` and sensor in millimetres.
#[derive(Debug, Deserialize)]
pub(super) struct Camera {
    #[serde(rename = "type")]
    pub kind: String,
    pub lens: f32,
    pub sensor_fit: String,
    pub sensor_width: f32,
    pub sensor_height: f32,
    #[serde(default)]
    pub shift: [f32; 2],
    pub clip: [f32; 2],
    pub ortho_scale: f32,
    #[serde(default)]
    pub panorama: String,
    #[serde(default)]
    pub dof: Option<DepthOfField>,
}

#[derive(Debug, Deserialize)]
pub(super) struct DepthOfField {
    pub enabled: bool,
    pub fstop: f32,
    pub focus_distance: f32,
    #[serde(default)]
    pub blades: u32,
    #[serde(default)]
    pub rotation: f32,
    #[serde(default = "one")]
    pub ratio: f32,
}

fn one() -> f32 {
    1.0
}

#[derive(Debug, Deserialize)]
pub(super) struct World {
    #[serde(default)]
    pub name: String,
    pub color: [f32; 3],
    #[serde(default)]
    pub visibility: Visibility,
    #[serde(default = "yes")]
    pub importance_sample: bool,
    #[serde(default)]
    pub map_resolution: u32,
    #[serde(default)]
    pub tree: Option<u32>,
}

#[derive(Debug, Deserialize)]
pub(super) struct Settings {
    pub resolution: [u32; 2],
    pub pixel_aspect: f32,
    pub samples: u32,
    pub max_bounces: u32,
    pub diffuse_bounces: u32,
    pub glossy_bounces: u32,
    pub transmission_bounces: u32,
    pub transparent_bounces: u32,
    #[serde(default)]
    pub min_bounces: u32,
    pub clamp_direct: f32,
    pub clamp_indirect: f32,
    pub blur_glossy: f32,
    pub reflective_caustics: bool,
    pub refractive_caustics: bool,
    pub light_threshold: f32,
    pub filter: Filter,
    pub exposure: f32,
    pub transparent_film: bool,
    pub view: View,
    pub seed: i64,
}

#[derive(Debug, Deserialize)]
pub(super) struct Filter {
    #[serde(rename = "type")]
    pub kind: String,
    pub width: f32,
}

#[derive(Debug, Deserialize)]
pub(super) struct View {
    pub transform: String,
    pub look: String,
    pub exposure: f32,
    pub gamma: f32,
}
