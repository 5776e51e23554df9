//! The GPU as a rendering device, through wgpu: Vulkan, Metal or DX12.
//!
//! * [`adapter`]: which devices there are, and which is taken; [`device`]: an open one.
//! * [`memory`]: named arrays in as few buffers as the limits allow, and their accessors.
//! * [`shader`]: WGSL of kernels put together from device code (Rust, translated when the
//!   crate is built), host layers (`src/wgsl/*.wgsl`) and accessors.
//! * [`pipeline`]: kernels compiled, and kept on disk.
//! * [`batch`]: dispatches, timed.
//! * [`sort`]: a counting sort of queues.
//! * [`table`]: the material cache's table.
//! * [`trace`]: the hierarchy in compressed nodes, and the walk of rays through it.
//! * [`wavefront`]: a scene's paths on a device, and on the processor stage by stage (`twin`), to
//!   compare; [`backend`]: that as what renders.
//!
//! A host layer declares the sections that it reaches into (`//@ read4 bvh_nodes`, see
//! [`memory::section`]) and calls their accessors ([`memory::accessors`]). A kernel is an
//! entry point of any host layer; it gets the items that it needs, of all files, and is
//! bound to its arguments (group 0) and to memories (groups 1, 2, …).

pub mod adapter;
pub mod backend;
pub mod batch;
pub mod device;
mod error;
pub mod machine;
pub mod memory;
pub mod pipeline;
pub mod shader;
pub mod sort;
pub mod table;
#[doc(hidden)]
pub mod testing;
pub mod trace;
mod twin;
pub mod wavefront;

pub use error::GpuError;
