//! The table of operations, read from the same macros that the CPU's kernels come from.

mod dispatch;
mod table;

use crate::diagnostic::{Fault, Faults, Place, Problem, TranslateError};
use crate::source::Source;
use crate::translation::{Module, Translation};
use crate::types::Ty;
pub use dispatch::DispatchForm;
use table::{Entry, Form};

/// A type that an entry of the table names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OperandType {
    /// A number.
    F1,
    /// `Vec2`.
    F2,
    /// `Vec3`.
    F3,
    /// `[f32; 4]`.
    F4,
    /// The word's immediate.
    Immediate,
}

impl OperandType {
    /// Rows that it takes.
    pub fn width(self) -> usize {
        match self {
            OperandType::F1 => 1,
            OperandType::F2 => 2,
            OperandType::F3 => 3,
            OperandType::F4 => 4,
            OperandType::Immediate => 0,
        }
    }

    /// Its type in device code.
    pub fn ty(self) -> Ty {
        match self {
            OperandType::F1 => Ty::F32,
            OperandType::F2 => Ty::Vec2,
            OperandType::F3 => Ty::Vec3,
            OperandType::F4 => Ty::Array(Box::new(Ty::F32), 4),
            OperandType::Immediate => Ty::U32,
        }
    }

    fn named(name: &str) -> Option<OperandType> {
        Some(match name {
            "F1" => OperandType::F1,
            "F2" | "Gradient" => OperandType::F2,
            "F3" | "Color" | "Normal" => OperandType::F3,
            "F4" => OperandType::F4,
            "U32" => OperandType::Immediate,
            _ => return None,
        })
    }
}

/// An operation that devices can run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Operation {
    /// Its code: the place in the table.
    pub code: u16,
    /// Its name in the table.
    pub name: String,
    /// Its function in WGSL, `execute_` and the name.
    pub wgsl_name: String,
    /// Operands in order, the immediate last.
    pub arguments: Vec<OperandType>,
    /// The result.
    pub result: OperandType,
    /// It has a loop of its own.
    pub is_loop: bool,
    /// Where its entry is.
    pub place: Place,
    /// Names (in Rust) of its device functions.
    pub functions: Vec<String>,
    /// Its function.
    pub source: Source,
}

/// The table in WGSL.
#[derive(Clone, Debug)]
pub struct Operations {
    /// The operations by code; fewer, where a program needs no others.
    pub entries: Vec<Operation>,
}

impl Operations {
    /// A function for each operation, to be put behind the device functions.
    pub fn source(&self) -> Source {
        let mut source = Source::default();
        self.entries
            .iter()
            .for_each(|entry| source.append(&entry.source));
        source
    }

    /// Names (in Rust) of the device functions of all operations.
    pub fn functions(&self) -> impl Iterator<Item = &str> {
        self.entries
            .iter()
            .flat_map(|entry| entry.functions.iter().map(String::as_str))
    }
}

/// Reads the table: `table` is the file with the list of families, `families` are the
/// files with their entries, `device` is the translation of the functions that they name.
pub fn operations(
    table: &Module,
    families: &[Module],
    device: &Translation,
) -> Result<Operations, TranslateError> {
    let mut faults = Faults::default();
    let mut parsed = Vec::new();
    for module in families {
        if let Some(family) = faults.keep(&module.path, table::family(module)) {
            parsed.push((&module.path, family));
        }
    }
    let order = faults
        .keep(&table.path, table::family_order(table))
        .unwrap_or_default();
    // A family that does not read would be reported as missing, too.
    faults.or(())?;
    let mut faults = Faults::default();
    let mut entries = Vec::new();
    for (line, name) in &order {
        let Some((path, family)) = parsed.iter().find(|(_, f)| f.name == *name) else {
            let problem = Problem::Table(format!("no file has the family `{name}`"));
            faults.add(&table.path, (*line, problem));
            continue;
        };
        for entry in &family.entries {
            let mut source = Source::default();
            for (text, line) in faults
                .keep(path, entry_lines(entry, device))
                .unwrap_or_default()
            {
                let path = path.to_string();
                source.push(&text, Place { path, line });
            }
            entries.push(described(entry, entries.len(), path, source));
        }
    }
    faults.or(Operations { entries })
}

