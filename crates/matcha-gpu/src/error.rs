//! What can go wrong with a device, each in a sentence that says what to do.

use crate::memory::PlacementError;
use crate::shader::LinkError;
use matcha_cache::CacheError;
use matcha_render::backend::RenderError;
use std::sync::Arc;
use std::time::Duration;

/// Why a device does not do what it should.
#[derive(Clone, Debug, thiserror::Error)]
pub enum GpuError {
    /// There is none.
    #[error(
        "there is no graphics adapter with Vulkan, Metal or DX12: install its driver (Mesa's lavapipe runs on any \
         processor) or render with --device cpu"
    )]
    NoAdapter,
    /// None is called that.
    #[error("no graphics adapter is called \"{asked}\"; there are {found}")]
    Unknown {
        /// The number or name that was asked for.
        asked: String,
        /// Those that there are, for people.
        found: String,
    },
    /// It cannot run Matcha.
    #[error("{adapter} lacks {}: choose another with --device (matcha devices lists them)", lacks.join(", "))]
    Lacks {
        /// The adapter's name.
        adapter: String,
        /// What it lacks.
        lacks: Vec<String>,
    },
    /// It has no ray queries, but they were asked for.
    #[error(
        "{adapter} has no hardware ray queries: render without --ray-queries, or choose another with --device \
         (matcha devices says which has them)"
    )]
    NoRayQueries {
        /// The adapter's name.
        adapter: String,
    },
    /// The driver does not open it.
    #[error(
        "{adapter} cannot be opened ({message}): is another program using it, or its driver out of date?"
    )]
    Refused {
        /// The adapter's name.
        adapter: String,
        /// The driver's words.
        message: String,
    },
    /// Not enough memory.
    #[error(
        "the graphics device has no memory for {what} ({} MiB): render with a smaller cache (--cells), a smaller \
         picture or --device cpu",
        bytes.div_ceil(1 << 20)
    )]
    OutOfMemory {
        /// What it was for.
        what: String,
        /// How much it was.
        bytes: u64,
    },
    /// The scene is more than the device can take.
    #[error("{0}")]
    Scene(String),
    /// A limit of the device.
    #[error("{0}")]
    Placement(#[from] PlacementError),
    /// The device is gone.
    #[error("the graphics device was lost ({message}): try again, or with --device cpu")]
    Lost {
        /// The driver's words.
        message: String,
    },
    /// The device does not come back.
    #[error(
        "the graphics device has not answered for {} s: try again, or with --device cpu",
        waited.as_secs()
    )]
    Silent {
        /// How long it was waited for.
        waited: Duration,
    },
    /// The driver does not take a kernel.
    #[error(
        "the driver refuses the kernel \"{kernel}\" ({message}): update it, or render with --device cpu"
    )]
    Pipeline {
        /// The kernel.
        kernel: String,
        /// The driver's words.
        message: String,
    },
    /// The scene or what is asked of it, whatever the device.
    #[error("{0}")]
    Render(#[from] Arc<RenderError>),
    /// A kernel's text does not come together.
    #[error("{0}")]
    Link(#[from] LinkError),
    /// The device refuses a command: a mistake of Matcha's.
    #[error(
        "the graphics device refuses {what} ({message}): this is a mistake in Matcha, please report it"
    )]
    Invalid {
        /// What was asked of it.
        what: String,
        /// Its words.
        message: String,
    },
}

impl From<RenderError> for GpuError {
    fn from(error: RenderError) -> Self {
        GpuError::Render(Arc::new(error))
    }
}

impl From<CacheError> for GpuError {
    fn from(error: CacheError) -> Self {
        RenderError::from(error).into()
    }
}

impl From<GpuError> for RenderError {
    fn from(error: GpuError) -> Self {
        RenderError::Device(Box::new(error))
    }
}

/// An error's text with its causes', in one line.
pub(crate) fn one_line(error: &dyn std::error::Error) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(inner) = cause {
        let more = inner.to_string();
        if !text.contains(&more) {
            text = format!("{text}: {more}");
        }
        cause = inner.source();
    }
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
