//! Scene, geometry, lights, closures, sampling, integrator and film.
pub mod accel;
pub mod camera;
pub mod device;
pub mod sampler;
pub mod scene;
