//! A scene as the renderer takes it: plain data, made by an importer, never changed
//! while rendering. Blender's conventions throughout: metres, Z up, right-handed,
//! linear Rec.709, v of texture coordinates up.

pub use crate::light::Sides;
use glam::{Affine3A, Vec2, Vec3, Vec4};
use matcha_shade::source::{GltfMaterial, NodeTree};
use std::sync::Arc;

/// Everything there is to render.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// Name for reports: the file's stem.
    pub name: String,
    /// Meshes, each once.
    pub meshes: Vec<Mesh>,
    /// Placements of meshes.
    pub instances: Vec<Instance>,
    /// Materials; `Mesh::material_slots` and `Instance::materials` index them.
    pub materials: Vec<Material>,
    /// Node trees: of materials, lights and the world, and the groups inside.
    pub trees: Vec<NodeTree>,
    /// Decoded pictures.
    pub images: Vec<Image>,
    /// Analytic lights.
    pub lights: Vec<Light>,
    /// Names of mesh attributes that programs read; `InputKind::Attribute` indexes them.
    pub attribute_names: Vec<String>,
    /// Names of UV maps; `InputKind::Uv` indexes them. Entry 0 is always the empty name
    /// and means the active layer of whatever mesh is hit.
    pub uv_names: Vec<String>,
    /// The world around.
    pub world: World,
    /// The camera.
    pub camera: Camera,
    /// What the author asked the renderer for.
    pub settings: Settings,
}

/// A triangle mesh in its object's space. All per-corner arrays have `3 * triangles` entries.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Name in the source file.
    pub name: String,
    /// Vertex positions.
    pub positions: Vec<Vec3>,
    /// Three vertex indices a triangle, counter-clockwise seen from the front.
    pub indices: Vec<[u32; 3]>,
    /// Shading normal of each triangle corner, unit. Empty: flat everywhere.
    pub corner_normals: Vec<[Vec3; 3]>,
    /// Material slot of each triangle; empty: all 0.
    pub slots: Vec<u16>,
    /// Material of each slot: index into `Scene::materials`.
    pub material_slots: Vec<u32>,
    /// UV layers.
    pub uv_sets: Vec<UvSet>,
    /// Which of `uv_sets` is meant where a node names none.
    pub active_uv: usize,
    /// Colour and vector attributes.
    pub attributes: Vec<MeshAttribute>,
    /// Origin of the Generated texture space: `generated = (p - origin) / size`.
    pub generated_origin: Vec3,
    /// Size of the Generated texture space.
    pub generated_size: Vec3,
    /// Generated coordinates of each triangle's corners where modifiers moved the vertices
    /// away from them; empty: as the box above gives them.
    pub generated: Vec<[Vec3; 3]>,
    /// Random Per Island of each triangle where the file has it; empty: a hash of its own.
    pub islands: Vec<f32>,
}

impl Mesh {
    /// Material of a triangle as an instance shows it: index into `Scene::materials`.
    pub fn material_of(&self, instance: &Instance, triangle: u32) -> Option<u32> {
        let slot = self
            .slots
            .get(triangle as usize)
            .map_or(0, |&slot| usize::from(slot));
        self.material_of_slot(instance, slot)
    }

    /// Material of a slot: the instance's where it replaces the mesh's.
    pub fn material_of_slot(&self, instance: &Instance, slot: usize) -> Option<u32> {
        instance
            .materials
            .get(slot)
            .or_else(|| self.material_slots.get(slot))
            .copied()
    }
}

/// A UV layer.
#[derive(Clone, Debug)]
pub struct UvSet {
    /// Index into `Scene::uv_names`, never 0.
    pub name: u16,
    /// Coordinates of each triangle's corners.
    pub corners: Vec<[Vec2; 3]>,
    /// Tangents (unit) with sign in w, MikkTSpace, where some material needs them; else empty.
    pub tangents: Vec<[Vec4; 3]>,
}

