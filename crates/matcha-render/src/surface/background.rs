//! Input rows for the world, where a ray leaves the scene.

use super::fill::{Sink, path_quantity, write};
use super::point::PathInfo;
use super::view::View;
use glam::Vec3;
use matcha_shade::input::{Input, InputKind, Part};
use matcha_shade::rows::Rows;

/// A ray that leaves the scene; `path.direction` is what the world is asked for.
pub type BackgroundRay = PathInfo;

/// Writes the rows that a world's program reads for a group of directions. As in Cycles,
/// positions of all kinds are the direction, and normal and incoming its opposite.
pub fn fill_background(
    view: &View,
    inputs: &[(Input, usize)],
    rays: &[BackgroundRay],
    rows: &mut Rows,
) {
    for &(input, first) in inputs {
        let mut sink = Sink::new(rows, input.kind.width(), first, rays.len());
        for (i, ray) in rays.iter().enumerate() {
            write(&mut sink, i, quantity(view, input, ray));
        }
    }
}

fn quantity(view: &View, input: Input, ray: &BackgroundRay) -> [f32; 4] {
    let direction = ray.direction;
    let vector = |v: Vec3| v.extend(0.0).to_array();
    let value = match input.kind {
        InputKind::Position | InputKind::Generated | InputKind::Object => vector(direction),
        InputKind::Normal | InputKind::TrueNormal | InputKind::Incoming => {
            return if input.part == Part::Value {
                vector(-direction)
            } else {
                vector(-along(input.part, ray))
            };
        }
        // Cycles adds the camera's position to a direction before it transforms it.
        InputKind::Camera => vector(view.camera_coordinates_of(direction)),
        InputKind::Window => vector(view.window_coordinates_of(direction)),
        kind => return path_quantity(kind, ray).map_or([0.0; 4], |value| [value, 0.0, 0.0, 0.0]),
    };
    match (input.part, input.kind) {
        (Part::Value, _) => value,
        (part, InputKind::Camera) => vector(view.camera_coordinates_of(along(part, ray))),
        (part, InputKind::Window) => {
            let beside = view.window_coordinates_of(direction + along(part, ray));
            vector(beside - Vec3::from_slice(&value))
        }
        (part, _) => vector(along(part, ray)),
    }
}

/// Half axes of a cone's circle on the sphere of directions.
fn along(part: Part, ray: &BackgroundRay) -> Vec3 {
    let (first, second) = ray.direction.any_orthonormal_pair();
    let radius = 0.5 * ray.cone_spread;
    if part == Part::AxisA {
        first * radius
    } else {
        second * radius
    }
}
