//! The sampler: Sobol points with Owen scrambling, one sequence a pixel.
//!
//! A sequence is named by a seed ([`pixel_seed`]). A path draws from it by the index of its
//! sample and by dimension numbers that it counts up, one for each draw whatever its width:
//! the points of one draw over the samples of a pixel are stratified in all their
//! coordinates together; different draws are independent.

pub use crate::device::sobol::{
    sobol_1d as sample_1d, sobol_2d as sample_2d, sobol_3d as sample_3d,
    sobol_pixel_seed as pixel_seed,
};

#[cfg(test)]
mod tests;
