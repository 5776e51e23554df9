//! From a scene to the structure that rays walk through.
//!
//! Two levels where meshes are shared. But boxes of instances overlap, and each one that a ray
//! enters costs a transform and a walk of its own; so as many instances as fit a budget are copied
//! into world space, into ONE hierarchy whose leaves are triangles or whole instances.

use super::collapse::{Leaves, collapse};
use super::memory::in_huge_pages;
use super::node::{Bounds, LEAF_PACKS, Link, Node, PACK, Pack};
use super::ray::visibility_mask;
use super::traverse::Placement;
use super::{Accel, AccelError, Isa};
use crate::scene::{Mesh, Scene};
use glam::{Affine3A, Vec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::bvh2::{Bvh2, reinsertion::ReinsertionOptimizer};
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};
use obvhs::splits::split_aabbs_preset;
use obvhs::triangle::Triangle;

/// How a structure is built.
#[derive(Clone, Copy, Debug)]
pub struct BuildOptions {
    /// Number of triangles that may be copied into world space (about 70 bytes each); by default
    /// as many as the meshes have, so that the structure at most doubles. More was measured to
    /// lose in caches what it saves in transforms.
    pub flat_triangles: Option<usize>,
    /// Splits the boxes of large triangles.
    pub pre_split: bool,
    /// Share of the nodes that are tried at better places; 0 to 1.
    pub reinsertion: f32,
}

impl Default for BuildOptions {
    fn default() -> Self {
        Self {
            flat_triangles: None,
            pre_split: true,
            reinsertion: 0.15,
        }
    }
}

/// A triangle in the space of its hierarchy, with what a hit reports.
#[derive(Clone, Copy)]
struct Item {
    corners: [Vec3; 3],
    primitive: u32,
    instance: u32,
}

/// Primitives of one hierarchy: triangles, then placements.
#[derive(Default)]
struct Primitives {
    triangles: Vec<Item>,
    /// Boxes of instances and their place in the table of placements.
    instances: Vec<(Bounds, u32)>,
}

struct LeafWriter<'a> {
    primitives: &'a Primitives,
    packs: &'a mut Vec<Pack>,
    scratch: Vec<u32>,
}

impl Leaves for LeafWriter<'_> {
    fn can_share(&self, primitive: u32) -> bool {
        (primitive as usize) < self.primitives.triangles.len()
    }

    fn write(&mut self, members: &[u32]) -> Link {
        let triangles = &self.primitives.triangles;
        if let &[one] = members
            && one as usize >= triangles.len()
        {
            let (_, placement) = self.primitives.instances[one as usize - triangles.len()];
            return Link::instance(placement as usize);
        }
        // Where boxes of a triangle were split, several of them may have met again.
        self.scratch.clear();
        self.scratch.extend_from_slice(members);
        self.scratch.sort_unstable();
        self.scratch.dedup();
        let first = self.packs.len();
        for chunk in self.scratch.chunks(PACK) {
            let mut pack = Pack::EMPTY;
            for (lane, &member) in chunk.iter().enumerate() {
                let item = &triangles[member as usize];
                pack.set(lane, item.corners, item.primitive, item.instance);
            }
            self.packs.push(pack);
        }
        debug_assert!(self.packs.len() - first <= LEAF_PACKS);
        Link::leaf(first, self.packs.len() - first)
    }
}

/// The structure while it grows.
#[derive(Default)]
struct Builder {
    nodes: Vec<Node>,
    packs: Vec<Pack>,
    dropped: usize,
}

impl Builder {
    /// Adds a hierarchy over primitives; none if there are none.
    fn add(
        &mut self,
        primitives: &Primitives,
        options: &BuildOptions,
    ) -> Result<Option<(Link, usize)>, AccelError> {
        if primitives.triangles.is_empty() && primitives.instances.is_empty() {
            return Ok(None);
        }
        let tree = binary_tree(primitives, options);
        let worst = self.packs.len().max(self.nodes.len()) + tree.nodes.len();
        if worst >= Link::LIMIT {
            return Err(AccelError::TooLarge { limit: Link::LIMIT });
        }
        let mut leaves = LeafWriter {
            primitives,
            packs: &mut self.packs,
            scratch: Vec::new(),
        };
        Ok(Some(collapse(&tree, &mut self.nodes, &mut leaves)))
    }

