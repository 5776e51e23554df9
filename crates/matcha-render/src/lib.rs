//! Scene, geometry, lights, closures, sampling, integrator and film.
pub mod accel;
pub mod backend;
pub mod camera;
pub mod closure;
pub mod cpu;
pub mod device;
mod emission;
pub mod film;
pub mod flat;
pub mod integrator;
pub mod light;
mod node_cache;
pub mod prepare;
pub mod sampler;
pub mod scene;
pub mod surface;
mod table_use;
pub mod texture;
