//! Closures, and Mix and Add Shader.

use super::coordinates::radial_tangent;
use super::{At, Lowered, Lowering, Value};
use crate::closure::{ClosureKind, Distribution, PRINCIPLED, SheenModel};
use crate::graph::{Encoding, NodeId};
use crate::ops::OpCode;

fn leaf(l: &mut Lowering, kind: ClosureKind, weight: NodeId, params: Vec<NodeId>) -> Value {
    let span = l.graph.span();
    Value::Shader(l.closures.leaf(&l.graph, kind, weight, params, span))
}

fn distribution(l: &Lowering, at: At) -> Lowered<Distribution> {
    Ok(match l.text(at, "distribution", "GGX").as_str() {
        "GGX" | "SHARP" => Distribution::Ggx,
        "MULTI_GGX" => Distribution::MultiGgx,
        "BECKMANN" => Distribution::Beckmann,
        "ASHIKHMIN_SHIRLEY" => Distribution::AshikhminShirley,
        _ => return Err(l.bad_property(at, "distribution")),
    })
}

/// The tangent of an anisotropic closure; anything where it is isotropic.
fn tangent(l: &mut Lowering, at: At, anisotropy: NodeId) -> Lowered<NodeId> {
    if l.known(anisotropy) == Some(0.0) {
        return Ok(l.graph.f3([0.0; 3]));
    }
    if l.is_linked(at, "Tangent") {
        return l.f3(at, "Tangent");
    }
    Ok(radial_tangent(l, 2))
}

/// `ShaderNodeBsdfDiffuse`.
pub(super) fn diffuse(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let color = l.color(at, "Color")?;
    let params = vec![l.f1(at, "Roughness")?, l.normal_input(at, "Normal")?];
    Ok(leaf(l, ClosureKind::Diffuse, color, params))
}

/// `ShaderNodeBsdfAnisotropic` and `ShaderNodeBsdfGlossy`.
pub(super) fn glossy(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let kind = ClosureKind::Glossy(distribution(l, at)?);
    let color = l.color(at, "Color")?;
    glossy_with(l, at, kind, color)
}

fn glossy_with(l: &mut Lowering, at: At, kind: ClosureKind, color: NodeId) -> Lowered<Value> {
    let roughness = l.f1(at, "Roughness")?;
    let anisotropy = l.f1_or(at, "Anisotropy", 0.0)?;
    let rotation = l.f1_or(at, "Rotation", 0.0)?;
    let normal = l.normal_input(at, "Normal")?;
    let tangent = tangent(l, at, anisotropy)?;
    let params = vec![roughness, anisotropy, rotation, normal, tangent];
    Ok(leaf(l, kind, color, params))
}

/// `ShaderNodeBsdfMetallic`: its edge tint or refractive index is left out.
pub(super) fn metallic(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    l.substitute(
        at,
        "ShaderNodeBsdfMetallic",
        "a glossy closure of its base colour",
    );
    let kind = ClosureKind::Glossy(distribution(l, at)?);
    let color = l.color(at, "Base Color")?;
    glossy_with(l, at, kind, color)
}

/// `ShaderNodeBsdfGlass`.
pub(super) fn glass(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let kind = ClosureKind::Glass(distribution(l, at)?);
    refracting(l, at, kind)
}

/// `ShaderNodeBsdfRefraction`.
pub(super) fn refraction(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let kind = match distribution(l, at)? {
        Distribution::MultiGgx => Distribution::Ggx,
        other => other,
    };
    refracting(l, at, ClosureKind::Refraction(kind))
}

fn refracting(l: &mut Lowering, at: At, kind: ClosureKind) -> Lowered<Value> {
    let color = l.color(at, "Color")?;
    let params = vec![
        l.f1(at, "Roughness")?,
        l.f1(at, "IOR")?,
        l.normal_input(at, "Normal")?,
    ];
    let film = l.f1_or(at, "Thin Film Thickness", 0.0)?;
    if l.known(film) != Some(0.0) {
        l.substitute(at, "a thin film on glass", "no film");
    }
    Ok(leaf(l, kind, color, params))
}

/// `ShaderNodeBsdfTranslucent`.
pub(super) fn translucent(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let color = l.color(at, "Color")?;
    let normal = l.normal_input(at, "Normal")?;
    Ok(leaf(l, ClosureKind::Translucent, color, vec![normal]))
}

/// `ShaderNodeBsdfTransparent`.
pub(super) fn transparent(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let color = l.color(at, "Color")?;
    Ok(leaf(l, ClosureKind::Transparent, color, vec![]))
}

/// `ShaderNodeHoldout`.
pub(super) fn holdout(l: &mut Lowering, _at: At, _output: &str) -> Lowered<Value> {
    let white = l.graph.f3([1.0; 3]);
    Ok(leaf(l, ClosureKind::Holdout, white, vec![]))
}

/// `ShaderNodeBsdfSheen`.
pub(super) fn sheen(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let model = match l.text(at, "distribution", "MICROFIBER").as_str() {
        "ASHIKHMIN" => SheenModel::Ashikhmin,
        "MICROFIBER" => SheenModel::Microfiber,
        _ => return Err(l.bad_property(at, "distribution")),
    };
    let color = l.color(at, "Color")?;
    let params = vec![l.f1(at, "Roughness")?, l.normal_input(at, "Normal")?];
    Ok(leaf(l, ClosureKind::Sheen(model), color, params))
}

