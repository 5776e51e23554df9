//! Sockets: their values, converted as Blender converts them, and node properties.

use super::error::LowerError;
use super::{At, Lowered, Lowering, Value};
use crate::graph::{Encoding, NodeId};
use crate::material::ClosureId;
use crate::ops::OpCode;
use crate::source::{Property, Socket};

/// Converts a value to a socket's kind: a colour's number is its luminance, a vector's
/// the mean of its components; a number becomes three equal ones; anything but a closure
/// in a shader socket becomes emission, as Cycles has it.
pub(super) fn convert(l: &mut Lowering, value: Value, kind: &str) -> Lowered<Value> {
    Ok(match (kind, value) {
        ("SHADER", Value::Shader(_)) => value,
        ("SHADER", _) => {
            let color = number_or_triple(l, value);
            let span = l.graph.span();
            let kind = crate::closure::ClosureKind::Emission;
            Value::Shader(l.closures.leaf(&l.graph, kind, color, vec![], span))
        }
        (_, Value::Shader(_)) => l.zero(kind),
        ("RGBA", _) => Value::Color(number_or_triple(l, value)),
        ("VECTOR" | "ROTATION", _) => Value::Vector(number_or_triple(l, value)),
        ("INT", _) => {
            let x = to_number(l, value);
            match l.graph.constant_value(x) {
                Some([v, ..]) => Value::Float(l.graph.f1(v.trunc())),
                None => Value::Float(l.graph.apply(OpCode::math_truncate, &[x])),
            }
        }
        _ => Value::Float(to_number(l, value)),
    })
}

fn to_number(l: &mut Lowering, value: Value) -> NodeId {
    match value {
        Value::Float(x) => x,
        Value::Vector(v) => l.graph.apply(OpCode::vector_average, &[v]),
        Value::Color(c) => l.graph.apply(OpCode::color_luminance, &[c]),
        Value::Shader(_) => l.graph.f1(0.0),
    }
}

fn number_or_triple(l: &mut Lowering, value: Value) -> NodeId {
    match value {
        Value::Float(x) => l.splat(x),
        Value::Vector(v) | Value::Color(v) => v,
        Value::Shader(_) => l.graph.f3([0.0; 3]),
    }
}

