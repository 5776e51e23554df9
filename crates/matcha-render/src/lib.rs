//! Scene, geometry, lights, closures, sampling, integrator and film.
pub mod accel;
pub mod camera;
pub mod closure;
pub mod device;
pub mod light;
pub mod sampler;
pub mod scene;
pub mod texture;
