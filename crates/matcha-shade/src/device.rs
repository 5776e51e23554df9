//! Device code: the functions behind the operations, in a subset of Rust that a
//! translator turns into WGSL.
pub mod arithmetic;
pub mod blend;
pub mod color;
pub mod fractal;
pub mod hash;
pub mod input_code;
pub mod math;
pub mod pattern;
pub mod perlin;
pub mod ramp;
pub mod scalar;
pub mod shading;
pub mod texel;
pub mod vector;
pub mod voronoi;
pub mod voronoi_edge;
pub mod voronoi_nearest;
pub mod voronoi_smooth;
