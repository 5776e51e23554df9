//! Node trees that can be lowered: links in range, no cycles, no group inside itself,
//! tables of the right size, finite numbers.

use crate::error::{Checked, Fault};
use matcha_shade::source::{Curves, NodeTree, Property, Ramp, SourceNode};

/// Largest number of nodes of a tree with all of its groups written out. Groups nested in
/// groups multiply: forty of them, each with two of the next, are a trillion nodes.
const MOST_NODES: u64 = 1_000_000;
/// Points of a curve's table.
const CURVE_TABLE: usize = 257;

/// Checks all trees of a file; `names` says whose each tree is (`material "Oak"`).
pub(super) fn trees(trees: &[NodeTree], images: usize, names: &[String]) -> Checked<()> {
    for (tree, name) in trees.iter().zip(names) {
        for node in &tree.nodes {
            let place = || format!("{name}, node \"{}\"", node.name);
            node_parts(node, trees.len(), images)
                .map_err(|problem| Fault::new(place(), problem))?;
        }
        links(tree).map_err(|problem| Fault::new(name.clone(), problem))?;
        if let Some(node) = node_in_cycle(tree) {
            let place = format!("{name}, node \"{}\"", tree.nodes[node].name);
            return Err(Fault::new(place, "its input depends on its own output"));
        }
    }
    nesting(trees, names)
}

fn node_parts(node: &SourceNode, trees: usize, images: usize) -> Result<(), String> {
    if node.tree.is_some_and(|tree| tree as usize >= trees) {
        return Err(format!(
            "its group, tree {}, does not exist",
            node.tree.unwrap_or(0)
        ));
    }
    if node.image.is_some_and(|image| image as usize >= images) {
        return Err(format!(
            "its image {} does not exist",
            node.image.unwrap_or(0)
        ));
    }
    let (ins, outs) = (node.inputs.len(), node.outputs.len());
    if node
        .internal_links
        .iter()
        .any(|&[from, to]| from as usize >= ins || to as usize >= outs)
    {
        return Err("an internal link has no socket at its end".into());
    }
    for socket in node.inputs.iter().chain(&node.outputs) {
        if socket.value.len() > 4 || !all_finite(&socket.value) {
            return Err(format!(
                "the value of socket \"{}\" is not 0 to 4 finite numbers",
                socket.identifier
            ));
        }
    }
    for (name, property) in &node.props {
        let finite = match property {
            Property::Number(x) => x.is_finite(),
            Property::Numbers(list) => list.iter().all(|x| x.is_finite()),
            Property::Bool(_) | Property::Text(_) => true,
        };
        if !finite {
            return Err(format!("its property {name} is not finite"));
        }
    }
    let matrices = node.texture_mapping.iter().chain(&node.object_from_world);
    if matrices.flatten().any(|x| !x.is_finite()) {
        return Err("its matrix is not finite".into());
    }
    node.ramp.as_ref().map_or(Ok(()), ramp)?;
    node.curves.as_ref().map_or(Ok(()), curves)
}

fn all_finite(values: &[f32]) -> bool {
    values.iter().all(|x| x.is_finite())
}

fn ramp(ramp: &Ramp) -> Result<(), String> {
    let size = ramp.table.len();
    if size != 0 && (size < 8 || !size.is_multiple_of(4)) {
        return Err(format!(
            "its colour ramp's table has {size} numbers instead of four for each of 2 or more samples"
        ));
    }
    if ramp.stops.is_empty() && size == 0 {
        return Err("its colour ramp has neither stops nor a table".into());
    }
    if !all_finite(&ramp.table) || !ramp.stops.iter().all(|stop| all_finite(stop)) {
        return Err("its colour ramp is not finite".into());
    }
    Ok(())
}

fn curves(curves: &Curves) -> Result<(), String> {
    if curves.tables.is_empty() || curves.tables.len() > 4 {
        return Err(format!(
            "it has {} curve tables instead of 1 to 4",
            curves.tables.len()
        ));
    }
    if let Some(table) = curves
        .tables
        .iter()
        .find(|table| table.len() != CURVE_TABLE)
    {
        return Err(format!(
            "a curve's table has {} numbers instead of {CURVE_TABLE}",
            table.len()
        ));
    }
    let [low, high] = curves.range;
    let finite = all_finite(&curves.range) && curves.tables.iter().all(|t| all_finite(t));
    if !finite || low >= high {
        return Err("its curves are not finite or cover no range".into());
    }
    Ok(())
}

