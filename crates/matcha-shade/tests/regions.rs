//! Cacheable nodes: what is looked up, skipped, stored and shared.

mod support;

use matcha_shade::closure::ClosureKind;
use matcha_shade::compile::{Compiled, CostModel, Options, compile};
use matcha_shade::graph::{Graph, NodeId, Span};
use matcha_shade::input::InputKind;
use matcha_shade::material::MaterialGraph;
use matcha_shade::ops::OpCode;
use matcha_shade::program::Program;
use matcha_shade::vm::{Isa, Machine, NodeCache, Rows};
use support::{ExactCache, Random, at_texel_centres, inputs, run_at};

const N: usize = 100;

fn material(build: impl FnOnce(&mut Graph) -> Vec<NodeId>) -> MaterialGraph {
    let mut m = MaterialGraph::default();
    for weight in build(&mut m.graph) {
        // Different parameters, so that the closures are not merged.
        let k = m.closures.nodes().len() as f32;
        let normal = m.graph.f3([0.0, 0.0, k]);
        let kind = ClosureKind::Translucent;
        let leaf = m
            .closures
            .leaf(&m.graph, kind, weight, vec![normal], Span::default());
        m.closures.root = Some(match m.closures.root {
            Some(root) => m.closures.add(root, leaf),
            None => leaf,
        });
    }
    m
}

fn compiled(m: &MaterialGraph, cache: bool) -> Compiled {
    let cost = CostModel {
        lookup_ns: 0.0,
        ..CostModel::default()
    };
    compile(
        m,
        &Options {
            cache,
            cost,
            ..Options::default()
        },
    )
    .expect("compiles")
}

fn run(
    c: &Compiled,
    isa: Option<Isa>,
    n: usize,
    rows: &Rows,
    cache: Option<&mut dyn NodeCache>,
) -> Rows {
    run_at(&mut Machine::new(isa), &c.program, n, rows, cache, 0.0).0
}

fn assert_equal(a: &Rows, b: &Rows, n: usize) {
    assert_eq!(a.rows(), b.rows());
    for row in 0..a.rows() {
        for k in 0..n {
            let (x, y) = (a.get(row, k), b.get(row, k));
            assert!(!x.is_nan(), "row {row}, point {k} is undefined");
            assert_eq!(x, y, "row {row}, point {k}");
        }
    }
}

/// Runs a material whose values depend on one UV set inside their cacheable parts, with
/// a cache that is empty, half full and full, against the program without regions at
/// the texels' centres.
fn check(m: &MaterialGraph, values: usize) {
    let with = compiled(m, true);
    let without = compiled(m, false);
    assert_eq!(with.program.cacheable(), values, "{}", with.program);
    let regions = with.program.regions().len();
    assert_eq!(regions, 1, "one for all values of a set");
    assert_eq!(without.program.regions().len(), 0);
    let mut random = Random(7);
    let rows = inputs(&with.program, N, &mut random);
    let centres = at_texel_centres(&with.program, N, &rows, 0);
    let plain = {
        let mut own = Rows::new(without.program.input_rows(), N);
        for &(input, first) in &without.program.inputs {
            let from = with.program.input_row(input).expect("the same inputs");
            for i in 0..input.kind.width() {
                own.row_mut(first + i)
                    .copy_from_slice(centres.row(from + i));
            }
        }
        own
    };
    let expected = run(&without, None, N, &plain, None);
    for isa in Isa::available() {
        let mut cache = ExactCache::default();
        // Half of the points first: the whole group then finds some and misses some.
        run(&with, Some(isa), N / 2, &rows, Some(&mut cache));
        assert!(!cache.values.is_empty());
        for _ in 0..2 {
            assert_equal(
                &run(&with, Some(isa), N, &rows, Some(&mut cache)),
                &expected,
                N,
            );
        }
        assert_equal(&run(&with, Some(isa), N, &rows, None), &expected, N);
        assert_eq!(cache.calls, 3 * regions);
    }
}

