//! The walk of a ray through the hierarchy.

use super::kernel::{Kernel, PackHits};
use super::node::{Link, Node, Pack};
use super::ray::{Hit, NOTHING, Ray};
use glam::{Affine3A, Vec3};
use std::mem::MaybeUninit;

/// Stack entries that a walk has without allocating.
pub(super) const STACK: usize = 384;

/// A mesh that is placed and not copied into world space.
#[derive(Clone, Debug)]
pub struct Placement {
    /// World to object.
    pub inverse: Affine3A,
    /// Root of the mesh's hierarchy.
    pub root: Link,
    /// Index into `Scene::instances`.
    pub instance: u32,
}

/// What a walk reads.
#[derive(Clone, Copy, Debug)]
pub struct Tree<'a> {
    /// Nodes of all hierarchies.
    pub nodes: &'a [Node],
    /// Triangles of all leaves.
    pub packs: &'a [Pack],
    /// Instances that are not copied into world space.
    pub placements: &'a [Placement],
    /// Visibility bits per instance.
    pub masks: &'a [u8],
    /// Where a walk starts; [`Link::EMPTY`] in an empty scene.
    pub root: Link,
}

/// A child to visit: entry distance in the upper half, link in the lower, so that integers order
/// by distance (which is never negative).
type Pending = u64;

#[inline(always)]
fn pending(entry: f32, link: Link) -> Pending {
    (u64::from(entry.to_bits()) << 32) | u64::from(link.0)
}

#[inline(always)]
fn entry_of(pending: Pending) -> f32 {
    f32::from_bits((pending >> 32) as u32)
}

/// Brings the farthest of a few entries to the front, so that the nearest is popped first.
#[inline(always)]
fn sort_far_first(entries: &mut [Pending]) {
    for i in 1..entries.len() {
        let moving = entries[i];
        let mut j = i;
        while j > 0 && entries[j - 1] < moving {
            entries[j] = entries[j - 1];
            j -= 1;
        }
        entries[j] = moving;
    }
}

#[inline(always)]
fn prefetch(tree: &Tree, link: Link) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        if link.is_node() {
            let at = tree.nodes.as_ptr().wrapping_add(link.index()).cast::<i8>();
            for line in 0..4 {
                // SAFETY: a prefetch reads nothing, whatever the address.
                unsafe { _mm_prefetch::<_MM_HINT_T0>(at.wrapping_add(64 * line)) };
            }
        } else if link.is_leaf() {
            let at = tree.packs.as_ptr().wrapping_add(link.index()).cast::<i8>();
            for line in 0..3 {
                // SAFETY: as above.
                unsafe { _mm_prefetch::<_MM_HINT_T0>(at.wrapping_add(64 * line)) };
            }
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (tree, link);
}

/// The nearest hit so far.
struct Nearest {
    t: f32,
    u: f32,
    v: f32,
    instance: u32,
    primitive: u32,
}

/// Takes the nearest acceptable hit of a pack; true if there was one.
#[inline(always)]
fn accept(
    tree: &Tree,
    ray: &Ray,
    pack: &Pack,
    hits: &PackHits,
    inside: u32,
    nearest: &mut Nearest,
) -> bool {
    let mut mask = hits.mask;
    let mut any = false;
    while mask != 0 {
        let lane = mask.trailing_zeros() as usize & 3;
        mask &= mask - 1;
        if hits.t[lane] >= nearest.t {
            continue;
        }
        let instance = if inside == NOTHING {
            pack.instance[lane]
        } else {
            inside
        };
        let primitive = pack.primitive[lane];
        let seen = tree
            .masks
            .get(instance as usize)
            .is_some_and(|m| m & ray.mask != 0);
        if !seen || (ray.excluded[1] == primitive && ray.excluded[0] == instance) {
            continue;
        }
        *nearest = Nearest {
            t: hits.t[lane],
            u: hits.u[lane],
            v: hits.v[lane],
            instance,
            primitive,
        };
        any = true;
    }
    any
}

