//! Which slot a child takes.

use glam::Vec3;
use matcha_render::accel::{Bounds, WIDTH};

/// The corner of a node that a slot stands for: bits 0, 1 and 2 say "the upper half" of x, y, z.
fn corner(slot: usize) -> Vec3 {
    let side = |axis: usize| if slot >> axis & 1 == 1 { 1.0 } else { -1.0 };
    Vec3::new(side(0), side(1), side(2))
}

/// A slot for each child, all different: the child farthest into a corner chooses first.
///
/// A ray whose direction has the signs `s` then visits slots in the order of `slot ^ s`.
pub(super) fn slots(children: &[Bounds]) -> Vec<usize> {
    debug_assert!(children.len() <= WIDTH);
    let center = |bounds: &Bounds| bounds.min * 0.5 + bounds.max * 0.5;
    let mut whole = Bounds::EMPTY;
    for child in children {
        whole.grow(child.min);
        whole.grow(child.max);
    }
    let middle = center(&whole);
    let mut wishes: Vec<(f32, usize, usize)> = children
        .iter()
        .enumerate()
        .flat_map(|(child, bounds)| {
            let toward = center(bounds) - middle;
            (0..WIDTH).map(move |slot| (toward.dot(corner(slot)), child, slot))
        })
        .collect();
    // Ties in the order of children and slots, so that a scene always gives the same structure.
    wishes.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut taken = [false; WIDTH];
    let mut chosen = vec![usize::MAX; children.len()];
    for (_, child, slot) in wishes {
        if chosen[child] == usize::MAX && !taken[slot] {
            chosen[child] = slot;
            taken[slot] = true;
        }
    }
    chosen
}
