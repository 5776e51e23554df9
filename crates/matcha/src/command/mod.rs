//! The commands.

pub(crate) mod compare;
pub(crate) mod devices;
pub(crate) mod inspect;
mod inspect_dot;
pub(crate) mod render;
mod report;
