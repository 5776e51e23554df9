//! Which group of lights is tried: a binary tree is descended, each step towards a side that
//! may matter more; its root parts the local lights from those at infinity.
//!
//! A block holds two levels: lanes 0 and 1 are the two sides, lanes 2 and 3 the two sides of
//! lane 0, lanes 4 and 5 those of lane 1.

use crate::device::light_analytic::LIGHT_FAR;
use crate::device::light_group::{
    LIGHT_GROUP_RECTANGLE, LightCorners, light_corners, light_group, light_range,
};
use crate::device::light_tree::LIGHT_ONE_BELOW;
use crate::device::light_view::{
    LIGHT_GROUP_IS_BLOCK, LIGHT_GROUP_WHAT, LIGHT_NONE, LIGHT_OPENS, LIGHT_RECTANGLES,
    LIGHT_UNSURE, LightView,
};
use crate::device::light_world::light_world_factor;
use glam::Vec3;
use matcha_shade::device::math::{clamp, select};

/// Share of the samples that the root's two sides get alike. What suns and local lights bring
/// is estimated without what is in between: a sun that a roof keeps off must not starve a lamp.
pub const LIGHT_EVEN_SHARE: f32 = 0.25;

/// What the groups of a block could bring.
#[derive(Clone, Copy, Debug)]
pub struct LightRanges {
    /// Zero only where a group brings nothing.
    pub most: [f32; 8],
    /// Zero where it may bring nothing.
    pub least: [f32; 8],
}

/// What the groups of a block could bring to the point `p` with normal `n`.
#[inline(always)]
pub fn light_ranges(view: LightView, block: u32, p: Vec3, n: Vec3) -> LightRanges {
    let mut cosines = [1.0; 8];
    let mut far2 = [1.0; 8];
    let flags = view.groups[block as usize].flags;
    if (flags & LIGHT_RECTANGLES) != 0 {
        let mut lane = 0;
        while lane < 8 {
            if view.groups[block as usize].kind[lane as usize] == LIGHT_GROUP_RECTANGLE {
                let group = light_group(view, block, lane);
                let corners = light_corners(group.center - p, group.half, group.side);
                cosines[lane as usize] = corners.cosine;
                far2[lane as usize] = corners.far2;
            }
            lane += 1;
        }
    }
    let mut most = [0.0; 8];
    let mut least = [0.0; 8];
    let mut lane = 0;
    while lane < 8 {
        let corners = LightCorners {
            cosine: cosines[lane as usize],
            far2: far2[lane as usize],
        };
        let range = light_range(light_group(view, block, lane), corners, p, n);
        most[lane as usize] = range.most;
        least[lane as usize] = range.least;
        lane += 1;
    }
    let world = view.groups[block as usize].world;
    if world != LIGHT_NONE {
        most[world as usize] *= light_world_factor(view, n);
    }
    if (flags & LIGHT_UNSURE) != 0 {
        // The least that a world brings is nothing everywhere, and says nothing.
        least[0] = 0.0;
        least[1] = 0.0;
        least[4] = 0.0;
        least[5] = 0.0;
    }
    if block == 0 && (flags & (LIGHT_OPENS << 1)) != 0 {
        // Of lights at infinity the bounds of two together are no better than their sum.
        most[1] = most[4] + most[5];
    }
    LightRanges { most, least }
}

/// Probability of the first of two groups: the mean of the choice by the most and the choice
/// by the least that they bring, even where neither must bring anything.
#[inline(always)]
pub fn light_side(most: f32, least: f32, other_most: f32, other_least: f32) -> f32 {
    let sum = most + other_most;
    // Not a number and infinite sums end here too.
    if !(most > 0.0 && sum <= LIGHT_FAR) {
        return 0.0;
    }
    let sure = least + other_least;
    let by_least = select(
        select(0.5, 1.0, other_most <= 0.0),
        least / select(1.0, sure, sure > 0.0),
        sure > 0.0,
    );
    0.5 * (most / sum + by_least)
}

