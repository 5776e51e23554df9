//! A region over a group: one look-up for all points, then its words over those that
//! were not found.

use crate::device::texel::{texel_centre, texel_index, texel_level, texel_size};
use crate::program::Region;
use crate::vm::core::Core;
use crate::vm::{Cached, Group, NodeCache, RunCounts, Texel};
use glam::Vec2;

/// Finds or computes a region's value for every point and puts it into the rows of
/// `cached.results` from `first` on.
pub(super) fn run<const N: usize>(
    group: &Group,
    region: &Region,
    core: &mut Core<N>,
    cached: &mut Cached,
    cache: Option<&mut dyn NodeCache>,
    first: usize,
    counts: &mut RunCounts,
) {
    let n = group.n;
    let width = region.ty.width();
    find_texels(group, region, &mut cached.texels);
    cached.found.clear();
    cached.found.resize(n, false);
    cached.missed.clear();
    let Some(cache) = cache else {
        cached.missed.extend(0..n as u32);
        evaluate(region, core, cached);
        scatter(cached, first, width);
        return;
    };
    cached.values.resize(width, n);
    cache.look_up(
        region,
        &cached.texels,
        &mut cached.values,
        &mut cached.found,
    );
    for i in 0..width {
        cached.results.row_mut(first + i)[..n].copy_from_slice(&cached.values.row(i)[..n]);
    }
    let found = &cached.found;
    cached
        .missed
        .extend((0..n as u32).filter(|&i| !found[i as usize]));
    counts.look_ups += n as u64;
    counts.found += (n - cached.missed.len()) as u64;
    if cached.missed.is_empty() {
        return;
    }
    evaluate(region, core, cached);
    cache.store(region, &cached.texels, &cached.missed, &cached.computed);
    scatter(cached, first, width);
}

fn find_texels(group: &Group, region: &Region, texels: &mut Vec<Texel>) {
    let [uv, a, b] = region.uv_rows.map(|row| {
        let pair = [group.inputs.row(row), group.inputs.row(row + 1)];
        pair.map(|r| &r[..group.n])
    });
    let scale_squared = (-2.0 * group.level_offset).exp2();
    texels.clear();
    texels.extend((0..group.n).map(|k| {
        let at = |rows: [&[f32]; 2]| Vec2::new(rows[0][k], rows[1][k]);
        let level = texel_level(at(a), at(b), scale_squared);
        let uv = at(uv);
        Texel {
            level,
            i: texel_index(uv.x, level),
            j: texel_index(uv.y, level),
        }
    }));
}

/// Runs the region's words over the missed points' texels.
fn evaluate<const N: usize>(region: &Region, core: &mut Core<N>, cached: &mut Cached) {
    let Cached {
        computed,
        texels,
        missed,
        ..
    } = cached;
    let width = region.ty.width();
    let lookup = core.word(region.words.start);
    let store = core.word(region.words.end - 1);
    computed.resize(width, missed.len());
    for (chunk, which) in missed.chunks(N).enumerate() {
        let mut rows = [[0.0f32; N]; 3];
        for (lane, &k) in which.iter().enumerate() {
            let Texel { level, i, j } = texels[k as usize];
            let centre = texel_centre(i, j, level);
            rows[0][lane] = centre.x;
            rows[1][lane] = centre.y;
            rows[2][lane] = texel_size(level);
        }
        for (i, row) in rows.iter().enumerate() {
            core.load(lookup.dst as usize + i, row, which.len());
        }
        core.execute(region.words.start + 1..region.words.end - 1, which.len());
        for (i, row) in computed.rows_mut(0, width).enumerate() {
            row[chunk * N..][..N].copy_from_slice(core.value(store.src[i]));
        }
    }
}

/// From the missed points' columns to the group's.
fn scatter(cached: &mut Cached, first: usize, width: usize) {
    let Cached {
        results,
        computed,
        missed,
        ..
    } = cached;
    for i in 0..width {
        let from = computed.row(i);
        let to = results.row_mut(first + i);
        for (k, &point) in missed.iter().enumerate() {
            to[point as usize] = from[k];
        }
    }
}
