//! Graphics adapters: which there are, what they have and lack, and which one is taken.

use crate::error::GpuError;
use serde::Serialize;

/// Storage buffers that kernels are bound to at least.
const STORAGE_BUFFERS: u32 = 8;
/// Bytes of a binding, at least.
const BINDING_BYTES: u64 = 128 << 20;
/// Invocations of a workgroup, and its shared memory, at least.
const INVOCATIONS: u32 = 256;
const WORKGROUP_BYTES: u32 = 16 << 10;

/// The kind of an adapter, the best first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// A GPU with its own memory.
    Discrete,
    /// A GPU that shares the processor's memory.
    Integrated,
    /// A GPU seen through a virtual machine.
    Virtual,
    /// Nobody knows.
    Unknown,
    /// A driver that computes on the processor.
    Software,
}

/// What an adapter is and offers.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct AdapterReport {
    /// Its number, for `--device gpu:N`.
    pub number: usize,
    /// Its name.
    pub name: String,
    /// Its driver.
    pub driver: String,
    /// Vulkan, Metal or DX12.
    pub backend: String,
    /// What it is.
    pub kind: Kind,
    /// Bytes of the largest binding.
    pub binding_bytes: u64,
    /// Bytes of the largest buffer.
    pub buffer_bytes: u64,
    /// Storage buffers that a kernel may be bound to.
    pub storage_buffers: u32,
    /// Invocations of the largest workgroup.
    pub invocations: u32,
    /// Fewest and most invocations of a subgroup.
    pub subgroup: [u32; 2],
    /// 64-bit atomic operations: the cache's table takes one of them for an entry.
    pub atomics_64: bool,
    /// Ray queries through acceleration structures of the device's own: `--ray-queries`.
    pub ray_queries: bool,
    /// Times per stage in `--stats`.
    pub timestamps: bool,
    /// Compiled kernels are kept on disk.
    pub pipeline_cache: bool,
    /// What Matcha needs and it has not; empty if it can render.
    pub lacks: Vec<String>,
    /// What Matcha does without, at a cost.
    pub misses: Vec<String>,
}

/// An adapter and what it is.
#[derive(Clone, Debug)]
pub struct Adapter {
    pub(crate) handle: wgpu::Adapter,
    report: AdapterReport,
}

/// What is asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// A GPU that can render; no driver on the processor.
    Real,
    /// The best that can render.
    Best,
    /// By its number.
    Number(usize),
    /// By a part of its name, in any case.
    Named(String),
}

/// All adapters, in a fixed order.
pub fn adapters() -> Vec<Adapter> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::VULKAN | wgpu::Backends::METAL | wgpu::Backends::DX12;
    // Numbers of workgroups come from our own kernels, which keep to the limits.
    descriptor
        .flags
        .remove(wgpu::InstanceFlags::VALIDATION_INDIRECT_CALL);
    // Better no buffer than a desktop without memory.
    descriptor.memory_budget_thresholds.for_resource_creation = Some(95);
    let instance = wgpu::Instance::new(descriptor);
    let handles = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::all()));
    let adapters = handles
        .into_iter()
        .enumerate()
        .map(|(number, handle)| Adapter {
            report: report(number, &handle),
            handle,
        });
    adapters.collect()
}

/// The adapter that is asked for, out of all.
///
/// # Errors
/// If there is none, or it lacks something.
pub fn choose(adapters: Vec<Adapter>, wanted: &Wanted) -> Result<Adapter, GpuError> {
    let reports: Vec<&AdapterReport> = adapters.iter().map(|a| &a.report).collect();
    let index = choose_report(&reports, wanted)?;
    adapters.into_iter().nth(index).ok_or(GpuError::NoAdapter)
}

