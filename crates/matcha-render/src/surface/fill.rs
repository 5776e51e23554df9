//! Input rows of a group of points, one quantity at a time.

use super::point::{PathInfo, SurfacePoint};
use super::tables::{SurfaceTables, material_of, unit_or};
use crate::integrator::path::flags;
use crate::scene::{Instance, Mesh, Scene};
use glam::{Vec2, Vec3, Vec3A, Vec4};
use matcha_shade::input::{Input, InputKind, Part};
use matcha_shade::rows::Rows;

/// The rows of one quantity.
pub(super) struct Sink<'a> {
    rows: [&'a mut [f32]; 4],
}

impl<'a> Sink<'a> {
    /// `width` rows from `first` on, cut to `n` points.
    pub(super) fn new(rows: &'a mut Rows, width: usize, first: usize, n: usize) -> Self {
        let mut sink = Self {
            rows: Default::default(),
        };
        for (slot, row) in sink.rows.iter_mut().zip(rows.rows_mut(first, width)) {
            *slot = &mut row[..n];
        }
        sink
    }
}

/// Writes as many components as the sink has rows.
#[inline(always)]
pub(super) fn write(sink: &mut Sink, i: usize, value: [f32; 4]) {
    for (row, value) in sink.rows.iter_mut().zip(value) {
        if let Some(slot) = row.get_mut(i) {
            *slot = value;
        }
    }
}

fn each<const N: usize>(
    rows: &mut Rows,
    first: usize,
    points: &[SurfacePoint],
    value: impl Fn(&SurfacePoint) -> [f32; N],
) {
    let mut targets = rows.rows_mut(first, N);
    let targets: [&mut [f32]; N] = std::array::from_fn(|_| {
        targets
            .next()
            .map_or(&mut [][..], |row| &mut row[..points.len()])
    });
    for (i, point) in points.iter().enumerate() {
        let value = value(point);
        for c in 0..N {
            targets[c][i] = value[c];
        }
    }
}

fn each3(
    rows: &mut Rows,
    first: usize,
    points: &[SurfacePoint],
    value: impl Fn(&SurfacePoint) -> Vec3,
) {
    each(rows, first, points, |point| value(point).to_array());
}

fn each1(
    rows: &mut Rows,
    first: usize,
    points: &[SurfacePoint],
    value: impl Fn(&SurfacePoint) -> f32,
) {
    each(rows, first, points, |point| [value(point)]);
}

/// What a part takes of a quantity that is linear over the triangle.
#[inline(always)]
fn linear<V>(point: &SurfacePoint, part: Part, [a, b, c]: [V; 3]) -> V
where
    V: Copy
        + std::ops::Add<Output = V>
        + std::ops::Sub<Output = V>
        + std::ops::Mul<f32, Output = V>,
{
    let (ab, ac) = (b - a, c - a);
    match part {
        Part::Value => a + ab * point.weights.x + ac * point.weights.y,
        Part::AxisA => ab * point.weights_along[0].x + ac * point.weights_along[0].y,
        Part::AxisB => ab * point.weights_along[1].x + ac * point.weights_along[1].y,
    }
}

/// A world vector of a part.
#[inline(always)]
fn axis(point: &SurfacePoint, part: Part) -> Vec3 {
    if part == Part::AxisA {
        point.axes[0]
    } else {
        point.axes[1]
    }
}

/// Numbers that belong to the path; none for other quantities.
pub(super) fn path_quantity(kind: InputKind, path: &PathInfo) -> Option<f32> {
    let flag = |bit: u32| f32::from(u8::from(path.flags & bit != 0));
    Some(match kind {
        InputKind::IsCameraRay => flag(flags::CAMERA),
        InputKind::IsShadowRay => flag(flags::SHADOW),
        InputKind::IsDiffuseRay => flag(flags::DIFFUSE),
        InputKind::IsGlossyRay => flag(flags::GLOSSY),
        InputKind::IsSingularRay => flag(flags::SINGULAR),
        InputKind::IsReflectionRay => flag(flags::REFLECT),
        InputKind::IsTransmissionRay => flag(flags::TRANSMIT),
        InputKind::RayLength => path.ray_length,
        InputKind::RayDepth => f32::from(path.bounce),
        InputKind::DiffuseDepth => f32::from(path.diffuse),
        InputKind::GlossyDepth => f32::from(path.glossy),
        InputKind::TransparentDepth => f32::from(path.transparent),
        InputKind::TransmissionDepth => f32::from(path.transmission),
        _ => return None,
    })
}

/// Change of world position with u and v of a triangle with these UVs; zero where UVs collapse.
fn position_gradients(corners: [Vec3; 3], uv: [Vec2; 3]) -> [Vec3; 2] {
    let [e1, e2] = [corners[1] - corners[0], corners[2] - corners[0]];
    let [d1, d2] = [uv[1] - uv[0], uv[2] - uv[0]];
    let determinant = d1.perp_dot(d2);
    let inverse = 1.0 / determinant;
    if !inverse.is_finite() {
        return [Vec3::ZERO; 2];
    }
    [
        (e1 * d2.y - e2 * d1.y) * inverse,
        (e2 * d1.x - e1 * d2.x) * inverse,
    ]
}

