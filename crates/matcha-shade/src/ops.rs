//! The operations: one table, from which everything else about an operation derives:
//! its code, name and documentation, the constant folder's and the machine's kernels,
//! the disassembly, the tests, and (by a translator that reads the same entries) WGSL.
//!
//! # Adding an operation
//!
//! Write its device function (`device/*.rs`, in the subset described there) and one
//! entry in the family's file under `ops/`:
//!
//! ```text
//! /// What it computes, for which arguments; the source of the definition.
//! math_multiply_add(a: F1, b: F1, c: F1) -> F1 {
//!     cost: 0.2,            // ns a point in lanes, for the cost model
//!     error: 1e-7,          // largest |f32 − exact| / max(1, |exact|) in the domain
//!     domain: [-8.0, 8.0],  // optional: where every operand lies in tests
//!     eval: arithmetic::multiply_add,
//! }
//! ```
//!
//! Types of operands: `F1` (f32), `F2` (`Vec2`), `F3` (`Vec3`), `F4` (`[f32; 4]`), with
//! 12 components at most in all, and last, if at all, `U32`: the word's immediate.
//! Result: one of `F1`, `F2`, `F3`, `F4`, or `Color`, `Normal` (`Vec3`), `Gradient` (`Vec2`),
//! which also tell the cache what the value means. A function must be total: any
//! operand, not-a-number too, gives some value, without panic and in bounded time.
//!
//! A function with a loop of its own does not vectorise. Split it:
//!
//! ```text
//! noise_fbm_3d(p: F3, detail: F1) -> F1 {
//!     cost: 30.0,
//!     error: 1e-5,
//!     loop: {
//!         count: noise::fbm_3d_count,    // fn(args..) -> u32, bounded
//!         init: noise::fbm_3d_init,      // fn(args..) -> [f32; STATE]
//!         step: noise::fbm_3d_step,      // fn(i: u32, args.., [f32; STATE]) -> [f32; STATE]
//!         finish: noise::fbm_3d_finish,  // fn(args.., [f32; STATE]) -> result
//!         state: 3,
//!     },
//! }
//! ```
//!
//! The lane kernel runs `step` as often as its longest lane asks and keeps the state
//! of the lanes that are done. Device functions of the table must be `#[inline(always)]`.
//!
//! A new family is a new file and its name in the list of `families!` below.

use crate::closure::Ty;
use crate::graph::Encoding;
use crate::vm::kernel::KernelSet;

/// Index of an operation in the table.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct OpCode(pub u16);

impl OpCode {
    /// The table's entry.
    pub fn info(self) -> &'static OpInfo {
        TABLE[self.0 as usize]
    }

    /// Finds an operation by name.
    pub fn by_name(name: &str) -> Option<OpCode> {
        all().find(|op| op.info().name == name)
    }
}

impl std::fmt::Debug for OpCode {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(self.info().name)
    }
}

/// Every operation.
pub fn all() -> impl Iterator<Item = OpCode> {
    (0..TABLE.len() as u16).map(OpCode)
}

/// An operand of an operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Operand {
    /// Its name.
    pub name: &'static str,
    /// Its type; `F1` for the immediate too.
    pub ty: Ty,
    /// True for `U32`: the word's immediate, which takes no row.
    pub immediate: bool,
}

/// An entry of the table.
#[derive(Debug)]
pub struct OpInfo {
    /// Unique, snake case.
    pub name: &'static str,
    /// The file of the table that it is in.
    pub family: &'static str,
    /// What it computes, with its source.
    pub doc: &'static str,
    /// Operands in order, the immediate last.
    pub arguments: &'static [Operand],
    /// Type of the result.
    pub result: Ty,
    /// What the result means, where the table knows.
    pub encoding: Option<Encoding>,
    /// Estimated cost, ns a point in lanes.
    pub cost: f32,
    /// Largest |f32 − exact| / max(1, |exact|) inside the domain.
    pub error: f32,
    /// Where every operand's components lie in tests.
    pub domain: [f32; 2],
    /// The device functions, by path.
    pub functions: &'static [&'static str],
    /// The machine's code for it.
    pub kernels: KernelSet,
}

impl OpInfo {
    /// The operands that take rows.
    pub fn operands(&self) -> impl Iterator<Item = &'static Operand> + use<> {
        self.arguments.iter().filter(|a| !a.immediate)
    }

    /// Rows of all operands.
    pub fn operand_rows(&self) -> usize {
        self.operands().map(|a| a.ty.width()).sum()
    }
}

