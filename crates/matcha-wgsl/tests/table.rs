//! The table of operations: what is read from it, and what is refused.

use matcha_wgsl::{DispatchForm, Module, OperandType, Operations, operations, translate};

const DEVICE: &str = "
    pub fn twice(x: f32) -> f32 { x + x }
    pub fn pick(p: Vec3, mode: u32) -> Vec2 { Vec2 { x: p.x, y: mode as f32 } }
    pub fn count(x: f32) -> u32 { 3 }
    pub fn start(x: f32) -> [f32; 2] { [x, 0.0] }
    pub fn next(i: u32, x: f32, s: [f32; 2]) -> [f32; 2] { [s[0] * 0.5, s[1] + s[0]] }
    pub fn last(x: f32, s: [f32; 2]) -> f32 { s[1] }";

const FAMILY: &str = "operations! {
    family one;
    /// Doubled.
    op_twice(x: F1) -> F1 { cost: 1.0, error: 0.0, eval: device::twice, }
    /// Picked.
    op_pick(p: F3, mode: U32) -> Gradient { cost: 1.0, error: 0.0, domain: [0.0, 1.0], eval: device::pick }
    /// Summed.
    op_sum(x: F1) -> F1 {
        cost: 1.0, error: 0.0,
        loop: { count: device::count, init: device::start, step: device::next, finish: device::last, state: 2 },
    }
}";

/// Reads a table of one family.
fn read(list: &str, family: &str) -> Result<Operations, String> {
    let module = |path: &str, source: &str| Module {
        path: path.to_owned(),
        source: source.to_owned(),
    };
    let device = translate(&[module("device.rs", DEVICE)]).unwrap_or_else(|e| panic!("{e}"));
    let families = [module("one.rs", family)];
    operations(&module("ops.rs", list), &families, &device).map_err(|e| e.to_string())
}

#[test]
fn entries_and_their_functions() {
    let table = read("families! { one }", FAMILY).unwrap_or_else(|e| panic!("{e}"));
    let [twice, pick, sum] = table.entries.as_slice() else {
        panic!("{} entries", table.entries.len());
    };
    assert_eq!((twice.code, pick.code, sum.code), (0, 1, 2));
    assert_eq!(pick.arguments, [OperandType::F3, OperandType::Immediate]);
    assert_eq!(pick.result, OperandType::F2);
    assert!(sum.is_loop && !twice.is_loop);
    assert_eq!(sum.functions, ["count", "start", "next", "last"]);
    let mut source = table.source();
    source.append(&table.dispatch(&DispatchForm {
        name: "execute",
        parameters: "word: Word",
        arguments: "word",
        operand: "row(word, {}u)",
        immediate: "word.immediate",
    }));
    insta::assert_snapshot!(source.text());
}

#[test]
fn what_is_no_table_is_refused_at_its_line() {
    let with = |from: &str, to: &str| {
        assert!(FAMILY.contains(from), "{from}");
        read("families! { one }", &FAMILY.replacen(from, to, 1)).expect_err(to)
    };
    let refusals = [
        read("families! { one, two }", FAMILY).expect_err("no family two"),
        read("pub struct Nothing;", FAMILY).expect_err("no list"),
        read("families! { one }", "pub struct Nothing;").expect_err("no entries"),
        with("family one;", "families one;"),
        with("error: 0.0, eval", "erorr: 0.0, eval"),
        with("eval: device::pick", "cost: 2.0"),
        with("state: 2 ", ""),
        with("step: device::next", "stride: device::next"),
        with("x: F1) -> F1 {", "x: F5) -> F1 {"),
        with("device::twice", "device::thrice"),
        with("device::twice", "device::count"),
        with("state: 2", "state: 3"),
    ];
    insta::assert_snapshot!(refusals.join("\n"));
}