/// A scene, its tables and how to find a point's mesh.
struct Source<'a> {
    tables: &'a SurfaceTables,
    scene: &'a Scene,
}

impl Source<'_> {
    #[inline(always)]
    fn instance(&self, point: &SurfacePoint) -> &Instance {
        &self.scene.instances[point.instance as usize]
    }

    #[inline(always)]
    fn mesh(&self, point: &SurfacePoint) -> &Mesh {
        &self.scene.meshes[self.instance(point).mesh as usize]
    }

    /// Positions of the corners, object space.
    #[inline(always)]
    fn corners(&self, point: &SurfacePoint) -> [Vec3; 3] {
        let mesh = self.mesh(point);
        mesh.indices[point.primitive as usize].map(|v| mesh.positions[v as usize])
    }

    #[inline(always)]
    fn uv(&self, point: &SurfacePoint, name: u16) -> [Vec2; 3] {
        let mesh = self.instance(point).mesh;
        let set = self.tables.uv_set(self.scene, mesh, name);
        set.and_then(|set| set.corners.get(point.primitive as usize))
            .copied()
            .unwrap_or_default()
    }

    fn attribute(&self, point: &SurfacePoint, name: u16) -> [Vec4; 3] {
        let mesh = self.instance(point).mesh;
        let corners = self
            .tables
            .attribute(self.scene, mesh, name, point.primitive);
        corners.copied().unwrap_or([Vec4::ZERO; 3])
    }

    fn gradients(&self, point: &SurfacePoint, name: u16) -> [Vec3; 2] {
        let transform = self.instance(point).transform;
        let [u, v] = position_gradients(self.corners(point), self.uv(point, name));
        [
            transform.transform_vector3(u),
            transform.transform_vector3(v),
        ]
    }

    /// Change of the unit shading normal along an axis.
    fn normal_along(&self, point: &SurfacePoint, part: Part) -> Vec3 {
        let Some(normals) = self
            .mesh(point)
            .corner_normals
            .get(point.primitive as usize)
        else {
            return Vec3::ZERO;
        };
        let matrix = self.tables.placed[point.instance as usize].normals;
        let sum = Vec3::from(matrix * Vec3A::from(linear(point, Part::Value, *normals)));
        let change = Vec3::from(matrix * Vec3A::from(linear(point, part, *normals)));
        let length = sum.length();
        if length <= 0.0 {
            return Vec3::ZERO;
        }
        let sign = if point.backfacing { -1.0 } else { 1.0 };
        let unit = sum / length;
        (change - unit * unit.dot(change)) * (sign / length)
    }

    /// Tangent with its sign: MikkTSpace's where the mesh has it, otherwise along dP/du.
    fn tangent(&self, point: &SurfacePoint, name: u16) -> (Vec3, f32) {
        let instance = self.instance(point);
        let handedness = self.tables.placed[point.instance as usize].handedness;
        let set = self.tables.uv_set(self.scene, instance.mesh, name);
        if let Some(corners) = set.and_then(|set| set.tangents.get(point.primitive as usize)) {
            let tangent = linear(point, Part::Value, *corners);
            let world = instance.transform.transform_vector3(tangent.truncate());
            return (unit_or(world, Vec3::ZERO), handedness * corners[0].w);
        }
        let [u, v] = self.gradients(point, name);
        let front = if point.backfacing {
            -point.normal
        } else {
            point.normal
        };
        let side = u.cross(v).dot(front);
        let tangent = unit_or(u - front * front.dot(u), Vec3::ZERO);
        (tangent, if side < 0.0 { -1.0 } else { 1.0 })
    }

    fn generated(&self, point: &SurfacePoint, part: Part) -> Vec3 {
        let mesh = self.mesh(point);
        if let Some(corners) = mesh.generated.get(point.primitive as usize) {
            return linear(point, part, *corners);
        }
        let object = linear(point, part, self.corners(point));
        let offset = if part == Part::Value {
            mesh.generated_origin
        } else {
            Vec3::ZERO
        };
        let size = mesh.generated_size;
        let scale = |s: f32| if s != 0.0 { 1.0 / s } else { 0.0 };
        (object - offset) * Vec3::new(scale(size.x), scale(size.y), scale(size.z))
    }

    fn window(&self, point: &SurfacePoint, part: Part) -> Vec3 {
        let view = &self.tables.view;
        let here = view.window_coordinates(point.position);
        match part {
            Part::Value => here,
            part => view.window_coordinates(point.position + axis(point, part)) - here,
        }
    }

    fn camera(&self, point: &SurfacePoint, part: Part) -> Vec3 {
        let view = &self.tables.view;
        match part {
            Part::Value => view.camera_coordinates(point.position),
            part => view.camera_coordinates_of(axis(point, part)),
        }
    }

    fn pointiness(&self, point: &SurfacePoint) -> f32 {
        let instance = self.instance(point);
        let Some(values) = self.tables.pointiness.get(instance.mesh as usize) else {
            return 0.5;
        };
        let vertices = self.mesh(point).indices[point.primitive as usize];
        linear(point, Part::Value, vertices.map(|v| values[v as usize]))
    }

    fn material_index(&self, point: &SurfacePoint) -> f32 {
        let material = material_of(self.scene, point.instance, point.primitive);
        material
            .and_then(|m| self.scene.materials.get(m as usize))
            .map_or(0.0, |m| m.pass_index)
    }

    fn island(&self, point: &SurfacePoint) -> f32 {
        let islands = self.tables.islands.get(self.instance(point).mesh as usize);
        islands.map_or(0.0, |values| values[point.primitive as usize])
    }
}