fn links(tree: &NodeTree) -> Result<(), String> {
    let node = |index: u32| tree.nodes.get(index as usize);
    for (i, link) in tree.links.iter().enumerate() {
        let from = node(link.from[0]).and_then(|n| n.outputs.get(link.from[1] as usize));
        let to = node(link.to[0]).and_then(|n| n.inputs.get(link.to[1] as usize));
        if from.is_none() || to.is_none() {
            let ([a, b], [c, d]) = (link.from, link.to);
            return Err(format!(
                "link {i}, from socket {b} of node {a} to socket {d} of node {c}, has a loose end"
            ));
        }
    }
    Ok(())
}

/// A node that its own output reaches: what is left when nodes without unresolved inputs are
/// taken away one after the other (Kahn, 1962). The one named is on the cycle, not merely behind it.
fn node_in_cycle(tree: &NodeTree) -> Option<usize> {
    let count = tree.nodes.len();
    let (mut targets, mut waiting) = (vec![Vec::new(); count], vec![0_usize; count]);
    for link in &tree.links {
        targets[link.from[0] as usize].push(link.to[0] as usize);
        waiting[link.to[0] as usize] += 1;
    }
    let mut ready: Vec<usize> = (0..count).filter(|&node| waiting[node] == 0).collect();
    while let Some(node) = ready.pop() {
        for &target in &targets[node] {
            waiting[target] -= 1;
            if waiting[target] == 0 {
                ready.push(target);
            }
        }
    }
    let mut node = waiting.iter().position(|&open| open > 0)?;
    let mut source = vec![None; count];
    for link in &tree.links {
        let [from, to] = [link.from[0] as usize, link.to[0] as usize];
        if waiting[from] > 0 {
            source[to] = Some(from);
        }
    }
    // Each node that is left has a source that is left too; after `count` steps back the
    // walk is on a cycle, whatever led to it.
    for _ in 0..count {
        node = source[node]?;
    }
    Some(node)
}

/// A tree that is being walked over.
struct Frame {
    tree: usize,
    /// The next node to look at.
    next: usize,
    /// Nodes so far, with their groups written out.
    size: u64,
}

/// No tree contains itself, and none is too large when written out.
fn nesting(trees: &[NodeTree], names: &[String]) -> Checked<()> {
    let mut sizes: Vec<Option<u64>> = vec![None; trees.len()];
    let mut is_open = vec![false; trees.len()];
    for start in 0..trees.len() {
        let mut stack = vec![Frame {
            tree: start,
            next: 0,
            size: 0,
        }];
        while let Some(frame) = stack.last_mut() {
            let tree = frame.tree;
            if sizes[tree].is_some() {
                stack.pop();
                continue;
            }
            is_open[tree] = true;
            match step(frame, trees, &sizes) {
                Step::Into(group) if is_open[group] => {
                    let place = format!(
                        "{}, node \"{}\"",
                        names[tree], trees[tree].nodes[frame.next].name
                    );
                    let problem = format!("the group \"{}\" contains itself", trees[group].name);
                    return Err(Fault::new(place, problem));
                }
                Step::Into(group) => stack.push(Frame {
                    tree: group,
                    next: 0,
                    size: 0,
                }),
                Step::Done(size) if size > MOST_NODES => {
                    let problem = format!(
                        "has {size} nodes with its groups written out, more than {MOST_NODES}"
                    );
                    return Err(Fault::new(names[tree].clone(), problem));
                }
                Step::Done(size) => {
                    (sizes[tree], is_open[tree]) = (Some(size), false);
                    stack.pop();
                }
            }
        }
    }
    Ok(())
}

enum Step {
    /// A group whose size is not known yet.
    Into(usize),
    /// The tree's size.
    Done(u64),
}

/// Goes on until a group of unknown size, or to the end.
fn step(frame: &mut Frame, trees: &[NodeTree], sizes: &[Option<u64>]) -> Step {
    while let Some(node) = trees[frame.tree].nodes.get(frame.next) {
        let inner = match node
            .tree
            .map(|group| (group as usize, sizes[group as usize]))
        {
            Some((group, None)) => return Step::Into(group),
            Some((_, Some(size))) => size,
            None => 0,
        };
        frame.size = frame.size.saturating_add(1).saturating_add(inner);
        frame.next += 1;
    }
    Step::Done(frame.size)
}

#[cfg(test)]
mod tests;
