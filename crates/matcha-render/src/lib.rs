//! Scene, geometry, lights, closures, sampling, integrator and film.
pub mod scene;
