//! Small device modules and what becomes of them.

use matcha_wgsl::{Access, FieldPlace, Module, Source, Translation, Value, check, translate};
use naga::valid::Capabilities;

/// The WGSL of a module, which naga accepts.
fn wgsl(source: &str) -> String {
    let module = |path: &str, source: &str| Module {
        path: path.to_owned(),
        source: source.to_owned(),
    };
    let prelude = "
        pub fn vec3(x: f32, y: f32, z: f32) -> Vec3 { Vec3 { x, y, z } }
        pub fn select(f: f32, t: f32, c: bool) -> f32 { select_unpredictable(c, t, f) }
        pub fn bits_of(x: f32) -> u32 { x.to_bits() }
        pub fn wrapping_mul(a: u32, b: u32) -> u32 { a.wrapping_mul(b) }
        pub fn min(a: f32, b: f32) -> f32 { select(b, a, a < b) }";
    let modules = [module("math.rs", prelude), module("golden.rs", source)];
    let translation = translate(&modules).unwrap_or_else(|e| panic!("{e}"));
    let mut whole = translation.stand_ins();
    whole.append(&translation.source);
    check(&whole, Capabilities::empty()).unwrap_or_else(|e| panic!("{e}\n{}", whole.text()));
    let of_golden = (1..).zip(translation.source.text().lines());
    let lines = of_golden.filter_map(|(number, text)| {
        let origin = translation.source.origin(number)?;
        let is_blank = text.is_empty();
        (origin.path == "golden.rs" && !is_blank).then(|| format!("{:3} | {text}", origin.line))
    });
    lines.collect::<Vec<_>>().join("\n")
}

#[test]
fn numbers_and_casts() {
    insta::assert_snapshot!(wgsl(
        "
pub const SMALL: f32 = 1.0e-30;
pub const MASK: u32 = 0xffff_0000;
pub const SUM: u32 = MASK + (1 << 2);
pub fn numbers(x: f32, k: u32, i: i32, b: bool) -> f32 {
    let a = k as i32 as f32;
    let c = (i as u32) >> 3;
    let d = i >> k;
    let e = k << i;
    let f = b as u32 + !k;
    let g = -2147483648;
    let h = 3 * c + 0x10;
    let m = core::f32::consts::PI * f32::EPSILON * -0.0;
    let j = -(-x);
    a + c as f32 + d as f32 + (e + f + h) as f32 + (g + i) as f32 + m + j
}"
    ));
}

#[test]
fn choices() {
    insta::assert_snapshot!(wgsl(
        "
pub fn choices(x: f32, k: u32) -> f32 {
    if k == 7 {
        return x;
    }
    let y = if x > 0.0 { x } else if k == 1 { 2.0 } else { let z = x * x; z + 1.0 };
    let mut w = min(y, if k == 2 { 3.0 } else { 4.0 }) + { let q = y; q * q };
    if (k == 3) | (x < 0.0) && !(k == 4) {
        w = if k == 5 { 1.0 } else { w };
    } else if min(x, if k == 6 { 0.0 } else { 1.0 }) > 0.5 {
        w += 2.0;
    } else {
        w -= 1.0;
    }
    if k > 10 { w } else { -w }
}"
    ));
}

#[test]
fn loops() {
    insta::assert_snapshot!(wgsl(
        "
pub fn loops(x: f32, n: u32) -> f32 {
    let mut i = 0;
    let mut sum = 0.0;
    while i < n && sum < 100.0 {
        let x = x + sum;
        if x < 0.0 { i += 2; continue; }
        sum += x;
        i += 1;
    }
    let mut j = 0;
    while min(sum, if j == 1 { 1.0 } else { 2.0 }) > 0.5 {
        sum *= 0.5;
        j += 1;
    }
    loop {
        sum -= 1.0;
        if sum < 0.0 { break; }
    }
    sum
}"
    ));
}

#[test]
fn loops_that_only_return_leaves() {
    insta::assert_snapshot!(wgsl(
        "
pub fn endless(x: f32, n: u32) -> f32 {
    let mut sum = x;
    if n == 3 {
        loop { sum += 2.0; if sum > 50.0 { return sum; } }
    } else {
        let mut i = 0;
        loop {
            i += 1;
            loop { sum *= 2.0; if sum > 9.0 { break; } }
            if i > n { return sum; }
        }
    }
}
pub fn only(n: u32) -> u32 {
    let mut i = n;
    loop { i += 3; if i > 9 { return i; } }
}"
    ));
}

