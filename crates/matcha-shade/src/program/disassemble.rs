//! Programs as text: a word a line, regions indented.

use crate::program::verify::shape;
use crate::program::{CONSTANT, Program, Word, special};
use std::fmt;

impl fmt::Display for Program {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(
            f,
            "program {:?}: {} slots, {:.1} ns",
            self.name, self.slots, self.cost
        )?;
        for &(input, row) in &self.inputs {
            let name = format!("{:?}.{:?}", input.kind, input.part);
            writeln!(f, "  {} = {name}", registers(row, input.kind.width()))?;
        }
        let mut region = None;
        for (index, word) in self.words.iter().enumerate() {
            if word.op == special::STORE {
                region = None;
            }
            let indent = if region.is_some() { "  " } else { "" };
            writeln!(f, "{index:4} {indent}{}", self.line(word))?;
            if word.op == special::LOOKUP {
                region = Some(word.aux);
            }
        }
        for closure in &self.closures {
            writeln!(f, "  {:?}", closure.kind)?;
            let row = closure.first_row;
            writeln!(
                f,
                "    weight = {}",
                self.operands(&self.outputs[row..row + 3])
            )?;
            let mut row = row + 3;
            for parameter in closure.kind.parameters() {
                let operands = &self.outputs[row..row + parameter.ty.width()];
                writeln!(f, "    {} = {}", parameter.name, self.operands(operands))?;
                row += parameter.ty.width();
            }
        }
        Ok(())
    }
}

impl Program {
    fn line(&self, word: &Word) -> String {
        let (operands, results) = shape(self, word).unwrap_or((0, 0));
        let dst = registers(word.dst as usize, results);
        let src = self.operands(&word.src[..operands]);
        match word.op {
            special::LOOKUP => {
                let region = &self.regions[word.aux as usize];
                let values = region.values.iter().map(|value| {
                    let result = registers(value.result as usize, value.ty.width());
                    format!("{result} {:?}", value.encoding)
                });
                let values: Vec<String> = values.collect();
                format!(
                    "{} = lookup uv{} else {dst}; found: {}",
                    values.join(", "),
                    region.uv_set,
                    region.words.end
                )
            }
            special::STORE => format!("{dst} = store {src}"),
            special::TEXTURE => {
                let texture = self.textures[word.aux as usize];
                format!(
                    "{dst} = image{} {:?} {:?} {src}",
                    texture.image, texture.interpolation, texture.extension
                )
            }
            special::TABLE => format!("{dst} = table{} {src}", word.aux),
            _ => {
                let info = word.operation().map(|op| op.info());
                let name = info.map_or("?", |i| i.name);
                let immediate = match info {
                    Some(i) if i.arguments.iter().any(|a| a.immediate) => {
                        format!(" {:#x}", word.aux)
                    }
                    _ => String::new(),
                };
                format!("{dst} = {name}{immediate} {src}")
            }
        }
    }

    fn operands(&self, operands: &[u16]) -> String {
        let one = |&operand: &u16| match operand & CONSTANT {
            0 => format!("r{operand}"),
            _ => format!("{:?}", self.constants[(operand & !CONSTANT) as usize]),
        };
        operands.iter().map(one).collect::<Vec<_>>().join(" ")
    }
}

/// A value's registers: `r4`, `r4..6` (both ends).
fn registers(first: usize, width: usize) -> String {
    match width {
        0 | 1 => format!("r{first}"),
        _ => format!("r{first}..{}", first + width - 1),
    }
}
