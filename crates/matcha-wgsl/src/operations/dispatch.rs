//! The switch over all operations.

use super::{OperandType, Operation, Operations};
use crate::source::Source;

/// How the host layer gives operands to the switch.
#[derive(Clone, Copy, Debug)]
pub struct DispatchForm<'a> {
    /// Name of the function.
    pub name: &'a str,
    /// Its parameters after the code, for instance `word: Word`.
    pub parameters: &'a str,
    /// The expression (f32) of an operand's row, with `{}` for its number, for instance
    /// `row(word, {}u)`.
    pub operand: &'a str,
    /// The expression (u32) of the immediate.
    pub immediate: &'a str,
}

impl Operations {
    /// A function that runs the operation with the code `code: u32` and gives its result
    /// as `vec4f`, unused components zero. An unknown code gives zeros.
    pub fn dispatch(&self, form: &DispatchForm) -> Source {
        let mut source = Source::default();
        let Some(first) = self.entries.first() else {
            return source;
        };
        let head = format!(
            "fn {}(code: u32, {}) -> vec4f {{",
            form.name, form.parameters
        );
        source.push(&head, first.place.clone());
        source.push("    switch code {", first.place.clone());
        for operation in &self.entries {
            let call = call(operation, form);
            let statements = match operation.result {
                OperandType::F1 => format!("return vec4f({call}, 0.0, 0.0, 0.0);"),
                OperandType::F2 => format!("return vec4f({call}, 0.0, 0.0);"),
                OperandType::F3 => format!("return vec4f({call}, 0.0);"),
                OperandType::F4 => format!("let r = {call}; return vec4f(r[0], r[1], r[2], r[3]);"),
                OperandType::Immediate => "return vec4f();".to_owned(),
            };
            let case = format!("        case {}u: {{ {statements} }}", operation.code);
            source.push(&case, operation.place.clone());
        }
        source.push("        default: { return vec4f(); }", first.place.clone());
        source.push("    }", first.place.clone());
        source.push("}", first.place.clone());
        source
    }
}

fn call(operation: &Operation, form: &DispatchForm) -> String {
    let mut row = 0;
    let mut arguments = Vec::new();
    for ty in &operation.arguments {
        let rows = (row..row + ty.width()).map(|r| form.operand.replace("{}", &r.to_string()));
        let rows: Vec<String> = rows.collect();
        row += ty.width();
        arguments.push(match ty {
            OperandType::Immediate => form.immediate.to_owned(),
            OperandType::F1 => rows.join(""),
            _ => format!("{}({})", ty.ty().wgsl(), rows.join(", ")),
        });
    }
    format!("{}({})", operation.wgsl_name, arguments.join(", "))
}
