//! `matcha inspect`: what became of each material on its way to a program.

use super::inspect_dot;
use crate::End;
use crate::arguments::InspectArguments;
use crate::loading;
use crate::output;
use anyhow::{Result, bail};
use matcha_render::scene::{Material, Scene, Shader};
use matcha_shade::cacheability;
use matcha_shade::closure::ClosureKind;
use matcha_shade::compile::{Compiled, Options, compile};
use matcha_shade::input::Dependency;
use matcha_shade::material::{LowerReport, MaterialGraph, MaterialKind, Substitution};
use matcha_shade::nodes::{Names, lower, lower_gltf};
use serde::Serialize;
use std::collections::BTreeMap;

pub(crate) fn run(arguments: &InspectArguments) -> Result<End> {
    let scene = loading::load_scene(&arguments.scene)?;
    let chosen = choose(&scene, arguments.material.as_deref())?;
    let mut entries = Vec::new();
    for material in chosen {
        let (graph, substituted) = lowered(&scene, material)?;
        let compiled = compile(&graph, &Options::default())
            .map_err(|error| anyhow::anyhow!("material \"{}\": {error}", material.name))?;
        if arguments.dot {
            output::print(&inspect_dot::draw(&material.name, &compiled))?;
            return Ok(End::Done);
        }
        let nodes = source_nodes(&scene, material);
        entries.push(Entry::new(&material.name, nodes, &compiled, &substituted));
    }
    if arguments.json {
        output::print(&(serde_json::to_string_pretty(&entries)? + "\n"))?;
    } else {
        output::print(
            &entries
                .iter()
                .map(Entry::text)
                .collect::<Vec<_>>()
                .join("\n"),
        )?;
    }
    Ok(End::Done)
}

fn choose<'a>(scene: &'a Scene, name: Option<&str>) -> Result<Vec<&'a Material>> {
    let chosen: Vec<&Material> = scene
        .materials
        .iter()
        .filter(|m| name.is_none_or(|name| m.name == name))
        .collect();
    if let (Some(name), true) = (name, chosen.is_empty()) {
        bail!("{}: there is no material named \"{name}\"", scene.name);
    }
    Ok(chosen)
}

fn lowered(scene: &Scene, material: &Material) -> Result<(MaterialGraph, Vec<Substitution>)> {
    let names = Names {
        uv: &scene.uv_names,
        attributes: &scene.attribute_names,
    };
    let (graph, report) = match &material.shader {
        Shader::Cycles(tree) => lower(
            &scene.trees,
            *tree,
            names,
            &material.name,
            MaterialKind::Surface,
        )?,
        Shader::Gltf(gltf) => (lower_gltf(&material.name, gltf), LowerReport::default()),
    };
    Ok((graph, report.items))
}

/// Nodes as the author drew them, groups counted where they are used, not inside.
fn source_nodes(scene: &Scene, material: &Material) -> usize {
    match &material.shader {
        Shader::Cycles(tree) => scene.trees.get(*tree as usize).map_or(0, |t| t.nodes.len()),
        Shader::Gltf(_) => 1,
    }
}

/// What there is to say of a material.
#[derive(Debug, Serialize)]
struct Entry {
    material: String,
    /// In the material's own tree.
    nodes: usize,
    passes: Vec<Pass>,
    cacheable: Vec<Cacheable>,
    words: usize,
    /// Of the words, those that are skipped where the cache has everything.
    words_skipped: usize,
    /// Registers of the machine.
    slots: usize,
    /// Estimated, ns a point in lanes, without the cache.
    cost_ns: f32,
    closures: Vec<ClosureKind>,
    /// Number of values by what they depend on.
    dependencies: BTreeMap<String, usize>,
    /// What the program reads of a hit.
    inputs: Vec<String>,
    substituted: Vec<String>,
}

#[derive(Debug, Serialize)]
struct Pass {
    pass: &'static str,
    nodes: usize,
    operations: usize,
}

#[derive(Debug, Serialize)]
struct Cacheable {
    uv_set: u16,
    encoding: String,
    /// Estimated cost of it alone, ns a point in lanes.
    cost_ns: f32,
}

impl Entry {
    fn new(name: &str, nodes: usize, compiled: &Compiled, substituted: &[Substitution]) -> Self {
        let program = &compiled.program;
        let cacheable = program.regions().iter().flat_map(|region| {
            region.values.iter().map(|value| Cacheable {
                uv_set: region.uv_set,
                encoding: format!("{:?}", value.encoding),
                cost_ns: value.cost,
            })
        });
        let skipped = program.regions().iter().map(|region| region.words.len());
        let passes = compiled.passes.iter().map(|pass| Pass {
            pass: pass.pass,
            nodes: pass.nodes,
            operations: pass.operations,
        });
        Self {
            material: name.to_owned(),
            nodes,
            passes: passes.collect(),
            cacheable: cacheable.collect(),
            words: program.words().len(),
            words_skipped: skipped.sum(),
            slots: program.slots(),
            cost_ns: program.cost,
            closures: program
                .closures
                .iter()
                .map(|closure| closure.kind)
                .collect(),
            dependencies: dependencies(compiled),
            inputs: program
                .inputs
                .iter()
                .map(|(i, _)| format!("{:?} {:?}", i.kind, i.part))
                .collect(),
            substituted: substituted
                .iter()
                .map(|item| {
                    format!(
                        "{} (node \"{}\"): {}",
                        item.kind, item.node, item.substitute
                    )
                })
                .collect(),
        }
    }

    fn text(&self) -> String {
        let mut text = format!("{}\n", self.material);
        let mut line = |name: &str, value: String| text += &format!("  {name:<14}{value}\n");
        line("nodes", self.nodes.to_string());
        let passes = self
            .passes
            .iter()
            .map(|p| format!("{} {}", p.pass, p.operations));
        line("operations", passes.collect::<Vec<_>>().join(", "));
        line("cacheable", self.cacheable.len().to_string());
        for node in &self.cacheable {
            let Cacheable {
                uv_set,
                encoding,
                cost_ns,
            } = node;
            line("", format!("{encoding}, UV set {uv_set}, {cost_ns:.0} ns"));
        }
        line(
            "words",
            format!("{}, {} of them cacheable", self.words, self.words_skipped),
        );
        line("stack slots", self.slots.to_string());
        line("cost", format!("{:.0} ns a point", self.cost_ns));
        let closures = self.closures.iter().map(|kind| format!("{kind:?}"));
        line("closures", closures.collect::<Vec<_>>().join(", "));
        let depends = self
            .dependencies
            .iter()
            .map(|(name, count)| format!("{name} {count}"));
        line("dependencies", depends.collect::<Vec<_>>().join(", "));
        line("inputs", self.inputs.join(", "));
        for item in &self.substituted {
            line("substituted", item.clone());
        }
        text
    }
}

/// Operations by what they depend on.
fn dependencies(compiled: &Compiled) -> BTreeMap<String, usize> {
    let network = &compiled.network;
    let live = network.live();
    let mut counts = BTreeMap::new();
    for (k, dependency) in cacheability::dependencies(&network.graph)
        .into_iter()
        .enumerate()
    {
        if live[k] && matcha_shade::opt::is_operation(&network.graph.nodes()[k].kind) {
            *counts.entry(name_of(dependency)).or_default() += 1;
        }
    }
    counts
}

pub(super) fn name_of(dependency: Dependency) -> String {
    match dependency {
        Dependency::Constant => "constant".into(),
        Dependency::Uv(set) => format!("uv {set}"),
        Dependency::Surface => "surface".into(),
        Dependency::View => "view".into(),
        Dependency::Path => "path".into(),
    }
}
