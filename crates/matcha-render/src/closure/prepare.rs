//! From a closure's rows to its lobes: device code under the names of closure kinds.

use super::tables::closure_tables;
pub use crate::device::closure_lobe::ClosureContext;
use crate::device::closure_prepare::closure_prepare;
use crate::device::closure_rows::ClosureRows;
use crate::device::closure_set::LobeSet;
use matcha_shade::closure::ClosureKind;

impl Default for ClosureContext {
    fn default() -> Self {
        Self {
            blur: 0.0,
            reflective_caustics: true,
            refractive_caustics: true,
            scatter: true,
        }
    }
}

/// Adds the lobes of one closure to `set`, which must have been begun.
///
/// `rows` are the closure's weight and parameters as `matcha_shade::closure` lays them out
/// ([`ClosureKind::rows`] numbers); fewer make no lobe. Numbers that are not finite
/// count as 0, and a normal of length 0 becomes the shading normal.
pub fn prepare_closure(
    kind: ClosureKind,
    rows: &[f32],
    context: &ClosureContext,
    set: &mut LobeSet,
) {
    if rows.len() < kind.rows() {
        return;
    }
    let rows = ClosureRows { row: rows };
    closure_prepare(super::code(kind), rows, closure_tables(), *context, set);
}
