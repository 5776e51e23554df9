//! Builds the light tree: top-down by the surface area orientation heuristic over bins
//! (Conty Estevez and Kulla 2018, §4.4), in parallel; exact bounds bottom-up.

use crate::device::light_importance::LightBounds;
use glam::{Vec3, Vec4};
use matcha_shade::device::math::{clamp, to_int};
use rayon::prelude::*;

/// Bins per axis.
const BINS: usize = 12;
/// Below this depth halves are equal, which bounds the depth of the recursion.
const DEEP: u32 = 36;
/// Smaller jobs stay on their thread.
const PARALLEL: usize = 4096;

/// What the choice of splits reads of an emitter, in vectors that a register holds.
#[derive(Clone, Copy)]
struct Item {
    /// Low corner of the box; the fourth number is 0.
    low: Vec4,
    /// High corner of the box.
    high: Vec4,
    /// Axis times the weight of its direction in a cluster; power.
    sum: Vec4,
    emitter: u32,
}

impl Item {
    fn new(bounds: &LightBounds, emitter: u32) -> Self {
        // Either direction stands for a two-sided light: take one half space's.
        let sign = if bounds.two_sided && bounds.axis.dot(HALF_SPACE) < 0.0 {
            -1.0
        } else {
            1.0
        };
        let sharpness = 0.5 + 0.5 * bounds.cos_normals;
        let axis = bounds.axis * (bounds.power * sign * sharpness);
        Self {
            low: bounds.low.extend(0.0),
            high: bounds.high.extend(0.0),
            sum: axis.extend(bounds.power),
            emitter,
        }
    }

    fn centroid(&self) -> Vec4 {
        (self.low + self.high) * 0.5
    }
}

/// A node of the binary tree.
#[derive(Clone, Copy, Debug)]
pub struct BinaryNode {
    /// Bounds of all that is below.
    pub bounds: LightBounds,
    /// What is below.
    pub link: BinaryLink,
}

/// What a node of the binary tree leads to.
#[derive(Clone, Copy, Debug)]
pub enum BinaryLink {
    /// One emitter.
    Emitter(u32),
    /// Index of the first of two children side by side.
    Children(u32),
}

/// Nodes of the binary tree, root first.
pub fn build(bounds: &[LightBounds]) -> Vec<BinaryNode> {
    let Some(&some) = bounds.first() else {
        return Vec::new();
    };
    let mut items: Vec<Item> = bounds
        .par_iter()
        .enumerate()
        .map(|(emitter, b)| Item::new(b, emitter as u32))
        .collect();
    let blank = BinaryNode {
        bounds: some,
        link: BinaryLink::Emitter(0),
    };
    let mut nodes = vec![blank; 2 * items.len() - 1];
    let (root, rest) = nodes.split_first_mut().expect("there is one node at least");
    let job = Job {
        node: root,
        rest,
        first: 1,
        items: &mut items,
        depth: 0,
    };
    build_node(bounds, job);
    nodes
}

/// A sub-tree to build: its root, room for its other nodes, and where that room starts.
struct Job<'a> {
    node: &'a mut BinaryNode,
    rest: &'a mut [BinaryNode],
    first: u32,
    items: &'a mut [Item],
    depth: u32,
}

