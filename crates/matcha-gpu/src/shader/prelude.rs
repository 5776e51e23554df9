//! What every kernel may use. The build script reads this file, too.

/// Workgroups of a row: a dispatch of more has several rows, because a dimension has at
/// most 65535.
pub const COLUMNS: u32 = 32768;

/// Invocations of a workgroup of kernels that have no reason for another number.
pub const WORKGROUP: u32 = 64;

/// Words that a dispatch is given.
pub const ARGUMENTS: usize = 16;

/// What the accessors' names begin with.
pub const ACCESSORS: &[&str] = &[
    "count", "word", "quad", "long", "put", "add", "or", "and", "min", "max", "swap", "compare",
];

/// Numbers of invocations and the dispatch's arguments.
pub fn text() -> String {
    format!(
        "\
const WORKGROUP: u32 = {WORKGROUP}u;
const WORKGROUP_COLUMNS: u32 = {COLUMNS}u;
@group(0) @binding(0) var<uniform> dispatch_arguments: array<vec4u, {}>;
fn argument(k: u32) -> u32 {{ return dispatch_arguments[k >> 2u][k & 3u]; }}
fn workgroup_number(workgroup: vec3u) -> u32 {{ return workgroup.y * WORKGROUP_COLUMNS + workgroup.x; }}
fn invocation_number(workgroup: vec3u, local: u32) -> u32 {{ return workgroup_number(workgroup) * WORKGROUP + local; }}
",
        ARGUMENTS / 4
    )
}

/// Which of the host layers that exclude each other a device's kernels are made of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Dialect {
    /// 64-bit atomic operations (`…_int64.wgsl`), or not (`…_int32.wgsl`).
    pub atomics_64: bool,
    /// The device's ray queries (`…_query.wgsl`), or our own walk (`…_walk.wgsl`).
    pub ray_queries: bool,
}

/// What a kernel with ray queries begins with.
pub const RAY_QUERIES: &str = "enable wgpu_ray_query;\n";

/// True if a host layer belongs to a dialect; most belong to all.
pub fn belongs(file: &str, dialect: Dialect) -> bool {
    let stem = file.strip_suffix(".wgsl").unwrap_or(file);
    let endings = [
        ("_int64", dialect.atomics_64),
        ("_int32", !dialect.atomics_64),
        ("_query", dialect.ray_queries),
        ("_walk", !dialect.ray_queries),
    ];
    endings
        .iter()
        .all(|(ending, has)| *has || !stem.ends_with(ending))
}
