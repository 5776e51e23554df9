//! The command line.

use clap::{Args, Parser, Subcommand, ValueEnum};
use matcha_render::backend::{CacheMode, CpuSchedule, RenderOptions};
use matcha_shade::vm::Isa;
use std::path::PathBuf;

/// A path tracer that keeps what material networks compute.
#[derive(Debug, Parser)]
#[command(name = "matcha", version)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Render a scene into a picture
    Render(RenderArguments),
    /// Render a scene without and with the material cache, in turn, and compare
    Compare(CompareArguments),
    /// Say what became of a scene's materials
    Inspect(InspectArguments),
    /// List the graphics adapters, what they have and what they lack
    Devices(DevicesArguments),
}

#[derive(Debug, Args)]
pub(crate) struct RenderArguments {
    #[command(flatten)]
    pub scene: SceneArguments,
    /// Picture to write: .exr (linear, all layers) or .png (through the scene's view transform)
    #[arg(short, long, value_name = "OUT.(exr|png)")]
    pub output: PathBuf,
    /// The material cache
    #[arg(long, value_enum, default_value_t = Cache::Paper)]
    pub cache: Cache,
    #[command(flatten)]
    pub options: Options,
}

#[derive(Debug, Args)]
pub(crate) struct CompareArguments {
    #[command(flatten)]
    pub scene: SceneArguments,
    /// Folder for the pictures and the report; made if it is not there
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,
    /// The material cache of the second picture
    #[arg(long, value_enum, default_value_t = Cache::Paper)]
    pub cache: Cache,
    #[command(flatten)]
    pub options: Options,
}

