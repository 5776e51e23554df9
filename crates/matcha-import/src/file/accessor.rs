//! Typed arrays out of accessors (glTF 2.0, section 3.6.2), sparse ones too.

use super::Document;
use crate::error::{Checked, Fault};
use gltf::json::accessor::{Accessor, ComponentType, Type, sparse::Sparse};
use gltf::json::validation::Checked as Valid;

/// Elements in memory: `count` of `width` components each, `stride` bytes apart.
struct Elements<'a> {
    data: &'a [u8],
    stride: usize,
    component: ComponentType,
    normalized: bool,
}

impl Elements<'_> {
    fn float(&self, element: usize, i: usize) -> f32 {
        let at = element * self.stride + i * size_of_component(self.component);
        let bytes = &self.data[at..];
        // Section 3.6.2.2: signed integers map to [-1, 1], unsigned ones to [0, 1].
        let (value, largest) = match self.component {
            ComponentType::I8 => (f32::from(bytes[0] as i8), 127.0),
            ComponentType::U8 => (f32::from(bytes[0]), 255.0),
            ComponentType::I16 => (
                f32::from(i16::from_le_bytes([bytes[0], bytes[1]])),
                32_767.0,
            ),
            ComponentType::U16 => (
                f32::from(u16::from_le_bytes([bytes[0], bytes[1]])),
                65_535.0,
            ),
            ComponentType::U32 => (four(bytes, u32::from_le_bytes) as f32, u32::MAX as f32),
            ComponentType::F32 => return four(bytes, f32::from_le_bytes),
        };
        if self.normalized {
            (value / largest).max(-1.0)
        } else {
            value
        }
    }

    fn index(&self, element: usize) -> u32 {
        let bytes = &self.data[element * self.stride..];
        match self.component {
            ComponentType::U8 | ComponentType::I8 => u32::from(bytes[0]),
            ComponentType::U16 | ComponentType::I16 => {
                u32::from(u16::from_le_bytes([bytes[0], bytes[1]]))
            }
            ComponentType::U32 | ComponentType::F32 => four(bytes, u32::from_le_bytes),
        }
    }
}

fn four<T>(bytes: &[u8], read: fn([u8; 4]) -> T) -> T {
    read([bytes[0], bytes[1], bytes[2], bytes[3]])
}

fn size_of_component(component: ComponentType) -> usize {
    match component {
        ComponentType::I8 | ComponentType::U8 => 1,
        ComponentType::I16 | ComponentType::U16 => 2,
        ComponentType::U32 | ComponentType::F32 => 4,
    }
}

fn width(kind: Type) -> usize {
    match kind {
        Type::Scalar => 1,
        Type::Vec2 => 2,
        Type::Vec3 => 3,
        Type::Vec4 | Type::Mat2 => 4,
        Type::Mat3 => 9,
        Type::Mat4 => 16,
    }
}

fn name(kind: Type) -> &'static str {
    match kind {
        Type::Scalar => "SCALAR",
        Type::Vec2 => "VEC2",
        Type::Vec3 => "VEC3",
        Type::Vec4 => "VEC4",
        Type::Mat2 => "MAT2",
        Type::Mat3 => "MAT3",
        Type::Mat4 => "MAT4",
    }
}

