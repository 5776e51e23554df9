//! The table about itself.

use matcha_shade::ops;
use std::collections::HashSet;

#[test]
fn names_are_unique_and_found_again() {
    let mut seen = HashSet::new();
    for op in ops::all() {
        let name = op.info().name;
        assert!(seen.insert(name), "{name} twice");
        assert_eq!(ops::OpCode::by_name(name), Some(op));
    }
}

#[test]
fn every_entry_is_documented_and_bounded() {
    for op in ops::all() {
        let info = op.info();
        assert!(info.doc.trim().len() > 10, "{} says too little", info.name);
        assert!(
            info.cost > 0.0 && info.cost.is_finite(),
            "{} costs nothing",
            info.name
        );
        assert!(
            info.error >= 0.0 && info.error < 0.1,
            "{} bounds no error",
            info.name
        );
        assert!(
            info.domain[0] < info.domain[1],
            "{} has no domain",
            info.name
        );
        assert!(!info.functions.is_empty());
    }
}

#[test]
fn operands_fit_a_word() {
    for op in ops::all() {
        let info = op.info();
        assert!(
            info.operand_rows() <= 12,
            "{} has {} rows",
            info.name,
            info.operand_rows()
        );
        let immediates = info.arguments.iter().filter(|a| a.immediate).count();
        let last = info.arguments.last().is_some_and(|a| a.immediate);
        assert!(
            immediates == 0 || (immediates == 1 && last),
            "{}",
            info.name
        );
    }
}

#[test]
fn function_paths_are_translatable() {
    for op in ops::all() {
        for path in op.info().functions {
            let parts: Vec<&str> = path.split("::").map(str::trim).collect();
            assert_eq!(
                parts.len(),
                2,
                "{}: {path} is not module::function",
                op.info().name
            );
        }
    }
}
