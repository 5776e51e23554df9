//! The switch over all operations.

use super::{OperandType, Operation, Operations};
use crate::diagnostic::Place;
use crate::source::Source;

/// How the host layer gives operands to the switch.
#[derive(Clone, Copy, Debug)]
pub struct DispatchForm<'a> {
    /// Name of the function.
    pub name: &'a str,
    /// Its parameters after the code, for instance `word: Word`.
    pub parameters: &'a str,
    /// Those parameters' names, for instance `word`.
    pub arguments: &'a str,
    /// The expression (f32) of an operand's row, with `{}` for its number, for instance
    /// `row(word, {}u)`.
    pub operand: &'a str,
    /// The expression (u32) of the immediate.
    pub immediate: &'a str,
}

/// Cases of one switch. Drivers make a chain of nested conditions of a switch, and Mesa's
/// CPU driver (22.3) takes wrong turns, without a word, when 80 of them are nested; and a
/// chain is walked from its start. So there are two short ones.
const CASES: usize = 16;

impl Operations {
    /// A function that runs the operation with the code `code: u32` and gives its result
    /// as `vec4f`, unused components zero. An unknown code gives zeros. Codes are found in
    /// two steps, the first of them over blocks, whose functions have the name and a number.
    pub fn dispatch(&self, form: &DispatchForm) -> Source {
        let DispatchForm {
            name,
            parameters,
            arguments,
            ..
        } = form;
        let mut source = Source::default();
        let Some(first) = self.entries.first() else {
            return source;
        };
        let mut blocks = Vec::new();
        for (number, block) in self.entries.chunks(CASES).enumerate() {
            let place = &block[0].place;
            source.push(
                &format!("fn {name}_{number}(code: u32, {parameters}) -> vec4f {{"),
                place.clone(),
            );
            source.push("    switch code {", place.clone());
            for operation in block {
                let case = case(operation, form);
                source.push(&case, operation.place.clone());
            }
            close(&mut source, place);
            let last = block[block.len() - 1].code;
            blocks.push(format!(
                "if code <= {last}u {{ return {name}_{number}(code, {arguments}); }}"
            ));
        }
        source.push(
            &format!("fn {name}(code: u32, {parameters}) -> vec4f {{"),
            first.place.clone(),
        );
        for block in &blocks {
            source.push(&format!("    {block}"), first.place.clone());
        }
        source.push("    return vec4f();", first.place.clone());
        source.push("}", first.place.clone());
        source
    }
}

impl Operations {
    /// A function for each operation that gives its result as `vec4f`, unused components zero:
    /// the form's name, `_of_` and the code; its parameters are the form's. For hosts that
    /// make a switch over some of them later.
    pub fn one_by_one(&self, form: &DispatchForm) -> Source {
        let mut source = Source::default();
        for operation in &self.entries {
            let line = format!(
                "fn {}_of_{}({}) -> vec4f {{ {} }}",
                form.name,
                operation.code,
                form.parameters,
                statements(operation, form)
            );
            source.push(&line, operation.place.clone());
        }
        source
    }
}

fn close(source: &mut Source, place: &Place) {
    source.push("        default: { return vec4f(); }", place.clone());
    source.push("    }", place.clone());
    source.push("}", place.clone());
}

fn case(operation: &Operation, form: &DispatchForm) -> String {
    let statements = statements(operation, form);
    format!("        case {}u: {{ {statements} }}", operation.code)
}

/// Statements that return an operation's result.
fn statements(operation: &Operation, form: &DispatchForm) -> String {
    let call = call(operation, form);
    match operation.result {
        OperandType::F1 => format!("return vec4f({call}, 0.0, 0.0, 0.0);"),
        OperandType::F2 => format!("return vec4f({call}, 0.0, 0.0);"),
        OperandType::F3 => format!("return vec4f({call}, 0.0);"),
        OperandType::F4 => format!("let r = {call}; return vec4f(r[0], r[1], r[2], r[3]);"),
        OperandType::Immediate => "return vec4f();".to_owned(),
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