/// Builds a sub-tree over emitters with these bounds; returns the bounds of all of it.
fn build_node(emitters: &[LightBounds], job: Job<'_>) -> LightBounds {
    if let [item] = job.items {
        let bounds = emitters[item.emitter as usize];
        let link = BinaryLink::Emitter(item.emitter);
        *job.node = BinaryNode { bounds, link };
        return bounds;
    }
    let middle = if job.depth < DEEP {
        split(job.items)
    } else {
        job.items.len() / 2
    };
    let parallel = job.items.len() > PARALLEL;
    let (left_items, right_items) = job.items.split_at_mut(middle);
    let (children, rest) = job.rest.split_at_mut(2);
    let (left_rest, right_rest) = rest.split_at_mut(2 * middle - 2);
    let (left_node, right_node) = children.split_at_mut(1);
    let left = Job {
        node: &mut left_node[0],
        rest: left_rest,
        first: job.first + 2,
        items: left_items,
        depth: job.depth + 1,
    };
    let right = Job {
        node: &mut right_node[0],
        rest: right_rest,
        first: job.first + 2 * middle as u32,
        items: right_items,
        depth: job.depth + 1,
    };
    let (a, b) = if parallel {
        rayon::join(
            || build_node(emitters, left),
            || build_node(emitters, right),
        )
    } else {
        (build_node(emitters, left), build_node(emitters, right))
    };
    let bounds = unite(&a, &b);
    *job.node = BinaryNode {
        bounds,
        link: BinaryLink::Children(job.first),
    };
    bounds
}

/// Smallest bounds that hold both (cones: Conty Estevez and Kulla 2018, algorithm 1).
pub fn unite(a: &LightBounds, b: &LightBounds) -> LightBounds {
    let flip = a.two_sided && b.two_sided && a.axis.dot(b.axis) < 0.0;
    let (axis, cos_normals) = unite_cones(
        a.axis,
        a.cos_normals,
        if flip { -b.axis } else { b.axis },
        b.cos_normals,
    );
    LightBounds {
        low: a.low.min(b.low),
        high: a.high.max(b.high),
        axis,
        cos_normals,
        cos_emission: a.cos_emission.min(b.cos_emission),
        power: a.power + b.power,
        two_sided: a.two_sided || b.two_sided,
    }
}

fn unite_cones(a: Vec3, cos_a: f32, b: Vec3, cos_b: f32) -> (Vec3, f32) {
    if a == b {
        return (a, cos_a.min(cos_b));
    }
    let (wide, cos_wide, narrow, cos_narrow) = if cos_a <= cos_b {
        (a, cos_a, b, cos_b)
    } else {
        (b, cos_b, a, cos_a)
    };
    let angle = wide.dot(narrow).clamp(-1.0, 1.0).acos();
    let (half_wide, half_narrow) = (cos_wide.acos(), cos_narrow.acos());
    if (angle + half_narrow).min(std::f32::consts::PI) <= half_wide {
        return (wide, cos_wide);
    }
    let half = 0.5 * (half_wide + angle + half_narrow);
    let across = narrow - wide * wide.dot(narrow);
    if half >= std::f32::consts::PI || across.length_squared() < 1e-12 {
        return (wide, -1.0);
    }
    let turn = half - half_wide;
    let axis = wide * turn.cos() + across.normalize() * turn.sin();
    // A little wider than rounding could make it too narrow.
    (
        axis.normalize(),
        (half + 1e-4).min(std::f32::consts::PI).cos(),
    )
}

/// Sums over the items of a bin, or of one side of a split.
#[derive(Clone, Copy)]
struct Bin {
    low: Vec4,
    high: Vec4,
    /// Of the weighted axes and of powers.
    sum: Vec4,
    count: u32,
}

const EMPTY: Bin = Bin {
    low: Vec4::INFINITY,
    high: Vec4::NEG_INFINITY,
    sum: Vec4::ZERO,
    count: 0,
};

impl Bin {
    fn add(&mut self, item: &Item) {
        self.low = self.low.min(item.low);
        self.high = self.high.max(item.high);
        self.sum += item.sum;
        self.count += 1;
    }

    fn join(&mut self, other: &Bin) {
        self.low = self.low.min(other.low);
        self.high = self.high.max(other.high);
        self.sum += other.sum;
        self.count += other.count;
    }

    /// Power times area times a measure of the spread of normals. The measure only chooses
    /// splits, so the mean direction's length stands in for the bounding cone, whose union
    /// would cost more than the rest of the build.
    fn cost(&self, diagonal: f32) -> f32 {
        let size = (self.high - self.low).max(Vec4::splat(1e-3 * diagonal));
        let area = size.x * size.y + size.y * size.z + size.z * size.x;
        let (axis, power) = (self.sum.truncate(), self.sum.w);
        let spread = 1.0 - (axis.length() / power.max(1e-30)).min(1.0);
        power * area * (1.0 + 3.0 * spread)
    }
}

