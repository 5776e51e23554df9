//! Modules into one source.

use crate::assemble::{Assembler, Assembly, Memory};
use crate::collect::{Item, ItemKind, Scope, collect};
use crate::constant::{Value, evaluate};
use crate::diagnostic::{Fault, Faults, Place, Problem, TranslateError, outside};
use crate::emit::{self, Line};
use crate::ir::ExprKind;
use crate::layout::Structs;
use crate::lower::{Lowering, Read};
use crate::order::ordered;
use crate::prelude::{INTRINSICS, Intrinsic};
use crate::source::Source;
use crate::types::Ty;
use crate::view::{Access, FieldPlace, View};
use std::collections::{BTreeMap, BTreeSet};

/// A file of device code.
#[derive(Clone, Debug)]
pub struct Module {
    /// Its path, as messages shall name it.
    pub path: String,
    /// Its text.
    pub source: String,
}

impl Module {
    /// Reads a file.
    pub fn read(path: impl AsRef<std::path::Path>) -> std::io::Result<Module> {
        let source = std::fs::read_to_string(path.as_ref())?;
        let path = path.as_ref().display().to_string();
        Ok(Module { path, source })
    }
}

/// A device function as WGSL's host layers see it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Function {
    /// Name in Rust.
    pub name: String,
    /// Name in WGSL: WGSL's own names get an underscore.
    pub wgsl_name: String,
    /// Parameters' types.
    pub parameters: Vec<Ty>,
    /// The result's type.
    pub result: Ty,
    /// Where it is defined.
    pub place: Place,
}

/// Device code in WGSL.
#[derive(Clone, Debug)]
pub struct Translation {
    /// All structs, constants and functions.
    pub source: Source,
    /// The functions, by name in Rust.
    pub functions: BTreeMap<String, Function>,
    /// The views, by name.
    pub views: BTreeMap<String, View>,
    /// Values of the constants, by name; those that call functions are not among them.
    pub constants: BTreeMap<String, Value>,
    pub(crate) structs: Structs,
    pub(crate) struct_places: BTreeMap<String, Place>,
    pieces: Vec<Piece>,
}

impl Translation {
    /// Only what the device functions, structs and constants of these names (in Rust) need,
    /// and they themselves.
    pub fn needed<'n>(&self, names: impl IntoIterator<Item = &'n str>) -> Needed {
        let mut needed: BTreeSet<&str> = names.into_iter().collect();
        // Needs come before what needs them.
        for piece in self.pieces.iter().rev() {
            if needed.contains(piece.name.as_str()) {
                needed.extend(piece.uses.iter().map(String::as_str));
            }
        }
        let mut source = Source::default();
        let kept = self
            .pieces
            .iter()
            .filter(|p| needed.contains(p.name.as_str()));
        kept.for_each(|piece| piece.write(&mut source));
        let accesses = self.accesses(|function| needed.contains(function));
        Needed { source, accesses }
    }

    /// Functions of the host layer for all views, which give nothing but zeros: with them,
    /// [`check`](crate::check) takes the translation as it is.
    pub fn stand_ins(&self) -> Source {
        let mut source = Source::default();
        for access in self.accesses(|_| true) {
            let word = access.word_function();
            let count = access.count_function();
            let Some(view) = self.views.get(&access.view) else {
                continue;
            };
            let words = format!("fn {word}(i: u32) -> u32 {{ return i & 0u; }}");
            source.push(&words, view.place.clone());
            if access.count {
                let count = format!("fn {count}() -> u32 {{ return 0u; }}");
                source.push(&count, view.place.clone());
            }
        }
        source
    }

    /// Fields of views of which a function of the host layer is used.
    fn accesses(&self, is_used: impl Fn(&str) -> bool) -> Vec<Access> {
        let mut accesses = Vec::new();
        for view in self.views.values() {
            for field in &view.fields {
                let mut access = Access {
                    view: view.name.clone(),
                    field: field.name.clone(),
                    words: false,
                    count: false,
                };
                access.words = is_used(&access.word_function());
                access.count =
                    field.place == FieldPlace::Buffer && is_used(&access.count_function());
                if access.words || access.count {
                    accesses.push(access);
                }
            }
        }
        accesses
    }
}

