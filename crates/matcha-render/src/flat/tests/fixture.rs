//! For tests, those of matcha-gpu too: a scene in which every kind of layer is there, and is missing.

use crate::accel::Hit;
use crate::scene::{
    AlphaMode, ColorSpace, Image, Instance, Material, Mesh, MeshAttribute, Pixels, Scene, Shader,
    UvSet, Visibility,
};
use crate::surface::PathInfo;
use glam::{Affine3A, Quat, Vec3, Vec4};
use matcha_shade::graph::{AlphaHandling, Interpolation, TextureRef};
use matcha_shade::input::{Input, InputKind, Part};
use matcha_shade::source::Extension;
use std::sync::Arc;

/// A small generator (Wellons 2018: lowbias32 of a counter).
pub struct Random(pub u32);

impl Random {
    pub fn next(&mut self) -> u32 {
        self.0 = self.0.wrapping_add(1);
        let mut x = self.0;
        x = (x ^ (x >> 16)).wrapping_mul(0x7feb_352d);
        x = (x ^ (x >> 15)).wrapping_mul(0x846c_a68b);
        x ^ (x >> 16)
    }

    pub fn unit(&mut self) -> f32 {
        (self.next() >> 8) as f32 / 16_777_216.0
    }

    pub fn vector(&mut self) -> Vec3 {
        Vec3::from([0; 3].map(|_| self.unit() * 2.0 - 1.0))
    }

    pub fn direction(&mut self) -> Vec3 {
        self.vector().try_normalize().unwrap_or(Vec3::Z)
    }
}

/// A path of which everything is at random.
pub fn path(random: &mut Random) -> PathInfo {
    PathInfo {
        direction: random.direction(),
        flags: random.next() & 0xff,
        cone_width: random.unit() * 0.1,
        cone_spread: random.unit() * 0.1,
        ray_length: random.unit() * 5.0,
        bounce: random.next() & 7,
        transparent: random.next() & 3,
        ..PathInfo::default()
    }
}

/// A hit somewhere on a scene.
pub fn hit(random: &mut Random, scene: &Scene) -> Hit {
    let instance = random.next() % scene.instances.len() as u32;
    let mesh = &scene.meshes[scene.instances[instance as usize].mesh as usize];
    let (u, v) = (random.unit(), random.unit());
    let inside = u + v <= 1.0;
    Hit {
        instance,
        primitive: random.next() % mesh.indices.len() as u32,
        t: random.unit() * 10.0,
        u: if inside { u } else { 1.0 - u },
        v: if inside { v } else { 1.0 - v },
    }
}

/// Triangles at random; `rich` ones have all layers.
fn mesh(random: &mut Random, triangles: usize, rich: bool) -> Mesh {
    let positions: Vec<Vec3> = (0..triangles + 2).map(|_| random.vector()).collect();
    let indices = (0..triangles as u32).map(|i| [i, i + 1, i + 2]).collect();
    let mut three = |rich: bool| -> Vec<[Vec3; 3]> {
        let count = if rich { triangles } else { 0 };
        (0..count)
            .map(|_| [0; 3].map(|_| random.direction()))
            .collect()
    };
    let mut corner_normals = three(rich);
    if rich {
        // One facet of a single normal.
        corner_normals[0] = [corner_normals[0][0]; 3];
    }
    let uvs = three(true);
    let four = |v: &[Vec3; 3]| v.map(|v| v.extend(v.x.signum()));
    let uv_set = |name, tangents| UvSet {
        name,
        corners: uvs.iter().map(|t| t.map(Vec3::truncate)).collect(),
        tangents,
    };
    let tangents = three(rich).iter().map(four).collect();
    let attributes = if rich {
        vec![MeshAttribute {
            name: 1,
            corners: three(true)
                .iter()
                .map(|t| t.map(|v| Vec4::from((v, 0.5))))
                .collect(),
        }]
    } else {
        vec![]
    };
    Mesh {
        name: "mesh".into(),
        corner_normals,
        uv_sets: if rich {
            vec![uv_set(2, tangents), uv_set(1, vec![])]
        } else {
            vec![uv_set(2, vec![])]
        },
        active_uv: usize::from(rich),
        attributes,
        slots: if rich {
            (0..triangles as u16).map(|i| i % 3).collect()
        } else {
            vec![]
        },
        material_slots: vec![0, 1, 2],
        generated_origin: Vec3::new(0.1, 0.2, 0.3),
        generated_size: Vec3::new(2.0, 0.0, 0.5),
        generated: if rich { three(true) } else { vec![] },
        islands: vec![],
        positions,
        indices,
    }
}

