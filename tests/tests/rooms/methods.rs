//! Which files of a crate call which through the methods of one type.
//!
//! `impl Run` may stand in eight files. What one of them calls by `self.method()` and another
//! defines is an arrow between these files, which no `use` shows.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};

use crate::graph::{Graph, Module, Sources, absolute, named};

/// A type by the file that defines it, and its name.
type Defined = (Module, String);

/// The blocks of one type in one file.
#[derive(Default)]
struct Block {
    /// Methods that are the type's own, and not of a trait.
    defined: BTreeSet<String>,
    /// What is called by `self.method(..)` or `Self::function`.
    called: BTreeSet<String>,
}

/// Adds an arrow for every call of a method of the same type that another file defines.
pub(crate) fn add(sources: &Sources, graph: &mut Graph) {
    let mut definers: BTreeMap<String, Vec<Module>> = BTreeMap::new();
    for module in sources.texts.keys() {
        types(sources.tokens(module), &mut |name| {
            definers.entry(name).or_default().push(module.clone());
        });
    }
    let mut blocks: BTreeMap<Defined, BTreeMap<Module, Block>> = BTreeMap::new();
    for module in sources.texts.keys() {
        impls(sources.tokens(module), &mut |name, is_own, body| {
            let Some(defined) = definer(sources, &definers, module, &name) else {
                return;
            };
            let of = blocks.entry((defined, name)).or_default();
            let block = of.entry(module.clone()).or_default();
            if is_own {
                block.defined.extend(functions(body));
            }
            calls(body.stream(), &mut block.called);
        });
    }
    for of in blocks.values() {
        for (module, block) in of {
            for call in block.called.difference(&block.defined) {
                let others = of.iter().filter(|(_, other)| other.defined.contains(call));
                let used = graph.entry(module.clone()).or_default();
                used.extend(others.map(|(other, _)| other.clone()));
            }
        }
    }
}

/// The file that defines a type of this name, as seen from another one.
fn definer(
    sources: &Sources,
    definers: &BTreeMap<String, Vec<Module>>,
    module: &Module,
    name: &str,
) -> Option<Module> {
    let all = definers.get(name)?;
    if all.contains(module) {
        return Some(module.clone());
    }
    if let [only] = all.as_slice() {
        return Some(only.clone());
    }
    let mut imported = None;
    let heads = BTreeSet::from(["crate", "super"]);
    named(sources.tokens(module), &heads, &mut |path| {
        if path.last().is_some_and(|last| last == name) {
            let whole = absolute(module, path);
            imported = sources.file_of(&whole).map(<[String]>::to_vec);
        }
    });
    let imported = imported?;
    // A head may name what a file of its folder defines.
    let behind = |other: &&Module| other.starts_with(&imported);
    all.iter().find(behind).cloned()
}

/// Calls a function with the name of every type that is defined.
fn types(tokens: TokenStream, each: &mut impl FnMut(String)) {
    walk(tokens, &mut |tokens, place| {
        if let TokenTree::Ident(word) = &tokens[place]
            && ["struct", "enum"].contains(&word.to_string().as_str())
            && let Some(TokenTree::Ident(name)) = tokens.get(place + 1)
        {
            each(name.to_string());
        }
    });
}

/// Calls a function with the type of every `impl`, whether it is of no trait, and its body.
fn impls(tokens: TokenStream, each: &mut impl FnMut(String, bool, &Group)) {
    walk(tokens, &mut |tokens, place| {
        let is_impl = matches!(&tokens[place], TokenTree::Ident(word) if word == "impl");
        // Not `impl Trait` in a signature: an item begins a line of its own.
        let is_item = match place.checked_sub(1).map(|before| &tokens[before]) {
            None => true,
            Some(TokenTree::Punct(mark)) => mark.as_char() == ';',
            Some(TokenTree::Group(group)) => {
                [Delimiter::Brace, Delimiter::Bracket].contains(&group.delimiter())
            }
            Some(_) => false,
        };
        if !(is_impl && is_item) {
            return;
        }
        let rest = &tokens[place + 1..];
        let end = rest.iter().position(
            |token| matches!(token, TokenTree::Group(group) if group.delimiter() == Delimiter::Brace),
        );
        let Some(end) = end else { return };
        let TokenTree::Group(body) = &rest[end] else {
            return;
        };
        let header = outside_of_brackets(&rest[..end]);
        let words: Vec<String> = header.iter().map(ToString::to_string).collect();
        let is_of = words.iter().position(|word| word == "for");
        let first = is_of.map_or(0, |place| place + 1);
        let words = words[first..].iter().take_while(|word| *word != "where");
        let name = words
            .filter(|word| word.starts_with(char::is_uppercase))
            .last();
        if let Some(name) = name {
            each(name.clone(), is_of.is_none(), body);
        }
    });
}