#[test]
fn arrays_and_structs() {
    insta::assert_snapshot!(wgsl(
        "
const TABLE: [u32; 4] = [1, 2, 3, 0xff];
const COUNT: usize_length = 2;
pub struct Pair { pub at: Vec3, pub weights: [f32; 3], pub on: bool }
pub fn arrays(s: [f32; 3], k: u32) -> Pair {
    let mut t = [0.0; 3];
    t[(k % 3) as usize] = s[(k % 2) as usize] + s[2];
    t[1] += TABLE[(k & 3) as usize] as f32;
    let weights = [t[0], min(s[0], s[1]), 1.0];
    let mut pair = Pair { weights, at: Vec3 { z: 1.0, x: s[0], y: 2.0 }, on: k == 0 };
    pair.at.x = pair.at.x * 2.0;
    let mut scaled = pair.at;
    scaled *= s[0];
    pair.at += scaled;
    pair.weights[0] = Vec3::splat(s[1]).y + Vec3::ZERO.z;
    pair
}"
        .replace("const COUNT: usize_length = 2;\n", "")
        .as_str()
    ));
}

#[test]
fn names() {
    insta::assert_snapshot!(wgsl(
        "
pub struct Ref { pub r#override: f32 }
pub fn exp(target: f32, mut mix: f32, _: f32, _unused: u32) -> f32 {
    let target = target + 1.0;
    let target = target * target;
    mix += target;
    let var = Ref { r#override: mix };
    {
        let mix = 2.0;
        var.r#override * mix
    }
}
pub fn inverse(x: f32) -> f32 { exp(x, x, x, 1) }"
    ));
}

#[test]
fn intrinsics_and_inference() {
    insta::assert_snapshot!(wgsl(
        "
pub fn intrinsics(x: f32, k: u32) -> u32 {
    let start = 0;
    let late;
    if k > 3 { late = 1; } else { late = 2; }
    let h = wrapping_mul(bits_of(x) ^ start, k | 1) >> late;
    let v = vec3(x, select(0.0, x, k == 1), 1.0) * 2.0;
    let both = (x > 0.0) ^ (k == 2);
    let i = 5;
    h + (bits_of(v.y) & wrapping_mul(k, k)) + both as u32 + (i as f32 > x) as u32
}"
    ));
}

#[test]
fn views() {
    insta::assert_snapshot!(wgsl(
        "
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub struct Node { pub at: Vec3, pub children: [u32; 2], pub power: [Vec2; 9], pub kind: i32 }
#[derive(Clone, Copy, Debug)]
pub struct Tree<'a> {
    pub nodes: &'a [Node],
    pub order: &'a [u32],
    pub scale: f32,
    pub box_: [Vec3; 2],
    pub root: Node,
}
pub fn leaf(tree: Tree<'_>, i: u32) -> f32 {
    let node = tree.nodes[i as usize];
    let order = tree.order[(i + 1) as usize];
    let x = tree.nodes[order as usize].power[(i & 3) as usize].y;
    let kind = tree.nodes[tree.order[2] as usize].kind;
    let at = tree.nodes[3].at;
    node.at.x + x + kind as f32 + at.z
}
pub fn header<'a>(i: u32, tree: Tree<'a>, k: u32) -> f32 {
    if i >= tree.order.len() as u32 || tree.nodes.is_empty() {
        return tree.scale;
    }
    let corner = tree.box_[k as usize];
    corner.x * tree.box_[1].z * tree.root.power[k as usize].x * leaf(tree, i) * leaf((tree), 0)
}"
    ));
}

#[test]
fn references() {
    insta::assert_snapshot!(wgsl(
        "
pub struct Item { pub weight: f32, pub kind: u32 }
pub struct Set { pub items: [Item; 4], pub count: u32 }
pub fn total(set: &Set, k: u32) -> f32 {
    set.items[0].weight + set.items[k as usize].weight
}
pub fn add(set: &mut Set, item: Item) {
    if set.count >= 4 {
        return;
    }
    set.items[set.count as usize] = item;
    set.count += 1;
}
pub fn reset(set: &mut Set, with: Set) -> bool {
    *set = with;
    let old = *set;
    old.count > 0
}
pub fn next(state: &mut u32) -> u32 {
    *state = *state * 3 + 1;
    *state
}
pub fn first(table: &[f32; 3]) -> f32 { table[0] }
pub fn all<'a>(with: Set, item: &'a Item, seed: u32) -> f32 {
    let mut set = with;
    let fixed = with;
    let mut state = seed;
    add(&mut set, *item);
    let was = if item.kind == 1 { reset(&mut set, with) } else { false };
    let table = [1.0, 2.0, 3.0];
    set.items[(seed & 1) as usize].kind = next(&mut state) % 5;
    let pick = next(&mut state) - next(&mut state);
    if was { add(&mut set, *item) } else { add(&mut set, Item { weight: 1.0, kind: pick }) }
    total(&set, 1) + total(&fixed, 2) + total(&with, 3) + first(&table)
}"
    ));
}

