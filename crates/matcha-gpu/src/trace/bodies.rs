//! What acceleration structures are built of: meshes, each once, and instances of them.

use super::TraceError;
use glam::{Affine3A, Vec3};
use matcha_render::accel::{Bounds, is_hittable, is_near};
use matcha_render::scene::{Mesh, Scene};
use std::collections::HashMap;

/// Instances that a structure can number: a hit tells 24 bits.
const NUMBERED: u32 = 1 << 24;

/// What a device's structures hold.
#[derive(Clone, Copy, Debug)]
pub(super) struct StructureLimits {
    /// Triangles of a mesh, and vertices.
    pub triangles: u32,
    /// Instances.
    pub instances: u32,
}

/// A mesh in a structure of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Body {
    mesh: usize,
    /// Where it lies, if its structure is in world space: where a transform has no inverse.
    baked: Option<Affine3A>,
}

/// An instance of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stand {
    pub body: usize,
    pub transform: Affine3A,
    pub instance: u32,
    pub mask: u8,
}

/// Which structures there shall be.
#[derive(Clone, Debug, Default)]
pub(super) struct Plan {
    pub bodies: Vec<Body>,
    pub stands: Vec<Stand>,
}

impl Plan {
    /// Those of a scene; `masks` has the visibility of each instance.
    pub(super) fn new(
        scene: &Scene,
        masks: &[u8],
        limits: &StructureLimits,
    ) -> Result<Plan, TraceError> {
        let most = limits.instances.min(NUMBERED);
        if scene.instances.len() > most as usize {
            return Err(TraceError::TooManyInstances {
                instances: scene.instances.len(),
                most,
            });
        }
        let mut plan = Plan::default();
        let mut shared: HashMap<usize, usize> = HashMap::new();
        for (i, (instance, &mask)) in scene.instances.iter().zip(masks).enumerate() {
            let transform = instance.transform;
            if mask == 0 || !transform.is_finite() {
                continue;
            }
            let mesh = instance.mesh as usize;
            check(&scene.meshes[mesh], limits)?;
            let singular = !transform.inverse().is_finite();
            let next = plan.bodies.len();
            let body = if singular {
                next
            } else {
                *shared.entry(mesh).or_insert(next)
            };
            if body == next {
                let baked = singular.then_some(transform);
                plan.bodies.push(Body { mesh, baked });
            }
            plan.stands.push(Stand {
                body,
                transform: if singular {
                    Affine3A::IDENTITY
                } else {
                    transform
                },
                instance: i as u32,
                mask,
            });
        }
        Ok(plan)
    }
}

fn check(mesh: &Mesh, limits: &StructureLimits) -> Result<(), TraceError> {
    let elements = mesh.indices.len().max(mesh.positions.len());
    if elements > limits.triangles as usize {
        return Err(TraceError::MeshTooLarge {
            mesh: mesh.name.clone(),
            elements,
            most: limits.triangles,
        });
    }
    Ok(())
}

/// Vertices and triangles of a body.
pub(super) struct Geometry {
    pub positions: Vec<[f32; 3]>,
    pub indices: Vec<[u32; 3]>,
    /// Of what can be hit.
    pub bounds: Bounds,
}

impl Geometry {
    /// That of a body; nothing if no ray can hit it. Triangles keep their numbers: those that
    /// the walk leaves out become points on one that it does not.
    pub(super) fn of(body: &Body, scene: &Scene) -> Option<Geometry> {
        let mesh = &scene.meshes[body.mesh];
        let mut positions = mesh.positions.clone();
        if let Some(transform) = &body.baked {
            for p in &mut positions {
                *p = transform.transform_point3(*p);
            }
        }
        let corners = |indices: &[u32; 3]| indices.map(|i| positions.get(i as usize).copied());
        let hittable = |indices: &[u32; 3]| match corners(indices) {
            [Some(a), Some(b), Some(c)] => is_hittable([a, b, c]),
            _ => false,
        };
        let somewhere = mesh.indices.iter().find(|t| hittable(t))?[0];
        let mut bounds = Bounds::EMPTY;
        let mut indices = mesh.indices.clone();
        for triangle in &mut indices {
            if hittable(triangle) {
                corners(triangle)
                    .into_iter()
                    .flatten()
                    .for_each(|p| bounds.grow(p));
            } else {
                *triangle = [somewhere; 3];
            }
        }
        // What nothing refers to any more may be no number.
        let number = |p: Vec3| if is_near(p) { p } else { Vec3::ZERO };
        Some(Geometry {
            positions: positions.into_iter().map(|p| number(p).into()).collect(),
            indices,
            bounds,
        })
    }
}

