//! The GPU as a rendering device.

use crate::adapter::Wanted;
use std::path::PathBuf;

/// How networks are evaluated when results are kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MaterialStage {
    /// As in the paper: a hit looks a node up and evaluates it at once if it is not there.
    Inline,
    /// All hits look their nodes up; only those that miss are evaluated, side by side.
    #[default]
    Split,
}

/// A stage of the wavefront.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// Camera rays.
    Generate,
    /// Rays through the scene.
    Traverse,
    /// Points, footprints and look-ups in the cache.
    Lookup,
    /// Networks.
    Evaluate,
    /// Closures and light samples.
    Shade,
    /// Shadow rays.
    Shadow,
    /// Results to the film.
    Accumulate,
}

impl Stage {
    /// All, in the order in which a path meets them.
    pub const ALL: [Stage; 7] = [
        Stage::Generate,
        Stage::Traverse,
        Stage::Lookup,
        Stage::Evaluate,
        Stage::Shade,
        Stage::Shadow,
        Stage::Accumulate,
    ];

    /// Its name in statistics and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Stage::Generate => "generate",
            Stage::Traverse => "traverse",
            Stage::Lookup => "lookup",
            Stage::Evaluate => "evaluate",
            Stage::Shade => "shade",
            Stage::Shadow => "shadow",
            Stage::Accumulate => "accumulate",
        }
    }

    /// The stage of a name.
    pub fn named(name: &str) -> Option<Stage> {
        Stage::ALL.into_iter().find(|stage| stage.name() == name)
    }
}

/// What is asked of the GPU beside what is asked of every device.
#[derive(Clone, Debug)]
pub struct GpuOptions {
    /// The adapter.
    pub wanted: Wanted,
    /// How networks are evaluated when results are kept.
    pub material_stage: MaterialStage,
    /// Stages before this one run on the CPU: to find a fault.
    pub gpu_from: Option<Stage>,
    /// Where compiled kernels are kept.
    pub cache_folder: Option<PathBuf>,
}

impl Default for GpuOptions {
    fn default() -> Self {
        Self {
            wanted: Wanted::Best,
            material_stage: MaterialStage::default(),
            gpu_from: None,
            cache_folder: None,
        }
    }
}