/// An attribute on triangle corners, linear colour with alpha or a vector with w = 1.
#[derive(Clone, Debug)]
pub struct MeshAttribute {
    /// Index into `Scene::attribute_names`.
    pub name: u16,
    /// Values of each triangle's corners.
    pub corners: Vec<[Vec4; 3]>,
}

/// Which kinds of rays see an object or a light (Cycles' ray visibility).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Visibility {
    /// Seen by camera rays.
    pub camera: bool,
    /// Seen by rays that a diffuse closure scattered.
    pub diffuse: bool,
    /// Seen by rays that a glossy closure scattered.
    pub glossy: bool,
    /// Seen by rays that were transmitted.
    pub transmission: bool,
    /// Casts shadows.
    pub shadow: bool,
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

/// One placement of a mesh.
#[derive(Clone, Debug)]
pub struct Instance {
    /// Object's name.
    pub name: String,
    /// Index into `Scene::meshes`.
    pub mesh: u32,
    /// Object to world.
    pub transform: Affine3A,
    /// Materials that replace the mesh's slots; empty: the mesh's own.
    pub materials: Vec<u32>,
    /// `Object Info` index.
    pub pass_index: f32,
    /// `Object Info` random, 0 to 1.
    pub random: f32,
    /// `Object Info` colour and alpha.
    pub color: Vec4,
    /// Who sees it.
    pub visibility: Visibility,
    /// Cuts a hole into the film.
    pub holdout: bool,
}

/// A material.
#[derive(Clone, Debug)]
pub struct Material {
    /// Name.
    pub name: String,
    /// Where the look comes from.
    pub shader: Shader,
    /// `Material Index` of the object-info node.
    pub pass_index: f32,
    /// Sides that are treated as lights by next-event estimation. It matters to more than noise
    /// where a surface that shines casts no shadow: light is taken through it.
    pub sample_emission: Option<Sides>,
}

/// The source of a material's look.
#[derive(Clone, Debug)]
pub enum Shader {
    /// A Cycles tree: index into `Scene::trees`.
    Cycles(u32),
    /// glTF metallic-roughness.
    Gltf(Box<GltfMaterial>),
}

/// A picture, in memory as its file had it.
#[derive(Clone, Debug)]
pub struct Image {
    /// Name for messages.
    pub name: String,
    /// Size in pixels.
    pub width: u32,
    /// Size in pixels.
    pub height: u32,
    /// Pixels, four channels, first row is the TOP of the picture.
    pub pixels: Pixels,
    /// How numbers become light.
    pub color_space: ColorSpace,
    /// Straight, premultiplied, none (alpha is 1), channel packed.
    pub alpha: AlphaMode,
}

/// Pixel storage.
#[derive(Clone, Debug)]
pub enum Pixels {
    /// Eight bits a channel.
    Rgba8(Arc<Vec<[u8; 4]>>),
    /// Floats.
    RgbaF32(Arc<Vec<[f32; 4]>>),
}

/// Colour space of an image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColorSpace {
    /// IEC 61966-2-1.
    Srgb,
    /// Linear Rec.709.
    LinearRec709,
    /// Numbers that are no colours.
    NonColor,
}

/// How an image's alpha is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AlphaMode {
    /// Colour is independent of alpha.
    Straight,
    /// Colour is already multiplied by alpha.
    Premultiplied,
    /// Alpha and colour are unrelated.
    ChannelPacked,
    /// Alpha is ignored and reads 1.
    None,
}