impl SurfaceTables {
    /// Writes the rows that a program reads for a group of points. Layers that a mesh lacks read
    /// zero.
    pub fn fill(
        &self,
        scene: &Scene,
        inputs: &[(Input, usize)],
        points: &[SurfacePoint],
        rows: &mut Rows,
    ) {
        let source = Source {
            tables: self,
            scene,
        };
        for &(input, first) in inputs {
            if input.part != Part::Value && !input.kind.is_differentiable() {
                for row in rows.rows_mut(first, input.kind.width()) {
                    row.fill(0.0);
                }
                continue;
            }
            if !fill_varying(&source, input, first, points, rows) {
                fill_constant(&source, input.kind, first, points, rows);
            }
        }
    }
}

/// Quantities that change over a surface; false where `input` is none of them.
fn fill_varying(
    source: &Source,
    input: Input,
    first: usize,
    points: &[SurfacePoint],
    rows: &mut Rows,
) -> bool {
    use InputKind::*;
    let part = input.part;
    match input.kind {
        Uv(name) => each(rows, first, points, |p| {
            linear(p, part, source.uv(p, name)).to_array()
        }),
        Attribute(name) => {
            each(rows, first, points, |p| {
                linear(p, part, source.attribute(p, name)).to_array()
            });
        }
        Position if part == Part::Value => each3(rows, first, points, |p| p.position),
        Position => each3(rows, first, points, |p| axis(p, part)),
        Normal if part == Part::Value => each3(rows, first, points, |p| p.normal),
        Normal => each3(rows, first, points, |p| source.normal_along(p, part)),
        Generated => each3(rows, first, points, |p| source.generated(p, part)),
        Object => each3(rows, first, points, |p| linear(p, part, source.corners(p))),
        Camera => each3(rows, first, points, |p| source.camera(p, part)),
        Window => each3(rows, first, points, |p| source.window(p, part)),
        Parametric => each(rows, first, points, |p| match part {
            Part::Value => p.weights.to_array(),
            Part::AxisA => p.weights_along[0].to_array(),
            Part::AxisB => p.weights_along[1].to_array(),
        }),
        TrueNormal => each3(rows, first, points, |p| p.true_normal),
        Incoming => each3(rows, first, points, |p| p.outgoing),
        Tangent(name) => each3(rows, first, points, |p| source.tangent(p, name).0),
        TangentSign(name) => each1(rows, first, points, |p| source.tangent(p, name).1),
        DpDu(name) => each3(rows, first, points, |p| source.gradients(p, name)[0]),
        DpDv(name) => each3(rows, first, points, |p| source.gradients(p, name)[1]),
        _ => return false,
    }
    true
}

/// Quantities of the object, the material and the path.
fn fill_constant(
    source: &Source,
    kind: InputKind,
    first: usize,
    points: &[SurfacePoint],
    rows: &mut Rows,
) {
    use InputKind::*;
    match kind {
        Backfacing => each1(rows, first, points, |p| f32::from(u8::from(p.backfacing))),
        Pointiness => each1(rows, first, points, |p| source.pointiness(p)),
        RandomPerIsland => each1(rows, first, points, |p| source.island(p)),
        ObjectLocation => {
            each3(rows, first, points, |p| {
                source.instance(p).transform.translation.into()
            });
        }
        ObjectColor => each3(rows, first, points, |p| source.instance(p).color.truncate()),
        ObjectAlpha => each1(rows, first, points, |p| source.instance(p).color.w),
        ObjectIndex => each1(rows, first, points, |p| source.instance(p).pass_index),
        ObjectRandom => each1(rows, first, points, |p| source.instance(p).random),
        MaterialIndex => each1(rows, first, points, |p| source.material_index(p)),
        _ => each1(rows, first, points, |p| {
            path_quantity(kind, &p.path).unwrap_or(0.0)
        }),
    }
}
