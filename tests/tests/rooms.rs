//! Rooms are folders of `src`, and read one way; circles of files are few, small, and named here.

#![forbid(unsafe_code)]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// A module by its path within the crate.
type Module = Vec<String>;

/// The rooms of the run time, each behind those that it may use.
const RUNTIME: [&str; 18] = [
    "math",
    "error",
    "state",
    "forward",
    "mechanism",
    "constraints",
    "integrate",
    "formulation",
    "monitor",
    "assembly",
    "nonsmooth",
    "measure",
    "independent",
    "dynamics",
    "stepping",
    "run",
    "sensitivity",
    "lanes",
];

/// What lies beside the rooms: interfaces, and the language's own tables.
const BESIDE: [&str; 5] = ["lib", "private", "joints", "forces", "guide"];

/// The circles of files in the engine. They may only shrink.
const ENGINE_CIRCLES: [&[&str]; 3] = [
    &["coordinates/align", "coordinates/links"],
    &[
        "coordinates/candidates",
        "coordinates/handover",
        "coordinates/system",
    ],
    &["coordinates/certain", "coordinates/dependent"],
];

/// The circles of files in the run time.
const RUNTIME_CIRCLES: [&[&str]; 2] = [
    &["math/scalar", "math/versine"],
    &["mechanism/coordinates", "mechanism/kernels"],
];

#[test]
fn rooms_of_the_run_time_read_one_way() {
    let graph = graph("runtime/src", false);
    let place = |room: &str| {
        let place = RUNTIME.iter().position(|known| *known == room);
        place.unwrap_or_else(|| panic!("the room `{room}` has no place in the order"))
    };
    let mut arrows = 0;
    for (file, used) in &graph {
        if BESIDE.contains(&file[0].as_str()) {
            continue;
        }
        for other in used {
            assert_ne!(
                other,
                &["lib"],
                "`{}` names something by the root, which is for users",
                file.join("/")
            );
            if file[0] != other[0] && !BESIDE.contains(&other[0].as_str()) {
                arrows += 1;
                assert!(
                    place(&other[0]) < place(&file[0]),
                    "`{}` uses `{}`, which comes after it",
                    file.join("/"),
                    other.join("/")
                );
            }
        }
    }
    assert!(arrows > 200, "they were found: {arrows}");
}

#[test]
fn circles_of_files_do_not_grow() {
    // Heads of rooms of the run time re-export what users name, and hold the traits of their files.
    for (folder, known, of_heads) in [
        ("runtime/src", &RUNTIME_CIRCLES[..], false),
        ("macros/engine/src", &ENGINE_CIRCLES[..], true),
    ] {
        for circle in circles(&graph(folder, of_heads)) {
            let names: Vec<String> = circle.iter().map(|file| file.join("/")).collect();
            let is_known = known
                .iter()
                .any(|known| names.iter().all(|name| known.contains(&name.as_str())));
            assert!(is_known, "{folder}: a circle of {names:?}");
        }
    }
}

/// Files that use each other, directly or by others.
fn circles(graph: &BTreeMap<Module, BTreeSet<Module>>) -> BTreeSet<Vec<Module>> {
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

/// Which files use which. What the head of a folder uses of its own files counts if asked for.
fn graph(folder: &str, of_heads: bool) -> BTreeMap<Module, BTreeSet<Module>> {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).parent();
    let root = workspace.expect("tests lie in the workspace").join(folder);
    let mut paths = Vec::new();
    files(&root, &mut paths);
    let texts: BTreeMap<Module, String> = paths
        .iter()
        .map(|path| {
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
        })
        .collect();
    let mut graph = BTreeMap::new();
    for (module, text) in &texts {
        let mut used = BTreeSet::new();
        let tokens: TokenStream = text.parse().expect("it is Rust");
        let mut heads = BTreeSet::from(["crate", "super"]);
        if of_heads {
            let children = texts.keys().filter_map(|other| other.split_last());
            let children = children.filter(|(_, parent)| *parent == module.as_slice());
            heads.extend(children.map(|(name, _)| name.as_str()).chain(["self"]));
        }
        named(tokens, &heads, &mut |path| {
            let whole = absolute(module, path);
            let file = (1..=whole.len()).rev().map(|length| &whole[..length]);
            let file = file.into_iter().find(|start| texts.contains_key(*start));
            match file {
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
fn absolute(module: &[String], path: &[String]) -> Module {
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
fn named(tokens: TokenStream, heads: &BTreeSet<&str>, each: &mut impl FnMut(&[String])) {
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