/// Walks; the stack holds as many entries as the tree needs at most.
#[inline(always)]
fn walk<K: Kernel, const ANY: bool>(
    tree: &Tree,
    ray: &Ray,
    stack: &mut [MaybeUninit<Pending>],
) -> Option<Hit> {
    let world = K::new(ray.origin, ray.direction, ray.t_min);
    let mut kernel = world;
    let mut nearest = Nearest {
        t: ray.t_max,
        u: 0.0,
        v: 0.0,
        instance: NOTHING,
        primitive: NOTHING,
    };
    let mut inside = NOTHING;
    let mut top = 0usize;
    let mut link = tree.root;
    loop {
        while link.is_node() {
            let node = &tree.nodes[link.index()];
            let hits = kernel.boxes(node, nearest.t);
            let mut mask = hits.mask;
            if mask == 0 {
                link = Link::EMPTY;
                break;
            }
            let base = top;
            loop {
                let child = mask.trailing_zeros() as usize & 7;
                mask &= mask - 1;
                let target = node.children[child];
                prefetch(tree, target);
                if mask == 0 && base == top {
                    link = target;
                    break;
                }
                stack[top].write(pending(hits.entry[child], target));
                top += 1;
                if mask == 0 {
                    // SAFETY: entries below `top` have been written.
                    let fresh = unsafe { stack[base..top].assume_init_mut() };
                    if !ANY {
                        sort_far_first(fresh);
                    }
                    top -= 1;
                    link = Link(fresh[fresh.len() - 1] as u32);
                    break;
                }
            }
        }
        if link.is_leaf() {
            let first = link.index();
            for pack in &tree.packs[first..first + link.packs()] {
                let hits = kernel.triangles(pack, nearest.t);
                if hits.mask != 0 && accept(tree, ray, pack, &hits, inside, &mut nearest) && ANY {
                    return hit(&nearest);
                }
            }
        } else if link.is_instance() {
            let placement = &tree.placements[link.index()];
            stack[top].write(pending(0.0, Link::RESTORE));
            top += 1;
            inside = placement.instance;
            let origin: Vec3 = placement.inverse.transform_point3(ray.origin);
            let direction = placement.inverse.transform_vector3(ray.direction);
            kernel = K::new(origin, direction, ray.t_min);
            link = placement.root;
            continue;
        }
        loop {
            if top == 0 {
                return hit(&nearest);
            }
            top -= 1;
            // SAFETY: entries below the old `top` have been written.
            let next = unsafe { stack[top].assume_init() };
            link = Link(next as u32);
            if link == Link::RESTORE {
                kernel = world;
                inside = NOTHING;
            } else if ANY || entry_of(next) < nearest.t {
                break;
            }
        }
    }
}

#[inline(always)]
fn hit(nearest: &Nearest) -> Option<Hit> {
    let &Nearest {
        t,
        u,
        v,
        instance,
        primitive,
    } = nearest;
    (instance != NOTHING).then_some(Hit {
        instance,
        primitive,
        t,
        u,
        v,
    })
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
fn walk_avx2<const ANY: bool>(
    tree: &Tree,
    ray: &Ray,
    stack: &mut [MaybeUninit<Pending>],
) -> Option<Hit> {
    walk::<super::kernel_avx2::Avx2, ANY>(tree, ray, stack)
}

fn walk_portable<const ANY: bool>(
    tree: &Tree,
    ray: &Ray,
    stack: &mut [MaybeUninit<Pending>],
) -> Option<Hit> {
    walk::<super::kernel::Portable, ANY>(tree, ray, stack)
}

/// Instructions that a walk is compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Isa {
    /// AVX2.
    #[cfg(target_arch = "x86_64")]
    Avx2,
    /// What every processor of the target has.
    Portable,
}

impl Isa {
    /// The best that this processor has.
    pub(super) fn detect() -> Self {
        #[cfg(target_arch = "x86_64")]
        if std::is_x86_feature_detected!("avx2")
            && std::is_x86_feature_detected!("bmi1")
            && std::is_x86_feature_detected!("bmi2")
            && std::is_x86_feature_detected!("lzcnt")
            && std::is_x86_feature_detected!("popcnt")
        {
            return Self::Avx2;
        }
        Self::Portable
    }
}

/// Walks with the given instructions; `depth` is the number of stack entries that may be needed.
#[inline]
pub(super) fn trace<const ANY: bool>(
    tree: &Tree,
    ray: &Ray,
    isa: Isa,
    depth: usize,
) -> Option<Hit> {
    if tree.nodes.is_empty() || !ray.is_sound() {
        return None;
    }
    if depth <= STACK {
        let mut stack = [MaybeUninit::uninit(); STACK];
        dispatch::<ANY>(tree, ray, isa, &mut stack)
    } else {
        dispatch::<ANY>(tree, ray, isa, &mut vec![MaybeUninit::uninit(); depth])
    }
}

#[inline(always)]
fn dispatch<const ANY: bool>(
    tree: &Tree,
    ray: &Ray,
    isa: Isa,
    stack: &mut [MaybeUninit<Pending>],
) -> Option<Hit> {
    match isa {
        #[cfg(target_arch = "x86_64")]
        // SAFETY: `Isa::Avx2` is only made where the processor has the features.
        Isa::Avx2 => unsafe { walk_avx2::<ANY>(tree, ray, stack) },
        Isa::Portable => walk_portable::<ANY>(tree, ray, stack),
    }
}
