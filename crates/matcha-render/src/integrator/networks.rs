//! Node networks over groups of points: input rows, the machine, output rows, closures.

use super::Frame;
use super::path::Path;
use super::worker::SurfaceTask;
use crate::accel::Hit;
use crate::closure::{self, ClosureContext, LobeSet, code, prepare_closure};
use crate::device::closure_glow::{ClosureGlow, closure_glow};
use crate::device::closure_rows::{ClosureRows, closure_radiance, closure_shading_normal};
use crate::device::path_meet::path_shadow_info;
use crate::node_cache::{GroupKeys, MaterialCache};
use crate::surface::{BackgroundRay, PathInfo, SurfacePoint, fill_background};
use glam::Vec3;
use matcha_cache::{CacheCounts, Found};
use matcha_shade::closure::ClosureKind;
use matcha_shade::program::{ClosureOutput, Program};
use matcha_shade::rows::Rows;
use matcha_shade::vm::{Isa, Machine, NodeCache, Texels};
use std::time::{Duration, Instant};

/// Rows of the largest closure, with room.
const MOST_ROWS: usize = 64;

/// One thread's machine and its buffers.
pub struct Networks {
    machine: Machine,
    /// The group whose results are in `outputs`.
    group: Group,
    /// The one that is evaluated next.
    announced: Group,
    outputs: Rows,
    rays: Vec<BackgroundRay>,
    background: Rows,
    found: Vec<f32>,
    colors: Vec<Vec3>,
    looked_up: Found,
    /// What the cache did for this thread.
    pub counts: CacheCounts,
    /// Time spent in the machine.
    pub time: Duration,
}

/// Hits on one material, and what their evaluation starts from.
#[derive(Default)]
struct Group {
    material: u32,
    points: Vec<SurfacePoint>,
    inputs: Rows,
    texels: Vec<Texels>,
    keys: GroupKeys,
}

impl Group {
    /// Everything up to the keys of the look-ups, whose cells are then on their way.
    fn prepare(&mut self, frame: &Frame) {
        let program = frame.program(self.material);
        let n = self.points.len();
        self.inputs.resize(program.input_rows(), n);
        frame.prepared.surfaces.fill(
            frame.scene(),
            &program.inputs,
            &self.points,
            &mut self.inputs,
        );
        let offset = frame.cache.map_or(0.0, |cache| cache.level_offset);
        Texels::of_regions(&mut self.texels, program, n, &self.inputs, offset);
        if let Some(cache) = frame.cache {
            let layout = &cache.layouts[self.material as usize];
            self.keys.prepare(cache.table, layout, &self.texels);
        }
    }
}

impl Networks {
    /// Empty buffers and a machine for some instructions, or the best where the processor
    /// lacks them.
    pub fn new(isa: Isa) -> Self {
        Self {
            machine: Machine::new(Some(isa)),
            group: Group::default(),
            announced: Group::default(),
            outputs: Rows::default(),
            rays: Vec::new(),
            background: Rows::default(),
            found: Vec::new(),
            colors: Vec::new(),
            looked_up: Found::default(),
            counts: CacheCounts::default(),
            time: Duration::ZERO,
        }
    }

    /// Prepares the evaluation of a material at the hits of a group, so that memory has time
    /// to bring what will be looked up. It becomes [`Networks::evaluate`]'s group; what the
    /// one before it gave can still be read until then.
    pub fn announce_surfaces(&mut self, frame: &Frame, group: &[SurfaceTask], paths: &[Path]) {
        let hits = group
            .iter()
            .map(|task| (task.hit, paths[task.path as usize].info(task.hit.t)));
        self.announce(frame, group[0].material, hits);
    }

    fn announce(
        &mut self,
        frame: &Frame,
        material: u32,
        hits: impl Iterator<Item = (Hit, PathInfo)>,
    ) {
        let group = &mut self.announced;
        group.material = material;
        group.points.clear();
        group.points.extend(
            hits.map(|(hit, path)| frame.prepared.surfaces.point(frame.scene(), &hit, &path)),
        );
        let start = Instant::now();
        group.prepare(frame);
        self.time += start.elapsed();
    }