fn choose_report(reports: &[&AdapterReport], wanted: &Wanted) -> Result<usize, GpuError> {
    let asked = match wanted {
        Wanted::Real | Wanted::Best => String::new(),
        Wanted::Number(number) => format!("gpu:{number}"),
        Wanted::Named(name) => name.clone(),
    };
    let fits = |report: &AdapterReport| match wanted {
        Wanted::Real => report.kind != Kind::Software && report.lacks.is_empty(),
        Wanted::Best => true,
        Wanted::Number(number) => report.number == *number,
        Wanted::Named(name) => contains(&report.name, name) || contains(&report.driver, name),
    };
    let rank =
        |report: &AdapterReport| (!report.lacks.is_empty(), report.kind, report.misses.len());
    let found = reports
        .iter()
        .enumerate()
        .filter(|(_, report)| fits(report));
    let best = found.min_by_key(|(_, report)| rank(report));
    let Some((index, report)) = best else {
        if reports.is_empty() || matches!(wanted, Wanted::Real | Wanted::Best) {
            return Err(GpuError::NoAdapter);
        }
        let all: Vec<String> = reports
            .iter()
            .map(|r| format!("gpu:{} ({})", r.number, r.name))
            .collect();
        return Err(GpuError::Unknown {
            asked,
            found: all.join(", "),
        });
    };
    if !report.lacks.is_empty() {
        return Err(GpuError::Lacks {
            adapter: report.name.clone(),
            lacks: report.lacks.clone(),
        });
    }
    Ok(index)
}

fn contains(text: &str, part: &str) -> bool {
    text.to_lowercase().contains(&part.to_lowercase())
}

impl Adapter {
    /// What it is and offers.
    pub fn report(&self) -> &AdapterReport {
        &self.report
    }
}

fn report(number: usize, adapter: &wgpu::Adapter) -> AdapterReport {
    let info = adapter.get_info();
    let limits = adapter.limits();
    let has = |features| adapter.features().contains(features);
    let mut report = AdapterReport {
        number,
        name: info.name.clone(),
        driver: [info.driver.as_str(), info.driver_info.as_str()]
            .join(" ")
            .trim()
            .to_owned(),
        backend: info.backend.to_string(),
        kind: match info.device_type {
            wgpu::DeviceType::DiscreteGpu => Kind::Discrete,
            wgpu::DeviceType::IntegratedGpu => Kind::Integrated,
            wgpu::DeviceType::VirtualGpu => Kind::Virtual,
            wgpu::DeviceType::Other => Kind::Unknown,
            wgpu::DeviceType::Cpu => Kind::Software,
        },
        binding_bytes: limits.max_storage_buffer_binding_size,
        buffer_bytes: limits.max_buffer_size,
        storage_buffers: limits.max_storage_buffers_per_shader_stage,
        invocations: limits.max_compute_invocations_per_workgroup,
        subgroup: [info.subgroup_min_size, info.subgroup_max_size],
        atomics_64: has(wgpu::Features::SHADER_INT64 | wgpu::Features::SHADER_INT64_ATOMIC_ALL_OPS),
        ray_queries: has(wgpu::Features::EXPERIMENTAL_RAY_QUERY),
        timestamps: has(wgpu::Features::TIMESTAMP_QUERY),
        pipeline_cache: has(wgpu::Features::PIPELINE_CACHE),
        lacks: Vec::new(),
        misses: Vec::new(),
    };
    let downlevel = adapter.get_downlevel_capabilities();
    let compute = downlevel
        .flags
        .contains(wgpu::DownlevelFlags::COMPUTE_SHADERS | wgpu::DownlevelFlags::INDIRECT_EXECUTION);
    report.lacks = lacks(&report, compute, limits.max_compute_workgroup_storage_size);
    report.misses = misses(&report);
    report
}

