//! Bump, normal maps and glTF materials: normals and closures at points whose geometry
//! is known.

mod support;

use glam::{Vec2, Vec3, Vec4};
use matcha_shade::closure::ClosureKind;
use matcha_shade::compile::{Options, compile};
use matcha_shade::input::{InputKind, Part};
use matcha_shade::material::{MaterialGraph, MaterialKind};
use matcha_shade::nodes::{self, Names};
use matcha_shade::rows::Rows;
use matcha_shade::source::{
    Extension, GltfAlpha, GltfMaterial, GltfTexture, Link, NodeTree, Property, Socket, SourceNode,
};
use matcha_shade::vm::Machine;
use std::collections::BTreeMap;
use support::Formulas;

/// A rectangle in the plane z = 0, seen from above: x = 2u, y = v/2, and footprints of
/// a thousandth.
fn geometry(kind: InputKind, part: Part, moved: Vec2) -> Vec<f32> {
    let (u, v, step) = (0.3f32, 0.7f32, 1e-3f32);
    let v3 = |p: Vec3| vec![p.x, p.y, p.z];
    let by_part = |value: Vec3, a: Vec3, b: Vec3| match part {
        Part::Value => value,
        Part::AxisA => a,
        Part::AxisB => b,
    };
    match kind {
        InputKind::Uv(_) => {
            // The footprint's axes are turned by 30 degrees against the UV axes.
            let (s, c) = (0.5f32, 0.75f32.sqrt());
            let axes = [
                Vec2::new(c * step / 2.0, s * step * 2.0),
                Vec2::new(-s * step / 2.0, c * step * 2.0),
            ];
            let p = by_part(
                Vec3::new(u, v, 0.0),
                axes[0].extend(0.0),
                axes[1].extend(0.0),
            );
            vec![p.x, p.y]
        }
        InputKind::Position | InputKind::Generated | InputKind::Object => {
            let (s, c) = (0.5f32, 0.75f32.sqrt());
            let scale = if kind == InputKind::Object { 0.5 } else { 1.0 };
            let place = Vec3::new(2.0 * u, 0.5 * v, 0.0) + moved.extend(0.0);
            let a = Vec3::new(c, s, 0.0) * step;
            let b = Vec3::new(-s, c, 0.0) * step;
            v3(by_part(place, a, b) * scale)
        }
        InputKind::Normal | InputKind::TrueNormal | InputKind::Incoming => {
            v3(by_part(Vec3::Z, Vec3::ZERO, Vec3::ZERO))
        }
        InputKind::DpDu(_) => vec![2.0, 0.0, 0.0],
        InputKind::DpDv(_) => vec![0.0, 0.5, 0.0],
        InputKind::Tangent(_) => vec![1.0, 0.0, 0.0],
        InputKind::TangentSign(_) => vec![1.0],
        InputKind::Attribute(_) => vec![0.5, 0.25, 1.0, 0.8],
        _ => vec![0.0; kind.width()],
    }
}

/// The first closure's named parameter (or its weight).
fn evaluate(material: &MaterialGraph, cache: bool, parameter: &str) -> Vec<f32> {
    evaluate_at(material, cache, parameter, Vec2::ZERO)
}

/// The same, beside the usual place.
fn evaluate_at(material: &MaterialGraph, cache: bool, parameter: &str, moved: Vec2) -> Vec<f32> {
    let options = Options {
        cache,
        ..Options::default()
    };
    let program = compile(material, &options).expect("it compiles").program;
    let mut inputs = Rows::new(program.input_rows().max(1), 1);
    for (input, row) in &program.inputs {
        for (i, x) in geometry(input.kind, input.part, moved)
            .into_iter()
            .enumerate()
        {
            inputs.set(row + i, 0, x);
        }
    }
    let mut out = Rows::default();
    Machine::new(None).run(&program, 1, &inputs, &[], &Formulas, None, &mut out);
    let closure = &program.closures[0];
    let rows = if parameter == "weight" {
        closure.first_row..closure.first_row + 3
    } else {
        program.parameter_rows(closure, parameter)
    };
    rows.map(|row| out.get(row, 0)).collect()
}

#[track_caller]
fn close(got: &[f32], expected: &[f32], error: f32) {
    let near = got
        .iter()
        .zip(expected)
        .all(|(g, e)| (g - e).abs() <= error);
    assert!(
        near && got.len() == expected.len(),
        "{got:?} instead of {expected:?}"
    );
}

fn socket(identifier: &str, kind: &str, value: &[f32]) -> Socket {
    Socket {
        identifier: identifier.into(),
        name: identifier.into(),
        kind: kind.into(),
        value: value.to_vec(),
        hide_value: false,
        enabled: true,
    }
}

