use super::*;
use crate::accel::{Accel, Hit, Ray};
use crate::camera::prepare;
use crate::device::surface_cone::{cone_ellipse, cone_spread_after, cone_width_at};
use crate::integrator::path::flags;
use crate::scene::{
    Camera, Instance, Material, Mesh, MeshAttribute, Scene, Shader, UvSet, Visibility,
};
use glam::{Affine3A, Quat, Vec2, Vec3, Vec4};
use matcha_shade::input::{Input, InputKind, Part};
use matcha_shade::rows::Rows;
use proptest::prelude::*;

fn quad() -> Mesh {
    let positions = vec![Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.2), Vec3::Y];
    let indices = vec![[0, 1, 2], [0, 2, 3]];
    let normal = |v: u32| (Vec3::Z + 0.2 * (positions[v as usize] - 0.5)).normalize();
    let uv = |v: u32| Vec2::new(2.0 * positions[v as usize].x + 0.3, positions[v as usize].y);
    let corner_normals = indices.iter().map(|t: &[u32; 3]| t.map(normal)).collect();
    let corners = indices.iter().map(|t| t.map(uv)).collect();
    let color = |v: u32| Vec4::new(positions[v as usize].x, 0.5, positions[v as usize].y, 1.0);
    let attribute = indices.iter().map(|t| t.map(color)).collect();
    Mesh {
        name: "quad".into(),
        indices,
        corner_normals,
        uv_sets: vec![UvSet {
            name: 1,
            corners,
            tangents: vec![],
        }],
        attributes: vec![MeshAttribute {
            name: 0,
            corners: attribute,
        }],
        generated_origin: Vec3::new(0.0, 0.0, -1.0),
        generated_size: Vec3::new(1.0, 2.0, 0.0),
        positions,
        material_slots: vec![0],
        ..Mesh::default()
    }
}

fn scene(transform: Affine3A) -> Scene {
    let instance = Instance {
        name: "object".into(),
        mesh: 0,
        transform,
        materials: vec![],
        pass_index: 4.0,
        random: 0.25,
        color: Vec4::new(0.1, 0.2, 0.3, 0.4),
        visibility: Visibility::default(),
        holdout: false,
    };
    Scene {
        meshes: vec![quad()],
        instances: vec![instance],
        materials: vec![Material {
            name: "m".into(),
            shader: Shader::Cycles(0),
            pass_index: 9.0,
            sample_emission: Some(crate::scene::Sides::Both),
        }],
        uv_names: vec!["".into(), "UVMap".into(), "absent".into()],
        attribute_names: vec!["Col".into(), "absent".into()],
        ..Scene::default()
    }
}

fn view() -> View {
    let camera = Camera {
        transform: Affine3A::from_translation(Vec3::new(0.5, 0.5, 5.0)),
        ..Camera::default()
    };
    View::new(prepare(&camera, [200, 100], 1.0), [200, 100])
}

fn tables(scene: &Scene) -> SurfaceTables {
    SurfaceTables::new(
        scene,
        view(),
        [InputKind::Pointiness, InputKind::RandomPerIsland],
    )
}

fn path(direction: Vec3) -> PathInfo {
    PathInfo {
        direction,
        flags: flags::CAMERA | flags::TRANSMIT,
        cone_width: 0.0,
        cone_spread: 0.002,
        ray_length: 3.5,
        bounce: 3,
        ..PathInfo::default()
    }
}

fn rows_of(scene: &Scene, points: &[SurfacePoint], kind: InputKind, part: Part) -> Vec<Vec<f32>> {
    let mut rows = Rows::new(kind.width() + 1, points.len());
    let input = Input { kind, part };
    tables(scene).fill(scene, &[(input, 1)], points, &mut rows);
    (0..points.len())
        .map(|i| (0..kind.width()).map(|r| rows.get(r + 1, i)).collect())
        .collect()
}

fn hit_from(scene: &Scene, origin: Vec3, direction: Vec3) -> SurfacePoint {
    let direction = direction.normalize();
    let hit = Accel::build(scene)
        .unwrap()
        .closest(&Ray::new(origin, direction))
        .unwrap();
    tables(scene).point(scene, &hit, &path(direction))
}