/// An analytic light.
#[derive(Clone, Debug)]
pub struct Light {
    /// Name.
    pub name: String,
    /// Light to world; it shines along its −Z.
    pub transform: Affine3A,
    /// Geometry and distribution.
    pub shape: LightShape,
    /// Colour times power, in the unit of Blender's light (W; W·m⁻² for a sun).
    pub power: Vec3,
    /// Node tree that replaces or modulates the emission: index into `Scene::trees`.
    pub tree: Option<u32>,
    /// Blocked by objects.
    pub cast_shadow: bool,
    /// Sampled together with BSDFs (multiple importance).
    pub use_mis: bool,
    /// Who sees the light's shape.
    pub visibility: Visibility,
    /// Maximum number of bounces after which the light still counts.
    pub max_bounces: u32,
    /// Divided by the shape's size, as Cycles' point, spot and area lights do (`normalize`).
    pub normalize: bool,
    /// `Object Info` random, 0 to 1.
    pub random: f32,
}

/// A white point of one watt at the origin that casts shadows and that everybody sees.
impl Default for Light {
    fn default() -> Self {
        Self {
            name: String::new(),
            transform: Affine3A::IDENTITY,
            shape: LightShape::Point {
                radius: 0.0,
                soft_falloff: false,
            },
            power: Vec3::ONE,
            tree: None,
            cast_shadow: true,
            use_mis: true,
            visibility: Visibility::default(),
            max_bounces: 1024,
            normalize: true,
            random: 0.0,
        }
    }
}

/// Shape of an analytic light.
#[derive(Clone, Copy, Debug)]
pub enum LightShape {
    /// Sphere of a radius (metres); zero is a point. `soft_falloff` as in Blender.
    Point {
        /// Radius, metres.
        radius: f32,
        /// Blender's soft falloff flag.
        soft_falloff: bool,
    },
    /// Point or sphere with a cone.
    Spot {
        /// Radius, metres.
        radius: f32,
        /// Full angle of the cone, radians.
        angle: f32,
        /// Softness of the edge, 0 to 1.
        blend: f32,
        /// Blender's soft falloff flag.
        soft_falloff: bool,
    },
    /// Directional, with an angular diameter in radians.
    Sun {
        /// Angular diameter, radians.
        angle: f32,
    },
    /// Rectangle or ellipse in the light's XY plane, one-sided.
    Area {
        /// Sizes in x and y, metres.
        size: Vec2,
        /// Ellipse instead of rectangle.
        ellipse: bool,
        /// Full spread angle, radians; π is all of the half space.
        spread: f32,
    },
}

/// What is around the scene.
#[derive(Clone, Debug)]
pub struct World {
    /// Node tree; index into `Scene::trees`.
    pub tree: Option<u32>,
    /// Constant radiance where there is no tree.
    pub color: Vec3,
    /// Who sees it.
    pub visibility: Visibility,
    /// False where its author switched off importance sampling (`NONE`).
    pub importance_sample: bool,
    /// Width of the importance map, 0: automatic.
    pub map_resolution: u32,
}

impl Default for World {
    fn default() -> Self {
        Self {
            tree: None,
            color: Vec3::ZERO,
            visibility: Visibility::default(),
            importance_sample: true,
            map_resolution: 0,
        }
    }
}

/// A thin-lens camera that looks along its −Z with +Y up.
#[derive(Clone, Debug)]
pub struct Camera {
    /// Camera to world.
    pub transform: Affine3A,
    /// Projection.
    pub projection: Projection,
    /// Lens shift in units of the larger sensor side, as in Blender.
    pub shift: Vec2,
    /// Near and far clipping distance, metres.
    pub clip: [f32; 2],
    /// Radius of the lens, metres; 0 is a pinhole.
    pub aperture_radius: f32,
    /// Distance of the plane in focus, metres.
    pub focus_distance: f32,
    /// Number of blades, 0 to 2: round. And their rotation, radians.
    pub blades: (u32, f32),
    /// Anamorphic ratio.
    pub aperture_ratio: f32,
}

impl Default for Camera {
    fn default() -> Self {
        Self {
            transform: Affine3A::IDENTITY,
            projection: Projection::Perspective {
                tan_half_width: 0.36,
                fit: SensorFit::Auto,
            },
            shift: Vec2::ZERO,
            clip: [0.001, 1e5],
            aperture_radius: 0.0,
            focus_distance: 10.0,
            blades: (0, 0.0),
            aperture_ratio: 1.0,
        }
    }
}

