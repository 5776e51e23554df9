//! Where textures are read, and what the shading point knows of itself.

use super::mapping::matrix_point;
use super::{At, Lowered, Lowering, Value};
use crate::closure::Ty;
use crate::graph::NodeId;
use crate::input::InputKind;
use crate::material::MaterialKind;
use crate::ops::OpCode;

/// A texture node's coordinate: the linked one or the node type's default, through the
/// matrix of old files.
pub(super) fn texture_coordinate(l: &mut Lowering, at: At) -> Lowered<NodeId> {
    let p = default_coordinate(l, at)?;
    Ok(match &l.source(at).texture_mapping {
        Some(matrix) => matrix_point(l, p, matrix),
        None => p,
    })
}

fn default_coordinate(l: &mut Lowering, at: At) -> Lowered<NodeId> {
    if l.is_linked(at, "Vector") {
        return l.f3(at, "Vector");
    }
    Ok(match l.source(at).kind.as_str() {
        "ShaderNodeTexImage" => uv(l, 0),
        "ShaderNodeTexEnvironment" => l.graph.value(InputKind::Position),
        _ => generated(l),
    })
}

/// Generated coordinates; the direction in a world.
pub(super) fn generated(l: &mut Lowering) -> NodeId {
    let kind = if l.kind == MaterialKind::World {
        InputKind::Position
    } else {
        InputKind::Generated
    };
    l.graph.value(kind)
}

/// A UV set as a vector.
pub(super) fn uv(l: &mut Lowering, set: u16) -> NodeId {
    let uv = l.graph.value(InputKind::Uv(set));
    let zero = l.graph.f1(0.0);
    l.graph.combine(&[uv, zero])
}

/// Index of a UV map by name; the active one, with a note, where there is none.
pub(super) fn uv_set(l: &mut Lowering, at: At, name: &str) -> u16 {
    if name.is_empty() {
        return 0;
    }
    match l.names.uv.iter().position(|n| n == name) {
        Some(set) => set as u16,
        None => {
            l.substitute(
                at,
                &format!("the missing UV map \"{name}\""),
                "the active UV map",
            );
            0
        }
    }
}

/// True in a light, of which no surface can be asked: what its tree reads of one is zero, and
/// this is said.
fn is_without_surface(l: &mut Lowering, at: At, output: &str) -> bool {
    let is_light = l.kind == MaterialKind::Light;
    if is_light {
        let what = format!("the output {output} of {} in a light", l.source(at).kind);
        l.substitute(at, &what, "zero");
    }
    is_light
}

/// `ShaderNodeTexCoord`.
pub(super) fn texture_coordinates(l: &mut Lowering, at: At, output: &str) -> Lowered<Value> {
    let is_world = l.kind == MaterialKind::World;
    if matches!(output, "UV" | "Object") && is_without_surface(l, at, output) {
        return Ok(l.zero("VECTOR"));
    }
    let vector = match output {
        "Generated" => generated(l),
        "UV" => uv(l, 0),
        "Normal" => {
            l.substitute(
                at,
                "the output Normal of ShaderNodeTexCoord",
                "the normal in the world's space",
            );
            l.default_normal()
        }
        "Object" => match (&l.source(at).object_from_world, is_world) {
            (Some(matrix), _) => {
                let p = l.graph.value(InputKind::Position);
                matrix_point(l, p, matrix)
            }
            (None, true) => l.graph.value(InputKind::Position),
            (None, false) => l.graph.value(InputKind::Object),
        },
        "Camera" => l.graph.value(InputKind::Camera),
        "Window" => l.graph.value(InputKind::Window),
        "Reflection" => reflection(l),
        _ => return Err(l.bad_output(at, output)),
    };
    Ok(Value::Vector(vector))
}

