//! Random materials through everything: the interpreter over the graph, the program as
//! lowered, the optimised program, one point at a time and in lanes of every
//! instruction set, without a cache and with one that is empty, half full and full.

#[path = "../tests/support/mod.rs"]
mod support;

use crate::closure::{ClosureKind, Ty};
use crate::compile::{CostModel, Options, compile};
use crate::device::texel::{texel_centre, texel_footprint, texel_index, texel_level};
use crate::graph::{AlphaHandling, Interpolation, NodeId, Span, Table, TextureRef, type_of_width};
use crate::input::{Input, InputKind, Part};
use crate::material::{ClosureId, MaterialGraph};
use crate::ops::{self, OpCode};
use crate::opt::Optimise;
use crate::oracle::{self, Shaded};
use crate::program::Program;
use crate::source::Extension;
use crate::vm::kernel::{Frame, LANES};
use crate::vm::{Isa, Machine, NodeCache, Rows};
use glam::Vec2;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use std::collections::HashMap;
use support::{ExactCache, Formulas, Random, run_at};

/// Not a multiple of the lanes.
const POINTS: usize = 37;

/// Quantities that the random materials read.
const QUANTITIES: [InputKind; 6] = [
    InputKind::Uv(0),
    InputKind::Uv(1),
    InputKind::Position,
    InputKind::Normal,
    InputKind::Attribute(0),
    InputKind::Pointiness,
];

/// The points' quantities. Coordinates and footprints are those of virtual texels, so
/// that a region's value is the value at the point itself.
struct Points(HashMap<Input, Vec<[f32; 4]>>);

impl Points {
    fn new(random: &mut Random) -> Points {
        let mut of = HashMap::new();
        for kind in QUANTITIES {
            for part in [Part::Value, Part::AxisA, Part::AxisB] {
                let reach = if part == Part::Value { 1.5 } else { 0.03 };
                let value = |_| std::array::from_fn(|_| random.number(-reach, reach));
                of.insert(Input { kind, part }, (0..POINTS).map(value).collect());
            }
        }
        let mut points = Points(of);
        points.snap(0);
        points.snap(1);
        points
    }

    fn snap(&mut self, set: u16) {
        let input = |part| Input {
            kind: InputKind::Uv(set),
            part,
        };
        for k in 0..POINTS {
            let at = |part| {
                let value = self.0[&input(part)][k];
                Vec2::new(value[0], value[1])
            };
            let level = texel_level(at(Part::AxisA), at(Part::AxisB), 1.0);
            let uv = at(Part::Value);
            let centre = texel_centre(texel_index(uv.x, level), texel_index(uv.y, level), level);
            let size = texel_footprint(level);
            let mut set = |part, x: [f32; 2]| {
                let value = self
                    .0
                    .get_mut(&input(part))
                    .expect("every set has all parts");
                value[k][..2].copy_from_slice(&x);
            };
            set(Part::Value, [centre.x, centre.y]);
            set(Part::AxisA, [size, 0.0]);
            set(Part::AxisB, [0.0, size]);
        }
    }

    fn rows(&self, program: &Program) -> Rows {
        let mut rows = Rows::new(program.input_rows(), POINTS);
        for &(input, first) in &program.inputs {
            for i in 0..input.kind.width() {
                for k in 0..POINTS {
                    rows.set(first + i, k, self.0[&input][k][i]);
                }
            }
        }
        rows
    }
}

/// Builds a random typed graph out of all operations.
struct Builder<'a> {
    m: MaterialGraph,
    random: &'a mut Random,
    values: Vec<NodeId>,
    allowed: &'a [OpCode],
    /// Keeps numbers small.
    limiter: OpCode,
}

