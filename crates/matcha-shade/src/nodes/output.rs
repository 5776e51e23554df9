//! Output nodes: where lowering starts.

use super::bump::displaced_normal;
use super::walk::FrameId;
use super::{At, Lowered, Lowering, Value};
use crate::closure::ClosureKind;
use crate::material::{ClosureId, MaterialKind};
use crate::source::{Property, SourceNode};

impl Lowering<'_> {
    /// Lowers what the frame's output node is given.
    pub(super) fn output(&mut self, frame: FrameId) -> Lowered<()> {
        let Some(node) = self.output_node(frame) else {
            let none = self.closures.none();
            self.closures.root = Some(none);
            return Ok(());
        };
        let at = At { frame, node };
        if self.is_linked(at, "Displacement") && self.kind == MaterialKind::Surface {
            self.in_displacement = true;
            let displacement = self.f3(at, "Displacement")?;
            self.in_displacement = false;
            let normal = displaced_normal(self, displacement);
            self.normal = Some(normal);
            self.forget();
        }
        if self.is_linked(at, "Volume") {
            self.substitute(at, "a volume", "no volume");
        }
        let surface = match self.find_input(at, "Surface") {
            Some(index) => match self.input_at(at, index)? {
                Value::Shader(closure) => closure,
                _ => self.closures.none(),
            },
            None => self.closures.none(),
        };
        self.closures.root = Some(self.with_displaced_normal(surface));
        Ok(())
    }

    /// The surface's closures and the normal that its displacement bends.
    fn with_displaced_normal(&mut self, surface: ClosureId) -> ClosureId {
        let Some(normal) = self.normal else {
            return surface;
        };
        let white = self.graph.f3([1.0; 3]);
        let kind = ClosureKind::ShadingNormal;
        let span = self.graph.span();
        let leaf = self
            .closures
            .leaf(&self.graph, kind, white, vec![normal], span);
        self.closures.add(surface, leaf)
    }

    /// The active output for Cycles, else any.
    fn output_node(&self, frame: FrameId) -> Option<u32> {
        let kind = match self.kind {
            MaterialKind::Surface => "ShaderNodeOutputMaterial",
            MaterialKind::World => "ShaderNodeOutputWorld",
            MaterialKind::Light => "ShaderNodeOutputLight",
        };
        let nodes = self.nodes_of(frame);
        let outputs = || nodes.iter().enumerate().filter(|(_, n)| n.kind == kind);
        let best = outputs().max_by_key(|(_, n)| rank(n));
        best.map(|(index, _)| index as u32)
    }
}

fn rank(node: &SourceNode) -> u32 {
    let active = node.props.get("is_active_output") == Some(&Property::Bool(true));
    let target = match node.props.get("target") {
        Some(Property::Text(target)) => target.as_str(),
        _ => "ALL",
    };
    let for_cycles = match target {
        "CYCLES" => 4,
        "ALL" => 2,
        _ => 0,
    };
    for_cycles + u32::from(active)
}