fn reflection(l: &mut Lowering) -> NodeId {
    let incoming = l.graph.value(InputKind::Incoming);
    if l.kind == MaterialKind::World {
        return incoming;
    }
    let normal = l.default_normal();
    let minus = l.graph.f1(-1.0);
    let away = l.op(OpCode::vector_scale, &[incoming, minus]);
    l.op(OpCode::vector_reflect, &[away, normal])
}

/// `ShaderNodeUVMap`.
pub(super) fn uv_map(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    let name = l.text(at, "uv_map", "");
    if !name.is_empty() && !l.names.uv.contains(&name) {
        // What Cycles gives for a UV map that no mesh has.
        l.substitute(at, &format!("the missing UV map \"{name}\""), "zero");
        return Ok(l.zero("VECTOR"));
    }
    let set = uv_set(l, at, &name);
    Ok(Value::Vector(uv(l, set)))
}

/// `ShaderNodeAttribute`.
pub(super) fn attribute(l: &mut Lowering, at: At, output: &str) -> Lowered<Value> {
    let name = l.text(at, "attribute_name", "");
    let kind = l.text(at, "attribute_type", "GEOMETRY");
    if kind != "GEOMETRY" {
        let what = format!("an attribute of type {kind}");
        l.substitute(at, &what, "zero");
        return Ok(l.zero(if output == "Color" { "RGBA" } else { "VECTOR" }));
    }
    Ok(attribute_value(l, at, &name, output))
}

/// `ShaderNodeVertexColor`.
pub(super) fn vertex_color(l: &mut Lowering, at: At, output: &str) -> Lowered<Value> {
    let name = l.text(at, "layer_name", "");
    Ok(attribute_value(l, at, &name, output))
}

fn attribute_value(l: &mut Lowering, at: At, name: &str, output: &str) -> Value {
    let four = match l.names.attributes.iter().position(|n| n == name) {
        Some(index) => l.graph.value(InputKind::Attribute(index as u16)),
        None => match l
            .names
            .uv
            .iter()
            .position(|n| n == name && !name.is_empty())
        {
            Some(set) => {
                let uv = l.graph.value(InputKind::Uv(set as u16));
                let (zero, one) = (l.graph.f1(0.0), l.graph.f1(1.0));
                l.graph.combine(&[uv, zero, one])
            }
            None => {
                // What Cycles gives for an attribute that no mesh has.
                l.substitute(at, &format!("the missing attribute \"{name}\""), "zero");
                l.graph.constant(Ty::F4, [0.0; 4])
            }
        },
    };
    let triple = l.graph.extract(four, 0, Ty::F3);
    match output {
        "Alpha" => Value::Float(l.graph.component(four, 3)),
        "Fac" => Value::Float(l.op(OpCode::vector_average, &[triple])),
        "Vector" => Value::Vector(triple),
        _ => Value::Color(triple),
    }
}

/// `ShaderNodeObjectInfo`.
pub(super) fn object_info(l: &mut Lowering, at: At, output: &str) -> Lowered<Value> {
    if is_without_surface(l, at, output) {
        let is_vector = matches!(output, "Location" | "Color");
        return Ok(l.zero(if is_vector { "VECTOR" } else { "VALUE" }));
    }
    Ok(match output {
        "Location" => Value::Vector(l.graph.value(InputKind::ObjectLocation)),
        "Color" => Value::Color(l.graph.value(InputKind::ObjectColor)),
        "Alpha" => Value::Float(l.graph.value(InputKind::ObjectAlpha)),
        "Object Index" => Value::Float(l.graph.value(InputKind::ObjectIndex)),
        "Material Index" => Value::Float(l.graph.value(InputKind::MaterialIndex)),
        "Random" => Value::Float(l.graph.value(InputKind::ObjectRandom)),
        _ => return Err(l.bad_output(at, output)),
    })
}

