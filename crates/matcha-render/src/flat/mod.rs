//! A prepared scene in a few plain arrays, for devices with a memory of their own.
//!
//! [`FlatGeometry`] and [`FlatTextures`] own what `device::geometry_view` and
//! `device::texture_view` read. [`FlatGeometry::sections`] names the arrays as translated device
//! code asks for their words: the view's name, then the field's.

mod blocks;
mod geometry;
mod layers;
mod programs;
mod scene;
#[cfg(test)]
mod tests;
mod texture;

pub use blocks::BLOCK_ERROR;
pub use geometry::FlatGeometry;
pub use programs::FlatPrograms;
pub use scene::{FlatScene, NO_PROGRAM};
pub use texture::FlatTextures;

/// Words of a view's field: its name in translated device code, and what is in it.
pub struct Section<'a> {
    /// `VIEW_field`.
    pub name: &'static str,
    /// The words.
    pub words: &'a [u32],
    /// A few words that are the same for all: the field is no array.
    pub is_plain: bool,
}

/// Sections of a view's fields, arrays before the semicolon.
macro_rules! sections {
    ($self:ident, $view:ident: $($array:ident)*; $($plain:ident)*) => {
        vec![
            $($crate::flat::Section {
                name: concat!(stringify!($view), "_", stringify!($array)),
                words: bytemuck::cast_slice(&$self.$array),
                is_plain: false,
            },)*
            $($crate::flat::Section {
                name: concat!(stringify!($view), "_", stringify!($plain)),
                words: bytemuck::cast_slice(std::slice::from_ref(&$self.$plain)),
                is_plain: true,
            },)*
        ]
    };
}
use sections;
