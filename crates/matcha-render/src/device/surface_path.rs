//! What the path that arrives at a point knows, and what programs read of it.

use crate::device::path_flags::*;
use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use matcha_shade::device::input_code::*;
use matcha_shade::device::math::select;

/// What the path that arrives at a point knows.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct PathInfo {
    /// Unit direction of the ray, towards the point.
    pub direction: Vec3,
    /// Kind of the ray: the bits of `path_flags`.
    pub flags: u32,
    /// Width of the ray cone where the ray began, metres.
    pub cone_width: f32,
    /// Growth of the cone per metre.
    pub cone_spread: f32,
    /// Length of the last segment as networks read it, metres.
    pub ray_length: f32,
    /// Bounces so far.
    pub bounce: u32,
    /// Diffuse ones.
    pub diffuse: u32,
    /// Glossy ones.
    pub glossy: u32,
    /// Transmitting ones.
    pub transmission: u32,
    /// Transparent surfaces passed.
    pub transparent: u32,
}

/// Bit of a path's flags that a quantity asks for; 0: the quantity is none of these.
#[inline(always)]
pub fn path_flag_of(code: u32) -> u32 {
    if code == INPUT_IS_CAMERA_RAY {
        PATH_CAMERA
    } else if code == INPUT_IS_SHADOW_RAY {
        PATH_SHADOW
    } else if code == INPUT_IS_DIFFUSE_RAY {
        PATH_DIFFUSE
    } else if code == INPUT_IS_GLOSSY_RAY {
        PATH_GLOSSY
    } else if code == INPUT_IS_SINGULAR_RAY {
        PATH_SINGULAR
    } else if code == INPUT_IS_REFLECTION_RAY {
        PATH_REFLECT
    } else if code == INPUT_IS_TRANSMISSION_RAY {
        PATH_TRANSMIT
    } else {
        0
    }
}

/// A quantity of the path by its code; 0 for quantities that are not the path's.
#[inline(always)]
pub fn path_quantity(code: u32, path: PathInfo) -> f32 {
    let flag = path_flag_of(code);
    if flag != 0 {
        select(0.0, 1.0, path.flags & flag != 0)
    } else if code == INPUT_RAY_LENGTH {
        path.ray_length
    } else if code == INPUT_RAY_DEPTH {
        path.bounce as f32
    } else if code == INPUT_DIFFUSE_DEPTH {
        path.diffuse as f32
    } else if code == INPUT_GLOSSY_DEPTH {
        path.glossy as f32
    } else if code == INPUT_TRANSPARENT_DEPTH {
        path.transparent as f32
    } else if code == INPUT_TRANSMISSION_DEPTH {
        path.transmission as f32
    } else {
        0.0
    }
}
