//! From an optimised network to words: schedule, registers, regions.

mod registers;
mod schedule;
mod texel;

use crate::cacheability::{self, encoding};
use crate::compile::Options;
use crate::graph::{Graph, NodeId, NodeKind};
use crate::input::{Input, InputKind, Part};
use crate::material::MaterialKind;
use crate::opt::Network;
use crate::program::{
    CONSTANT, CachedValue, ClosureOutput, NODES_ALIGNED, Program, ProgramError, Region, Splat,
    Word, special,
};
use crate::vm::kernel::LANES;
use registers::{Source, Step, slot, too_large};
use std::collections::HashMap;

/// Emits a network. `cached` are the nodes that are looked up, with their UV sets; those of
/// one set, which follow each other, become a region.
pub fn emit(
    network: &Network,
    cached: &[(NodeId, u16)],
    options: &Options,
    name: &str,
    kind: MaterialKind,
) -> Result<Program, ProgramError> {
    let mut emitter = Emitter::default();
    emitter.number_inputs(network, cached);
    let mut results = HashMap::new();
    for same in cached.chunk_by(|a, b| a.1 == b.1) {
        let nodes: Vec<NodeId> = same.iter().map(|&(id, _)| id).collect();
        let registers = emitter.region(&network.graph, &nodes, same[0].1, options)?;
        results.extend(nodes.into_iter().zip(registers));
    }
    let outputs = emitter.rest(network, &results)?;
    let (closures, cost) = (
        closure_rows(network),
        cacheability::network_cost(network, &options.cost),
    );
    emitter.finish(outputs, closures, cost, name, kind)
}

fn closure_rows(network: &Network) -> Vec<ClosureOutput> {
    let rows = network.closures.iter().scan(0, |row, closure| {
        let first_row = *row;
        *row += closure.kind.rows();
        Some(ClosureOutput {
            kind: closure.kind,
            first_row,
        })
    });
    rows.collect()
}

#[derive(Default)]
struct Emitter {
    words: Vec<Word>,
    regions: Vec<Region>,
    inputs: Vec<(Input, usize)>,
    input_rows: usize,
    /// Registers from 0 on that hold inputs and results of regions.
    pinned: usize,
    slots: usize,
    constants: Vec<f32>,
    constant_of: HashMap<u32, u16>,
    textures: Vec<crate::graph::TextureRef>,
    tables: Vec<crate::graph::Table>,
}

impl Emitter {
    /// Gives rows to everything that the rest of the words or a region reads.
    fn number_inputs(&mut self, network: &Network, cached: &[(NodeId, u16)]) {
        let mut inputs = Vec::new();
        let stop = |id| cached.iter().any(|(c, _)| *c == id);
        let outputs: Vec<NodeId> = network.outputs().collect();
        for id in schedule::order(&network.graph, &outputs, stop) {
            if let NodeKind::Input(input) = network.graph.node(id).kind
                && !stop(id)
            {
                inputs.push(input);
            }
        }
        for &(_, set) in cached {
            for part in [Part::Value, Part::AxisA, Part::AxisB] {
                inputs.push(Input {
                    kind: InputKind::Uv(set),
                    part,
                });
            }
        }
        inputs.sort();
        inputs.dedup();
        for input in inputs {
            self.inputs.push((input, self.input_rows));
            self.input_rows += input.kind.width();
        }
        self.pinned = self.input_rows;
        // A register exists even if nothing is read: operands that a kernel does not
        // use are zero.
        self.slots = self.pinned.max(1);
    }

    fn input_row(&self, input: Input) -> usize {
        let found = self.inputs.iter().find(|(i, _)| *i == input);
        found.expect("every input that is read was numbered").1
    }

