//! Device code: sampling, camera, closures and lights in the subset of Rust that a
//! translator turns into WGSL.
pub mod camera;
pub mod light_analytic;
pub mod light_importance;
pub mod light_rectangle;
pub mod light_triangle;
pub mod mapping;
pub mod sobol;
