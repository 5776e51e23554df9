//! From a scene to everything that rendering reads: programs, hierarchy, lights, tables.

use crate::accel::{Accel, Hit};
use crate::backend::RenderError;
use crate::camera;
use crate::device::camera::RasterCamera;
use crate::emission;
use crate::integrator::path::{PathSettings, path_settings};
use crate::light::LightSet;
use crate::scene::{Scene, Shader};
use crate::surface::{SurfaceTables, View};
use crate::texture::TextureSet;
use glam::Vec3;
use matcha_shade::closure::ClosureKind;
use matcha_shade::compile::{CostModel, Options, compile};
use matcha_shade::material::{LowerReport, MaterialGraph, MaterialKind};
use matcha_shade::nodes::{Names, lower, lower_gltf};
use matcha_shade::program::Program;
use rayon::prelude::*;
use std::sync::{Arc, OnceLock};

/// Largest side of a picture.
const MAX_SIDE: u32 = 65536;

/// A scene, ready to be rendered at one size.
pub struct Prepared {
    scene: Scene,
    resolution: [u32; 2],
    graphs: Vec<MaterialGraph>,
    /// What lowering could not honour, by material.
    reports: Vec<(String, LowerReport)>,
    programs: Arc<Vec<Program>>,
    cached_programs: OnceLock<Arc<Vec<Program>>>,
    world: Result<Program, Vec3>,
    /// By index of the scene's lights, where a node tree's emission varies.
    light_programs: Vec<Option<Program>>,
    transparent_shadows: bool,
    /// By material: whether it may emit.
    emits: Vec<bool>,
    pub(crate) accel: Accel,
    pub(crate) lights: LightSet,
    pub(crate) textures: TextureSet,
    pub(crate) surfaces: SurfaceTables,
    pub(crate) view: View,
    pub(crate) camera: RasterCamera,
    pub(crate) rules: PathSettings,
}

impl Prepared {
    /// Prepares a scene for pictures of a size (the scene's own where none is given).
    ///
    /// # Errors
    /// If the scene refers to things that are not there, or a network makes no sense.
    pub fn new(mut scene: Scene, resolution: Option<[u32; 2]>) -> Result<Self, RenderError> {
        let resolution = resolution.unwrap_or(scene.settings.resolution);
        check_resolution(resolution)?;
        check_indices(&scene)?;
        let Lowered {
            graphs,
            reports,
            world,
            lights,
        } = lower_scene(&mut scene)?;
        let programs = compile_without_cache(&graphs)?;
        let camera = camera::prepare(&scene.camera, resolution, scene.settings.pixel_aspect);
        let view = View::new(camera, resolution);
        let all = || {
            programs
                .iter()
                .chain(world.as_ref().ok())
                .chain(lights.iter().flatten())
        };
        let textures = TextureSet::build(&scene.images, all().flat_map(|p| p.textures()));
        let kinds = all().flat_map(|p| &p.inputs).map(|(input, _)| input.kind);
        let surfaces = SurfaceTables::new(&scene, view, kinds);
        let emits = programs.iter().map(Program::has_emission).collect();
        let mut accel = Accel::build(&scene)?;
        let transparent = transparent_instances(&scene, &programs);
        accel.part_shadows(&transparent);
        let mut prepared = Self {
            resolution,
            graphs,
            reports,
            programs: Arc::new(programs),
            cached_programs: OnceLock::new(),
            world,
            light_programs: lights,
            transparent_shadows: transparent.contains(&true),
            emits,
            accel,
            lights: LightSet::default(),
            textures,
            surfaces,
            view,
            camera,
            rules: path_settings(&scene.settings),
            scene,
        };
        let emission = emission::of_materials(&prepared);
        let world = emission::of_world(&prepared);
        prepared.lights = LightSet::build(&prepared.scene, emission, world);
        Ok(prepared)
    }

    /// The scene.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The structure that answers rays.
    pub fn accel(&self) -> &Accel {
        &self.accel
    }

    /// Size of the picture, pixels.
    pub fn resolution(&self) -> [u32; 2] {
        self.resolution
    }

    /// Materials as lowered, in the scene's order.
    pub fn graphs(&self) -> &[MaterialGraph] {
        &self.graphs
    }

    /// What lowering could not honour: names of materials and what was done instead.
    pub fn reports(&self) -> &[(String, LowerReport)] {
        &self.reports
    }