fn random_material(seed: u64, nodes: usize, allowed: &[OpCode], limiter: OpCode) -> MaterialGraph {
    let mut random = Random(seed);
    let m = MaterialGraph::default();
    let mut b = Builder {
        m,
        random: &mut random,
        values: Vec::new(),
        allowed,
        limiter,
    };
    for kind in QUANTITIES {
        b.values.push(b.m.graph.value(kind));
    }
    b.values
        .push(b.m.graph.input(InputKind::Uv(0), Part::AxisA));
    for x in [0.0, 1.0, 0.5, 3.0] {
        b.values.push(b.m.graph.f1(x));
    }
    for _ in 0..nodes {
        let value = b.node();
        b.values.push(value);
    }
    b.closures();
    b.m
}

impl Builder<'_> {
    fn pick(&mut self) -> NodeId {
        // Newer values more often, so that graphs get deep.
        let n = self.values.len();
        let at = self.random.below(n).max(self.random.below(n));
        self.values[at]
    }

    /// A value of a type: one that exists, a part of one, or several put together.
    fn of_type(&mut self, ty: Ty) -> NodeId {
        let value = self.pick();
        let width = self.m.graph.ty(value).width();
        if width >= ty.width() {
            let first = self.random.below(width - ty.width() + 1);
            return self.m.graph.extract(value, first, ty);
        }
        let rest = self.of_type(type_of_width(ty.width() - width));
        self.m.graph.combine(&[value, rest])
    }

    fn node(&mut self) -> NodeId {
        match self.random.below(12) {
            0 => self.texture(),
            1 => self.table(),
            2 | 3 => {
                let x = self.of_type(Ty::F3);
                self.m.graph.apply(self.limiter, &[x])
            }
            4 => {
                let value = self.pick();
                let axis = if self.random.below(2) == 0 {
                    Part::AxisA
                } else {
                    Part::AxisB
                };
                self.m.graph.shifted(value, axis, 0.5)
            }
            _ => self.operation(),
        }
    }

    fn operation(&mut self) -> NodeId {
        let op = self.allowed[self.random.below(self.allowed.len())];
        let operands: Vec<NodeId> = op.info().operands().map(|o| self.of_type(o.ty)).collect();
        let has_aux = op.info().arguments.iter().any(|a| a.immediate);
        let aux = if has_aux {
            self.random.below(5) as u32
        } else {
            0
        };
        self.m.graph.apply_aux(op, aux, &operands)
    }

    fn texture(&mut self) -> NodeId {
        let [uv, da, db] = std::array::from_fn(|_| self.of_type(Ty::F2));
        let texture = TextureRef {
            image: self.random.below(3) as u32,
            interpolation: Interpolation::Linear,
            extension: Extension::Repeat,
            alpha: AlphaHandling::Associated,
            no_footprint: false,
        };
        self.m.graph.texture(texture, uv, da, db)
    }

    fn table(&mut self) -> NodeId {
        let rows = 1 + self.random.below(4);
        let row = |r: &mut Random| (0..9).map(|_| r.number(-1.0, 2.0)).collect();
        let table = Table {
            rows: (0..rows).map(|_| row(self.random)).collect(),
            interpolate: self.random.below(2) == 0,
            extrapolate: self.random.below(2) == 0,
        };
        let table = self.m.graph.table(table);
        let x = self.of_type(Ty::F1);
        self.m.graph.look_up(table, x)
    }

    /// Closures over random values. Their normals are constants that tell them apart,
    /// so that none are merged and each is found again.
    fn closures(&mut self) {
        let mut ids: Vec<ClosureId> = Vec::new();
        for k in 0..3 {
            let weight = self.of_type(Ty::F3);
            let roughness = self.of_type(Ty::F1);
            let normal = self.m.graph.f3([0.0, 1.0, k as f32]);
            let (kind, params) = (ClosureKind::Diffuse, vec![roughness, normal]);
            let MaterialGraph {
                graph, closures, ..
            } = &mut self.m;
            ids.push(closures.leaf(graph, kind, weight, params, Span::default()));
        }
        for _ in 0..3 {
            let (a, b) = (
                ids[self.random.below(ids.len())],
                ids[self.random.below(ids.len())],
            );
            let fac = self.of_type(Ty::F1);
            let id = match self.random.below(2) {
                0 => self.m.closures.add(a, b),
                _ => self.m.closures.mix(&self.m.graph, fac, a, b),
            };
            ids.push(id);
        }
        self.m.closures.root = ids.last().copied();
    }
}

