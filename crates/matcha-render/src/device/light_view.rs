//! Everything that shines, as the devices read it.

use crate::device::light_analytic::AnalyticLight;
use crate::device::light_triangle::LightTriangle;
use glam::Vec3;

/// Stands for no index.
pub const LIGHT_NONE: u32 = 0xffff_ffff;

/// Bit of [`LightNode::link`]: the child is an emitter, else a node.
pub const LIGHT_LINK_EMITTER: u32 = 0x8000_0000;
/// Bit of [`LightNode::link`]: the child shines to both sides of its normals.
pub const LIGHT_LINK_TWO_SIDED: u32 = 0x4000_0000;
/// Bits of [`LightNode::link`] that hold the emitter or the node.
pub const LIGHT_LINK_INDEX: u32 = 0x3fff_ffff;

/// A node of a light tree: bounds and links of its eight children, 48 bytes each. An empty
/// slot has no power.
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C, align(64))]
pub struct LightNode {
    /// Low corners of the boxes, metres: x.
    pub low_x: [f32; 8],
    /// Low corners: y.
    pub low_y: [f32; 8],
    /// Low corners: z.
    pub low_z: [f32; 8],
    /// High corners of the boxes, metres: x.
    pub high_x: [f32; 8],
    /// High corners: y.
    pub high_y: [f32; 8],
    /// High corners: z.
    pub high_z: [f32; 8],
    /// Unit axes of the cones of normals: x.
    pub axis_x: [f32; 8],
    /// Axes: y.
    pub axis_y: [f32; 8],
    /// Axes: z.
    pub axis_z: [f32; 8],
    /// Radiance times area, W·sr⁻¹.
    pub power: [f32; 8],
    /// `LIGHT_LINK_` bits.
    pub link: [u32; 8],
    /// Cosines of θo (low 16 bits) and θe (high ones) in parts of 32767, signed, rounded down
    /// so that the cones only grow.
    pub cosines: [u32; 8],
}

/// Bits of [`LightGroups::link`] that say what a group is; the others are an index.
pub const LIGHT_GROUP_WHAT: u32 = 0xc000_0000;
/// A block of groups.
pub const LIGHT_GROUP_IS_BLOCK: u32 = 0;
/// An analytic light.
pub const LIGHT_GROUP_IS_LIGHT: u32 = 0x4000_0000;
/// A tree of emissive triangles; the index is its root.
pub const LIGHT_GROUP_IS_TREE: u32 = 0x8000_0000;
/// The world.
pub const LIGHT_GROUP_IS_WORLD: u32 = 0xc000_0000;

/// Bit of [`LightGroups::flags`]: lane 0 is parted into lanes 2 and 3; twice as large: lane 1
/// into lanes 4 and 5.
pub const LIGHT_OPENS: u32 = 1;
/// Bit of [`LightGroups::flags`]: some lane is a rectangle.
pub const LIGHT_RECTANGLES: u32 = 4;

/// Bit of [`LightGroups::flags`]: in lanes 0, 1, 4 and 5 the world is one of the choices.
pub const LIGHT_UNSURE: u32 = 8;

/// A block of groups of lights, in eight lanes, of which the first six are used; see
/// `light_choice`. Fields of a lane are those of `LightGroup`; an empty lane has no power.
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct LightGroups {
    /// Middles, metres: x.
    pub center_x: [f32; 8],
    /// Middles: y.
    pub center_y: [f32; 8],
    /// Middles: z.
    pub center_z: [f32; 8],
    /// Half diagonals or sides, metres: x.
    pub half_x: [f32; 8],
    /// Half diagonals or sides: y.
    pub half_y: [f32; 8],
    /// Half diagonals or sides: z.
    pub half_z: [f32; 8],
    /// Half the other sides, metres: x.
    pub side_x: [f32; 8],
    /// Half the other sides: y.
    pub side_y: [f32; 8],
    /// Half the other sides: z.
    pub side_z: [f32; 8],
    /// Unit axes of the cones of normals: x.
    pub axis_x: [f32; 8],
    /// Axes: y.
    pub axis_y: [f32; 8],
    /// Axes: z.
    pub axis_z: [f32; 8],
    /// Cosines of θo.
    pub cos_normals: [f32; 8],
    /// Cosines of θe.
    pub cos_emission: [f32; 8],
    /// Luminous intensity or irradiance, W·sr⁻¹ or W·m⁻².
    pub power: [f32; 8],
    /// `LIGHT_GROUP_` kinds of shapes.
    pub kind: [u32; 8],
    /// What the lanes are: `LIGHT_GROUP_IS_` and an index.
    pub link: [u32; 8],
    /// [`LIGHT_OPENS`], [`LIGHT_RECTANGLES`], [`LIGHT_UNSURE`].
    pub flags: u32,
    /// Lane that is the world, or [`LIGHT_NONE`].
    pub world: u32,
}

/// Bit of [`LightView::parents`]: the node is a root, and the rest its slot in the groups.
pub const LIGHT_PARENT_GROUP: u32 = 0x8000_0000;

