//! Which kind of ray it is, one bit each, for the visibility of instances, lights and the world.

/// From the camera, perhaps through transparent surfaces.
pub const RAY_CAMERA: u32 = 1;
/// Scattered by a diffuse closure.
pub const RAY_DIFFUSE: u32 = 2;
/// Scattered by a glossy closure.
pub const RAY_GLOSSY: u32 = 4;
/// Transmitted.
pub const RAY_TRANSMISSION: u32 = 8;
/// Towards a light.
pub const RAY_SHADOW: u32 = 16;
/// Towards a light, through surfaces that may let it pass.
pub const RAY_TRANSPARENT_SHADOW: u32 = 32;
/// Sees everything that is not wholly invisible.
pub const RAY_ALL: u32 = 63;
