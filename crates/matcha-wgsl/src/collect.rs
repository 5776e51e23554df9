//! The items of all modules, and the one namespace that they share in WGSL.

mod view;

use crate::diagnostic::{Fault, Faults, Place, Problem, outside};
use crate::layout::Structs;
use crate::lower::integer_literal;
use crate::prelude::{intrinsic, is_intrinsics_module};
use crate::translation::Module;
use crate::types::Ty;
use crate::view::View;
use std::collections::{BTreeMap, HashMap};
use syn::spanned::Spanned;

/// An item to translate.
pub(crate) struct Item {
    /// The module's path.
    pub path: String,
    pub kind: ItemKind,
}

pub(crate) enum ItemKind {
    Struct(syn::ItemStruct),
    Constant(syn::ItemConst),
    Function(syn::ItemFn),
}

/// A function as its callers see it.
#[derive(Clone, Debug)]
pub(crate) struct Signature {
    pub parameters: Vec<Ty>,
    pub result: Ty,
}

/// What names mean.
#[derive(Default)]
pub(crate) struct Scope {
    pub structs: Structs,
    pub views: BTreeMap<String, View>,
    pub constants: HashMap<String, Ty>,
    pub functions: HashMap<String, Signature>,
    lengths: HashMap<String, usize>,
    pub defined: HashMap<String, Place>,
}

/// Reads modules: their items in order, and the namespace.
pub(crate) fn collect(modules: &[Module], faults: &mut Faults) -> (Vec<Item>, Scope) {
    let mut items = Vec::new();
    let mut stand_ins = Vec::new();
    for module in modules {
        let path = &module.path;
        let parsed = syn::parse_file(&module.source)
            .map_err(|e| (e.span().start().line, Problem::Syntax(e.to_string())));
        let Some(file) = faults.keep(path, parsed) else {
            continue;
        };
        for item in file.items {
            let Some(Some(kind)) = faults.keep(path, kind_of(item)) else {
                continue;
            };
            let path = path.clone();
            match kind {
                ItemKind::Function(f) if is_intrinsics_module(&path) => stand_ins.push((path, f)),
                kind => items.push(Item { path, kind }),
            }
        }
    }
    let mut scope = Scope::default();
    // Of two items of one name the first counts, so that its callers are not in doubt.
    items.retain(|item| faults.keep(&item.path, scope.define(item)).is_some());
    for item in &items {
        faults.keep(&item.path, scope.describe(item));
    }
    let views: Vec<View> = scope.views.values().cloned().collect();
    for view in views {
        let laid_out = faults.keep(&view.place.path, scope.lay_out(&view));
        scope.views.extend(laid_out.map(|v| (v.name.clone(), v)));
    }
    for (path, function) in &stand_ins {
        faults.keep(path, scope.stand_in(function));
    }
    items.retain(|item| !is_intrinsic(item) && !is_view(item));
    (items, scope)
}

fn is_intrinsic(item: &Item) -> bool {
    matches!(&item.kind, ItemKind::Function(f) if intrinsic(&f.sig.ident.to_string()).is_some())
}

/// Views are not written into WGSL.
fn is_view(item: &Item) -> bool {
    matches!(&item.kind, ItemKind::Struct(s) if view::is_view(s))
}

/// The kind of an item; `None` where it has no part in WGSL.
fn kind_of(item: syn::Item) -> Result<Option<ItemKind>, Fault> {
    let line = item.span().start().line;
    let attributes: &[syn::Attribute] = match &item {
        syn::Item::Fn(i) => &i.attrs,
        syn::Item::Const(i) => &i.attrs,
        syn::Item::Struct(i) => &i.attrs,
        syn::Item::Mod(i) => &i.attrs,
        syn::Item::Use(i) => &i.attrs,
        _ => &[],
    };
    for attribute in attributes {
        if attribute.path().is_ident("cfg") {
            let is_test = attribute
                .parse_args::<syn::Ident>()
                .is_ok_and(|i| i == "test");
            return if is_test {
                Ok(None)
            } else {
                Err(outside(
                    line,
                    "`cfg`",
                    "a device is not known before the program runs",
                ))
            };
        }
    }
    match item {
        syn::Item::Fn(f) => Ok(Some(ItemKind::Function(f))),
        syn::Item::Const(c) => Ok(Some(ItemKind::Constant(c))),
        syn::Item::Struct(s) => Ok(Some(ItemKind::Struct(s))),
        syn::Item::Use(u) => renamed(&u.tree).map(|()| None),
        // Files of modules are listed one by one; this one only names them.
        syn::Item::Mod(m) if m.content.is_none() => Ok(None),
        other => {
            let what = match other {
                syn::Item::Impl(_) => "`impl`",
                syn::Item::Trait(_) => "`trait`",
                syn::Item::Enum(_) => "`enum`",
                syn::Item::Static(_) => "`static`",
                syn::Item::Type(_) => "`type`",
                syn::Item::Mod(_) => "a module in a module",
                syn::Item::Macro(_) => "a macro",
                _ => "this item",
            };
            Err(outside(
                line,
                what,
                "modules hold `use`, `const`, plain structs and free functions",
            ))
        }
    }
}