/// Probability with which a lane is preferred to its neighbour.
#[inline(always)]
pub fn light_lane_share(ranges: LightRanges, block: u32, lane: u32) -> f32 {
    let other = lane ^ 1;
    let other_most = ranges.most[other as usize];
    let share = light_side(
        ranges.most[lane as usize],
        ranges.least[lane as usize],
        other_most,
        ranges.least[other as usize],
    );
    if block == 0 && lane < 2 && share > 0.0 {
        let even = select(0.5, 1.0, other_most <= 0.0);
        return share + LIGHT_EVEN_SHARE * (even - share);
    }
    share
}

/// The side of a block whose parts are lanes 2 to 5.
#[inline(always)]
pub fn light_side_of_lane(lane: u32) -> u32 {
    if lane > 1 {
        return lane / 2 - 1;
    }
    lane
}

/// Probability with which a block's descent ends in a lane.
#[inline(always)]
pub fn light_lane_probability(ranges: LightRanges, block: u32, lane: u32) -> f32 {
    let mut probability = light_lane_share(ranges, block, light_side_of_lane(lane));
    if lane > 1 {
        probability *= light_lane_share(ranges, block, lane);
    }
    probability
}

/// A group that was drawn.
#[derive(Clone, Copy, Debug)]
pub struct LightGroupChoice {
    /// What the group is: a `LIGHT_GROUP_IS_` kind and an index; [`LIGHT_NONE`]: nothing
    /// reaches the point.
    pub link: u32,
    /// Probability of the choice.
    pub probability: f32,
    /// Place of the random number inside of it, in [0, 1).
    pub place: f32,
}

/// Lane that `u` in [0, 1) falls to, of `first` and its neighbour, and the place inside.
#[inline(always)]
pub fn light_choose_lane(ranges: LightRanges, block: u32, first: u32, u: f32) -> LightGroupChoice {
    let share = light_lane_share(ranges, block, first);
    if u < share {
        return LightGroupChoice {
            link: first,
            probability: share,
            place: clamp(u / share, 0.0, LIGHT_ONE_BELOW),
        };
    }
    // Not 1 − share, which loses digits that `light_lane_probability` has.
    let rest = light_lane_share(ranges, block, first ^ 1);
    LightGroupChoice {
        link: first ^ 1,
        probability: rest,
        place: clamp(
            (u - share) / select(1.0, rest, rest > 0.0),
            0.0,
            LIGHT_ONE_BELOW,
        ),
    }
}

/// Draws a group with `select` in [0, 1).
#[inline(always)]
pub fn light_choose_group(view: LightView, p: Vec3, n: Vec3, select: f32) -> LightGroupChoice {
    let mut choice = LightGroupChoice {
        link: LIGHT_NONE,
        probability: 1.0,
        place: select,
    };
    if view.groups.len() as u32 == 0 {
        return choice;
    }
    let mut block = 0;
    loop {
        let ranges = light_ranges(view, block, p, n);
        let side = light_choose_lane(ranges, block, 0, choice.place);
        let mut lane = side.link;
        choice.probability *= side.probability;
        choice.place = side.place;
        if (view.groups[block as usize].flags & (LIGHT_OPENS << lane)) != 0 {
            let part = light_choose_lane(ranges, block, 2 * lane + 2, choice.place);
            lane = part.link;
            choice.probability *= part.probability;
            choice.place = part.place;
        }
        let possible = choice.probability > 0.0;
        if !possible {
            return choice;
        }
        let link = view.groups[block as usize].link[lane as usize];
        if (link & LIGHT_GROUP_WHAT) != LIGHT_GROUP_IS_BLOCK {
            choice.link = link;
            return choice;
        }
        block = link & !LIGHT_GROUP_WHAT;
    }
}

/// Probability with which [`light_choose_group`] draws the group in a slot (8 · block +
/// lane): upwards from there.
#[inline(always)]
pub fn light_group_probability(view: LightView, slot: u32, p: Vec3, n: Vec3) -> f32 {
    let mut at = slot;
    let mut probability = 1.0;
    loop {
        let block = at / 8;
        let ranges = light_ranges(view, block, p, n);
        probability *= light_lane_probability(ranges, block, at % 8);
        let possible = probability > 0.0;
        if block == 0 || !possible {
            return probability;
        }
        at = view.group_parents[block as usize];
    }
}
