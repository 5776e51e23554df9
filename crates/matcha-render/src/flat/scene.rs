//! Everything of a prepared scene.

use super::{FlatGeometry, FlatPrograms, FlatTextures, Section};
use crate::backend::TextureMemory;
use crate::closure::tables::closure_tables;
use crate::device::camera::RasterCamera;
use crate::device::geometry_view::GeometryView;
use crate::device::light_view::LightView;
use crate::device::path_start::FilterView;
use crate::device::path_state::PathSettings;
use crate::film::filter::FilterTable;
use crate::prepare::Prepared;
use crate::texture::TextureSet;
use glam::Vec3;
use matcha_shade::program::Program;
use std::sync::Arc;

/// A scene in arrays, for one set of its programs (with look-ups of the cache, or without).
pub struct FlatScene {
    prepared: Arc<Prepared>,
    materials: Arc<Vec<Program>>,
    filter: FilterTable,
    geometry: FlatGeometry,
    textures: FlatTextures,
    programs: FlatPrograms,
    world: Option<u32>,
    lights: Vec<u32>,
}

/// Stands for no program.
pub const NO_PROGRAM: u32 = u32::MAX;

impl FlatScene {
    /// Lays a scene out; `materials` are the programs of its materials in their order. The
    /// world's program comes behind them, then those of lights.
    pub fn new(prepared: &Arc<Prepared>, materials: &Arc<Vec<Program>>) -> Self {
        Self::with_textures(prepared, materials, false)
    }

    /// The same, with images of bytes packed in blocks if `packs` says so.
    pub fn with_textures(
        prepared: &Arc<Prepared>,
        materials: &Arc<Vec<Program>>,
        packs: bool,
    ) -> Self {
        let mut all: Vec<&Program> = materials.iter().collect();
        let mut number = |program| {
            Option::map(program, |program| {
                all.push(program);
                all.len() as u32 - 1
            })
        };
        let world = number(prepared.world().ok());
        let scene_lights = prepared.scene().lights.len() as u32;
        let lights = (0..scene_lights)
            .map(|light| number(prepared.light_program(light)).unwrap_or(NO_PROGRAM))
            .collect();
        let looks = all.iter().flat_map(|program| program.textures());
        Self {
            filter: FilterTable::new(prepared.scene().settings.filter),
            geometry: FlatGeometry::new(prepared, all.iter().copied()),
            textures: FlatTextures::new(prepared, looks, packs),
            programs: FlatPrograms::new(all.iter().copied()),
            materials: materials.clone(),
            prepared: prepared.clone(),
            world,
            lights,
        }
    }

    /// The programs.
    pub fn programs(&self) -> &FlatPrograms {
        &self.programs
    }

    /// The program with a number; `None` where there is none.
    pub fn program(&self, number: u32) -> Option<&Program> {
        if self.world == Some(number) {
            return self.prepared.world().ok();
        }
        let light = self.lights.iter().position(|&program| program == number);
        match light {
            Some(light) if number != NO_PROGRAM => self.prepared.light_program(light as u32),
            _ => self.materials.get(number as usize),
        }
    }

    /// What the arrays were made of.
    pub fn prepared(&self) -> &Prepared {
        &self.prepared
    }

    /// Surfaces, as device code reads them.
    pub fn geometry(&self) -> GeometryView<'_> {
        self.geometry.view()
    }

    /// Lights, likewise.
    pub fn lights(&self) -> LightView<'_> {
        self.prepared.lights.view()
    }

    /// The pixel filter, likewise.
    pub fn filter(&self) -> FilterView<'_> {
        self.filter.view()
    }

    /// Images, for the machine that runs on the processor.
    pub fn images(&self) -> &TextureSet {
        &self.prepared.textures
    }

    /// What packed images save; nothing where none were to be packed.
    pub fn texture_memory(&self) -> Option<TextureMemory> {
        self.textures.memory()
    }

    /// Number of the world's program; where it has none, its radiance is
    /// [`FlatScene::world_radiance`].
    pub fn world_program(&self) -> Option<u32> {
        self.world
    }

    /// Radiance of a world that is the same everywhere.
    pub fn world_radiance(&self) -> Vec3 {
        self.prepared.world().err().unwrap_or(Vec3::ZERO)
    }

    /// Kinds of rays that see the world: `RAY_` bits.
    pub fn world_visibility(&self) -> u32 {
        crate::accel::visibility_mask(&self.prepared.scene().world.visibility).into()
    }

    /// Number of each scene light's program, [`NO_PROGRAM`] where it has none.
    pub fn light_programs(&self) -> &[u32] {
        &self.lights
    }

    /// Whether some light's radiance must be evaluated.
    pub fn has_light_programs(&self) -> bool {
        self.lights.iter().any(|&program| program != NO_PROGRAM)
    }

    /// Whether some material lets light straight through.
    pub fn has_transparent_shadows(&self) -> bool {
        self.prepared.has_transparent_shadows()
    }

    /// The camera.
    pub fn camera(&self) -> RasterCamera {
        self.prepared.camera
    }

    /// What the rules of paths ask of the settings.
    pub fn rules(&self) -> PathSettings {
        self.prepared.rules
    }

    /// Hands the words of all fields of all views to `take`.
    ///
    /// # Errors
    /// The first that `take` gives.
    pub fn sections<E>(&self, mut take: impl FnMut(&Section) -> Result<(), E>) -> Result<(), E> {
        let lights = self.prepared.lights.view();
        let tables = Section {
            name: "ClosureTables_entry",
            words: bytemuck::cast_slice(closure_tables().entry),
            is_plain: false,
        };
        let filter = Section {
            name: "FilterView_inverse",
            words: bytemuck::cast_slice(self.filter.view().inverse),
            is_plain: false,
        };
        let sections = self.geometry.sections().into_iter();
        sections
            .chain(self.textures.sections())
            .chain(self.programs.sections())
            .chain(light_sections(&lights))
            .chain([tables, filter])
            .try_for_each(|section| take(&section))
    }
}

/// The words of all fields of [`LightView`].
fn light_sections<'a>(view: &'a LightView<'a>) -> Vec<Section<'a>> {
    macro_rules! fields {
        ($($array:ident)*; $($plain:ident)*) => {{
            // Named one by one, so that a new field is not forgotten.
            let LightView { $($array,)* $($plain,)* } = view;
            vec![
                $(Section {
                    name: concat!("LightView_", stringify!($array)),
                    words: bytemuck::cast_slice($array),
                    is_plain: false,
                },)*
                $(Section {
                    name: concat!("LightView_", stringify!($plain)),
                    words: bytemuck::cast_slice(std::slice::from_ref($plain)),
                    is_plain: true,
                },)*
            ]
        }};
    }
    fields!(
        groups group_parents nodes parents slots triangles first of_primitive materials lights suns
        boxes order world;
        world_width world_height world_visibility world_slot world_irradiance world_harmonics
    )
}