/// Refuses `use a as b`: names are looked up as they are.
fn renamed(tree: &syn::UseTree) -> Result<(), Fault> {
    match tree {
        syn::UseTree::Rename(rename) => {
            let line = rename.span().start().line;
            Err(outside(
                line,
                "`use … as …`",
                "names are one over all modules; use them as they are",
            ))
        }
        syn::UseTree::Path(path) => renamed(&path.tree),
        syn::UseTree::Group(group) => group.items.iter().try_for_each(renamed),
        _ => Ok(()),
    }
}

impl Scope {
    /// Enters an item's name.
    fn define(&mut self, item: &Item) -> Result<(), Fault> {
        let ident = match &item.kind {
            ItemKind::Struct(s) => &s.ident,
            ItemKind::Constant(c) => &c.ident,
            ItemKind::Function(f) => &f.sig.ident,
        };
        let name = ident.to_string();
        let line = ident.span().start().line;
        if let Some(first) = self.defined.get(&name) {
            let first = first.clone();
            return Err((line, Problem::Duplicate { name, first }));
        }
        if let ItemKind::Constant(c) = &item.kind
            && let Some(length) = integer_literal(&c.expr)
        {
            self.lengths.insert(name.clone(), length as usize);
        }
        let path = item.path.clone();
        let place = Place { path, line };
        self.defined.insert(name.clone(), place.clone());
        // Their fields may name each other, so that the names come first.
        if is_view(item) {
            let view = View {
                name: name.clone(),
                fields: Vec::new(),
                header_words: 0,
                place,
            };
            self.views.insert(name, view);
        } else if let ItemKind::Struct(_) = item.kind {
            self.structs.insert(name, Vec::new());
        }
        Ok(())
    }

    /// Resolves the types in an item's face.
    fn describe(&mut self, item: &Item) -> Result<(), Fault> {
        match &item.kind {
            ItemKind::Struct(s) if is_view(item) => {
                let view = self.view(s, &item.path)?;
                self.views.insert(view.name.clone(), view);
            }
            ItemKind::Struct(s) => {
                let fields = self.fields(s)?;
                self.structs.insert(s.ident.to_string(), fields);
            }
            ItemKind::Constant(c) => {
                let ty = self.ty(&c.ty)?;
                self.constants.insert(c.ident.to_string(), ty);
            }
            ItemKind::Function(f) => {
                // The prelude's generic functions have rules of their own.
                if f.sig.generics.params.is_empty() || intrinsic(&f.sig.ident.to_string()).is_none()
                {
                    let signature = self.signature(&f.sig)?;
                    self.functions.insert(f.sig.ident.to_string(), signature);
                }
            }
        }
        Ok(())
    }

    /// A function of an `intrinsics` module: WGSL or the prelude has it.
    fn stand_in(&mut self, function: &syn::ItemFn) -> Result<(), Fault> {
        let name = function.sig.ident.to_string();
        if self.functions.contains_key(&name) || name == "select" {
            return Ok(());
        }
        if intrinsic(&name).is_none() {
            let line = function.sig.ident.span().start().line;
            return Err((line, Problem::UnknownIntrinsic(name)));
        }
        let signature = self.signature(&function.sig)?;
        self.functions.insert(name, signature);
        Ok(())
    }