pub fn scene() -> Scene {
    let mut random = Random(77);
    let meshes = vec![
        mesh(&mut random, 5, false),
        mesh(&mut random, 9, true),
        mesh(&mut random, 3, false),
    ];
    let mut instances = Vec::new();
    for i in 0..8u32 {
        let turn = Quat::from_axis_angle(random.direction(), random.unit() * 6.0);
        let mut scale = random.vector() + Vec3::splat(1.5);
        if i % 3 == 0 {
            scale.x = -scale.x;
        }
        instances.push(Instance {
            name: "object".into(),
            mesh: i % 3,
            transform: Affine3A::from_scale_rotation_translation(scale, turn, random.vector()),
            materials: if i > 4 { vec![3] } else { vec![] },
            pass_index: i as f32,
            random: random.unit(),
            color: random.vector().extend(random.unit()),
            visibility: Visibility::default(),
            holdout: i == 2,
        });
    }
    let material = |i: u32| Material {
        name: "material".into(),
        shader: Shader::Cycles(0),
        pass_index: 10.0 + i as f32,
        sample_emission: Some(crate::scene::Sides::Both),
    };
    Scene {
        meshes,
        instances,
        materials: (0..4).map(material).collect(),
        uv_names: ["", "a", "b", "absent"].map(String::from).to_vec(),
        attribute_names: ["absent", "color"].map(String::from).to_vec(),
        ..Scene::default()
    }
}

/// Every quantity with every part, of names that are there and of some that are not.
pub fn all_kinds() -> Vec<Input> {
    use InputKind::*;
    let named = [Uv, Tangent, TangentSign, DpDu, DpDv, InputKind::Attribute];
    let names = named.iter().flat_map(|kind| [0, 1, 2, 3, 99].map(kind));
    let plain = [
        Position,
        Normal,
        TrueNormal,
        Incoming,
        Generated,
        Object,
        Camera,
        Window,
        Parametric,
        Backfacing,
        Pointiness,
        RandomPerIsland,
        ObjectLocation,
        ObjectColor,
        ObjectAlpha,
        ObjectIndex,
        MaterialIndex,
        ObjectRandom,
        IsCameraRay,
        IsShadowRay,
        IsDiffuseRay,
        IsGlossyRay,
        IsSingularRay,
        IsReflectionRay,
        IsTransmissionRay,
        RayLength,
        RayDepth,
        DiffuseDepth,
        GlossyDepth,
        TransparentDepth,
        TransmissionDepth,
    ];
    let parts = [Part::Value, Part::AxisA, Part::AxisB];
    let with_parts = |kind| parts.map(|part| Input { kind, part });
    names.chain(plain).flat_map(with_parts).collect()
}

pub fn image(width: u32, height: u32, color_space: ColorSpace, alpha: AlphaMode) -> Image {
    let mut random = Random(width * 100 + height);
    let pixels = (0..width * height).map(|_| random.next().to_le_bytes());
    Image {
        name: "bytes".into(),
        width,
        height,
        pixels: Pixels::Rgba8(Arc::new(pixels.collect())),
        color_space,
        alpha,
    }
}

/// Images of all kinds; look-ups may ask for one more.
pub fn images() -> Vec<Image> {
    let mut random = Random(9);
    let floats = (0..77).map(|_| [0; 4].map(|_| random.unit() * 3.0));
    vec![
        image(16, 8, ColorSpace::Srgb, AlphaMode::Straight),
        image(7, 13, ColorSpace::NonColor, AlphaMode::Straight),
        image(1, 1, ColorSpace::LinearRec709, AlphaMode::ChannelPacked),
        image(9, 9, ColorSpace::LinearRec709, AlphaMode::Premultiplied),
        image(8, 4, ColorSpace::Srgb, AlphaMode::None),
        Image {
            pixels: Pixels::RgbaF32(Arc::new(floats.collect())),
            ..image(7, 11, ColorSpace::LinearRec709, AlphaMode::Straight)
        },
    ]
}

/// The same images, those of bytes smooth: as blocks can have them.
pub fn smooth_images() -> Vec<Image> {
    let mut images = images();
    for image in &mut images {
        let width = image.width as usize;
        if let Pixels::Rgba8(pixels) = &mut image.pixels {
            for (k, pixel) in Arc::make_mut(pixels).iter_mut().enumerate() {
                let along = k % width + k / width;
                let alpha = if along.is_multiple_of(3) {
                    0
                } else {
                    250 + along % 6
                };
                *pixel = [40 + 3 * along, 200 - 2 * along, 90 + along, alpha].map(|v| v as u8);
            }
        }
    }
    images
}

/// Look-ups of these images, and of one that is not there, in all ways.
pub fn looks() -> Vec<TextureRef> {
    let mut looks = Vec::new();
    for image in 0..7 {
        for interpolation in [
            Interpolation::Closest,
            Interpolation::Linear,
            Interpolation::Cubic,
        ] {
            for extension in [
                Extension::Repeat,
                Extension::Extend,
                Extension::Clip,
                Extension::Mirror,
            ] {
                for alpha in [
                    AlphaHandling::Associated,
                    AlphaHandling::Unassociated,
                    AlphaHandling::Ignored,
                ] {
                    looks.push(TextureRef {
                        image,
                        interpolation,
                        extension,
                        alpha,
                        no_footprint: image == 3,
                    });
                }
            }
        }
    }
    looks
}