fn node(kind: &str, inputs: Vec<Socket>, outputs: Vec<Socket>) -> SourceNode {
    SourceNode {
        name: kind.into(),
        kind: kind.into(),
        props: BTreeMap::new(),
        inputs,
        outputs,
        muted: false,
        internal_links: vec![],
        tree: None,
        image: None,
        ramp: None,
        curves: None,
        texture_mapping: None,
        object_from_world: None,
    }
}

/// A diffuse closure whose normal is a bump of 0.3 x + 0.1 y of a coordinate.
fn bumped(coordinate: &str, strength: f32, distance: f32, invert: bool) -> MaterialGraph {
    let coordinates = node(
        "ShaderNodeTexCoord",
        vec![],
        vec![socket(coordinate, "VECTOR", &[])],
    );
    let inputs = vec![
        socket("Vector", "VECTOR", &[0.0; 3]),
        socket("Vector_001", "VECTOR", &[0.3, 0.1, 0.0]),
    ];
    let mut dot = node(
        "ShaderNodeVectorMath",
        inputs,
        vec![socket("Value", "VALUE", &[])],
    );
    dot.props
        .insert("operation".into(), Property::Text("DOT_PRODUCT".into()));
    let inputs = vec![
        socket("Strength", "VALUE", &[strength]),
        socket("Distance", "VALUE", &[distance]),
        socket("Filter Width", "VALUE", &[0.1]),
        socket("Height", "VALUE", &[1.0]),
        socket("Normal", "VECTOR", &[0.0; 3]),
    ];
    let mut bump = node(
        "ShaderNodeBump",
        inputs,
        vec![socket("Normal", "VECTOR", &[])],
    );
    bump.props.insert("invert".into(), Property::Bool(invert));
    with_normal(
        vec![coordinates, dot, bump],
        &[([0, 0], [1, 0]), ([1, 0], [2, 3])],
    )
}

/// The last node's output as the normal of a diffuse closure.
fn with_normal(mut nodes: Vec<SourceNode>, links: &[([u32; 2], [u32; 2])]) -> MaterialGraph {
    let inputs = vec![
        socket("Color", "RGBA", &[1.0; 4]),
        socket("Roughness", "VALUE", &[0.0]),
        socket("Normal", "VECTOR", &[0.0; 3]),
    ];
    let last = nodes.len() as u32;
    nodes.push(node(
        "ShaderNodeBsdfDiffuse",
        inputs,
        vec![socket("BSDF", "SHADER", &[])],
    ));
    nodes.push(node(
        "ShaderNodeOutputMaterial",
        vec![socket("Surface", "SHADER", &[])],
        vec![],
    ));
    let mut links: Vec<Link> = links.iter().map(|&(from, to)| Link { from, to }).collect();
    links.push(Link {
        from: [last - 1, 0],
        to: [last, 2],
    });
    links.push(Link {
        from: [last, 0],
        to: [last + 1, 0],
    });
    let tree = NodeTree {
        name: "tree".into(),
        nodes,
        links,
    };
    let names = Names {
        uv: &[String::new()],
        attributes: &[],
    };
    let lowered = nodes::lower(&[tree], 0, names, "Oak", MaterialKind::Surface);
    lowered.expect("it lowers").0
}

fn tilted(slope_x: f32, slope_y: f32) -> [f32; 3] {
    Vec3::new(-slope_x, -slope_y, 1.0).normalize().into()
}

#[test]
fn bump_leans_away_from_where_the_height_rises() {
    // u rises by 1 over 2 of x, v by 1 over a half of y.
    let normal = evaluate(&bumped("UV", 1.0, 1.0, false), false, "normal");
    close(&normal, &tilted(0.15, 0.2), 1e-3);
    let normal = evaluate(&bumped("Generated", 1.0, 1.0, false), false, "normal");
    close(&normal, &tilted(0.3, 0.1), 1e-3);
}

#[test]
fn bump_honours_strength_distance_and_inversion() {
    let normal = evaluate(&bumped("UV", 1.0, 0.5, true), false, "normal");
    close(&normal, &tilted(-0.075, -0.1), 1e-3);
    let normal = evaluate(&bumped("UV", 0.5, 1.0, false), false, "normal");
    let half = (Vec3::from(tilted(0.15, 0.2)) + Vec3::Z).normalize();
    close(&normal, &half.to_array(), 1e-3);
    let normal = evaluate(&bumped("UV", 0.0, 1.0, false), false, "normal");
    close(&normal, &[0.0, 0.0, 1.0], 1e-6);
}