impl Document<'_> {
    /// Number of elements and of components each.
    pub fn shape(&self, index: usize) -> Checked<(usize, usize)> {
        let (accessor, kind, _) = self.typed(index)?;
        Ok((accessor.count.0 as usize, width(kind)))
    }

    /// Vectors of exactly `N` components; integers are normalised where the file says so.
    pub fn floats<const N: usize>(&self, index: usize, use_: &str) -> Checked<Vec<[f32; N]>> {
        let (accessor, kind, component) = self.typed(index)?;
        let place = format!("accessors[{index}]");
        if width(kind) != N || matches!(kind, Type::Mat2) {
            return Err(Fault::new(
                place,
                format!(
                    "is {} and cannot be {use_}, which has {N} components",
                    name(kind)
                ),
            ));
        }
        self.budget
            .charge(accessor.count.0.saturating_mul(4 * N as u64), &place)?;
        let count = accessor.count.0 as usize;
        let mut out = match self.elements(index, accessor, component, N)? {
            Some(elements) => (0..count)
                .map(|e| std::array::from_fn(|i| elements.float(e, i)))
                .collect(),
            None => vec![[0.0; N]; count],
        };
        if let Some(sparse) = &accessor.sparse {
            let (targets, values) =
                self.sparse(index, sparse, component, accessor.normalized, N)?;
            for (e, &target) in targets.iter().enumerate() {
                let slot = out
                    .get_mut(target as usize)
                    .ok_or_else(|| outside(&place, target, count))?;
                *slot = std::array::from_fn(|i| values.float(e, i));
            }
        }
        Ok(out)
    }

    /// Vertex indices, all below `vertices`.
    pub fn indices(&self, index: usize, vertices: usize) -> Checked<Vec<u32>> {
        let (accessor, kind, component) = self.typed(index)?;
        let place = format!("accessors[{index}]");
        let integer = matches!(
            component,
            ComponentType::U8 | ComponentType::U16 | ComponentType::U32
        );
        if kind != Type::Scalar || !integer {
            let problem = format!(
                "holds {} of {component:?} and cannot be vertex indices",
                name(kind)
            );
            return Err(Fault::new(place, problem));
        }
        self.budget
            .charge(accessor.count.0.saturating_mul(4), &place)?;
        let count = accessor.count.0 as usize;
        let mut out: Vec<u32> = match self.elements(index, accessor, component, 1)? {
            Some(elements) => (0..count).map(|e| elements.index(e)).collect(),
            None => vec![0; count],
        };
        if let Some(sparse) = &accessor.sparse {
            let (targets, values) = self.sparse(index, sparse, component, false, 1)?;
            for (e, &target) in targets.iter().enumerate() {
                *out.get_mut(target as usize)
                    .ok_or_else(|| outside(&place, target, count))? = values.index(e);
            }
        }
        match out.iter().position(|&i| i as usize >= vertices) {
            Some(at) => {
                let problem = format!(
                    "index {at} is {}, and there are {vertices} vertices",
                    out[at]
                );
                Err(Fault::new(place, problem))
            }
            None => Ok(out),
        }
    }

    fn typed(&self, index: usize) -> Checked<(&Accessor, Type, ComponentType)> {
        let place = || format!("accessors[{index}]");
        let accessor = self
            .root
            .accessors
            .get(index)
            .ok_or_else(|| Fault::new(place(), "does not exist"))?;
        match (accessor.type_, accessor.component_type) {
            (Valid::Valid(kind), Valid::Valid(component)) => Ok((accessor, kind, component.0)),
            _ => Err(Fault::new(place(), "has a type that glTF does not know")),
        }
    }

    /// The accessor's dense part, checked to lie inside of its buffer view.
    fn elements(
        &self,
        index: usize,
        accessor: &Accessor,
        component: ComponentType,
        width: usize,
    ) -> Checked<Option<Elements<'_>>> {
        let Some(view) = accessor.buffer_view else {
            return Ok(None);
        };
        let stride = self
            .root
            .buffer_views
            .get(view.value())
            .and_then(|view| view.byte_stride)
            .map(|s| s.0);
        let offset = accessor.byte_offset.map_or(0, |offset| offset.0);
        let window = Window {
            view: view.value(),
            offset,
            stride,
            count: accessor.count.0,
            width,
        };
        self.window(
            &format!("accessors[{index}]"),
            window,
            component,
            accessor.normalized,
        )
        .map(Some)
    }

    fn sparse(
        &self,
        index: usize,
        sparse: &Sparse,
        component: ComponentType,
        normalized: bool,
        width: usize,
    ) -> Checked<(Vec<u32>, Elements<'_>)> {
        let place = format!("accessors[{index}].sparse");
        let Valid::Valid(kind) = sparse.indices.component_type else {
            return Err(Fault::new(
                place,
                "has indices of a type that glTF does not know",
            ));
        };
        let count = sparse.count.0;
        let (view, offset) = (
            sparse.indices.buffer_view.value(),
            sparse.indices.byte_offset.0,
        );
        let window = Window {
            view,
            offset,
            stride: None,
            count,
            width: 1,
        };
        let targets = self.window(&place, window, kind.0, false)?;
        let (view, offset) = (
            sparse.values.buffer_view.value(),
            sparse.values.byte_offset.0,
        );
        let window = Window {
            view,
            offset,
            stride: None,
            count,
            width,
        };
        let values = self.window(&place, window, component, normalized)?;
        self.budget.charge(count.saturating_mul(4), &place)?;
        Ok((
            (0..count as usize).map(|e| targets.index(e)).collect(),
            values,
        ))
    }

    fn window(
        &self,
        place: &str,
        window: Window,
        component: ComponentType,
        normalized: bool,
    ) -> Checked<Elements<'_>> {
        let data = self.view(window.view, place)?;
        let element = window.width * size_of_component(component);
        let stride = window.stride.unwrap_or(element);
        let span = window
            .count
            .saturating_sub(1)
            .checked_mul(stride as u64)
            .and_then(|gap| {
                let last = if window.count == 0 { 0 } else { element as u64 };
                window.offset.checked_add(gap)?.checked_add(last)
            });
        if span.is_none_or(|span| span > data.len() as u64) {
            let (count, size, view) = (window.count, data.len(), window.view);
            let problem = format!(
                "{count} elements of {element} bytes reach beyond the {size} bytes of buffer view {view}"
            );
            return Err(Fault::new(place, problem));
        }
        Ok(Elements {
            data: &data[window.offset as usize..],
            stride,
            component,
            normalized,
        })
    }
}

/// A regular run of elements in a buffer view.
struct Window {
    view: usize,
    offset: u64,
    stride: Option<usize>,
    count: u64,
    width: usize,
}

fn outside(place: &str, target: u32, count: usize) -> Fault {
    Fault::new(
        place,
        format!("its sparse part replaces element {target} of {count}"),
    )
}