#[test]
fn a_head_on_footprint_is_a_circle() {
    let [a, b] = cone_ellipse(Vec3::NEG_Z, Vec3::Z, 0.2);
    assert!((a.length() - 0.1).abs() < 1e-6 && (b.length() - 0.1).abs() < 1e-6);
    assert!(a.dot(b).abs() < 1e-7 && a.z.abs() < 1e-7);
}

#[test]
fn a_slanted_footprint_is_longer_by_the_cosine() {
    for degrees in [10.0f32, 45.0, 80.0] {
        let angle = degrees.to_radians();
        let [a, b] = cone_ellipse(Vec3::new(angle.sin(), 0.0, -angle.cos()), Vec3::Z, 2.0);
        assert!((a.length() - 1.0 / angle.cos()).abs() < 1e-4, "{degrees}");
        assert!((b.length() - 1.0).abs() < 1e-5);
        assert!(a.y.abs() < 1e-6 && b.x.abs() < 1e-5, "{a} {b}");
    }
    let [a, _] = cone_ellipse(Vec3::X, Vec3::Z, 2.0);
    assert!(a.is_finite(), "edge-on stays finite");
}

#[test]
fn cones_grow() {
    assert_eq!(cone_width_at(0.5, 0.1, 10.0), 1.5);
    let mirror = cone_spread_after(0.01, 0.0, false);
    let glossy = cone_spread_after(0.01, 0.1, false);
    let diffuse = cone_spread_after(0.01, 0.0, true);
    assert!(mirror == 0.01 && mirror < glossy && glossy < diffuse && diffuse <= 1.0);
}

#[test]
fn normals_face_the_viewer_on_every_side_and_when_mirrored() {
    for scale in [
        Vec3::ONE,
        Vec3::new(-1.0, 1.0, 1.0),
        Vec3::new(2.0, 1.0, -0.5),
    ] {
        let scene = scene(Affine3A::from_scale(scale));
        let target = Vec3::new(0.4, 0.5, 0.05) * scale;
        for side in [1.0, -1.0] {
            let origin = target + Vec3::new(0.1, 0.2, 3.0) * side * scale.z.signum();
            let point = hit_from(&scene, origin, target - origin);
            assert_eq!(point.backfacing != 0, side < 0.0, "{scale} {side}");
            assert!(point.true_normal.dot(point.outgoing) > 0.0);
            assert!(point.normal.dot(point.true_normal) > 0.8);
            assert!((point.normal.length() - 1.0).abs() < 1e-5);
            let to = (target - origin).normalize();
            assert!(
                (point.position - origin).cross(to).length() < 1e-5,
                "on the ray"
            );
        }
    }
}

#[test]
fn the_shadow_origin_lies_above_a_convex_surface() {
    let scene = scene(Affine3A::IDENTITY);
    let point = hit_from(&scene, Vec3::new(0.6, 0.3, 2.0), Vec3::NEG_Z);
    let lift = point.shadow_origin - point.position;
    assert!(
        lift.dot(point.true_normal) > 0.005 && lift.length() < 0.2,
        "{lift}"
    );
    let mut flat = scene.clone();
    flat.meshes[0].corner_normals.clear();
    let point = hit_from(&flat, Vec3::new(0.6, 0.3, 2.0), Vec3::NEG_Z);
    assert_eq!(point.shadow_origin, point.position);
}

