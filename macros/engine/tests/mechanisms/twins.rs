//! Twins: mechanisms of the catalogue and of the tests whose literals are parameters of the same
//! values. A plan may depend on the numbers that the macro sees, so it is judged where it sees
//! none.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use holonom_engine::model::{ElementKind, Rank};
use proc_macro2::{Delimiter, Group, Ident, Span, TokenStream, TokenTree};
use quote::{ToTokens, quote};
use syn::{Attribute, Item, ItemStruct};

use crate::comparison::Extent;
use crate::library::definition_of;
use crate::text::{Outcome, Text};

/// Which literals become parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Which {
    /// Every number.
    All,
    /// Those that are not zero: what a user would write.
    NotZero,
    /// One in three.
    Third,
}

/// The parameters of a twin.
struct Parameters {
    which: Which,
    /// The literals so far, equal ones once, so that a particle stays at the end of its rod.
    seen: Vec<f64>,
    values: Vec<f64>,
}

impl Parameters {
    /// Tokens in which literals are the names of parameters.
    fn rewritten(&mut self, tokens: TokenStream) -> TokenStream {
        let mut is_angle = false;
        let rewritten = tokens.into_iter().map(|token| match token {
            // Rotations and tensors are read at expansion only.
            TokenTree::Group(group) if is_angle || is_tensor(&group) => {
                is_angle = false;
                TokenTree::Group(group)
            }
            TokenTree::Group(group) => {
                let inner = self.rewritten(group.stream());
                TokenTree::Group(Group::new(group.delimiter(), inner))
            }
            TokenTree::Literal(literal) => match self.name(&literal.to_string()) {
                Some(name) => TokenTree::Ident(Ident::new(&name, Span::call_site())),
                None => TokenTree::Literal(literal),
            },
            TokenTree::Ident(word) => {
                is_angle = word == "rotation";
                TokenTree::Ident(word)
            }
            other => other,
        });
        rewritten.collect()
    }

    /// The parameter in the place of a literal.
    fn name(&mut self, literal: &str) -> Option<String> {
        let value = literal.parse::<f64>().ok()?;
        if !literal.contains(['.', 'e']) {
            return None;
        }
        let place = self.seen.iter().position(|known| *known == value);
        let place = place.unwrap_or_else(|| {
            self.seen.push(value);
            self.seen.len() - 1
        });
        let is_taken = match self.which {
            Which::All => true,
            Which::NotZero => value != 0.0,
            Which::Third => place % 3 == 0,
        };
        if !is_taken {
            return None;
        }
        let known = self.values.iter().position(|known| *known == value);
        let place = known.unwrap_or_else(|| {
            self.values.push(value);
            self.values.len() - 1
        });
        Some(format!("number_{place}"))
    }
}

/// Whether an array holds arrays.
fn is_tensor(group: &Group) -> bool {
    let is_array = |token: TokenTree| match token {
        TokenTree::Group(inner) => inner.delimiter() == Delimiter::Bracket,
        _ => false,
    };
    group.delimiter() == Delimiter::Bracket && group.stream().into_iter().any(is_array)
}

/// An attribute of the language.
fn is_ours(attribute: &Attribute) -> bool {
    ["mechanism", "body", "joint", "force"]
        .iter()
        .any(|word| attribute.path().is_ident(word))
}