/// The third component of a closure's normal, which is its name here.
const NAME: usize = 3;

fn oracle_at(material: &MaterialGraph, points: &Points) -> Vec<Shaded> {
    let shade = |k: usize| oracle::shade(material, &|i| points.0[&i][k], &Formulas);
    (0..POINTS).map(shade).collect()
}

/// Equal but for rounding. Not-a-number is close to nothing.
fn close(got: f64, expected: f64) -> bool {
    (got - expected).abs() <= 1e-5 * expected.abs().max(1.0)
}

/// Compares a run's rows with the oracle's closures. A closure that is missing must have
/// no weight.
fn compare(program: &Program, out: &Rows, expected: &[Shaded]) -> Result<(), String> {
    for (k, shaded) in expected.iter().enumerate().filter(|(_, s)| s.finite) {
        for closure in &shaded.closures {
            let name = closure.params[NAME];
            let at = program
                .closures
                .iter()
                .find(|c| program.constant_output(c.first_row + 3 + NAME) == Some(name));
            let Some(at) = at else {
                if closure.weight.iter().any(|w| w.abs() > 1e-30) {
                    return Err(format!("point {k}: closure {name} is missing"));
                }
                continue;
            };
            for (i, &weight) in closure.weight.iter().enumerate() {
                let got = out.get(at.first_row + i, k);
                if !close(f64::from(got), weight) {
                    return Err(format!("point {k}: weight {got}, expected {weight}"));
                }
            }
            for (i, &expected) in closure.params.iter().enumerate() {
                let got = out.get(at.first_row + 3 + i, k);
                if !close(f64::from(got), f64::from(expected)) {
                    return Err(format!(
                        "point {k}: parameter {i} {got}, expected {expected}"
                    ));
                }
            }
        }
    }
    Ok(())
}

fn run(
    machine: &mut Machine,
    program: &Program,
    rows: &Rows,
    n: usize,
    cache: Option<&mut dyn NodeCache>,
) -> Rows {
    run_at(machine, program, n, rows, cache, 0.0).0
}

/// Every way to evaluate the material gives the oracle's values; all machines give the
/// same bits.
fn check(material: &MaterialGraph, points: &Points, how: Optimise) -> Result<(), String> {
    let expected = oracle_at(material, points);
    let paper = CostModel {
        lookup_ns: 0.0,
        ..CostModel::default()
    };
    let variants = [
        (
            "as lowered",
            Options {
                cache: false,
                optimise: Optimise::Nothing,
                cost: paper,
            },
        ),
        (
            "optimised",
            Options {
                cache: false,
                optimise: how,
                cost: paper,
            },
        ),
        (
            "cached",
            Options {
                cache: true,
                optimise: how,
                cost: paper,
            },
        ),
        (
            "cached where it pays",
            Options {
                cache: true,
                optimise: how,
                ..Options::default()
            },
        ),
    ];
    for (name, options) in variants {
        let program = compile(material, &options)
            .map_err(|e| e.to_string())?
            .program;
        let rows = points.rows(&program);
        let tell = |isa: Isa, problem| format!("{name}, {isa:?}: {problem}");
        let mut bits: Option<Vec<u32>> = None;
        for isa in Isa::available() {
            let machine = &mut Machine::new(Some(isa));
            let out = run(machine, &program, &rows, POINTS, None);
            compare(&program, &out, &expected).map_err(|p| tell(isa, p))?;
            let own = bits_of(&out);
            if bits.get_or_insert(own.clone()) != &own {
                return Err(tell(isa, "other bits than the scalar machine's".into()));
            }
            let mut cache = ExactCache::default();
            for n in [POINTS / 2, POINTS, POINTS] {
                let out = run(machine, &program, &rows, n, Some(&mut cache));
                let expected = &expected[..n];
                compare(&program, &out, expected).map_err(|p| tell(isa, p))?;
            }
        }
    }
    Ok(())
}

