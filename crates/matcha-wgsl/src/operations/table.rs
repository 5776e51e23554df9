//! The syntax of `operations!` and `families!`.

use super::OperandType;
use crate::diagnostic::{Fault, Problem};
use crate::translation::Module;
use syn::ext::IdentExt;
use syn::parse::{Parse, ParseStream};
use syn::punctuated::Punctuated;
use syn::{Ident, Token, braced, parenthesized};

/// One file's entries.
pub(super) struct Family {
    pub name: String,
    pub entries: Vec<Entry>,
}

/// One entry.
pub(super) struct Entry {
    pub line: usize,
    pub name: String,
    pub arguments: Vec<(String, OperandType)>,
    pub result: OperandType,
    pub form: Form,
}

/// A device function that an entry names.
pub(super) struct Named {
    pub name: String,
    pub line: usize,
}

/// How the operation runs.
pub(super) enum Form {
    Straight(Named),
    Loop {
        count: Named,
        init: Named,
        step: Named,
        finish: Named,
        state: usize,
    },
}

/// The entries of a file.
pub(super) fn family(module: &Module) -> Result<Family, Fault> {
    let makro = find(module, "operations")?;
    makro.parse_body().map_err(fault)
}

/// Lines and names of the families, in the order of their codes.
pub(super) fn family_order(module: &Module) -> Result<Vec<(usize, String)>, Fault> {
    let makro = find(module, "families")?;
    let parser = Punctuated::<Ident, Token![,]>::parse_terminated;
    let names = makro.parse_body_with(parser).map_err(fault)?;
    Ok(names
        .iter()
        .map(|n| (n.span().start().line, n.to_string()))
        .collect())
}

fn find(module: &Module, name: &str) -> Result<syn::Macro, Fault> {
    let file = syn::parse_file(&module.source).map_err(fault)?;
    let found = file.items.into_iter().find_map(|item| match item {
        syn::Item::Macro(m) if m.mac.path.is_ident(name) => Some(m.mac),
        _ => None,
    });
    found.ok_or_else(|| (1, Problem::Table(format!("no `{name}!` in this file"))))
}

fn fault(error: syn::Error) -> Fault {
    (error.span().start().line, Problem::Table(error.to_string()))
}

impl Parse for Family {
    fn parse(input: ParseStream) -> syn::Result<Self> {
        let keyword: Ident = input.parse()?;
        if keyword != "family" {
            return Err(syn::Error::new(keyword.span(), "expected `family name;`"));
        }
        let name: Ident = input.parse()?;
        input.parse::<Token![;]>()?;
        let mut entries = Vec::new();
        while !input.is_empty() {
            entries.push(input.parse()?);
        }
        Ok(Family {
            name: name.to_string(),
            entries,
        })
    }
}

impl Parse for Entry {
    fn parse(input: ParseStream) -> syn::Result<Self> {
        syn::Attribute::parse_outer(input)?;
        let name: Ident = input.parse()?;
        let list;
        parenthesized!(list in input);
        let arguments = list.parse_terminated(argument, Token![,])?;
        input.parse::<Token![->]>()?;
        let result = operand_type(input)?;
        let body;
        braced!(body in input);
        let mut form = None;
        while !body.is_empty() {
            let key = body.call(Ident::parse_any)?;
            body.parse::<Token![:]>()?;
            match key.to_string().as_str() {
                "eval" => form = Some(Form::Straight(body.parse()?)),
                "loop" => form = Some(loop_form(&body)?),
                "cost" | "error" | "domain" => drop(body.parse::<syn::Expr>()?),
                _ => return Err(syn::Error::new(key.span(), format!("unknown key `{key}`"))),
            }
            if !body.is_empty() {
                body.parse::<Token![,]>()?;
            }
        }
        let form = form.ok_or_else(|| syn::Error::new(name.span(), "neither `eval` nor `loop`"))?;
        Ok(Entry {
            line: name.span().start().line,
            name: name.to_string(),
            arguments: arguments.into_iter().collect(),
            result,
            form,
        })
    }
}

impl Parse for Named {
    fn parse(input: ParseStream) -> syn::Result<Self> {
        let path: syn::Path = input.parse()?;
        let last = path.segments.last();
        let name = last.map(|s| s.ident.to_string()).unwrap_or_default();
        let line = last.map_or(1, |s| s.ident.span().start().line);
        Ok(Named { name, line })
    }
}

fn argument(input: ParseStream) -> syn::Result<(String, OperandType)> {
    let name: Ident = input.parse()?;
    input.parse::<Token![:]>()?;
    Ok((name.to_string(), operand_type(input)?))
}

fn operand_type(input: ParseStream) -> syn::Result<OperandType> {
    let name: Ident = input.parse()?;
    OperandType::named(&name.to_string())
        .ok_or_else(|| syn::Error::new(name.span(), format!("`{name}` is no type of the table")))
}

fn loop_form(input: ParseStream) -> syn::Result<Form> {
    let body;
    let brace = braced!(body in input);
    let (mut count, mut init, mut step, mut finish, mut state) = (None, None, None, None, None);
    while !body.is_empty() {
        let key: Ident = body.parse()?;
        body.parse::<Token![:]>()?;
        match key.to_string().as_str() {
            "count" => count = Some(body.parse()?),
            "init" => init = Some(body.parse()?),
            "step" => step = Some(body.parse()?),
            "finish" => finish = Some(body.parse()?),
            "state" => state = Some(body.parse::<syn::LitInt>()?.base10_parse()?),
            _ => return Err(syn::Error::new(key.span(), format!("unknown key `{key}`"))),
        }
        if !body.is_empty() {
            body.parse::<Token![,]>()?;
        }
    }
    match (count, init, step, finish, state) {
        (Some(count), Some(init), Some(step), Some(finish), Some(state)) => Ok(Form::Loop {
            count,
            init,
            step,
            finish,
            state,
        }),
        _ => Err(syn::Error::new(
            brace.span.open(),
            "a loop has `count`, `init`, `step`, `finish` and `state`",
        )),
    }
}
