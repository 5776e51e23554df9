//! How large kernels are, and how long a driver takes to make them.
//!
//! `kernels SCENE [KERNEL …]` compiles the kernels with the operations of a scene and runs each
//! over empty queues (some drivers compile when a kernel first runs): seconds. With
//! `MATCHA_KERNELS=size` it prints what is in them instead. Drivers inline every function, so
//! that counts are of the inlined text: operations (a vector's components one by one), words
//! that are read from and written to buffers and to arrays with a variable index, branches;
//! then the functions with the largest part in it, and their copies.
//!
//! To have kernels made anew: `MESA_SHADER_CACHE_DISABLE=true`.

use matcha_gpu::GpuError;
use matcha_gpu::adapter::{self, Wanted};
use matcha_gpu::batch::{Extent, Runner};
use matcha_gpu::device::Device;
use matcha_gpu::machine::switch;
use matcha_gpu::memory::{Memory, Sections};
use matcha_gpu::pipeline::{KernelSource, Pipelines};
use matcha_gpu::shader::Library;
use matcha_render::flat::FlatScene;
use matcha_render::prepare::Prepared;
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{AddressSpace, Expression, Function, Handle, Module, ScalarKind, Statement, TypeInner};
use std::collections::HashMap;
use std::ops::{AddAssign, Mul};
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

/// The kernels of a rendering with everything, large ones first.
const ALL: [&str; 13] = [
    "wave_shade",
    "wave_inline",
    "wave_evaluate",
    "wave_misses",
    "wave_look_up",
    "wave_emit",
    "wave_pass",
    "wave_meet_trees",
    "wave_meet",
    "wave_escape_trees",
    "wave_escape",
    "wave_block",
    "wave_regenerate",
];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let scene = arguments.next().ok_or("kernels SCENE [KERNEL …]")?;
    let named: Vec<String> = arguments.collect();
    let kernels = if named.is_empty() {
        ALL.map(str::to_owned).to_vec()
    } else {
        named
    };
    let device = Device::open(&adapter::choose(adapter::adapters(), &Wanted::Best)?)?;
    let library = library(&device, Path::new(&scene))?;
    let memory = memory(&device, &library)?;
    let sizes = std::env::var_os("MATCHA_KERNELS").is_some_and(|what| what == "size");
    for kernel in kernels {
        if sizes {
            print_size(&library.link(&kernel, &[&memory])?.text, &kernel)?;
        } else {
            let seconds = compile(&device, &library, &memory, &kernel)?;
            println!("{kernel:20} {seconds:7.1} s");
        }
    }
    Ok(())
}

/// Kernels with the operations of a scene.
fn library(device: &Device, scene: &Path) -> Result<Library, Box<dyn std::error::Error>> {
    let loaded = matcha_import::load(scene, &Default::default(), &mut |_| {})?;
    let prepared = Arc::new(Prepared::new(loaded.scene, Some([32, 18]))?);
    let programs = prepared.programs(true)?;
    let flat = FlatScene::new(&prepared, &programs);
    let mut library = Library::embedded(device.has_atomics_64())?;
    library.add(
        "the scene's operations",
        &switch(flat.programs().operations()),
    )?;
    Ok(library)
}

/// Every section that a kernel may ask for, with nothing in it.
fn memory(device: &Device, library: &Library) -> Result<Memory, GpuError> {
    let mut sections = Sections::new();
    for section in library.sections() {
        sections.zeroed(library, &section.name, 64 * u64::from(section.stride))?;
    }
    sections.place(device, 1, &[])
}

/// Compiles a kernel and runs it over nothing; seconds.
fn compile(
    device: &Device,
    library: &Library,
    memory: &Memory,
    kernel: &str,
) -> Result<f64, GpuError> {
    let pipelines = Pipelines::new(device, None);
    let start = Instant::now();
    let kernel = pipelines.kernel(&KernelSource {
        name: kernel,
        library,
        memories: &[memory],
        constants: &[],
    })?;
    let mut runner = Runner::new(device)?;
    let mut batch = runner.batch();
    batch.dispatch("kernel", &kernel, &[memory], &[0; 6], Extent::Items(1));
    batch.run()?;
    Ok(start.elapsed().as_secs_f64())
}

