//! The device's memory: sections in buffers, and the way to and from them.

pub mod accessors;
mod binding;
pub mod placement;
pub mod section;
pub(crate) mod transfer;

use crate::device::Device;
use crate::error::GpuError;
use crate::shader::Library;
use crate::shader::items::{Item, items};
pub use placement::PlacementError;
use placement::{Placed, Placement, PlacementLimits};
use section::{Class, Declaration};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// What shall be in memory: sections with their sizes and contents.
#[derive(Default)]
pub struct Sections<'a> {
    list: Vec<(Declaration, u64)>,
    contents: Vec<(String, Cow<'a, [u32]>)>,
    structures: Vec<(String, wgpu::Tlas)>,
    binding_bytes: Option<u64>,
}

impl<'a> Sections<'a> {
    /// Nothing yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// No binding shall be larger, whatever the device allows: for tests of what happens then.
    pub fn limit_bindings(&mut self, bytes: u64) {
        self.binding_bytes = Some(bytes);
    }

    /// A section with contents, in words: for plain sections the values, for others as
    /// many elements as there are words for.
    ///
    /// # Errors
    /// If no shader declares it.
    pub fn filled(
        &mut self,
        library: &Library,
        name: &str,
        words: impl Into<Cow<'a, [u32]>>,
    ) -> Result<(), GpuError> {
        let declaration = library.section(name)?;
        let words = words.into();
        let length = (words.len() as u64).div_ceil(declaration.class.words());
        self.list.push((declaration.clone(), length));
        self.contents.push((name.to_owned(), words));
        Ok(())
    }

    /// A section of zeros with so many elements of its class.
    ///
    /// # Errors
    /// If no shader declares it.
    pub fn zeroed(&mut self, library: &Library, name: &str, length: u64) -> Result<(), GpuError> {
        self.list.push((library.section(name)?.clone(), length));
        Ok(())
    }

    /// An acceleration structure, as a shader declares it (`//@ structure NAME`).
    pub fn structure(&mut self, name: &str, structure: wgpu::Tlas) {
        self.structures.push((name.to_owned(), structure));
    }

    /// Makes the buffers of bind group `group` and fills them. `others` are the memories
    /// that kernels are bound to beside this one: they share the number of bindings.
    ///
    /// # Errors
    /// If the device has no memory or no bindings for it.
    pub fn place(
        self,
        device: &Device,
        group: u32,
        others: &[&Memory],
    ) -> Result<Memory, GpuError> {
        let limits = device.raw().limits();
        let taken: usize = others.iter().map(|m| m.placement.arenas.len()).sum();
        let limits = PlacementLimits {
            binding_bytes: limits
                .max_storage_buffer_binding_size
                .min(limits.max_buffer_size)
                .min(self.binding_bytes.unwrap_or(u64::MAX)),
            storage_buffers: limits
                .max_storage_buffers_per_shader_stage
                .saturating_sub(taken as u32),
            uniform_bytes: limits.max_uniform_buffer_binding_size,
        };
        let placement = Placement::new(&self.list, &limits)?;
        let mut memory = Memory::new(device, group, placement, self.structures)?;
        for (name, words) in &self.contents {
            memory.write(name, 0, words)?;
        }
        Ok(memory)
    }
}

/// Buffers of a bind group, with sections in them.
pub struct Memory {
    device: Device,
    group: u32,
    placement: Placement,
    sections: BTreeMap<String, usize>,
    header_words: Vec<u32>,
    header: wgpu::Buffer,
    arenas: Vec<wgpu::Buffer>,
    layout: wgpu::BindGroupLayout,
    bind_group: wgpu::BindGroup,
    items: BTreeMap<String, Item>,
    /// How many acceleration structures are bound behind the arenas.
    structures: usize,
}

impl Memory {
    fn new(
        device: &Device,
        group: u32,
        placement: Placement,
        structures: Vec<(String, wgpu::Tlas)>,
    ) -> Result<Memory, GpuError> {
        let header_words = placement.header();
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let header = buffer(device, "the header", header_words.len() as u64 * 4, usage)?;
        let mut arenas = Vec::new();
        for arena in &placement.arenas {
            let what = format!("sections \"{}\"", arena.class.name());
            let usage = wgpu::BufferUsages::STORAGE
                | wgpu::BufferUsages::COPY_DST
                | wgpu::BufferUsages::COPY_SRC;
            let bytes = arena.length * arena.class.words() * 4;
            arenas.push(buffer(device, &what, bytes, usage)?);
        }
        let layout = binding::layout(device, &placement, structures.len())?;
        let bind_group = binding::bind_group(device, &layout, &header, &arenas, &structures)?;
        let mut text = accessors::accessors(&placement, group);
        for (binding, (name, _)) in (1 + arenas.len()..).zip(&structures) {
            text += &accessors::structure(name, group, binding);
        }
        let names = placement.sections.iter().enumerate();
        let memory = Memory {
            device: device.clone(),
            group,
            sections: names
                .map(|(i, s)| (s.declaration.name.clone(), i))
                .collect(),
            header_words,
            header,
            arenas,
            layout,
            bind_group,
            items: items(&text)
                .into_iter()
                .map(|item| (item.name.clone(), item))
                .collect(),
            structures: structures.len(),
            placement,
        };
        memory.write_header();
        Ok(memory)
    }

    /// The number of its bind group.
    pub fn group(&self) -> u32 {
        self.group
    }

    /// Bytes of all its buffers.
    pub fn bytes(&self) -> u64 {
        let arenas: u64 = self.arenas.iter().map(wgpu::Buffer::size).sum();
        arenas + self.header.size()
    }

    /// Elements of a section.
    ///
    /// # Errors
    /// If it is not in this memory.
    pub fn length(&self, name: &str) -> Result<u64, GpuError> {
        Ok(self.placed(name)?.length)
    }