    /// Programs of all materials, with or without look-ups of the cache.
    ///
    /// # Errors
    /// If a network is larger than a program can be.
    pub fn programs(&self, cached: bool) -> Result<Arc<Vec<Program>>, RenderError> {
        if !cached {
            return Ok(self.programs.clone());
        }
        if let Some(programs) = self.cached_programs.get() {
            return Ok(programs.clone());
        }
        let programs = self.cached_programs_for(CostModel::default())?;
        Ok(self.cached_programs.get_or_init(|| programs).clone())
    }

    /// Programs with look-ups of what is worth one by other costs than this processor's.
    ///
    /// # Errors
    /// If a network is larger than a program can be.
    pub fn cached_programs_for(&self, cost: CostModel) -> Result<Arc<Vec<Program>>, RenderError> {
        let options = Options {
            cost,
            ..Options::default()
        };
        compile_all(&self.graphs, &options).map(Arc::new)
    }

    /// The world's program, or its radiance where it is the same everywhere.
    pub(crate) fn world(&self) -> Result<&Program, Vec3> {
        self.world.as_ref().map_err(|&radiance| radiance)
    }

    /// The program of a light whose emission varies with direction or place.
    pub(crate) fn light_program(&self, scene_light: u32) -> Option<&Program> {
        self.light_programs[scene_light as usize].as_ref()
    }

    /// Whether some material lets light straight through.
    pub(crate) fn has_transparent_shadows(&self) -> bool {
        self.transparent_shadows
    }

    /// Whether a material may emit.
    ///
    /// # Panics
    /// If there is no such material.
    pub fn emits(&self, material: u32) -> bool {
        self.emits[material as usize]
    }

    /// Material of a hit.
    pub(crate) fn material_of(&self, hit: &Hit) -> u32 {
        let instance = &self.scene.instances[hit.instance as usize];
        let mesh = &self.scene.meshes[instance.mesh as usize];
        // Checked when the scene was prepared.
        mesh.material_of(instance, hit.primitive).unwrap_or(0)
    }

    /// Bytes of geometry, hierarchy, lights and pictures.
    pub fn bytes(&self) -> usize {
        self.accel.bytes() + self.lights.bytes() + self.textures.bytes() + self.surfaces.bytes()
    }
}

fn check_resolution([width, height]: [u32; 2]) -> Result<(), RenderError> {
    let fits = |side| (1..=MAX_SIDE).contains(&side);
    if fits(width) && fits(height) {
        Ok(())
    } else {
        Err(RenderError::Resolution(width, height))
    }
}

/// Every triangle of every instance must have a material that exists.
fn check_indices(scene: &Scene) -> Result<(), RenderError> {
    let count = scene.materials.len();
    for instance in &scene.instances {
        let Some(mesh) = scene.meshes.get(instance.mesh as usize) else {
            return Err(RenderError::Scene(format!(
                "object \"{}\" refers to mesh {}, but there are {}",
                instance.name,
                instance.mesh,
                scene.meshes.len()
            )));
        };
        let slots = mesh.slots.iter().copied().max().unwrap_or(0);
        for slot in 0..=usize::from(slots) {
            let given = mesh.material_of_slot(instance, slot);
            let exists = given.is_some_and(|m| (m as usize) < count);
            if !(exists || mesh.indices.is_empty()) {
                return Err(RenderError::Scene(format!(
                    "object \"{}\": slot {slot} of mesh \"{}\" has no material",
                    instance.name, mesh.name
                )));
            }
        }
    }
    Ok(())
}

/// Everything of a scene that was drawn as nodes.
struct Lowered {
    graphs: Vec<MaterialGraph>,
    reports: Vec<(String, LowerReport)>,
    world: Result<Program, Vec3>,
    lights: Vec<Option<Program>>,
}

/// Lowers all node trees. Lights whose tree is the same everywhere lose it to their power.
fn lower_scene(scene: &mut Scene) -> Result<Lowered, RenderError> {
    let mut reports = Vec::new();
    let graphs = lower_materials(scene, &mut reports)?;
    let world = lower_world(scene, &mut reports)?;
    let lights = lower_lights(scene, &mut reports)?;
    Ok(Lowered {
        graphs,
        reports,
        world,
        lights,
    })
}

fn names(scene: &Scene) -> Names<'_> {
    Names {
        uv: &scene.uv_names,
        attributes: &scene.attribute_names,
    }
}

