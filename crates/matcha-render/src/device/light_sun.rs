//! Choosing a sun.

use crate::device::light_importance::{light_cos_reduced, light_sine};
use crate::device::light_tree::LightChoice;
use crate::device::light_view::{LightSun, LightView};
use glam::Vec3;
use matcha_shade::device::math::{dot, max, select};

/// True for the zero normal of a point where light from both sides counts.
#[inline(always)]
pub fn light_from_both_sides(n: Vec3) -> bool {
    n.x == 0.0 && n.y == 0.0 && n.z == 0.0
}

/// Largest luminous irradiance that a sun can bring to a surface with normal `n`.
#[inline]
pub fn light_sun_irradiance(sun: LightSun, n: Vec3) -> f32 {
    if light_from_both_sides(n) {
        return sun.irradiance;
    }
    let cosine = light_cos_reduced(dot(n, sun.towards), sun.cos_half);
    // A disc that straddles the horizon still counts a little.
    let rim = select(0.0, 1e-3 * light_sine(sun.cos_half), cosine > 0.0);
    sun.irradiance * max(cosine, rim)
}

/// The suns' irradiances together.
#[inline(always)]
pub fn light_suns_irradiance(view: LightView, n: Vec3) -> f32 {
    let mut sum = 0.0;
    let mut k = 0;
    while k < view.suns.len() as u32 {
        sum += light_sun_irradiance(view.suns[k as usize], n);
        k += 1;
    }
    sum
}

/// Chooses a sun by its irradiance, with `u` in [0, 1).
#[inline(always)]
pub fn light_choose_sun(view: LightView, n: Vec3, u: f32) -> LightChoice {
    let sum = light_suns_irradiance(view, n);
    let mut choice = LightChoice {
        found: false,
        index: 0,
        probability: 0.0,
    };
    let mut left = u * sum;
    let mut k = 0;
    while k < view.suns.len() as u32 {
        let irradiance = light_sun_irradiance(view.suns[k as usize], n);
        if irradiance > 0.0 {
            choice = LightChoice {
                found: true,
                index: view.suns[k as usize].index,
                probability: irradiance / sum,
            };
            if left < irradiance {
                return choice;
            }
            left -= irradiance;
        }
        k += 1;
    }
    choice
}

/// Probability with which [`light_choose_sun`] chooses sun `k`.
#[inline(always)]
pub fn light_sun_probability(view: LightView, k: u32, n: Vec3) -> f32 {
    let sum = light_suns_irradiance(view, n);
    if sum > 0.0 {
        return light_sun_irradiance(view.suns[k as usize], n) / sum;
    }
    0.0
}
