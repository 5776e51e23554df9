//! From a hit to all that is known about the point: geometry, footprint, and the input rows that
//! a program reads.
//!
//! Two steps. [`SurfaceTables::point`] makes a [`SurfacePoint`] of a hit, whatever its material
//! needs. [`SurfaceTables::fill`] then writes, for a group of points of one program, just the rows
//! that the program reads. [`fill_background`] does that for directions that leave the scene.

mod background;
mod fill;
mod island;
mod point;
mod pointiness;
mod tables;
#[cfg(test)]
mod tests;
mod view;

pub use crate::device::surface_path::PathInfo;
pub use crate::device::surface_point::SurfacePoint;
pub use crate::device::surface_view::CameraView as View;
pub use background::{BackgroundRay, fill_background};
pub use tables::{SurfaceTables, material_of};
