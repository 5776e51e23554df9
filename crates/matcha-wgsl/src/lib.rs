//! Device code into WGSL, when the project is built.
//!
//! Operations, noises, hashes, encodings, closures and light sampling are written once,
//! in a subset of Rust (`docs/adr/0002-device-code.md` has its rules). The CPU runs them
//! as they are. This crate reads the same files with `syn` and writes them as WGSL:
//!
//! * [`translate`] turns modules of device functions into one [`Source`].
//! * [`Translation::views`] is what functions read of buffers; host layers answer with a
//!   function for each field ([`View`] has their names), and [`Translation::stand_ins`] does
//!   while there is no host yet.
//! * [`Translation::columns`] stores structs and loads them again, word by word.
//! * [`operations`] reads the table of operations and adds a function for each, loops
//!   included, and [`Operations::dispatch`] the switch over them.
//! * [`check`] has naga validate the whole, host layers too.
//!
//! Every line of a [`Source`] knows the line of Rust that it came from, so that whatever
//! is wrong, a construct outside of the subset or an error of naga's, is reported as
//! `file.rs:line: what`.
//!
//! # What is promised of a translation
//!
//! A function computes what its Rust does, operation by operation and in that order. WGSL
//! lets a device deviate: fuse a product and a sum, reassociate (Mesa makes `(a + b) - a`
//! into `b`), be off by 2.5 units in the last place of quotients and square roots, take −0
//! for 0 and numbers below 10⁻³⁸ for zero, and assume that nothing is infinite or not a
//! number. Whole numbers and bits are the same everywhere. Nothing is replaced by a builtin
//! that computes something else.

mod assemble;
mod check;
mod collect;
mod columns;
mod constant;
mod diagnostic;
mod emit;
mod ir;
mod layout;
mod lower;
mod names;
mod operations;
mod order;
mod prelude;
mod source;
mod translation;
mod types;
mod view;

pub use check::check;
pub use columns::Columns;
pub use constant::Value;
pub use diagnostic::{Diagnostic, Place, Problem, TranslateError};
pub use layout::{Layout, LayoutField};
pub use operations::{DispatchForm, OperandType, Operation, Operations, operations};
pub use source::Source;
pub use translation::{Function, Module, Needed, Translation, translate};
pub use types::Ty;
pub use view::{Access, FieldPlace, View, ViewField};
