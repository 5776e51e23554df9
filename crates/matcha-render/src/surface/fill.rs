//! Input rows of a group of points, one quantity at a time.

use super::tables::{SurfaceTables, material_of};
use crate::device::surface_input::*;
use crate::device::surface_path::path_quantity;
use crate::device::surface_point::{SurfacePlacement, SurfacePoint};
use crate::scene::{Instance, Mesh, Scene};
use glam::{Vec2, Vec3, Vec4};
use matcha_shade::device::input_code::INPUT_PART_VALUE;
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

    fn placement(&self, point: &SurfacePoint) -> &SurfacePlacement {
        &self.tables.placed[point.instance as usize]
    }

    fn gradients(&self, point: &SurfacePoint, name: u16) -> SurfaceGradients {
        let (corners, uv) = (self.corners(point), self.uv(point, name));
        surface_gradients(self.placement(point), corners, uv)
    }

    /// Change of the unit shading normal along an axis.
    fn normal_along(&self, point: &SurfacePoint, part: u32) -> Vec3 {
        let normals = &self.mesh(point).corner_normals;
        normals
            .get(point.primitive as usize)
            .map_or(Vec3::ZERO, |normals| {
                surface_normal_along(point, self.placement(point), *normals, part)
            })
    }

    /// Tangent with its sign: MikkTSpace's where the mesh has it, otherwise along dP/du.
    fn tangent(&self, point: &SurfacePoint, name: u16) -> SurfaceTangent {
        let mesh = self.instance(point).mesh;
        let set = self.tables.uv_set(self.scene, mesh, name);
        if let Some(corners) = set.and_then(|set| set.tangents.get(point.primitive as usize)) {
            let directions = corners.map(Vec4::truncate);
            let placement = self.placement(point);
            return surface_tangent_of_corners(point, placement, directions, corners[0].w);
        }
        surface_tangent_of_gradients(point, self.gradients(point, name))
    }

    fn generated(&self, point: &SurfacePoint, part: u32) -> Vec3 {
        let mesh = self.mesh(point);
        let blend = surface_blend(point, part);
        if let Some(corners) = mesh.generated.get(point.primitive as usize) {
            return surface_linear3(blend, *corners);
        }
        let object = surface_linear3(blend, self.corners(point));
        surface_generated(object, part, mesh.generated_origin, mesh.generated_size)
    }

    fn pointiness(&self, point: &SurfacePoint) -> f32 {
        let instance = self.instance(point);
        let Some(values) = self.tables.pointiness.get(instance.mesh as usize) else {
            return 0.5;
        };
        let vertices = self.mesh(point).indices[point.primitive as usize];
        let [a, b, c] = vertices.map(|v| values[v as usize]);
        surface_linear(surface_blend(point, INPUT_PART_VALUE), a, b, c)
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
    let part = input.part.code();
    let view = source.tables.view;
    match input.kind {
        Uv(name) => each(rows, first, points, |p| {
            surface_linear2(surface_blend(p, part), source.uv(p, name)).to_array()
        }),
        Attribute(name) => each(rows, first, points, |p| {
            let [a, b, c] = source.attribute(p, name).map(|corner| corner.to_array());
            let blend = surface_blend(p, part);
            std::array::from_fn::<f32, 4, _>(|k| surface_linear(blend, a[k], b[k], c[k]))
        }),
        Normal if input.part != Part::Value => {
            each3(rows, first, points, |p| source.normal_along(p, part));
        }
        Generated => each3(rows, first, points, |p| source.generated(p, part)),
        Object => each3(rows, first, points, |p| {
            surface_linear3(surface_blend(p, part), source.corners(p))
        }),
        Position if input.part == Part::Value => each3(rows, first, points, |p| p.position),
        Position => each3(rows, first, points, |p| surface_axis(p, part)),
        Normal => each3(rows, first, points, |p| p.normal),
        Camera => each3(rows, first, points, |p| surface_camera(view, p, part)),
        Window => each3(rows, first, points, |p| surface_window(view, p, part)),
        Parametric => each(rows, first, points, |p| {
            surface_parametric(p, part).to_array()
        }),
        TrueNormal => each3(rows, first, points, |p| p.true_normal),
        Incoming => each3(rows, first, points, |p| p.outgoing),
        Tangent(name) => each3(rows, first, points, |p| source.tangent(p, name).direction),
        TangentSign(name) => each1(rows, first, points, |p| source.tangent(p, name).sign),
        DpDu(name) => each3(rows, first, points, |p| source.gradients(p, name).u),
        DpDv(name) => each3(rows, first, points, |p| source.gradients(p, name).v),
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
        Backfacing => each1(rows, first, points, |p| p.backfacing as f32),
        Pointiness => each1(rows, first, points, |p| source.pointiness(p)),
        RandomPerIsland => each1(rows, first, points, |p| source.island(p)),
        ObjectLocation => {
            each3(rows, first, points, |p| source.placement(p).origin);
        }
        ObjectColor => each3(rows, first, points, |p| source.instance(p).color.truncate()),
        ObjectAlpha => each1(rows, first, points, |p| source.instance(p).color.w),
        ObjectIndex => each1(rows, first, points, |p| source.instance(p).pass_index),
        ObjectRandom => each1(rows, first, points, |p| source.instance(p).random),
        MaterialIndex => each1(rows, first, points, |p| source.material_index(p)),
        _ => {
            let (code, _) = kind.code();
            each1(rows, first, points, |p| path_quantity(code, p.path));
        }
    }
}