/// All numbers of the points; one bit pattern for every not-a-number, whose payload
/// depends on the order of a sum's operands.
fn bits_of(rows: &Rows) -> Vec<u32> {
    let bits = |x: &f32| {
        if x.is_nan() {
            f32::NAN.to_bits()
        } else {
            x.to_bits()
        }
    };
    (0..rows.rows())
        .flat_map(|r| rows.row(r)[..POINTS].iter().map(bits).collect::<Vec<_>>())
        .collect()
}

/// All operations but those that take long one point at a time; these have a case of
/// their own below.
fn quick_operations() -> Vec<OpCode> {
    ops::all().filter(|op| op.info().cost < 100.0).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, rng_seed: RngSeed::Fixed(1), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_graphs_keep_their_values(seed: u64, nodes in 1usize..60) {
        let material = random_material(seed, nodes, &quick_operations(), OpCode::vector_fraction);
        let points = Points::new(&mut Random(seed ^ 1));
        if let Err(problem) = check(&material, &points, Optimise::Exact) {
            prop_assert!(false, "{}", problem);
        }
    }
}

/// Operations without steps that magnify differences by little.
const SMOOTH: &[OpCode] = &[
    OpCode::math_add,
    OpCode::math_subtract,
    OpCode::math_multiply,
    OpCode::math_multiply_add,
    OpCode::math_minimum,
    OpCode::math_saturate,
    OpCode::math_mix,
    OpCode::math_sine,
    OpCode::vector_add,
    OpCode::vector_multiply,
    OpCode::vector_scale,
    OpCode::vector_mix,
    OpCode::vector_mix_each,
    OpCode::mix_add,
    OpCode::mix_multiply,
    OpCode::mix_screen,
    OpCode::mix_difference,
    OpCode::mix_darken,
    OpCode::mix_lighten,
];

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 256,
        rng_seed: RngSeed::Fixed(2),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    /// With the rules that round too, where rounding is not magnified to a jump.
    #[test]
    fn random_smooth_graphs_keep_their_values_but_for_rounding(seed: u64, nodes in 1usize..30) {
        let material = random_material(seed, nodes, SMOOTH, OpCode::vector_sine);
        let points = Points::new(&mut Random(seed ^ 1));
        if let Err(problem) = check(&material, &points, Optimise::Rounding) {
            prop_assert!(false, "{}", problem);
        }
    }
}

#[test]
fn most_random_points_are_compared() {
    let mut finite = 0;
    for seed in 0..100 {
        let material = random_material(seed, 30, &quick_operations(), OpCode::vector_fraction);
        let shaded = oracle_at(&material, &Points::new(&mut Random(seed ^ 1)));
        finite += shaded.iter().filter(|s| s.finite).count();
    }
    let share = finite as f64 / (100 * POINTS) as f64;
    assert!(
        share > 0.5,
        "only {share:.2} of the points have finite values"
    );
}

/// A material whose only closure shows the operation's result.
fn showing(op: OpCode) -> MaterialGraph {
    let mut m = MaterialGraph::default();
    let g = &mut m.graph;
    let pool: Vec<NodeId> = QUANTITIES.iter().map(|&kind| g.value(kind)).collect();
    let components: Vec<NodeId> = pool
        .iter()
        .flat_map(|&v| {
            (0..g.ty(v).width())
                .map(|i| g.component(v, i))
                .collect::<Vec<_>>()
        })
        .collect();
    let mut next = 0;
    let operands: Vec<NodeId> = op
        .info()
        .operands()
        .map(|o| {
            let parts: Vec<NodeId> = (0..o.ty.width())
                .map(|i| components[(next + i) % components.len()])
                .collect();
            next += o.ty.width();
            g.combine(&parts)
        })
        .collect();
    let value = g.apply(op, &operands);
    let parts: Vec<NodeId> = (0..3)
        .map(|i| g.component(value, i % op.info().result.width()))
        .collect();
    let weight = g.combine(&parts);
    let roughness = g.component(value, op.info().result.width() - 1);
    let normal = g.f3([0.0, 1.0, 0.0]);
    let params = vec![roughness, normal];
    let leaf = m.closures.leaf(
        &m.graph,
        ClosureKind::Diffuse,
        weight,
        params,
        Span::default(),
    );
    m.closures.root = Some(leaf);
    m
}