fn lower_materials(
    scene: &Scene,
    reports: &mut Vec<(String, LowerReport)>,
) -> Result<Vec<MaterialGraph>, RenderError> {
    let lowered: Vec<_> = scene
        .materials
        .par_iter()
        .map(|material| match &material.shader {
            Shader::Cycles(tree) => lower(
                &scene.trees,
                *tree,
                names(scene),
                &material.name,
                MaterialKind::Surface,
            ),
            Shader::Gltf(gltf) => Ok((lower_gltf(&material.name, gltf), LowerReport::default())),
        })
        .collect::<Result<_, _>>()?;
    let mut graphs = Vec::with_capacity(lowered.len());
    for (graph, report) in lowered {
        note(reports, &graph.name, report);
        graphs.push(graph);
    }
    Ok(graphs)
}

fn note(reports: &mut Vec<(String, LowerReport)>, name: &str, report: LowerReport) {
    if !report.items.is_empty() {
        reports.push((name.to_owned(), report));
    }
}

fn compile_without_cache(graphs: &[MaterialGraph]) -> Result<Vec<Program>, RenderError> {
    let options = Options {
        cache: false,
        ..Options::default()
    };
    compile_all(graphs, &options)
}

fn compile_all(graphs: &[MaterialGraph], options: &Options) -> Result<Vec<Program>, RenderError> {
    graphs
        .par_iter()
        .map(|graph| {
            compile(graph, options)
                .map(|compiled| compiled.program)
                .map_err(|error| {
                    RenderError::Scene(format!("material \"{}\": {error}", graph.name))
                })
        })
        .collect()
}

/// A tree that emits, compiled; or its radiance where that is the same everywhere.
fn lower_emitter(
    scene: &Scene,
    tree: u32,
    name: &str,
    kind: MaterialKind,
    reports: &mut Vec<(String, LowerReport)>,
) -> Result<Result<Program, Vec3>, RenderError> {
    let (graph, report) = lower(&scene.trees, tree, names(scene), name, kind)?;
    note(reports, name, report);
    let program = compile_without_cache(std::slice::from_ref(&graph))?.remove(0);
    Ok(match constant_radiance(&program) {
        Some(radiance) => Err(radiance),
        None => Ok(program),
    })
}

fn lower_world(
    scene: &Scene,
    reports: &mut Vec<(String, LowerReport)>,
) -> Result<Result<Program, Vec3>, RenderError> {
    match scene.world.tree {
        Some(tree) => lower_emitter(scene, tree, "World", MaterialKind::World, reports),
        None => Ok(Err(scene.world.color)),
    }
}

fn lower_lights(
    scene: &mut Scene,
    reports: &mut Vec<(String, LowerReport)>,
) -> Result<Vec<Option<Program>>, RenderError> {
    let mut programs = Vec::with_capacity(scene.lights.len());
    for i in 0..scene.lights.len() {
        let Some(tree) = scene.lights[i].tree else {
            programs.push(None);
            continue;
        };
        let name = scene.lights[i].name.clone();
        match lower_emitter(scene, tree, &name, MaterialKind::Light, reports)? {
            Ok(program) => programs.push(Some(program)),
            Err(radiance) => {
                scene.lights[i].power *= radiance;
                scene.lights[i].tree = None;
                programs.push(None);
            }
        }
    }
    Ok(programs)
}

/// What a program radiates if that depends on nothing.
pub(crate) fn constant_radiance(program: &Program) -> Option<Vec3> {
    let mut sum = Vec3::ZERO;
    for closure in &program.closures {
        if matches!(
            closure.kind,
            ClosureKind::Emission | ClosureKind::Background
        ) {
            let row = |k| program.constant_output(closure.first_row + k);
            sum += Vec3::new(row(0)?, row(1)?, row(2)?);
        }
    }
    Some(sum)
}

/// Which instances show a material that lets light straight through.
fn transparent_instances(scene: &Scene, programs: &[Program]) -> Vec<bool> {
    let transparent: Vec<bool> = programs.iter().map(Program::has_transparency).collect();
    let shows = |instance: &crate::scene::Instance| {
        let mesh = &scene.meshes[instance.mesh as usize];
        let slots = mesh.material_slots.len().max(instance.materials.len());
        (0..slots).any(|slot| {
            let material = mesh.material_of_slot(instance, slot);
            material.is_some_and(|m| transparent.get(m as usize) == Some(&true))
        })
    };
    scene.instances.iter().map(shows).collect()
}
