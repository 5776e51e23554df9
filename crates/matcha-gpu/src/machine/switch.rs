//! The switch over the operations that a scene uses. The build script reads this file, too.

use std::fmt::Write;

/// Cases of one switch. Drivers make a chain of nested conditions of a switch, and Mesa's CPU
/// driver (22.3) takes wrong turns, without a word, when 80 of them are nested; and a chain is
/// walked from its start. So there are two short ones.
const CASES: usize = 16;

/// `machine_execute(op, word)`, which gives the result of the operation with a code, of those
/// in `codes` (ascending), as `vec4f`; zeros for others. `machine_of_CODE(word)` runs one.
pub fn switch(codes: &[u16]) -> String {
    let mut text = String::new();
    let mut blocks = String::new();
    for (number, block) in codes.chunks(CASES).enumerate() {
        let _ = writeln!(
            text,
            "fn machine_block_{number}(op: u32, word: u32) -> vec4f {{ switch op {{"
        );
        for code in block {
            let _ = writeln!(text, "case {code}u: {{ return machine_of_{code}(word); }}");
        }
        text.push_str("default: { return vec4f(); } } }\n");
        let last = block[block.len() - 1];
        let _ = writeln!(
            blocks,
            "if op <= {last}u {{ return machine_block_{number}(op, word); }}"
        );
    }
    let _ = writeln!(
        text,
        "fn machine_execute(op: u32, word: u32) -> vec4f {{\n{blocks}return vec4f();\n}}"
    );
    text
}

#[cfg(test)]
mod tests {
    use super::switch;

    #[test]
    fn codes_are_found_in_two_steps() {
        let codes: Vec<u16> = (0..40).map(|k| 2 * k + 1).collect();
        let text = switch(&codes);
        assert_eq!(text.matches("fn machine_block_").count(), 3);
        for code in codes {
            assert!(text.contains(&format!(
                "case {code}u: {{ return machine_of_{code}(word); }}"
            )));
        }
        assert!(text.contains("if op <= 31u { return machine_block_0(op, word); }"));
    }

    #[test]
    fn without_operations_nothing_is_found() {
        let text = switch(&[]);
        assert!(text.contains("fn machine_execute") && !text.contains("case"));
    }
}
