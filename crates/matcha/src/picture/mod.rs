//! From a film to files that people look at: EXR layers, view transforms, differences,
//! heat maps, the figure.

pub mod difference;
pub mod exr_file;
pub mod figure;
pub mod heat;
pub mod png_file;
pub mod text;
pub mod view;

mod agx;
mod filmic;
