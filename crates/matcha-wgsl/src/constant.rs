//! Constants' values, for hosts.

use crate::ir::{Expr, ExprKind};
use crate::types::{Inference, Ty};
use std::collections::BTreeMap;

/// A constant's value.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// f32.
    F32(f32),
    /// u32.
    U32(u32),
    /// i32.
    I32(i32),
    /// bool.
    Bool(bool),
    /// A vector, an array or a struct, part by part.
    Parts(Vec<Value>),
}

impl Value {
    /// A whole number's value.
    pub fn as_u32(&self) -> Option<u32> {
        match self {
            Value::U32(value) => Some(*value),
            Value::I32(value) => u32::try_from(*value).ok(),
            _ => None,
        }
    }

    /// A number's value.
    pub fn as_f32(&self) -> Option<f32> {
        match self {
            Value::F32(value) => Some(*value),
            _ => None,
        }
    }
}

/// The value of a constant's expression, if it is made of numbers, operators and
/// constants that `known` has.
pub(crate) fn evaluate(
    it: &Expr,
    inference: &Inference,
    known: &BTreeMap<String, Value>,
) -> Option<Value> {
    let of = |it: &Expr| evaluate(it, inference, known);
    let ty = inference.settled(&it.ty);
    Some(match &it.kind {
        ExprKind::Float(value) => Value::F32(*value),
        ExprKind::Integer { value, .. } if ty == Ty::U32 => Value::U32(*value),
        ExprKind::Integer { value, .. } => Value::I32(*value as i32),
        ExprKind::Bool(value) => Value::Bool(*value),
        ExprKind::Constant(name) => known.get(name)?.clone(),
        ExprKind::Unary(operator, operand) => unary(operator, of(operand)?)?,
        ExprKind::Binary(operator, a, b) => binary(operator, of(a)?, of(b)?)?,
        ExprKind::Cast(operand) => cast(of(operand)?, &ty)?,
        ExprKind::Construct(parts) => {
            let parts: Option<Vec<Value>> = parts.iter().map(of).collect();
            let parts = parts?;
            match (&ty, parts.as_slice()) {
                (Ty::Vec2, [one]) => Value::Parts(vec![one.clone(); 2]),
                (Ty::Vec3, [one]) => Value::Parts(vec![one.clone(); 3]),
                _ => Value::Parts(parts),
            }
        }
        ExprKind::Repeat(element) => match ty {
            Ty::Array(_, length) => Value::Parts(vec![of(element)?; length]),
            _ => return None,
        },
        _ => return None,
    })
}

fn unary(operator: &str, operand: Value) -> Option<Value> {
    Some(match (operator, operand) {
        ("-", Value::F32(x)) => Value::F32(-x),
        ("-", Value::I32(x)) => Value::I32(x.wrapping_neg()),
        ("~", Value::U32(x)) => Value::U32(!x),
        ("~", Value::I32(x)) => Value::I32(!x),
        ("!", Value::Bool(x)) => Value::Bool(!x),
        _ => return None,
    })
}

fn binary(operator: &str, a: Value, b: Value) -> Option<Value> {
    if let ("<<" | ">>", Some(by)) = (operator, b.as_u32()) {
        return match (operator, a) {
            ("<<", Value::U32(x)) => x.checked_shl(by).map(Value::U32),
            (">>", Value::U32(x)) => x.checked_shr(by).map(Value::U32),
            ("<<", Value::I32(x)) => x.checked_shl(by).map(Value::I32),
            (_, Value::I32(x)) => x.checked_shr(by).map(Value::I32),
            _ => None,
        };
    }
    match (a, b) {
        (Value::F32(a), Value::F32(b)) => float(operator, a, b).map(Value::F32),
        (Value::U32(a), Value::U32(b)) => {
            let value = integer(operator, i64::from(a), i64::from(b))?;
            u32::try_from(value).ok().map(Value::U32)
        }
        (Value::I32(a), Value::I32(b)) => {
            let value = integer(operator, i64::from(a), i64::from(b))?;
            i32::try_from(value).ok().map(Value::I32)
        }
        _ => None,
    }
}

fn float(operator: &str, a: f32, b: f32) -> Option<f32> {
    Some(match operator {
        "+" => a + b,
        "-" => a - b,
        "*" => a * b,
        "/" => a / b,
        _ => return None,
    })
}

fn integer(operator: &str, a: i64, b: i64) -> Option<i64> {
    match operator {
        "+" => a.checked_add(b),
        "-" => a.checked_sub(b),
        "*" => a.checked_mul(b),
        "/" => a.checked_div(b),
        "%" => a.checked_rem(b),
        "&" => Some(a & b),
        "|" => Some(a | b),
        "^" => Some(a ^ b),
        _ => None,
    }
}

fn cast(value: Value, to: &Ty) -> Option<Value> {
    let whole = match value {
        Value::U32(x) => i64::from(x),
        Value::I32(x) => i64::from(x),
        Value::Bool(x) => i64::from(x),
        Value::F32(_) | Value::Parts(_) => {
            return matches!((&value, to), (Value::F32(_), Ty::F32)).then_some(value);
        }
    };
    Some(match to {
        Ty::U32 => Value::U32(whole as u32),
        Ty::I32 => Value::I32(whole as i32),
        Ty::F32 => Value::F32(whole as f32),
        _ => return None,
    })
}