fn described(entry: &Entry, code: usize, path: &str, source: Source) -> Operation {
    let functions = match &entry.form {
        Form::Straight(function) => vec![function],
        Form::Loop {
            count,
            init,
            step,
            finish,
            ..
        } => vec![count, init, step, finish],
    };
    Operation {
        code: code as u16,
        name: entry.name.clone(),
        wgsl_name: format!("execute_{}", entry.name),
        arguments: entry.arguments.iter().map(|(_, ty)| *ty).collect(),
        result: entry.result,
        is_loop: matches!(entry.form, Form::Loop { .. }),
        place: Place {
            path: path.to_owned(),
            line: entry.line,
        },
        functions: functions.iter().map(|f| f.name.clone()).collect(),
        source,
    }
}

/// An entry's function.
fn entry_lines(entry: &Entry, device: &Translation) -> Result<Vec<(String, usize)>, Fault> {
    let types: Vec<Ty> = entry.arguments.iter().map(|(_, ty)| ty.ty()).collect();
    let names: Vec<String> = (0..types.len()).map(|i| format!("a{i}")).collect();
    let names = names.join(", ");
    let parameters = types
        .iter()
        .enumerate()
        .map(|(i, ty)| format!("a{i}: {}", ty.wgsl()));
    let parameters: Vec<String> = parameters.collect();
    let result = entry.result.ty();
    let mut lines = vec![(
        format!(
            "fn execute_{}({}) -> {} {{",
            entry.name,
            parameters.join(", "),
            result.wgsl()
        ),
        entry.line,
    )];
    match &entry.form {
        Form::Straight(function) => {
            let name = called(function, device, &types, &result)?;
            lines.push((format!("    return {name}({names});"), function.line));
        }
        Form::Loop {
            count,
            init,
            step,
            finish,
            state,
        } => {
            let state = Ty::Array(Box::new(Ty::F32), *state);
            let mut step_types = vec![Ty::U32];
            step_types.extend(types.iter().cloned());
            step_types.push(state.clone());
            let mut finish_types = types.clone();
            finish_types.push(state.clone());
            let count_name = called(count, device, &types, &Ty::U32)?;
            let init_name = called(init, device, &types, &state)?;
            let step_name = called(step, device, &step_types, &state)?;
            let finish_name = called(finish, device, &finish_types, &result)?;
            lines.push((
                format!("    let count = {count_name}({names});"),
                count.line,
            ));
            lines.push((format!("    var state = {init_name}({names});"), init.line));
            lines.push((
                "    for (var i = 0u; i < count; i += 1u) {".to_owned(),
                count.line,
            ));
            lines.push((
                format!("        state = {step_name}(i, {names}, state);"),
                step.line,
            ));
            lines.push(("    }".to_owned(), step.line));
            lines.push((
                format!("    return {finish_name}({names}, state);"),
                finish.line,
            ));
        }
    }
    lines.push(("}".to_owned(), entry.line));
    lines.push((String::new(), entry.line));
    Ok(lines)
}

/// A function that an entry names, which must have these types.
fn called(
    function: &table::Named,
    device: &Translation,
    parameters: &[Ty],
    result: &Ty,
) -> Result<String, Fault> {
    let Some(found) = device.functions.get(&function.name) else {
        return Err((
            function.line,
            Problem::UnknownFunction(function.name.clone()),
        ));
    };
    if found.parameters != parameters || found.result != *result {
        let face = |parameters: &[Ty], result: &Ty| {
            let parameters: Vec<String> = parameters.iter().map(Ty::rust).collect();
            format!(
                "{}({}) -> {}",
                function.name,
                parameters.join(", "),
                result.rust()
            )
        };
        let expected = face(parameters, result);
        let found = face(&found.parameters, &found.result);
        return Err((function.line, Problem::Mismatch { expected, found }));
    }
    Ok(found.wgsl_name.clone())
}
