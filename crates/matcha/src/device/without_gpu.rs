//! What stands in for graphics adapters in a build without them.

use crate::arguments::Options;
use anyhow::{Result, bail};
use matcha_render::backend::{Backend, RenderError, RenderOptions};
use matcha_render::prepare::Prepared;
use std::sync::Arc;

/// There is none.
pub(crate) enum Opened {}

impl Opened {
    pub fn name(&self) -> &str {
        match *self {}
    }

    pub fn backend(
        &self,
        _prepared: &Arc<Prepared>,
        _options: &RenderOptions,
    ) -> Result<Box<dyn Backend>, RenderError> {
        match *self {}
    }
}

/// Refuses.
pub(super) fn open(_options: &Options) -> Result<Opened> {
    refuse()
}

/// Says that there is none.
pub(super) fn open_real(_options: &Options) -> Result<Result<Opened, String>> {
    Ok(Err("this build renders on nothing else".to_owned()))
}

/// Refuses.
pub(crate) fn list(_json: bool) -> Result<String> {
    refuse()
}

fn refuse<T>() -> Result<T> {
    bail!(
        "this build of Matcha has no renderer for GPUs: build it with the feature \"gpu\", or render with --device cpu"
    )
}
