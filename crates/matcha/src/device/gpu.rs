//! Graphics adapters, in a build that has them.

mod list;

use crate::arguments::{self, Options};
use anyhow::Result;
use matcha_gpu::GpuError;
use matcha_gpu::adapter::{self, AdapterReport, Wanted};
use matcha_gpu::backend::{Gpu, GpuBackend, GpuOptions, MaterialStage};
use matcha_gpu::wavefront::{GpuFrom, Stage};
use matcha_import::user_cache_folder;
use matcha_render::backend::{Backend, RenderError, RenderOptions};
use matcha_render::prepare::Prepared;
use std::sync::Arc;

/// An open adapter.
pub(crate) struct Opened(Arc<Gpu>);

impl Opened {
    /// Its name, for people.
    pub fn name(&self) -> &str {
        &self.0.device().report().name
    }

    /// A renderer of a scene.
    pub fn backend(
        &self,
        prepared: &Arc<Prepared>,
        options: &RenderOptions,
    ) -> Result<Box<dyn Backend>, RenderError> {
        Ok(Box::new(GpuBackend::new(&self.0, prepared, options)?))
    }
}

/// Opens the adapter that is asked for.
pub(super) fn open(options: &Options) -> Result<Opened> {
    Ok(Opened(Gpu::open(gpu_options(options)?)?))
}

/// Opens a real GPU that can render; otherwise says why there is none.
pub(super) fn open_real(options: &Options) -> Result<Result<Opened, String>> {
    let opened = Gpu::open(gpu_options(options)?);
    Ok(opened.map(Opened).map_err(|error| match error {
        GpuError::NoAdapter => "there is no GPU that can".to_owned(),
        other => other.to_string(),
    }))
}

/// All adapters that there are, for people or machines.
pub(crate) fn list(json: bool) -> Result<String> {
    let adapters = adapter::adapters();
    let reports: Vec<AdapterReport> = adapters.iter().map(|a| a.report().clone()).collect();
    if json {
        return Ok(serde_json::to_string_pretty(&reports)? + "\n");
    }
    let automatic = adapter::choose(adapters, &Wanted::Real).ok();
    Ok(list::text(&reports, automatic.map(|a| a.report().number)))
}

fn gpu_options(options: &Options) -> Result<GpuOptions> {
    Ok(GpuOptions {
        wanted: match &options.device {
            arguments::Device::Auto | arguments::Device::Cpu => Wanted::Real,
            arguments::Device::Gpu => Wanted::Best,
            arguments::Device::Numbered(number) => Wanted::Number(*number),
            arguments::Device::Named(name) => Wanted::Named(name.clone()),
        },
        material_stage: match options.material_stage {
            arguments::MaterialStage::Inline => MaterialStage::Inline,
            arguments::MaterialStage::Split => MaterialStage::Split,
        },
        sort_queues: None,
        gpu_from: options.gpu_from.map(first_stage),
        ray_queries: options.ray_queries,
        compress_textures: options.compress_textures,
        cache_folder: user_cache_folder().map(|folder| folder.join("kernels")),
    })
}

fn first_stage(from: arguments::GpuFrom) -> GpuFrom {
    use arguments::GpuFrom as Asked;
    GpuFrom::Stage(match from {
        Asked::Regenerate => Stage::Regenerate,
        Asked::Traverse => Stage::Traverse,
        Asked::Lights => Stage::Lights,
        Asked::Evaluate => Stage::Evaluate,
        Asked::Shade => Stage::Shade,
        Asked::Shadow => Stage::Shadow,
        Asked::Accumulate => Stage::Accumulate,
        Asked::Nothing => return GpuFrom::Nothing,
    })
}