/// The tokens that stand in no `<..>`.
fn outside_of_brackets(tokens: &[TokenTree]) -> Vec<TokenTree> {
    let (mut depth, mut before) = (0, ' ');
    let mut outside = Vec::new();
    for token in tokens {
        let mark = match token {
            TokenTree::Punct(mark) => mark.as_char(),
            _ => ' ',
        };
        match mark {
            '<' => depth += 1,
            // Not `->`.
            '>' if before != '-' => depth -= 1,
            _ if depth == 0 => outside.push(token.clone()),
            _ => {}
        }
        before = mark;
    }
    outside
}

/// The names of the functions of a body.
fn functions(body: &Group) -> Vec<String> {
    let tokens: Vec<TokenTree> = body.stream().into_iter().collect();
    let pairs = tokens.windows(2).filter_map(|pair| match pair {
        [TokenTree::Ident(word), TokenTree::Ident(name)] if word == "fn" => Some(name.to_string()),
        _ => None,
    });
    pairs.collect()
}

/// What is called by `self.method(..)`, and `Self::function`.
fn calls(tokens: TokenStream, called: &mut BTreeSet<String>) {
    walk(tokens, &mut |tokens, place| {
        let TokenTree::Ident(word) = &tokens[place] else {
            return;
        };
        let mark = |at: usize| match tokens.get(at) {
            Some(TokenTree::Punct(mark)) => mark.as_char(),
            _ => ' ',
        };
        let name = |at: usize| match tokens.get(at) {
            Some(TokenTree::Ident(name)) => Some(name.to_string()),
            _ => None,
        };
        // A field is followed by neither.
        let is_call = |at: usize| {
            mark(at) == ':'
                || matches!(tokens.get(at), Some(TokenTree::Group(group))
                    if group.delimiter() == Delimiter::Parenthesis)
        };
        if word == "self" && mark(place + 1) == '.' && is_call(place + 3) {
            called.extend(name(place + 2));
        } else if word == "Self" && mark(place + 1) == ':' && mark(place + 2) == ':' {
            called.extend(name(place + 3));
        }
    });
}

/// Calls a function at every token, those in groups included, but not in unit tests.
fn walk(tokens: TokenStream, each: &mut dyn FnMut(&[TokenTree], usize)) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let mut place = 0;
    while place < tokens.len() {
        each(&tokens, place);
        place += match &tokens[place] {
            TokenTree::Punct(mark) if mark.as_char() == '#' => {
                let is_test = matches!(tokens.get(place + 1), Some(TokenTree::Group(group))
                    if group.stream().to_string().replace(' ', "") == "cfg(test)");
                if is_test { 5 } else { 1 }
            }
            TokenTree::Group(group) => {
                walk(group.stream(), each);
                1
            }
            _ => 1,
        };
    }
}

#[test]
fn calls_of_methods_are_arrows() {
    let file = |name: &str, text: &str| (vec![name.to_owned()], text.to_owned());
    let sources = Sources {
        texts: BTreeMap::from([
            file(
                "a",
                "pub struct Run<S>(S);\nimpl<S> Run<S> { fn go(&self) { if true { self.end::<u8>(1) } } }",
            ),
            file(
                "b",
                "use crate::a::Run;\nimpl<S: Fn() -> u8> Run<S> { fn end(&self) { self.0; Self::go(self) } }",
            ),
            file(
                "c",
                "use crate::a::Run;\nimpl<S> Drop for Run<S> where S: Copy { fn drop(&mut self) { self.go() } }",
            ),
        ]),
    };
    let mut graph = Graph::new();
    add(&sources, &mut graph);
    let arrows: Vec<String> = graph
        .iter()
        .flat_map(|(from, to)| to.iter().map(move |to| format!("{}{}", from[0], to[0])))
        .collect();
    assert_eq!(arrows, ["ab", "ba", "ca"]);
}