/// What some device functions need.
#[derive(Clone, Debug)]
pub struct Needed {
    /// Structs, constants and functions.
    pub source: Source,
    /// Fields of views that they read, in the order of the views' names and of their fields.
    pub accesses: Vec<Access>,
}

/// Translates modules, which see each other's items by name. All errors of all modules
/// are reported together: those of items' faces first, then those of bodies.
pub fn translate(modules: &[Module]) -> Result<Translation, TranslateError> {
    let mut faults = Faults::default();
    let (items, scope) = collect(modules, &mut faults);
    // Errors in the faces of items would only be followed by more of the same cause.
    faults.or(())?;
    let mut faults = Faults::default();
    let mut pieces = helpers();
    let mut reads = BTreeMap::new();
    for item in &items {
        let piece = faults.keep(&item.path, translate_item(item, &scope, &mut reads));
        pieces.extend(piece);
    }
    faults.or(())?;
    pieces.extend(readers(&reads, &scope));
    let mut faults = Faults::default();
    let needs: Vec<(&str, &BTreeSet<String>)> =
        pieces.iter().map(|p| (p.name.as_str(), &p.uses)).collect();
    let order = match ordered(&needs) {
        Ok(order) => order,
        Err(item) => {
            let Piece { name, place, .. } = &pieces[item];
            faults.add(&place.path, (place.line, Problem::Cycle(name.clone())));
            Vec::new()
        }
    };
    let mut pieces: Vec<Option<Piece>> = pieces.into_iter().map(Some).collect();
    let pieces: Vec<Piece> = order.iter().filter_map(|&i| pieces[i].take()).collect();
    let mut source = Source::default();
    pieces.iter().for_each(|piece| piece.write(&mut source));
    let written = items.iter().filter_map(|i| describe(i, &scope));
    let offered = INTRINSICS
        .iter()
        .filter_map(|(name, i)| offered(name, *i, &scope));
    let functions = written.chain(offered);
    let functions = functions.map(|f| (f.name.clone(), f)).collect();
    let constants = constants(&items, &pieces, &scope);
    let place = |name: &String| Some((name.clone(), scope.defined.get(name)?.clone()));
    let struct_places = scope.structs.keys().filter_map(place).collect();
    faults.or(Translation {
        source,
        functions,
        views: scope.views,
        constants,
        structs: scope.structs,
        struct_places,
        pieces,
    })
}

/// An item in WGSL.
#[derive(Clone, Debug)]
struct Piece {
    name: String,
    place: Place,
    uses: BTreeSet<String>,
    lines: Vec<Line>,
}

impl Piece {
    fn write(&self, source: &mut Source) {
        for (text, line) in &self.lines {
            let path = self.place.path.clone();
            source.push(text, Place { path, line: *line });
        }
        source.push("", self.place.clone());
    }
}

/// The translator's own functions, each on one line.
fn helpers() -> Vec<Piece> {
    let helper = |(name, intrinsic): &(&str, Intrinsic)| {
        let Intrinsic::Helper(text) = intrinsic else {
            return None;
        };
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/src/prelude.rs");
        let path = path.to_owned();
        Some(Piece {
            name: (*name).to_owned(),
            place: Place { path, line: 1 },
            uses: BTreeSet::new(),
            lines: vec![((*text).to_owned(), 1)],
        })
    };
    INTRINSICS.iter().filter_map(helper).collect()
}

/// The functions that read values of several words out of views.
fn readers(reads: &BTreeMap<String, Read>, scope: &Scope) -> Vec<Piece> {
    let mut pieces = BTreeMap::new();
    for Read { view, field, ty } in reads.values() {
        let Some(described) = scope.views.get(view) else {
            continue;
        };
        let memory = Memory::Field {
            view: view.clone(),
            field: field.clone(),
        };
        let line = described.field(field).map(|f| f.line);
        let mut assembler = Assembler {
            memory,
            structs: &scope.structs,
            line: line.unwrap_or(described.place.line),
            functions: BTreeMap::new(),
        };
        assembler.reader(ty);
        for (name, Assembly { uses, lines }) in assembler.functions {
            let place = described.place.clone();
            let piece = Piece {
                name: name.clone(),
                place,
                uses,
                lines,
            };
            pieces.insert(name, piece);
        }
    }
    pieces.into_values().collect()
}