    /// Triangles of a mesh, moved by a transform; those that nothing can hit are left out.
    fn gather(
        &mut self,
        mesh: &Mesh,
        transform: Option<&Affine3A>,
        instance: u32,
        into: &mut Vec<Item>,
    ) -> Result<(), AccelError> {
        into.reserve(mesh.indices.len());
        for (primitive, indices) in mesh.indices.iter().enumerate() {
            let corner = |vertex: u32| {
                mesh.positions.get(vertex as usize).copied().ok_or_else(|| {
                    AccelError::VertexIndex {
                        mesh: mesh.name.clone(),
                        triangle: primitive,
                        vertex,
                        vertices: mesh.positions.len(),
                    }
                })
            };
            let mut corners = [
                corner(indices[0])?,
                corner(indices[1])?,
                corner(indices[2])?,
            ];
            if let Some(transform) = transform {
                corners = corners.map(|p| transform.transform_point3(p));
            }
            if is_hittable(corners) {
                into.push(Item {
                    corners,
                    primitive: primitive as u32,
                    instance,
                });
            } else {
                self.dropped += 1;
            }
        }
        Ok(())
    }
}

/// Coordinates beyond have squares that are no numbers, metres.
const FARTHEST: f32 = 1e18;

/// True if a place has coordinates whose squares are numbers.
pub fn is_near(place: Vec3) -> bool {
    place.is_finite() && place.abs().max_element() < FARTHEST
}

/// False for triangles without area, or with coordinates whose squares are no numbers.
pub fn is_hittable(corners: [Vec3; 3]) -> bool {
    let [a, b, c] = corners;
    let area = (b - a).cross(c - a).length_squared();
    corners.iter().all(|&p| is_near(p))
        && area.is_finite()
        && (b - a) != Vec3::ZERO
        && (c - a) != Vec3::ZERO
        && b != c
}

/// Boxes of triangles, large ones split, and the triangle of each box.
fn triangle_boxes(items: &[Item], pre_split: bool) -> (Vec<Aabb>, Vec<u32>) {
    let triangles: Vec<Triangle> = items
        .iter()
        .map(|item| {
            let [v0, v1, v2] = item.corners.map(Vec3A::from);
            Triangle { v0, v1, v2 }
        })
        .collect();
    let mut boxes: Vec<Aabb> = triangles.iter().map(Triangle::aabb).collect();
    let mut indices: Vec<u32> = (0..boxes.len() as u32).collect();
    if !pre_split || boxes.is_empty() {
        return (boxes, indices);
    }
    let areas = boxes.iter().map(Aabb::half_area);
    let largest = areas.clone().fold(0.0, f32::max);
    let mean = (areas.map(f64::from).sum::<f64>() / boxes.len() as f64) as f32;
    split_aabbs_preset(&mut boxes, &mut indices, &triangles, mean, largest);
    // The splitter rounds where an edge crosses a plane: without slack a ray could pass between
    // two boxes of a triangle. What is inside out even so holds no part of the triangle.
    let mut kept = 0;
    for i in 0..boxes.len() {
        let whole = triangles[indices[i] as usize].aabb();
        let slack = whole.max.abs().max(whole.min.abs()) * (4.0 * f32::EPSILON);
        let grown = Aabb::new(
            (boxes[i].min - slack).max(whole.min),
            (boxes[i].max + slack).min(whole.max),
        );
        if grown.min.cmple(grown.max).all() {
            boxes[kept] = grown;
            indices[kept] = indices[i];
            kept += 1;
        }
    }
    boxes.truncate(kept);
    indices.truncate(kept);
    (boxes, indices)
}

fn binary_tree(primitives: &Primitives, options: &BuildOptions) -> Bvh2 {
    let (mut boxes, mut members) = triangle_boxes(&primitives.triangles, options.pre_split);
    for (i, (bounds, _)) in primitives.instances.iter().enumerate() {
        boxes.push(Aabb::new(bounds.min.into(), bounds.max.into()));
        members.push((primitives.triangles.len() + i) as u32);
    }
    let mut tree = PlocBuilder::with_capacity(boxes.len()).build(
        PlocSearchDistance::Medium,
        &boxes,
        (0..boxes.len() as u32).collect(),
        SortPrecision::U64,
        2,
    );
    // The builder's leaves name boxes, in the order given to it.
    tree.primitive_indices = members;
    tree.uses_spatial_splits = options.pre_split;
    if options.reinsertion > 0.0 {
        ReinsertionOptimizer::default().run(&mut tree, options.reinsertion, None);
    }
    tree
}