#[test]
fn a_cached_gradient_gives_the_same_normal() {
    let material = bumped("UV", 1.0, 1.0, false);
    let mut options = Options::default();
    options.cost.lookup_ns = 0.0;
    let compiled = compile(&material, &options).expect("it compiles");
    assert_eq!(compiled.cached.len(), 1, "the gradient");
    let normal = evaluate(&material, true, "normal");
    close(&normal, &tilted(0.15, 0.2), 1e-3);
}

fn normal_mapped(color: [f32; 3], strength: f32) -> MaterialGraph {
    let inputs = vec![
        socket("Strength", "VALUE", &[strength]),
        socket("Color", "RGBA", &[color[0], color[1], color[2], 1.0]),
    ];
    let mut map = node(
        "ShaderNodeNormalMap",
        inputs,
        vec![socket("Normal", "VECTOR", &[])],
    );
    map.props
        .insert("space".into(), Property::Text("TANGENT".into()));
    with_normal(vec![map], &[])
}

#[test]
fn normal_maps_are_in_the_frame_of_tangent_bitangent_and_normal() {
    let at = |color, strength| evaluate(&normal_mapped(color, strength), false, "normal");
    close(&at([0.5, 0.5, 1.0], 1.0), &[0.0, 0.0, 1.0], 1e-6);
    let expected = Vec3::new(0.6, 0.0, 0.8);
    close(&at([0.8, 0.5, 0.9], 1.0), &expected.to_array(), 1e-5);
    let expected = Vec3::new(0.0, 0.6, 0.8);
    close(&at([0.5, 0.8, 0.9], 1.0), &expected.to_array(), 1e-5);
    let expected = Vec3::new(0.3, 0.0, 0.9).normalize();
    close(&at([0.8, 0.5, 0.9], 0.5), &expected.to_array(), 1e-5);
}

fn plain_gltf() -> GltfMaterial {
    GltfMaterial {
        base_color: Vec4::new(0.8, 0.6, 0.4, 0.5),
        base_color_texture: None,
        metallic: 0.25,
        roughness: 0.7,
        metallic_roughness_texture: None,
        normal_texture: None,
        emission: Vec3::new(1.0, 2.0, 3.0),
        emission_texture: None,
        alpha: GltfAlpha::Opaque,
        ior: 1.45,
        transmission: 0.1,
        specular: (1.0, Vec3::ONE),
        vertex_color: None,
    }
}

fn texture(transform: (Vec2, f32, Vec2)) -> GltfTexture {
    GltfTexture {
        image: 0,
        uv: 0,
        transform,
        extension: Extension::Repeat,
    }
}

#[test]
fn gltf_factors_are_principled_parameters() {
    let material = nodes::lower_gltf("Oak", &plain_gltf());
    let at = |name| evaluate(&material, false, name);
    close(&at("weight"), &[1.0; 3], 0.0);
    close(&at("base_color"), &[0.8, 0.6, 0.4], 0.0);
    close(&at("alpha"), &[1.0], 0.0);
    close(&at("metallic"), &[0.25], 0.0);
    close(&at("roughness"), &[0.7], 0.0);
    close(&at("ior"), &[1.45], 0.0);
    close(&at("transmission_weight"), &[0.1], 0.0);
    close(&at("specular_ior_level"), &[0.5], 0.0);
    close(&at("emission_color"), &[1.0, 2.0, 3.0], 0.0);
    close(&at("emission_strength"), &[1.0], 0.0);
}

#[test]
fn gltf_alpha_blends_or_cuts() {
    let alpha = |alpha| {
        let source = GltfMaterial {
            alpha,
            ..plain_gltf()
        };
        evaluate(&nodes::lower_gltf("Oak", &source), false, "alpha")
    };
    close(&alpha(GltfAlpha::Blend), &[0.5], 0.0);
    close(&alpha(GltfAlpha::Mask(0.5)), &[1.0], 0.0);
    close(&alpha(GltfAlpha::Mask(0.51)), &[0.0], 0.0);
}

