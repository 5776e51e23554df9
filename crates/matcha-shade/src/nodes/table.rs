//! The node types, one entry each.

use super::{
    At, Lowered, Lowering, Value, bump, cellular, color, coordinates, image, mapping, noise,
    number, pattern, ramp, shader, spectrum, surface, vector,
};

/// Lowers one output, given by its identifier.
pub(super) type Lower = fn(&mut Lowering, At, &str) -> Lowered<Value>;

/// A node type.
pub struct NodeEntry {
    /// Blender's `bl_idname`.
    pub kind: &'static str,
    /// Its place in Blender's *Add* menu.
    pub menu: &'static str,
    /// What is not honoured; empty where everything is.
    pub limits: &'static str,
    pub(super) lower: Lower,
}

/// Every node type that is known.
pub fn nodes() -> impl Iterator<Item = &'static NodeEntry> {
    NODES.iter()
}

pub(super) fn find(kind: &str) -> Option<&'static NodeEntry> {
    NODES.iter().find(|entry| entry.kind == kind)
}

/// A node type that is not known: grey, reported.
pub(super) fn unknown(l: &mut Lowering, at: At, socket: &str) -> Value {
    let kind = l.source(at).kind.clone();
    match socket {
        "SHADER" => {
            l.substitute(at, &kind, "a grey diffuse closure");
            let grey = l.graph.f3([0.8; 3]);
            let params = vec![l.graph.f1(0.0), l.default_normal()];
            let span = l.graph.span();
            let kind = crate::closure::ClosureKind::Diffuse;
            Value::Shader(l.closures.leaf(&l.graph, kind, grey, params, span))
        }
        "RGBA" => {
            l.substitute(at, &kind, "a constant grey");
            Value::Color(l.graph.f3([0.5; 3]))
        }
        "VECTOR" => {
            l.substitute(at, &kind, "a vector of zeros");
            l.zero("VECTOR")
        }
        _ => {
            l.substitute(at, &kind, "the number 0.5");
            Value::Float(l.graph.f1(0.5))
        }
    }
}

macro_rules! nodes {
    ($($kind:literal in $menu:literal: $lower:path $(, $limits:literal)?;)*) => {
        const NODES: &[NodeEntry] = &[$(NodeEntry {
            kind: $kind,
            menu: $menu,
            limits: concat!($($limits)?),
            lower: $lower,
        }),*];
    };
}

