use super::slots::slots;
use super::*;
use glam::Vec3;
use matcha_render::accel::{Accel, Bounds, BuildOptions};
use matcha_render::scene::{Instance, Mesh, Scene, Visibility};
use proptest::prelude::*;

fn boxes() -> impl Strategy<Value = Vec<Bounds>> {
    // Coordinates of all sizes, sides that have no extent among them.
    let number = (-1.0f32..1.0, -40i32..50).prop_map(|(m, e)| m * (e as f32).exp2());
    let corner = prop::array::uniform3(number);
    let thin = prop::array::uniform3(any::<bool>());
    let one = (corner.clone(), corner, thin).prop_map(|(a, b, thin)| {
        let a = Vec3::from(a);
        let mut b = Vec3::from(b);
        for axis in 0..3 {
            if thin[axis] {
                b[axis] = a[axis];
            }
        }
        Bounds {
            min: a.min(b),
            max: a.max(b),
        }
    });
    prop::collection::vec(one, 1..=8)
}

fn whole(boxes: &[Bounds]) -> Bounds {
    let mut whole = Bounds::EMPTY;
    for bounds in boxes {
        whole.grow(bounds.min);
        whole.grow(bounds.max);
    }
    whole
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn quantised_boxes_hold_their_boxes_with_a_margin(boxes in boxes()) {
        let whole = whole(&boxes);
        let grid = Grid::over(&whole);
        for bounds in &boxes {
            let kept = grid.bounds(grid.quantise(bounds));
            for (axis, [low, high]) in kept.into_iter().enumerate() {
                let step = grid.step(axis);
                let (min, max) = (f64::from(bounds.min[axis]), f64::from(bounds.max[axis]));
                // The walk's rounding: 2⁻¹⁴ steps. See `grid::MARGIN`.
                prop_assert!(low + step / 300.0 <= min && max <= high - step / 300.0);
                prop_assert!(min - low <= 1.01 * step && high - max <= 1.01 * step);
            }
        }
    }

    #[test]
    fn grids_are_fine(boxes in boxes()) {
        let whole = whole(&boxes);
        let grid = Grid::over(&whole);
        for axis in 0..3 {
            let extent = f64::from(whole.max[axis]) - f64::from(whole.min[axis]);
            let ulp = f64::from(whole.min[axis].abs().max(whole.max[axis].abs())) * f64::from(f32::EPSILON);
            prop_assert!(grid.step(axis) * 250.0 <= 2.0 * (extent + ulp) + 1e-25);
        }
    }
}

#[test]
fn corners_take_their_own_slots() {
    let corner = |slot: usize| {
        let at = Vec3::new(
            (slot & 1) as f32,
            (slot >> 1 & 1) as f32,
            (slot >> 2) as f32,
        );
        Bounds {
            min: at,
            max: at + 0.9,
        }
    };
    let all: Vec<Bounds> = (0..8).rev().map(corner).collect();
    assert_eq!(slots(&all), [7, 6, 5, 4, 3, 2, 1, 0]);
    let same = slots(&[corner(3); 8]);
    let mut sorted = same.clone();
    sorted.sort_unstable();
    assert_eq!(sorted, [0, 1, 2, 3, 4, 5, 6, 7]);
}

/// Triangles of `count` different sizes, each in the next one's middle.
fn nested(count: i32, ratio: f32) -> Mesh {
    let mut mesh = Mesh::default();
    for k in 0..count {
        let size = ratio.powi(k);
        let first = mesh.positions.len() as u32;
        mesh.positions
            .extend([Vec3::X * size, Vec3::Y * size, Vec3::Z * size]);
        mesh.indices.push([first, first + 1, first + 2]);
    }
    mesh
}