/// Types that an entry may name, and how they lie in rows. The markers are types of
/// the table's language only.
pub mod types {
    use super::{Encoding, Ty};
    use glam::{Vec2, Vec3};

    /// A type of the table.
    pub trait TableType {
        /// Type in the graph.
        const TY: Ty;
        /// What a result of it means.
        const ENCODING: Option<Encoding> = None;
        /// Rows of a result.
        const WIDTH: usize = Self::TY.width();
        /// True for the immediate.
        const IMMEDIATE: bool = false;
        /// Type in device code.
        type Value: Copy;
        /// An operand: its rows, or the immediate.
        type Rows<'a, const N: usize>: Copy;
        /// Takes the operand's rows off the front of `rows`.
        fn rows<'a, const N: usize>(
            rows: [&'a [f32; N]; 12],
            at: &mut usize,
            aux: u32,
        ) -> Self::Rows<'a, N>;
        /// A lane's value.
        fn get<const N: usize>(rows: Self::Rows<'_, N>, lane: usize) -> Self::Value;
        /// Stores a lane's value into the first `WIDTH` rows.
        fn put<const N: usize, const W: usize>(
            value: Self::Value,
            rows: &mut [[f32; N]; W],
            lane: usize,
        );
    }

    macro_rules! table_type {
        ($name:ident, $ty:ident, $value:ty, $width:literal, $encoding:expr, $doc:literal,
         |$r:ident, $l:ident| $get:expr, |$v:ident| $parts:expr) => {
            #[doc = $doc]
            #[derive(Clone, Copy, Debug)]
            pub struct $name;
            impl TableType for $name {
                const TY: Ty = Ty::$ty;
                const ENCODING: Option<Encoding> = $encoding;
                type Value = $value;
                type Rows<'a, const N: usize> = [&'a [f32; N]; $width];
                #[inline(always)]
                fn rows<'a, const N: usize>(
                    rows: [&'a [f32; N]; 12],
                    at: &mut usize,
                    _aux: u32,
                ) -> Self::Rows<'a, N> {
                    let first = *at;
                    *at += $width;
                    core::array::from_fn(|i| rows[first + i])
                }
                #[inline(always)]
                fn get<const N: usize>($r: Self::Rows<'_, N>, $l: usize) -> $value {
                    $get
                }
                #[inline(always)]
                fn put<const N: usize, const W: usize>(
                    $v: $value,
                    rows: &mut [[f32; N]; W],
                    lane: usize,
                ) {
                    let parts: [f32; $width] = $parts;
                    for i in 0..$width {
                        rows[i][lane] = parts[i];
                    }
                }
            }
        };
    }

    table_type!(F1, F1, f32, 1, None, "A number.", |r, l| r[0][l], |v| [v]);
    table_type!(
        F2,
        F2,
        Vec2,
        2,
        None,
        "A pair.",
        |r, l| Vec2::new(r[0][l], r[1][l]),
        |v| [v.x, v.y]
    );
    table_type!(
        F3,
        F3,
        Vec3,
        3,
        None,
        "Three numbers.",
        |r, l| Vec3::new(r[0][l], r[1][l], r[2][l]),
        |v| [v.x, v.y, v.z]
    );
    table_type!(
        F4,
        F4,
        [f32; 4],
        4,
        None,
        "Four numbers.",
        |r, l| [r[0][l], r[1][l], r[2][l], r[3][l]],
        |v| v
    );
    table_type!(
        Color,
        F3,
        Vec3,
        3,
        Some(Encoding::Color),
        "A linear colour.",
        |r, l| Vec3::new(r[0][l], r[1][l], r[2][l]),
        |v| [v.x, v.y, v.z]
    );
    table_type!(
        Normal,
        F3,
        Vec3,
        3,
        Some(Encoding::Normal),
        "A unit vector.",
        |r, l| Vec3::new(r[0][l], r[1][l], r[2][l]),
        |v| [v.x, v.y, v.z]
    );
    table_type!(
        Gradient,
        F2,
        Vec2,
        2,
        Some(Encoding::Gradient),
        "A height's change with u and v.",
        |r, l| Vec2::new(r[0][l], r[1][l]),
        |v| [v.x, v.y]
    );

    /// The word's immediate.
    #[derive(Clone, Copy, Debug)]
    pub struct U32;
    impl TableType for U32 {
        const TY: Ty = Ty::F1;
        const IMMEDIATE: bool = true;
        type Value = u32;
        type Rows<'a, const N: usize> = u32;
        #[inline(always)]
        fn rows<const N: usize>(_rows: [&[f32; N]; 12], _at: &mut usize, aux: u32) -> u32 {
            aux
        }
        #[inline(always)]
        fn get<const N: usize>(rows: u32, _lane: usize) -> u32 {
            rows
        }
        #[inline(always)]
        fn put<const N: usize, const W: usize>(_: u32, _: &mut [[f32; N]; W], _: usize) {}
    }
}