nodes! {
    "ShaderNodeAttribute" in "Input": coordinates::attribute, "attributes of the geometry only";
    "ShaderNodeCameraData" in "Input": coordinates::camera_data;
    "ShaderNodeFresnel" in "Input": surface::fresnel;
    "ShaderNodeLayerWeight" in "Input": surface::layer_weight;
    "ShaderNodeLightPath" in "Input": coordinates::light_path, "no volume rays";
    "ShaderNodeNewGeometry" in "Input": coordinates::geometry;
    "ShaderNodeObjectInfo" in "Input": coordinates::object_info;
    "ShaderNodeRGB" in "Input": color::rgb;
    "ShaderNodeTangent" in "Input": coordinates::tangent;
    "ShaderNodeTexCoord" in "Input": coordinates::texture_coordinates, "Normal is the world's";
    "ShaderNodeUVMap" in "Input": coordinates::uv_map;
    "ShaderNodeValue" in "Input": number::value;
    "ShaderNodeVertexColor" in "Input": coordinates::vertex_color;
    "ShaderNodeAddShader" in "Shader": shader::add_shader;
    "ShaderNodeBackground" in "Shader": shader::background;
    "ShaderNodeBsdfAnisotropic" in "Shader": shader::glossy;
    "ShaderNodeBsdfDiffuse" in "Shader": shader::diffuse;
    "ShaderNodeBsdfGlass" in "Shader": shader::glass, "no thin film";
    "ShaderNodeBsdfGlossy" in "Shader": shader::glossy;
    "ShaderNodeBsdfHair" in "Shader": shader::as_diffuse, "diffuse instead";
    "ShaderNodeBsdfHairPrincipled" in "Shader": shader::as_diffuse, "diffuse instead";
    "ShaderNodeBsdfMetallic" in "Shader": shader::metallic, "glossy of the base colour instead";
    "ShaderNodeBsdfPrincipled" in "Shader": shader::principled, "subsurface is diffuse, no thin film";
    "ShaderNodeBsdfRefraction" in "Shader": shader::refraction;
    "ShaderNodeBsdfSheen" in "Shader": shader::sheen;
    "ShaderNodeBsdfToon" in "Shader": shader::as_diffuse, "diffuse instead";
    "ShaderNodeBsdfTranslucent" in "Shader": shader::translucent;
    "ShaderNodeBsdfTransparent" in "Shader": shader::transparent;
    "ShaderNodeBsdfVelvet" in "Shader": shader::velvet;
    "ShaderNodeEmission" in "Shader": shader::emission;
    "ShaderNodeHoldout" in "Shader": shader::holdout;
    "ShaderNodeMixShader" in "Shader": shader::mix_shader;
    "ShaderNodeSubsurfaceScattering" in "Shader": shader::subsurface, "diffuse instead";
    "ShaderNodeVolumeAbsorption" in "Shader": shader::volume, "nothing instead";
    "ShaderNodeVolumeCoefficients" in "Shader": shader::volume, "nothing instead";
    "ShaderNodeVolumePrincipled" in "Shader": shader::volume, "nothing instead";
    "ShaderNodeVolumeScatter" in "Shader": shader::volume, "nothing instead";
    "ShaderNodeTexBrick" in "Texture": pattern::brick;
    "ShaderNodeTexChecker" in "Texture": pattern::checker;
    "ShaderNodeTexEnvironment" in "Texture": image::environment;
    "ShaderNodeTexGradient" in "Texture": pattern::gradient;
    "ShaderNodeTexImage" in "Texture": image::image, "Box uses the normal in the world's space";
    "ShaderNodeTexMagic" in "Texture": pattern::magic;
    "ShaderNodeTexNoise" in "Texture": noise::noise;
    "ShaderNodeTexVoronoi" in "Texture": cellular::voronoi;
    "ShaderNodeTexWave" in "Texture": pattern::wave;
    "ShaderNodeTexWhiteNoise" in "Texture": noise::white_noise;
    "ShaderNodeBrightContrast" in "Color": color::bright_contrast;
    "ShaderNodeGamma" in "Color": color::gamma;
    "ShaderNodeHueSaturation" in "Color": color::hue_saturation;
    "ShaderNodeInvert" in "Color": color::invert;
    "ShaderNodeLightFalloff" in "Color": number::light_falloff;
    "ShaderNodeMix" in "Color": color::mix, "no rotations";
    "ShaderNodeMixRGB" in "Color": color::mix_rgb;
    "ShaderNodeRGBCurve" in "Color": ramp::rgb_curves;
    "ShaderNodeBump" in "Vector": bump::bump;
    "ShaderNodeDisplacement" in "Vector": bump::displacement, "as bump";
    "ShaderNodeMapping" in "Vector": mapping::mapping;
    "ShaderNodeNormal" in "Vector": vector::normal;
    "ShaderNodeNormalMap" in "Vector": surface::normal_map, "object space is the world's";
    "ShaderNodeVectorCurve" in "Vector": ramp::vector_curves;
    "ShaderNodeVectorDisplacement" in "Vector": bump::vector_displacement, "along the normal, as bump";
    "ShaderNodeVectorRotate" in "Vector": mapping::rotate;
    "ShaderNodeVectorTransform" in "Vector": mapping::transform, "no change of space";
    "ShaderNodeBlackbody" in "Converter": spectrum::blackbody;
    "ShaderNodeClamp" in "Converter": number::clamp;
    "ShaderNodeCombineColor" in "Converter": color::combine_color;
    "ShaderNodeCombineHSV" in "Converter": color::combine_hsv;
    "ShaderNodeCombineRGB" in "Converter": color::combine_rgb;
    "ShaderNodeCombineXYZ" in "Converter": vector::combine;
    "ShaderNodeFloatCurve" in "Converter": ramp::float_curve;
    "ShaderNodeMapRange" in "Converter": number::map_range;
    "ShaderNodeMath" in "Converter": number::math;
    "ShaderNodeRGBToBW" in "Converter": color::luminance;
    "ShaderNodeSeparateColor" in "Converter": color::separate_color;
    "ShaderNodeSeparateHSV" in "Converter": color::separate_hsv;
    "ShaderNodeSeparateRGB" in "Converter": color::separate_rgb;
    "ShaderNodeSeparateXYZ" in "Converter": vector::separate;
    "ShaderNodeValToRGB" in "Converter": ramp::color_ramp;
    "ShaderNodeVectorMath" in "Converter": vector::vector_math;
    "ShaderNodeWavelength" in "Converter": spectrum::wavelength;
}