/// `ShaderNodeBsdfVelvet`, the older form of sheen.
pub(super) fn velvet(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let color = l.color(at, "Color")?;
    let params = vec![l.f1(at, "Sigma")?, l.normal_input(at, "Normal")?];
    let kind = ClosureKind::Sheen(SheenModel::Ashikhmin);
    Ok(leaf(l, kind, color, params))
}

/// `ShaderNodeBsdfToon` and hair: diffuse.
pub(super) fn as_diffuse(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let kind = l.source(at).kind.clone();
    l.substitute(at, &kind, "a diffuse closure of its colour");
    let color = l.color(at, "Color")?;
    let params = vec![l.graph.f1(0.0), l.default_normal()];
    Ok(leaf(l, ClosureKind::Diffuse, color, params))
}

/// `ShaderNodeSubsurfaceScattering`.
pub(super) fn subsurface(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    l.substitute(
        at,
        "ShaderNodeSubsurfaceScattering",
        "a diffuse closure of its colour",
    );
    let color = l.color(at, "Color")?;
    let params = vec![
        l.f1(at, "Scale")?,
        l.f3(at, "Radius")?,
        l.f1_or(at, "IOR", 1.4)?,
        l.f1_or(at, "Anisotropy", 0.0)?,
        l.normal_input(at, "Normal")?,
    ];
    Ok(leaf(l, ClosureKind::Subsurface, color, params))
}

/// `ShaderNodeEmission`.
pub(super) fn emission(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    radiating(l, at, ClosureKind::Emission)
}

/// `ShaderNodeBackground`.
pub(super) fn background(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    radiating(l, at, ClosureKind::Background)
}

fn radiating(l: &mut Lowering, at: At, kind: ClosureKind) -> Lowered<Value> {
    let color = l.color(at, "Color")?;
    let strength = l.f1(at, "Strength")?;
    let weight = match l.known(strength) {
        Some(1.0) => color,
        _ => {
            let product = l.op(OpCode::vector_scale, &[color, strength]);
            l.graph.means(product, Encoding::Color)
        }
    };
    Ok(leaf(l, kind, weight, vec![]))
}

/// What an older or incomplete Principled node has where a socket is missing.
fn principled_default(name: &str) -> [f32; 3] {
    match name {
        "base_color" => [0.8; 3],
        "roughness" | "specular_ior_level" | "sheen_roughness" => [0.5; 3],
        "ior" | "coat_ior" => [1.5; 3],
        "alpha" | "specular_tint" | "coat_tint" | "sheen_tint" | "emission_color" => [1.0; 3],
        "subsurface_radius" => [1.0, 0.2, 0.1],
        "subsurface_scale" => [0.05; 3],
        "subsurface_ior" => [1.4; 3],
        "coat_roughness" => [0.03; 3],
        "thin_film_ior" => [1.33; 3],
        _ => [0.0; 3],
    }
}

/// Blender's name of a Principled parameter's socket.
fn principled_socket(name: &str) -> String {
    let words = name.split('_').map(|word| match word {
        "ior" => "IOR".to_owned(),
        _ => word[..1].to_uppercase() + &word[1..],
    });
    words.collect::<Vec<_>>().join(" ")
}

/// `ShaderNodeBsdfPrincipled`.
pub(super) fn principled(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let kind = ClosureKind::Principled(distribution(l, at)?);
    let mut params = Vec::new();
    for parameter in PRINCIPLED {
        let socket = principled_socket(parameter.name);
        let default = principled_default(parameter.name);
        params.push(match parameter.name {
            "normal" => l.normal_input(at, &socket)?,
            "coat_normal" if !l.is_linked(at, &socket) => l.default_normal(),
            "tangent" => {
                let anisotropy = l.f1_or(at, "Anisotropic", 0.0)?;
                tangent(l, at, anisotropy)?
            }
            name if name.ends_with("_color") || name.ends_with("_tint") => {
                match l.find_input(at, &socket) {
                    Some(_) => l.color(at, &socket)?,
                    None => l.graph.f3(default),
                }
            }
            _ if parameter.ty.width() == 3 => l.f3_or(at, &socket, default)?,
            _ => l.f1_or(at, &socket, default[0])?,
        });
    }
    let scattered = l.f1_or(at, "Subsurface Weight", 0.0)?;
    if l.known(scattered) != Some(0.0) {
        l.substitute(
            at,
            "subsurface of ShaderNodeBsdfPrincipled",
            "diffuse reflection",
        );
    }
    let film = l.f1_or(at, "Thin Film Thickness", 0.0)?;
    if l.known(film) != Some(0.0) {
        l.substitute(at, "a thin film on ShaderNodeBsdfPrincipled", "no film");
    }
    let white = l.graph.f3([1.0; 3]);
    Ok(leaf(l, kind, white, params))
}

/// `ShaderNodeMixShader`.
pub(super) fn mix_shader(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let fac = l.f1(at, "Fac")?;
    let a = l.closure(at, "Shader")?;
    let b = l.closure(at, "Shader_001")?;
    Ok(Value::Shader(l.closures.mix(&l.graph, fac, a, b)))
}

/// `ShaderNodeAddShader`.
pub(super) fn add_shader(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let a = l.closure(at, "Shader")?;
    let b = l.closure(at, "Shader_001")?;
    Ok(Value::Shader(l.closures.add(a, b)))
}

/// Volumes: nothing.
pub(super) fn volume(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let kind = l.source(at).kind.clone();
    l.substitute(at, &kind, "no volume");
    Ok(Value::Shader(l.closures.none()))
}
