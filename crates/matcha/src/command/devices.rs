//! `matcha devices`: graphics adapters, what they have and what they lack.

use crate::End;
use crate::arguments::DevicesArguments;
use crate::device::gpu;
use crate::output;
use anyhow::Result;

pub(crate) fn run(arguments: &DevicesArguments) -> Result<End> {
    output::print(&gpu::list(arguments.json)?)?;
    Ok(End::Done)
}