/// Some arithmetic on the coordinate.
fn pattern(g: &mut Graph, k: f32) -> NodeId {
    let uv = g.value(InputKind::Uv(0));
    let (u, v) = (g.component(uv, 0), g.component(uv, 1));
    let k = g.f1(k);
    let a = g.apply(OpCode::math_multiply_add, &[u, k, v]);
    let b = g.apply(OpCode::series_of_halves, &[a, k]);
    g.combine(&[a, b, v])
}

#[test]
fn one_value() {
    check(
        &material(|g| {
            let p = pattern(g, 3.0);
            let q = g.value(InputKind::Position);
            vec![g.apply(OpCode::vector_multiply, &[p, q])]
        }),
        1,
    );
}

#[test]
fn a_value_shared_by_two_cached_ones() {
    check(
        &material(|g| {
            let shared = pattern(g, 3.0);
            let own = pattern(g, 5.0);
            let a = g.apply(OpCode::vector_multiply, &[shared, own]);
            let b = g.apply(OpCode::vector_subtract, &[shared, own]);
            let q = g.value(InputKind::Position);
            vec![
                g.apply(OpCode::vector_add, &[a, q]),
                g.apply(OpCode::vector_add, &[b, q]),
            ]
        }),
        2,
    );
}

#[test]
fn a_value_that_the_rest_needs_too() {
    check(
        &material(|g| {
            let shared = pattern(g, 3.0);
            let squared = g.apply(OpCode::vector_multiply, &[shared, shared]);
            let q = g.value(InputKind::Position);
            vec![
                g.apply(OpCode::vector_add, &[squared, q]),
                g.apply(OpCode::vector_multiply, &[shared, q]),
            ]
        }),
        2,
    );
}

#[test]
fn components_of_one_value_are_looked_up_once() {
    check(
        &material(|g| {
            let p = pattern(g, 3.0);
            let p = g.apply(OpCode::vector_add, &[p, p]);
            let (x, z) = (g.component(p, 0), g.component(p, 2));
            let q = g.value(InputKind::Position);
            vec![
                g.apply(OpCode::vector_scale, &[q, x]),
                g.apply(OpCode::vector_scale, &[q, z]),
            ]
        }),
        1,
    );
}

#[test]
fn an_output_itself_is_cacheable() {
    check(&material(|g| vec![pattern(g, 2.0)]), 1);
}

#[test]
fn counts_tell_hits_from_misses() {
    let m = material(|g| vec![pattern(g, 2.0)]);
    let c = compiled(&m, true);
    let rows = inputs(&c.program, N, &mut Random(1));
    let mut cache = ExactCache::default();
    let mut machine = Machine::new(None);
    let mut run =
        |cache: &mut ExactCache| run_at(&mut machine, &c.program, N, &rows, Some(cache), 0.0).1;
    let first = run(&mut cache);
    let second = run(&mut cache);
    assert_eq!((first.look_ups, first.found), (N as u64, 0));
    assert_eq!((second.look_ups, second.found), (N as u64, N as u64));
}

/// Levels of the texels that a program's values are stored at: coarsest and finest.
fn levels(program: &Program, offset: f32) -> [i32; 2] {
    let rows = inputs(program, N, &mut Random(1));
    let mut cache = ExactCache::default();
    let machine = &mut Machine::new(None);
    run_at(machine, program, N, &rows, Some(&mut cache), offset);
    let levels = cache.values.keys().map(|(_, texel)| texel.level);
    let (least, most) = (levels.clone().min(), levels.max());
    [least, most].map(|level| level.expect("something is stored"))
}

#[test]
fn a_level_offset_makes_texels_finer() {
    let program = compiled(&material(|g| vec![pattern(g, 2.0)]), true).program;
    let finer = levels(&program, 0.0).map(|level| level + 3);
    assert_eq!(levels(&program, 3.0), finer);
}