#[test]
fn values_are_those_of_the_corners() {
    let scene = scene(Affine3A::IDENTITY);
    let point = hit_from(&scene, Vec3::new(0.6, 0.3, 2.0), Vec3::NEG_Z);
    let value = |kind| rows_of(&scene, &[point], kind, Part::Value).remove(0);
    let near = |a: Vec<f32>, b: &[f32]| {
        assert!(
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-5),
            "{a:?} {b:?}"
        );
    };
    let z = point.position.z;
    near(value(InputKind::Position), &[0.6, 0.3, z]);
    near(value(InputKind::Object), &[0.6, 0.3, z]);
    near(value(InputKind::Generated), &[0.6, 0.15, 0.0]);
    near(value(InputKind::Uv(0)), &[1.5, 0.3]);
    near(value(InputKind::Uv(1)), &[1.5, 0.3]);
    near(value(InputKind::Uv(2)), &[0.0, 0.0]);
    near(value(InputKind::Uv(77)), &[0.0, 0.0]);
    near(value(InputKind::Attribute(0)), &[0.6, 0.5, 0.3, 1.0]);
    near(value(InputKind::Attribute(1)), &[0.0; 4]);
    near(value(InputKind::Incoming), &[0.0, 0.0, 1.0]);
    near(value(InputKind::Camera), &[0.1, -0.2, 5.0 - z]);
    near(value(InputKind::ObjectColor), &[0.1, 0.2, 0.3]);
    near(value(InputKind::ObjectAlpha), &[0.4]);
    near(value(InputKind::ObjectIndex), &[4.0]);
    near(value(InputKind::MaterialIndex), &[9.0]);
    near(value(InputKind::ObjectRandom), &[0.25]);
    near(value(InputKind::IsCameraRay), &[1.0]);
    near(value(InputKind::IsTransmissionRay), &[1.0]);
    near(value(InputKind::IsShadowRay), &[0.0]);
    near(value(InputKind::RayLength), &[3.5]);
    near(value(InputKind::RayDepth), &[3.0]);
    near(value(InputKind::TangentSign(1)), &[1.0]);
    let tangent = Vec3::from_slice(&value(InputKind::Tangent(1)));
    assert!(tangent.x > 0.9 && (tangent.length() - 1.0).abs() < 1e-5);
    let [du, dv] = [InputKind::DpDu(1), InputKind::DpDv(1)].map(|k| Vec3::from_slice(&value(k)));
    assert!(
        (du.x - 0.5).abs() < 1e-5 && (dv.y - 1.0).abs() < 1e-5,
        "{du} {dv}"
    );
}

#[test]
fn parametric_is_the_weight_of_the_first_two_corners() {
    let scene = scene(Affine3A::IDENTITY);
    // In the first triangle: (0, 0), (1, 0), (1, 1).
    let point = hit_from(&scene, Vec3::new(0.7, 0.2, 3.0), Vec3::NEG_Z);
    let found = &rows_of(&scene, &[point], InputKind::Parametric, Part::Value)[0];
    assert!(
        (found[0] - 0.3).abs() < 1e-4 && (found[1] - 0.5).abs() < 1e-4,
        "{found:?}"
    );
}

#[test]
fn the_window_is_where_the_camera_sees_the_point() {
    let scene = scene(Affine3A::IDENTITY);
    let middle = hit_from(&scene, Vec3::new(0.5, 0.5, 2.0), Vec3::NEG_Z);
    let window = rows_of(&scene, &[middle], InputKind::Window, Part::Value).remove(0);
    assert!(
        (window[0] - 0.5).abs() < 1e-5 && (window[1] - 0.5).abs() < 1e-5,
        "{window:?}"
    );
    let up = hit_from(&scene, Vec3::new(0.5, 0.9, 2.0), Vec3::NEG_Z);
    let window = rows_of(&scene, &[up], InputKind::Window, Part::Value).remove(0);
    assert!(
        (window[0] - 0.5).abs() < 1e-5 && window[1] > 0.6,
        "{window:?}"
    );
}

#[test]
fn a_mirrored_object_has_the_other_tangent_sign() {
    let sign = |transform: Affine3A| {
        let scene = scene(transform);
        let hit = Hit {
            instance: 0,
            primitive: 0,
            t: 1.0,
            u: 0.3,
            v: 0.3,
        };
        let point = tables(&scene).point(&scene, &hit, &path(Vec3::NEG_Z));
        rows_of(&scene, &[point], InputKind::TangentSign(1), Part::Value)[0][0]
    };
    assert_eq!(sign(Affine3A::IDENTITY), 1.0);
    assert_eq!(sign(Affine3A::from_scale(Vec3::new(-1.0, 1.0, 1.0))), -1.0);
}