/// No plane through the origin with a simple equation is perpendicular to it.
const HALF_SPACE: Vec3 = Vec3::new(0.31, 0.47, 0.83);

/// Reorders the items into two groups; returns the size of the first, never 0 or all.
fn split(items: &mut [Item]) -> usize {
    let half = items.len() / 2;
    if items.len() == 2 {
        return half;
    }
    let (mut low, mut high) = (Vec4::INFINITY, Vec4::NEG_INFINITY);
    for item in items.iter() {
        low = low.min(item.centroid());
        high = high.max(item.centroid());
    }
    let extent = (high - low).truncate();
    if !extent.is_finite() || extent.max_element() <= 0.0 {
        return half;
    }
    let scale =
        Vec3::select(extent.cmpgt(Vec3::ZERO), BINS as f32 / extent, Vec3::ZERO).extend(0.0);
    let mut bins = [[EMPTY; BINS]; 3];
    for item in items.iter() {
        let places = (item.centroid() - low) * scale;
        for axis in 0..3 {
            bins[axis][bin_of(places[axis])].add(item);
        }
    }
    let Some((axis, boundary)) = cheapest(&bins, extent) else {
        return half;
    };
    let (start, scale) = (low[axis], scale[axis]);
    let middle = partition(items, |item| {
        // Through arrays: indexing a vector branches.
        let (low, high): (&[f32; 4], &[f32; 4]) = (item.low.as_ref(), item.high.as_ref());
        let centroid = (low[axis] + high[axis]) * 0.5;
        bin_of((centroid - start) * scale) < boundary
    });
    if middle == 0 || middle == items.len() {
        half
    } else {
        middle
    }
}

/// Bin of a place from 0 to [`BINS`].
#[inline(always)]
fn bin_of(place: f32) -> usize {
    to_int(clamp(place, 0.0, BINS as f32 - 1.0)) as usize
}

/// Axis and first bin of the second group of the cheapest split.
fn cheapest(bins: &[[Bin; BINS]; 3], extent: Vec3) -> Option<(usize, usize)> {
    let mut best = None;
    let mut least = f32::INFINITY;
    let mut after = [EMPTY; BINS];
    for (axis, bins) in bins.iter().enumerate() {
        if extent[axis] <= 0.0 {
            continue;
        }
        // Long sides are better cut (the paper's regularisation of thin boxes).
        let thinness = extent.max_element() / extent[axis];
        let (filled, count) = filled(bins);
        let mut all = EMPTY;
        for k in (0..count).rev() {
            all.join(&bins[filled[k]]);
            after[k] = all;
        }
        let diagonal = (all.high - all.low).truncate().length();
        let mut before = EMPTY;
        for k in 1..count {
            before.join(&bins[filled[k - 1]]);
            let cost = thinness * (before.cost(diagonal) + after[k].cost(diagonal));
            if cost < least {
                least = cost;
                best = Some((axis, filled[k]));
            }
        }
    }
    best
}

/// Bins with items, and how many there are: few where the items are few.
fn filled(bins: &[Bin; BINS]) -> ([usize; BINS], usize) {
    let mut filled = [0; BINS];
    let mut count = 0;
    for (i, bin) in bins.iter().enumerate() {
        if bin.count > 0 {
            filled[count] = i;
            count += 1;
        }
    }
    (filled, count)
}

/// Moves the items that satisfy the predicate to the front; returns their number.
fn partition(items: &mut [Item], first: impl Fn(&Item) -> bool) -> usize {
    let mut end = 0;
    for i in 0..items.len() {
        if first(&items[i]) {
            if i != end {
                items.swap(i, end);
            }
            end += 1;
        }
    }
    end
}
