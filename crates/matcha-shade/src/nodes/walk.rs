//! The order of lowering: an explicit stack instead of recursion, so that a chain of any
//! length fits, and a cycle is found where it closes.

use super::error::LowerError;
use super::{At, Lowered, Lowering, Value, socket, table};
use crate::graph::Span;
use crate::source::{NodeTree, SourceNode};
use std::collections::{HashMap, HashSet};

/// Most values of one material with all of its groups written out.
const MOST_VALUES: usize = 2_000_000;

/// Handle of a [`Frame`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct FrameId(pub u32);

/// A tree in use: the material's own, or a group's once for each group node.
pub(crate) struct Frame {
    /// Index of the tree.
    pub tree: u32,
    /// The group node that it is inside of.
    pub caller: Option<At>,
}

/// A node's output socket: what is lowered in one step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Task {
    pub at: At,
    pub output: u32,
}

/// The links of a tree, by the input that they end at.
pub(crate) struct Wires {
    sources: HashMap<[u32; 2], [u32; 2]>,
    read: HashSet<[u32; 2]>,
}

impl Wires {
    fn of(tree: &NodeTree, material: &str) -> Lowered<Self> {
        let mut sources = HashMap::new();
        let mut read = HashSet::new();
        for (at, link) in tree.links.iter().enumerate() {
            let node = |index: u32| tree.nodes.get(index as usize);
            let from = node(link.from[0]).and_then(|n| n.outputs.get(link.from[1] as usize));
            let to = node(link.to[0]).and_then(|n| n.inputs.get(link.to[1] as usize));
            if from.is_none() || to.is_none() {
                return Err(LowerError::Link {
                    material: material.to_owned(),
                    tree: tree.name.clone(),
                    link: at,
                });
            }
            sources.insert(link.to, link.from);
            read.insert(link.from);
        }
        Ok(Wires { sources, read })
    }
}

impl<'a> Lowering<'a> {
    /// Lowers the whole tree.
    pub(super) fn run(&mut self, tree: u32) -> Lowered<()> {
        let frame = self.frame(tree, None)?;
        self.output(frame)
    }

    fn frame(&mut self, tree: u32, caller: Option<At>) -> Lowered<FrameId> {
        let Some(source) = self.trees.get(tree as usize) else {
            return Err(LowerError::Tree {
                material: self.material.to_owned(),
                tree,
            });
        };
        if !self.wires.contains_key(&tree) {
            self.wires.insert(tree, Wires::of(source, self.material)?);
        }
        self.frames.push(Frame { tree, caller });
        Ok(FrameId(self.frames.len() as u32 - 1))
    }

    /// The frame inside of a group node.
    fn inside(&mut self, at: At, tree: u32) -> Lowered<FrameId> {
        if let Some(&frame) = self.children.get(&at) {
            return Ok(frame);
        }
        let mut above = Some(at);
        while let Some(caller) = above {
            let frame = &self.frames[caller.frame.0 as usize];
            if frame.tree == tree {
                let name = self.trees[tree as usize].name.clone();
                return Err(LowerError::Nested(self.place(at), name));
            }
            above = frame.caller;
        }
        let frame = self.frame(tree, Some(at))?;
        self.children.insert(at, frame);
        Ok(frame)
    }