#[test]
fn passing_references_on() {
    insta::assert_snapshot!(wgsl(
        "
pub struct Pair { pub a: f32, pub b: f32 }
pub fn sum(pair: &Pair) -> f32 { pair.a + pair.b }
pub fn swap(pair: &mut Pair) -> f32 {
    let a = pair.a;
    pair.a = pair.b;
    pair.b = a;
    sum(pair)
}
pub fn twice(pair: &mut Pair) {
    swap(pair);
    swap(&mut *pair);
    let mut i = 0;
    while swap(pair) > 1.0 && i < 3 {
        pair.a *= 0.5;
        i += 1;
    }
    if pair.a > 0.0 { twice_more(pair) }
}
pub fn twice_more(pair: &mut Pair) { swap(pair); }"
    ));
}

const PARTICLES: &str = "
pub struct Spot { pub at: Vec2, pub on: bool }
pub struct Path { pub spots: [Spot; 2], pub words: [u32; 9], pub kind: i32 }
pub struct Grid<'a> { pub cells: &'a [Spot2], pub size: u32, pub low: Vec3, pub count: u32 }
pub struct Spot2 { pub at: Vec2 }
pub const SIZES: [u32; 2] = [SIZE, 1 << 4];
const SIZE: u32 = 3 * 5 - 1;
pub const LOW: f32 = -1.5 * 2.0;
pub fn cell(grid: Grid, i: u32) -> f32 { grid.cells[i as usize].at.x * grid.low.z }
pub fn cells(grid: Grid) -> u32 { grid.cells.len() as u32 / grid.size }
pub fn both(grid: Grid) -> f32 { cell(grid, cells(grid)) }";

fn particles() -> Translation {
    let module = Module {
        path: "golden.rs".to_owned(),
        source: PARTICLES.to_owned(),
    };
    translate(&[module]).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn columns() {
    let translation = particles();
    let columns = translation.columns("Path", "paths").expect("the struct");
    let mut whole = translation.needed(["Path"]).source;
    whole.append(&columns.source);
    whole.append(&Source::written(
        "host.wgsl",
        "fn paths_get(word: u32, i: u32) -> u32 { return word + i; }
         fn paths_set(word: u32, i: u32, value: u32) { }",
    ));
    check(&whole, Capabilities::empty()).unwrap_or_else(|e| panic!("{e}\n{}", whole.text()));
    insta::assert_snapshot!(columns.source.text());
    assert_eq!(columns.layout.words, 16);
    assert_eq!(columns.layout.offset("spots[1].on"), Some(5));
    assert_eq!(columns.layout.offset("words"), Some(6));
    assert!(
        translation.columns("Grid", "grid").is_none(),
        "it is a view"
    );
}

#[test]
fn what_hosts_are_told() {
    let translation = particles();
    let grid = &translation.views["Grid"];
    let places: Vec<(&str, u32, FieldPlace)> = grid
        .fields
        .iter()
        .map(|f| (f.name.as_str(), f.words, f.place))
        .collect();
    let header = |offset| FieldPlace::Header { offset };
    assert_eq!(
        places,
        [
            ("cells", 2, FieldPlace::Buffer),
            ("size", 1, header(0)),
            ("low", 3, header(1)),
            ("count", 1, header(4)),
        ]
    );
    assert_eq!(grid.header_words, 5);
    let accesses = |function: &str| -> Vec<String> {
        let accesses = translation.needed([function]).accesses;
        let text = |a: &Access| format!("{} {} {}", a.field, a.words, a.count);
        accesses.iter().map(text).collect()
    };
    assert_eq!(accesses("cell"), ["cells true false", "low true false"]);
    assert_eq!(accesses("cells"), ["cells false true", "size true false"]);
    let all = ["cells true true", "size true false", "low true false"];
    assert_eq!(accesses("both"), all);
    let parts = Value::Parts(vec![Value::U32(14), Value::U32(16)]);
    assert_eq!(translation.constants["SIZES"], parts);
    assert_eq!(translation.constants["LOW"].as_f32(), Some(-3.0));
}
