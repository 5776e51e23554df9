//! Input rows for the world, where a ray leaves the scene.

use super::fill::{Sink, write};
use crate::device::surface_background::background_quantity;
use crate::device::surface_path::PathInfo;
use crate::device::surface_view::CameraView;
use matcha_shade::input::Input;
use matcha_shade::rows::Rows;

/// A ray that leaves the scene; `direction` is what the world is asked for.
pub type BackgroundRay = PathInfo;

/// Writes the rows that a world's program reads for a group of directions.
pub fn fill_background(
    view: &CameraView,
    inputs: &[(Input, usize)],
    rays: &[BackgroundRay],
    rows: &mut Rows,
) {
    for &(input, first) in inputs {
        let mut sink = Sink::new(rows, input.kind.width(), first, rays.len());
        let (code, _) = input.kind.code();
        let part = input.part.code();
        for (i, ray) in rays.iter().enumerate() {
            let value = background_quantity(*view, *ray, code, part);
            write(&mut sink, i, value.extend(0.0).to_array());
        }
    }
}