/// `ShaderNodeNewGeometry`.
pub(super) fn geometry(l: &mut Lowering, at: At, output: &str) -> Lowered<Value> {
    let vector = match output {
        "Position" => l.graph.value(InputKind::Position),
        "Normal" => l.default_normal(),
        "True Normal" => l.graph.value(InputKind::TrueNormal),
        "Incoming" => l.graph.value(InputKind::Incoming),
        "Tangent" => radial_tangent(l, 2),
        "Parametric" if is_without_surface(l, at, output) => l.graph.f3([0.0; 3]),
        "Parametric" => {
            let uv = l.graph.value(InputKind::Parametric);
            let zero = l.graph.f1(0.0);
            l.graph.combine(&[uv, zero])
        }
        "Backfacing" => return Ok(Value::Float(l.graph.value(InputKind::Backfacing))),
        "Pointiness" => return Ok(Value::Float(l.graph.value(InputKind::Pointiness))),
        "Random Per Island" => {
            return Ok(Value::Float(l.graph.value(InputKind::RandomPerIsland)));
        }
        _ => return Err(l.bad_output(at, output)),
    };
    Ok(Value::Vector(vector))
}

/// The tangent about an axis of the generated box (0 to 2).
pub(super) fn radial_tangent(l: &mut Lowering, axis: u32) -> NodeId {
    let p = generated(l);
    let normal = l.default_normal();
    l.graph
        .apply_aux(OpCode::tangent_radial, axis, &[p, normal])
}

/// `ShaderNodeTangent`.
pub(super) fn tangent(l: &mut Lowering, at: At, _output: &str) -> Lowered<Value> {
    if l.text(at, "direction_type", "RADIAL") == "UV_MAP" {
        let name = l.text(at, "uv_map", "");
        let set = uv_set(l, at, &name);
        return Ok(Value::Vector(l.graph.value(InputKind::Tangent(set))));
    }
    let axis = match l.text(at, "axis", "Z").as_str() {
        "X" => 0,
        "Y" => 1,
        "Z" => 2,
        _ => return Err(l.bad_property(at, "axis")),
    };
    Ok(Value::Vector(radial_tangent(l, axis)))
}

/// `ShaderNodeLightPath`.
pub(super) fn light_path(l: &mut Lowering, at: At, output: &str) -> Lowered<Value> {
    let kind = match output {
        "Is Camera Ray" => InputKind::IsCameraRay,
        "Is Shadow Ray" => InputKind::IsShadowRay,
        "Is Diffuse Ray" => InputKind::IsDiffuseRay,
        "Is Glossy Ray" => InputKind::IsGlossyRay,
        "Is Singular Ray" => InputKind::IsSingularRay,
        "Is Reflection Ray" => InputKind::IsReflectionRay,
        "Is Transmission Ray" => InputKind::IsTransmissionRay,
        "Ray Length" => InputKind::RayLength,
        "Ray Depth" => InputKind::RayDepth,
        "Diffuse Depth" => InputKind::DiffuseDepth,
        "Glossy Depth" => InputKind::GlossyDepth,
        "Transparent Depth" => InputKind::TransparentDepth,
        "Transmission Depth" => InputKind::TransmissionDepth,
        _ => {
            // Volumes are not rendered, so that no ray is theirs.
            l.substitute(
                at,
                &format!("the output {output} of ShaderNodeLightPath"),
                "zero",
            );
            return Ok(l.zero("VALUE"));
        }
    };
    Ok(Value::Float(l.graph.value(kind)))
}

/// `ShaderNodeCameraData`.
pub(super) fn camera_data(l: &mut Lowering, at: At, output: &str) -> Lowered<Value> {
    let p = l.graph.value(InputKind::Camera);
    Ok(match output {
        "View Vector" => Value::Vector(l.op(OpCode::vector_normalize, &[p])),
        "View Z Depth" => Value::Float(l.graph.component(p, 2)),
        "View Distance" => Value::Float(l.op(OpCode::vector_length, &[p])),
        _ => return Err(l.bad_output(at, output)),
    })
}