    /// Makes the announced group the one to evaluate and to read; another may be announced.
    pub fn advance(&mut self) {
        std::mem::swap(&mut self.group, &mut self.announced);
    }

    /// Evaluates the group.
    pub fn evaluate(&mut self, frame: &Frame) {
        let start = Instant::now();
        let group = &self.group;
        let n = group.points.len();
        self.found.clear();
        self.found.resize(n, 0.0);
        let mut cache = frame.cache.map(|cache| MaterialCache {
            table: cache.table,
            layout: &cache.layouts[group.material as usize],
            keys: &group.keys,
            found_nodes: &mut self.found,
            counts: &mut self.counts,
            found: &mut self.looked_up,
        });
        self.machine.run(
            frame.program(group.material),
            n,
            &group.inputs,
            &group.texels,
            &frame.prepared.textures,
            cache.as_mut().map(|cache| cache as &mut dyn NodeCache),
            &mut self.outputs,
        );
        self.time += start.elapsed();
    }

    /// Cacheable nodes that the cache had for point `i` of the group.
    pub fn nodes_found(&self, i: usize) -> f32 {
        self.found[i]
    }

    /// Point `i` of the group.
    pub fn point(&self, i: usize) -> &SurfacePoint {
        &self.group.points[i]
    }

    /// Builds the closures of point `i` of the group.
    pub fn closures(&self, frame: &Frame, i: usize, context: &ClosureContext, lobes: &mut LobeSet) {
        let program = frame.program(self.group.material);
        build_lobes(program, &self.outputs, i, self.point(i), context, lobes);
    }

    /// Evaluates the world in the directions of paths that left the scene.
    pub fn world_of_paths(&mut self, frame: &Frame, escaped: &[u32], paths: &[Path]) {
        self.rays.clear();
        self.rays.extend(
            escaped
                .iter()
                .map(|&path| paths[path as usize].info(f32::MAX)),
        );
        self.world(frame);
    }

    /// Evaluates the world in directions that next-event estimation sampled.
    pub fn world_of_directions(&mut self, frame: &Frame, directions: impl Iterator<Item = Vec3>) {
        self.rays.clear();
        self.rays
            .extend(directions.map(|d| path_shadow_info(d, 0.0)));
        self.world(frame);
    }

    fn world(&mut self, frame: &Frame) {
        match frame.world_program() {
            Ok(program) => self.run_background(frame, program),
            Err(constant) => {
                self.colors.clear();
                self.colors.resize(self.rays.len(), constant);
            }
        }
    }

    fn run_background(&mut self, frame: &Frame, program: &Program) {
        let n = self.rays.len();
        let start = Instant::now();
        self.background.resize(program.input_rows(), n);
        fill_background(
            &frame.prepared.view,
            &program.inputs,
            &self.rays,
            &mut self.background,
        );
        self.machine.run(
            program,
            n,
            &self.background,
            &[],
            &frame.prepared.textures,
            None,
            &mut self.outputs,
        );
        self.time += start.elapsed();
        self.colors.clear();
        self.colors
            .extend((0..n).map(|i| radiance(program, &self.outputs, i)));
    }

    /// What the node tree of an analytic light emits in the direction of a ray that meets it
    /// at `distance`; white where it has none.
    ///
    /// A light's tree reads the direction as the world's does: lights have no surface that
    /// programs could ask about.
    pub fn light_radiance(
        &mut self,
        frame: &Frame,
        light: u32,
        direction: Vec3,
        distance: f32,
    ) -> Vec3 {
        let scene_light = frame.prepared.lights.analytic()[light as usize].scene_light;
        let Some(program) = frame.prepared.light_program(scene_light) else {
            return Vec3::ONE;
        };
        self.rays.clear();
        self.rays.push(path_shadow_info(direction, distance));
        self.run_background(frame, program);
        self.colors[0]
    }

    /// Radiance of the world in direction `i`.
    pub fn world_radiance(&self, i: usize) -> Vec3 {
        self.colors[i]
    }

    /// Evaluates what a material emits at points towards where light was sampled from;
    /// directions are those of the shadow rays, towards the points.
    pub fn emission_of_points(
        &mut self,
        frame: &Frame,
        material: u32,
        points: impl Iterator<Item = (Hit, Vec3)>,
    ) {
        self.shadow_points(frame, material, points);
        self.collect(frame, |glow| glow.emission);
    }