/// The constants' values; needs come before what needs them in `pieces`.
fn constants(items: &[Item], pieces: &[Piece], scope: &Scope) -> BTreeMap<String, Value> {
    let by_name: BTreeMap<String, &syn::ItemConst> = items
        .iter()
        .filter_map(|item| match &item.kind {
            ItemKind::Constant(c) => Some((c.ident.to_string(), c)),
            _ => None,
        })
        .collect();
    let mut values = BTreeMap::new();
    for piece in pieces {
        if let Some(item) = by_name.get(&piece.name)
            && let Ok(lowered) = Lowering::new(scope).constant(item)
            && let Some(value) = evaluate(&lowered.item, &lowered.inference, &values)
        {
            values.insert(piece.name.clone(), value);
        }
    }
    values
}

fn translate_item(
    item: &Item,
    scope: &Scope,
    reads: &mut BTreeMap<String, Read>,
) -> Result<Piece, Fault> {
    let (ident, uses, lines) = match &item.kind {
        ItemKind::Struct(s) => {
            let name = s.ident.to_string();
            let fields = scope.structs.get(&name).cloned().unwrap_or_default();
            let mut uses = BTreeSet::new();
            fields.iter().for_each(|(_, ty)| structs_of(ty, &mut uses));
            let line = s.ident.span().start().line;
            (&s.ident, uses, emit::structure(line, &name, &fields))
        }
        ItemKind::Constant(c) => {
            let line = c.ident.span().start().line;
            let lowered = Lowering::new(scope).constant(c)?;
            if matches!(lowered.item.kind, ExprKind::If { .. } | ExprKind::Block(_)) {
                return Err(outside(
                    line,
                    "a constant with statements",
                    "write it as an expression",
                ));
            }
            let name = c.ident.to_string();
            let ty = scope.ty(&c.ty)?;
            let mut uses = lowered.uses;
            structs_of(&ty, &mut uses);
            let lines = emit::constant(line, &name, &ty, &lowered.item, &lowered.inference);
            (&c.ident, uses, lines)
        }
        ItemKind::Function(f) => {
            let lowered = Lowering::new(scope).function(f)?;
            let lines = emit::function(&lowered.item, &lowered.inference);
            reads.extend(lowered.reads);
            (&f.sig.ident, lowered.uses, lines)
        }
    };
    let path = item.path.clone();
    let line = ident.span().start().line;
    Ok(Piece {
        name: ident.to_string(),
        place: Place { path, line },
        uses,
        lines,
    })
}

fn structs_of(ty: &Ty, uses: &mut BTreeSet<String>) {
    match ty {
        Ty::Struct(name) => {
            uses.insert(name.clone());
        }
        Ty::Array(of, _) => structs_of(of, uses),
        _ => {}
    }
}

fn describe(item: &Item, scope: &Scope) -> Option<Function> {
    let ItemKind::Function(function) = &item.kind else {
        return None;
    };
    let name = function.sig.ident.to_string();
    let signature = scope.functions.get(&name)?;
    Some(Function {
        wgsl_name: crate::names::escaped(&name),
        name,
        parameters: signature.parameters.clone(),
        result: signature.result.clone(),
        place: Place {
            path: item.path.clone(),
            line: function.sig.ident.span().start().line,
        },
    })
}

/// A prelude function that is a function of WGSL, too.
fn offered(name: &str, intrinsic: Intrinsic, scope: &Scope) -> Option<Function> {
    let wgsl_name = match intrinsic {
        Intrinsic::Builtin(builtin) => builtin.to_owned(),
        Intrinsic::Helper(_) => crate::names::escaped(name),
        Intrinsic::Operator(_) | Intrinsic::Construct => return None,
    };
    let signature = scope.functions.get(name)?;
    Some(Function {
        name: name.to_owned(),
        wgsl_name,
        parameters: signature.parameters.clone(),
        result: signature.result.clone(),
        place: scope.defined.get(name)?.clone(),
    })
}