/// Bit of [`EmissiveTriangle::surface`]: the instance mirrors its mesh.
pub const LIGHT_MIRRORED: u32 = 0x8000_0000;

/// A triangle that shines, in the world.
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct EmissiveTriangle {
    /// Corners in the world.
    pub corners: LightTriangle,
    /// Index into `Scene::instances`.
    pub instance: u32,
    /// Triangle of the instance's mesh.
    pub primitive: u32,
    /// Index into `Scene::materials`; with [`LIGHT_MIRRORED`] where the instance mirrors its
    /// mesh, so that the front is where corners run clockwise.
    pub surface: u32,
}

/// Bit of [`LightMaterial::flags`]: the radiance is the same everywhere and in every direction.
pub const LIGHT_UNIFORM: u32 = 1;
/// Bit of [`LightMaterial::flags`]: the side shines that the corners run around counter-clockwise.
pub const LIGHT_FRONT: u32 = 2;
/// Bit of [`LightMaterial::flags`]: the other side shines.
pub const LIGHT_BACK: u32 = 4;

/// Emission of a material; without flags it has none.
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct LightMaterial {
    /// Mean radiance over the surface, W·sr⁻¹·m⁻².
    pub radiance: Vec3,
    /// [`LIGHT_UNIFORM`], [`LIGHT_FRONT`], [`LIGHT_BACK`].
    pub flags: u32,
}

/// Bit of [`LightOf::flags`]: blocked by objects.
pub const LIGHT_CASTS_SHADOW: u32 = 1;
/// Bit of [`LightOf::flags`]: combined with BSDF samples; otherwise only next-event
/// estimation finds the light.
pub const LIGHT_IS_MET: u32 = 2;

/// An analytic light with what a path must know of it.
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct LightOf {
    /// Index into `Scene::lights`.
    pub scene_light: u32,
    /// Node tree that multiplies the radiance: index into `Scene::trees`, or [`LIGHT_NONE`].
    pub tree: u32,
    /// [`LIGHT_CASTS_SHADOW`], [`LIGHT_IS_MET`].
    pub flags: u32,
    /// Who sees it: `RAY_` bits.
    pub visibility: u32,
    /// Bounces after which it still counts.
    pub max_bounces: u32,
    /// Its slot in the groups (8 · block + lane).
    pub slot: u32,
    /// Geometry and radiance.
    pub shape: AnalyticLight,
}

/// A node of the hierarchy over the analytic lights with a shape.
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct LightBox {
    /// Low corner, metres.
    pub low: Vec3,
    /// High corner, metres.
    pub high: Vec3,
    /// Of a leaf the first place in [`LightView::order`], else the first of two children.
    pub first: u32,
    /// Lights of a leaf, 0 for others.
    pub count: u32,
}

/// All lights. Functions over the view are always inlined, so that it is never copied whole.
///
/// Analytic lights, the world and instances with emission are the leaves of the tree of
/// groups; emissive triangles hang in trees of their own.
#[derive(Clone, Copy, Debug, Default)]
pub struct LightView<'a> {
    /// Blocks of the tree of groups, root first.
    pub groups: &'a [LightGroups],
    /// Slot (8 · block + lane) that holds each block; unused for the root.
    pub group_parents: &'a [u32],
    /// The trees of emissive triangles.
    pub nodes: &'a [LightNode],
    /// Slot (8 · node + child) that holds each node, or [`LIGHT_PARENT_GROUP`].
    pub parents: &'a [u32],
    /// Slot that holds each emitter.
    pub slots: &'a [u32],
    /// Emissive triangles; their index is their emitter.
    pub triangles: &'a [EmissiveTriangle],
    /// For each instance the start of its entries in `of_primitive`, or [`LIGHT_NONE`].
    pub first: &'a [u32],
    /// Emitter of each primitive of the instances with emission, or [`LIGHT_NONE`].
    pub of_primitive: &'a [u32],
    /// Emission by index of the scene's materials.
    pub materials: &'a [LightMaterial],
    /// Analytic lights.
    pub lights: &'a [LightOf],
    /// Those at infinity but for the world.
    pub suns: &'a [u32],
    /// Hierarchy over the analytic lights with a shape, root first.
    pub boxes: &'a [LightBox],
    /// Analytic lights in the order of the hierarchy's leaves.
    pub order: &'a [u32],
    /// Tables of the world's importance map; see `light_world`.
    pub world: &'a [f32],
    /// Columns of the world's map; 0: the world is not sampled.
    pub world_width: u32,
    /// Rows of the world's map.
    pub world_height: u32,
    /// Which closures see the world: `RAY_` bits.
    pub world_visibility: u32,
    /// The world's slot in the groups.
    pub world_slot: u32,
    /// Luminous irradiance of the world's mean radiance on one side.
    pub world_irradiance: f32,
    /// Spherical harmonics of the map's luminance; order as in `light_world_irradiance`.
    pub world_harmonics: [f32; 9],
}

/// Which light of the scene an analytic light is.
#[inline]
pub fn light_scene_light(view: LightView, light: u32) -> u32 {
    view.lights[light as usize].scene_light
}