/// What a driver has to deal with.
#[derive(Clone, Copy, Default)]
struct Size {
    operations: u64,
    reads: u64,
    writes: u64,
    indexed: u64,
    branches: u64,
}

impl AddAssign for Size {
    fn add_assign(&mut self, other: Size) {
        self.operations += other.operations;
        self.reads += other.reads;
        self.writes += other.writes;
        self.indexed += other.indexed;
        self.branches += other.branches;
    }
}

impl Mul<u64> for Size {
    type Output = Size;
    fn mul(self, copies: u64) -> Size {
        Size {
            operations: self.operations * copies,
            reads: self.reads * copies,
            writes: self.writes * copies,
            indexed: self.indexed * copies,
            branches: self.branches * copies,
        }
    }
}

impl Size {
    /// One number to sort by: what a word in a buffer or in an array costs a driver that
    /// computes on the processor, in operations.
    fn weight(self) -> u64 {
        self.operations + 20 * (self.reads + self.writes) + 40 * self.indexed + 10 * self.branches
    }
}

/// A function's own size and whom it calls.
struct Counted {
    own: Size,
    calls: HashMap<Handle<Function>, u64>,
}

struct Counter<'m> {
    module: &'m Module,
    function: &'m Function,
    info: &'m naga::valid::FunctionInfo,
    counted: Counted,
}

/// Where an address begins, and whether an index on the way is variable.
enum Root {
    Buffer,
    Array,
    Other,
}

impl Counter<'_> {
    fn words(&self, expression: Handle<Expression>) -> u64 {
        let inner = self.info[expression].ty.inner_with(&self.module.types);
        match inner {
            TypeInner::Pointer { base, .. } => {
                let size = self.module.types[*base].inner.size(self.module.to_ctx());
                u64::from(size / 4)
            }
            TypeInner::ValuePointer { size, .. } => size.map_or(1, |size| size as u64),
            other => u64::from(other.size(self.module.to_ctx()) / 4),
        }
    }

    fn root(&self, mut at: Handle<Expression>) -> Root {
        let mut variable = false;
        loop {
            match self.function.expressions[at] {
                Expression::Access { base, index } => {
                    let constant = matches!(
                        self.function.expressions[index],
                        Expression::Literal(_) | Expression::Constant(_)
                    );
                    variable |= !constant;
                    at = base;
                }
                Expression::AccessIndex { base, .. } => at = base,
                Expression::GlobalVariable(global) => {
                    let space = self.module.global_variables[global].space;
                    return match space {
                        AddressSpace::Storage { .. } => Root::Buffer,
                        _ if variable => Root::Array,
                        _ => Root::Other,
                    };
                }
                _ if variable => return Root::Array,
                _ => return Root::Other,
            }
        }
    }

    fn expression(&mut self, handle: Handle<Expression>) {
        let one = |inner: &TypeInner| match inner {
            TypeInner::Vector { size, .. } => *size as u64,
            _ => 1,
        };
        let components = one(self.info[handle].ty.inner_with(&self.module.types));
        let own = &mut self.counted.own;
        match self.function.expressions[handle] {
            Expression::Binary { .. }
            | Expression::Unary { .. }
            | Expression::Select { .. }
            | Expression::Math { .. }
            | Expression::Relational { .. } => own.operations += components,
            Expression::As { kind, convert, .. } => {
                own.operations += u64::from(convert.is_some() && kind != ScalarKind::Bool);
            }
            Expression::Load { pointer } => {
                let words = self.words(pointer);
                match self.root(pointer) {
                    Root::Buffer => self.counted.own.reads += words,
                    Root::Array => self.counted.own.indexed += words,
                    Root::Other => {}
                }
            }
            _ => {}
        }
    }

    fn block(&mut self, block: &naga::Block) {
        for statement in block {
            match statement {
                Statement::Emit(range) => {
                    for handle in range.clone() {
                        self.expression(handle);
                    }
                }
                Statement::Block(inner) => self.block(inner),
                Statement::If { accept, reject, .. } => {
                    self.counted.own.branches += 1;
                    self.block(accept);
                    self.block(reject);
                }
                Statement::Switch { cases, .. } => {
                    for case in cases {
                        self.counted.own.branches += 1;
                        self.block(&case.body);
                    }
                }
                Statement::Loop {
                    body, continuing, ..
                } => {
                    self.counted.own.branches += 1;
                    self.block(body);
                    self.block(continuing);
                }
                Statement::Store { pointer, .. } => {
                    let words = self.words(*pointer);
                    match self.root(*pointer) {
                        Root::Buffer => self.counted.own.writes += words,
                        Root::Array => self.counted.own.indexed += words,
                        Root::Other => {}
                    }
                }
                Statement::Atomic { .. } => self.counted.own.writes += 1,
                Statement::Call { function, .. } => {
                    *self.counted.calls.entry(*function).or_default() += 1;
                }
                _ => {}
            }
        }
    }
}

