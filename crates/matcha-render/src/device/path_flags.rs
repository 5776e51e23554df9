//! Bits that say what kind of ray a path follows, and what happened to the path before.

/// Straight from the camera (through transparent surfaces too).
pub const PATH_CAMERA: u32 = 1;
/// Last scattered by a diffuse closure.
pub const PATH_DIFFUSE: u32 = 2;
/// Last scattered by a glossy closure.
pub const PATH_GLOSSY: u32 = 4;
/// Last scattered by a perfectly sharp closure.
pub const PATH_SINGULAR: u32 = 8;
/// Last scattered to the side it came from.
pub const PATH_REFLECT: u32 = 16;
/// Last scattered through the surface.
pub const PATH_TRANSMIT: u32 = 32;
/// A shadow ray.
pub const PATH_SHADOW: u32 = 64;
/// The next surface still adds its emission, then the path ends.
pub const PATH_TERMINATE: u32 = 128;
/// Albedo, normal and depth are on the film.
pub const PATH_FEATURES_DONE: u32 = 256;
/// Russian roulette ends the path at the surface that it has reached, which still adds its emission.
pub const PATH_ENDS: u32 = 512;
/// Some diffuse closure scattered the path before (for caustics).
pub const PATH_DIFFUSE_ANCESTOR: u32 = 1024;
/// Russian roulette has been played since the last scattering, and the throughput makes up for it.
pub const PATH_SURVIVED: u32 = 2048;
