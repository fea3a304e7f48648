//! Which files of a crate use which, read from its sources.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// A module by its path within the crate.
pub(crate) type Module = Vec<String>;

/// Which files use which.
pub(crate) type Graph = BTreeMap<Module, BTreeSet<Module>>;

/// The files of a folder, by module, without unit tests that are files of their own.
pub(crate) struct Sources {
    pub(crate) texts: BTreeMap<Module, String>,
}

impl Sources {
    /// Those beneath a folder of the workspace.
    pub(crate) fn of(folder: &str) -> Self {
        let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).parent();
        let root = workspace.expect("tests lie in the workspace").join(folder);
        let mut paths = Vec::new();
        files(&root, &mut paths);
        let read = |path: &PathBuf| {
            let inside = path.strip_prefix(&root).expect("it lies there");
            let parts = inside.with_extension("");
            let mut module: Module = parts
                .iter()
                .map(|part| part.to_string_lossy().into_owned())
                .collect();
            if module.last().is_some_and(|last| last == "mod") {
                module.pop();
            }
            (module, fs::read_to_string(path).expect("it can be read"))
        };
        Self {
            texts: paths.iter().map(read).collect(),
        }
    }

    /// The tokens of a file.
    pub(crate) fn tokens(&self, module: &Module) -> TokenStream {
        self.texts[module].parse().expect("it is Rust")
    }

    /// Which files use which by paths. What the head of a folder uses of its own files counts if
    /// asked for.
    pub(crate) fn graph(&self, of_heads: bool) -> Graph {
        let texts = &self.texts;
        let mut graph = BTreeMap::new();
        for module in texts.keys() {
            let mut used = BTreeSet::new();
            let mut heads = BTreeSet::from(["crate", "super"]);
            if of_heads {
                let children = texts.keys().filter_map(|other| other.split_last());
                let children = children.filter(|(_, parent)| *parent == module.as_slice());
                heads.extend(children.map(|(name, _)| name.as_str()).chain(["self"]));
            }
            named(self.tokens(module), &heads, &mut |path| {
                let whole = absolute(module, path);
                match self.file_of(&whole) {
                    Some(file) if file == module.as_slice() => {}
                    Some(file) => {
                        used.insert(file.to_vec());
                    }
                    // A type or a function; macros are of the root, and written in small letters.
                    None if whole
                        .first()
                        .is_some_and(|name| name.starts_with(char::is_uppercase)) =>
                    {
                        used.insert(vec!["lib".to_owned()]);
                    }
                    None => {}
                }
            });
            graph.insert(module.clone(), used);
        }
        graph
    }

    /// The file in which a path from the root on ends.
    pub(crate) fn file_of<'a>(&self, path: &'a [String]) -> Option<&'a [String]> {
        let starts = (1..=path.len()).rev().map(|length| &path[..length]);
        starts
            .into_iter()
            .find(|start| self.texts.contains_key(*start))
    }
}

/// Files that use each other, directly or by others.
pub(crate) fn circles(graph: &Graph) -> BTreeSet<Vec<Module>> {
    let reached = |from: &Module| {
        let (mut seen, mut open) = (BTreeSet::new(), vec![from]);
        while let Some(file) = open.pop() {
            for next in graph.get(file).into_iter().flatten() {
                if seen.insert(next) {
                    open.push(next);
                }
            }
        }
        seen
    };
    let reach: BTreeMap<&Module, BTreeSet<&Module>> =
        graph.keys().map(|file| (file, reached(file))).collect();
    let circle = |file: &Module| -> Vec<Module> {
        let others = reach[file].iter().filter(|other| {
            let back = reach.get(**other);
            back.is_some_and(|back| back.contains(file))
        });
        others.map(|other| (*other).clone()).collect()
    };
    let all = graph.keys().map(circle);
    all.filter(|circle| circle.len() > 1).collect()
}

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("it can be read") {
        let path = entry.expect("it can be read").path();
        let stem = path.file_stem().expect("it has a name");
        if stem == "tests" {
            continue;
        }
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|kind| kind == "rs") {
            found.push(path);
        }
    }
}

/// A path that begins with `crate`, `self` or `super`, from the root on.
pub(crate) fn absolute(module: &[String], path: &[String]) -> Module {
    let (mut base, mut rest) = (module.to_vec(), path);
    while let Some((first, others)) = rest.split_first() {
        match first.as_str() {
            "crate" => base.clear(),
            "super" => {
                base.pop();
            }
            "self" => {}
            _ => break,
        }
        rest = others;
    }
    base.extend_from_slice(rest);
    base
}

/// Calls a function with every path that begins with one of the heads. What stands in unit tests
/// does not count.
pub(crate) fn named(tokens: TokenStream, heads: &BTreeSet<&str>, each: &mut impl FnMut(&[String])) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let mut place = 0;
    while place < tokens.len() {
        match &tokens[place] {
            TokenTree::Punct(mark) if mark.as_char() == '#' => {
                let is_test = matches!(tokens.get(place + 1), Some(TokenTree::Group(group))
                    if group.stream().to_string().replace(' ', "") == "cfg(test)");
                // `#[cfg(test)] mod name {..}`
                place += if is_test { 5 } else { 1 };
            }
            TokenTree::Group(group) => {
                named(group.stream(), heads, each);
                place += 1;
            }
            // `$crate` is what users of a macro name.
            TokenTree::Punct(mark) if mark.as_char() == '$' => {
                let is_name = matches!(tokens.get(place + 1), Some(TokenTree::Ident(_)));
                place += if is_name { 2 } else { 1 };
            }
            TokenTree::Ident(word)
                if heads.contains(word.to_string().as_str()) && begins(&tokens, place) =>
            {
                place = path(&tokens, place, &mut Vec::new(), each);
            }
            _ => place += 1,
        }
    }
}

/// Whether a word is the first of a path, and neither a method nor a part of a longer one.
fn begins(tokens: &[TokenTree], place: usize) -> bool {
    let mark = |at: usize| match tokens.get(at) {
        Some(TokenTree::Punct(mark)) => Some(mark.as_char()),
        _ => None,
    };
    let before = place.checked_sub(1).and_then(mark);
    let is_longer = mark(place + 1) == Some(':') && mark(place + 2) == Some(':');
    // `name::<Type>(..)` is the call of a function.
    let is_module = mark(place + 3) != Some('<');
    is_longer && is_module && !matches!(before, Some(':' | '.'))
}

/// The path from a place on, and those of its branches in braces. Returns where it ends.
fn path(
    tokens: &[TokenTree],
    mut place: usize,
    path_so_far: &mut Vec<String>,
    each: &mut impl FnMut(&[String]),
) -> usize {
    let depth = path_so_far.len();
    loop {
        match tokens.get(place) {
            Some(TokenTree::Ident(word)) => {
                path_so_far.push(word.to_string());
                place += 1;
            }
            Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Brace => {
                let inner: Vec<TokenTree> = group.stream().into_iter().collect();
                let is_comma =
                    |token: &TokenTree| matches!(token, TokenTree::Punct(p) if p.as_char() == ',');
                for branch in inner.split(is_comma) {
                    path(branch, 0, path_so_far, each);
                }
                path_so_far.truncate(depth);
                return place + 1;
            }
            _ => break,
        }
        let colon =
            |at: usize| matches!(tokens.get(at), Some(TokenTree::Punct(p)) if p.as_char() == ':');
        if !(colon(place) && colon(place + 1)) {
            break;
        }
        place += 2;
    }
    each(path_so_far);
    path_so_far.truncate(depth);
    place
}