/// A struct without what does not matter, its literals replaced; parameters may tell what they are
/// like.
fn twin(item: &ItemStruct, which: Which, is_told: bool) -> String {
    let mut parameters = Parameters {
        which,
        seen: Vec::new(),
        values: Vec::new(),
    };
    let attributes = item.attrs.iter().filter(|attribute| is_ours(attribute));
    let name = &item.ident;
    let fields: TokenStream = item
        .fields
        .iter()
        .map(|field| {
            let attributes: TokenStream = field
                .attrs
                .iter()
                .filter(|attribute| is_ours(attribute))
                .map(|attribute| {
                    let tokens = parameters.rewritten(attribute.meta.to_token_stream());
                    quote!(#[#tokens])
                })
                .collect();
            let (name, ty) = (&field.ident, &field.ty);
            quote!(#attributes #name: #ty,)
        })
        .collect();
    let values = parameters.values.iter().enumerate();
    let declared: String = values
        .map(|(place, value)| {
            let like = if is_told {
                format!("(like = {value:?})")
            } else {
                String::new()
            };
            format!("/// {value:?}\n#[param{like}]\nnumber_{place}: f64,\n")
        })
        .collect();
    format!(
        "{}\npub struct {name} {{\n{declared}{fields}}}",
        quote!(#(#attributes)*)
    )
}

/// All annotated structs of a file without run-time values, and the definitions in it.
fn structs(items: &[Item], found: &mut Vec<ItemStruct>, definitions: &mut Vec<Definition>) {
    for item in items {
        match item {
            Item::Struct(item) => {
                let is_mechanism = item.attrs.iter().any(|attribute| {
                    attribute.path().is_ident("derive")
                        && attribute
                            .to_token_stream()
                            .to_string()
                            .contains("Mechanism")
                });
                let is_plain = item.fields.iter().all(|field| {
                    let mut attributes = field.attrs.iter();
                    !attributes.any(|a| a.path().is_ident("param") || a.path().is_ident("input"))
                });
                if is_mechanism && is_plain {
                    found.push(item.clone());
                }
            }
            Item::Mod(module) => {
                if let Some((_, items)) = &module.content {
                    structs(items, found, definitions);
                }
            }
            other => definitions.extend(definition_of(other)),
        }
    }
}

type Definition = (String, ElementKind, String);

/// The files of Rust below a folder.
fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut entries: Vec<PathBuf> = entries
        .map(|entry| entry.expect("an entry").path())
        .collect();
    entries.sort();
    for entry in entries {
        if entry.is_dir() {
            files(&entry, found);
        } else if entry.extension().is_some_and(|extension| extension == "rs") {
            found.push(entry);
        }
    }
}

/// The mechanisms below a folder of the workspace, with their definitions.
fn mechanisms(folder: &str) -> Vec<(ItemStruct, Vec<Definition>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .join(folder);
    let mut paths = Vec::new();
    files(&folder, &mut paths);
    let mut mechanisms = Vec::new();
    for path in paths {
        let text = fs::read_to_string(&path).expect("a file");
        let Ok(file) = syn::parse_file(&text) else {
            continue;
        };
        let (mut found, mut definitions) = (Vec::new(), Vec::new());
        structs(&file.items, &mut found, &mut definitions);
        mechanisms.extend(found.into_iter().map(|item| (item, definitions.clone())));
    }
    mechanisms
}

/// What became of the twins of some mechanisms.
#[derive(Default)]
struct Tally {
    compared: usize,
    skipped: Vec<String>,
    wrong: Vec<String>,
}

impl Tally {
    fn judge(&mut self, item: &ItemStruct, definitions: &[Definition], which: Which) {
        // Equations that follow from others are found where parameters tell what they are like.
        match self.judge_as(item, definitions, which, false) {
            Some(why) if why.contains("that the macro cannot see") => {
                if let Some(why) = self.judge_as(item, definitions, which, true) {
                    self.skipped
                        .push(format!("{} ({which:?}, like): {why}", item.ident));
                }
            }
            Some(why) => self
                .skipped
                .push(format!("{} ({which:?}): {why}", item.ident)),
            None => {}
        }
    }

    /// Compares a twin, or says why it cannot be compared.
    fn judge_as(
        &mut self,
        item: &ItemStruct,
        definitions: &[Definition],
        which: Which,
        is_told: bool,
    ) -> Option<String> {
        let text = |item: String| Text {
            item,
            definitions: definitions.to_vec(),
        };
        let original = text(item.to_token_stream().to_string());
        let twin = text(twin(item, which, is_told));
        type Judged = Result<Result<Outcome, String>, String>;
        let run = catch_unwind(AssertUnwindSafe(|| -> Judged {
            let (original, own) = (original.rank()?, twin.rank()?);
            if (is_told || matches!(own, Rank::Decided { .. })) && original != own {
                return Ok(Err(format!("{original:?}, of the twin {own:?}")));
            }
            Ok(twin.check(&twin, 7, Extent::Full))
        }));
        match run {
            Ok(Ok(Ok(Outcome::Compared(_)))) => {
                self.compared += 1;
                None
            }
            Ok(Ok(Ok(Outcome::Refused(why) | Outcome::RefusedOtherwise(why)))) | Ok(Err(why)) => {
                Some(why)
            }
            Ok(Ok(Err(why))) => {
                self.wrong
                    .push(format!("{} ({which:?}): {why}\n{}", item.ident, twin.item));
                None
            }
            // The second reader knows no loops over `k` and no constants.
            Err(panic) => {
                let why = panic.downcast_ref::<String>().cloned().unwrap_or_default();
                Some(format!("not read: {why}"))
            }
        }
    }
}

#[test]
fn literals_may_be_parameters() {
    let mut tally = Tally::default();
    for folder in ["models/src", "tests/tests"] {
        for (item, definitions) in mechanisms(folder) {
            // Axes of which the macro sees nothing make long kernels of long chains.
            let most = if item.fields.len() <= 4 {
                Which::All
            } else {
                Which::NotZero
            };
            for which in [most, Which::Third] {
                println!("{} {which:?}", item.ident);
                tally.judge(&item, &definitions, which);
            }
        }
    }
    for skipped in &tally.skipped {
        println!("skipped {}", skipped.chars().take(300).collect::<String>());
    }
    println!(
        "{} compared, {} skipped",
        tally.compared,
        tally.skipped.len()
    );
    assert!(tally.wrong.is_empty(), "{}", tally.wrong.join("\n\n"));
    assert!(tally.compared > 200, "{} compared", tally.compared);
}
