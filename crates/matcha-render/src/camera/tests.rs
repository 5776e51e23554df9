use super::blender_projection::{CASES, MATRIX, POINTS};
use super::*;
use crate::device::camera::camera_aperture;
use crate::sampler::sample_2d;
use glam::{Affine3A, Mat3};

/// A camera of the reference and where Blender says that it sees points.
pub struct Case {
    pub parallel: bool,
    pub fit: SensorFit,
    pub size: [u32; 2],
    pub aspect: f32,
    pub shift: [f32; 2],
    pub fitted: f32,
    pub pixels: [[f32; 2]; 3],
}

fn camera(case: &Case) -> Camera {
    let [x, y, z, t] = MATRIX.map(Vec3::from);
    let projection = if case.parallel {
        Projection::Orthographic {
            scale: case.fitted,
            fit: case.fit,
        }
    } else {
        Projection::Perspective {
            tan_half_width: case.fitted,
            fit: case.fit,
        }
    };
    Camera {
        transform: Affine3A::from_mat3_translation(Mat3::from_cols(x, y, z), t),
        projection,
        shift: Vec2::from(case.shift),
        ..Camera::default()
    }
}

/// Distance of a point from a ray's line.
fn miss(ray: &CameraRay, point: Vec3) -> f32 {
    let to = point - ray.origin;
    (to - ray.direction * to.dot(ray.direction)).length()
}

/// Largest miss of the rays of a case through the pixels that Blender names, in pixels.
fn largest_miss(case: &Case, camera: &RasterCamera) -> f32 {
    let misses = case.pixels.iter().zip(POINTS).map(|(pixel, point)| {
        let point = Vec3::from(point);
        let ray = camera_ray(*camera, Vec2::from(*pixel), Vec2::ZERO);
        let distance = (point - ray.origin).dot(ray.direction);
        miss(&ray, point) / (ray.cone_width + ray.cone_spread * distance)
    });
    misses.fold(0.0, f32::max)
}

#[test]
fn rays_meet_the_points_that_blender_projects() {
    for case in CASES {
        let camera = prepare(&camera(case), case.size, case.aspect);
        let miss = largest_miss(case, &camera);
        assert!(
            miss < 0.02,
            "{:?} {:?} {:?}: {miss} pixels",
            case.fit,
            case.size,
            case.shift
        );
    }
}

#[test]
fn a_wrong_fit_or_shift_is_found_out() {
    let case = CASES
        .iter()
        .find(|c| c.shift[0] != 0.0 && c.size[0] < c.size[1])
        .unwrap();
    let mut shifted = camera(case);
    shifted.shift.y = -shifted.shift.y;
    assert!(largest_miss(case, &prepare(&shifted, case.size, case.aspect)) > 1.0);
    assert!(largest_miss(case, &prepare(&camera(case), case.size, 1.1 * case.aspect)) > 1.0);
}

#[test]
fn rays_of_a_lens_meet_in_the_plane_of_focus() {
    for case in CASES.iter().step_by(5) {
        let sharp = camera(case);
        let blurred = Camera {
            aperture_radius: 0.2,
            focus_distance: 3.0,
            ..sharp.clone()
        };
        let axis = -Vec3::from(sharp.transform.matrix3.z_axis);
        let sharp = prepare(&sharp, case.size, case.aspect);
        let blurred = prepare(&blurred, case.size, case.aspect);
        for i in 0..64 {
            let raster = sample_2d(3, i, 0) * Vec2::new(case.size[0] as f32, case.size[1] as f32);
            let lens = sample_2d(3, i, 1);
            let centre = camera_ray(sharp, raster, lens);
            let focus = centre.origin + centre.direction * (3.0 / centre.direction.dot(axis));
            let ray = camera_ray(blurred, raster, lens);
            assert!(miss(&ray, focus) < 1e-5, "{}", miss(&ray, focus));
            assert!((ray.origin - centre.origin).length() <= 0.2 + 1e-6);
            assert!((ray.direction.length() - 1.0).abs() < 1e-5);
        }
    }
}

#[test]
fn apertures_are_uniform_and_have_their_shape() {
    let base = prepare(&Camera::default(), [8, 8], 1.0);
    for blades in [0.0, 3.0, 6.0] {
        let camera = RasterCamera {
            blades,
            blades_rotation: 0.4,
            lens_squeeze: 0.5,
            ..base
        };
        let n = 1 << 14;
        let (mut mean, mut second) = (Vec2::ZERO, Vec2::ZERO);
        for i in 0..n {
            let p = camera_aperture(camera, sample_2d(1, i, 0)) / vec2(0.5, 1.0);
            mean += p / n as f32;
            second += p * p / n as f32;
            assert!(p.length() <= 1.0 + 1e-5);
            if blades >= 3.0 {
                let sector = std::f32::consts::TAU / blades;
                let angle = (p.y.atan2(p.x) - 0.4).rem_euclid(sector);
                let towards_edge = angle.min(sector - angle);
                let edge = (sector / 2.0).cos();
                assert!(
                    p.length() * towards_edge.cos() <= edge + 1e-4,
                    "outside of the polygon"
                );
            }
        }
        assert!(mean.length() < 2e-3, "{mean}");
        // Second moment of a regular polygon with unit circumradius: (2 + cos(2π/k)) / 12.
        let moment = if blades == 0.0 {
            0.25
        } else {
            (2.0 + (std::f32::consts::TAU / blades).cos()) / 12.0
        };
        assert!(
            (second - Vec2::splat(moment)).abs().max_element() < 3e-3,
            "{second} {moment}"
        );
    }
}

#[test]
fn panorama_looks_along_its_axis_and_covers_the_sphere() {
    let scene = Camera {
        projection: Projection::Equirectangular,
        ..Camera::default()
    };
    let camera = prepare(&scene, [64, 32], 1.0);
    let look = |x, y| camera_ray(camera, vec2(x, y), Vec2::splat(0.5)).direction;
    assert!((look(32.0, 16.0) - Vec3::NEG_Z).length() < 1e-5);
    assert!((look(48.0, 16.0) - Vec3::X).length() < 1e-5);
    assert!((look(32.0, 0.0) - Vec3::Y).length() < 1e-5);
    assert!((look(16.0, 16.0) - Vec3::NEG_X).length() < 1e-5);
    let mut sum = 0.0;
    for y in 0..32 {
        for x in 0..64 {
            let ray = pixel_ray(&camera, [x, y], Vec2::ZERO, Vec2::ZERO);
            sum += ray.cone_spread * ray.cone_spread;
        }
    }
    assert!(
        (sum / (4.0 * std::f32::consts::PI) - 1.0).abs() < 1e-3,
        "{sum}"
    );
}

#[test]
fn cones_cover_the_solid_angle_of_the_picture() {
    let projection = Projection::Perspective {
        tan_half_width: 0.9,
        fit: SensorFit::Horizontal,
    };
    let camera = prepare(
        &Camera {
            projection,
            ..Camera::default()
        },
        [80, 60],
        1.0,
    );
    let mut sum = 0.0;
    for y in 0..60 {
        for x in 0..80 {
            sum += pixel_ray(&camera, [x, y], Vec2::ZERO, Vec2::ZERO)
                .cone_spread
                .powi(2);
        }
    }
    // Solid angle of a pyramid: 4 asin(sin a/2 · sin b/2) with full angles a and b.
    let (a, b) = (0.9f32.atan(), (0.9f32 * 0.75).atan());
    let expected = 4.0 * (a.sin() * b.sin()).asin();
    assert!((sum / expected - 1.0).abs() < 1e-3, "{sum} {expected}");
}
