//! Memory, kernels and batches on a device.

use matcha_gpu::batch::{Extent, Runner, workgroups};
use matcha_gpu::device::Device;
use matcha_gpu::memory::{Memory, Sections};
use matcha_gpu::pipeline::{KernelSource, Pipelines};
use matcha_gpu::shader::Library;
use matcha_gpu::{GpuError, testing};
use matcha_shade::device::hash::hash1;

const KERNELS: &str = "
//@ read numbers
//@ read4 quads
//@ write sums
//@ write4 doubled
//@ atomic counters
//@ plain added 2

@compute @workgroup_size(64)
fn add_all(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let i = invocation_number(group, local);
    if i >= count_sums() {
        return;
    }
    put_sums(i, word_numbers(i) + word_added(1u) + argument(0u) + (hash1(i) & 3u));
    add_counters(word_numbers(i) & 1u, 1u);
    if i < count_quads() {
        put_doubled(i, quad_quads(i) * 2u);
    }
}

@compute @workgroup_size(1)
fn size_next() {
    let size = workgroups_for(1000u);
    put_counters(4u, size.x);
    put_counters(5u, size.y);
    put_counters(6u, size.z);
}
";

struct Setup {
    library: Library,
    scene: Memory,
    state: Memory,
}

const COUNT: u32 = 5000;

fn setup(device: &Device, binding_bytes: u64) -> Result<Setup, GpuError> {
    let mut library = Library::embedded(device.report().atomics_64)?;
    library.add("test.wgsl", KERNELS)?;
    let mut scene = Sections::new();
    scene.limit_bindings(binding_bytes);
    scene.filled(&library, "numbers", (0..COUNT).collect::<Vec<u32>>())?;
    scene.filled(&library, "quads", (0..400).collect::<Vec<u32>>())?;
    scene.filled(&library, "added", vec![7, 1000])?;
    let scene = scene.place(device, 1, &[])?;
    let mut state = Sections::new();
    state.limit_bindings(binding_bytes);
    state.zeroed(&library, "sums", u64::from(COUNT))?;
    state.zeroed(&library, "doubled", 100)?;
    state.zeroed(&library, "counters", 8)?;
    let state = state.place(device, 2, &[&scene])?;
    Ok(Setup {
        library,
        scene,
        state,
    })
}

fn sums(device: &Device, binding_bytes: u64) -> Result<(), GpuError> {
    let Setup {
        library,
        scene,
        state,
    } = setup(device, binding_bytes)?;
    let pipelines = Pipelines::new(device, None);
    let memories = [&scene, &state];
    let kernel = |name| {
        pipelines.kernel(&KernelSource {
            name,
            library: &library,
            memories: &memories,
            constants: &[],
        })
    };
    let (add_all, size_next) = (kernel("add_all")?, kernel("size_next")?);
    let indirect = device.raw().create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: 12,
        usage: wgpu::BufferUsages::INDIRECT | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let mut runner = Runner::new(device)?;
    let mut batch = runner.batch();
    batch.dispatch("add", &add_all, &memories, &[50], Extent::Items(COUNT));
    batch.dispatch("size", &size_next, &memories, &[], Extent::Items(1));
    state.copy(batch.commands(), "counters", 4, 3, &indirect)?;
    // A thousand more, with another argument.
    batch.dispatch(
        "add",
        &add_all,
        &memories,
        &[60],
        Extent::Indirect(&indirect, 0),
    );
    let time = batch.run()?;
    let sums = state.read("sums", 0, u64::from(COUNT))?;
    for (i, sum) in (0..).zip(&sums) {
        let argument = if i < 1024 { 60 } else { 50 };
        let expected = i + 1000 + argument + (hash1(i) & 3);
        assert_eq!(*sum, expected, "element {i}");
    }
    assert_eq!(state.read("sums", 1023, 2)?, sums[1023..1025]);
    let doubled: Vec<u32> = (0..400).map(|i| 2 * i).collect();
    assert_eq!(state.read("doubled", 0, 100)?, doubled);
    assert_eq!(state.read("counters", 0, 2)?, [2500 + 512, 2500 + 512]);
    if device.report().timestamps {
        let stages: Vec<_> = time.dispatches.iter().map(|(stage, _)| *stage).collect();
        assert_eq!(stages, ["add", "size", "add"]);
        assert!(runner.stage_seconds()["add"] > 0.0);
    }
    let mut batch = runner.batch();
    state.clear(batch.commands(), "sums")?;
    batch.run()?;
    assert!(
        state
            .read("sums", 0, u64::from(COUNT))?
            .iter()
            .all(|&w| w == 0)
    );
    Ok(())
}

