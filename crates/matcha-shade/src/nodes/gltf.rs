//! glTF 2.0 metallic-roughness (specification, section 3.9) as a Principled closure.

use super::image::look_up_in;
use crate::closure::{ClosureKind, Distribution, PRINCIPLED, Ty};
use crate::graph::{AlphaHandling, Encoding, Graph, Interpolation, NodeId, TextureRef};
use crate::input::InputKind;
use crate::material::{ClosureTree, MaterialGraph, MaterialKind};
use crate::ops::OpCode;
use crate::source::{GltfAlpha, GltfMaterial, GltfTexture};

/// Lowers a glTF material.
pub fn lower_gltf(name: &str, source: &GltfMaterial) -> MaterialGraph {
    let mut graph = Graph::new();
    let g = &mut graph;
    let look = Look::of(g, source);
    let mut closures = ClosureTree::default();
    let params = PRINCIPLED
        .iter()
        .map(|p| look.parameter(g, p.name, p.ty, source))
        .collect();
    let white = g.f3([1.0; 3]);
    let kind = ClosureKind::Principled(Distribution::MultiGgx);
    let leaf = closures.leaf(g, kind, white, params, Default::default());
    closures.root = Some(leaf);
    MaterialGraph {
        name: name.to_owned(),
        kind: MaterialKind::Surface,
        graph,
        closures,
    }
}

/// The values that textures may drive.
struct Look {
    base_color: NodeId,
    alpha: NodeId,
    metallic: NodeId,
    roughness: NodeId,
    normal: NodeId,
    emission: NodeId,
}

impl Look {
    fn of(g: &mut Graph, source: &GltfMaterial) -> Self {
        let base = base_color(g, source);
        let base_color = g.extract(base, 0, Ty::F3);
        let raw_alpha = g.component(base, 3);
        let alpha = match source.alpha {
            GltfAlpha::Opaque => g.f1(1.0),
            GltfAlpha::Blend => raw_alpha,
            GltfAlpha::Mask(cutoff) => {
                let cutoff = g.f1(cutoff);
                let below = g.apply(OpCode::math_less_than, &[raw_alpha, cutoff]);
                let one = g.f1(1.0);
                g.apply(OpCode::math_subtract, &[one, below])
            }
        };
        let factors = [source.metallic, source.roughness].map(|x| g.f1(x));
        let [metallic, roughness] = match &source.metallic_roughness_texture {
            None => factors,
            Some(texture) => {
                let found = texel(g, texture, AlphaHandling::Ignored);
                let blue = g.component(found, 2);
                let green = g.component(found, 1);
                [
                    g.apply(OpCode::math_multiply, &[blue, factors[0]]),
                    g.apply(OpCode::math_multiply, &[green, factors[1]]),
                ]
            }
        };
        Look {
            base_color: g.means_color(base_color),
            alpha,
            metallic,
            roughness,
            normal: normal(g, source),
            emission: emission(g, source),
        }
    }

    fn parameter(&self, g: &mut Graph, name: &str, ty: Ty, source: &GltfMaterial) -> NodeId {
        let number = match name {
            "base_color" => return self.base_color,
            "alpha" => return self.alpha,
            "metallic" => return self.metallic,
            "roughness" => return self.roughness,
            "normal" | "coat_normal" => return self.normal,
            "emission_color" => return self.emission,
            "specular_tint" => return g.f3(source.specular.1.into()),
            "ior" => source.ior,
            "transmission_weight" => source.transmission,
            // Principled's level is one half where the index alone decides.
            "specular_ior_level" => 0.5 * source.specular.0,
            "emission_strength" | "coat_tint" | "sheen_tint" => 1.0,
            "coat_ior" => 1.5,
            "coat_roughness" => 0.03,
            "sheen_roughness" => 0.5,
            "subsurface_ior" => 1.4,
            "thin_film_ior" => 1.33,
            _ => 0.0,
        };
        let mut value = [number; 4];
        value[ty.width()..].fill(0.0);
        g.constant(ty, value)
    }
}

