//! Every stage of a wave on the device and on the processor, from identical memory.

mod comparison;
mod corrupted;
mod divided;
mod scene;
#[path = "../../../matcha-render/tests/scenes/mod.rs"]
#[allow(dead_code)]
mod scenes;

use comparison::compare;
use matcha_gpu::GpuError;
use matcha_gpu::backend::{GpuOptions, MaterialStage};
use matcha_gpu::device::Device;
use matcha_gpu::pipeline::Pipelines;
use matcha_gpu::shader::{Library, LinkError};
use matcha_gpu::testing;
use matcha_gpu::wavefront::{GpuFrom, Place, Step, StepRecord, Wavefront};
use matcha_import::{LoadOptions, load};
use matcha_render::backend::{CacheMode, RenderOptions};
use matcha_render::prepare::Prepared;
use std::path::Path;
use std::sync::{Arc, OnceLock};

const RESOLUTION: [u32; 2] = [24, 14];

const SMALL_CACHE: CacheMode = CacheMode::Paper {
    cells: Some(1 << 14),
    entries: Some(8),
    level_offset: 0.0,
};

fn tea_room() -> Arc<Prepared> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/tea_room.glb");
    let loaded = load(&path, &LoadOptions::default(), &mut |_| {}).expect("the example");
    Arc::new(Prepared::new(loaded.scene, Some(RESOLUTION)).expect("it can be rendered"))
}

fn small_scene() -> Arc<Prepared> {
    static PREPARED: OnceLock<Arc<Prepared>> = OnceLock::new();
    let prepare = || Prepared::new(scene::scene(), Some(RESOLUTION)).expect("it can be rendered");
    PREPARED.get_or_init(|| Arc::new(prepare())).clone()
}

/// Kernels that all tests share.
fn pipelines(device: &Device) -> &'static Pipelines {
    static PIPELINES: OnceLock<Pipelines> = OnceLock::new();
    PIPELINES.get_or_init(|| Pipelines::new(device, None))
}

fn render_options(cache: CacheMode) -> RenderOptions {
    RenderOptions {
        cache,
        seed: Some(1),
        ..RenderOptions::default()
    }
}

/// How a scene is rendered.
#[derive(Clone, Copy, Debug)]
struct Setting {
    cache: CacheMode,
    material_stage: MaterialStage,
    sorted: bool,
    bounces: u32,
}

const PLAIN: Setting = Setting {
    cache: CacheMode::Off,
    material_stage: MaterialStage::Split,
    sorted: false,
    bounces: 3,
};

/// Shows `look` all steps of some bounces of a scene whose kernels have been changed.
fn each_step(
    device: &Device,
    prepared: &Arc<Prepared>,
    setting: Setting,
    change: impl FnOnce(&mut Library) -> Result<(), LinkError>,
    look: &mut dyn FnMut(&StepRecord),
) -> Result<(), GpuError> {
    let options = render_options(setting.cache);
    let gpu = GpuOptions {
        material_stage: setting.material_stage,
        sort_queues: Some(setting.sorted),
        gpu_from: Some(GpuFrom::Nothing),
        ..GpuOptions::default()
    };
    let pipelines = pipelines(device);
    let mut wavefront =
        Wavefront::with_library(device, pipelines, prepared, &options, &gpu, change)?;
    let [width, height] = RESOLUTION;
    wavefront.compare_steps(width * height, 0..8, setting.bounces, look)
}

/// Of so many slots one may be decided otherwise where a step decides something: which of two
/// triangles a ray meets that goes through their edge, which cell of a pattern a point is in, which
/// closure or light a number chooses. Mesa's driver needs none of it; devices that fuse products
/// and sums do.
const DECIDED_OTHERWISE: usize = 200;

/// Slots that may differ of those that some steps changed.
fn allowed(steps: &[Step], changed: usize) -> usize {
    let decides = |step: &Step| {
        !matches!(
            step,
            Step::Measure { .. }
                | Step::Regenerate
                | Step::Sort(_)
                | Step::SortMisses
                | Step::Emit(_)
                | Step::Pass { .. }
                | Step::Collect
        )
    };
    if steps.iter().any(decides) {
        changed / DECIDED_OTHERWISE
    } else {
        0
    }
}

/// What is wrong with what some steps did.
fn fault(record: &StepRecord) -> Option<String> {
    let difference = compare(record);
    let allowed = allowed(record.steps, difference.changed.len());
    let agrees = difference.wrong.is_empty() && difference.others.len() <= allowed;
    (!agrees).then(|| {
        format!(
            "{:?}: {} of {} slots (device, twin): {:?}; {:?}",
            record.steps,
            difference.others.len(),
            difference.changed.len(),
            difference.fields,
            difference.wrong
        )
    })
}

/// Compares all steps, and gives those that had something to do.
fn compare_all(device: &Device, prepared: &Arc<Prepared>, setting: Setting) -> Vec<Step> {
    let mut busy = Vec::new();
    let mut faults = Vec::new();
    let mut look = |record: &StepRecord| {
        faults.extend(fault(record));
        if record.device != record.before {
            busy.extend(record.steps);
        }
    };
    let done = each_step(device, prepared, setting, |_| Ok(()), &mut look);
    done.unwrap_or_else(|error| panic!("{error}"));
    assert!(faults.is_empty(), "{setting:?}: {}", faults.join("\n"));
    busy
}

fn assert_busy(busy: &[Step], expected: &[Step]) {
    for step in expected {
        assert!(busy.contains(step), "{step:?} had nothing to do");
    }
}

#[test]
fn stages_do_what_their_twins_do() {
    let Some(device) = testing::device() else {
        return;
    };
    let busy = compare_all(&device, &small_scene(), PLAIN);
    let of_paths = [
        Step::Regenerate,
        Step::Traverse,
        Step::Meet,
        Step::Escape,
        Step::Shade,
        Step::Block,
        Step::Collect,
    ];
    assert_busy(&busy, &of_paths);
    use Place::{Emitters, Escaped, Hits, Layers, LightTasks, WorldTasks};
    let places = [Hits, Emitters, Layers, Escaped, WorldTasks, LightTasks];
    assert_busy(&busy, &places.map(Step::Evaluate));
    assert_busy(&busy, &[Emitters, WorldTasks, LightTasks].map(Step::Emit));
    let layer = |step: &Step| matches!(step, Step::Layer { .. });
    let pass = |step: &Step| matches!(step, Step::Pass { .. });
    assert!(busy.iter().any(layer) && busy.iter().any(pass));
}

#[test]
fn stages_of_the_example_do_what_their_twins_do() {
    let Some(device) = testing::device() else {
        return;
    };
    let busy = compare_all(&device, &tea_room(), PLAIN);
    assert_busy(&busy, &[Step::Evaluate(Place::Hits), Step::Shade]);
}

#[test]
fn stages_with_a_cache_do_what_their_twins_do_without_one() {
    let Some(device) = testing::device() else {
        return;
    };
    let split = Setting {
        cache: SMALL_CACHE,
        sorted: true,
        ..PLAIN
    };
    let busy = compare_all(&device, &small_scene(), split);
    let look_up = Step::LookUp(Place::Hits);
    let sort = Step::Sort(Place::Hits);
    assert_busy(&busy, &[sort, look_up, Step::SortMisses, Step::Misses]);
    let inline = Setting {
        material_stage: MaterialStage::Inline,
        sorted: false,
        ..split
    };
    let busy = compare_all(&device, &small_scene(), inline);
    assert_busy(&busy, &[Step::Inline(Place::Hits)]);
}