#[test]
fn kernels_read_and_write_sections() {
    let Some(device) = testing::device() else {
        return;
    };
    sums(&device, u64::MAX).unwrap_or_else(|error| panic!("{error}"));
}

#[test]
fn a_section_may_need_several_bindings() {
    let Some(device) = testing::device() else {
        return;
    };
    sums(&device, 8192).unwrap_or_else(|error| panic!("{error}"));
}

#[test]
fn a_kernel_without_its_section_is_refused_by_name() {
    let Some(device) = testing::device() else {
        return;
    };
    let setup = setup(&device, u64::MAX).unwrap_or_else(|error| panic!("{error}"));
    let error = setup
        .library
        .link("add_all", &[&setup.scene])
        .expect_err("sums are missing");
    let text = error.to_string();
    assert!(
        text.contains("\"add_all\"") && text.contains("in none of its memories"),
        "{text}"
    );
}

#[test]
fn a_kernel_that_a_driver_refuses_is_named() {
    let Some(device) = testing::device() else {
        return;
    };
    let mut library = Library::default();
    let source = "@compute @workgroup_size(64) fn broken() { let x: u32 = 1.5; }";
    library.add("broken.wgsl", source).expect("it is one item");
    let pipelines = Pipelines::new(&device, None);
    let refused = pipelines.kernel(&KernelSource {
        name: "broken",
        library: &library,
        memories: &[],
        constants: &[],
    });
    let Err(GpuError::Pipeline { kernel, message }) = refused else {
        panic!("it is not refused");
    };
    assert_eq!(kernel, "broken");
    assert!(!message.contains('\n'), "{message}");
}

#[test]
fn a_dispatch_of_many_workgroups_has_rows() {
    assert_eq!(workgroups(0), [0, 0, 1]);
    assert_eq!(workgroups(32768), [32768, 1, 1]);
    assert_eq!(workgroups(32769), [32768, 2, 1]);
}

#[test]
fn compiled_kernels_are_kept_on_disk() {
    let Some(device) = testing::device() else {
        return;
    };
    if !device.report().pipeline_cache {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let setup = setup(&device, u64::MAX).unwrap_or_else(|error| panic!("{error}"));
    let compile = |pipelines: &Pipelines| {
        let source = KernelSource {
            name: "add_all",
            library: &setup.library,
            memories: &[&setup.scene, &setup.state],
            constants: &[],
        };
        let kernel = pipelines.kernel(&source);
        kernel.unwrap_or_else(|error| panic!("{error}"));
    };
    let pipelines = Pipelines::new(&device, Some(folder.path()));
    compile(&pipelines);
    pipelines.save();
    let files = || {
        let entries = std::fs::read_dir(folder.path()).expect("the folder");
        entries
            .map(|entry| entry.expect("a file").path())
            .collect::<Vec<_>>()
    };
    let [file] = files().try_into().expect("one file");
    let length = std::fs::metadata(&file).expect("a file").len();
    std::fs::write(&file, b"damaged").expect("it is writable");
    let again = Pipelines::new(&device, Some(folder.path()));
    compile(&again);
    again.save();
    assert_eq!(std::fs::metadata(&file).expect("a file").len(), length);
}
