//! How often each kind of light is tried.
//!
//! A share is half the same for everyone that can reach the point, half in proportion to the
//! irradiance that is estimated to arrive: the estimates of a tree's root and of a sun differ
//! too much in kind to trust them alone.

use crate::device::light_sun::light_suns_irradiance;
use crate::device::light_tree::{LIGHT_ONE_BELOW, light_tree_importance};
use crate::device::light_view::{LIGHT_WORLD_NONE, LightView};
use crate::device::light_world::light_world_estimate;
use glam::Vec3;
use matcha_shade::device::math::{clamp, min, select};

/// Probability of each kind at a point; they sum to one, or to zero where nothing shines.
#[derive(Clone, Copy, Debug)]
pub struct LightShares {
    /// Local lights.
    pub tree: f32,
    /// The suns together.
    pub suns: f32,
    /// The world.
    pub world: f32,
}

/// [`LightShare::kind`]: nothing.
pub const LIGHT_SHARE_NONE: u32 = 0;
/// [`LightShare::kind`]: local lights.
pub const LIGHT_SHARE_TREE: u32 = 1;
/// [`LightShare::kind`]: the suns.
pub const LIGHT_SHARE_SUNS: u32 = 2;
/// [`LightShare::kind`]: the world.
pub const LIGHT_SHARE_WORLD: u32 = 3;

/// Kind that a number falls to.
#[derive(Clone, Copy, Debug)]
pub struct LightShare {
    /// One of the `LIGHT_SHARE_` kinds.
    pub kind: u32,
    /// Place of the number inside of the kind's share, in [0, 1).
    pub place: f32,
}

/// `x` where it is positive, with an end.
#[inline(always)]
pub fn light_share_limit(x: f32) -> f32 {
    select(0.0, min(x, 1e30), x > 0.0)
}

/// Shares from estimates of the luminous irradiance that each kind brings.
#[inline]
pub fn light_shares_of(from_tree: f32, from_suns: f32, from_world: f32) -> LightShares {
    let tree = light_share_limit(from_tree);
    let suns = light_share_limit(from_suns);
    let world = light_share_limit(from_world);
    let sum = tree + suns + world;
    if sum <= 0.0 {
        return LightShares {
            tree: 0.0,
            suns: 0.0,
            world: 0.0,
        };
    }
    let has_tree = select(0.0, 1.0, tree > 0.0);
    let has_suns = select(0.0, 1.0, suns > 0.0);
    let has_world = select(0.0, 1.0, world > 0.0);
    let even = 0.5 / (has_tree + has_suns + has_world);
    LightShares {
        tree: has_tree * even + 0.5 * tree / sum,
        suns: has_suns * even + 0.5 * suns / sum,
        world: has_world * even + 0.5 * world / sum,
    }
}

/// Shares at the point `p` with normal `n`.
#[inline(always)]
pub fn light_shares(view: LightView, p: Vec3, n: Vec3) -> LightShares {
    if view.suns.len() as u32 == 0 && view.world_kind == LIGHT_WORLD_NONE {
        return LightShares {
            tree: 1.0,
            suns: 0.0,
            world: 0.0,
        };
    }
    light_shares_of(
        light_tree_importance(view, p, n),
        light_suns_irradiance(view, n),
        light_world_estimate(view, n),
    )
}

/// Kind that `u` in [0, 1) falls to.
#[inline]
pub fn light_choose_share(shares: LightShares, u: f32) -> LightShare {
    let kinds = [shares.tree, shares.suns, shares.world];
    let mut chosen = LightShare {
        kind: LIGHT_SHARE_NONE,
        place: 0.0,
    };
    let mut start = 0.0;
    let mut k = 0;
    while k < 3 {
        let share = kinds[k as usize];
        if share > 0.0 {
            // Rounding may leave a last sliver to the last kind.
            chosen = LightShare {
                kind: LIGHT_SHARE_TREE + k,
                place: clamp((u - start) / share, 0.0, LIGHT_ONE_BELOW),
            };
            if u < start + share {
                return chosen;
            }
            start += share;
        }
        k += 1;
    }
    chosen
}