    /// The nodes of a frame's tree.
    pub(super) fn nodes_of(&self, frame: FrameId) -> &'a [SourceNode] {
        &self.trees[self.frames[frame.0 as usize].tree as usize].nodes
    }

    /// Where the link into an input comes from.
    pub(super) fn source_of(&self, at: At, input: u32) -> Option<Task> {
        let tree = self.frames[at.frame.0 as usize].tree;
        let [node, output] = *self.wires[&tree].sources.get(&[at.node, input])?;
        let at = At {
            frame: at.frame,
            node,
        };
        Some(Task { at, output })
    }

    /// Whether anything reads an output of a node.
    pub(super) fn is_read(&self, at: At, output: &str) -> bool {
        let outputs = &self.source(at).outputs;
        let Some(index) = outputs.iter().position(|o| o.identifier == output) else {
            return false;
        };
        let tree = self.frames[at.frame.0 as usize].tree;
        let from = [at.node, index as u32];
        self.wires[&tree].read.contains(&from)
    }

    /// Forgets values, so that nodes are lowered anew with another default normal.
    pub(super) fn forget(&mut self) {
        self.values.clear();
    }

    /// A value that was lowered before its reader.
    pub(super) fn lowered(&self, task: Task) -> Option<Value> {
        self.values.get(&task).copied()
    }

    /// Lowers everything that `root` needs, then `root`.
    pub(super) fn evaluate(&mut self, root: Task) -> Lowered<Value> {
        let mut stack = vec![root];
        let mut open = HashSet::new();
        while let Some(&task) = stack.last() {
            if self.values.contains_key(&task) {
                stack.pop();
                continue;
            }
            let needed = self.needs(task)?;
            let missing: Vec<Task> = needed
                .into_iter()
                .filter(|t| !self.values.contains_key(t))
                .collect();
            if missing.is_empty() {
                let value = self.step(task)?;
                self.values.insert(task, value);
                if self.values.len() > MOST_VALUES {
                    return Err(LowerError::Size(self.material.to_owned(), MOST_VALUES));
                }
                open.remove(&task);
                stack.pop();
                continue;
            }
            open.insert(task);
            if let Some(closed) = missing.iter().find(|t| open.contains(t)) {
                return Err(LowerError::Cycle(self.place(closed.at)));
            }
            stack.extend(missing);
        }
        Ok(self.values[&root])
    }

    /// The outputs that must be lowered before this one.
    fn needs(&mut self, task: Task) -> Lowered<Vec<Task>> {
        match self.passes_through(task)? {
            Some(Through::Input(at, input)) => Ok(self.source_of(at, input).into_iter().collect()),
            Some(Through::Nothing) => Ok(Vec::new()),
            None => {
                let inputs = self.source(task.at).inputs.len() as u32;
                Ok((0..inputs)
                    .filter_map(|i| self.source_of(task.at, i))
                    .collect())
            }
        }
    }

    fn step(&mut self, task: Task) -> Lowered<Value> {
        let tree = self.frames[task.at.frame.0 as usize].tree;
        self.graph.set_span(Span {
            tree,
            node: task.at.node,
        });
        let node = self.source(task.at);
        let Some(socket) = node.outputs.get(task.output as usize) else {
            return Err(LowerError::Socket(
                self.place(task.at),
                format!("output {}", task.output),
            ));
        };
        let value = match self.passes_through(task)? {
            Some(Through::Input(at, input)) if self.is_empty(at, input) => self.zero(&socket.kind),
            Some(Through::Input(at, input)) => self.input_at(at, input as usize)?,
            Some(Through::Nothing) => self.zero(&socket.kind),
            None => match table::find(&node.kind) {
                Some(entry) => (entry.lower)(self, task.at, &socket.identifier)?,
                None => table::unknown(self, task.at, &socket.kind),
            },
        };
        socket::convert(self, value, &socket.kind)
    }

    /// Whether an input of a node that is muted has no link: Cycles hands zero on then, not the
    /// input's own value.
    fn is_empty(&self, at: At, input: u32) -> bool {
        self.source(at).muted && self.source_of(at, input).is_none()
    }

    /// Whether a value arrives at an input, and not only a group's, a reroute's or a muted node's
    /// input that nothing is linked to: what has a default of its own, like a texture's
    /// coordinate or a normal, keeps it there.
    pub(super) fn is_fed(&mut self, at: At, input: u32) -> bool {
        let mut source = self.source_of(at, input);
        let mut seen = HashSet::new();
        while let Some(task) = source {
            // Lowering the input names what is wrong with a cycle, or with a group.
            if !seen.insert(task) {
                return true;
            }
            source = match self.passes_through(task) {
                Ok(Some(Through::Input(at, input))) => self.source_of(at, input),
                Ok(Some(Through::Nothing)) => None,
                Ok(None) | Err(_) => return true,
            };
        }
        false
    }

    /// Nodes that only hand on: groups, their inputs, reroutes, muted nodes.
    fn passes_through(&mut self, task: Task) -> Lowered<Option<Through>> {
        let node = self.source(task.at);
        if node.muted {
            let link = node.internal_links.iter().find(|l| l[1] == task.output);
            let link = link.filter(|l| (l[0] as usize) < node.inputs.len());
            return Ok(Some(
                link.map_or(Through::Nothing, |l| Through::Input(task.at, l[0])),
            ));
        }
        match node.kind.as_str() {
            "NodeReroute" if !node.inputs.is_empty() => Ok(Some(Through::Input(task.at, 0))),
            "NodeGroupInput" => Ok(Some(self.caller_input(task))),
            kind if kind == "ShaderNodeGroup" || node.tree.is_some() => {
                self.group_output(task).map(Some)
            }
            _ => Ok(None),
        }
    }

    fn caller_input(&self, task: Task) -> Through {
        let Some(caller) = self.frames[task.at.frame.0 as usize].caller else {
            return Through::Nothing;
        };
        let output = &self.source(task.at).outputs.get(task.output as usize);
        let inputs = &self.source(caller).inputs;
        let same = output.and_then(|o| inputs.iter().position(|i| i.identifier == o.identifier));
        let at = same.unwrap_or(task.output as usize);
        if at < inputs.len() {
            Through::Input(caller, at as u32)
        } else {
            Through::Nothing
        }
    }

    fn group_output(&mut self, task: Task) -> Lowered<Through> {
        let Some(tree) = self.source(task.at).tree else {
            return Ok(Through::Nothing);
        };
        let frame = self.inside(task.at, tree)?;
        let nodes = self.nodes_of(frame);
        let Some(at) = nodes.iter().position(|n| n.kind == "NodeGroupOutput") else {
            return Ok(Through::Nothing);
        };
        let wanted = self.source(task.at).outputs.get(task.output as usize);
        let inputs = &nodes[at].inputs;
        let same = wanted.and_then(|o| inputs.iter().position(|i| i.identifier == o.identifier));
        let input = same.unwrap_or(task.output as usize);
        let node = at as u32;
        if input < inputs.len() {
            Ok(Through::Input(At { frame, node }, input as u32))
        } else {
            Ok(Through::Nothing)
        }
    }
}

/// What an output hands on.
enum Through {
    /// A node's input.
    Input(At, u32),
    /// Zero.
    Nothing,
}