#[derive(Debug, Args)]
pub(crate) struct InspectArguments {
    #[command(flatten)]
    pub scene: SceneArguments,
    /// Only this material
    #[arg(long, value_name = "NAME")]
    pub material: Option<String>,
    /// Draw the graph in Graphviz' language, cacheable nodes marked
    #[arg(long, requires = "material")]
    pub dot: bool,
    /// For machines
    #[arg(long, conflicts_with = "dot")]
    pub json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct DevicesArguments {
    /// For machines
    #[arg(long)]
    pub json: bool,
}

/// What is loaded, and how.
#[derive(Debug, Args)]
pub(crate) struct SceneArguments {
    /// Scene: .glb, .gltf or .blend
    #[arg(value_name = "SCENE")]
    pub scene: PathBuf,
    /// Refuse scenes of which something must be substituted
    #[arg(long)]
    pub strict: bool,
    /// The Blender that exports .blend files; otherwise it is searched
    #[arg(long, value_name = "PATH")]
    pub blender: Option<PathBuf>,
}

/// How to render.
#[derive(Debug, Args)]
pub(crate) struct Options {
    /// Samples a pixel; otherwise the scene's
    #[arg(long, value_name = "N", value_parser = samples)]
    pub samples: Option<u32>,
    /// Size in pixels; otherwise the scene's
    #[arg(long, value_name = "WxH", value_parser = resolution)]
    pub resolution: Option<[u32; 2]>,
    /// Cells of the cache [default: 10000000, or what fits]
    #[arg(long, value_name = "N")]
    pub cells: Option<u64>,
    /// Entries of a cell [default: 10]
    #[arg(long, value_name = "N")]
    pub entries: Option<u32>,
    /// Added to the level of the cache's virtual textures: positive is finer
    #[arg(long, value_name = "F", default_value_t = 0.0, value_parser = finite, allow_negative_numbers = true)]
    pub level_offset: f32,
    /// Threads; otherwise one for each core
    #[arg(long, value_name = "N", value_parser = threads)]
    pub threads: Option<usize>,
    /// Seed; otherwise the scene's
    #[arg(long, value_name = "N")]
    pub seed: Option<u32>,
    /// Where to render: auto is a GPU that can, else the CPU; gpu is the best adapter there
    /// is, gpu:N one by its number in `matcha devices`, anything else a part of its name
    #[arg(long, value_name = "auto|cpu|gpu|gpu:N|NAME", default_value = "auto", value_parser = device)]
    pub device: Device,
    /// How networks are evaluated on a GPU when results are kept
    #[arg(long, value_enum, default_value_t = MaterialStage::Split)]
    pub material_stage: MaterialStage,
    /// Leave the stages before this one to the processor, to find out which one differs on a GPU
    #[arg(long, value_enum, value_name = "STAGE", hide = true)]
    pub gpu_from: Option<GpuFrom>,
    /// Experimental: trace rays by the ray queries of a GPU that has them (`matcha devices` says
    /// which) instead of by Matcha's own hierarchy
    #[arg(long)]
    pub ray_queries: bool,
    /// Pack images of 8 bits a channel in blocks on a GPU: a quarter of their memory, where the
    /// error is small (at most 4 of 255 in the mean)
    #[arg(long)]
    pub compress_textures: bool,
    #[command(flatten)]
    pub schedule: Schedule,
    /// Write full statistics
    #[arg(long, value_name = "FILE.json")]
    pub stats: Option<PathBuf>,
}

/// For measurements of the CPU renderer; not in the help.
#[derive(Debug, Args)]
pub(crate) struct Schedule {
    /// Paths in flight on one thread
    #[arg(long, value_name = "N", value_parser = positive, hide = true)]
    pub batch_paths: Option<usize>,
    /// Most hits that networks are evaluated for at once
    #[arg(long, value_name = "N", value_parser = positive, hide = true)]
    pub group_hits: Option<usize>,
    /// Instructions that networks run in; scalar is one hit at a time
    #[arg(long, value_name = "scalar|sse2|avx2|avx512", value_parser = lanes, hide = true)]
    pub lanes: Option<Isa>,
}

impl Schedule {
    fn cpu_schedule(&self) -> CpuSchedule {
        let default = CpuSchedule::default();
        CpuSchedule {
            batch_paths: self.batch_paths.unwrap_or(default.batch_paths),
            group_hits: self.group_hits.unwrap_or(default.group_hits),
            isa: self.lanes.unwrap_or(default.isa),
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Cache {
    /// As in Fujieda and Harada 2022
    Paper,
    /// Every network is evaluated at every hit
    Off,
}

/// Where to render.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Device {
    /// The fastest there is.
    Auto,
    /// The processor.
    Cpu,
    /// The best adapter there is.
    Gpu,
    /// An adapter by its number.
    Numbered(usize),
    /// An adapter by a part of its name.
    Named(String),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum MaterialStage {
    /// Each hit evaluates at once what it does not find, as in the paper
    Inline,
    /// All hits look up first; what is missing is evaluated side by side
    Split,
}

/// The first stage of a bounce that a GPU takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum GpuFrom {
    /// Finished paths go onto the film and are replaced
    Regenerate,
    /// Paths find what they meet
    Traverse,
    /// Lights on the way of paths, the suns and the world
    Lights,
    /// Node networks
    Evaluate,
    /// Closures, and all that is sampled or taken from them
    Shade,
    /// Shadow rays
    Shadow,
    /// What shadow rays bring
    Accumulate,
    /// None at all
    Nothing,
}

impl Options {
    /// Options of a backend with a cache or none.
    pub fn render_options(&self, cache: Cache) -> RenderOptions {
        let cache = match cache {
            Cache::Off => CacheMode::Off,
            Cache::Paper => CacheMode::Paper {
                cells: self.cells,
                entries: self.entries,
                level_offset: self.level_offset,
            },
        };
        RenderOptions {
            resolution: self.resolution,
            threads: self.threads,
            seed: self.seed,
            cache,
            schedule: self.schedule.cpu_schedule(),
        }
    }
}

fn samples(text: &str) -> Result<u32, String> {
    match text.parse::<u32>() {
        Ok(n @ 1..=16_777_216) => Ok(n),
        Ok(0) => Err("a picture needs at least one sample a pixel".into()),
        _ => Err("samples are a number from 1 to 16777216".into()),
    }
}

fn resolution(text: &str) -> Result<[u32; 2], String> {
    let refuse = || "a resolution is WIDTHxHEIGHT, each 1 to 65536, as in 1920x1080".to_owned();
    let (width, height) = text.split_once(['x', 'X', '×']).ok_or_else(refuse)?;
    let side = |text: &str| text.parse().ok().filter(|n| (1..=65_536).contains(n));
    match (side(width), side(height)) {
        (Some(width), Some(height)) => Ok([width, height]),
        _ => Err(refuse()),
    }
}

fn threads(text: &str) -> Result<usize, String> {
    match text.parse::<usize>() {
        Ok(n @ 1..=4096) => Ok(n),
        _ => Err("threads are a number from 1 to 4096".into()),
    }
}

fn positive(text: &str) -> Result<usize, String> {
    match text.parse::<usize>() {
        Ok(n @ 1..=16_777_216) => Ok(n),
        _ => Err("this is a number from 1 to 16777216".into()),
    }
}

fn lanes(text: &str) -> Result<Isa, String> {
    let isa = match text {
        "scalar" => Isa::Scalar,
        "sse2" => Isa::Baseline,
        "avx2" => Isa::Avx2,
        "avx512" => Isa::Avx512,
        _ => return Err("lanes are scalar, sse2, avx2 or avx512".into()),
    };
    if Isa::available().contains(&isa) {
        Ok(isa)
    } else {
        Err("this processor does not have these instructions".into())
    }
}

fn device(text: &str) -> Result<Device, String> {
    let refuse = || "a device is auto, cpu, gpu, gpu:N, or a part of an adapter's name".to_owned();
    match text.to_lowercase().as_str() {
        "" => Err(refuse()),
        "auto" => Ok(Device::Auto),
        "cpu" => Ok(Device::Cpu),
        "gpu" => Ok(Device::Gpu),
        lower => match lower.strip_prefix("gpu:") {
            Some(number) => number.parse().map(Device::Numbered).map_err(|_| refuse()),
            None => Ok(Device::Named(text.to_owned())),
        },
    }
}

fn finite(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(x) if x.abs() <= 64.0 => Ok(x),
        _ => Err("a level offset is a number from -64 to 64".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn devices_are_words_numbers_and_names() {
        assert_eq!(device("auto"), Ok(Device::Auto));
        assert_eq!(device("CPU"), Ok(Device::Cpu));
        assert_eq!(device("gpu"), Ok(Device::Gpu));
        assert_eq!(device("gpu:12"), Ok(Device::Numbered(12)));
        assert_eq!(device("Radeon"), Ok(Device::Named("Radeon".into())));
        assert!(device("").is_err() && device("gpu:").is_err() && device("gpu:-1").is_err());
    }
}