    /// Names of the sections that kernels write.
    pub fn written(&self) -> impl Iterator<Item = &str> {
        let sections = self.placement.sections.iter().map(|s| &s.declaration);
        let written = sections.filter(|declaration| !declaration.class.read_only());
        written.map(|declaration| declaration.name.as_str())
    }

    /// True if the section is here.
    pub fn holds(&self, name: &str) -> bool {
        self.sections.contains_key(name)
    }

    pub(crate) fn layout(&self) -> &wgpu::BindGroupLayout {
        &self.layout
    }

    pub(crate) fn bind_group(&self) -> &wgpu::BindGroup {
        &self.bind_group
    }

    /// Names the layout of its bindings: kernels compiled for one fit all of the same.
    pub(crate) fn shape(&self) -> String {
        let classes: Vec<_> = self
            .placement
            .arenas
            .iter()
            .map(|a| a.class.name())
            .collect();
        format!("{} {} +{};", self.group, classes.join(" "), self.structures)
    }

    /// The bindings and accessors in WGSL.
    pub(crate) fn item(&self, name: &str) -> Option<&Item> {
        self.items.get(name)
    }

    fn placed(&self, name: &str) -> Result<&Placed, GpuError> {
        match self.sections.get(name) {
            Some(&index) => Ok(&self.placement.sections[index]),
            None => Err(GpuError::Invalid {
                what: format!("section {name}"),
                message: format!("it is not in group {}", self.group),
            }),
        }
    }

    /// Writes the values of a plain section, or the elements of another from `first` on.
    ///
    /// # Errors
    /// If it is not in this memory, or too short.
    pub fn write(&mut self, name: &str, first: u64, words: &[u32]) -> Result<(), GpuError> {
        let placed = self.placed(name)?;
        if placed.declaration.class == Class::Plain {
            let start = (placed.offset + first) as usize;
            let room = (placed.length - first.min(placed.length)) as usize;
            if words.len() > room {
                return Err(too_long(name));
            }
            self.header_words[start..start + words.len()].copy_from_slice(words);
            self.write_header();
            return Ok(());
        }
        let elements = words.len() as u64 / placed.declaration.class.words();
        let mut words = words;
        for piece in self.pieces(name, first, elements)? {
            let (now, rest) = words.split_at(piece.bytes as usize / 4);
            transfer::upload(&self.device, &self.arenas[piece.arena], piece.offset, now)?;
            words = rest;
        }
        Ok(())
    }

    /// The words of `length` elements from `first` on, all work before being done.
    ///
    /// # Errors
    /// If they are not in this memory, or the device fails.
    pub fn read(&self, name: &str, first: u64, length: u64) -> Result<Vec<u32>, GpuError> {
        let mut words = Vec::new();
        for piece in self.pieces(name, first, length)? {
            let arena = &self.arenas[piece.arena];
            transfer::download(&self.device, arena, piece.offset, piece.bytes, &mut words)?;
        }
        Ok(words)
    }

    /// Makes a section zero, in the order of `commands`.
    ///
    /// # Errors
    /// If it is not in this memory.
    pub fn clear(&self, commands: &mut wgpu::CommandEncoder, name: &str) -> Result<(), GpuError> {
        for piece in self.pieces(name, 0, self.length(name)?)? {
            commands.clear_buffer(&self.arenas[piece.arena], piece.offset, Some(piece.bytes));
        }
        Ok(())
    }

    /// Copies elements into another buffer, in the order of `commands`.
    ///
    /// # Errors
    /// If they are not in this memory.
    pub fn copy(
        &self,
        commands: &mut wgpu::CommandEncoder,
        name: &str,
        first: u64,
        length: u64,
        to: &wgpu::Buffer,
    ) -> Result<(), GpuError> {
        let mut at = 0;
        for piece in self.pieces(name, first, length)? {
            let from = &self.arenas[piece.arena];
            commands.copy_buffer_to_buffer(from, piece.offset, to, at, piece.bytes);
            at += piece.bytes;
        }
        Ok(())
    }

    fn write_header(&self) {
        let words = bytemuck::cast_slice(&self.header_words);
        self.device.queue().write_buffer(&self.header, 0, words);
    }

    /// Where elements of a section lie.
    fn pieces(&self, name: &str, first: u64, length: u64) -> Result<Vec<Piece>, GpuError> {
        let placed = self.placed(name)?;
        if first + length > placed.length {
            return Err(too_long(name));
        }
        let class = placed.declaration.class;
        let capacity = self.placement.binding_length(class);
        let mut pieces = Vec::new();
        let (mut at, mut rest) = (placed.offset + first, length);
        while rest > 0 {
            // A section of one arena begins anywhere in it, but ends in it.
            let here = rest.min(capacity - at % capacity);
            pieces.push(Piece {
                arena: placed.arena + (at / capacity) as usize,
                offset: at % capacity * class.words() * 4,
                bytes: here * class.words() * 4,
            });
            at += here;
            rest -= here;
        }
        Ok(pieces)
    }
}

/// Part of an arena.
struct Piece {
    arena: usize,
    /// First byte.
    offset: u64,
    bytes: u64,
}

fn too_long(name: &str) -> GpuError {
    GpuError::Invalid {
        what: format!("section {name}"),
        message: "there is not so much of it".to_owned(),
    }
}

/// A buffer, or an error that says what it was for.
pub(crate) fn buffer(
    device: &Device,
    what: &str,
    bytes: u64,
    usage: wgpu::BufferUsages,
) -> Result<wgpu::Buffer, GpuError> {
    device.create(what, bytes, |device| {
        device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(what),
            size: bytes,
            usage,
            mapped_at_creation: false,
        })
    })
}