#[test]
fn every_operation_alone() {
    let points = Points::new(&mut Random(5));
    for op in ops::all() {
        if let Err(problem) = check(&showing(op), &points, Optimise::Rounding) {
            panic!("{}: {problem}", op.info().name);
        }
    }
}

/// Spoils a result.
unsafe fn corrupt(frame: Frame, word: &crate::program::Word) {
    // SAFETY: the word's destination is inside of the frame, as for any kernel.
    unsafe { frame.store(word, &[[0.12345f32; LANES]]) }
}

#[test]
fn must_fail_a_corrupted_operation_turns_the_comparison_red() {
    let points = Points::new(&mut Random(5));
    for op in ops::all() {
        let material = showing(op);
        let expected = oracle_at(&material, &points);
        let options = Options {
            cache: false,
            ..Options::default()
        };
        let program = compile(&material, &options).expect("compiles").program;
        let rows = points.rows(&program);
        let mut machine = Machine::new(Some(Isa::best()));
        assert_eq!(
            compare(
                &program,
                &run(&mut machine, &program, &rows, POINTS, None),
                &expected
            ),
            Ok(())
        );
        machine.replace_kernel(op, corrupt);
        let out = run(&mut machine, &program, &rows, POINTS, None);
        assert!(
            compare(&program, &out, &expected).is_err(),
            "{}",
            op.info().name
        );
    }
}

#[test]
fn a_point_does_not_depend_on_its_group() {
    let material = random_material(11, 50, &quick_operations(), OpCode::vector_fraction);
    let points = Points::new(&mut Random(3));
    let program = compile(&material, &Options::default())
        .expect("compiles")
        .program;
    let rows = points.rows(&program);
    let mut machine = Machine::new(None);
    let whole = run(&mut machine, &program, &rows, POINTS, None);
    for k in 0..POINTS {
        let mut one = Rows::new(program.input_rows(), 1);
        for row in 0..program.input_rows() {
            one.set(row, 0, rows.get(row, k));
        }
        let alone = run(&mut machine, &program, &one, 1, None);
        for row in 0..whole.rows() {
            assert_eq!(alone.get(row, 0).to_bits(), whole.get(row, k).to_bits());
        }
    }
}

#[test]
fn special_values_neither_panic_nor_hang() {
    let special = [
        f32::NAN,
        f32::INFINITY,
        -f32::INFINITY,
        f32::MAX,
        -f32::MAX,
        1e-40,
        -0.0,
    ];
    for op in ops::all() {
        let program = compile(
            &showing(op),
            &Options {
                cache: false,
                ..Options::default()
            },
        )
        .expect("compiles")
        .program;
        let mut rows = Rows::new(program.input_rows(), POINTS);
        let mut random = Random(9);
        for row in 0..rows.rows() {
            rows.row_mut(row)
                .fill_with(|| special[random.below(special.len())]);
        }
        let mut all: Option<Vec<u32>> = None;
        for isa in Isa::available() {
            let out = run(&mut Machine::new(Some(isa)), &program, &rows, POINTS, None);
            let bits = bits_of(&out);
            assert_eq!(
                *all.get_or_insert(bits.clone()),
                bits,
                "{} {isa:?}",
                op.info().name
            );
        }
    }
}