    /// Emits a region with the nodes of a UV set; returns the first register of each one's
    /// value.
    fn region(
        &mut self,
        graph: &Graph,
        nodes: &[NodeId],
        set: u16,
        options: &Options,
    ) -> Result<Vec<u16>, ProgramError> {
        let number = self.regions.len() as u32;
        let start = self.words.len();
        let mut values = self.cached_values(graph, nodes)?;
        let texel = slot(self.pinned)?;
        self.words.push(Word {
            op: special::LOOKUP,
            dst: texel,
            aux: number,
            ..Word::default()
        });
        let (inner, roots) = texel::at_centre(graph, nodes, set, options.optimise);
        let placed = self.pinned + texel::REGISTERS;
        let places = self.words_of(&inner, &roots, &HashMap::new(), placed, false, |input| {
            texel::register(input, texel)
        })?;
        let mut rest = &places[..];
        for (value, &root) in values.iter_mut().zip(&roots) {
            let operands = rest
                .split_off(..value.ty.width())
                .expect("a place a component");
            let mut store = Word {
                op: special::STORE,
                dst: value.result,
                aux: number,
                ..Word::default()
            };
            store.src[..operands.len()].copy_from_slice(operands);
            self.words.push(store);
            value.cost = cost_of(&inner, &[root], options);
        }
        let uv_rows = [Part::Value, Part::AxisA, Part::AxisB].map(|part| {
            self.input_row(Input {
                kind: InputKind::Uv(set),
                part,
            })
        });
        let results = values.iter().map(|value| value.result).collect();
        self.regions.push(Region {
            number,
            uv_set: set,
            values,
            words: start..self.words.len(),
            uv_rows,
            cost: cost_of(&inner, &roots, options),
        });
        Ok(results)
    }

    /// Gives registers and numbers to a region's values; their costs come later.
    fn cached_values(
        &mut self,
        graph: &Graph,
        nodes: &[NodeId],
    ) -> Result<Vec<CachedValue>, ProgramError> {
        let last = self.regions.last().and_then(|region| region.values.last());
        let first = last.map_or(0, |value| (value.node + 1).next_multiple_of(NODES_ALIGNED));
        let value = |(node, &id): (u32, &NodeId)| {
            let ty = graph.ty(id);
            let result = slot(self.pinned)?;
            self.pinned += ty.width();
            Ok(CachedValue {
                node,
                ty,
                encoding: encoding(graph, id),
                result,
                cost: 0.0,
            })
        };
        (first..).zip(nodes).map(value).collect()
    }

    /// Emits the words after the regions; returns the operand of each output row.
    fn rest(
        &mut self,
        network: &Network,
        results: &HashMap<NodeId, u16>,
    ) -> Result<Vec<u16>, ProgramError> {
        let outputs: Vec<NodeId> = network.outputs().collect();
        let rows: HashMap<Input, usize> = self.inputs.iter().copied().collect();
        let register = |input| rows[&input] as u16;
        self.words_of(
            &network.graph,
            &outputs,
            results,
            self.pinned,
            true,
            register,
        )
    }

    /// Emits what `outputs` need; returns the operands of all their components. Nodes
    /// in `given` have their value in registers already. Registers below `placed` are
    /// taken at the start, and free after their last use if `reuse` says so.
    fn words_of(
        &mut self,
        graph: &Graph,
        outputs: &[NodeId],
        given: &HashMap<NodeId, u16>,
        placed: usize,
        reuse: bool,
        input_register: impl Fn(Input) -> u16,
    ) -> Result<Vec<u16>, ProgramError> {
        let mut place: Vec<[Source; 4]> = vec![[Source::Value(0); 4]; graph.nodes().len()];
        let mut steps = Vec::new();
        let mut values = placed as u32;
        for id in schedule::order(graph, outputs, |id| given.contains_key(&id)) {
            let node = graph.node(id);
            let sources = components(graph, &node.inputs, &place);
            place[id.index()] = match node.kind {
                _ if given.contains_key(&id) => consecutive(given[&id] as u32),
                NodeKind::Input(input) => consecutive(input_register(input) as u32),
                NodeKind::Const(value) => self.constants(value, node.ty.width())?,
                NodeKind::Extract(first) => {
                    std::array::from_fn(|i| sources[(first as usize + i).min(sources.len() - 1)])
                }
                NodeKind::Combine => std::array::from_fn(|i| sources[i.min(sources.len() - 1)]),
                NodeKind::Apply(..) | NodeKind::Texture(_) | NodeKind::Table(_) => {
                    let (op, aux) = self.code(graph, &node.kind);
                    let (first, width) = (values, node.ty.width());
                    values += width as u32;
                    steps.push(Step {
                        op,
                        aux,
                        sources,
                        first,
                        width,
                    });
                    consecutive(first)
                }
            };
        }
        let results = components(graph, outputs, &place);
        let assigned = registers::assign(&steps, &results, placed, values as usize, reuse)?;
        self.slots = self.slots.max(assigned.slots);
        self.words.extend(assigned.words);
        Ok(assigned.results)
    }