/// The table's entries of one family. See the module's documentation for the form.
macro_rules! operations {
    (
        family $family:ident;
        $($(#[doc = $doc:literal])+ $name:ident $arguments:tt -> $result:ident $body:tt)*
    ) => {
        #[allow(non_camel_case_types, clippy::upper_case_acronyms)]
        enum Position { $($name),* }

        /// Number of operations in the family.
        pub(super) const COUNT: usize = [$(stringify!($name)),*].len();

        impl crate::ops::OpCode {
            $(
                $(#[doc = $doc])+
                #[allow(non_upper_case_globals)]
                pub const $name: crate::ops::OpCode = crate::ops::OpCode(
                    (crate::ops::first_of(crate::ops::Family::$family as usize)
                        + Position::$name as usize) as u16,
                );
            )*
        }

        /// The family's entries.
        pub(super) static ENTRIES: [crate::ops::OpInfo; COUNT] = [
            $(crate::ops::entry! {
                $family $name concat!($($doc, "\n"),+); $arguments $result $body
            }),*
        ];

        $(crate::ops::kernel! { $name $arguments $result $body })*
    };
}

/// An entry as a value.
macro_rules! entry {
    (
        $family:ident $name:ident $doc:expr; $arguments:tt $result:ident {
            cost: $cost:expr, error: $error:expr, domain: $domain:expr,
            $form:ident : $body:tt $(:: $rest:ident)* $(,)?
        }
    ) => {
        crate::ops::entry!(@entry
            $family $name $doc; $arguments $result $cost, $error, $domain,
            $form $body $(:: $rest)*)
    };
    (
        $family:ident $name:ident $doc:expr; $arguments:tt $result:ident {
            cost: $cost:expr, error: $error:expr,
            $form:ident : $body:tt $(:: $rest:ident)* $(,)?
        }
    ) => {
        crate::ops::entry!(@entry
            $family $name $doc; $arguments $result $cost, $error, [-4.0, 4.0],
            $form $body $(:: $rest)*)
    };
    (@entry
        $family:ident $name:ident $doc:expr; ($($arg:ident : $ty:ident),* $(,)?) $result:ident
        $cost:expr, $error:expr, $domain:expr, $form:ident $body:tt $(:: $rest:ident)*
    ) => {
        crate::ops::OpInfo {
            name: stringify!($name),
            family: stringify!($family),
            doc: $doc,
            arguments: &[$(crate::ops::Operand {
                name: stringify!($arg),
                ty: <crate::ops::types::$ty as crate::ops::types::TableType>::TY,
                immediate: <crate::ops::types::$ty as crate::ops::types::TableType>::IMMEDIATE,
            }),*],
            result: <crate::ops::types::$result as crate::ops::types::TableType>::TY,
            encoding: <crate::ops::types::$result as crate::ops::types::TableType>::ENCODING,
            cost: $cost,
            error: $error,
            domain: $domain,
            functions: crate::ops::entry!(@functions $form $body $(:: $rest)*),
            kernels: crate::vm::kernel::KernelSet::of::<$name>(),
        }
    };
    (@functions eval $eval:path) => { &[stringify!($eval)] };
    (@functions loop {
        count: $count:path, init: $init:path, step: $step:path, finish: $finish:path,
        state: $state:literal $(,)?
    }) => { &[stringify!($count), stringify!($init), stringify!($step), stringify!($finish)] };
}

/// An entry's kernel over `N` lanes.
macro_rules! kernel {
    (
        $name:ident ($($arg:ident : $ty:ident),* $(,)?) $result:ident {
            cost: $cost:expr, error: $error:expr, $(domain: $domain:expr,)?
            eval: $eval:path $(,)?
        }
    ) => {
        #[allow(non_camel_case_types)]
        struct $name;
        impl crate::vm::kernel::LaneOp for $name {
            #[inline(always)]
            unsafe fn run<const N: usize>(
                frame: crate::vm::kernel::Frame,
                word: &crate::program::Word,
            ) {
                use crate::ops::types::{self, TableType};
                // SAFETY: the caller promises that the word's operands are in the frame.
                let rows = unsafe { frame.operands::<N>(word) };
                let mut at = 0;
                $(let $arg = <types::$ty as TableType>::rows::<N>(rows, &mut at, word.aux);)*
                let _ = at;
                let mut out = [[0.0f32; N]; <types::$result as TableType>::WIDTH];
                for lane in 0..N {
                    let value = $eval($(<types::$ty as TableType>::get::<N>($arg, lane)),*);
                    <types::$result as TableType>::put(value, &mut out, lane);
                }
                // SAFETY: as above, for the destination.
                unsafe { frame.store(word, &out) }
            }
        }
    };
    (
        $name:ident ($($arg:ident : $ty:ident),* $(,)?) $result:ident {
            cost: $cost:expr, error: $error:expr, $(domain: $domain:expr,)?
            loop: {
                count: $count:path, init: $init:path, step: $step:path, finish: $finish:path,
                state: $state:literal $(,)?
            } $(,)?
        }
    ) => {
        #[allow(non_camel_case_types)]
        struct $name;
        impl crate::vm::kernel::LaneOp for $name {
            #[inline(always)]
            unsafe fn run<const N: usize>(
                frame: crate::vm::kernel::Frame,
                word: &crate::program::Word,
            ) {
                use crate::ops::types::{self, TableType};
                // SAFETY: the caller promises that the word's operands are in the frame.
                let rows = unsafe { frame.operands::<N>(word) };
                let mut at = 0;
                $(let $arg = <types::$ty as TableType>::rows::<N>(rows, &mut at, word.aux);)*
                let _ = at;
                let mut counts = [0u32; N];
                let mut state = [[0.0f32; N]; $state];
                for lane in 0..N {
                    counts[lane] = $count($(<types::$ty as TableType>::get::<N>($arg, lane)),*);
                    let first: [f32; $state] =
                        $init($(<types::$ty as TableType>::get::<N>($arg, lane)),*);
                    for k in 0..$state {
                        state[k][lane] = first[k];
                    }
                }
                let longest = counts.iter().fold(0, |a, &b| if b > a { b } else { a });
                let mut i = 0u32;
                while i < longest {
                    for lane in 0..N {
                        let old: [f32; $state] = core::array::from_fn(|k| state[k][lane]);
                        let new: [f32; $state] = $step(
                            i,
                            $(<types::$ty as TableType>::get::<N>($arg, lane),)*
                            old,
                        );
                        // A plain `if` between two numbers that are there: with the hint
                        // `select_unpredictable` SSE2 is not vectorised.
                        let goes_on = i < counts[lane];
                        for k in 0..$state {
                            state[k][lane] = if goes_on { new[k] } else { old[k] };
                        }
                    }
                    i += 1;
                }
                let mut out = [[0.0f32; N]; <types::$result as TableType>::WIDTH];
                for lane in 0..N {
                    let last: [f32; $state] = core::array::from_fn(|k| state[k][lane]);
                    let value =
                        $finish($(<types::$ty as TableType>::get::<N>($arg, lane),)* last);
                    <types::$result as TableType>::put(value, &mut out, lane);
                }
                // SAFETY: as above, for the destination.
                unsafe { frame.store(word, &out) }
            }
        }
    };
}

pub(crate) use {entry, kernel};

/// Collects the families' entries into one table.
macro_rules! families {
    ($($family:ident),* $(,)?) => {
        $(pub(crate) mod $family;)*

        #[allow(non_camel_case_types)]
        pub(crate) enum Family { $($family),* }

        const SIZES: &[usize] = &[$($family::COUNT),*];

        /// The whole table; an [`OpCode`] is an index into it.
        static TABLE: [&OpInfo; first_of(SIZES.len())] = {
            let families: &[&'static [OpInfo]] = &[$(&$family::ENTRIES),*];
            let mut table = [&families[0][0]; first_of(SIZES.len())];
            let mut at = 0;
            let mut f = 0;
            while f < families.len() {
                let mut i = 0;
                while i < families[f].len() {
                    table[at] = &families[f][i];
                    at += 1;
                    i += 1;
                }
                f += 1;
            }
            table
        };
    };
}

families! { arithmetic, number, direction, tint, noise, cellular, texture, surface }

/// Index of a family's first operation.
pub(crate) const fn first_of(family: usize) -> usize {
    let mut sum = 0;
    let mut f = 0;
    while f < family {
        sum += SIZES[f];
        f += 1;
    }
    sum
}
