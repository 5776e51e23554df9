//! From the command line's `--device` to renderers.

#[cfg_attr(not(feature = "gpu"), path = "without_gpu.rs")]
pub(crate) mod gpu;

use crate::arguments::{self, Options};
use anyhow::{Result, bail};
use gpu::Opened;
use matcha_render::backend::{Backend, RenderError, RenderOptions};
use matcha_render::cpu::CpuBackend;
use matcha_render::prepare::Prepared;
use std::sync::Arc;

/// A device that is ready.
pub(crate) enum Device {
    /// The processor.
    Cpu,
    /// A graphics adapter that was asked for.
    Gpu(Opened),
    /// A graphics adapter that nobody asked for: the CPU may stand in.
    GpuOrCpu(Opened),
}

impl Device {
    /// Finds and opens what the options ask for. What `auto` takes is said in the log.
    pub fn choose(options: &Options) -> Result<Device> {
        match &options.device {
            arguments::Device::Cpu if options.ray_queries => bail!(
                "--ray-queries is for GPUs: render without it, or choose another with --device"
            ),
            arguments::Device::Cpu => Ok(Device::Cpu),
            arguments::Device::Auto => match gpu::open_real(options)? {
                Ok(opened) => {
                    tracing::info!("rendering on {}", opened.name());
                    // With ray queries or not at all.
                    Ok(if options.ray_queries {
                        Device::Gpu(opened)
                    } else {
                        Device::GpuOrCpu(opened)
                    })
                }
                Err(reason) if options.ray_queries => {
                    bail!("--ray-queries is for GPUs, but --device auto takes the CPU: {reason}")
                }
                Err(reason) => {
                    tracing::info!("rendering on the CPU: {reason}");
                    Ok(Device::Cpu)
                }
            },
            _ => gpu::open(options).map(Device::Gpu),
        }
    }

    /// Renderers of a scene, all on the same device.
    pub fn backends<const N: usize>(
        &self,
        prepared: &Arc<Prepared>,
        options: [RenderOptions; N],
    ) -> Result<[Box<dyn Backend>; N]> {
        let on_cpu = |options: &RenderOptions| -> Result<Box<dyn Backend>, RenderError> {
            Ok(Box::new(CpuBackend::new(prepared.clone(), options)?))
        };
        match self {
            Device::Cpu => all(&options, on_cpu),
            Device::Gpu(opened) => all(&options, |o| opened.backend(prepared, o)),
            Device::GpuOrCpu(opened) => match all(&options, |o| opened.backend(prepared, o)) {
                Ok(backends) => Ok(backends),
                Err(error) => {
                    tracing::warn!("rendering on the CPU instead: {error}");
                    all(&options, on_cpu)
                }
            },
        }
    }
}

/// One renderer for each of several options.
fn all<const N: usize>(
    options: &[RenderOptions; N],
    make: impl Fn(&RenderOptions) -> Result<Box<dyn Backend>, RenderError>,
) -> Result<[Box<dyn Backend>; N]> {
    let made: Result<Vec<_>, RenderError> = options.iter().map(make).collect();
    match made?.try_into() {
        Ok(backends) => Ok(backends),
        Err(_) => unreachable!("there is one for each"),
    }
}