    fn code(&mut self, graph: &Graph, kind: &NodeKind) -> (u16, u32) {
        match *kind {
            NodeKind::Apply(op, aux) => (op.0, aux),
            NodeKind::Texture(texture) => {
                (special::TEXTURE, index_of(&mut self.textures, &texture))
            }
            NodeKind::Table(table) => {
                let table = &graph.tables()[table.0 as usize];
                (special::TABLE, index_of(&mut self.tables, table))
            }
            _ => unreachable!("only operations become words"),
        }
    }

    fn constants(&mut self, value: [f32; 4], width: usize) -> Result<[Source; 4], ProgramError> {
        let mut sources = [Source::Value(0); 4];
        for (source, x) in sources.iter_mut().zip(&value[..width]) {
            *source = Source::Constant(self.constant(*x)?);
        }
        Ok(sources)
    }

    fn constant(&mut self, x: f32) -> Result<u16, ProgramError> {
        let next = self.constants.len();
        if let Some(&operand) = self.constant_of.get(&x.to_bits()) {
            return Ok(operand);
        }
        if next >= registers::MOST_SLOTS {
            return Err(too_large("constants", next + 1));
        }
        self.constants.push(x);
        let operand = next as u16 | CONSTANT;
        self.constant_of.insert(x.to_bits(), operand);
        Ok(operand)
    }

    fn finish(
        self,
        outputs: Vec<u16>,
        closures: Vec<ClosureOutput>,
        cost: f32,
        name: &str,
        kind: MaterialKind,
    ) -> Result<Program, ProgramError> {
        let mut program = Program {
            name: name.to_owned(),
            kind,
            inputs: self.inputs,
            input_rows: self.input_rows,
            loads: Vec::new(),
            words: self.words,
            slots: self.slots,
            regions: self.regions,
            splats: self.constants.iter().map(|&x| Splat([x; LANES])).collect(),
            constants: self.constants,
            textures: self.textures,
            tables: self.tables,
            closures,
            outputs,
            cost,
        };
        program.loads = program.find_loads();
        program.verify()?;
        Ok(program)
    }
}

/// Cost of everything that the roots need, computed once.
fn cost_of(graph: &Graph, roots: &[NodeId], options: &Options) -> f32 {
    let live = schedule::order(graph, roots, |_| false);
    let costs = live
        .iter()
        .map(|&id| cacheability::own_cost(graph, id, &options.cost));
    costs.sum()
}

fn consecutive(first: u32) -> [Source; 4] {
    std::array::from_fn(|i| Source::Value(first + i as u32))
}

fn components(graph: &Graph, nodes: &[NodeId], place: &[[Source; 4]]) -> Vec<Source> {
    let of = |id: &NodeId| place[id.index()][..graph.ty(*id).width()].to_vec();
    nodes.iter().flat_map(of).collect()
}

fn index_of<T: PartialEq + Clone>(list: &mut Vec<T>, item: &T) -> u32 {
    let at = list.iter().position(|i| i == item).unwrap_or_else(|| {
        list.push(item.clone());
        list.len() - 1
    });
    at as u32
}
