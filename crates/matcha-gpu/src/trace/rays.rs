//! Rays and hits as the device has them: a row a component.

use matcha_render::accel::{Hit, NOTHING, Ray};

/// Rows of rays: origin, direction, ends, mask, and what is excluded.
pub const RAY_ROWS: usize = 11;
/// Rows of hits: distance, two weights, instance, primitive.
pub const HIT_ROWS: usize = 5;

/// Rays in rows. Infinite ends become the largest number.
pub fn ray_rows(rays: &[Ray]) -> Vec<u32> {
    let mut rows = Vec::with_capacity(RAY_ROWS * rays.len());
    for axis in 0..3 {
        rows.extend(rays.iter().map(|ray| ray.origin[axis].to_bits()));
    }
    for axis in 0..3 {
        rows.extend(rays.iter().map(|ray| ray.direction[axis].to_bits()));
    }
    rows.extend(rays.iter().map(|ray| ray.t_min.to_bits()));
    rows.extend(rays.iter().map(|ray| ray.t_max.min(f32::MAX).to_bits()));
    rows.extend(rays.iter().map(|ray| u32::from(ray.mask)));
    for which in 0..2 {
        rows.extend(rays.iter().map(|ray| ray.excluded[which]));
    }
    rows
}

/// Hits from rows.
pub fn hits_of_rows(rows: &[u32]) -> Vec<Option<Hit>> {
    let count = rows.len() / HIT_ROWS;
    let word = |row: usize, i: usize| rows[row * count + i];
    let hit = |i: usize| Hit {
        instance: word(3, i),
        primitive: word(4, i),
        t: f32::from_bits(word(0, i)),
        u: f32::from_bits(word(1, i)),
        v: f32::from_bits(word(2, i)),
    };
    (0..count)
        .map(hit)
        .map(|hit| (hit.instance != NOTHING).then_some(hit))
        .collect()
}
