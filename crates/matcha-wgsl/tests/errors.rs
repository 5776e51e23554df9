//! Everything outside of the subset is refused, with a sentence and the line of Rust.

use matcha_wgsl::{Module, translate};

/// The messages for one module, `file.rs:line: …` each.
fn refused(source: &str) -> String {
    let module = Module {
        path: "file.rs".to_owned(),
        source: source.to_owned(),
    };
    match translate(&[module]) {
        Ok(translation) => panic!("accepted: {}", translation.source.text()),
        Err(error) => error.to_string(),
    }
}

/// `body` as that of `f(x: f32, k: u32, a: [f32; 3]) -> f32`, on line 2.
fn refused_body(body: &str) -> String {
    refused(&format!(
        "pub fn f(x: f32, k: u32, a: [f32; 3]) -> f32 {{\n{body}\n}}"
    ))
}

#[test]
fn statements_and_expressions_outside_of_the_subset() {
    let bodies = [
        "match k { _ => x }",
        "for i in 0..3 { }",
        "x.abs()",
        "let f = |y: f32| y; f(x)",
        "let y = &x; *y",
        "let (y, z) = (x, x); y",
        "(x, x).0",
        "assert!(x > 0.0); x",
        "let y = vec![x]; x",
        "if let y = x { y } else { x }",
        "let y = x else { return x }; y",
        "'outer: loop { break 'outer; } x",
        "let y = loop { break x; }; y",
        "x as u32 as f32",
        "x % 2.0",
        "let y = return x; y",
        "bits(x)",
        "y",
        "f64::MAX as f32",
        "1.0e40",
        "1.0f64 as f32",
        "x + k",
        "f(x, k)",
        "k.x",
        "x[0]",
        "a[4294967296]",
        "select(x, x, x)",
        "fn g() -> f32 { 1.0 } x",
        "x;\nx",
        "return;",
        "if x == x { x }",
        "if a == a { x } else { x }",
        "let mut y = x; y + if k == 0 { y = 2.0; y } else { x }",
        "let y = [x; 2 + 1]; x",
        "unsafe { core::hint::unreachable_unchecked() }",
        "k as bool as u32 as f32",
    ];
    let listing: Vec<String> = bodies
        .iter()
        .map(|body| format!("{}\n    {}", body.replace('\n', "⏎"), refused_body(body)))
        .collect();
    insta::assert_snapshot!("bodies", listing.join("\n"));
}

#[test]
fn items_outside_of_the_subset() {
    let items = [
        "pub struct S<T> { x: T }",
        "pub struct S(f32);",
        "pub struct S { x: f64 }",
        "pub struct S { x: S }",
        "impl S { }",
        "pub trait T { }",
        "pub enum E { A, B }",
        "static X: f32 = 1.0;",
        "type F = f32;",
        "macro_rules! m { () => { } }",
        "mod inner { }",
        "use a::b as c;",
        "#[cfg(feature = \"x\")]\npub fn f(x: f32) -> f32 { x }",
        "pub fn f<T>(x: T) -> T { x }",
        "pub unsafe fn f(x: f32) -> f32 { x }",
        "pub fn f(x: &f32) -> f32 { 1.0 }",
        "pub fn f(x: &[f32]) -> f32 { 1.0 }",
        "pub fn f(x: (f32, f32)) -> f32 { 1.0 }",
        "pub fn f(x: Vec4) -> f32 { 1.0 }",
        "pub fn f(x: f32) { }",
        "pub fn f((x, y): f32) -> f32 { x }",
        "pub fn f(x: f32) -> f32 { f(x) }",
        "pub fn f(x: f32) -> f32 { g(x) }\npub fn g(x: f32) -> f32 { f(x) }",
        "pub fn f(x: f32) -> f32 { x }\npub fn f(x: f32) -> f32 { x }",
        "pub fn f(x: f32) -> f32 { 1 }",
        "pub const A: f32 = B;\npub const B: f32 = A;",
        "pub const A: f32 = if true { 1.0 } else { 2.0 };",
        "pub struct S { a: f32 }\npub fn f(x: f32) -> S { S { b: x } }",
        "pub struct S { a: f32, b: f32 }\npub fn f(x: f32) -> S { S { a: x } }",
        "pub struct S { a: f32 }\npub fn f(x: S) -> S { S { ..x } }",
        "pub fn f(x: f32 -> f32 { x }",
    ];
    let listing: Vec<String> = items
        .iter()
        .map(|item| {
            format!(
                "{}\n    {}",
                item.replace('\n', "⏎"),
                refused(item).replace('\n', "\n    ")
            )
        })
        .collect();
    insta::assert_snapshot!("items", listing.join("\n"));
}

#[test]
fn all_mistakes_are_reported_in_the_order_of_their_lines() {
    let source =
        "pub fn f(x: f32) -> f32 {\n    x.sin()\n}\npub fn g(x: f32) -> f32 {\n    h(x)\n}\n";
    let lines: Vec<String> = refused(source)
        .lines()
        .map(|l| l[..10].to_owned())
        .collect();
    assert_eq!(lines, ["file.rs:2:", "file.rs:5:"]);
}

#[test]
fn an_intrinsic_that_nobody_knows() {
    let module = Module {
        path: "device/intrinsics.rs".to_owned(),
        source: "pub fn count_ones(x: u32) -> u32 { x.count_ones() }".to_owned(),
    };
    let error = translate(&[module])
        .expect_err("WGSL calls it otherwise")
        .to_string();
    assert!(
        error.starts_with("device/intrinsics.rs:1: `count_ones`"),
        "{error}"
    );
}