/// Camera projection.
#[derive(Clone, Copy, Debug)]
pub enum Projection {
    /// `tan_half_width` belongs to the side that `fit` names.
    Perspective {
        /// Tangent of half of the field of view.
        tan_half_width: f32,
        /// The side that it spans.
        fit: SensorFit,
    },
    /// Parallel rays; `scale` metres wide.
    Orthographic {
        /// Metres.
        scale: f32,
        /// The side that it spans.
        fit: SensorFit,
    },
    /// Full equirectangular panorama.
    Equirectangular,
}

/// Which side of the picture a camera's width refers to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SensorFit {
    /// The larger.
    Auto,
    /// The width.
    Horizontal,
    /// The height.
    Vertical,
}

/// Render settings of the scene.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Picture size in pixels, percentage applied.
    pub resolution: [u32; 2],
    /// Pixel aspect ratio (x / y).
    pub pixel_aspect: f32,
    /// Samples a pixel.
    pub samples: u32,
    /// Largest number of bounces in all.
    pub max_bounces: u32,
    /// Likewise after diffuse closures.
    pub diffuse_bounces: u32,
    /// Likewise after glossy closures.
    pub glossy_bounces: u32,
    /// Likewise after transmission.
    pub transmission_bounces: u32,
    /// Number of transparent surfaces that a ray passes.
    pub transparent_bounces: u32,
    /// Bounces before Russian roulette may end a path, beyond the first.
    pub min_bounces: u32,
    /// Clamp of a direct contribution (sum of channels), 0: none.
    pub clamp_direct: f32,
    /// Clamp of an indirect contribution, 0: none.
    pub clamp_indirect: f32,
    /// Cycles' filter glossy.
    pub blur_glossy: f32,
    /// Caustics by reflection.
    pub reflective_caustics: bool,
    /// Caustics by refraction.
    pub refractive_caustics: bool,
    /// Light contributions below this may be dropped at random (Cycles' threshold).
    pub light_threshold: f32,
    /// Pixel filter.
    pub filter: PixelFilter,
    /// Film exposure factor.
    pub exposure: f32,
    /// The world is not seen by the camera, alpha is 0 there.
    pub transparent_film: bool,
    /// View transform of the PNG.
    pub view: ViewSettings,
    /// Seed.
    pub seed: u32,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            resolution: [960, 540],
            pixel_aspect: 1.0,
            samples: 128,
            max_bounces: 12,
            diffuse_bounces: 4,
            glossy_bounces: 4,
            transmission_bounces: 12,
            transparent_bounces: 8,
            min_bounces: 0,
            clamp_direct: 0.0,
            clamp_indirect: 10.0,
            blur_glossy: 1.0,
            reflective_caustics: true,
            refractive_caustics: true,
            light_threshold: 0.01,
            filter: PixelFilter::BlackmanHarris(1.5),
            exposure: 1.0,
            transparent_film: false,
            view: ViewSettings::default(),
            seed: 0,
        }
    }
}

/// Pixel filter with its width in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PixelFilter {
    /// Box of one pixel.
    Box,
    /// Gaussian.
    Gaussian(f32),
    /// Blackman–Harris.
    BlackmanHarris(f32),
}

/// View transform of the scene.
#[derive(Clone, Debug)]
pub struct ViewSettings {
    /// `Standard`, `AgX`, `Filmic`, `Raw`, …
    pub transform: String,
    /// Blender's look, `None` where there is none.
    pub look: String,
    /// Stops.
    pub exposure: f32,
    /// Display gamma.
    pub gamma: f32,
}

impl Default for ViewSettings {
    fn default() -> Self {
        Self {
            transform: "AgX".into(),
            look: "None".into(),
            exposure: 0.0,
            gamma: 1.0,
        }
    }
}