    fn fields(&self, item: &syn::ItemStruct) -> Result<Vec<(String, Ty)>, Fault> {
        let line = item.ident.span().start().line;
        if !item.generics.params.is_empty() {
            return Err(outside(
                line,
                "a generic struct",
                "name a struct for each type",
            ));
        }
        let syn::Fields::Named(fields) = &item.fields else {
            return Err(outside(
                line,
                "a struct without field names",
                "name its fields",
            ));
        };
        let named = fields.named.iter();
        named
            .map(|f| {
                let name = f.ident.as_ref().map(ToString::to_string);
                Ok((name.unwrap_or_default(), self.ty(&f.ty)?))
            })
            .collect()
    }

    fn signature(&self, sig: &syn::Signature) -> Result<Signature, Fault> {
        let line = sig.ident.span().start().line;
        if sig.generics.lifetimes().count() < sig.generics.params.len() {
            return Err(outside(
                line,
                "a generic function",
                "write one function for each type",
            ));
        }
        if sig.asyncness.is_some() || sig.unsafety.is_some() || sig.variadic.is_some() {
            return Err(outside(line, "this kind of function", "write a plain `fn`"));
        }
        let mut parameters = Vec::new();
        for input in &sig.inputs {
            match input {
                syn::FnArg::Typed(typed) => parameters.push(self.parameter(&typed.ty)?),
                syn::FnArg::Receiver(_) => {
                    return Err(outside(line, "`self`", "write a free function"));
                }
            }
        }
        let writes = |ty: &Ty| matches!(ty, Ty::Reference { mutable: true, .. });
        let result = match &sig.output {
            syn::ReturnType::Type(_, result) => self.ty(result)?,
            syn::ReturnType::Default if parameters.iter().any(writes) => Ty::Unit,
            syn::ReturnType::Default => {
                return Err(outside(
                    line,
                    "a function without result",
                    "return a value, or write through a `&mut` parameter",
                ));
            }
        };
        Ok(Signature { parameters, result })
    }

    /// A type of the subset.
    pub fn ty(&self, ty: &syn::Type) -> Result<Ty, Fault> {
        let line = ty.span().start().line;
        if self.view_name(ty).is_some() {
            return Err(outside(
                line,
                "a view in this place",
                "views are parameters, by value",
            ));
        }
        match ty {
            syn::Type::Path(path) if path.qself.is_none() => {
                let segment = path.path.segments.last();
                let plain = segment.filter(|s| s.arguments.is_none());
                let name = plain.map(|s| s.ident.to_string()).unwrap_or_default();
                Ok(match name.as_str() {
                    "f32" => Ty::F32,
                    "i32" => Ty::I32,
                    "u32" => Ty::U32,
                    "bool" => Ty::Bool,
                    "Vec2" => Ty::Vec2,
                    "Vec3" => Ty::Vec3,
                    _ if self.structs.contains_key(&name) => Ty::Struct(name),
                    _ => {
                        let written = path.path.segments.iter().map(|s| s.ident.to_string());
                        let written: Vec<String> = written.collect();
                        return Err((line, Problem::UnknownType(written.join("::"))));
                    }
                })
            }
            syn::Type::Array(array) => {
                let of = self.ty(&array.elem)?;
                Ok(Ty::Array(Box::new(of), self.length(&array.len)?))
            }
            syn::Type::Paren(inner) => self.ty(&inner.elem),
            syn::Type::Group(inner) => self.ty(&inner.elem),
            syn::Type::Reference(_) => Err(outside(
                line,
                "a reference in this place",
                "references are parameters; return values",
            )),
            syn::Type::Slice(_) => Err(outside(
                line,
                "a slice",
                "use a fixed array, or a view's field",
            )),
            syn::Type::Tuple(_) => Err(outside(line, "a tuple", "name a struct")),
            _ => Err(outside(
                line,
                "this type",
                "use f32, u32, i32, bool, Vec2, Vec3, a struct or an array of those",
            )),
        }
    }

    /// An array's length: a literal, or a constant that is one.
    pub fn length(&self, length: &syn::Expr) -> Result<usize, Fault> {
        if let Some(literal) = integer_literal(length) {
            return Ok(literal as usize);
        }
        let name = match length {
            syn::Expr::Path(path) => path.path.segments.last().map(|s| s.ident.to_string()),
            _ => None,
        };
        let known = name.and_then(|n| self.lengths.get(&n).copied());
        known.ok_or_else(|| {
            let line = length.span().start().line;
            outside(
                line,
                "a computed array length",
                "write the number, or a constant that is one",
            )
        })
    }
}
