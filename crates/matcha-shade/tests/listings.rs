//! Golden listings: what a small material becomes.

mod support;

use matcha_shade::closure::ClosureKind;
use matcha_shade::compile::{CostModel, Options, compile};
use matcha_shade::graph::{AlphaHandling, Encoding, Interpolation, Span, Table, TextureRef};
use matcha_shade::input::{InputKind, Part};
use matcha_shade::material::MaterialGraph;
use matcha_shade::ops::OpCode;
use matcha_shade::source::Extension;
use matcha_shade::vm::Isa;

/// An image through a ramp, and the image's alpha, over a diffuse closure; a position
/// tints the result.
fn material() -> MaterialGraph {
    let mut m = MaterialGraph {
        name: "tile".to_owned(),
        ..MaterialGraph::default()
    };
    let g = &mut m.graph;
    let [uv, a, b] =
        [Part::Value, Part::AxisA, Part::AxisB].map(|part| g.input(InputKind::Uv(0), part));
    let texture = TextureRef {
        image: 3,
        interpolation: Interpolation::Linear,
        extension: Extension::Repeat,
        alpha: AlphaHandling::Associated,
        no_footprint: false,
    };
    let image = g.texture(texture, uv, a, b);
    let red = g.component(image, 0);
    let alpha = g.component(image, 3);
    let table = g.table(Table {
        rows: vec![vec![0.0, 1.0], vec![0.5, 0.5], vec![1.0, 0.0]],
        interpolate: true,
        extrapolate: false,
    });
    let ramp = g.look_up(table, red);
    let ramp = g.means(ramp, Encoding::Color);
    let position = g.value(InputKind::Position);
    let one = g.f1(1.0);
    let unchanged = g.apply(OpCode::vector_scale, &[ramp, one]);
    let color = g.apply(OpCode::vector_multiply, &[unchanged, position]);
    let normal = g.value(InputKind::Normal);
    let rough = g.apply(OpCode::math_multiply, &[alpha, one]);
    let params = vec![rough, normal];
    let leaf = m.closures.leaf(
        &m.graph,
        ClosureKind::Diffuse,
        color,
        params,
        Span::default(),
    );
    let clear = m.graph.f3([1.0; 3]);
    let clear = m.closures.leaf(
        &m.graph,
        ClosureKind::Transparent,
        clear,
        vec![],
        Span::default(),
    );
    let fac = m.graph.f1(0.25);
    m.closures.root = Some(m.closures.mix(&m.graph, fac, leaf, clear));
    m
}

fn options(cache: bool) -> Options {
    let cost = CostModel {
        lookup_ns: 0.0,
        ..CostModel::of(Isa::Avx512)
    };
    Options {
        cache,
        cost,
        ..Options::default()
    }
}

#[test]
fn a_program_with_regions() {
    let compiled = compile(&material(), &options(true)).expect("compiles");
    insta::assert_snapshot!(compiled.program.to_string());
}

#[test]
fn a_program_without_regions() {
    let compiled = compile(&material(), &options(false)).expect("compiles");
    insta::assert_snapshot!(compiled.program.to_string());
}

#[test]
fn passes_make_it_smaller() {
    let compiled = compile(&material(), &options(true)).expect("compiles");
    let sizes: Vec<String> = compiled
        .passes
        .iter()
        .map(|p| format!("{}: {} nodes, {} operations", p.pass, p.nodes, p.operations))
        .collect();
    insta::assert_snapshot!(sizes.join("\n"));
}