impl Lowering<'_> {
    /// Three times the same number.
    pub fn splat(&mut self, x: NodeId) -> NodeId {
        match self.graph.constant_value(x) {
            Some([v, ..]) => self.graph.f3([v; 3]),
            None => self.graph.combine(&[x, x, x]),
        }
    }

    /// The zero of a socket's kind.
    pub fn zero(&mut self, kind: &str) -> Value {
        match kind {
            "SHADER" => Value::Shader(self.closures.none()),
            "RGBA" => Value::Color(self.graph.f3([0.0; 3])),
            "VECTOR" | "ROTATION" => Value::Vector(self.graph.f3([0.0; 3])),
            _ => Value::Float(self.graph.f1(0.0)),
        }
    }

    /// The socket's own value.
    fn unlinked(&mut self, socket: &Socket) -> Value {
        let at = |i: usize| socket.value.get(i).copied().unwrap_or(0.0);
        match socket.kind.as_str() {
            "SHADER" => Value::Shader(self.closures.none()),
            "RGBA" => Value::Color(self.graph.f3([at(0), at(1), at(2)])),
            "VECTOR" | "ROTATION" => Value::Vector(self.graph.f3([at(0), at(1), at(2)])),
            _ => Value::Float(self.graph.f1(at(0))),
        }
    }

    /// An input by position, converted to its kind.
    pub fn input_at(&mut self, at: At, index: usize) -> Lowered<Value> {
        let node = self.source(at);
        let Some(socket) = node.inputs.get(index) else {
            let name = format!("input {index}");
            return Err(LowerError::Socket(self.place(at), name));
        };
        match self.source_of(at, index as u32) {
            Some(task) => match self.lowered(task) {
                Some(value) => convert(self, value, &socket.kind),
                None => self
                    .evaluate(task)
                    .and_then(|v| convert(self, v, &socket.kind)),
            },
            None => Ok(self.unlinked(socket)),
        }
    }

    /// Position of an input by identifier.
    pub fn find_input(&self, at: At, identifier: &str) -> Option<usize> {
        let inputs = &self.source(at).inputs;
        inputs.iter().position(|s| s.identifier == identifier)
    }

    /// An input by identifier.
    pub fn any(&mut self, at: At, identifier: &str) -> Lowered<Value> {
        match self.find_input(at, identifier) {
            Some(index) => self.input_at(at, index),
            None => Err(LowerError::Socket(self.place(at), identifier.to_owned())),
        }
    }

    /// An input as a number (F1).
    pub fn f1(&mut self, at: At, identifier: &str) -> Lowered<NodeId> {
        let value = self.any(at, identifier)?;
        Ok(to_number(self, value))
    }

    /// An input as a vector (F3).
    pub fn f3(&mut self, at: At, identifier: &str) -> Lowered<NodeId> {
        let value = self.any(at, identifier)?;
        Ok(number_or_triple(self, value))
    }

    /// An input as a colour (F3), marked as one for the cache.
    pub fn color(&mut self, at: At, identifier: &str) -> Lowered<NodeId> {
        let color = self.f3(at, identifier)?;
        Ok(if self.graph.constant_value(color).is_none() {
            self.graph.means(color, Encoding::Color)
        } else {
            color
        })
    }

    /// An input as a closure.
    pub fn closure(&mut self, at: At, identifier: &str) -> Lowered<ClosureId> {
        let value = self.any(at, identifier)?;
        match convert(self, value, "SHADER")? {
            Value::Shader(closure) => Ok(closure),
            _ => Ok(self.closures.none()),
        }
    }

    /// A number that older versions of the node do not have.
    pub fn f1_or(&mut self, at: At, identifier: &str, default: f32) -> Lowered<NodeId> {
        match self.find_input(at, identifier) {
            Some(_) => self.f1(at, identifier),
            None => Ok(self.graph.f1(default)),
        }
    }

    /// A vector or colour that older versions of the node do not have.
    pub fn f3_or(&mut self, at: At, identifier: &str, default: [f32; 3]) -> Lowered<NodeId> {
        match self.find_input(at, identifier) {
            Some(_) => self.f3(at, identifier),
            None => Ok(self.graph.f3(default)),
        }
    }

    /// Whether a value arrives at an input by a link.
    pub fn is_linked(&mut self, at: At, identifier: &str) -> bool {
        let index = self.find_input(at, identifier);
        index.is_some_and(|i| self.is_fed(at, i as u32))
    }

    /// A normal: the linked one, else the default.
    pub fn normal_input(&mut self, at: At, identifier: &str) -> Lowered<NodeId> {
        if self.is_linked(at, identifier) {
            self.f3(at, identifier)
        } else {
            Ok(self.default_normal())
        }
    }

    /// A constant's number.
    pub fn known(&self, id: NodeId) -> Option<f32> {
        self.graph.constant_value(id).map(|v| v[0])
    }

    /// A text property; `default` where the file has none.
    pub fn text(&self, at: At, name: &str, default: &str) -> String {
        match self.source(at).props.get(name) {
            Some(Property::Text(text)) => text.clone(),
            _ => default.to_owned(),
        }
    }

    /// A flag; false where the file has none.
    pub fn flag(&self, at: At, name: &str) -> bool {
        match self.source(at).props.get(name) {
            Some(Property::Bool(flag)) => *flag,
            Some(Property::Number(x)) => *x != 0.0,
            _ => false,
        }
    }

    /// A number property; `default` where the file has none.
    pub fn number(&self, at: At, name: &str, default: f32) -> f32 {
        match self.source(at).props.get(name) {
            Some(Property::Number(x)) => *x as f32,
            _ => default,
        }
    }

    /// An error about a property's value.
    pub fn bad_property(&self, at: At, name: &str) -> LowerError {
        let value = self.text(at, name, "missing");
        LowerError::Property(self.place(at), name.to_owned(), value)
    }

    /// An output that the node's type does not have.
    pub fn bad_output(&self, at: At, output: &str) -> LowerError {
        LowerError::Socket(self.place(at), output.to_owned())
    }

    /// An operation.
    pub fn op(&mut self, op: OpCode, inputs: &[NodeId]) -> NodeId {
        self.graph.apply(op, inputs)
    }
}
