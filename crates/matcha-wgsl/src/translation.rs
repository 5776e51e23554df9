//! Modules into one source.

use crate::collect::{Item, ItemKind, Scope, collect};
use crate::diagnostic::{Fault, Faults, Place, Problem, TranslateError, outside};
use crate::emit::{self, Line};
use crate::ir::ExprKind;
use crate::lower::Lowering;
use crate::order::ordered;
use crate::prelude::{INTRINSICS, Intrinsic};
use crate::source::Source;
use crate::types::Ty;
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
    pieces: Vec<Piece>,
}

impl Translation {
    /// Only what the device functions of these names (in Rust) need, and they themselves.
    pub fn needed<'n>(&self, names: impl IntoIterator<Item = &'n str>) -> Source {
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
        source
    }
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
    for item in &items {
        let piece = faults.keep(&item.path, translate_item(item, &scope));
        pieces.extend(piece);
    }
    faults.or(())?;
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
    faults.or(Translation {
        source,
        functions,
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

fn translate_item(item: &Item, scope: &Scope) -> Result<Piece, Fault> {
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
