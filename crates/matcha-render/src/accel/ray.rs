//! Rays and hits.

use crate::device::ray_box::ray_is_sound;
use crate::scene::Visibility;
use glam::Vec3;

/// Marks "no instance" or "no primitive" in [`Ray::excluded`].
pub const NOTHING: u32 = u32::MAX;

/// Which kind of ray it is, one bit each, for the visibility of instances.
pub mod ray_kind {
    use crate::device::ray_kind as device;

    /// From the camera.
    pub const CAMERA: u8 = device::RAY_CAMERA as u8;
    /// Scattered by a diffuse closure.
    pub const DIFFUSE: u8 = device::RAY_DIFFUSE as u8;
    /// Scattered by a glossy closure.
    pub const GLOSSY: u8 = device::RAY_GLOSSY as u8;
    /// Transmitted.
    pub const TRANSMISSION: u8 = device::RAY_TRANSMISSION as u8;
    /// Towards a light.
    pub const SHADOW: u8 = device::RAY_SHADOW as u8;
    /// Towards a light, through surfaces that may let it pass.
    pub const TRANSPARENT_SHADOW: u8 = device::RAY_TRANSPARENT_SHADOW as u8;
    /// Sees everything that is not wholly invisible.
    pub const ALL: u8 = device::RAY_ALL as u8;
}

/// The bits of the kinds of rays that see something.
pub fn visibility_mask(visibility: &Visibility) -> u8 {
    let bit = |flag: bool, bit: u8| if flag { bit } else { 0 };
    bit(visibility.camera, ray_kind::CAMERA)
        | bit(visibility.diffuse, ray_kind::DIFFUSE)
        | bit(visibility.glossy, ray_kind::GLOSSY)
        | bit(visibility.transmission, ray_kind::TRANSMISSION)
        | bit(visibility.shadow, ray_kind::SHADOW)
}

/// A ray `origin + t * direction` with `t_min < t < t_max`.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Where it starts, world space, metres.
    pub origin: Vec3,
    /// Its direction; `t` is in units of its length.
    pub direction: Vec3,
    /// Hits at or before it are ignored; not negative.
    pub t_min: f32,
    /// Hits at or beyond it are ignored.
    pub t_max: f32,
    /// Bits of [`ray_kind`]: an instance is seen if it shares one.
    pub mask: u8,
    /// Instance and primitive that the ray leaves and so cannot hit; [`NOTHING`] twice if none.
    pub excluded: [u32; 2],
}

impl Ray {
    /// An endless ray that everything is seen by.
    pub fn new(origin: Vec3, direction: Vec3) -> Self {
        Self {
            origin,
            direction,
            t_min: 0.0,
            t_max: f32::INFINITY,
            mask: ray_kind::ALL,
            excluded: [NOTHING; 2],
        }
    }

    /// False if a coordinate is not a finite number or the direction is zero: such a ray hits nothing.
    #[inline(always)]
    pub(super) fn is_sound(&self) -> bool {
        ray_is_sound(self.origin, self.direction)
    }
}

/// Where a ray meets a triangle: at `(1 - u - v) p0 + u p1 + v p2`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Index into `Scene::instances`.
    pub instance: u32,
    /// Triangle of the instance's mesh.
    pub primitive: u32,
    /// Distance in units of the ray's direction.
    pub t: f32,
    /// Weight of the triangle's second corner.
    pub u: f32,
    /// Weight of the triangle's third corner.
    pub v: f32,
}

pub use crate::device::path_ray::ray_offset_origin as offset_origin;
