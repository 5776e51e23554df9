//! Reads of views.

use super::Emitter;
use crate::ir::WordAddress;
use crate::types::Ty;
use crate::view::{read_function, word_function};

impl Emitter<'_> {
    /// A value in a view's field.
    pub(super) fn stored(
        &mut self,
        view: &str,
        field: &str,
        address: &WordAddress,
        ty: &Ty,
    ) -> String {
        let address = self.address(address);
        let word = || format!("{}({address})", word_function(view, field));
        match ty {
            Ty::U32 => word(),
            Ty::F32 | Ty::I32 => format!("bitcast<{}>({})", ty.wgsl(), word()),
            _ => format!("{}({address})", read_function(view, field, ty)),
        }
    }

    fn address(&mut self, address: &WordAddress) -> String {
        if let ([(index, 1)], 0) = (&address.terms[..], address.offset) {
            let index = self.without_cast(index);
            return self.expression(index);
        }
        let mut terms = Vec::new();
        for (index, words) in &address.terms {
            let index = self.without_cast(index);
            let text = self.operand(index);
            terms.push(match words {
                1 => text,
                _ => format!("{text} * {words}u"),
            });
        }
        if address.offset > 0 || terms.is_empty() {
            terms.push(format!("{}u", address.offset));
        }
        terms.join(" + ")
    }
}