/// False where some corner of a box is at no place that rays can be told by.
pub(super) fn is_sound(bounds: &Bounds, transform: &Affine3A) -> bool {
    let sides = [bounds.min, bounds.max];
    (0..8).all(|k: usize| {
        let corner = Vec3::new(sides[k & 1].x, sides[k >> 1 & 1].y, sides[k >> 2].z);
        is_near(transform.transform_point3(corner))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Mat3;
    use matcha_render::scene::Instance;

    const LIMITS: StructureLimits = StructureLimits {
        triangles: 4,
        instances: 3,
    };

    fn pane() -> Mesh {
        Mesh {
            name: "pane".to_owned(),
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::splat(f32::NAN)],
            indices: vec![[0, 1, 3], [1, 1, 2], [0, 1, 2]],
            ..Mesh::default()
        }
    }

    fn scene(transforms: &[Affine3A]) -> Scene {
        let place = |&transform: &Affine3A| Instance {
            name: String::new(),
            mesh: 0,
            transform,
            materials: vec![],
            pass_index: 0.0,
            random: 0.0,
            color: glam::Vec4::ONE,
            visibility: Default::default(),
            holdout: false,
        };
        Scene {
            meshes: vec![pane()],
            instances: transforms.iter().map(place).collect(),
            ..Scene::default()
        }
    }

    #[test]
    fn instances_share_their_mesh_unless_they_are_flat() {
        let flat = Affine3A::from_mat3(Mat3::from_diagonal(Vec3::new(2.0, 3.0, 0.0)));
        let moved = Affine3A::from_translation(Vec3::Z);
        let scene = scene(&[moved, flat, Affine3A::IDENTITY]);
        let plan = Plan::new(&scene, &[1, 2, 4], &LIMITS).expect("it fits");
        let stands: Vec<_> = plan
            .stands
            .iter()
            .map(|s| (s.body, s.instance, s.mask))
            .collect();
        assert_eq!(stands, [(0, 0, 1), (1, 1, 2), (0, 2, 4)]);
        assert_eq!(plan.stands[1].transform, Affine3A::IDENTITY);
        let baked = Geometry::of(&plan.bodies[1], &scene).expect("it can be hit");
        assert_eq!(baked.positions[2], [0.0, 3.0, 0.0]);
        let hidden = Plan::new(&scene, &[0, 2, 0], &LIMITS).expect("it fits");
        assert_eq!((hidden.bodies.len(), hidden.stands.len()), (1, 1));
    }

    #[test]
    fn triangles_keep_their_numbers_and_none_is_at_no_place() {
        let scene = scene(&[Affine3A::IDENTITY]);
        let body = Body {
            mesh: 0,
            baked: None,
        };
        let geometry = Geometry::of(&body, &scene).expect("one can be hit");
        assert_eq!(geometry.indices, [[0, 0, 0], [0, 0, 0], [0, 1, 2]]);
        assert!(
            geometry
                .positions
                .as_flattened()
                .iter()
                .all(|x| x.is_finite())
        );
        assert_eq!(geometry.bounds.max, Vec3::new(1.0, 1.0, 0.0));
        let far = Affine3A::from_translation(Vec3::X * 2e18);
        assert!(is_sound(&geometry.bounds, &Affine3A::IDENTITY));
        assert!(!is_sound(&geometry.bounds, &far));
    }

    #[test]
    fn more_than_structures_hold_is_refused_in_a_sentence() {
        let four = scene(&[Affine3A::IDENTITY; 4]);
        let error = Plan::new(&four, &[1; 4], &LIMITS).expect_err("three are held");
        assert_eq!(
            error.to_string(),
            "the scene has 4 instances, but the device's acceleration structures hold 3: render without --ray-queries"
        );
        let limits = StructureLimits {
            triangles: 3,
            ..LIMITS
        };
        let one = scene(&[Affine3A::IDENTITY]);
        let error = Plan::new(&one, &[1], &limits).expect_err("four vertices");
        assert!(error.to_string().contains("\"pane\" has 4"), "{error}");
    }
}