fn lacks(report: &AdapterReport, compute: bool, workgroup_bytes: u32) -> Vec<String> {
    let mut lacks = Vec::new();
    let mut needs = |has: bool, what: String| {
        if !has {
            lacks.push(what);
        }
    };
    needs(compute, "compute kernels with indirect dispatch".to_owned());
    needs(
        report.storage_buffers >= STORAGE_BUFFERS,
        format!(
            "{STORAGE_BUFFERS} storage buffers ({} are bound at most)",
            report.storage_buffers
        ),
    );
    needs(
        report.binding_bytes >= BINDING_BYTES,
        format!(
            "bindings of 128 MiB ({} MiB at most)",
            report.binding_bytes >> 20
        ),
    );
    needs(
        report.invocations >= INVOCATIONS,
        format!(
            "workgroups of {INVOCATIONS} invocations ({} at most)",
            report.invocations
        ),
    );
    needs(
        workgroup_bytes >= WORKGROUP_BYTES,
        format!("16 KiB of workgroup memory ({workgroup_bytes} bytes at most)"),
    );
    lacks
}

fn misses(report: &AdapterReport) -> Vec<String> {
    let all = [
        (
            report.atomics_64,
            "64-bit atomic operations (the cache's table takes two steps for an entry)",
        ),
        (report.timestamps, "timestamps (no times per stage)"),
        (
            report.pipeline_cache,
            "a pipeline cache (kernels are compiled at every start, unless the driver keeps them)",
        ),
    ];
    let missed = all.iter().filter(|(has, _)| !has);
    missed.map(|(_, what)| (*what).to_owned()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn adapter(number: usize, name: &str, kind: Kind, lacks: &[&str]) -> AdapterReport {
        AdapterReport {
            number,
            name: name.to_owned(),
            driver: "driver 1".to_owned(),
            backend: "vulkan".to_owned(),
            kind,
            binding_bytes: BINDING_BYTES,
            buffer_bytes: 1 << 32,
            storage_buffers: STORAGE_BUFFERS,
            invocations: 1024,
            subgroup: [8, 8],
            atomics_64: true,
            ray_queries: false,
            timestamps: true,
            pipeline_cache: true,
            lacks: lacks.iter().map(|&l| l.to_owned()).collect(),
            misses: Vec::new(),
        }
    }

    fn chosen(all: &[AdapterReport], wanted: &Wanted) -> Result<usize, GpuError> {
        choose_report(&all.iter().collect::<Vec<_>>(), wanted)
    }

    #[test]
    fn the_best_that_can_render_is_taken() {
        let all = [
            adapter(0, "Old", Kind::Discrete, &["bindings of 128 MiB"]),
            adapter(1, "llvmpipe", Kind::Software, &[]),
            adapter(2, "Small", Kind::Integrated, &[]),
            adapter(3, "Big", Kind::Discrete, &[]),
        ];
        assert_eq!(chosen(&all, &Wanted::Real).ok(), Some(3));
        assert_eq!(chosen(&all[..3], &Wanted::Real).ok(), Some(2));
        assert_eq!(chosen(&all[..2], &Wanted::Best).ok(), Some(1));
        assert_eq!(chosen(&all, &Wanted::Number(1)).ok(), Some(1));
        assert_eq!(chosen(&all, &Wanted::Named("LLVM".into())).ok(), Some(1));
    }

    #[test]
    fn a_software_driver_is_no_real_gpu() {
        let all = [adapter(0, "llvmpipe", Kind::Software, &[])];
        assert!(matches!(
            chosen(&all, &Wanted::Real),
            Err(GpuError::NoAdapter)
        ));
        assert!(matches!(
            chosen(&[], &Wanted::Best),
            Err(GpuError::NoAdapter)
        ));
    }

    #[test]
    fn what_cannot_be_taken_is_said_by_name() {
        let all = [adapter(0, "Old", Kind::Discrete, &["bindings of 128 MiB"])];
        let error = chosen(&all, &Wanted::Best).expect_err("it lacks something");
        assert_eq!(
            error.to_string(),
            "Old lacks bindings of 128 MiB: choose another with --device (matcha devices lists them)"
        );
        let error = chosen(&all, &Wanted::Named("New".into())).expect_err("there is none");
        assert_eq!(
            error.to_string(),
            "no graphics adapter is called \"New\"; there are gpu:0 (Old)"
        );
    }
}