fn count(module: &Module, function: &Function, info: &naga::valid::FunctionInfo) -> Counted {
    let mut counter = Counter {
        module,
        function,
        info,
        counted: Counted {
            own: Size::default(),
            calls: HashMap::new(),
        },
    };
    counter.block(&function.body);
    counter.counted
}

fn print_size(text: &str, kernel: &str) -> Result<(), Box<dyn std::error::Error>> {
    let module = naga::front::wgsl::parse_str(text)?;
    let info: ModuleInfo =
        Validator::new(ValidationFlags::all(), Capabilities::all()).validate(&module)?;
    let entry = count(
        &module,
        &module.entry_points[0].function,
        info.get_entry_point(0),
    );
    let functions: HashMap<_, _> = module
        .functions
        .iter()
        .map(|(handle, function)| (handle, count(&module, function, &info[handle])))
        .collect();
    // Functions stand before those that call them.
    let mut copies: HashMap<Handle<Function>, u64> = entry.calls;
    let mut inclusive: HashMap<Handle<Function>, Size> = HashMap::new();
    for (handle, _) in module.functions.iter() {
        let mut size = functions[&handle].own;
        for (callee, times) in &functions[&handle].calls {
            size += inclusive[callee] * *times;
        }
        inclusive.insert(handle, size);
    }
    let order: Vec<_> = module.functions.iter().map(|(handle, _)| handle).collect();
    for handle in order.into_iter().rev() {
        let Some(&times) = copies.get(&handle) else {
            continue;
        };
        for (callee, calls) in &functions[&handle].calls {
            *copies.entry(*callee).or_default() += times * calls;
        }
    }
    let mut total = entry.own;
    for (handle, times) in &copies {
        total += functions[handle].own * *times;
    }
    println!("{kernel}: weight {}", total.weight());
    println!("  copies  operations  reads  writes  indexed  branches");
    print_row(1, total, "all");
    let mut rows: Vec<_> = copies.iter().collect();
    let part = |&(handle, times): &(&Handle<Function>, &u64)| (inclusive[handle] * *times).weight();
    rows.sort_by_key(|row| std::cmp::Reverse(part(row)));
    for (handle, times) in rows.into_iter().take(rows_wanted()) {
        let name = module.functions[*handle].name.as_deref().unwrap_or("?");
        print_row(*times, inclusive[handle] * *times, name);
    }
    Ok(())
}

fn rows_wanted() -> usize {
    std::env::var("MATCHA_KERNELS_ROWS")
        .ok()
        .and_then(|rows| rows.parse().ok())
        .unwrap_or(40)
}

fn print_row(copies: u64, size: Size, name: &str) {
    println!(
        "{copies:8} {:11} {:6} {:7} {:8} {:9}  {name} ({})",
        size.operations,
        size.reads,
        size.writes,
        size.indexed,
        size.branches,
        size.weight()
    );
}
