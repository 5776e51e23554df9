//! The stack machine on the device: `wgsl/machine.wgsl`, and what is written of it for each
//! scene.

mod switch;

pub use switch::switch;