    /// Emission of point `i`.
    pub fn emission(&self, i: usize) -> Vec3 {
        self.colors[i]
    }

    /// Evaluates how much light passes straight through a material at points on shadow rays.
    pub fn transparency_of_points(
        &mut self,
        frame: &Frame,
        material: u32,
        points: impl Iterator<Item = (Hit, Vec3)>,
    ) {
        self.shadow_points(frame, material, points);
        self.collect(frame, |glow| glow.transparency);
    }

    /// Transparency of point `i`.
    pub fn transparency(&self, i: usize) -> Vec3 {
        self.colors[i]
    }

    fn shadow_points(
        &mut self,
        frame: &Frame,
        material: u32,
        points: impl Iterator<Item = (Hit, Vec3)>,
    ) {
        self.announce(
            frame,
            material,
            points.map(|(hit, towards)| (hit, path_shadow_info(towards, 0.0))),
        );
        self.advance();
        self.evaluate(frame);
    }

    /// Keeps what the closures of each point let `read` see, summed.
    fn collect(&mut self, frame: &Frame, read: impl Fn(&ClosureGlow) -> Vec3) {
        let program = frame.program(self.group.material);
        self.colors.clear();
        for (i, point) in self.group.points.iter().enumerate() {
            let geometry = closure_frame(program, &self.outputs, i, point);
            let mut buffer = [0.0; MOST_ROWS];
            let glow = |c: &ClosureOutput| {
                let rows = rows(c, &self.outputs, i, &mut buffer);
                read(&closure_glow(code(c.kind), rows, geometry))
            };
            self.colors.push(program.closures.iter().map(glow).sum());
        }
    }
}

impl Default for Networks {
    fn default() -> Self {
        Self::new(Isa::best())
    }
}

/// Sum of the emitting closures of point `i`: a world's or a light's radiance.
pub fn radiance(program: &Program, outputs: &Rows, i: usize) -> Vec3 {
    let mut buffer = [0.0; MOST_ROWS];
    program
        .closures
        .iter()
        .map(|c| closure_radiance(code(c.kind), rows(c, outputs, i, &mut buffer)))
        .sum()
}

/// The normal that displacement as bump gives point `i`; `normal` where there is none.
fn shading_normal(program: &Program, outputs: &Rows, i: usize, normal: Vec3) -> Vec3 {
    let is_normal = |c: &&ClosureOutput| c.kind == ClosureKind::ShadingNormal;
    let Some(output) = program.closures.iter().find(is_normal) else {
        return normal;
    };
    let mut buffer = [0.0; MOST_ROWS];
    closure_shading_normal(rows(output, outputs, i, &mut buffer), normal)
}

/// The geometry of point `i` as closures see it.
fn closure_frame(
    program: &Program,
    outputs: &Rows,
    i: usize,
    point: &SurfacePoint,
) -> closure::Frame {
    closure::Frame {
        n: shading_normal(program, outputs, i, point.normal),
        ng: point.true_normal,
        wo: point.outgoing,
        backfacing: point.backfacing != 0,
        bump_correction: true,
    }
}

/// Makes the lobes of point `i` from its output rows.
pub fn build_lobes(
    program: &Program,
    outputs: &Rows,
    i: usize,
    point: &SurfacePoint,
    context: &ClosureContext,
    lobes: &mut LobeSet,
) {
    lobes.begin(&closure_frame(program, outputs, i, point));
    let mut buffer = [0.0; MOST_ROWS];
    for output in &program.closures {
        let rows = rows(output, outputs, i, &mut buffer);
        prepare_closure(output.kind, rows.row, context, lobes);
    }
}

/// Weight and parameters of a closure of point `i`, gathered in `buffer`.
fn rows<'a>(
    output: &ClosureOutput,
    outputs: &Rows,
    i: usize,
    buffer: &'a mut [f32; MOST_ROWS],
) -> ClosureRows<'a> {
    let row = &mut buffer[..output.kind.rows()];
    for (k, value) in row.iter_mut().enumerate() {
        *value = outputs.row(output.first_row + k)[i];
    }
    ClosureRows { row }
}
