//! Definitions before their uses.

use std::collections::{BTreeSet, HashMap};

/// Orders items, given each one's name and needs, so that whatever an item needs comes
/// before it; otherwise as they were. The error is the index of an item that needs itself.
pub(crate) fn ordered(items: &[(&str, &BTreeSet<String>)]) -> Result<Vec<usize>, usize> {
    let index: HashMap<&str, usize> = items
        .iter()
        .enumerate()
        .map(|(i, (n, _))| (*n, i))
        .collect();
    let mut marks = vec![Mark::New; items.len()];
    let mut order = Vec::with_capacity(items.len());
    for item in 0..items.len() {
        visit(item, items, &index, &mut marks, &mut order)?;
    }
    Ok(order)
}

#[derive(Clone, Copy, PartialEq)]
enum Mark {
    New,
    Open,
    Done,
}

fn visit(
    item: usize,
    items: &[(&str, &BTreeSet<String>)],
    index: &HashMap<&str, usize>,
    marks: &mut [Mark],
    order: &mut Vec<usize>,
) -> Result<(), usize> {
    match marks[item] {
        Mark::Done => return Ok(()),
        Mark::Open => return Err(item),
        Mark::New => marks[item] = Mark::Open,
    }
    for need in items[item].1 {
        if let Some(&other) = index.get(need.as_str()) {
            visit(other, items, index, marks, order)?;
        }
    }
    marks[item] = Mark::Done;
    order.push(item);
    Ok(())
}