#[test]
fn pointiness_tells_tips_from_dents_and_islands_differ() {
    let mut scene = scene(Affine3A::IDENTITY);
    let mesh = &mut scene.meshes[0];
    // Two pyramids without floors, the second one upside down.
    mesh.positions.clear();
    mesh.indices.clear();
    for (side, offset) in [(1.0, 0.0), (-1.0, 10.0)] {
        let first = mesh.positions.len() as u32;
        mesh.positions.push(Vec3::new(offset, 0.0, side));
        for k in 0..4 {
            let angle = k as f32 * std::f32::consts::FRAC_PI_2;
            mesh.positions
                .push(Vec3::new(offset + angle.cos(), angle.sin(), 0.0));
        }
        mesh.indices
            .extend((0..4).map(|k| [first, first + 1 + k, first + 1 + (k + 1) % 4]));
    }
    let values = pointiness::pointiness(mesh);
    assert!(values[0] > 0.55 && values[5] < 0.45, "{values:?}");
    let islands = island::random_per_island(mesh);
    assert!(islands[0] == islands[3] && islands[4] == islands[7] && islands[0] != islands[4]);
}

#[test]
fn the_background_sees_directions() {
    let ray = path(Vec3::new(0.6, 0.0, 0.8));
    let mut rows = Rows::new(3, 1);
    let mut read = |kind, part| {
        fill_background(&view(), &[(Input { kind, part }, 0)], &[ray], &mut rows);
        [0, 1, 2].map(|r| {
            if r < kind.width() {
                rows.get(r, 0)
            } else {
                0.0
            }
        })
    };
    assert_eq!(read(InputKind::Generated, Part::Value), [0.6, 0.0, 0.8]);
    assert_eq!(read(InputKind::Incoming, Part::Value), [-0.6, -0.0, -0.8]);
    assert_eq!(read(InputKind::RayDepth, Part::Value), [3.0, 0.0, 0.0]);
    let along = Vec3::from(read(InputKind::Position, Part::AxisA));
    assert!((along.length() - 0.001).abs() < 1e-6 && along.dot(ray.direction).abs() < 1e-7);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]
    /// What the axes say is what one finds beside the hit.
    #[test]
    fn axes_are_changes_of_values(angle in 0.0f32..6.0, sx in 0.5f32..2.0, sy in -2.0f32..-0.5,
                                  u in 0.1f32..0.45, v in 0.1f32..0.45, tilt in -1.0f32..1.0) {
        let turn = Quat::from_axis_angle(Vec3::new(0.6, 0.0, 0.8), angle);
        let transform = Affine3A::from_scale_rotation_translation(Vec3::new(sx, sy, 1.3), turn, Vec3::new(1.0, 2.0, -3.0));
        let scene = scene(transform);
        let tables = tables(&scene);
        let direction = (turn * Vec3::new(tilt, 0.3, -1.0)).normalize();
        let hit = Hit { instance: 0, primitive: 0, t: 2.0, u, v };
        let point = tables.point(&scene, &hit, &path(direction));
        for (axis, part) in [Part::AxisA, Part::AxisB].into_iter().enumerate() {
            let step = point.weights_along[axis];
            let beside = Hit { u: u + step.x, v: v + step.y, ..hit };
            let moved = tables.point(&scene, &beside, &path(direction));
            let distance = (moved.position - point.position - point.axes[axis]).length();
            prop_assert!(distance < 1e-5, "{distance}");
            for kind in [InputKind::Uv(0), InputKind::Position, InputKind::Generated, InputKind::Object,
                         InputKind::Camera, InputKind::Window, InputKind::Parametric,
                         InputKind::Attribute(0), InputKind::Normal] {
                let value = rows_of(&scene, &[point, moved], kind, Part::Value);
                let change = rows_of(&scene, &[point], kind, part);
                for c in 0..kind.width() {
                    let expected = value[1][c] - value[0][c];
                    prop_assert!((change[0][c] - expected).abs() < 2e-5, "{kind:?} {} {expected}", change[0][c]);
                }
            }
        }
    }
}
