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
        "pub fn f(x: f32) -> &f32 { x }",
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

/// `body` as that of `f(v: V, s: &mut S, k: u32) -> u32`, on line 5.
#[test]
fn views_and_references_outside_of_the_subset() {
    let bodies = [
        "v.list[k as usize].a.x",
        "v.list[k as usize].b",
        "v.list",
        "v.list.iter()",
        "v.none[0]",
        "v.plain[k as usize]",
        "let w = v; k",
        "f(w, s, k)",
        "f(v, s)",
        "f(V { plain: 1, list: v.list }, s, k)",
        "g(v)",
        "f(v, k, k)",
        "f(v, &mut k, k)",
        "f(v, &mut s.a, k)",
        "f(v, &mut S { a: 1 }, k)",
        "f(v, &mut v, k)",
        "f(v, &mut s, k)",
        "let t = s; k",
        "let t = &k; k",
        "k + s",
        "*k",
        "v.plain = k; k",
        "s.b",
        "if k == 0 { s } else { s }",
        "let n = w(s) + if k == 0 { 1 } else { 2 }; n",
        "let n = [w(s) + 1; 3]; k",
        "let t = [1, 2]; let n = w(s) + t[k as usize]; n",
        "let n = k + { s.a = 2; w(s) }; n",
        "let mut t = [1, 2]; t[w(s) as usize] = 1; k",
        "w(s);\ng(v);\nk",
        "x(v)",
    ];
    let listing: Vec<String> = bodies
        .iter()
        .map(|body| {
            let message = refused(&format!(
                "pub struct S {{ a: u32 }}
pub struct V<'a> {{ plain: u32, list: &'a [S] }}
pub struct W<'a> {{ plain: u32, list: &'a [S] }}
pub fn f(v: V, s: &mut S, k: u32) -> u32 {{
{body}
}}
pub fn g(w: W) -> u32 {{ w.plain }}
pub fn w(s: &mut S) -> u32 {{ s.a }}"
            ));
            format!("{}\n    {message}", body.replace('\n', "⏎"))
        })
        .collect();
    insta::assert_snapshot!("views_and_references", listing.join("\n"));
}

#[test]
fn faces_of_views_and_references_outside_of_the_subset() {
    let items = [
        "pub struct V<'a, 'b> { x: &'a [f32], y: &'b [f32] }",
        "pub struct V<'a, T> { x: &'a [T] }",
        "pub struct V<'a>(&'a [f32]);",
        "pub struct V<'a> {\nx: &'a f32 }",
        "pub struct V<'a> {\nx: &'a mut [f32] }",
        "pub struct V<'a> {\nx: &'a [bool] }",
        "pub struct V<'a> {\nx: &'a [u16] }",
        "pub struct S { on: bool }\npub struct V<'a> {\nx: &'a [[S; 2]] }",
        "pub struct S { s: S }\npub struct V<'a> {\nx: &'a [S] }",
        "pub struct V<'a> { x: &'a [f32] }\npub struct S {\nv: V<'static> }",
        "pub struct V<'a> { x: &'a [f32] }\npub fn f(v: &V) -> f32 { v.x[0] }",
        "pub struct V<'a> { x: &'a [f32] }\npub fn f(v: V) -> V { v }",
        "pub struct V<'a> { x: &'a [f32] }\npub fn f(mut v: V) -> f32 { v.x[0] }",
        "pub struct V<'a> { x: &'a [f32] }\npub const V: f32 = 1.0;",
        "pub struct S { x: f32 }\npub fn f<'a>(s: &'a S) -> &'a S { s }",
        "pub struct S { x: f32 }\npub fn f(mut s: &S) -> f32 { s.x }",
        "pub struct S { x: f32 }\npub fn f(s: &S) { }",
        "pub struct S<'a> { x: f32 }\npub struct T { s: &'a S }",
    ];
    let listing: Vec<String> = items
        .iter()
        .map(|item| format!("{}\n    {}", item.replace('\n', "⏎"), refused(item)))
        .collect();
    insta::assert_snapshot!("faces", listing.join("\n"));
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