#[test]
fn gltf_textures_multiply_and_take_their_channels() {
    // The test's image 0 is (u v, (u − v)/2, 1/(1 + u²)) at (u, v).
    let (u, v) = (0.3f32, 0.7f32);
    let pixel = [u * v, (u - v) * 0.5, 1.0 / (1.0 + u * u)];
    let identity = (Vec2::ZERO, 0.0, Vec2::ONE);
    let source = GltfMaterial {
        base_color_texture: Some(texture(identity)),
        metallic_roughness_texture: Some(texture(identity)),
        emission_texture: Some(texture(identity)),
        vertex_color: Some(0),
        ..plain_gltf()
    };
    let material = nodes::lower_gltf("Oak", &source);
    let at = |name| evaluate(&material, false, name);
    let vertex = [0.5, 0.25, 1.0];
    let base = [0, 1, 2].map(|i| [0.8, 0.6, 0.4][i] * pixel[i] * vertex[i]);
    close(&at("base_color"), &base, 1e-6);
    close(&at("metallic"), &[0.25 * pixel[2]], 1e-6);
    close(&at("roughness"), &[0.7 * pixel[1]], 1e-6);
    let emission = [0, 1, 2].map(|i| [1.0, 2.0, 3.0][i] * pixel[i]);
    close(&at("emission_color"), &emission, 1e-6);
}

#[test]
fn gltf_texture_transforms_turn_in_the_files_orientation() {
    let (offset, angle, scale) = (Vec2::new(0.1, -0.2), 0.4f32, Vec2::new(2.0, 0.5));
    let source = GltfMaterial {
        base_color_texture: Some(texture((offset, angle, scale))),
        base_color: Vec4::ONE,
        ..plain_gltf()
    };
    // KHR_texture_transform: translation · rotation · scale, in coordinates with v down.
    let down = Vec2::new(0.3, 1.0 - 0.7) * scale;
    let (s, c) = angle.sin_cos();
    let turned = Vec2::new(c * down.x + s * down.y, -s * down.x + c * down.y) + offset;
    let (u, v) = (turned.x, 1.0 - turned.y);
    let expected = [u * v, (u - v) * 0.5, 1.0 / (1.0 + u * u)];
    let material = nodes::lower_gltf("Oak", &source);
    close(&evaluate(&material, false, "base_color"), &expected, 1e-5);
    let program = compile(&material, &Options::default())
        .expect("it compiles")
        .program;
    assert!(matches!(
        program.closures[0].kind,
        ClosureKind::Principled(_)
    ));
}

/// A Voronoi texture's distance, read at 7 times the Generated coordinates.
fn cells(feature: &str, dims: &str) -> Vec<SourceNode> {
    let outputs = vec![socket("Generated", "VECTOR", &[])];
    let coordinates = node("ShaderNodeTexCoord", vec![], outputs);
    let inputs = vec![
        socket("Vector", "VECTOR", &[0.0; 3]),
        socket("W", "VALUE", &[0.3]),
        socket("Scale", "VALUE", &[7.0]),
    ];
    let mut voronoi = node(
        "ShaderNodeTexVoronoi",
        inputs,
        vec![socket("Distance", "VALUE", &[])],
    );
    for (name, value) in [("feature", feature), ("voronoi_dimensions", dims)] {
        voronoi
            .props
            .insert(name.into(), Property::Text(value.into()));
    }
    vec![coordinates, voronoi]
}

#[test]
fn a_bump_of_cells_has_the_slope_of_the_piece_that_is_hit() {
    for feature in ["F1", "DISTANCE_TO_EDGE"] {
        for dims in ["2D", "3D", "4D"] {
            let mut nodes = cells(feature, dims);
            let inputs = vec![
                socket("Strength", "VALUE", &[1.0]),
                socket("Distance", "VALUE", &[1.0]),
                socket("Filter Width", "VALUE", &[0.1]),
                socket("Height", "VALUE", &[1.0]),
                socket("Normal", "VECTOR", &[0.0; 3]),
            ];
            nodes.push(node(
                "ShaderNodeBump",
                inputs,
                vec![socket("Normal", "VECTOR", &[])],
            ));
            let bump = with_normal(nodes, &[([0, 0], [1, 0]), ([1, 0], [2, 3])]);
            let searches = |name: &str| {
                let options = Options {
                    cache: false,
                    ..Options::default()
                };
                let program = compile(&bump, &options).expect("it compiles").program;
                let words = program.words().iter();
                words
                    .filter(|w| {
                        w.operation()
                            .is_some_and(|op| op.info().name.starts_with(name))
                    })
                    .count()
            };
            assert_eq!(searches("voronoi_f1"), 1, "one search for three heights");
            // The heights themselves, each searched for: the distance as a normal's parts.
            let heights = with_normal(cells(feature, dims), &[([0, 0], [1, 0])]);
            let height = |moved| evaluate_at(&heights, false, "normal", moved)[0];
            let step = 2e-4;
            let slope = [Vec2::X, Vec2::Y]
                .map(|axis| (height(axis * step) - height(-axis * step)) / (2.0 * step));
            let normal = evaluate(&bump, false, "normal");
            close(&normal, &tilted(slope[0], slope[1]), 2e-3);
        }
    }
}
