//! The passes read one way: none uses what comes after it.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use proc_macro2::{TokenStream, TokenTree};

/// The modules of the engine, each behind those that it may use.
const ORDER: [&str; 13] = [
    "model",
    "diag",
    "syntax",
    "wire",
    "mesh",
    "check",
    "symbolic",
    "rank",
    "passes",
    "plan",
    "coordinates",
    "emit",
    "lib",
];
/// Pairs that the order allows and that have nothing to do with each other: what is refused knows
/// no algebra, and algebra no text.
const APART: [(&str, &str); 12] = [
    ("mesh", "model"),
    ("mesh", "diag"),
    ("mesh", "syntax"),
    ("symbolic", "diag"),
    ("symbolic", "syntax"),
    ("symbolic", "check"),
    ("rank", "diag"),
    ("rank", "syntax"),
    ("rank", "check"),
    ("plan", "syntax"),
    ("plan", "rank"),
    ("coordinates", "syntax"),
];

#[test]
fn the_passes_read_one_way() {
    let mut found = BTreeSet::new();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    files(&root, &mut |path| {
        let inside = path.strip_prefix(&root).expect("it lies there");
        let first = inside.iter().next().expect("it has a name");
        let module = Path::new(first).file_stem().expect("it has a name");
        let module = module.to_string_lossy().into_owned();
        let text = fs::read_to_string(path).expect("it can be read");
        let tokens = text.parse().expect("it is Rust");
        uses(tokens, &mut |used| {
            found.insert((module.clone(), used));
        });
    });
    let place = |module: &str| {
        let place = ORDER.iter().position(|known| *known == module);
        place.unwrap_or_else(|| panic!("`{module}` has no place in the order of passes"))
    };
    let mut arrows = 0;
    for (module, used) in &found {
        if module == used || !ORDER.contains(&used.as_str()) {
            continue;
        }
        arrows += 1;
        assert!(
            place(used) < place(module),
            "`{module}` uses `{used}`, which comes after it"
        );
        assert!(
            !APART.contains(&(module, used)),
            "`{module}` uses `{used}`, which it should not know"
        );
    }
    assert!(arrows > 20, "they were found: {arrows}");
}

/// All files below a folder.
fn files(folder: &Path, each: &mut impl FnMut(&Path)) {
    for entry in fs::read_dir(folder).expect("it can be read") {
        let path = entry.expect("it can be read").path();
        if path.is_dir() {
            files(&path, each);
        } else {
            each(&path);
        }
    }
}

/// The names behind `crate::`, one or several in braces.
fn uses(tokens: TokenStream, each: &mut impl FnMut(String)) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    for (place, token) in tokens.iter().enumerate() {
        match token {
            TokenTree::Group(group) => uses(group.stream(), each),
            TokenTree::Ident(word) if word == "crate" => match tokens.get(place + 3) {
                Some(TokenTree::Ident(used)) => each(used.to_string()),
                Some(TokenTree::Group(group)) => {
                    let mut is_first = true;
                    for token in group.stream() {
                        if let TokenTree::Ident(used) = &token
                            && is_first
                        {
                            each(used.to_string());
                        }
                        is_first = matches!(&token, TokenTree::Punct(p) if p.as_char() == ',');
                    }
                }
                _ => {}
            },
            _ => {}
        }
    }
}