impl Graph {
    fn means_color(&mut self, id: NodeId) -> NodeId {
        if self.constant_value(id).is_some() {
            return id;
        }
        self.means(id, Encoding::Color)
    }
}

fn base_color(g: &mut Graph, source: &GltfMaterial) -> NodeId {
    let mut base = g.constant(Ty::F4, source.base_color.into());
    if let Some(texture) = &source.base_color_texture {
        let alpha = match source.alpha {
            GltfAlpha::Opaque => AlphaHandling::Ignored,
            _ => AlphaHandling::Unassociated,
        };
        let found = texel(g, texture, alpha);
        base = product(g, base, found);
    }
    if let Some(attribute) = source.vertex_color {
        let color = g.value(InputKind::Attribute(attribute));
        base = product(g, base, color);
    }
    base
}

/// Two F4, component by component.
fn product(g: &mut Graph, a: NodeId, b: NodeId) -> NodeId {
    let [ca, cb] = [a, b].map(|x| g.extract(x, 0, Ty::F3));
    let [aa, ab] = [a, b].map(|x| g.component(x, 3));
    let color = g.apply(OpCode::vector_multiply, &[ca, cb]);
    let alpha = g.apply(OpCode::math_multiply, &[aa, ab]);
    g.combine(&[color, alpha])
}

fn normal(g: &mut Graph, source: &GltfMaterial) -> NodeId {
    let smooth = g.value(InputKind::Normal);
    let Some((texture, scale)) = &source.normal_texture else {
        return smooth;
    };
    let found = texel(g, texture, AlphaHandling::Ignored);
    let color = g.extract(found, 0, Ty::F3);
    // glTF scales x and y and leaves z; so does the strength up to one.
    let strength = g.f1(*scale);
    let tangent = g.value(InputKind::Tangent(texture.uv));
    let sign = g.value(InputKind::TangentSign(texture.uv));
    let back = g.value(InputKind::Backfacing);
    let inputs = [color, strength, smooth, tangent, sign, back];
    g.apply(OpCode::normal_map_tangent, &inputs)
}

fn emission(g: &mut Graph, source: &GltfMaterial) -> NodeId {
    let factor = g.f3(source.emission.into());
    let Some(texture) = &source.emission_texture else {
        return factor;
    };
    let found = texel(g, texture, AlphaHandling::Ignored);
    let color = g.extract(found, 0, Ty::F3);
    let product = g.apply(OpCode::vector_multiply, &[color, factor]);
    g.means_color(product)
}

/// A texture at its transformed coordinate (`KHR_texture_transform`). glTF's v goes
/// down, ours up, so that the transform is applied between two flips.
fn texel(g: &mut Graph, texture: &GltfTexture, alpha: AlphaHandling) -> NodeId {
    let uv = g.value(InputKind::Uv(texture.uv));
    let (offset, angle, scale) = texture.transform;
    let is_identity = offset == glam::Vec2::ZERO && angle == 0.0 && scale == glam::Vec2::ONE;
    let uv = if is_identity {
        uv
    } else {
        let (sin, cos) = angle.sin_cos();
        // Down: u' = cos·sx·u + sin·sy·v + ox, v' = −sin·sx·u + cos·sy·v + oy.
        let rows = [
            [cos * scale.x, -sin * scale.y, sin * scale.y + offset.x],
            [sin * scale.x, cos * scale.y, 1.0 - cos * scale.y - offset.y],
        ];
        let [u, v] = [0, 1].map(|i| g.component(uv, i));
        let parts = rows.map(|[a, b, c]| {
            let [a, b, c] = [a, b, c].map(|x| g.f1(x));
            let partial = g.apply(OpCode::math_multiply_add, &[v, b, c]);
            g.apply(OpCode::math_multiply_add, &[u, a, partial])
        });
        g.combine(&parts)
    };
    let texture = TextureRef {
        image: texture.image,
        interpolation: Interpolation::Linear,
        extension: texture.extension,
        alpha,
        no_footprint: false,
    };
    look_up_in(g, texture, uv)
}