/// Instances to copy into world space: those whose mesh is used once first, then small ones.
fn choose_flat(scene: &Scene, budget: usize) -> Result<Vec<bool>, AccelError> {
    let mut uses = vec![0usize; scene.meshes.len()];
    for instance in &scene.instances {
        let count = uses
            .get_mut(instance.mesh as usize)
            .ok_or_else(|| AccelError::MeshIndex {
                instance: instance.name.clone(),
                mesh: instance.mesh,
                meshes: scene.meshes.len(),
            })?;
        *count += 1;
    }
    let mut flat = vec![false; scene.instances.len()];
    let mut order: Vec<usize> = (0..scene.instances.len()).collect();
    let triangles = |i: usize| scene.meshes[scene.instances[i].mesh as usize].indices.len();
    order.sort_by_key(|&i| (uses[scene.instances[i].mesh as usize] > 1, triangles(i), i));
    let mut left = budget;
    for i in order {
        let single = uses[scene.instances[i].mesh as usize] == 1;
        let singular = !scene.instances[i].transform.inverse().is_finite();
        if single || singular || triangles(i) <= left {
            left = left.saturating_sub(triangles(i));
            flat[i] = true;
        }
    }
    Ok(flat)
}

fn placed_bounds(items: &[Item], transform: &Affine3A) -> Bounds {
    let mut bounds = Bounds::EMPTY;
    for item in items {
        for corner in item.corners {
            bounds.grow(transform.transform_point3(corner));
        }
    }
    // The walk's ray is transformed, not the triangles: both round.
    let slack = (bounds.max.abs().max(bounds.min.abs())) * (8.0 * f32::EPSILON);
    Bounds {
        min: bounds.min - slack,
        max: bounds.max + slack,
    }
}

/// Builds the structure of a scene.
pub(super) fn build(scene: &Scene, options: &BuildOptions) -> Result<Accel, AccelError> {
    let meshes = scene.meshes.iter().map(|mesh| mesh.indices.len());
    let budget = options.flat_triangles.unwrap_or_else(|| meshes.sum());
    let flat = choose_flat(scene, budget)?;
    let mut builder = Builder::default();
    let mut top = Primitives::default();
    let mut placements: Vec<Placement> = Vec::new();
    let mut depth = 0;
    let mut placed_by_mesh: Vec<Vec<usize>> = vec![Vec::new(); scene.meshes.len()];
    for (i, instance) in scene.instances.iter().enumerate() {
        if visibility_mask(&instance.visibility) == 0 {
            continue;
        }
        if flat[i] {
            let mesh = &scene.meshes[instance.mesh as usize];
            builder.gather(
                mesh,
                Some(&instance.transform),
                i as u32,
                &mut top.triangles,
            )?;
        } else {
            placed_by_mesh[instance.mesh as usize].push(i);
        }
    }
    for (mesh, users) in scene.meshes.iter().zip(&placed_by_mesh) {
        if users.is_empty() {
            continue;
        }
        let mut own = Primitives::default();
        builder.gather(mesh, None, u32::MAX, &mut own.triangles)?;
        let Some((root, needed)) = builder.add(&own, options)? else {
            continue;
        };
        depth = depth.max(needed);
        for &i in users {
            let transform = scene.instances[i].transform;
            let bounds = placed_bounds(&own.triangles, &transform);
            if !(is_near(bounds.min) && is_near(bounds.max)) {
                builder.dropped += own.triangles.len();
                continue;
            }
            top.instances.push((bounds, placements.len() as u32));
            placements.push(Placement {
                inverse: transform.inverse(),
                root,
                instance: i as u32,
            });
        }
    }
    let root = builder.add(&top, options)?;
    let (root, needed) = root.unwrap_or((Link::EMPTY, 0));
    Ok(Accel {
        nodes: if root == Link::EMPTY {
            Vec::new()
        } else {
            in_huge_pages(builder.nodes)
        },
        packs: in_huge_pages(builder.packs),
        placements,
        masks: scene
            .instances
            .iter()
            .map(|i| visibility_mask(&i.visibility))
            .collect(),
        root,
        depth: depth + needed + 1,
        dropped: builder.dropped,
        isa: Isa::detect(),
    })
}
