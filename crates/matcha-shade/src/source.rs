//! A node tree as its author drew it: the serde mirror of the `MATCHA_cycles`
//! glTF extension (`docs/gltf-extension/README.md`).
//!
//! Nothing is interpreted here. `nodes::lower` turns a tree into a typed graph.

use glam::{Vec2, Vec3, Vec4};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A node tree; groups refer to each other by index into the scene's list of trees.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct NodeTree {
    /// The tree's name in Blender.
    pub name: String,
    /// Nodes; links refer to them by position.
    pub nodes: Vec<SourceNode>,
    /// Links from an output socket to an input socket.
    #[serde(default)]
    pub links: Vec<Link>,
}

/// One node with everything its author set on it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SourceNode {
    /// Unique in its tree, as shown to the user.
    pub name: String,
    /// Blender's `bl_idname`, for example `ShaderNodeTexImage`.
    #[serde(rename = "type")]
    pub kind: String,
    /// RNA properties by identifier (`noise_dimensions`, `blend_type`, …).
    #[serde(default)]
    pub props: BTreeMap<String, Property>,
    /// Input sockets, all of them, in order.
    #[serde(default)]
    pub inputs: Vec<Socket>,
    /// Output sockets, all of them, in order. A socket's value is given where it
    /// is the node's content (`ShaderNodeValue`, `ShaderNodeRGB`, `ShaderNodeNormal`).
    #[serde(default)]
    pub outputs: Vec<Socket>,
    /// A muted node passes its inputs through along `internal_links`.
    #[serde(default)]
    pub muted: bool,
    /// Pairs (input socket, output socket) that a muted node connects.
    #[serde(default)]
    pub internal_links: Vec<[u32; 2]>,
    /// The inner tree of a group node: index into the file's `trees`.
    #[serde(default)]
    pub tree: Option<u32>,
    /// Image used by an image or environment texture: index into the file's `images`.
    #[serde(default)]
    pub image: Option<u32>,
    /// Colour ramp of `ShaderNodeValToRGB`.
    #[serde(default)]
    pub ramp: Option<Ramp>,
    /// Curves of `ShaderNodeRGBCurve`, `ShaderNodeVectorCurve`, `ShaderNodeFloatCurve`.
    #[serde(default)]
    pub curves: Option<Curves>,
    /// `TexMapping` of old texture nodes where it is not the identity:
    /// the 4x4 matrix, column by column, that maps the coordinate.
    #[serde(default)]
    pub texture_mapping: Option<[f32; 16]>,
    /// World-to-local matrix (column by column, Z up) of the object that a texture
    /// coordinate node points at.
    #[serde(default)]
    pub object_from_world: Option<[f32; 16]>,
}

/// A socket and its unlinked value.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Socket {
    /// Stable identifier inside the node (`Fac`, `A_Color`, `Value_001`, …).
    pub identifier: String,
    /// The label that the user sees.
    #[serde(default)]
    pub name: String,
    /// `VALUE`, `INT`, `BOOLEAN`, `VECTOR`, `RGBA`, `ROTATION`, `SHADER`, `STRING`, …
    #[serde(rename = "type")]
    pub kind: String,
    /// Value of an unlinked input: 1 to 4 numbers; empty for shaders and strings.
    #[serde(default)]
    pub value: Vec<f32>,
    /// Vectors whose unlinked value means "use the default coordinate or normal".
    #[serde(default)]
    pub hide_value: bool,
    /// False for sockets that the node's mode switches off.
    #[serde(default = "yes")]
    pub enabled: bool,
}

fn yes() -> bool {
    true
}

/// `from` and `to` are (node, socket) positions.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Link {
    /// Source node and output socket.
    pub from: [u32; 2],
    /// Target node and input socket.
    pub to: [u32; 2],
}

/// An RNA property's value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Property {
    /// A flag.
    Bool(bool),
    /// A whole number or a real one.
    Number(f64),
    /// An enum's identifier or a text.
    Text(String),
    /// A vector, colour or matrix (column by column).
    Numbers(Vec<f64>),
}

/// A colour ramp's stops, as edited.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Ramp {
    /// `RGB`, `HSV` or `HSL`.
    pub color_mode: String,
    /// `LINEAR`, `CONSTANT`, `EASE`, `CARDINAL` or `B_SPLINE`.
    pub interpolation: String,
    /// `NEAR`, `FAR`, `CW` or `CCW`, for HSV and HSL.
    pub hue_interpolation: String,
    /// (position, r, g, b, a), ascending by position.
    pub stops: Vec<[f32; 5]>,
    /// The ramp at two or more even positions over [0, 1], r g b a each. Empty: bake from stops.
    #[serde(default)]
    pub table: Vec<f32>,
}

/// A curve-mapping widget.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Curves {
    /// Each curve's control points.
    pub curves: Vec<Vec<CurvePoint>>,
    /// `HORIZONTAL` or `EXTRAPOLATED`.
    pub extend: String,
    /// Smallest and largest x that the tables cover.
    pub range: [f32; 2],
    /// One table of 257 values a curve over `range`, sampled by Blender, with the
    /// combined curve already applied for RGB curves. Same order as `curves`.
    pub tables: Vec<Vec<f32>>,
}

/// A control point.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct CurvePoint {
    /// Position.
    pub location: [f32; 2],
    /// `AUTO`, `AUTO_CLAMPED` or `VECTOR`.
    pub handle: String,
}

/// glTF 2.0 metallic-roughness (section 3.9 of the specification).
#[derive(Clone, Debug)]
pub struct GltfMaterial {
    /// Base colour factor, linear.
    pub base_color: Vec4,
    /// Base colour texture.
    pub base_color_texture: Option<GltfTexture>,
    /// Metalness factor.
    pub metallic: f32,
    /// Roughness factor.
    pub roughness: f32,
    /// Roughness in G, metalness in B.
    pub metallic_roughness_texture: Option<GltfTexture>,
    /// Tangent-space normal map and its scale.
    pub normal_texture: Option<(GltfTexture, f32)>,
    /// Emission factor times strength.
    pub emission: Vec3,
    /// Emission texture.
    pub emission_texture: Option<GltfTexture>,
    /// How alpha is used.
    pub alpha: GltfAlpha,
    /// Index of refraction (`KHR_materials_ior`).
    pub ior: f32,
    /// Transmission (`KHR_materials_transmission`).
    pub transmission: f32,
    /// Specular level and tint (`KHR_materials_specular`).
    pub specular: (f32, Vec3),
    /// Multiplied by the vertex colour: attribute index.
    pub vertex_color: Option<u16>,
}

/// glTF alpha mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GltfAlpha {
    /// Alpha is ignored.
    Opaque,
    /// Cut out below the value.
    Mask(f32),
    /// Mixed with what is behind.
    Blend,
}

/// A texture reference of a glTF material.
#[derive(Clone, Copy, Debug)]
pub struct GltfTexture {
    /// Index into the scene's images.
    pub image: u32,
    /// Index into the scene's UV names.
    pub uv: u16,
    /// `KHR_texture_transform`: offset, rotation (radians), scale.
    pub transform: (Vec2, f32, Vec2),
    /// Wrap mode.
    pub extension: Extension,
}

/// What is outside of an image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Extension {
    /// Tiles.
    Repeat,
    /// The border's pixel.
    Extend,
    /// Transparent black.
    Clip,
    /// Tiles, every other one mirrored.
    Mirror,
}
