//! Device code: plain functions that a build-time translator can turn into WGSL.
pub mod camera;
pub mod error_function;
pub mod fresnel;
pub mod light_analytic;
pub mod light_importance;
pub mod light_rectangle;
pub mod light_triangle;
pub mod lobe;
pub mod lobe_ashikhmin;
pub mod lobe_microfacet;
pub mod lobe_soft;
pub mod mapping;
pub mod microfacet;
pub mod shading_normal;
pub mod sobol;