fn scene(mesh: Mesh, instances: usize) -> Scene {
    let place = |i: usize| Instance {
        name: "object".into(),
        mesh: 0,
        transform: glam::Affine3A::from_translation(Vec3::X * i as f32 * 0.3),
        materials: vec![],
        pass_index: 0.0,
        random: 0.0,
        color: glam::Vec4::ONE,
        visibility: Visibility::default(),
        holdout: false,
    };
    Scene {
        meshes: vec![mesh],
        instances: (0..instances).map(place).collect(),
        ..Scene::default()
    }
}

fn build(scene: &Scene, flat: usize) -> WideTree {
    let options = BuildOptions {
        flat_triangles: Some(flat),
        pre_split: false,
        ..BuildOptions::default()
    };
    WideTree::new(&Accel::build_with(scene, &options).expect("a structure")).expect("a hierarchy")
}

/// Walks everything: boxes hold what is below, and every triangle is reached once a placement.
struct Visit<'a> {
    tree: &'a WideTree,
    reached: Vec<usize>,
    deepest: u32,
}

impl Visit<'_> {
    fn node(&mut self, at: u32, level: u32) -> Vec<[f32; 3]> {
        self.deepest = self.deepest.max(level);
        let node = self.tree.nodes[at as usize];
        if let Some(root) = node.placed_root() {
            self.node(root, level + 1);
            return Vec::new();
        }
        let (mut child, mut triangle) = (node.children, node.triangles);
        let mut all = Vec::new();
        for slot in 0..8 {
            let points = if node.kinds >> slot & 1 == 1 {
                child += 1;
                self.node(child - 1, level + 1)
            } else if node.kinds >> (8 + slot) & 1 == 1 {
                let count = (node.counts >> (4 * slot) & 15) + 1;
                triangle += count;
                self.leaf(triangle - count, count)
            } else {
                continue;
            };
            let grid = node.grid();
            let sides = std::array::from_fn(|axis| node.sides[axis].map(|row| row[slot]));
            let bounds = grid.bounds(sides);
            for point in &points {
                for axis in 0..3 {
                    let at = f64::from(point[axis]);
                    assert!(bounds[axis][0] < at && at < bounds[axis][1]);
                }
            }
            all.extend(points);
        }
        all
    }

    fn leaf(&mut self, first: u32, count: u32) -> Vec<[f32; 3]> {
        let range = first as usize..(first + count) as usize;
        self.reached[range.clone()].iter_mut().for_each(|n| *n += 1);
        let corners = self.tree.triangles[range].iter().flat_map(|t| t.corners);
        corners.collect()
    }
}

fn visit(tree: &WideTree) -> Vec<usize> {
    let reached = vec![0; tree.triangles.len()];
    let mut visit = Visit {
        tree,
        reached,
        deepest: 0,
    };
    visit.node(0, 1);
    assert!(visit.deepest <= tree.levels && tree.levels <= tree.stack());
    visit.reached
}

#[test]
fn every_triangle_is_reached_and_held_by_its_boxes() {
    for count in [1, 3, 17, 400] {
        let scene = scene(nested(count, 0.97), 5);
        let copied = build(&scene, usize::MAX);
        assert_eq!(visit(&copied), vec![1; 5 * count as usize]);
        let placed = build(&scene, 0);
        assert_eq!(visit(&placed), vec![5; count as usize]);
    }
}

#[test]
fn an_empty_scene_has_an_empty_root() {
    let tree = build(&Scene::default(), 0);
    assert_eq!((tree.nodes.len(), tree.triangles.len()), (1, 0));
    assert_eq!(tree.nodes[0].kinds, 0);
}

#[test]
fn a_hierarchy_beyond_the_longest_stack_is_refused() {
    let mut tree = build(&scene(nested(30, 0.5), 1), 0);
    assert_eq!(tree.stack(), 32);
    tree.levels = 33;
    assert_eq!(tree.stack(), 64);
    tree.levels = 513;
    let error = tree.fits().expect_err("too deep");
    assert_eq!(
        error,
        TraceError::TooDeep {
            levels: 513,
            most: 512
        }
    );
}
